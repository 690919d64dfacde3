"""Paddle, screw, disc or drum contact dryer: an agitated bed on heated walls, under vacuum or not (penetration model)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import jax
import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import (
    Area,
    Density,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MoistureDryBasis,
    PositiveNumber,
    Pressure,
    Ratio,
    RotationSpeed,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
)  # fmt: skip
from granum.drying.equipment.drum import ContactDried
from granum.drying.formulas.contact_drying import contact_time_mixing, heat_transfer_coefficient_wall_particles, penetration_drying
from granum.drying.formulas.heat import heat_transfer_coefficient_penetration
from granum.drying.quantities import MassPerArea
from granum.drying.wet_surface import boiled
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.materials.formulas.water import water_boiling_temperature
from granum.numerics import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Check, Unit

STEPS = 40
LIQUID_HEAT = 4187.0
_CAPACITY, _TIME = "water evaporated per area", "residence time of the bed"
_LIMIT, _DRY = "product temperature over its limit", "moisture of the product above equilibrium"


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
    contact_time: Time
    boiling_temperature: Temperature
    temperature_product: Temperature
    energy_per_water: SpecificEnergy


@equipment("paddle_dryer", source="mollekopf1984; vdi2010, ch. Mc", title="Paddle or screw dryer (contact)")
class PaddleDryer(Unit):
    """An agitated bed that boils on heated walls: found is the area, or the batch time, to dry to the moisture wanted.

    Heat passes the wall's gap, then penetrates the resting bed behind a drying front until it is mixed again (Schlünder and Mollekopf).
    What does not evaporate warms the bed. Continuous dryers are taken in plug flow, which the paddles of one shaft nearly give; a batch is
    the same curve in time. Under vacuum the pressure sets the boiling temperature. Properties are those of the dry bed; non-hygroscopic
    product. ``dry_mass_per_area`` is the hold-up per heated area. Mixing numbers are those of paddles unless given.
    """

    wall_temperature: Temperature
    moisture_outlet: MoistureDryBasis
    pressure: Pressure
    particle_diameter: Length
    rotation_speed: RotationSpeed
    diameter: Length
    dry_mass_per_area: MassPerArea = 40.0
    bulk_density: Density = 700.0
    thermal_conductivity_bed: ThermalConductivity = 0.12
    mixing_factor: PositiveNumber = 9.0
    mixing_exponent: Ratio = 0.05
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    equilibrium_moisture: MoistureDryBasis = 0.0
    temperature_limit: Temperature | None = None

    def curve(self, feed: Stream) -> ContactCurve:
        """Moisture, temperature, time and flux of the bed, in even steps of moisture, from boiling on."""
        boiling, wall, bed, solid_heat = self._heat(feed)
        latent = water_heat_of_vaporization(boiling)
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        X2 = jnp.minimum(self.moisture_outlet, X1)
        dX = (X1 - X2) / STEPS

        def slopes(X: jax.Array, T: jax.Array) -> tuple[jax.Array, jax.Array, jax.Array]:
            """dT/d(−X), dt/d(−X) and flux."""
            p = penetration_drying(jnp.maximum(X, 1e-6), self.wall_temperature, T, wall, bed, solid_heat, latent)
            heat = p.heat_transfer_coefficient * (self.wall_temperature - T)
            warm = heat * (1.0 - p.latent_share) / (solid_heat + X * LIQUID_HEAT)
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

        (T, t), (X, Ts, ts, fluxes) = jax.lax.scan(step, (boiling + 0.0 * X1, 0.0 * X1), jnp.arange(STEPS, dtype=float))
        last = slopes(X2, T)[2]
        return ContactCurve(*(jnp.concatenate([a, jnp.reshape(b, (1,))]) for a, b in ((X, X2), (Ts, T), (ts, t), (fluxes, last))))

    def _heat(self, feed: Stream) -> tuple[jax.Array, jax.Array, jax.Array, jax.Array]:
        """Boiling temperature, coefficients of wall and of bed, heat capacity of the dry solid."""
        boiling = water_boiling_temperature(self.pressure)
        mean = 0.5 * (self.wall_temperature + boiling)
        wall = (
            heat_transfer_coefficient_wall_particles(self.particle_diameter, mean, self.pressure)
            if self.heat_transfer_coefficient is None
            else jnp.asarray(self.heat_transfer_coefficient)
        )
        dry = feed.replace(liquid=jnp.zeros_like(feed.liquid), gas=jnp.zeros_like(feed.gas))
        capacity = (dry.enthalpy_at(boiling + 5.0) - dry.enthalpy_at(boiling - 5.0)) / (10.0 * feed.solid_flow)
        effusivity = jnp.sqrt(self.bulk_density * capacity * self.thermal_conductivity_bed)
        return boiling, wall, heat_transfer_coefficient_penetration(effusivity, self._contact()), capacity

    def _contact(self) -> jax.Array:
        return contact_time_mixing(self.rotation_speed, self.diameter, self.mixing_factor, self.mixing_exponent)

    def __call__(self, feed: Stream) -> ContactDried:
        bed = self.curve(feed)
        product, vapor = boiled(feed, self.moisture_outlet, bed.temperature[-1], bed.temperature[0], self.pressure)
        return ContactDried(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def results(self, inlets: Mapping[str, Stream], outlets: ContactDried) -> PaddleFigures:
        feed = inlets["feed"]
        boiling, wall, coefficient, _capacity = self._heat(feed)
        bed = self.curve(feed)
        water = feed.liquid[0] - outlets.product.liquid[0]
        # warming up the feed to its boiling point: by the wall and the bed in series
        series = 1.0 / (1.0 / wall + 1.0 / coefficient)
        start = jnp.minimum(feed.temperature, boiling - 1e-6)
        mean = (boiling - start) / jnp.log((self.wall_temperature - start) / (self.wall_temperature - boiling))
        warm = (feed.enthalpy_at(boiling) - feed.enthalpy_at(start)) / (series * mean)
        area = feed.solid_flow * bed.time[-1] / self.dry_mass_per_area + warm
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
            contact_time=self._contact(),
            boiling_temperature=boiling,
            temperature_product=bed.temperature[-1],
            energy_per_water=safe_divide(outlets.heat_duty, water),
        )

    def checks(self, inlets: Mapping[str, Stream], outlets: ContactDried) -> tuple[Check, ...]:
        figures = self.results(inlets, outlets)
        found = [
            Check(_CAPACITY, figures.evaporation_per_area * 3600.0, 1.0, 30.0, "kg/(m^2*hour)", "houdon2017; mujumdar2014, ch. 1"),
            Check(_TIME, figures.residence_time, 600.0, 36000.0, "s", "houdon2017"),
            Check(_DRY, self.moisture_outlet - self.equilibrium_moisture, 0.0, 1e3, "kg/kg", "keey1978"),
        ]
        if self.temperature_limit is not None:
            found.append(Check(_LIMIT, figures.temperature_product - self.temperature_limit, -jnp.inf, 0.0, "delta_degC", "bonazzi2003"))
        return tuple(found)
