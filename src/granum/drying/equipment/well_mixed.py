"""A continuous dryer in which gas and solid are well mixed: the simplest true model of a fluidized-bed
dryer.
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    HumidityRatio,
    Mass,
    MassFlow,
    MoistureDryBasis,
    Power,
    RelativeHumidity,
    Speed,
    Temperature,
    Time,
)
from granum.core.limits import Limit
from granum.drying.gas_solid.dryer import Dried
from granum.drying.kinds import LostHeat
from granum.drying.wet_surface import crystallized, evaporated, leaving
from granum.humid_gas.relations import wet_bulb_balance
from granum.numerics import find_root, safe_divide
from granum.particles.formulas.numbers import reynolds_number
from granum.particles.formulas.transfer import nusselt_number_ranz_marshall
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, FANNED, HOT_GAS, ducted, warmth

COLDEST_FILM = 200.0  # K
UNSOLVED = (
    "No temperature of the bed was found at which heat and evaporation agree: give hotter gas or more of "
    "it, less wet solid, or a smaller heat loss."
)


class WellMixedFigures(NamedTuple):
    """Figures of a well-mixed dryer."""

    evaporation_rate: MassFlow
    moisture_dry_basis: MoistureDryBasis
    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    solid_holdup: Mass
    area: Area
    heat_duty: Power


@equipment("well_mixed_dryer", source="kunii1991, ch. 16; ranz1952", title="Well-mixed (fluidized-bed) dryer")
class WellMixedDryer(Unit):
    """Dries the liquor film on non-porous particles in a gas that is well mixed with them; sizes of particle
    dry at their own rate.

    The film is spread over the particle surface in proportion to its area. It evaporates at the wet-bulb
    temperature of the bed gas, with heat transfer after Ranz and Marshall at the superficial velocity, until
    it is gone; residence times are exponential. Particles and gas leave at the bed temperature. What was
    dissolved in the evaporated water stays on the particles as solid. Simplifications: the saturated film
    evaporates like the pure liquid, of several solvents only the first of the mixture, and no moisture is
    bound inside the crystals.
    """

    residence_time: Time
    gas_velocity: Speed
    heat_loss: LostHeat = 0.0

    limits: ClassVar[Limits] = {
        "humid": Limit("relative humidity of the exhaust", 0.0, 0.9, "dimensionless", "mujumdar2014, ch. 1"),
        "moist": Limit("moisture of the product", 0.0, 0.01, "kg/kg", "mullin2001, ch. 9"),
    } | FLAMMABLE

    utilities: ClassVar[Utilities] = HOT_GAS | FANNED | AREA

    def inside(self, feed: Stream, gas: Stream) -> Stream:
        """Gas and solid together, as they are in the bed."""
        humid = HumidMixture(feed.mixture)
        water = feed.liquid[0]
        wet = feed + gas.replace(liquid=jnp.zeros_like(gas.liquid), solid=jnp.zeros_like(gas.solid))
        wet = wet.replace(pressure=gas.pressure)
        enthalpy = feed.enthalpy_flow + gas.enthalpy_flow - self.heat_loss

        def after(evaporated: Any, T: Any) -> Stream:
            """The matter in the bed at T when that much water has gone into the gas."""
            return evaporate(wet, safe_divide(evaporated, water)).replace(temperature=T)

        def by_energy(T: Any) -> Any:
            """Water that the heat available at a bed temperature evaporates: enthalpy is linear in it."""
            none, all_ = after(0.0, T).enthalpy_flow, after(water, T).enthalpy_flow
            return water * (enthalpy - none) / (all_ - none)

        def by_kinetics(T: Any, evaporated: Any) -> Any:
            bed = after(jnp.clip(evaporated, 0.0, water), T)
            saturated = jnp.minimum(humid.pair.saturated_fraction(T, bed.pressure, False), 1.0)
            Tw = self._surface_temperature(
                humid, T, bed.pressure, jnp.minimum(humid.fraction(bed), saturated)
            )
            latent = humid.heat_of_vaporization(Tw)
            flux = self._heat_transfer(bed) * jnp.maximum(T - Tw, 0.0) / latent  # kg/(m² s) per class
            area = (
                feed.by_size(6.0 / (feed.mixture.sizes * feed.solid_density))
                * feed.solid
                / jnp.where(feed.solid_flow > 0, feed.solid_flow, 1.0)
            )
            area = jnp.sum(area, axis=(0, *range(2, area.ndim)))  # m² per kg of all solid, by class
            film = safe_divide(water, feed.solid_flow * jnp.sum(area))  # kg of water per m²
            time = film / jnp.maximum(flux, 1e-12)  # to dry one particle
            # share evaporated, exponential residence times
            dried = -jnp.expm1(-time / self.residence_time) * self.residence_time / time
            return water * jnp.sum(area * dried) / jnp.sum(area)

        coldest = jnp.maximum(jnp.minimum(feed.temperature, gas.temperature) - 60.0, COLDEST_FILM + 5.0)

        def surplus(T: Any) -> Any:
            available = by_energy(T)
            return (available - by_kinetics(T, available)) / jnp.maximum(water, 1e-300)

        root = find_root(surplus, coldest, gas.temperature, tolerance=1e-13)
        unsolved(root.converged | (water <= 0), type(self).card, reason=UNSOLVED)
        T = jnp.where(water > 0, root.value, wet.at_enthalpy(enthalpy).temperature)
        return after(jnp.clip(by_energy(T), 0.0, water), T)

    def outlets(self, inside: Stream, feed: Stream, gas: Stream) -> Dried:
        exhaust = inside.replace(solid=jnp.zeros_like(inside.solid), liquid=jnp.zeros_like(inside.liquid))
        return Dried(inside.replace(gas=jnp.zeros_like(inside.gas)), exhaust, -self.heat_loss)

    @staticmethod
    def _surface_temperature(humid: HumidMixture, T: Any, P: Any, y: Any) -> Any:
        """Wet bulb over liquid. The general ``wet_bulb`` also knows ice and vast arrays; here its balance
        alone compiles much faster.
        """
        pair = humid.pair
        top = jnp.minimum(T, pair.boiling_temperature(P)) * (1.0 + 1e-9)
        h = pair.molar_enthalpy(T, P, y)
        lewis = pair.lewis_factor()
        return find_root(
            lambda Ts: wet_bulb_balance(pair, Ts, h, P, y, False, lewis), COLDEST_FILM, top
        ).value

    def _heat_transfer(self, bed: Stream) -> Any:
        """Heat transfer coefficient of each size class, W/(m² K)."""
        conductivity = bed.gas_conductivity
        prandtl = bed.gas_heat_capacity * bed.gas_viscosity / conductivity
        sizes = self._sizes(bed)
        reynolds = reynolds_number(sizes, self.gas_velocity, bed.gas_density, bed.gas_viscosity)
        return nusselt_number_ranz_marshall(reynolds, prandtl) * conductivity / sizes

    @staticmethod
    def _sizes(bed: Stream) -> Any:
        """Class sizes; an empty class takes the size of the fullest one, so that nothing is flagged for
        particles that are not there.
        """
        shares = bed.size_fractions
        return jnp.where(shares > 1e-9, bed.mixture.sizes, jnp.asarray(bed.mixture.sizes)[jnp.argmax(shares)])

    def figures(self, inside: Stream, outlets: Dried, feed: Stream, gas: Stream) -> WellMixedFigures:
        humid, exhaust = HumidMixture(feed.mixture), outlets.exhaust
        return WellMixedFigures(
            evaporation_rate=evaporated(feed, outlets.product),
            moisture_dry_basis=outlets.product.moisture_dry_basis,
            temperature=outlets.product.temperature,
            humidity_ratio=humid.humidity_ratio(exhaust),
            relative_humidity=humid.relative_humidity(exhaust),
            solid_holdup=outlets.product.solid_flow * self.residence_time,
            area=exhaust.gas_volume_flow / self.gas_velocity,
            heat_duty=outlets.heat_duty,
        )

    def measured(
        self, inside: Stream, outlets: Dried, figures: WellMixedFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return {"humid": figures.relative_humidity, "moist": figures.moisture_dry_basis} | flammable(
            outlets.exhaust
        )

    def drawn(
        self, inside: Stream, outlets: Dried, figures: WellMixedFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        bed = 1.3 * figures.solid_holdup * STANDARD_GRAVITY / figures.area
        return warmth(gas) | {"electric_power_fan": ducted(gas, bed), "area_installed": figures.area}


def evaporate(wet: Stream, share: Any) -> Stream:
    """Move a share of the liquor into the gas; what was dissolved in it crystallizes. A second solvent
    stays.
    """
    gas = wet.gas.at[HumidMixture(wet.mixture).vapor].add(leaving(wet, share))
    return crystallized(wet, share).replace(gas=gas)
