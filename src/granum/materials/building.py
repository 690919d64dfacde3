"""From the entries of a materials file to fluids, solids, salts and solute systems."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from math import inf, isnan, nan
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags, registry, units
from granum.core.compiling import once
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import InputError, unknown_name
from granum.core.formulas import Formula
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.unit_table import rows
from granum.core.units import show
from granum.materials import saturated_heats
from granum.materials.activities import (
    CausticActivity,
    ElectrolyteActivity,
    IdealActivity,
    NoActivity,
    SucroseActivity,
)
from granum.materials.correlation import Correlation, Missing, Owner, Tabulated
from granum.materials.fluids import Combustion, Flammability, Fluid
from granum.materials.formulas.activity import TERMS, usual_exponents
from granum.materials.formulas.solutions import (
    dynamic_viscosity_laliberte,
    liquid_density_laliberte,
    specific_heat_capacity_laliberte,
)
from granum.materials.mixing_heats import CausticMixing, ElectrolyteMixing
from granum.materials.salts import Salt
from granum.materials.schema import (
    ActivityEntry,
    BranchEntry,
    FluidEntry,
    PropertyEntry,
    SaltEntry,
    SolidEntry,
    SoluteEntry,
)
from granum.materials.solids import Solid
from granum.materials.solutes import (
    BASES,
    REFERENCE,
    AdditiveHeats,
    AdditiveVolumes,
    Branch,
    DiluteViscosity,
    LaliberteLaw,
    NoLaw,
    SoluteSystem,
    SyrupViscosity,
)

_KIND_OF = {
    "liquid_density": "Density",
    "liquid_viscosity": "DynamicViscosity",
    "liquid_heat_capacity": "HeatCapacity",
    "liquid_conductivity": "ThermalConductivity",
    "surface_tension": "SurfaceTension",
    "vapor_pressure": "Pressure",
    "sublimation_pressure": "Pressure",
    "heat_of_vaporization": "SpecificEnergy",
    "vapor_heat_capacity": "HeatCapacity",
    "vapor_viscosity": "DynamicViscosity",
    "vapor_conductivity": "ThermalConductivity",
    "density": "Density",
    "heat_capacity": "HeatCapacity",
    "conductivity": "ThermalConductivity",
}
CONDENSED = ("density", "heat_capacity", "liquid_density", "liquid_heat_capacity")
PLAUSIBLE = {
    "Density": (10.0, 3e4),
    "HeatCapacity": (50.0, 2e4),
}  # of solids and liquids, from foams to osmium
_BY_AMOUNT = {"kg/m^3": ("mol/m^3", 1), "J/kg": ("J/mol", -1), "J/(kg*K)": ("J/(mol*K)", -1)}
"""The unit of a property given per amount of substance, and the power of the molar mass that it lacks."""
_FLUID_PROPERTIES = tuple(name for name in _KIND_OF if name in FluidEntry.model_fields)
_SOLID_PROPERTIES = ("density", "heat_capacity", "conductivity", "sublimation_pressure")


@cache
def _forms() -> dict[str, Formula]:
    cards = registry.everything(("materials",))
    every = {
        key.removeprefix("materials."): thing for key, thing in cards.items() if isinstance(thing, Formula)
    }
    return {name.removeprefix("correlation_"): thing for name, thing in every.items()}


def _form(name: str, owner: str) -> Formula:
    found = _forms().get(name)
    if found is None:
        raise unknown_name(
            _("Form of correlation"),
            name,
            [n for n, f in _forms().items() if f.card.family == "correlation"],
            _("for {owner}").format(owner=owner),
        )
    return found


def _factor(unit: str, kind_name: str, molar_mass: float, owner: str) -> float:
    """From a printed unit to SI; amounts become masses with the molar mass."""
    if not unit:
        return 1.0
    target = KINDS[kind_name].unit
    for si, power in ((target, 0), _BY_AMOUNT.get(target, (target, 0))):
        row = rows().get((unit, si))
        if row is not None and not row.offset and not (power and isnan(molar_mass)):
            return row.factor * molar_mass**power if power else row.factor
    mass = units.registry().Quantity(molar_mass, "kg/mol")
    quantity = units.registry().Quantity(1.0, units.parse_unit(unit))
    for candidate in (quantity, quantity * mass, quantity / mass):
        if candidate.is_compatible_with(target):
            factor = float(candidate.to(target).magnitude)
            if factor == factor:
                return factor
    raise InputError(
        _("Unit '{unit}' does not fit {owner}, which is in {target}.").format(
            unit=unit, owner=owner, target=target
        )
    )


def _property(
    entry: PropertyEntry | None, name: str, of: tuple[str, str], molar_mass: float
) -> Correlation | Missing:
    """A property of a material, by its name and its French name."""
    whole = Owner.of_property(of[0], name.replace("_", " "), of[1])
    if entry is None:
        return Missing(whole)
    factor = _factor(entry.unit, _KIND_OF[name], molar_mass, whole.label)
    low, high = entry.range or (0.0, inf)
    if entry.form is None:
        assert entry.value is not None
        least, most = PLAUSIBLE.get(_KIND_OF[name], (0.0, inf))
        if name in CONDENSED and not least < entry.value * factor < most:
            kind = KINDS[_KIND_OF[name]]
            raise InputError(
                _("{owner} = {value} is outside {least} … {most}: is it in the unit that is meant?").format(
                    owner=whole.label,
                    value=show(entry.value * factor, kind),
                    least=show(least, kind),
                    most=show(most, kind),
                ),
                name=name,
            )
        return Correlation(
            _form("polynomial", whole.label), (entry.value,), factor, low, high, whole, entry.source
        )
    coefficients = None if entry.coefficients is None else tuple(entry.coefficients)
    form = _form(entry.form, whole.label)
    needs = any(p.name == "coefficients" for p in form.card.parameters)
    if needs == (coefficients is None):
        word = _("needs 'coefficients'") if needs else _("takes no 'coefficients'")
        raise InputError(
            _("Form '{form}' {word} ({owner}).").format(form=entry.form, word=word, owner=whole.label)
        )
    return Correlation(form, coefficients, factor, low, high, whole, entry.source)


def _or_nan(value: float | None) -> float:
    return nan if value is None else value


def fluid_of(key: str, entry: FluidEntry) -> Fluid:
    """A fluid from its entry."""
    made = {
        name: _property(getattr(entry, name), name, (key, entry.fr), entry.molar_mass)
        for name in _FLUID_PROPERTIES
    }
    return Fluid(
        name=key,
        french=entry.fr,
        formula=entry.formula,
        molar_mass=entry.molar_mass,
        critical_temperature=_or_nan(entry.critical_temperature),
        critical_pressure=_or_nan(entry.critical_pressure),
        diffusion_volume=_or_nan(entry.diffusion_volume),
        heat_of_vaporization_at_zero=_constant(made["heat_of_vaporization"], ZERO_CELSIUS),
        combustion=_combustion(entry),
        flammability=_flammability(entry),
        **made,
    )


def _combustion(entry: FluidEntry) -> Combustion | None:
    burns = entry.combustion
    return None if burns is None else Combustion(burns.air, burns.water, burns.lower_heating_value)


def _flammability(entry: FluidEntry) -> Flammability | None:
    burns = entry.flammability
    return None if burns is None else Flammability(burns.lower_limit, _or_nan(burns.limiting_oxygen))


def solid_of(key: str, entry: SolidEntry) -> Solid:
    """A solid from its entry."""
    mass = _or_nan(entry.molar_mass)
    made = {name: _property(getattr(entry, name), name, (key, entry.fr), mass) for name in _SOLID_PROPERTIES}
    return Solid(
        name=key,
        french=entry.fr,
        formula=entry.formula,
        molar_mass=mass,
        sphericity=_or_nan(entry.sphericity),
        mohs_hardness=_or_nan(entry.mohs_hardness),
        dust=entry.dust,
        **made,
    )


def _constant(function: Any, *values: Any) -> float:
    """A number worked out once, also when a material is first asked for inside a traced function."""
    if isinstance(function, Missing):
        return nan
    with flags.collect():  # flags of the build are nobody's inputs
        return float(once(partial(function, *values)))


def salt_of(key: str, entry: SaltEntry) -> Salt:
    """A salt from its entry."""
    cation, anion = entry.cation, entry.anion
    return Salt(
        name=key,
        french=entry.fr,
        formula=entry.formula,
        cation=cation.name,
        anion=anion.name,
        cation_count=float(cation.count),
        anion_count=float(anion.count),
        cation_charge=float(cation.charge),
        anion_charge=float(anion.charge),
        solubility_product=entry.solubility_product,
        enthalpy_of_dissolution=entry.enthalpy_of_dissolution,
        source=entry.source,
    )


def _branch(
    entry: BranchEntry, of: tuple[str, str], molar_mass: float, solvent: Fluid, crystal: Solid
) -> Branch:
    whole = Owner.of_property(of[0], "solubility", of[1], entry.crystal, crystal.french)
    if entry.basis not in BASES:
        raise unknown_name(
            _("Basis of solubility"), entry.basis, BASES, _("for {owner}").format(owner=whole.label)
        )
    if entry.form == "table":
        celsius, ratios = _printed(entry.table)
        with jax.ensure_compile_time_eval():
            law = Tabulated.through(celsius + ZERO_CELSIUS, ratios, *entry.range, whole, entry.source)
    else:
        law = Correlation(
            _form(entry.form, whole.label),
            tuple(entry.coefficients or ()),
            entry.factor,
            *entry.range,
            whole,
            entry.source,
        )
    dilute = nan if entry.heat_of_solution is None else entry.heat_of_solution / molar_mass
    stated = dilute if entry.heat_at_saturation is None else entry.heat_at_saturation / molar_mass
    branch = Branch(
        crystal=crystal,
        solvent_ratio=entry.bound_solvent * solvent.molar_mass / molar_mass,
        stable_from=entry.stable[0],
        stable_to=entry.stable[1],
        heat_of_crystallization=stated,
        heat_temperature=REFERENCE,
        heat_dilute=dilute,
        heat_given=entry.heat_of_solution is not None,
        law=law,
        basis=entry.basis,
        misfit=nan,
        enthalpy_of_formation=nan,
        _masses=(molar_mass, solvent.molar_mass),
        _ends=(0.0, 0.0),
    )
    ends = tuple(_constant(_slope, branch, 1.0 / end) for end in entry.range)
    return replace(branch, _ends=ends, misfit=_constant(_misfit, branch, entry.table))


def _slope(branch: Branch, inverse_temperature: float) -> Any:
    """Of the logarithm of solubility over 1/T."""
    return jax.grad(lambda u: jnp.log(branch.inside(1.0 / u)))(inverse_temperature)


def _printed(table: list[tuple[float, float]]) -> tuple[np.ndarray, np.ndarray]:
    """Temperatures in °C and kg of anhydrous solute per kg of solvent."""
    celsius, percent = np.array(table).T
    return celsius, percent / (100.0 - percent)


def _misfit(branch: Branch, table: list[tuple[float, float]]) -> Any:
    """Root mean square of the relative deviations of a curve from the points it was drawn through; zero for
    the formula of a source.
    """
    if not table:
        return 0.0
    celsius, ratios = _printed(table)
    return jnp.sqrt(jnp.mean((branch.inside(celsius + ZERO_CELSIUS) / ratios - 1.0) ** 2))


def solute_of(key: str, entry: SoluteEntry, solvent: Fluid, crystals: tuple[Solid, ...]) -> SoluteSystem:
    """A solute–solvent system from its entry, its solvent and the crystals of its branches."""
    branches = tuple(
        _branch(b, (key, entry.fr), entry.molar_mass, solvent, crystal)
        for b, crystal in zip(entry.branches, crystals, strict=True)
    )
    dry = branches[-1].crystal
    density = viscosity = heat_capacity = None
    if entry.density:
        density = LaliberteLaw(
            liquid_density_laliberte, tuple(entry.density), tuple(entry.density_limits or ())
        )
    if entry.viscosity:
        viscosity = LaliberteLaw(
            dynamic_viscosity_laliberte, tuple(entry.viscosity), tuple(entry.viscosity_limits or ())
        )
        if entry.thick_viscosity:
            viscosity = SyrupViscosity(viscosity)
    if entry.heat_capacity:
        heat_capacity = LaliberteLaw(
            specific_heat_capacity_laliberte,
            tuple(entry.heat_capacity),
            tuple(entry.heat_capacity_limits or ()),
        )
    if heat_capacity is None:
        parts = (solvent.liquid_heat_capacity, dry.heat_capacity)
        gap = next((part for part in parts if isinstance(part, Missing)), None)
        heat_capacity = NoLaw(gap) if gap is not None else AdditiveHeats(*parts)
    if viscosity is None:
        parts = (solvent.liquid_viscosity, dry.density, solvent.liquid_density)
        gap = next((part for part in parts if isinstance(part, Missing)), None)
        volumes = density or AdditiveVolumes(solvent.liquid_density, dry.density)
        viscosity = (
            NoLaw(gap)
            if gap is not None
            else DiluteViscosity(parts[0], volumes, dry.density, entry.molar_mass, entry.viscosity_b)
        )
    system = SoluteSystem(
        name=key.split(" in ")[0],
        french=entry.fr,
        formula=entry.formula,
        molar_mass=entry.molar_mass,
        solvent=solvent,
        branches=branches,
        density_law=density or AdditiveVolumes(solvent.liquid_density, dry.density),
        viscosity_law=viscosity,
        heat_capacity_law=heat_capacity,
        solute_heat_capacity=nan,
        activity_law=_activity(key, entry, solvent),
        form_of=entry.form_of,
    )
    if saturated_heats.is_measured(system):
        stated = [b.heat_at_saturation is not None for b in entry.branches]
        branches = tuple(
            b if known else _saturated(system, b) for b, known in zip(branches, stated, strict=True)
        )
        system = replace(system, branches=branches)
    system = _with_enthalpies(system)
    return system if entry.mixing is None else replace(system, mixing_law=_mixing(system, entry))


def _mixing(system: SoluteSystem, entry: SoluteEntry) -> CausticMixing | ElectrolyteMixing:
    """The law of the heat of mixing of a solute that has one."""
    law = system.activity_law
    if entry.mixing == "olsson":
        return CausticMixing(system.solute_heat_capacity)
    assert isinstance(law, ElectrolyteActivity)
    strong = _constant(system.value, REFERENCE) / system.molar_mass
    return ElectrolyteMixing(law, max(law.coldest, entry.mixing_from), min(strong, law.most))


def _saturated(system: SoluteSystem, branch: Branch) -> Branch:
    """A branch with the heat of its saturated solution, where that is strong enough to differ."""
    T = saturated_heats.place(branch)
    with flags.collect():
        found = once(partial(saturated_heats.enthalpy_of_dissolution, system, branch), T)
    heat, strong = (float(value) for value in found)
    if not branch.heat_given or strong < saturated_heats.STRONG:
        return branch
    return replace(branch, heat_of_crystallization=heat / system.molar_mass, heat_temperature=T)


def _activity(key: str, entry: SoluteEntry, solvent: Fluid) -> Any:
    """The law of water activity of a solute, or what says that there is none."""
    found = entry.water_activity
    if found is None:
        return NoActivity(Missing(Owner.of_property(key, "water activity of the solution", entry.fr)))
    if found.form == "olsson":
        return CausticActivity()
    if found.form == "starzak_peacock":
        return SucroseActivity(entry.molar_mass)
    if found.form == "raoult":
        return IdealActivity(entry.molar_mass, solvent.molar_mass, float(found.ions))

    return _pitzer(entry.molar_mass, found)


def _pitzer(molar_mass: float, found: ActivityEntry) -> ElectrolyteActivity:
    """Pitzer's equation with the coefficients of a file."""

    def whole(a: list[float]) -> tuple[float, ...]:
        return tuple((*a, *[0.0] * TERMS)[:TERMS])

    return ElectrolyteActivity(
        molar_mass=molar_mass,
        counts=(float(found.counts[0]), float(found.counts[1])),
        charges=(float(found.charges[0]), float(found.charges[1])),
        beta_zero=whole(found.beta_zero),
        beta_one=whole(found.beta_one),
        c_phi=whole(found.c_phi),
        beta_two=whole(found.beta_two),
        coldest=found.range[0],
        hottest=found.range[1],
        most=found.molality,
        source=found.source,
        exponents=found.exponents or usual_exponents(*found.charges),
        beside=None if found.beside is None else _pitzer(molar_mass, found.beside),
    )


