"""Racks, or a floor, on which layers dry in the still air of a room."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import (
    Area,
    Fraction,
    HeatTransferCoefficient,
    HumidityRatio,
    Law,
    Length,
    Mass,
    MassFlow,
    MassFlux,
    MassPerArea,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Ratio,
    RelativeHumidity,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.drying.formulas.assisted import COLDEST, COLDEST_WATER
from granum.drying.formulas.still_air import RoomAir, StillSurface, still_surface, view_factor_rack
from granum.drying.formulas.times import drying_time
from granum.drying.gas_solid.steam import is_steam
from granum.drying.wet_surface import AS_SPECIFIED, as_specified, boiled, evaporated
from granum.numerics import find_root, safe_divide
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, HEATED, heated

LITTLE = 1e-4  # kg/kg, of humidity between the room and the air outside
WARMER = 1e-3  # K, of the room above the coldest surface that is sought
NO_STEAM = "Racks in a room dry in air: give fresh air at the port 'gas'. In steam a tunnel or a belt dries."
SATURATED = (
    "The fresh air does not carry the vapor away: the room would be foggy. Give more air at the port 'gas', "
    "drier air, or a warmer room ('temperature_room')."
)
TOO_COLD = (
    "The surface would freeze: drying in still air is reckoned with liquid water. Give warmer air, or heat "
    "the room ('temperature_room')."
)
TOO_DAMP = (
    "In a room so humid the product does not get that dry: its equilibrium moisture lies above "
    "'moisture_outlet'. Give more or drier air, a warmer room ('temperature_room'), or a higher moisture."
)
TOO_HOT = "A room as hot as the liquid boils is none: give a lower temperature."


class StillDried(NamedTuple):
    """Dry product, the air that leaves the room, and heat that keeps the room warm."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class StillAirFigures(NamedTuple):
    """Figures of racks in still air; flows are means over the cycle."""

    drying_time: Time
    cycle_time: Time
    area: Area
    area_floor: Area
    dry_solid_mass: Mass
    evaporation_rate: MassFlow
    evaporation_rate_highest: MassFlow
    drying_rate_constant: MassFlux
    heat_transfer_coefficient: HeatTransferCoefficient
    surface_temperature: Temperature
    temperature_room: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: Ratio
    equilibrium_moisture: MoistureDryBasis
    gas_flow_vented: MassFlow
    heat_duty: Power
    energy_per_water: SpecificEnergy


class Room(NamedTuple):
    """The air of the room, the wet surface in it, equilibrium, time and whether anything dries."""

    air: Stream
    surface: StillSurface
    equilibrium: Any
    time: Any
    dries: Any


