"""Drum (heated-cylinder) dryer: a film on a steam-heated cylinder, scraped off dry."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Fraction,
    HeatTransferCoefficient,
    Length,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    Power,
    PowerPerArea,
    Pressure,
    Ratio,
    SpecificEnergy,
    Temperature,
    Time,
    TurningSpeed,
    Within,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.drying.formulas.contact_drying import moisture_dry_basis_after
from granum.drying.formulas.scrapers import shaft_power_scraper
from granum.drying.wet_surface import boiled, evaporated
from granum.materials.formulas.steam import water_heat_of_vaporization
from granum.materials.formulas.water import water_boiling_temperature
from granum.numerics import safe_divide
from granum.settling.kinds import LineLoad
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import (
    AREA,
    DRIVE,
    HEAT_APPROACH,
    HEATED,
    VACUUM_KEPT,
    driven,
    heated,
    kept_empty,
)

HOUSED = 3.0  # times their own volume, the housing of cylinders under vacuum


class ContactDried(NamedTuple):
    """Dried product, vapor, and the heat of wall or steam net of losses."""

    product: Stream
    vapor: Stream
    heat_duty: Any


class DrumFigures(NamedTuple):
    """Figures of a drum dryer."""

    moisture_dry_basis: MoistureDryBasis
    evaporation_rate: MassFlow
    area: Area
    contact_time: Time
    dry_mass_per_area: MassPerArea
    drying_flux: MassFlux
    evaporation_per_area: MassFlux
    wall_temperature: Temperature
    boiling_temperature: Temperature
    mass_flow_steam: MassFlow
    steam_per_water: Ratio
    energy_per_water: SpecificEnergy
    shaft_power: Power


@equipment("drum_dryer", source="mujumdar2014, ch. 9; treybal1980, ch. 12", title="Drum (cylinder) dryer")
class DrumDryer(Unit):
    """A film or web wrapped on a steam-heated cylinder: it warms up, boils at a constant rate, then dries at
    a falling one, and is scraped off.

    The coefficient is the overall one from steam to film. Below the critical moisture the flux falls in a
    straight line to zero at equilibrium. The film covers ``wrapped_fraction`` of the turn; turning faster
    makes it thinner for a shorter time, so that the moisture reached hangs on area and steam alone. The
    product leaves between boiling and wall temperature, the closer to the wall the drier it is.
    ``heat_loss_share`` is of the steam's heat. The shaft drags its surface under the scraper, whose
    ``blade_load`` and ``friction_coefficient`` are those of knives that lift a sheet (the latter 0 where a
    web leaves by itself); ``drive_power_per_area`` is what rolls that feed, bearings and discharge take
    besides, some third of the motors that makers install on such drums (from memory 1.2 to 2 kW/m²; our own
    estimate). Several cylinders (``cylinder_count``, two of a twin or double drum) share the feed and are
    alike. A ``pressure`` below the atmosphere's is that of a housing under vacuum, three times as large as
    the cylinders (our own estimate): the film boils colder, the vapor leaves at that pressure for a condenser
    of the line, and a pump draws off the air that leaks in.
    """

    diameter: Length
    width: Length
    rotation_speed: TurningSpeed
    pressure_steam: Pressure
    heat_transfer_coefficient: HeatTransferCoefficient = 1200.0
    wrapped_fraction: Fraction = 0.75
    critical_moisture: MoistureDryBasis = 0.3
    equilibrium_moisture: MoistureDryBasis = 0.0
    heat_loss_share: Fraction = 0.1
    temperature_limit: Temperature | None = None
    blade_load: LineLoad = 2000.0
    friction_coefficient: Ratio = 0.2
    drive_power_per_area: PowerPerArea = 500.0
    cylinder_count: Annotated[int, Within(1, 20)] = 1
    pressure: Annotated[Pressure, Within(500.0, 1.1e5)] = STANDARD_ATMOSPHERE

    limits: ClassVar[Limits] = {
        "capacity": Limit(
            "water evaporated per area", 15.0, 80.0, "kg/(m^2*hour)", "houdon2017; mujumdar2014, ch. 9"
        ),
        "time": Limit("contact time on the drum", 3.0, 30.0, "s", "houdon2017"),
        "steam": Limit("temperature of the heating surface", 100.0, 180.0, "degC", "houdon2017"),
        "ratio": Limit("steam per water evaporated", 1.1, 1.6, "dimensionless", "mujumdar2014, ch. 9"),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    }

    utilities: ClassVar[Utilities] = HEATED | AREA | DRIVE | VACUUM_KEPT

    def inside(self, feed: Stream) -> dict[str, Any]:
        """What happens to the film on its way."""
        humid = HumidMixture(feed.mixture, alone=True)
        boiling = humid.boiling_temperature(jnp.asarray(self.pressure) + 0.0 * feed.pressure)
        wall = water_boiling_temperature(self.pressure_steam)
        latent = humid.heat_of_vaporization(boiling)
        area = self.cylinder_count * jnp.pi * self.diameter * self.width
        turn = 2.0 * jnp.pi / self.rotation_speed
        load = feed.solid_flow * turn / area
        contact = self.wrapped_fraction * turn
        U = jnp.asarray(self.heat_transfer_coefficient)
        warm = feed.enthalpy_at(boiling) - feed.enthalpy_flow  # W, spread over the wrapped area
        start = jnp.minimum(feed.temperature, boiling)
        mean = (boiling - start) / jnp.log(jnp.maximum((wall - start) / (wall - boiling), 1.0 + 1e-9))
        heating = warm * turn / area / (U * jnp.maximum(mean, 1e-6))
        N = U * (wall - boiling) / latent
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        X2 = moisture_dry_basis_after(
            X1,
            jnp.maximum(contact - heating, 0.0),
            N,
            load,
            self.critical_moisture,
            self.equilibrium_moisture,
        )
        below = jnp.asarray(self.critical_moisture) - X2
        dryness = jnp.clip(safe_divide(below, self.critical_moisture, 0.0), 0.0, 1.0)
        T2 = boiling + dryness * (wall - boiling)
        return {
            "boiling": boiling,
            "wall": wall,
            "area": area,
            "load": load,
            "contact": contact,
            "N": N,
            "X2": X2,
            "T2": T2,
            "heating": heating,
            "turn": turn,
        }

    @classmethod
    def size(
        cls,
        moisture_outlet: Any,
        feed: Stream,
        diameter: Any,
        rotation_speed: Any,
        pressure_steam: Any,
        **more: Any,
    ) -> DrumDryer:
        """The width of drums of given diameter that a product moisture needs: warming, constant and falling
        rate, each in closed form.
        """
        first = cls(diameter, 1.0, rotation_speed, pressure_steam, **more)
        film = first.inside(feed)
        X1, Xc, Xe = (
            safe_divide(feed.liquid[0], feed.solid_flow),
            first.critical_moisture,
            first.equilibrium_moisture,
        )
        if not Xe < float(moisture_outlet) < float(X1):
            raise InputError(
                _(
                    "A drum dries to a moisture between equilibrium ({low} kg/kg) and the feed ({high} "
                    "kg/kg), not to {value}."
                ).format(
                    low=format_number(Xe, 3),
                    high=format_number(float(X1), 3),
                    value=format_number(float(moisture_outlet), 3),
                ),
                name="moisture_outlet",
            )
        upper = jnp.minimum(X1, Xc)
        ways = jnp.maximum(X1 - jnp.maximum(Xc, moisture_outlet), 0.0)
        ways = ways + jnp.where(
            moisture_outlet < upper,
            (upper - Xe) * jnp.log((upper - Xe) / (jnp.minimum(moisture_outlet, upper) - Xe)),
            0.0,
        )
        # time on the drum is turn · wrapped fraction; warming and drying both take turn/area times a number
        per_area = film["heating"] * film["area"] / film["turn"] + feed.solid_flow * ways / film["N"]
        area = per_area / first.wrapped_fraction
        around = first.cylinder_count * jnp.pi * first.diameter
        return cls(diameter, float(area / around), rotation_speed, pressure_steam, **more)

    def outlets(self, inside: dict[str, Any], feed: Stream) -> ContactDried:
        film = inside
        product, vapor = boiled(feed, film["X2"], film["T2"], film["boiling"], self.pressure)
        return ContactDried(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: dict[str, Any], outlets: ContactDried, feed: Stream) -> DrumFigures:
        film = inside
        water = evaporated(feed, outlets.product)
        duty = outlets.heat_duty / (1.0 - self.heat_loss_share)
        steam = duty / water_heat_of_vaporization(film["wall"])
        return DrumFigures(
            moisture_dry_basis=film["X2"],
            evaporation_rate=water,
            area=film["area"],
            contact_time=film["contact"],
            dry_mass_per_area=film["load"],
            drying_flux=film["N"],
            evaporation_per_area=water / film["area"],
            wall_temperature=film["wall"],
            boiling_temperature=film["boiling"],
            mass_flow_steam=steam,
            steam_per_water=safe_divide(steam, water),
            energy_per_water=safe_divide(duty, water),
            shaft_power=self.cylinder_count
            * shaft_power_scraper.function(
                self.diameter,
                self.width,
                self.rotation_speed,
                self.blade_load,
                self.friction_coefficient,
            ),
        )

    def measured(
        self, inside: dict[str, Any], outlets: ContactDried, figures: DrumFigures, feed: Stream
    ) -> dict[str, Any]:
        found = {
            "capacity": figures.evaporation_per_area * 3600.0,
            "time": figures.contact_time,
            "steam": figures.wall_temperature - 273.15,
        }
        if feed.mixture.liquids[0].name == "water":
            found["ratio"] = figures.steam_per_water
        if self.temperature_limit is not None:
            found["hot"] = outlets.product.temperature - self.temperature_limit
        return found

    def drawn(
        self, inside: dict[str, Any], outlets: ContactDried, figures: DrumFigures, feed: Stream
    ) -> dict[str, Any]:
        steam = outlets.heat_duty / (1.0 - self.heat_loss_share)
        housing = HOUSED * 0.25 * figures.area * self.diameter
        return heated(steam, figures.wall_temperature - HEAT_APPROACH) | {
            "electric_power_drive": driven(figures.shaft_power) + self.drive_power_per_area * figures.area,
            "electric_power_vacuum": kept_empty(housing, self.pressure),
            "area_installed": figures.area,
        }
