"""Tray oven: batches on trays in circulating air."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jax.core import Tracer

from granum.core import equipment
from granum.core.errors import ApplicabilityError, ConvergenceError, InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Fraction,
    HeatFlux,
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
    Ratio,
    SpecificEnergy,
    Speed,
    Temperature,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.formulas.assisted import wet_surface
from granum.drying.formulas.contact_drying import temperature_outlet_tray
from granum.drying.formulas.heat import heat_transfer_coefficient_parallel
from granum.drying.formulas.times import drying_time
from granum.drying.gas_solid.cells import Contact, Network
from granum.drying.gas_solid.column import Zone, mean_moisture, pass_zones
from granum.drying.gas_solid.dryer import ready
from granum.drying.gas_solid.kinetics import VanMeelKinetics
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.steam import is_steam
from granum.drying.wet_surface import AS_SPECIFIED, as_specified, boiled, dried_share, leaving
from granum.numerics import safe_divide
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, HEATED, HOT_GAS, fanned, heated, warmth

TRAY_HEADS = 10.0
FOLLOWED = (20, 60)  # cells along the air and steps of the load that is drawn
HEADS = "treybal1980, ch. 12, the speed only: ten velocity heads over the trays are our own estimate"
NO_STEAM = (
    "A tray oven is reckoned with air: for trays in superheated steam take a tunnel dryer, whose trays stay "
    "as long, or a belt."
)
_UNSOLVED = (
    "No temperature of the wet surface was found between −5 °C and boiling at which heat and evaporation "
    "agree: give hotter air, or less radiated heat."
)
_STARVED = (
    "The air over the trays does not carry the heat of that drying rate: give faster or hotter air, a wider "
    "gap, or shorter trays."
)
PositiveMassFlux = Annotated[MassFlux, Within(1e-9)]


class TrayDried(NamedTuple):
    """Dried product, exhaust air, heat of the heater net of losses."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class TrayFigures(NamedTuple):
    """Figures of a tray oven, means over the cycle where flows are meant."""

    drying_time: Time
    cycle_time: Time
    area: Area
    dry_solid_mass: Mass
    evaporation_rate: MassFlow
    drying_rate_constant: MassFlux
    heat_transfer_coefficient: HeatTransferCoefficient
    surface_temperature: Temperature
    humidity_ratio: HumidityRatio
    temperature_outlet: Temperature
    relative_humidity: Ratio
    recirculated_fraction: Ratio
    energy_per_water: SpecificEnergy


class Batch(NamedTuple):
    """The trays over time (steps × cells along the air), with the air as it leaves each cell."""

    time: Any
    moisture: Any
    temperature: Any
    gas_temperature: Any
    humidity: Any
    moisture_mean: Any
    drying_time: Any  # to the moisture wanted; not a number when the run is too short for it
    dry_gas: Any  # that passed, kg per kg of dry solid
    vapor: Any  # with that air as it leaves, kg per kg of dry solid
    gas_enthalpy: Any  # of that air as it leaves, J per kg of dry solid
    converged: Any  # whether every step was solved


class _Rest(eqx.Module):
    """An equilibrium moisture that hangs on nothing, asked for as an isotherm is."""

    value: Any

    def moisture(self, a: Any, T: Any) -> Any:
        """The same for every air."""
        return self.value + 0.0 * a