@equipment(
    "still_air_dryer",
    source="mcadams1954; incropera2007, ch. 9; treybal1980, ch. 12; shah2014",
    title="Racks in still air",
)
class StillAirDryer(Unit):
    """Layers on the trays of racks, or on a floor, dry in the air of a room that no fan moves: the cold heavy
    air at their surfaces creeps off and drafts do the rest.

    The room is mixed, and as humid as the air that leaves it on average; its racks are filled one after
    another. ``temperature_room`` is kept by heating; without it the room is not heated, and cools until the
    fresh air brings the heat. Heat comes by natural convection, of heat and vapor together, or by a draft of
    ``gas_velocity`` where that is more, and from walls as warm as the room, of which a tray sees what
    ``tray_gap`` leaves open; without ``tray_gap`` it lies alone, as on a floor. Above the critical moisture
    the surface is wet; below it the flux falls in a straight line to equilibrium. ``sides`` is 1 for trays
    and a floor, up to 2 for nets. Heat through a bare tray, sun, wind and what moves inside the layer are
    left out: for sun and wind there is ``drying.drying_flux_penman``, for a fan the tray oven. Warm pools in
    quiet air evaporate so within the 18 % of Shah (2014); where the air barely rises they lose up to 30 %
    more than is reckoned, for rooms have drafts. The feed's flow is the mean over the cycle and fixes the
    area.
    """

    dry_mass_per_area: MassPerArea
    moisture_outlet: MoistureDryBasis
    critical_moisture: MoistureDryBasis
    equilibrium_moisture: MoistureDryBasis = 0.0
    isotherm: Annotated[Any, Law("isotherm")] = None
    temperature_room: Temperature | None = None
    tray_length: Length = 0.9
    tray_width: Length = 0.6
    tray_gap: Length | None = None
    sides: Annotated[PositiveNumber, Within(1.0, 2.0)] = 1.0
    tier_count: Annotated[PositiveNumber, Within(1.0)] = 1.0
    gas_velocity: Speed = 0.1
    emissivity: Fraction = 0.9
    dead_time: Time = 3600.0
    relative_humidity_limit: RelativeHumidity = 0.7

    limits: ClassVar[Limits] = {
        "still": Limit("draft over the trays", 0.0, 0.5, "m/s", "treybal1980, ch. 12"),
        "humid": Limit(
            "relative humidity of the room", 0.0, "relative_humidity_limit", "dimensionless", "beuchat1981"
        ),
        "film": Limit(
            "gap between trays over the two films in it", 1.0, 1e6, "dimensionless", "incropera2007, ch. 9"
        ),
    } | (FLAMMABLE | AS_SPECIFIED)

    utilities: ClassVar[Utilities] = HEATED | AREA

    def inside(self, feed: Stream, gas: Stream) -> Room:
        humid, card = HumidMixture(gas.mixture), type(self).card
        unsolved(~is_steam(gas), card, reason=NO_STEAM)
        coldest = COLDEST_WATER if humid.solvent == "water" else COLDEST
        product, vapor = self.parted(feed, gas, gas.temperature, gas.temperature)
        air = vapor.replace(gas=vapor.gas + gas.gas)
        if self.temperature_room is None:
            brought = feed.enthalpy_flow + gas.enthalpy_flow
            mixed = air.replace(solid=product.solid, liquid=product.liquid)
            # with too little air nothing warmer than this brings the heat
            enough = mixed.enthalpy_at(coldest) < brought
            T = jnp.where(enough, mixed.at_enthalpy(brought).temperature, coldest)
        else:
            T = jnp.asarray(self.temperature_room, dtype=float)
        P = jnp.asarray(gas.pressure, dtype=float)
        boils = humid.boiling_temperature(P)
        given, T = T, jnp.clip(T, coldest + WARMER, boils - 1.0)
        air = air.replace(temperature=T, pressure=P)
        phi = humid.relative_humidity(air)
        carried = (phi < 1.0) & (humid.dry_flow(air) > 0.0)
        unsolved(carried, card, reason=SATURATED)
        unsolved(given > coldest + WARMER, card, reason=TOO_COLD)
        unsolved(given < boils - 1.0, card, reason=TOO_HOT)
        surface = self.wet(humid, air, coldest)
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        Xe = (
            jnp.asarray(self.equilibrium_moisture, dtype=float)
            if self.isotherm is None
            else self.isotherm(jnp.clip(phi, 1e-3, 0.99), T)
        )
        dries = self.moisture_outlet < X1
        reached = ~dries | (Xe < self.moisture_outlet)
        unsolved(reached | ~carried, card, reason=TOO_DAMP)
        time = drying_time.function(
            self.dry_mass_per_area,
            1.0,
            jnp.where(surface.flux > 0.0, surface.flux, 1.0),
            X1,
            jnp.minimum(self.moisture_outlet, X1),
            self.critical_moisture,
            jnp.where(reached, Xe, 0.0),
        ).drying_time
        return Room(air, surface, Xe, jnp.where(dries, time, 0.0), dries)

    def over_trays(self, humid: HumidMixture, air: Stream) -> RoomAir:
        """The air of the room as the trays have it."""
        vapor, y = humid.molar_masses[humid.vapor], humid.fraction(air)
        mean = safe_divide(air.gas_flow, jnp.sum(air.gas / humid.molar_masses), 0.03)
        dry = (mean - y * vapor) / jnp.maximum(1.0 - y, 1e-6)

        def saturated(Ts: Any) -> Any:
            return jnp.minimum(humid.pair.saturated_fraction(Ts, air.pressure, False), 1.0 - 1e-6)

        some = air.replace(gas=jnp.where(air.gas_flow > 0.0, air.gas, 1.0))
        return RoomAir(
            air.temperature,
            y,
            some.gas_density,
            some.gas_viscosity,
            some.gas_conductivity,
            some.gas_heat_capacity,
            dry,
            vapor,
            self.tray_length * self.tray_width / (2.0 * (self.tray_length + self.tray_width)),
            jnp.minimum(self.tray_length, self.tray_width),
            self.gas_velocity,
            humid.lewis_factor,
            saturated,
        )

    def wet(self, humid: HumidMixture, air: Stream, coldest: Any) -> StillSurface:
        """The wet surface in the room."""
        seen = 1.0 if self.tray_gap is None else view_factor_rack.function(self.tray_gap, self.tray_width)
        found = still_surface(
            self.over_trays(humid, air),
            self.sides,
            self.emissivity * seen,
            humid.heat_of_vaporization,
            jnp.asarray(coldest),
        )
        unsolved(found.found, type(self).card, reason=TOO_COLD)
        return found

    def parted(self, feed: Stream, gas: Stream, T_product: Any, T_vapor: Any) -> tuple[Stream, Stream]:
        """Product and vapor."""
        return boiled(feed, self.moisture_outlet, T_product, T_vapor, gas.pressure)

    def outlets(self, inside: Room, feed: Stream, gas: Stream) -> StillDried:
        T = inside.air.temperature
        product, _vapor = self.parted(feed, gas, T, T)
        exhaust = inside.air
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow
        return StillDried(product, exhaust, 0.0 * duty if self.temperature_room is None else duty)

    def figures(self, inside: Room, outlets: StillDried, feed: Stream, gas: Stream) -> StillAirFigures:
        humid = HumidMixture(gas.mixture)
        water = evaporated(feed, outlets.product)
        cycle = inside.time + self.dead_time
        dry = feed.solid_flow * cycle
        area = dry / self.dry_mass_per_area
        surface = inside.surface
        return StillAirFigures(
            drying_time=inside.time,
            cycle_time=cycle,
            area=area,
            area_floor=area / self.tier_count,
            dry_solid_mass=dry,
            evaporation_rate=water,
            evaporation_rate_highest=surface.flux * area,
            drying_rate_constant=surface.flux,
            heat_transfer_coefficient=surface.heat_transfer / self.sides,
            surface_temperature=surface.surface_temperature,
            temperature_room=inside.air.temperature,
            humidity_ratio=humid.humidity_ratio(inside.air),
            relative_humidity=humid.relative_humidity(inside.air),
            equilibrium_moisture=inside.equilibrium,
            gas_flow_vented=self.vented(humid, inside, outlets.product, feed, gas),
            heat_duty=outlets.heat_duty,
            energy_per_water=safe_divide(jnp.maximum(outlets.heat_duty, 0.0), water),
        )

    def vented(self, humid: HumidMixture, inside: Room, product: Stream, feed: Stream, gas: Stream) -> Any:
        """Fresh air with which the room is as humid as it may be, kg/s; a room that is not heated gets the
        colder the less there is.
        """
        water, over = evaporated(feed, product), self.over_trays(humid, inside.air)
        fresh = humid.humidity_ratio(gas)

        def asked(T: Any) -> Any:
            allowed = over.humidity(self.relative_humidity_limit * over.saturated(T))
            return water / jnp.maximum(allowed - fresh, LITTLE) * (1.0 + fresh)

        if self.temperature_room is not None:
            return asked(inside.air.temperature)
        vapor = inside.air.gas - gas.gas

        def surplus(T: Any) -> Any:
            blown = safe_divide(asked(T), gas.gas_flow)
            room = inside.air.replace(gas=vapor + blown * gas.gas, solid=product.solid, liquid=product.liquid)
            brought = feed.enthalpy_flow + blown * gas.enthalpy_flow
            return (room.enthalpy_at(T) - brought) / jnp.maximum(water * 1e6, 1e-12)

        warmest = jnp.maximum(gas.temperature, feed.temperature)
        return asked(find_root(surplus, COLDEST, warmest, start=inside.air.temperature).value)

    def measured(
        self, inside: Room, outlets: StillDried, figures: StillAirFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        found = {
            "still": self.gas_velocity,
            "humid": figures.relative_humidity,
        } | (flammable(outlets.exhaust) | as_specified(feed, self.moisture_outlet))
        if self.tray_gap is not None:
            film = inside.air.gas_conductivity / figures.heat_transfer_coefficient
            found["film"] = self.tray_gap / (2.0 * film)
        return found

    def drawn(
        self, inside: Room, outlets: StillDried, figures: StillAirFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        return heated(outlets.heat_duty, figures.temperature_room) | {"area_installed": figures.area}
