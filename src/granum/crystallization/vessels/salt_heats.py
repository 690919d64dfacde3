"""Heats of dilution and of solution of salts in water: slopes of Pitzer's equations with temperature."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS, MassRatio, MolarEnergy, SpecificEnergy, Temperature
from granum.core.units import show
from granum.crystallization.vessels.common_ion import SATURATED
from granum.materials.activities import ElectrolyteActivity
from granum.materials.brines import TRACE, Brine, Forms, brine
from granum.materials.formulas.activity import ROOM, WATER
from granum.materials.library import session
from granum.materials.solutes import SoluteSystem

# Those whose law has the slope with temperature that calorimetry gives (silvester1978), and from which
# temperature (K): in the cold that of sodium sulfate bends, and would give its decahydrate 99 kJ/mol at 2 °C.
# The laws of calcium chloride (beside other salts) and potassium sulfate follow solubilities and lie far off;
# others are of 25 °C.
KNOWN = {
    "sodium chloride": 273.15,
    "potassium chloride": 273.15,
    "magnesium chloride": 273.15,
    "sodium sulfate": 283.15,
    "magnesium sulfate": 273.15,
}
# J per mol of salt at infinite dilution and 25 °C, differences of enthalpies of formation of wagman1982
# (recalled): that of the library is often one in 200 to 400 mol of water at 18 °C
INFINITE = {
    "sodium chloride": 3880.0,
    "potassium chloride": 17220.0,
    "sodium sulfate decahydrate": 79450.0,
    "magnesium chloride hexahydrate": -17130.0,
}
INSIDE = 1e-6  # K, as a law that is held at an end of its range has no slope there


class DilutionHeat(NamedTuple):
    """What mixing a solution with water, or taking water from it, does to its enthalpy."""

    relative_molar_enthalpy: MolarEnergy
    relative_molar_enthalpy_after: MolarEnergy
    heat_of_dilution: SpecificEnergy
    heat_of_dilution_per_solution: SpecificEnergy


class SolutionHeat(NamedTuple):
    """Heats of solution of a crystal."""

    crystal: str
    enthalpy_of_dissolution_dilute: MolarEnergy
    enthalpy_of_dissolution: MolarEnergy
    enthalpy_of_dissolution_differential: MolarEnergy
    heat_of_crystallization: SpecificEnergy
    heat_of_crystallization_balance: SpecificEnergy


def _refused(names: list[str]) -> ApplicabilityError:
    library = session()
    return ApplicabilityError(
        _(
            "The heat of dilution of {salts} is not known here: that takes activities whose change with "
            "temperature agrees with calorimetry. Known are {known}."
        ).format(
            salts=", ".join(library.label(n) for n in names),
            known=", ".join(library.label(n) for n in KNOWN),
        )
    )


def _brine(names: list[str], temperature: float) -> Brine:
    """The brine of salts whose heats are known at a temperature."""
    library = session()
    called = [library.called(n, "solute") or n for n in names]
    if len(set(called)) < len(called):
        raise InputError(_("'first_salt' and 'second_salt' are the same salt: name two."), name="second_salt")
    odd = [n for n in called if n not in KNOWN]
    found = brine(called) if not odd else None
    odd += [s.name for s in found.salts if s.name not in KNOWN] if found else []
    if found is None or odd:
        raise _refused(odd)
    low, high = found.limits
    for system in found.salts:
        law = system.activity_law
        assert isinstance(law, ElectrolyteActivity)
        low, high = max(low, law.coldest, KNOWN[system.name]), min(high, law.hottest)
    if not low <= temperature <= high:
        raise ApplicabilityError(
            _("The heats of this solution are known from {low} to {high}, not at {temperature}.").format(
                **{
                    key: show(value, KINDS["Temperature"])
                    for key, value in (("low", low), ("high", high), ("temperature", temperature))
                }
            )
        )
    return found


def _excess(salts: Brine, temperature: float, ions: Any) -> Any:
    """J over infinite dilution, for a kilogram of water."""
    low, high = salts.limits
    T = jnp.clip(jnp.asarray(temperature, dtype=float), low + INSIDE, high - INSIDE)
    return salts.excess_enthalpy(T, ions)


@procedure(
    source="silvester1978; moller1988; greenberg1989; pabalan1987",
    title="Heat of dilution of a brine (Pitzer)",
    typical={
        "temperature": (273.15, 373.15),
        "solute_per_solvent": (0.05, 0.35),
        "solute_per_solvent_after": (0.0, 0.05),
        "solute_per_solvent_second": (0.0, 0.0),
    },
)
def heat_of_dilution(
    temperature: Temperature,
    solute_per_solvent: MassRatio,
    solute_per_solvent_after: MassRatio,
    solute_per_solvent_second: MassRatio = 0.0,
    first_salt: str = "sodium chloride",
    second_salt: str = "",
) -> DilutionHeat:
    """Heat that a brine of one or two salts takes up when water is added to it, or taken from it as a liquid,
    at one temperature; less than zero where it is given off.

    The enthalpy over that at infinite dilution is the slope of the excess Gibbs energy over RT with
    temperature. A second salt is diluted in the same proportion; molar values are per mole of both, masses of
    both without water. Sodium, potassium and magnesium chloride, magnesium sulfate, from 10 °C on sodium
    sulfate: with these the slopes agree with calorimetry at 25 °C, within 210 J/mol for the first two, within
    an eighth for the others; no measured heats of mixtures were compared.

    The energy balances of units count this heat, that of several salts by the same slopes but for what like
    ions do to each other, which they take as the same at all temperatures; calcium chloride's too.
    Saturated salt brine that is thinned takes up 34 kJ per kg of salt, 9 per kg of brine; with magnesium
    chloride it is 210 per kg of salt, given off.

    >>> out = heat_of_dilution("25 degC", 0.35, 0.005)
    >>> round(float(out.heat_of_dilution) / 1e3)
    39
    """
    first, after = float(solute_per_solvent), float(solute_per_solvent_after)
    second = float(solute_per_solvent_second) if second_salt else 0.0
    if second and not first:
        raise InputError(
            _("A second salt is diluted in proportion to the first: give more than none of this."),
            name="solute_per_solvent",
        )
    names = [first_salt, *([second_salt] if second_salt else [])]
    salts = _brine(names, float(temperature))
    parts = np.array([1.0, second / first if first else 0.0])[: len(names)]
    moles = parts / salts.molar_masses[: len(names)]
    each = jnp.asarray(moles @ salts.ions_per_salt[: len(names)])

    def apparent(ratio: float) -> float:
        salts.heard(temperature, ratio * each)
        return float(_excess(salts, float(temperature), ratio * each)) / ratio / moles.sum() if ratio else 0.0

    before, diluted = apparent(first), apparent(after)
    heat, dissolved = (diluted - before) * moles.sum() / parts.sum(), first * parts.sum()
    return DilutionHeat(before, diluted, heat, heat * dissolved / (1.0 + dissolved))


def _dilute(system: SoluteSystem, form: Forms, salts: Brine, temperature: float) -> float:
    """Enthalpy of dissolution of a crystal at infinite dilution, J/mol: that at 25 °C and, from there, heat
    capacities of the library, whose apparent one is that of the solution saturated at 25 °C.
    """
    branch, M = form.branch, float(system.molar_mass)
    assert branch is not None
    strong = system.value(ROOM) / M

    def apart(T: float) -> Any:
        bound = branch.solvent_ratio * system.solvent.liquid_enthalpy(T)
        held = branch.hydrate_ratio * branch.crystal.enthalpy(T)
        part = jnp.asarray(salts.ions_per_salt[0])
        return M * (system.solute_enthalpy(T) + bound - held) - _excess(salts, T, strong * part) / strong

    return INFINITE[form.name] + float(apart(temperature) - apart(ROOM))


@procedure(
    source="silvester1978; wagman1982; mullin2001, ch. 2",
    title="Heat of solution and of crystallization of a salt (Pitzer)",
    typical={"temperature": (283.15, 303.15), "solute_per_solvent": (0.01, 0.3)},
)
def heat_of_solution(
    temperature: Temperature,
    solute_per_solvent: MassRatio,
    solute_per_solvent_second: MassRatio = 0.0,
    first_salt: str = "sodium chloride",
    second_salt: str = "",
) -> SolutionHeat:
    """Heat that the stable crystal of a salt takes up on dissolving: at infinite dilution, until the solution
    holds so much of it, and a little more in this solution; and what it gives off as it crystallizes from the
    saturated one, beside what the energy balances of units take.

    A second salt is in the water before. The enthalpy at infinite dilution is calorimetric at 25 °C and has
    the heat capacities of crystal and solution from there; what concentration adds is the slope of Pitzer's
    equations with temperature. A hydrate brings its water. Sodium chloride, potassium chloride, sodium
    sulfate decahydrate and magnesium chloride hexahydrate.

    Energy balances of units take that of the saturated solution at 25 °C, and from there the heat of dilution
    and the heat capacities of crystal and solution, so that they agree for one salt; the last output is that
    of the salt alone. Beside a second salt the balances count the heat of dilution of both.

    >>> out = heat_of_solution("25 degC", 0.35, first_salt="potassium chloride")
    >>> round(float(out.enthalpy_of_dissolution_dilute) / 1e3, 2)
    17.22
    """
    names = [first_salt, *([second_salt] if second_salt else [])]
    salts, T = _brine(names, float(temperature)), jnp.asarray(temperature, dtype=float)
    system = salts.salts[0]
    known = [(k, c) for k, c in enumerate(salts.crystals) if c.salt == 0 and c.branch is not None]
    where = [b.stable_from for b in system.branches]
    stable = system.branches[max(int(np.searchsorted(where, float(T), side="right")) - 1, 0)].crystal.name
    place, form = next((k, c) for k, c in known if c.name == stable)
    if stable not in INFINITE:
        raise ApplicabilityError(
            _(
                "The heat of solution of {crystal} at infinite dilution is not known here; known are {known}."
            ).format(crystal=session().label(stable), known=", ".join(session().label(n) for n in INFINITE))
        )
    part, M = jnp.asarray(form.ions, dtype=float), float(system.molar_mass)
    others = jnp.zeros(len(part))
    if second_salt:
        there = float(solute_per_solvent_second) / salts.molar_masses[1]
        others = there * jnp.asarray(salts.ions_per_salt[1])
    m = float(solute_per_solvent) / M
    left = 1.0 - WATER * form.water * m
    if left <= 0.0:
        raise InputError(
            _("The crystal brings more water than that, without any other: give less than {most}.").format(
                most=show(M / (WATER * form.water), KINDS["MassRatio"])
            ),
            name="solute_per_solvent",
        )
    at_saturation = salts.solubility(T, others, place)
    strong = others + at_saturation * part
    if abs(float(salts.saturation(T, strong)[place])) > SATURATED:
        raise ApplicabilityError(
            _("Beside so much of {second} no solution is saturated with {first}.").format(
                first=session().label(stable), second=session().label(salts.salts[1].name)
            )
        )

    def over(ions: Any) -> Any:
        return _excess(salts, float(T), ions)

    def last(ions: Any) -> Any:
        value, slopes = jax.value_and_grad(over)(jnp.maximum(ions, TRACE))
        return part @ slopes - form.water * WATER * (ions @ slopes - value)

    dilute, whole = _dilute(system, form, salts, float(T)), others + m * part
    salts.heard(T, whole)
    salts.heard(T, strong)
    before = left * over(others / left)
    added = (over(whole) - before) / m if m else last(others)
    return SolutionHeat(
        stable,
        dilute,
        dilute + float(added),
        dilute + float(last(whole)),
        (dilute + float(last(strong))) / M,
        float(system.heat_of_crystallization(T)),
    )
