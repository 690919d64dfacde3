"""A fluid said in words, ``"water at 20 °C"``, in place of the properties that a card asks of it."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from granum.core import flags
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.units import show
from granum.materials.correlation import Correlation, Missing, Owner
from granum.materials.fluids import Fluid
from granum.materials.library import session
from granum.materials.solutes import SoluteSystem

_WORDS = re.compile(r"^\s*(?P<name>.+?)\s+(?:at|à|@)\s+(?P<state>.+?)\s*$")
_SOLUTION_WORDS = re.compile(r"^\s*(?P<name>.*(?:%|g/kg).*?)\s+(?:at|à|@)\s+(?P<state>.+?)\s*$")
_STATE_ALONE = re.compile(
    r"^\s*(?P<name>.+?)[\s,]+(?P<state>[-+−]?\d[\d.,]*\s*(?:°\s*[CF]|deg[CF]|K|C|F)(?![\w/]).*?)\s*$"
)  # "water 60 °C"
_SHARE = r"(?P<share>[-+−]?[\d.,]+\s*(?:wt\s*%|%|g/kg|kg/kg))"
_SOLUTIONS = [
    re.compile(pattern, re.IGNORECASE)
    for pattern in (
        rf"^{_SHARE}\s+(?:of\s+|de\s+|d['’])?(?P<solute>.+)$",
        rf"^(?P<solute>.+?)(?:\s*,|\s+of|\s+à|\s+at|\s+de)?\s+{_SHARE}$",
    )
]  # "20 % calcium chloride", "sodium chloride 10 %"
_SOLVENT = re.compile(
    r"\s+(?:in water|dans l['’]eau|brine|solution)$|^(?:brine of|saumure de)\s+", re.IGNORECASE
)
CRYSTALS = "So much does not dissolve at this temperature: crystals would form."
_PARTS = re.compile(r"\s*(?:;|,\s|\s(?:and|et)\s)\s*")


class StatedFluid(NamedTuple):
    """A fluid at a temperature and a pressure: a liquid where it condenses and lies below its boiling point,
    else a gas.
    """

    fluid: Fluid
    temperature: float
    pressure: float

    @classmethod
    def read(cls, given: Any) -> StatedFluid:
        """From ``"water at 20 °C"``, ``"air at 60 °C, 2 bar"``, or a fluid (or its name), its temperature
        and, if not 1 atm, its pressure.
        """
        if isinstance(given, str):
            words = _SOLUTION_WORDS.match(given) or _WORDS.match(given) or _STATE_ALONE.match(given)
            if words is None:
                raise _not_a_fluid(given)
            name, parts = words["name"], _PARTS.split(words["state"])
        elif isinstance(given, (tuple, list)) and given:
            name, parts = given[0], list(given[1:])
        else:
            raise _not_a_fluid(given)
        if not 1 <= len(parts) <= 2:
            raise _not_a_fluid(given)
        solution = None if isinstance(name, Fluid) else _shared(str(name))
        known = name if isinstance(name, Fluid) else _solution(*solution) if solution else _pure(str(name))
        where = " " + _("of the 'fluid'")
        T = float(convert(parts[0], Parameter("temperature", KINDS["Temperature"]), where))
        if solution is not None:
            _saturated(*solution, T)
        P = (
            float(convert(parts[1], Parameter("pressure", KINDS["Pressure"]), where))
            if len(parts) > 1
            else STANDARD_ATMOSPHERE
        )
        return cls(known, T, P)

    @property
    def is_liquid(self) -> bool:
        """Whether it is a liquid in this state."""
        if isinstance(self.fluid.vapor_pressure, Missing):  # a permanent gas, or an oil that does not boil
            return not isinstance(self.fluid.liquid_density, Missing)
        return self.temperature < float(self.fluid.boiling_temperature(self.pressure))

    @property
    def label(self) -> str:
        """What a note says of it."""
        state = [show(self.temperature, KINDS["Temperature"])]
        if self.pressure != STANDARD_ATMOSPHERE:
            state.append(show(self.pressure, KINDS["Pressure"]))
        return _("{name} at {state}, {phase}").format(
            name=self.fluid.label, state=", ".join(state), phase=_("liquid") if self.is_liquid else _("gas")
        )

    def density(self) -> Any:
        """kg/m³."""
        return (
            self.fluid.liquid_density(self.temperature)
            if self.is_liquid
            else self.fluid.vapor_density(self.temperature, self.pressure)
        )

    def viscosity(self) -> Any:
        """Pa s."""
        return self._of("viscosity")

    def kinematic_viscosity(self) -> Any:
        """m²/s."""
        return self.viscosity() / self.density()

    def conductivity(self) -> Any:
        """W/(m K)."""
        return self._of("conductivity")

    def heat_capacity(self) -> Any:
        """J/(kg K)."""
        return self._of("heat_capacity")

    def surface_tension(self) -> Any:
        """N/m."""
        return self.fluid.surface_tension(self.temperature)

    def _of(self, name: str) -> Any:
        return getattr(self.fluid, f"{'liquid' if self.is_liquid else 'vapor'}_{name}")(self.temperature)


_ALWAYS: dict[str, Callable[[StatedFluid], Any]] = {
    "fluid_density": StatedFluid.density,
    "dynamic_viscosity": StatedFluid.viscosity,
    "kinematic_viscosity": StatedFluid.kinematic_viscosity,
}
_OF_LIQUID = {"liquid_density": StatedFluid.density, "surface_tension": StatedFluid.surface_tension}
_OF_GAS = {"gas_density": StatedFluid.density}
_BESIDE = {
    "thermal_conductivity": StatedFluid.conductivity,
    "specific_heat_capacity": StatedFluid.heat_capacity,
}


def asked_of_a_fluid(parameters: Iterable[Parameter]) -> tuple[str, ...]:
    """Names of the inputs that a fluid can give; conductivity and heat capacity only beside its density or
    viscosity, else they are a solid's.
    """
    names = [p.name for p in parameters]
    own = [name for name in names if name in {**_ALWAYS, **_OF_LIQUID, **_OF_GAS}]
    return tuple(name for name in names if name in own or (own and name in _BESIDE))


def properties(
    given: Any, owner: str, parameters: Iterable[Parameter], typed: Mapping[str, Any]
) -> tuple[dict[str, Any], str]:
    """Values of the inputs that a stated fluid gives, those ``typed`` left as they are, and what a note says
    of the fluid.
    """
    names = asked_of_a_fluid(parameters)
    if not names:
        raise InputError(
            _("{owner} asks for no property of a fluid: leave 'fluid' out.").format(owner=owner), name="fluid"
        )
    try:
        state = StatedFluid.read(given)
    except GranumError as problem:  # whatever it lacks, it is the text of this input
        raise InputError(problem.message, **{**problem.details, "name": "fluid"}) from None
    ways = _ALWAYS | _BESIDE | (_OF_LIQUID if state.is_liquid else _OF_GAS)
    return {
        name: float(ways[name](state)) for name in names if name in ways and name not in typed
    }, state.label


def _pure(name: str) -> Fluid:
    library = session()
    if library.called(name, "fluid") is None and (solute := library.called(name, "solute")):
        raise InputError(
            _(
                "'{name}' is a solute: say its share of the solution too, such as '10 % {solute} at 20 °C'."
            ).format(name=name, solute=library.label(solute)),
            name="fluid",
        )
    return library.fluid(name)


def _shared(name: str) -> tuple[SoluteSystem, float] | None:
    """The solute of a solution, and its share, ``"20 % calcium chloride"``; None of other words."""
    found = next(filter(None, (pattern.match(name) for pattern in _SOLUTIONS)), None)
    if found is None:
        return None
    system = session().solute(_SOLVENT.sub("", found["solute"].strip()))
    share = float(
        convert(
            found["share"],
            Parameter("solute_mass_fraction", KINDS["MassFraction"]),
            " " + _("of the 'fluid'"),
        )
    )
    if share >= 1.0:
        raise InputError(
            _("A solution of {share} has no solvent: its share of solute must be below 100 %.").format(
                share=found["share"]
            ),
            name="fluid",
        )
    return system, share


def _saturated(system: SoluteSystem, share: float, T: float) -> None:
    """Record more than dissolves at a temperature."""
    alone = float(system.value(T))
    most = alone / (1.0 + alone)
    owner = Owner.of_property(system.name, "solubility", system.french)
    flags.record(
        flags.EXTRAPOLATED, share > most, share, "solute_mass_fraction", owner, 0.0, most, reason=CRYSTALS
    )


def _solution(system: SoluteSystem, share: float) -> Fluid:
    """A solution as a fluid; its vapor is that of its water, at a lowered pressure."""
    solvent = system.solvent
    ratio = share / (1.0 - share)
    laws = {
        "liquid_density": system.density_law,
        "liquid_viscosity": system.viscosity_law,
        "liquid_heat_capacity": system.heat_capacity_law,
    }
    made: dict[str, Any] = {
        word: law.missing
        if getattr(law, "is_missing", False)
        else _of_solution(system, solvent, word, law, share)
        for word, law in laws.items()
    }
    what = f"{system.name} {100.0 * share:.4g} %"
    french = f"{system.french or system.name} {100.0 * share:.4g} %".replace(".", ",")
    for word in ("liquid_conductivity", "surface_tension"):
        made[word] = Missing(Owner.of_property(what, word.replace("_", " "), french))
    made["vapor_pressure"] = _of_solution(
        system,
        solvent,
        "vapor_pressure",
        lambda T, _w: solvent.vapor_pressure.value(T) * system.activity_law(T, ratio),
        share,
    )
    return dataclasses.replace(solvent, name=what, french=french, formula=system.formula, **made)


def _of_solution(system: Any, solvent: Fluid, word: str, law: Any, share: float) -> Correlation:
    """A property of a solution at one share of solute; its law tells its own range."""
    limits = getattr(solvent, word)
    return Correlation(
        lambda T: law(T, share),
        None,
        1.0,
        limits.low,
        limits.high,
        Owner.of_property(system.name, word.replace("_", " "), system.french),
        getattr(getattr(law, "form", None), "source", "") or "",
    )


def _not_a_fluid(given: Any) -> InputError:
    return InputError(
        _(
            "'fluid' = '{value}' is not understood: write it with its temperature, such as 'water at 20 °C'."
        ).format(value=given),
        name="fluid",
    )