def _with_enthalpies(system: SoluteSystem) -> SoluteSystem:
    """The system with the constants that put solution and crystals on one enthalpy scale."""
    if isinstance(system.heat_capacity_law, NoLaw):
        return system
    system = replace(system, solute_heat_capacity=_constant(_apparent_heat, system))
    formed = (
        nan if isinstance(b.crystal.heat_capacity, Missing) else _constant(_formed, system, b)
        for b in system.branches
    )
    return replace(
        system,
        branches=tuple(
            replace(b, enthalpy_of_formation=h) for b, h in zip(system.branches, formed, strict=True)
        ),
    )


def _apparent_heat(system: SoluteSystem) -> Any:
    """What the solute adds to the heat capacity of its saturated solution."""
    ratio = system.solubility(REFERENCE)
    whole = system.solution_heat_capacity(REFERENCE, ratio)
    return ((1.0 + ratio) * whole - system.solvent.liquid_heat_capacity.value(REFERENCE)) / ratio


def _formed(system: SoluteSystem, b: Branch) -> Any:
    """Enthalpy of formation of a crystal from what it dissolves to."""
    T = b.heat_temperature
    dissolved = system.solute_enthalpy(T) + b.solvent_ratio * system.solvent.liquid_enthalpy(T)
    return (dissolved - b.heat_of_crystallization) / b.hydrate_ratio - b.crystal.enthalpy(T)
