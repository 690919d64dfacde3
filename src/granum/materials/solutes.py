"""``SoluteSystem``: a solute in a solvent: solubility of each crystal, hydrates, heats, and properties of the
solution.

Basis everywhere: ``solute_per_solvent`` is kg of anhydrous solute per kg of solvent, the solvent bound in
dissolved hydrate counted as solvent. Crystal quantities are per kg of crystal as it is (hydrate included)
unless the name says otherwise.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.at_once import at_once
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import ApplicabilityError, unknown_name
from granum.core.i18n import _, current_language
from granum.materials.correlation import (
    Correlation,
    Missing,
    Tabulated,
    as_pressure,
    as_solute_ratio,
    as_temperature,
)
from granum.materials.fluids import Fluid
from granum.materials.formulas.solutions import dynamic_viscosity_genotelle, dynamic_viscosity_jones_dole
from granum.materials.solids import Solid
from granum.numerics import find_root

REFERENCE = 298.15  # K, at which heats of solution are given


def _from_anhydrous_ratio(y: Any, _bound: float, _solute: float, _solvent: float) -> Any:
    return y


def _from_hydrate_ratio(y: Any, bound: float, _solute: float, _solvent: float) -> Any:
    return y / (1.0 + bound + y * bound)


def _from_mass_fraction(y: Any, _bound: float, _solute: float, _solvent: float) -> Any:
    return y / (1.0 - y)


def _from_mole_fraction(y: Any, _bound: float, solute: float, solvent: float) -> Any:
    return y * solute / ((1.0 - y) * solvent)


def _from_molality(y: Any, _bound: float, solute: float, _solvent: float) -> Any:
    return y * solute


BASES: dict[str, Callable[[Any, float, float, float], Any]] = {
    "kg anhydrous per kg solvent": _from_anhydrous_ratio,
    "kg crystal per kg added solvent": _from_hydrate_ratio,
    "mass fraction anhydrous": _from_mass_fraction,
    "mole fraction anhydrous": _from_mole_fraction,
    "mol anhydrous per kg solvent": _from_molality,
}
"""What a printed solubility may mean, and how it becomes kg of anhydrous solute per kg of solvent."""


class Branch(eqx.Module):
    """One crystal of a system with its own solubility curve.

    Parameters
    ----------
    crystal: the solid that forms.
    solvent_ratio: kg of solvent bound in the crystal per kg of anhydrous solute; zero without solvate.
    stable_from, stable_to: temperatures between which it is the stable one, K.
    heat_of_crystallization: from the saturated solution, J per kg of anhydrous solute at
        ``heat_temperature``, positive when heat is released; NaN when not given.
    heat_temperature: K.
    heat_dilute: what the crystal takes up at infinite dilution, J per kg of anhydrous solute at 25 °C.
    misfit: root mean square of the relative deviations of the curve from its own data; zero where the source
        gives a formula alone.
    enthalpy_of_formation: of the crystal at 0 °C by its own heat capacity, J per kg of crystal, on the scale
        of the solution.
    """

    crystal: Solid
    solvent_ratio: float
    stable_from: float = eqx.field(static=True)
    stable_to: float = eqx.field(static=True)
    heat_of_crystallization: float
    heat_temperature: float
    heat_dilute: float
    heat_given: bool = eqx.field(static=True)
    law: Correlation | Tabulated
    basis: str = eqx.field(static=True)
    misfit: float
    enthalpy_of_formation: float
    _masses: tuple[float, float] = eqx.field(static=True)
    _ends: tuple[float, float]
    """Slopes d ln C*/d(1/T) at both ends of the range, K."""

    @property
    def hydrate_ratio(self) -> float:
        """kg of crystal per kg of anhydrous solute in it."""
        return 1.0 + self.solvent_ratio

    def solubility(self, temperature: Any) -> Any:
        """kg of anhydrous solute per kg of solvent in equilibrium with this crystal, stable or not."""
        T = as_temperature(temperature)
        self.law.check_range(T)
        return self.value(T)

    def value(self, temperature: Any) -> Any:
        """The solubility without flags; beyond the range a straight line of ln C* over 1/T (van 't Hoff), so
        that no fit runs away.
        """
        T = jnp.asarray(temperature, dtype=float)
        low, high = self.law.low, self.law.high
        colder, warmer = (
            jnp.where(low > T, 1.0 / T - 1.0 / low, 0.0),
            jnp.where(high < T, 1.0 / T - 1.0 / high, 0.0),
        )
        return self.inside(jnp.clip(T, low, high)) * jnp.exp(self._ends[0] * colder + self._ends[1] * warmer)

    def inside(self, temperature: Any) -> Any:
        """The solubility by its law, within the range."""
        return BASES[self.basis](self.law.value(temperature), self.solvent_ratio, *self._masses)


class SoluteSystem(eqx.Module):
    """A solute in a solvent, ``solute("potassium nitrate")``.

    Parameters
    ----------
    name, french, formula: the anhydrous solute.
    molar_mass: of the anhydrous solute, kg/mol.
    solvent: the pure solvent.
    branches: crystals by increasing temperature of stability.
    density_law, viscosity_law, heat_capacity_law: of (temperature, mass fraction of anhydrous solute).
    solute_heat_capacity: apparent heat capacity of dissolved solute in the solution saturated at 25 °C, J/(kg
        K).
    activity_law: water activity, of (temperature, solute per solvent).
    mixing_law: heat of mixing over solvent and solute counted apart, of (temperature, kg of solute, kg of
        solvent), J; None where it is left out.
    form_of: the solute of which the crystals here are another form; empty where they are its own.
    """

    name: str = eqx.field(static=True)
    french: str = eqx.field(static=True)
    formula: str = eqx.field(static=True)
    molar_mass: float
    solvent: Fluid
    branches: tuple[Branch, ...]
    density_law: Any
    viscosity_law: Any
    heat_capacity_law: Any
    solute_heat_capacity: float
    activity_law: Any
    mixing_law: Any = None
    form_of: str = eqx.field(static=True, default="")

    @property
    def label(self) -> str:
        """Solute and solvent in the current language."""
        solute = self.french if current_language() == "fr" and self.french else self.name
        return _("{solute} in {solvent}").format(solute=solute, solvent=self.solvent.label)

    def branch(self, crystal: str | None = None) -> Branch:
        """The branch of a crystal by name; without a name the only or coldest one."""
        if crystal is None:
            return self.branches[0]
        found = {b.crystal.name: b for b in self.branches}
        if crystal not in found:
            raise unknown_name(_("Crystal"), crystal, found, _("of {owner}").format(owner=self.label))
        return found[crystal]

    def _select(self, temperature: Any, pick: Callable[[Branch, Any], Any]) -> Any:
        """The value of the branch that is stable at each temperature; the others are evaluated where they are
        harmless.
        """
        T = jnp.asarray(temperature)
        out = None
        for i, b in enumerate(self.branches):
            low = -jnp.inf if i == 0 else b.stable_from
            high = jnp.inf if i == len(self.branches) - 1 else self.branches[i + 1].stable_from
            here = (low <= T) & (high > T)
            inside = 0.5 * (b.stable_from + b.stable_to)
            value = pick(b, jnp.where(here, T, inside))
            out = value if out is None else jnp.where(here, value, out)
        return out

    @at_once("crystal", temperature=as_temperature)
    def solubility(self, temperature: Any, crystal: str | None = None) -> Any:
        """Saturation, kg of anhydrous solute per kg of solvent; over the stable crystal, or over a named
        one.
        """
        T = as_temperature(temperature)
        return (
            self.branch(crystal).solubility(T) if crystal else self._select(T, lambda b, t: b.solubility(t))
        )

    @at_once()
    def value(self, temperature: Any) -> Any:
        """Saturation over the stable crystal, without flags and beyond the data, as of ``Branch.value``."""
        return self._select(temperature, lambda b, t: b.value(t))

    @property
    def data_range(self) -> tuple[float, float]:
        """Lowest and highest temperature of the solubility data, K."""
        return self.branches[0].law.low, self.branches[-1].law.high

    def solubility_misfit(self, temperature: Any) -> Any:
        """Root mean square of the relative deviations of the curve of the stable crystal from its own
        data.
        """
        return self._select(as_temperature(temperature), lambda b, t: b.misfit + 0.0 * t)

    def hydrate_ratio(self, temperature: Any) -> Any:
        """kg of the stable crystal per kg of anhydrous solute in it."""
        return self._select(as_temperature(temperature), lambda b, t: b.hydrate_ratio + 0.0 * t)

    @at_once(temperature=as_temperature)
    def heat_of_crystallization(self, temperature: Any) -> Any:
        """Heat released on crystallization at saturation, J per kg of anhydrous solute: that of one
        temperature, and from there by Kirchhoff's law.

        Equals ``solute_enthalpy`` + bound solvent − ``crystal_enthalpy``, and what the liquor loses of its
        heat of mixing, so that energy balances close.
        """

        T = as_temperature(temperature)
        return self.crystal_depth(T) + self._select(T, self._mixing_lost)

    def crystal_depth(self, temperature: Any) -> Any:
        """How far the stable crystal lies below its solute and solvent counted apart, J per kg of anhydrous
        solute.
        """

        def below(b: Branch, t: Any) -> Any:
            bound = b.solvent_ratio * self.solvent.liquid_enthalpy(t)
            crystal = b.hydrate_ratio * self.crystal_enthalpy(t, b.crystal.name)
            return self.solute_enthalpy(t) + bound - crystal

        return self._select(as_temperature(temperature), below)

    def heat_of_mixing(self, temperature: Any, solute: Any, solvent: Any) -> Any:
        """What these amounts hold over their parts counted apart, J; nothing without a ``mixing_law``."""
        return 0.0 if self.mixing_law is None else self.mixing_law(temperature, solute, solvent)

    @at_once("crystal", solute_per_solvent=as_solute_ratio)
    def saturation_temperature(self, solute_per_solvent: Any, crystal: str | None = None) -> Any:
        """Temperature at which a solution is saturated, K; NaN outside the range of the data. For rising
        solubilities.
        """
        ratio = jnp.asarray(as_solute_ratio(solute_per_solvent))
        branch = self.branch(crystal)
        low, high = branch.law.low, branch.law.high if crystal else self.branches[-1].law.high

        def law(T: Any) -> Any:
            return branch.value(T) if crystal else self._select(T, lambda b, t: b.value(t))

        goal = jnp.log(jnp.maximum(ratio, 1e-300))
        return find_root(lambda T, y: jnp.log(law(T)) - y, low, high, goal).value

    # -- the solution
    # ------------------------------------------------------------------------------------------
    def mass_fraction(self, solute_per_solvent: Any) -> Any:
        """Mass fraction of anhydrous solute in the solution."""
        ratio = as_solute_ratio(solute_per_solvent)
        return ratio / (1.0 + ratio)

    def solution_density(self, temperature: Any, solute_per_solvent: Any) -> Any:
        """Density of the solution, kg/m³."""
        return self.density_law(as_temperature(temperature), self.mass_fraction(solute_per_solvent))

    def solution_viscosity(self, temperature: Any, solute_per_solvent: Any) -> Any:
        """Dynamic viscosity of the solution, Pa s."""
        return self.viscosity_law(as_temperature(temperature), self.mass_fraction(solute_per_solvent))

    def solution_heat_capacity(self, temperature: Any, solute_per_solvent: Any) -> Any:
        """Heat capacity of the solution, J/(kg K)."""
        return self.heat_capacity_law(as_temperature(temperature), self.mass_fraction(solute_per_solvent))

    # -- boiling
    # -------------------------------------------------------------------------------------------------
    def solvent_activity(self, temperature: Any, solute_per_solvent: Any) -> Any:
        """Activity of the solvent over the solution."""
        return self.activity_law(as_temperature(temperature), as_solute_ratio(solute_per_solvent))

    @at_once(pressure=as_pressure, solute_per_solvent=as_solute_ratio)
    def boiling_temperature(self, pressure: Any, solute_per_solvent: Any) -> Any:
        """Temperature at which the solution boils, K; NaN outside the range of the vapor pressure."""
        P, ratio = jnp.asarray(as_pressure(pressure)), jnp.asarray(as_solute_ratio(solute_per_solvent))
        law = self.solvent.vapor_pressure
        if isinstance(law, Missing):
            return law(P)
        self.solvent_activity(jnp.clip(self.solvent.boiling_temperature(P), law.low, law.high), ratio)

        def excess(T: Any, p: Any, c: Any) -> Any:
            return jnp.log(law.value(T)) + jnp.log(self.activity_law(T, c)) - jnp.log(p)

        return find_root(excess, law.low, law.high, jnp.maximum(P, 1e-300), ratio).value

    @at_once(pressure=as_pressure, solute_per_solvent=as_solute_ratio)
    def boiling_point_elevation(self, pressure: Any, solute_per_solvent: Any) -> Any:
        """By how much hotter the solution boils than the solvent, K."""
        pure = self.solvent.boiling_temperature(pressure)
        return self.boiling_temperature(pressure, solute_per_solvent) - pure

    # -- enthalpies: zero for liquid solvent and dissolved solute at 0 °C; additive, so that mixing closes
    # exactly ----------
    def solute_enthalpy(self, temperature: Any) -> Any:
        """Enthalpy of dissolved anhydrous solute, J/kg, with its apparent heat capacity. It is that in the
        saturated solution at any strength, heats of dilution being left out; where there is a ``mixing_law``,
        it is that in much water, and the law has the rest.
        """
        return self.solute_heat_capacity * (as_temperature(temperature) - ZERO_CELSIUS)

    def crystal_enthalpy(self, temperature: Any, crystal: str | None = None) -> Any:
        """Enthalpy of a crystal, J per kg of crystal, on the scale of the solution: lower by the heat of
        crystallization.
        """
        b = self.branch(crystal)
        self._need_heat(b)
        # its heat of crystallization is from the saturated solution, which holds a heat of mixing
        strong = self.mixing_law is not None and b.heat_of_crystallization != b.heat_dilute
        held = self._mixing_lost(b, jnp.asarray(b.heat_temperature)) / b.hydrate_ratio if strong else 0.0
        return b.enthalpy_of_formation + held + b.crystal.enthalpy(temperature)

    def _mixing_lost(self, b: Branch, T: Any) -> Any:
        """Of the saturated liquor, as a kilogram of solute and the solvent that it binds leave it, J."""
        law = self.mixing_law
        if law is None:
            return 0.0 * T
        there, leaving = (
            (b.value(T), jnp.ones_like(T)),
            (jnp.ones_like(T), b.solvent_ratio * jnp.ones_like(T)),
        )
        return jax.jvp(lambda s, w: law(T, s, w), there, leaving)[1]

    def _need_heat(self, b: Branch) -> None:
        if not b.heat_given:
            raise ApplicabilityError(
                _(
                    "The library has no heat of crystallization for {crystal}; give 'heat_of_solution' "
                    "in a materials file."
                ).format(crystal=b.crystal.label)
            )

    def __repr__(self) -> str:
        return _("solute {name} ({formula})").format(name=self.label, formula=self.formula)


EINSTEIN = 2.5
ESTIMATED = (
    "No viscosity of this solution is known here: Einstein's law for the volume of the solute stands in, "
    "half of what sugars and organic acids do, and far less in strong solutions."
)
THIN, THICK = 0.4, 0.5  # mass fraction of sucrose between which one law gives way to the other
SLACK = 0.51  # K: the limits of the source are rounded


class LaliberteLaw(eqx.Module):
    """A solution property by one of Laliberté's models, flagged outside the data behind its coefficients."""

    form: Any = eqx.field(static=True)
    coefficients: tuple[float, ...] = eqx.field(static=True)
    # lowest and highest K, largest mass fraction
    limits: tuple[float, ...] = eqx.field(static=True, default=())
    is_missing = False

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        if self.limits:
            cold, hot, most = self.limits
            T, w = jnp.asarray(temperature), jnp.asarray(solute_mass_fraction)
            key, source = self.form.card.key, self.form.source
            outside = (cold - SLACK > T) | (hot + SLACK < T)
            flags.record(flags.EXTRAPOLATED, outside & (w > 0), T, "temperature", key, cold, hot, source)
            flags.record(
                flags.EXTRAPOLATED, w > most * (1.0 + 1e-3), w, "solute_mass_fraction", key, 0.0, most, source
            )
        return self.form(temperature, solute_mass_fraction, np.asarray(self.coefficients))


class SyrupViscosity(eqx.Module):
    """Viscosity of a solution of sucrose: Laliberté's coefficients, which end at half sugar, and Génotelle's
    equation beyond, which agree there to 3 %.
    """

    thin: LaliberteLaw
    is_missing = False

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        w = jnp.asarray(solute_mass_fraction)
        s = jnp.clip((w - THIN) / (THICK - THIN), 0.0, 1.0)
        share = s * s * (3.0 - 2.0 * s)
        thin = self.thin(temperature, jnp.where(share < 1.0, jnp.minimum(w, THICK), 0.0))
        thick = dynamic_viscosity_genotelle(temperature, w)
        return jnp.exp((1.0 - share) * jnp.log(thin) + share * jnp.log(thick))


class DiluteViscosity(eqx.Module):
    """Viscosity of a solution by Jones and Dole's coefficient, L/mol, or where none is known by Einstein's
    law for the volume of the solute as a solid, which is flagged as an estimate.
    """

    solvent: Any
    density: Any
    dry: Any
    molar_mass: float
    coefficient: float | None = eqx.field(static=True)
    is_missing = False

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        w = jnp.asarray(solute_mass_fraction)
        c = w * self.density(temperature, w) / self.molar_mass
        if self.coefficient is None:
            B = EINSTEIN * self.molar_mass / self.dry(temperature)
            card = dynamic_viscosity_jones_dole
            about = w > 0.0, w, "solute_mass_fraction", card.card.key
            flags.record(flags.EXTRAPOLATED, *about, source=card.source, reason=ESTIMATED)
        else:
            B = 1e-3 * self.coefficient
        return dynamic_viscosity_jones_dole(self.solvent(temperature), jnp.maximum(c, 0.0), B)


class AdditiveVolumes(eqx.Module):
    """Density of a solution whose solvent and (solid) solute volumes add: within a few percent for organic
    solutes.
    """

    solvent: Any
    solute_density: Any

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        w = solute_mass_fraction
        return 1.0 / ((1.0 - w) / self.solvent(temperature) + w / self.solute_density(temperature))


class AdditiveHeats(eqx.Module):
    """Heat capacity of a solution as the mass-weighted mean of solvent and solid solute."""

    solvent: Any
    solute_heat_capacity: Any

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        w = solute_mass_fraction
        return (1.0 - w) * self.solvent(temperature) + w * self.solute_heat_capacity(temperature)


class NoLaw(eqx.Module):
    """Stands where a system has no law for a property of its solutions."""

    missing: Missing
    is_missing = True

    def __call__(self, temperature: Any, solute_mass_fraction: Any) -> Any:
        return self.missing(temperature)