@equipment("tray_dryer", source="treybal1980, ch. 12; geankoplis2003, ch. 9", title="Tray oven")
class TrayDryer(Unit):
    """Batches on trays over which air of constant temperature circulates along the surface; the fresh air
    fixes its humidity.

    The air over the trays is as humid as the exhaust, on average over the cycle; it cools along each tray
    while the surface is wet at its wet bulb. Below the critical moisture the flux falls in a straight line to
    equilibrium. The heat transfer coefficient follows from the air speed unless it is given;
    ``radiated_heat`` is infrared or microwave heat per area that evaporates besides it. Trays dry from above,
    and from below too when ``sides`` is 2. ``drying_rate_constant``, the flux of the wet tray as measured,
    takes the place of transfer coefficient and radiated heat. Feed and gas flows are means over the cycle;
    the product leaves at the temperature of the air. ``batch`` follows a load in time, cell by cell along the
    air.
    """

    temperature_inlet: Temperature
    gas_velocity: Speed
    dry_mass_per_area: MassPerArea
    moisture_outlet: MoistureDryBasis
    critical_moisture: MoistureDryBasis
    equilibrium_moisture: MoistureDryBasis = 0.0
    isotherm: Annotated[Any, Law("isotherm")] = None
    heat_transfer_coefficient: HeatTransferCoefficient | None = None
    tray_length: Length = 0.6
    tray_gap: Length = 0.05
    sides: PositiveNumber = 1.0
    radiated_heat: HeatFlux = 0.0
    dead_time: Time = 1800.0
    heat_loss_share: Fraction = 0.0
    temperature_limit: Temperature | None = None
    drying_rate_constant: PositiveMassFlux | None = None

    limits: ClassVar[Limits] = {
        "speed": Limit("air speed over the trays", 0.5, 8.0, "m/s", "treybal1980, ch. 12"),
        "humid": Limit("relative humidity of the exhaust", 0.0, 0.9, "dimensionless", "mujumdar2014, ch. 1"),
        "reached": Limit(
            "moisture of the product above equilibrium with the hot air", 0.0, 1e3, "kg/kg", "keey1978"
        ),
        "recycle": Limit("recirculated share of the air", 0.0, 0.98, "dimensionless", "treybal1980, ch. 12"),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
        "energy": Limit("energy per water evaporated", 2.4e6, 9e6, "J/kg", "mujumdar2014, ch. 1"),
    } | (FLAMMABLE | AS_SPECIFIED)

    utilities: ClassVar[Utilities] = HEATED | HOT_GAS | AREA | {"electric_power_fan": Utility(HEADS)}

    def outlets(self, inside: dict[str, Any], feed: Stream, gas: Stream) -> TrayDried:
        product, vapor = boiled(
            feed, self.moisture_outlet, self.temperature_inlet, inside["T2"], gas.pressure
        )
        exhaust = vapor.replace(gas=vapor.gas + gas.gas)
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow - gas.enthalpy_flow
        return TrayDried(product, exhaust, duty)

    def inside(self, feed: Stream, gas: Stream) -> dict[str, Any]:
        """Air, flux and time."""
        T, humid = jnp.asarray(self.temperature_inlet), HumidMixture(gas.mixture)
        unsolved(~is_steam(gas), type(self).card, reason=NO_STEAM)
        water = leaving(feed, dried_share(feed, self.moisture_outlet))
        moist = gas.replace(gas=gas.gas.at[humid.vapor].add(water), temperature=T)
        w, c = humid.humidity_ratio(moist), moist.gas_heat_capacity
        flux = self.gas_velocity * moist.gas_density
        h = (
            heat_transfer_coefficient_parallel(flux)
            if self.heat_transfer_coefficient is None
            else jnp.asarray(self.heat_transfer_coefficient)
        )
        transfer = h / (humid.lewis_factor * c * (1.0 + w))
        wet = wet_surface(
            lambda Ts: h * (T - Ts) + self.radiated_heat,
            T,
            w,
            transfer,
            gas.pressure,
            humid.pair,
            humid.heat_of_vaporization,
        )
        unsolved(wet.converged, type(self).card, reason=_UNSOLVED)
        Tw = wet.value
        if self.drying_rate_constant is not None:
            h = self._from_rate(T, Tw, flux, c, humid.heat_of_vaporization(Tw))
        end = temperature_outlet_tray(T, Tw, h * self.sides, flux, self.tray_length, self.tray_gap, c)
        mean = flux * c * self.tray_gap * (T - end) / self.tray_length  # W per tray area, both sides
        N = (mean + self.radiated_heat) / humid.heat_of_vaporization(Tw)
        X1 = safe_divide(feed.liquid[0], feed.solid_flow)
        phi = jnp.clip(humid.relative_humidity(moist), 1e-3, 0.99)
        Xe = self.equilibrium_moisture if self.isotherm is None else self.isotherm(phi, T)
        time = drying_time(
            self.dry_mass_per_area, 1.0, N, X1, self.moisture_outlet, self.critical_moisture, Xe
        ).drying_time
        return {
            "w": w,
            "h": h,
            "Tw": Tw,
            "end": end,
            "N": N,
            "Xe": Xe,
            "time": time,
            "T2": end,
            "flux": flux,
            "water": water,
        }

    def _from_rate(self, T: Any, Tw: Any, flux: Any, c: Any, latent: Any) -> Any:
        """The transfer coefficient with which a tray dries at the measured rate; its wet bulb, without heat
        by other ways, is the same for every coefficient.
        """
        air = flux * self.tray_gap * c
        cooled = safe_divide(self.drying_rate_constant * latent * self.tray_length, air * (T - Tw))
        unsolved(cooled < 1.0, type(self).card, reason=_STARVED)
        return -jnp.log1p(-jnp.minimum(cooled, 1.0 - 1e-9)) * air / (self.tray_length * self.sides)

    def __check_init__(self) -> None:
        heat = self.radiated_heat
        apart = isinstance(heat, float | int) and heat != 0
        if self.drying_rate_constant is not None and (self.heat_transfer_coefficient is not None or apart):
            raise InputError(
                _(
                    "'drying_rate_constant' says how fast the wet tray dries by all ways together: leave out "
                    "'heat_transfer_coefficient' and 'radiated_heat'."
                ),
                name="drying_rate_constant",
            )

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, gas = inlets["feed"], inlets["gas"]
        heated_apart = float(self.radiated_heat) != 0.0
        time = float(made.figures.drying_time)
        if heated_apart or not (float(feed.liquid_flow) > 0.0 and 0.0 < time < math.inf):
            return {}
        load = _followed(self, feed, gas, jnp.asarray(1.2 * time), *FOLLOWED)
        if not bool(load.converged):
            return {}
        drawn = drawn_along(
            Axis("time", "Time", label=_("time since the trays came in")),
            load.time,
            (
                Axis("moisture_dry_basis", "MoistureDryBasis"),
                [
                    Curve(_("mean of the tray"), load.moisture_mean, "SOLID"),
                    Curve(_("where the air enters"), load.moisture[:, 0], "SOLID", "dash"),
                    Curve(_("where the air leaves"), load.moisture[:, -1], "SOLID", "dot"),
                ],
            ),
            (
                Axis("temperature", "Temperature", "degC", zero=False),
                [
                    Curve(_("product where the air leaves"), load.temperature[:, -1], "ACCENT"),
                    Curve(_("air as it leaves the trays"), load.gas_temperature[:, -1], "GAS", "dashdot"),
                ],
            ),
        )
        return {_("A load of the trays over time"): drawn}

    def batch(
        self, feed: Stream, gas: Stream, duration: Any = None, cells: int = 20, steps: int = 60
    ) -> Batch:
        """One load from cold, along the air and in time: the leading edge dries first, and the air that
        leaves changes as the load dries.

        The air enters as in the steady figures, hot and as humid as the exhaust is on average. Without a
        ``duration`` it is one and a half times the drying time of those figures.
        """
        if not isinstance(self.radiated_heat, float | int) or self.radiated_heat != 0:
            raise ApplicabilityError(
                _("A load is followed in time without radiated heat: set 'radiated_heat' to zero."),
                name="radiated_heat",
            )
        length = 1.5 * self.inside(feed, gas)["time"] if duration is None else duration
        found = _followed(self, feed, gas, length, cells, steps)
        if not isinstance(found.converged, Tracer) and not bool(found.converged):
            raise ConvergenceError(
                _("The load could not be followed to its end: take more 'steps', or a shorter 'duration'."),
                last=found,
            )
        return found

    def figures(self, inside: dict[str, Any], outlets: TrayDried, feed: Stream, gas: Stream) -> TrayFigures:
        s = inside
        cycle = s["time"] + self.dead_time
        dry = feed.solid_flow * cycle
        area = dry / self.dry_mass_per_area
        # air that passes over the trays while they dry, against the fresh air
        circulating = s["flux"] * self.tray_gap / self.tray_length * area / (1.0 + s["w"])
        duty = outlets.heat_duty / (1.0 - self.heat_loss_share)
        return TrayFigures(
            drying_time=s["time"],
            cycle_time=cycle,
            area=area,
            dry_solid_mass=dry,
            evaporation_rate=s["water"],
            drying_rate_constant=s["N"],
            heat_transfer_coefficient=s["h"],
            surface_temperature=s["Tw"],
            humidity_ratio=s["w"],
            temperature_outlet=s["end"],
            relative_humidity=HumidMixture(gas.mixture).relative_humidity(outlets.exhaust),
            recirculated_fraction=1.0 - safe_divide(HumidMixture(gas.mixture).dry_flow(gas), circulating),
            energy_per_water=safe_divide(duty, s["water"]),
        )

    def measured(
        self, inside: dict[str, Any], outlets: TrayDried, figures: TrayFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        found = {
            "speed": self.gas_velocity,
            "humid": figures.relative_humidity,
            "reached": self.moisture_outlet - inside["Xe"],
            "recycle": figures.recirculated_fraction,
        } | (flammable(outlets.exhaust) | as_specified(feed, self.moisture_outlet))
        if HumidMixture(gas.mixture).solvent == "water":
            found["energy"] = figures.energy_per_water
        if self.temperature_limit is not None:
            found["hot"] = self.temperature_inlet - self.temperature_limit
        return found

    def drawn(
        self, inside: dict[str, Any], outlets: TrayDried, figures: TrayFigures, feed: Stream, gas: Stream
    ) -> dict[str, Any]:
        s, share = inside, inside["time"] / figures.cycle_time
        over = s["flux"] / self.gas_velocity  # density, kg/m³
        section = self.tray_gap / self.tray_length * figures.area
        lost = TRAY_HEADS * 0.5 * over * self.gas_velocity**2
        duty = outlets.heat_duty / (1.0 - self.heat_loss_share)
        return (
            heated(duty, self.temperature_inlet)
            | warmth(gas)
            | {
                "electric_power_fan": fanned(self.gas_velocity * section * share, lost),
                "area_installed": figures.area,
            }
        )


@ready
def _followed(tray: TrayDryer, feed: Stream, gas: Stream, duration: Any, cells: int, steps: int) -> Batch:
    """Cells of standing solid along the air; each dries at the rate of the wet bulb of its own air, and below
    the critical moisture in proportion.
    """
    s = tray.inside(feed, gas)
    T, w = jnp.asarray(tray.temperature_inlet), s["w"]
    isotherm = _Rest(jnp.asarray(tray.equilibrium_moisture)) if tray.isotherm is None else tray.isotherm
    exchange = s["h"] * tray.sides / tray.dry_mass_per_area
    like = Contact(
        Matter.of(feed, gas).blended(feed),
        VanMeelKinetics(tray.critical_moisture, isotherm=isotherm),
        jnp.full((cells, 1), 1.0 / cells),
        jnp.zeros((cells, 1)),
        1.0,
        Network.co_current(cells),
        lambda X, Ts, Tg, Y: exchange,
    )
    per_solid = s["flux"] / (1.0 + w) * tray.tray_gap / (tray.tray_length * tray.dry_mass_per_area)
    (found,) = pass_zones(
        like, feed.moisture_dry_basis, feed.temperature, [Zone(duration, per_solid, False, w, T)], steps
    )
    mean, layers = mean_moisture(like, found), found.layers
    times, fallen = jnp.append(0.0, found.time), jnp.append(feed.moisture_dry_basis, mean)
    reached = jnp.interp(-tray.moisture_outlet, -fallen, times, right=jnp.nan)
    return Batch(
        found.time,
        layers.moisture[..., 0],
        layers.temperature[..., 0],
        layers.gas_temperature,
        layers.humidity,
        mean,
        reached,
        per_solid * duration,
        found.vapor,
        found.gas_enthalpy,
        jnp.all(layers.converged),
    )
