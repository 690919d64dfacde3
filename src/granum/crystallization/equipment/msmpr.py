"""Continuous crystallizers in a line: cooled, evaporative and vacuum (adiabatic)."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment, flags
from granum.core.conversion import is_tracer
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    GrowthRate,
    MassFlow,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    Pressure,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Temperature,
    TemperatureDifference,
    Time,
    Velocity,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.beside import (
    TOLD,
    heard_beside,
    keeps_solvent,
    others_per_solvent,
    solubility_beside,
    water_activity_beside,
)
from granum.crystallization.equipment.boiling import (
    Boiling,
    boiling_of,
    flashed,
    settled_liquor,
    temperature_beside,
)
from granum.crystallization.equipment.colliding import UNSOLVED_CROWD, Colliding
from granum.crystallization.equipment.in_time import Crystallized, InTime
from granum.crystallization.equipment.roles import (
    LARGEST,
    Roles,
    crystal_of,
    feed_of,
    given_off,
    refuse_boiling,
    roles,
    with_crystals,
)
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.kinds import Growth, Nucleation, Solubility, VesselVolume
from granum.crystallization.population.grid import Collisions
from granum.crystallization.vessels.msmpr import AdditiveVolumes, Removal, SteadyState, steady_msmpr
from granum.numerics.smooth import safe_divide
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, median_of
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COLD, COLD_APPROACH, COOLED, HEATED, STIRRED, cooled, heated

_UNSOLVED = (
    "No supersaturation was found at which the crystals made are those that the solute balance leaves: "
    "check feed, kinetics and evaporation."
)

LIFTED = (
    "The boiling point is that of the solute alone in its solvent, which the other solutes raise further: "
    "give 'elevation_linear' and 'elevation_quadratic' for this liquor."
)

THIN = (
    "The vapor over this liquor is thinner than that of the freezing solvent, so that nothing condenses it: "
    "hold a higher temperature."
)

ROUNDS = 2  # with the heat of mixing of the liquor as it is
WATER = COLD["cooling_water"] + COLD_APPROACH  # K, at which cooling water condenses the vapor


class CrystallizerFigures(NamedTuple):
    """Figures of a continuous crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Number
    magma_density: Concentration
    relative_supersaturation: Number
    growth_rate: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    growth_length: Distance
    mass_median_size: Distance
    evaporation: MassFlow
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class VacuumFigures(NamedTuple):
    """Figures of a continuous vacuum crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Number
    magma_density: Concentration
    relative_supersaturation: Number
    growth_rate: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    growth_length: Distance
    mass_median_size: Distance
    evaporation: MassFlow
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower
    boiling_temperature: Temperature
    boiling_point_elevation: TemperatureDifference
    pressure: Pressure
    temperature_condensation: Temperature
    condenser_duty: Power
    ejector_pressure_ratio: Ratio


STEADY: Limits = {
    "crowded": Limit("solids in the suspension by volume", 0.0, 0.35, "dimensionless", "mullin2001, ch. 9"),
    "time": Limit("residence time", 600.0, 36000.0, "s", "mullin2001, ch. 9"),
    "present": Limit(
        "crystals form, from a supersaturated liquor",
        1.0,
        1.0,
        "dimensionless",
        "randolph1988, ch. 4",
    ),
    "largest": Limit(LARGEST, 0.0, 0.05, "dimensionless", "randolph1988, ch. 4"),
}


class _Continuous(Stirred, Unit):
    """What the continuous crystallizers share; each says how much solvent evaporates."""

    temperature: Temperature
    volume: VesselVolume
    solubility: Solubility
    growth: Growth
    nucleation: Nucleation
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    nucleus_size: Distance = eqx.field(kw_only=True, default=0.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = (
        STEADY
        | SUSPENDED
        | {
            "drying": Limit("solvent evaporated", 0.0, math.inf, "kg/s", "randolph1988, ch. 4"),
        }
    )

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _liquor(self, feed: Stream, found: Roles, temperature: Any) -> AdditiveVolumes:
        """Volume flow of the mother liquor."""
        densities = feed.mixture.densities("liquids", temperature)
        volumes = feed.liquid / densities
        others = jnp.sum(volumes) - volumes[found.solute] - volumes[found.solvent]
        return AdditiveVolumes(densities[found.solute], densities[found.solvent], others)

    def _steady(self, feed: Stream, found: Roles, temperature: Any, given_off: tuple[Any, Any]) -> Any:
        """The steady suspension; what evaporates is given as by ``_evaporation``."""
        T, (evaporation, per_crystal), left = temperature, given_off, None
        if keeps_solvent(found) and isinstance(per_crystal, float):
            left = feed.liquid[found.solvent] - evaporation
        soluble = solubility_beside(self.solubility, feed.mixture, found, feed.liquid, T, left)
        return steady_msmpr(
            feed_of(feed, found),
            T,
            self.volume,
            soluble,
            self.growth,
            self.nucleation,
            crystal_of(feed.mixture, found, T, self.volume_shape_factor),
            self._liquor(feed, found, T),
            feed.mixture.edges,
            evaporation,
            per_crystal,
            self.nucleus_size,
            self._removal(feed, found, evaporation),
            self.collisions,
        )

    def _solid(self, feed: Stream, found: Roles, state: Any) -> Any:
        """Solid of the product by species and class."""
        return with_crystals(feed, found, state.crystals)

    def inside(self, feed: Stream) -> tuple[Any, Roles]:
        """The steady suspension, and which species plays which part."""
        found = roles(feed.mixture, self.solid, self.solvent)
        # once more where its flags are heard: inside what is compiled they are lost
        T = self.held_at(feed.mixture, feed)
        self.solubility(T)
        state = self._settled(feed, found, T)
        reason = _UNSOLVED if self.collisions is None else UNSOLVED_CROWD
        unsolved(state.converged, type(self).card, reason=reason)
        there = T, state.solute_per_solvent, state.solvent
        heard_beside(self.solubility, feed.mixture, found, feed.liquid, there, type(self).card)
        return state, found

    def _settled(self, feed: Stream, found: Roles, temperature: Any) -> SteadyState:
        """The steady suspension with what then evaporates."""
        return self._steady(feed, found, temperature, self._evaporation(feed, found, temperature))

    def outlets(self, inside: tuple[SteadyState, Roles], feed: Stream) -> Crystallized:
        state, found = inside
        T = jnp.asarray(state.temperature, dtype=float)
        liquid = feed.liquid.at[found.solute].set(state.solute).at[found.solvent].set(state.solvent)
        product = feed.replace(
            solid=self._solid(feed, found, state),
            liquid=liquid,
            gas=0.0 * feed.gas,
            temperature=T,
        )
        vapor = self._vapor(given_off(feed, found, state.evaporation, T), product, found)
        if found.vapor is not None:
            refuse_boiling(vapor.gas[found.vapor], product, feed, found, type(self).card)
        return Crystallized(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def _common(
        self, inside: tuple[SteadyState, Roles], outlets: Crystallized, feed: Stream
    ) -> CrystallizerFigures:
        state, found = inside
        entering = feed_of(feed, found)
        fed = entering.solute + found.solute_fraction * jnp.sum(entering.crystals)
        crystals = jnp.sum(state.crystals)
        return CrystallizerFigures(
            crystals,
            safe_divide(found.solute_fraction * crystals, fed),
            state.magma_density,
            state.relative_supersaturation,
            state.growth_rate,
            state.nucleation_rate,
            state.residence_time,
            state.length,
            median_of(state.crystals, feed.mixture.edges),
            jnp.asarray(state.evaporation, dtype=float),
            outlets.heat_duty,
            *self.stirrer_figures(outlets.product, self.volume),
        )

    def measured(
        self,
        inside: tuple[SteadyState, Roles],
        outlets: Crystallized,
        figures: Any,
        feed: Stream,
    ) -> dict[str, Any]:
        dissolved = feed.liquid[inside[1].solute]
        return {
            "crowded": outlets.product.solids_volume_fraction,
            "time": figures.residence_time,
            "present": jnp.where((figures.crystal_flow > 0.0) | ~(dissolved > 0.0), 1.0, 0.0),
            "largest": outlets.product.size_fractions[-1],
            "drying": figures.evaporation,
        } | self.stirrer_measured(outlets.product, self.volume)

    def drawn(
        self,
        inside: tuple[SteadyState, Roles],
        outlets: Crystallized,
        figures: Any,
        feed: Stream,
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, outlets.product.temperature
        return heated(duty, T) | cooled(duty, T) | self.stirrer_power(outlets.product, self.volume)

    def held_at(self, mixture: Mixture, feed: Stream | None = None) -> Any:
        """Temperature inside with a feed, K; without one, with nothing but solute and solvent."""
        return self.temperature

    def _vapor(self, vapor: Stream, product: Stream, found: Roles) -> Stream:
        """The vapor at the pressure over the suspension, which is that of the pure solvent by default."""
        return vapor

    def _removal(self, feed: Stream, found: Roles, evaporation: Any) -> Removal | None:
        """Fines dissolved and product classified; none by default."""
        return None

    @property
    def collisions(self) -> Collisions | None:
        """What crystals do to each other; nothing by default."""
        return None

    @abstractmethod
    def _evaporation(self, feed: Stream, found: Roles, temperature: Any) -> tuple[Any, Any]:
        """Solvent evaporated, kg/s, and what is added to it per kg of crystals formed."""


class Evaporative(_Continuous):
    """A vessel from which a given flow of solvent evaporates."""

    evaporation: MassFlow = eqx.field(kw_only=True, default=0.0)

    def _evaporation(self, feed: Stream, found: Roles, temperature: Any) -> tuple[Any, Any]:
        if found.vapor is not None:
            return self.evaporation, 0.0
        if not is_tracer(self.evaporation) and float(self.evaporation) != 0.0:
            raise CaseError(_("Evaporation needs a vapor of the solvent among the gases of the mixture."))
        return jnp.where(jnp.asarray(self.evaporation) == 0.0, 0.0, jnp.nan), 0.0


class _Evaporating(Evaporative):
    """One whose crystals have one size."""

    def figures(
        self, inside: tuple[SteadyState, Roles], outlets: Crystallized, feed: Stream
    ) -> CrystallizerFigures:
        return self._common(inside, outlets, feed)


@equipment(
    "msmpr",
    source="randolph1988, ch. 4; mullin2001, ch. 9",
    title="Continuous crystallizer, cooled or evaporative (MSMPR)",
    equation=r"M_T = k_v \rho_c \left(6 B_0 G^3\tau^4 + \dots\right)",
)
class Msmpr(Colliding, _Evaporating, InTime):
    """Continuous crystallizer with mixed suspension and mixed product removal at a given temperature and
    evaporation.

    The supersaturation is the one at which nucleation and growth make exactly the crystals that the solute
    balance leaves; seeds, fines and crystals of an earlier stage may come with the feed. Hydrates take their
    water from the solvent. Beside other salts that are known as ions the solubility of the library is that of
    the mixture, and what of them would crystallize too is told; a law of one's own is taken as that of this
    liquor. The vessel is as high as wide; without a ``rotation_speed`` its stirrer turns just
    fast enough to keep all crystals off the bottom. A viscosity that is not known counts there as that of
    water. With an ``agglomeration_kernel`` or a ``breakage_law`` (attrition is one) crystals also meet and
    break, in classes of 9 % of their size or less; agglomerates count as crystals of their volume.
    """


@equipment(
    "vacuum_crystallizer",
    source="mullin2001, ch. 8; randolph1988, ch. 4",
    title="Continuous vacuum crystallizer (adiabatic flash)",
    equation=r"\dot H_{feed} + \dot Q = \dot H_{product} + \dot H_{vapor}",
)
class VacuumCrystallizer(Colliding, _Continuous, InTime):
    """Continuous crystallizer whose hot feed flashes: cooling and evaporation at once, with no wall to
    foul.

    The vapor is what the enthalpy balance leaves; ``heat_duty`` adds heat from outside (zero for the
    adiabatic flash). Either the temperature is given and the pressure that must be held follows, or the other
    way round: the saturated mother liquor boils there. The elevation is that of the library's water activity,
    or of two coefficients over the mass fraction of solute; it counts as none at a given temperature where
    neither is there. Other salts that are known as ions raise it too, as much as they are concentrated in
    the liquor that is left; the supersaturation does not. In a run in time the temperature is the one of a
    liquor that has settled to the feed of the moment. An ejector is needed where cooling water condenses
    nothing, below 35 °C.
    """

    temperature: Temperature | None = eqx.field(kw_only=True, default=None)
    pressure: Pressure | None = eqx.field(kw_only=True, default=None)
    heat_duty: Power = 0.0
    elevation_linear: TemperatureDifference | None = eqx.field(kw_only=True, default=None)
    elevation_quadratic: TemperatureDifference | None = eqx.field(kw_only=True, default=None)

    instead: ClassVar[Mapping[str, str]] = {"pressure": "temperature"}

    limits: ClassVar[Limits] = _Continuous.limits | {
        "ejector": Limit("pressure ratio of one ejector", 0.0, 10.0, "dimensionless", "perry2008, § 10"),
    }

    def __check_init__(self) -> None:
        if (self.temperature is None) == (self.pressure is None):
            raise CaseError(
                _("A vacuum crystallizer takes either 'temperature' or 'pressure': give one of the two.")
            )

    def _boiling(self, mixture: Mixture) -> Boiling | None:
        found = roles(mixture, self.solid, self.solvent)
        given = (self.elevation_linear, self.elevation_quadratic)
        return boiling_of(mixture, found, self.solubility, given, needed=self.pressure is not None)

    def held_at(self, mixture: Mixture, feed: Stream | None = None) -> Any:
        if self.temperature is not None:
            return self.temperature
        law, card = self._boiling(mixture), type(self).card
        assert law is not None
        if feed is None or law.coefficients is not None:
            return law.temperature(self.pressure, card)
        found = roles(mixture, self.solid, self.solvent)
        beside = temperature_beside(law, feed, found, self.pressure, self.heat_duty, card)
        return law.temperature(self.pressure, card) if beside is None else beside

    def _vapor(self, vapor: Stream, product: Stream, found: Roles) -> Stream:
        law = self._boiling(product.mixture)
        if law is None:
            return vapor
        if self.pressure is None:
            T = vapor.temperature
            activity = water_activity_beside(product.mixture, found, product.liquid, T)
            over = law.pressure(T)
            if activity is not None and law.coefficients is None:
                over = law.solvent.vapor_pressure.value(T) * activity
            return vapor.replace(pressure=jnp.minimum(over, product.pressure))
        return vapor.replace(pressure=jnp.asarray(self.pressure, dtype=float))

    def _settled(self, feed: Stream, found: Roles, temperature: Any) -> SteadyState:
        state = super()._settled(feed, found, temperature)
        if feed.mixture.mixing is None:
            return state
        for _round in range(ROUNDS):  # with the heat that its own liquor holds, not the saturated one
            left = feed.liquid.at[found.solute].set(state.solute).at[found.solvent].set(state.solvent)
            given_off = flashed(feed, found, self.heat_duty, temperature, left)
            state = self._steady(feed, found, temperature, given_off)
        return state

    def inside(self, feed: Stream) -> tuple[Any, Roles]:
        made = super().inside(feed)
        share = others_per_solvent(made[1], feed.liquid)
        given = self.elevation_linear is not None or self.elevation_quadratic is not None
        known = water_activity_beside(feed.mixture, made[1], feed.liquid, feed.temperature) is not None
        if not given and not known:
            about = share > TOLD, share, "boiling_point_elevation", type(self).card.key
            flags.record(flags.EXTRAPOLATED, *about, reason=LIFTED)
        return made

    def figures(
        self, inside: tuple[SteadyState, Roles], outlets: Crystallized, feed: Stream
    ) -> VacuumFigures:
        found, law = inside[1], self._boiling(feed.mixture)
        T, held = outlets.product.temperature, outlets.vapor.pressure
        lifted = held if law is None else law.solvent.vapor_pressure.value(WATER)
        pure = T if law is None or not law.elevated else law.pure(held)
        unsolved(jnp.isfinite(pure), type(self).card, reason=THIN)
        vapor = outlets.vapor.part(gas=1.0)
        solvent = vapor.gas[found.vapor]
        liquid = vapor.replace(
            gas=vapor.gas.at[found.vapor].set(0.0), liquid=vapor.liquid.at[found.solvent].set(solvent)
        )
        return VacuumFigures(
            *self._common(inside, outlets, feed),
            T,
            T - pure,
            held,
            pure,
            vapor.enthalpy_flow - liquid.enthalpy_at(pure),
            jnp.maximum(lifted / held, 1.0),
        )

    def measured(
        self,
        inside: tuple[SteadyState, Roles],
        outlets: Crystallized,
        figures: Any,
        feed: Stream,
    ) -> dict[str, Any]:
        ratio = figures.ejector_pressure_ratio
        return super().measured(inside, outlets, figures, feed) | {"ejector": ratio}

    def _evaporation(self, feed: Stream, found: Roles, temperature: Any) -> tuple[Any, Any]:
        if found.vapor is None:
            raise CaseError(_("Evaporation needs a vapor of the solvent among the gases of the mixture."))
        left = None
        if feed.mixture.mixing is not None:
            soluble = solubility_beside(self.solubility, feed.mixture, found, feed.liquid, temperature)
            left = settled_liquor(feed, found, soluble, self.heat_duty, temperature)
        return flashed(feed, found, self.heat_duty, temperature, left)
