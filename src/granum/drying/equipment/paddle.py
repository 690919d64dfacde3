"""Paddle, screw, disc or drum contact dryer: an agitated bed on heated walls, under vacuum or not
(penetration model).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Density,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    PositiveNumber,
    Pressure,
    Ratio,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
    TurningSpeed,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.core.utilities import Utility
from granum.drying.equipment.drum import ContactDried
from granum.drying.formulas.contact_drying import (
    contact_time_mixing,
    heat_transfer_coefficient_wall_particles,
    penetration_drying,
)
from granum.drying.formulas.heat import heat_transfer_coefficient_penetration
from granum.drying.gas_solid.dryer import ready
from granum.drying.profile_charts import contact_chart
from granum.drying.wet_surface import AS_SPECIFIED, as_specified, boiled, evaporated
from granum.numerics import Root, find_root, safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, HEAT_APPROACH, HEATED, VACUUM_KEPT, driven, heated, kept_empty

HOUSED = 2.0  # times the volume of the bed, that of the dryer (our own estimate)
STEPS, PASTY_STEPS = 40, 10
FRICTION = 0.6  # inside the bed, of a repose of 31°
TURNED = "vdi2010, ch. Mc, the bed only: that all of it rubs at the speed of the paddles is our own estimate"
DRIEST = 1e-6  # kg/kg, to which an area may dry


class ContactCurve(NamedTuple):
    """Bed over its way: moisture, temperature, time per load, flux."""

    moisture: jax.Array
    temperature: jax.Array
    time: jax.Array
    flux: jax.Array


class PaddleFigures(NamedTuple):
    """Figures of an agitated contact dryer."""

    evaporation_rate: MassFlow
    area: Area
    residence_time: Time
    solid_holdup: Mass
    evaporation_per_area: MassFlux
    drying_flux_inlet: MassFlux
    drying_flux_outlet: MassFlux
    heat_transfer_coefficient_wall: HeatTransferCoefficient
    heat_transfer_coefficient_bed: HeatTransferCoefficient
    heat_transfer_coefficient_paste: HeatTransferCoefficient
    contact_time: Time
    boiling_temperature: Temperature
    temperature_product: Temperature
    energy_per_water: SpecificEnergy


class Heat(NamedTuple):
    """Boiling temperature, coefficients of wall and of bed, heat capacities of the dry solid and of the
    liquid.
    """

    boiling: jax.Array
    wall: jax.Array
    bed: jax.Array
    capacity: jax.Array
    liquid_capacity: jax.Array


class Heated(NamedTuple):
    """The bed on its walls: coefficients, that of the paste, its way, and the heated area that the feed
    needs, m².
    """

    heat: Heat
    paste: Any
    curve: ContactCurve
    area: Any


@equipment(
    "paddle_dryer",
    source="mollekopf1984; vdi2010, ch. Mc; milhe2014",
    title="Paddle or screw dryer (contact)",
)
class PaddleDryer(Unit):
    """An agitated bed that boils on heated walls: found is the area, or the batch time, to dry to the
    moisture wanted.

    Heat passes the wall's gap, then penetrates the resting bed behind a drying front until it is mixed again
    (Schlünder and Mollekopf). What does not evaporate warms the bed. Continuous dryers are taken in plug
    flow, which the paddles of one shaft nearly give; a batch is the same curve in time. Under vacuum the
    pressure sets the boiling temperature, and a pump draws off the air that leaks in. Properties are those of
    the dry bed; non-hygroscopic product. ``dry_mass_per_area`` is the hold-up per heated area. Mixing numbers
    are those of paddles unless given.

    A sludge is a paste above ``pasty_moisture``: it wets the wall, so that no gap resists, and boils as heat
    penetrates it between two mixings; its coefficient follows from the effusivity of solid and water unless
    measured. ``rate`` asks the other way round: how far an area dries.
    """

    wall_temperature: Temperature
    moisture_outlet: MoistureDryBasis
    pressure: Pressure
    particle_diameter: Length
    rotation_speed: TurningSpeed
    diameter: Length
    dry_mass_per_area: MassPerArea = 40.0
    bulk_density: Density = 700.0
    thermal_conductivity_bed: ThermalConductivity = 0.12
    mixing_factor: PositiveNumber = 9.0
    mixing_exponent: Ratio = 0.05
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    pasty_moisture: MoistureDryBasis | None = None
    heat_transfer_coefficient_paste: HeatTransferCoefficient | None = None
    thermal_conductivity_paste: ThermalConductivity = 0.6
    equilibrium_moisture: MoistureDryBasis = 0.0
    temperature_limit: Temperature | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit(
            "water evaporated per area", 1.0, 30.0, "kg/(m^2*hour)", "houdon2017; mujumdar2014, ch. 1"
        ),
        "time": Limit("residence time of the bed", 600.0, 36000.0, "s", "houdon2017"),
        "dry": Limit("moisture of the product above equilibrium", 0.0, 1e3, "kg/kg", "keey1978"),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    } | AS_SPECIFIED

    utilities: ClassVar[Utilities] = HEATED | AREA | VACUUM_KEPT | {"electric_power_drive": Utility(TURNED)}

    @classmethod
    def rate(cls, area: Any, feed: Stream, **parameters: Any) -> PaddleDryer:
        """The dryer with the moisture to which a heated area dries; its other parameters by name."""

        dryer = cls(moisture_outlet=DRIEST, **parameters)
        wettest = float(safe_divide(feed.liquid[0], feed.solid_flow))
        root = _driest(jnp.asarray(float(area)), feed, dryer)
        if not bool(root.converged):
            least, most = (float(eqx.tree_at(_moisture, dryer, X).area(feed)) for X in (wettest, DRIEST))
            raise ApplicabilityError(
                _(
                    "An area of {value} m² does not fit this feed: warming it takes {low} m², drying it "
                    "wholly {high} m²."
                ).format(
                    value=format_number(float(area), 3),
                    low=format_number(least, 3),
                    high=format_number(most, 3),
                ),
                name="area",
            )
        return eqx.tree_at(_moisture, dryer, float(jnp.exp(root.value)))

    def area(self, feed: Stream) -> Any:
        """Heated area that the feed needs, m²."""
        return self.inside(feed).area

    def curve(self, feed: Stream) -> ContactCurve:
        """Moisture, temperature, time and flux of the bed, from boiling on."""
        return self.inside(feed).curve

    def inside(self, feed: Stream) -> Heated:
        heat = self._heat(feed)
        paste = self._paste(feed, heat)
        curve = self._curve(feed, heat, paste)
        return Heated(heat, paste, curve, self._area(feed, heat, paste, curve))

    def _area(self, feed: Stream, heat: Heat, paste: Any, curve: ContactCurve) -> Any:
        """To warm the feed to boiling, by the wall and what lies on it, and to dry it."""
        boiling, wall, bed = heat[:3]
        series = 1.0 / (1.0 / wall + 1.0 / bed) if self.pasty_moisture is None else paste
        start = jnp.minimum(feed.temperature, boiling - 1e-6)
        mean = (boiling - start) / jnp.log(
            (self.wall_temperature - start) / (self.wall_temperature - boiling)
        )
        warm = (feed.enthalpy_at(boiling) - feed.enthalpy_at(start)) / (series * mean)
        return feed.solid_flow * curve.time[-1] / self.dry_mass_per_area + warm

    def _curve(self, feed: Stream, heat: Heat, paste: Any) -> ContactCurve:
        """Even steps of moisture as a paste, then as grains."""
        boiling, wall, bed, solid_heat, liquid_heat = heat
        latent = HumidMixture(feed.mixture, alone=True).heat_of_vaporization(boiling)
        X0 = safe_divide(feed.liquid[0], feed.solid_flow)
        X2 = jnp.minimum(self.moisture_outlet, X0)
        X1 = X0 if self.pasty_moisture is None else jnp.clip(self.pasty_moisture, X2, X0)
        dX = (X1 - X2) / STEPS

        def slopes(X: jax.Array, T: jax.Array) -> tuple[jax.Array, jax.Array, jax.Array]:
            """dT/d(−X), dt/d(−X) and flux."""
            p = penetration_drying(
                jnp.maximum(X, 1e-6), self.wall_temperature, T, wall, bed, solid_heat, latent
            )
            heat = p.heat_transfer_coefficient * (self.wall_temperature - T)
            warm = heat * (1.0 - p.latent_share) / (solid_heat + X * liquid_heat)
            return warm / p.drying_flux, self.dry_mass_per_area / p.drying_flux, p.drying_flux

        def step(carry: tuple, k: jax.Array) -> tuple:
            T, t = carry
            X = X1 - k * dX
            a, u, flux = slopes(X, T)
            b, v, _f = slopes(X - dX / 2, T + dX / 2 * a)
            c, w, _f = slopes(X - dX / 2, T + dX / 2 * b)
            d, x, _f = slopes(X - dX, T + dX * c)
            ahead = (T + dX / 6 * (a + 2 * b + 2 * c + d), t + dX / 6 * (u + 2 * v + 2 * w + x))
            return ahead, (X, T, t, flux)

        pasty = paste * (self.wall_temperature - boiling) / latent
        first = (X0 - X1) * self.dry_mass_per_area / pasty
        (T, t), (X, Ts, ts, fluxes) = jax.lax.scan(
            step, (boiling + 0.0 * X1, first), jnp.arange(STEPS, dtype=float)
        )
        pieces = [(X, Ts, ts, fluxes), tuple(jnp.reshape(a, (1,)) for a in (X2, T, t, slopes(X2, T)[2]))]
        if self.pasty_moisture is not None:
            share = jnp.arange(PASTY_STEPS) / PASTY_STEPS
            pieces.insert(
                0, (X0 - share * (X0 - X1), boiling + 0.0 * share, share * first, pasty + 0.0 * share)
            )
        return ContactCurve(*(jnp.concatenate(column) for column in zip(*pieces, strict=True)))

    def _paste(self, feed: Stream, heat: Heat) -> Any:
        """Coefficient of the paste, W/(m² K): heat that penetrates a mixture of solid and liquid while it
        rests.
        """
        if self.heat_transfer_coefficient_paste is not None:
            return jnp.asarray(self.heat_transfer_coefficient_paste)
        X = safe_divide(feed.liquid[0], feed.solid_flow)
        liquid_density = feed.mixture.densities("liquids", heat.boiling)[0]
        # J/(m³ K)
        held = (heat.capacity + X * heat.liquid_capacity) / (1.0 / feed.solid_density + X / liquid_density)
        return heat_transfer_coefficient_penetration(
            jnp.sqrt(held * self.thermal_conductivity_paste), self._contact()
        )

    def _heat(self, feed: Stream) -> Heat:
        humid = HumidMixture(feed.mixture, alone=True)
        boiling = humid.boiling_temperature(jnp.asarray(self.pressure))
        mean = 0.5 * (self.wall_temperature + boiling)
        if self.heat_transfer_coefficient is not None:
            wall = jnp.asarray(self.heat_transfer_coefficient)
        else:
            vapor = humid.fluid
            wall = heat_transfer_coefficient_wall_particles(
                self.particle_diameter,
                mean,
                self.pressure,
                vapor.vapor_conductivity.value(mean),
                molar_mass=vapor.molar_mass,
                specific_heat_capacity=vapor.vapor_heat_capacity.value(mean),
            )
        dry = feed.replace(liquid=jnp.zeros_like(feed.liquid), gas=jnp.zeros_like(feed.gas))
        capacity = (dry.enthalpy_at(boiling + 5.0) - dry.enthalpy_at(boiling - 5.0)) / (
            10.0 * feed.solid_flow
        )
        liquid = feed.mixture.liquids[0]
        liquid_capacity = (liquid.enthalpy(boiling + 5.0) - liquid.enthalpy(boiling - 5.0)) / 10.0
        effusivity = jnp.sqrt(self.bulk_density * capacity * self.thermal_conductivity_bed)
        return Heat(
            boiling,
            wall,
            heat_transfer_coefficient_penetration(effusivity, self._contact()),
            capacity,
            liquid_capacity,
        )

    def _contact(self) -> jax.Array:
        return contact_time_mixing(
            self.rotation_speed, self.diameter, self.mixing_factor, self.mixing_exponent
        )

    def outlets(self, inside: Heated, feed: Stream) -> ContactDried:
        bed = inside.curve
        product, vapor = boiled(
            feed, self.moisture_outlet, bed.temperature[-1], bed.temperature[0], self.pressure
        )
        return ContactDried(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: Heated, outlets: ContactDried, feed: Stream) -> PaddleFigures:
        boiling, wall, coefficient = inside.heat[:3]
        bed, area = inside.curve, inside.area
        water = evaporated(feed, outlets.product)
        time = area * self.dry_mass_per_area / feed.solid_flow
        return PaddleFigures(
            evaporation_rate=water,
            area=area,
            residence_time=time,
            solid_holdup=feed.solid_flow * time,
            evaporation_per_area=water / area,
            drying_flux_inlet=bed.flux[0],
            drying_flux_outlet=bed.flux[-1],
            heat_transfer_coefficient_wall=wall,
            heat_transfer_coefficient_bed=coefficient,
            heat_transfer_coefficient_paste=inside.paste,
            contact_time=self._contact(),
            boiling_temperature=boiling,
            temperature_product=bed.temperature[-1],
            energy_per_water=safe_divide(outlets.heat_duty, water),
        )

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        bed = made.inside.curve
        return {_("Profiles in a dryer"): contact_chart(bed.time, bed.moisture, bed.temperature)}

    def measured(
        self, inside: Heated, outlets: ContactDried, figures: PaddleFigures, feed: Stream
    ) -> dict[str, Any]:
        found = {
            "capacity": figures.evaporation_per_area * 3600.0,
            "time": figures.residence_time,
            "dry": self.moisture_outlet - self.equilibrium_moisture,
        } | as_specified(feed, self.moisture_outlet)
        if self.temperature_limit is not None:
            found["hot"] = figures.temperature_product - self.temperature_limit
        return found

    def drawn(
        self, inside: Heated, outlets: ContactDried, figures: PaddleFigures, feed: Stream
    ) -> dict[str, Any]:
        wet = figures.solid_holdup * (1.0 + 0.5 * (feed.moisture_dry_basis + self.moisture_outlet))
        turning = FRICTION * wet * STANDARD_GRAVITY * self.rotation_speed * 0.5 * self.diameter
        return heated(outlets.heat_duty, self.wall_temperature - HEAT_APPROACH) | {
            "electric_power_drive": driven(turning),
            "electric_power_vacuum": kept_empty(HOUSED * wet / self.bulk_density, self.pressure),
            "area_installed": inside.area,
        }


def _moisture(dryer: PaddleDryer) -> Any:
    return dryer.moisture_outlet


@ready
def _driest(area: Any, feed: Stream, dryer: PaddleDryer) -> Root:
    """Logarithm of the moisture to which an area dries."""

    def lack(x: Any) -> Any:
        return jnp.log(eqx.tree_at(_moisture, dryer, jnp.exp(x)).area(feed) / area)

    wettest = jnp.log(safe_divide(feed.liquid[0], feed.solid_flow))
    return find_root(lack, jnp.log(DRIEST), wettest, tolerance=1e-13)
