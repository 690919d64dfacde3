"""A mixture from material names: what a case file's ``[mixture]`` table means.

A liquid is a fluid of the library or a solute dissolved in one of them, in the first that it is known in; a
solid is a solid of the library, a crystal of one of those solutes when it is one of its branches or of
another form of it (a polymorph), or, as ``NAME in crystals``, what crystals have taken up of a liquid; a gas
is a fluid of the library. Enthalpies are zero for the liquid solvent, dissolved solutes and permanent gases
at 0 °C, so that vapor carries its heat of vaporization, and a crystal lies lower by its heat of
crystallization, or by that of sublimation where its vapor is among the gases.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import jax.numpy as jnp
import numpy as np

from granum.core.compiling import once
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _, quoted
from granum.materials.brines import SOLVENT, salts_of_ions
from granum.materials.correlation import Correlation
from granum.materials.double_salts import DOUBLE_SALTS, DoubleSalt, in_salts
from granum.materials.fluids import Fluid
from granum.materials.formulas.activity import WATER
from granum.materials.ions import Ions, ions_of
from granum.materials.library import Library, session, stated
from granum.materials.mixing_heats import ElectrolyteMixing, IonMixing
from granum.materials.solids import Solid
from granum.materials.solutes import SoluteSystem
from granum.streams.exchange import by_ions, reciprocal
from granum.streams.mixture import AIR, STEAM, Mixture, Species, carrier_of

COLDEST, HOTTEST = 263.15, 423.15  # K, over which condensed-phase properties are taken as polynomials
HOTTEST_GAS = 873.15
DENSITY_DEGREE = 4  # of a liquid: water within 0.1 kg/m³, as cells and fat globules differ from it by tens
ROOM = 298.15  # K, at which heats of sublimation are taken
CONDENSED = (COLDEST, HOTTEST)


def mixture_of(
    liquids: Sequence[str],
    solids: Sequence[str],
    gases: Sequence[str],
    size_edges: Iterable[float],
    *,
    axes: tuple[tuple[str, tuple[float, ...]], ...] = (),
    own: Iterable[str | Path | Mapping[str, Any]] = (),
) -> Mixture:
    """The mixture of named materials.

    Parameters
    ----------
    liquids: solvent first, then dissolved solutes (in any of the liquids) or further liquids.
    solids: crystals and other solids.
    gases: carrier gases and vapors, in any order; viscosity and conductivity are those of the carrier, of
        steam those of the vapor.
    size_edges: class boundaries, m.
    axes: further axes of the solid.
    own: TOML files with the user's own materials, or the tables of such files.
    """
    gases = tuple(gases)
    carrier = carrier_of(gases, liquids[0] if liquids else None) or next(iter(gases), None)
    vapor = (liquids[0], gases.index(liquids[0])) if liquids and liquids[0] in gases else None
    known = session().with_own(own)
    systems = {
        name: system for name in liquids[1:] if (system := solute_system(known, name, liquids)) is not None
    }
    systems, together = _mixed(known, systems)
    dissolved = tuple(
        _dissolved(name, systems[name]) if name in systems else _liquid(known, name) for name in liquids
    )
    crystallizing = _crystallizing(known, systems)
    made = [
        _crystal(name, crystallizing)
        or _double(known, name, systems)
        or _taken_up(name, dissolved)
        or _sublimed(known, name, gases)
        or _inert(known, name, systems)
        for name in solids
    ]
    formulas = {name: system.formula for name, system in systems.items()}
    made, dissolved = by_ions(known, made, dissolved, formulas)
    return Mixture(
        solids=made,
        liquids=dissolved,
        gases=tuple(_gas(known, name) for name in gases),
        size_edges=tuple(float(e) for e in np.asarray(list(size_edges))),
        axes=axes,
        liquid_viscosity=SolutionViscosity(known, tuple(liquids), tuple(systems)) if liquids else None,
        gas_viscosity=GasProperty(known, carrier, vapor, "vapor_viscosity") if carrier else None,
        gas_conductivity=GasProperty(known, carrier, vapor, "vapor_conductivity") if carrier else None,
        materials=known,
        mixing=Mixing.of(systems, liquids, together),
    )


@dataclass(frozen=True)
class Mixing:
    """Heats of mixing of the solutes that have one, each with all there is of its solvent.

    ``pairs``: the law, and the places of solute and solvent among the liquids; ``ions``: the law of several
    salts, their places and that of the water.
    """

    pairs: tuple[tuple[Any, int, int], ...]
    ions: tuple[IonMixing, tuple[int, ...], int] | None = None

    @classmethod
    def of(
        cls, systems: Mapping[str, SoluteSystem], liquids: Sequence[str], together: IonMixing | None
    ) -> Mixing | None:
        """Of a mixture; None where all enthalpies add up."""
        places = {name: i for i, name in enumerate(liquids)}
        salts = _salts(systems) if together is not None else {}
        pairs = tuple(
            (system.mixing_law, places[name], places[system.solvent.name])
            for name, system in systems.items()
            if system.mixing_law is not None and name not in salts
        )
        ions = None if together is None else (together, tuple(places[n] for n in salts), places[SOLVENT])
        return cls(pairs, ions) if pairs or ions else None

    def __call__(self, flows: Any, temperature: Any) -> Any:
        held = sum(law(temperature, flows[solute], flows[solvent]) for law, solute, solvent in self.pairs)
        if self.ions is None:
            return held
        law, salts, water = self.ions
        return held + law(temperature, [flows[i] for i in salts], flows[water])

    @property
    def solutes(self) -> tuple[int, ...]:
        """The places of those that have one."""
        return tuple(solute for _law, solute, _solvent in self.pairs) + (self.ions[1] if self.ions else ())

    def heard(self, flows: Any, temperature: Any) -> None:
        """Flag liquors outside the data of the laws."""
        for law, solute, solvent in self.pairs:
            law.heard(temperature, flows[solute], flows[solvent])
        if self.ions is not None:
            law, salts, water = self.ions
            law.heard(temperature, [flows[i] for i in salts], flows[water])


def _salts(systems: Mapping[str, SoluteSystem]) -> dict[str, Ions]:
    """The solutes that are salts, with their ions."""
    found = {name: ions_of(system.formula) for name, system in systems.items()}
    return {name: ions for name, ions in found.items() if ions is not None}


def _mixed(
    known: Library, systems: dict[str, SoluteSystem]
) -> tuple[dict[str, SoluteSystem], IonMixing | None]:
    """The solutes, and of several salts the heat of mixing that they have together; where it is not known,
    they are without that which each has alone.
    """
    salts = _salts(systems)
    if len(salts) < 2:
        return systems, None
    together = None
    if all(isinstance(systems[name].mixing_law, ElectrolyteMixing) for name in salts):
        formulas = {name: systems[name].formula for name in salts}
        laws = {
            (ions.cation, ions.anion): system.mixing_law
            for system in (*salts_of_ions(known), *(systems[name] for name in salts))
            if isinstance(system.mixing_law, ElectrolyteMixing)
            and (ions := ions_of(system.formula)) is not None
        }
        together = IonMixing.of(salts, laws, reciprocal(list(salts), formulas))
    if together is not None:
        return systems, together
    return {
        name: replace(system, mixing_law=None)
        if system.mixing_law is not None and not system.mixing_law.others
        else system
        for name, system in systems.items()
    }, None


def solute_system(known: Library, name: str, solvents: Sequence[str]) -> SoluteSystem | None:
    """The solute of that name in the first of the solvents that the library knows it in; None where it is a
    liquid of its own.
    """
    for solvent in solvents:
        for candidate in (name, f"{name} in {solvent}"):
            if candidate in known.names("solute") and known.solute(candidate).solvent.name == solvent:
                return known.solute(candidate)
    return None


def activity_laws(mixture: Mixture) -> list[Any]:
    """The law of the activity of the solvent for each further liquid of a mixture; None where the library has
    none.
    """
    solvent, *others = (s.name for s in mixture.liquids)
    systems = [solute_system(mixture.materials, name, (solvent,)) for name in others]
    return [s.activity_law if s and not s.activity_law.is_missing else None for s in systems]


def _polynomial(law: Any, hottest: float = HOTTEST, degree: int = 2) -> tuple[float, ...]:
    if isinstance(law, Correlation):
        low, high = max(law.low, COLDEST), min(law.high, hottest)
        return law.polynomial(low, high, degree) if high > low else (float(law.value(jnp.asarray(law.low))),)
    return law()  # a property the library lacks says so


def _liquid(known: Library, name: str) -> Species:
    if name not in known.names("fluid"):
        dissolves = [n for n in known.names("solute") if n == name or n.startswith(f"{name} in ")]
        if dissolves:
            others = dict.fromkeys(known.label(known.solute(n).solvent.name) for n in dissolves)
            raise InputError(
                _(
                    "'{name}' is known here dissolved in {solvents} only: name one of these before it among "
                    'the liquids, or describe another solution in a table [solute."{name} in SOLVENT"].'
                ).format(name=name, solvents=", ".join(others)),
                name=name,
            )
        there = (*known.names("fluid"), *known.names("solute"))
        meant = known.called(name, "solute", "fluid")
        solid = known.called(name, "solid") if meant is None else None
        if solid is not None:
            raise InputError(
                _("Liquid '{name}' is a solid here: give it among the solids, as '{solid}'.").format(
                    name=name, solid=solid
                ),
                name=name,
            )
        raise unknown_name(
            _("Liquid"),
            name,
            there,
            meant=meant,
            strict=True,
            otherwise="" if meant else stated("fluid", name),
        )
    f = known.fluid(name)
    return Species(
        f.name,
        ((f.name, 1.0),),
        _polynomial(f.liquid_density, degree=DENSITY_DEGREE),
        _polynomial(f.liquid_heat_capacity),
        0.0,
        float(f.molar_mass),
        CONDENSED,
    )


def _dissolved(name: str, system: SoluteSystem) -> Species:
    """Apparent density of the solute in the solution saturated at 25 °C; apparent heat capacity from the
    system.
    """
    T = np.linspace(280.0, 350.0, 8)
    densities, heat_capacity = once(partial(_apparent, system), T)
    density = np.polynomial.Polynomial.fit(T - ZERO_CELSIUS, np.asarray(densities), 1).convert().coef
    return Species(
        name,
        ((name, 1.0),),
        tuple(float(c) for c in density),
        (float(heat_capacity),),
        0.0,
        float(system.molar_mass),
        CONDENSED,
    )


def _apparent(system: SoluteSystem, T: Any) -> tuple[Any, Any]:
    ratio = system.solubility(298.15)
    whole = (1.0 + ratio) / system.solution_density(T, ratio)  # volume per kg of solvent
    return ratio / (whole - 1.0 / system.solvent.liquid_density(T)), system.solute_heat_capacity


def _crystallizing(
    known: Library, systems: Mapping[str, SoluteSystem]
) -> list[tuple[str, SoluteSystem, SoluteSystem]]:
    """Each dissolved solute and its system with those whose crystals dissolve to it: itself, then its other
    crystal forms.
    """
    dissolved = {system.name for system in systems.values()}
    entries = known.entries("solute").items() if dissolved else ()
    forms = [known.solute(key) for key, entry in entries if entry.form_of in dissolved]
    others = [
        (name, system, form)
        for name, system in systems.items()
        for form in forms
        if form.form_of == system.name and form.solvent.name == system.solvent.name
    ]
    return [*((name, system, system) for name, system in systems.items()), *others]


def _crystal(name: str, crystallizing: list[tuple[str, SoluteSystem, SoluteSystem]]) -> Species | None:
    for solute_name, dissolved, system in crystallizing:
        for branch in system.branches:
            if branch.crystal.name == name:
                anhydrous = 1.0 / float(branch.hydrate_ratio)
                parts = ((solute_name, anhydrous), (system.solvent.name, 1.0 - anhydrous))
                return Species(
                    name,
                    tuple(part for part in parts if part[1] > 0),
                    _polynomial(branch.crystal.density),
                    _polynomial(branch.crystal.heat_capacity),
                    float(once(partial(_crystal_enthalpy, system, name), ZERO_CELSIUS))
                    + anhydrous * float(once(partial(_apart, dissolved, system), ROOM)),
                    float(branch.crystal.molar_mass),
                    CONDENSED,
                )
    return None


def _apart(dissolved: SoluteSystem, system: SoluteSystem, T: Any) -> Any:
    """What the enthalpy of the dissolved solute is above that in the system of another crystal form, which
    may have another heat capacity.
    """
    return dissolved.solute_enthalpy(T) - system.solute_enthalpy(T)


def _double(known: Library, name: str, systems: Mapping[str, SoluteSystem]) -> Species | None:
    """A crystal of two dissolved salts."""
    double = DOUBLE_SALTS.get(known.called(name, "solid") or name)
    made = {n: p for n, s in systems.items() if s.solvent.name == SOLVENT and (p := ions_of(s.formula))}
    if double is None:
        return None
    parts = in_salts(tuple(made.values()), double.ions)
    if parts is None:
        raise InputError(
            _("'{name}' is a double salt: give the two salts that it is made of among the liquids.").format(
                name=name
            ),
            name=name,
        )
    masses = {n: x * p.anhydrous_mass for (n, p), x in zip(made.items(), parts, strict=True) if x > 0.0}
    masses[SOLVENT] = WATER * double.water
    whole, solid = sum(masses.values()), known.solid(name)
    return Species(
        name,
        tuple((n, mass / whole) for n, mass in masses.items() if mass > 0.0),
        _polynomial(solid.density),
        _polynomial(solid.heat_capacity),
        float(once(partial(_double_enthalpy, double, solid, masses, systems), ROOM)) / whole,
        whole,
        CONDENSED,
    )


def _double_enthalpy(
    double: DoubleSalt, solid: Solid, masses: dict[str, float], systems: Mapping[str, SoluteSystem], T: Any
) -> Any:
    """Of a mole of a double salt, less that by its heat capacity from 0 °C on. Its heat of solution, one of
    infinite dilution, is brought to saturation as those of the crystals of its salts are, where these are
    without a heat of mixing.
    """
    solvent = next(iter(systems.values())).solvent
    parts = {n: m for n, m in masses.items() if n in systems}
    dissolved = sum(m * systems[n].solute_enthalpy(T) for n, m in parts.items())
    water = masses[SOLVENT] * solvent.liquid_enthalpy(T)
    heat = double.heat_of_solution + sum(m * _strong(systems[n], T) for n, m in parts.items())
    return dissolved + water - heat - sum(masses.values()) * solid.enthalpy(T)


def _strong(system: SoluteSystem, T: Any) -> Any:
    """What the crystal of a salt that is stable in a room takes up in its saturated solution over that in
    much water, J/kg; nothing where the solution holds it.
    """
    if system.mixing_law is not None:
        return 0.0
    stable = sum(b.stable_from <= ROOM for b in system.branches[1:])
    return system.heat_of_crystallization(T) - system.branches[stable].heat_dilute


def taken_up_name(liquid: str) -> str:
    """What a liquid species is called once crystals have taken it up."""
    return f"{liquid} in crystals"


def _taken_up(name: str, liquids: Iterable[Species]) -> Species | None:
    """A liquid species in the lattice or in inclusions of crystals: as it is in the liquor, but carried by
    the solid.
    """
    return next((replace(s, name=name) for s in liquids if taken_up_name(s.name) == name), None)


def _crystal_enthalpy(system: SoluteSystem, name: str, T: Any) -> Any:
    return system.crystal_enthalpy(T, name)


def _sublimed(known: Library, name: str, gases: Iterable[str]) -> Species | None:
    """A solid whose vapor is among the gases: it lies lower by its heat of sublimation."""
    if name not in known.names("solid") or name not in gases or name not in known.names("fluid"):
        return None
    if not known.solid(name).sublimes:
        return None
    lower = float(once(partial(_below_vapor, known.solid(name), known.fluid(name)), ROOM))
    return replace(_inert(known, name, {}), reference_enthalpy=lower)


def _below_vapor(solid: Solid, vapor: Fluid, T: Any) -> Any:
    return vapor.vapor_enthalpy(T) - solid.heat_of_sublimation(T) - solid.enthalpy(T)


def _inert(known: Library, name: str, systems: Mapping[str, SoluteSystem]) -> Species:
    if name in systems and known.called(name, "solid") is None:
        crystals = " ".join(f"{quoted(b.crystal.name)}," for b in systems[name].branches).rstrip(",")
        raise InputError(
            _("'{name}' is dissolved; what crystallizes from it is {crystals}: give one of these.").format(
                name=name, crystals=crystals
            ),
            name=name,
        )
    s = known.solid(name)
    return Species(
        s.name,
        ((s.name, 1.0),),
        _polynomial(s.density),
        _polynomial(s.heat_capacity),
        0.0,
        float(s.molar_mass),
        CONDENSED,
    )


def _gas(known: Library, name: str) -> Species:
    f = known.fluid(name)
    heat = float(once(f.vapor_enthalpy, ZERO_CELSIUS))
    made_of = ((f.name, 1.0),)
    # counted as what it burns to, less the air that this takes, so that burning conserves components
    if f.combustion is not None:
        water = f.combustion.water
        made_of, heat = ((AIR, 1.0 - water), ("water", water)), heat + _heat_held(known, f)
    return Species(
        f.name,
        made_of,
        (),
        _polynomial(f.vapor_heat_capacity, HOTTEST_GAS),
        heat,
        float(f.molar_mass),
        (COLDEST, HOTTEST_GAS),
    )


def _heat_held(known: Library, fuel: Fluid) -> float:
    """What a fuel's enthalpy lies above that of the gas it burns to at one temperature, which the heating
    value is for 25 °C, J/kg.
    """
    assert fuel.combustion is not None
    flue = known.fluid(AIR), known.fluid("water")
    return float(once(partial(_above_flue, fuel, *flue), 298.15))


def _above_flue(fuel: Fluid, air: Fluid, water: Fluid, T: Any) -> Any:
    burns = fuel.combustion
    assert burns is not None
    flue = (1.0 - burns.water) * air.vapor_enthalpy(T) + burns.water * water.vapor_enthalpy(T)
    return burns.lower_heating_value + flue - fuel.vapor_enthalpy(T)


@dataclass(frozen=True)
class SolutionViscosity:
    """Viscosity of the liquid: the solvent's, raised by each solute as in its binary solution at its own
    ratio to all that is solvent.
    """

    materials: Library
    liquids: tuple[str, ...]
    solutes: tuple[str, ...]

    def __call__(self, mass_fractions: Any, temperature: Any) -> Any:
        pure = self.materials.fluid(self.liquids[0]).liquid_viscosity(temperature)
        solvents = [i for i, name in enumerate(self.liquids) if name not in self.solutes]
        solvent = jnp.maximum(sum(mass_fractions[i] for i in solvents), 1e-12)
        viscosity = pure
        for i, name in enumerate(self.liquids):
            if i == 0:
                continue
            if name in self.solutes:
                system = solute_system(self.materials, name, self.liquids)
                if system is None:
                    raise InputError(
                        _("'{name}' is not a solute in '{solvent}'.").format(
                            name=name, solvent=self.liquids[0]
                        )
                    )
                alone = system.solvent.liquid_viscosity(temperature)
                viscosity = (
                    viscosity * system.solution_viscosity(temperature, mass_fractions[i] / solvent) / alone
                )
            else:  # a second liquid: logarithmic mixing by mass (Arrhenius), a simplification
                viscosity = (
                    viscosity
                    * (self.materials.fluid(name).liquid_viscosity(temperature) / pure) ** mass_fractions[i]
                )
        return viscosity


@dataclass(frozen=True)
class GasProperty:
    """A transport property of the gas, taken as that of the carrier; of steam, that of the vapor.

    ``vapor``: name and place among the gases; none where the liquid has no vapor.
    """

    materials: Library
    carrier: str
    vapor: tuple[str, int] | None
    name: str

    def __call__(self, mass_fractions: Any, temperature: Any) -> Any:
        carrier = self._of(self.carrier, temperature)
        if self.vapor is None or self.vapor[0] == self.carrier:
            return carrier
        name, place = self.vapor
        return jnp.where(mass_fractions[place] > STEAM, self._of(name, temperature), carrier)

    def _of(self, fluid: str, temperature: Any) -> Any:
        return getattr(self.materials.fluid(fluid), self.name)(temperature)
