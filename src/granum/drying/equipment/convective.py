"""A convective dryer by balance alone, in a flowsheet: any type, as far as its streams go."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    HumidityRatio,
    Law,
    MassFlow,
    MoistureDryBasis,
    Number,
    Power,
    Ratio,
    RelativeHumidity,
    SpecificEnergy,
    SpecificMoistureExtraction,
    Temperature,
)
from granum.core.limits import Limit
from granum.drying.equipment.well_mixed import evaporate
from granum.drying.kinds import LostHeat
from granum.drying.wet_surface import AS_SPECIFIED, evaporated
from granum.numerics import find_root, safe_divide
from granum.streams.atmosphere import FLAMMABLE, flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import FANNED, HEATED, HOT_GAS, driven, heated, warmth

COLDEST, HOTTEST = 200.0, 1200.0  # K, bracket of the exhaust
_UNSOLVED = (
    "No temperature of the exhaust was found at which heat and evaporation agree: check the duty of the "
    "heater and the heat loss against the flow of gas, and what is asked of the outlet."
)


class ConvectiveOutlets(NamedTuple):
    """Dried product, exhaust air, condensate of the heat recovery; heat of the heater net of losses, and fan
    power.
    """

    product: Stream
    exhaust: Stream
    condensate: Stream
    heat_duty: Any
    shaft_power: Any


class ConvectiveFigures(NamedTuple):
    """Figures of a convective dryer."""

    evaporation_rate: MassFlow
    moisture_dry_basis: MoistureDryBasis
    temperature_inlet: Temperature
    temperature_outlet: Temperature
    temperature_product: Temperature
    humidity_ratio_inlet: HumidityRatio
    humidity_ratio_outlet: HumidityRatio
    relative_humidity_outlet: Ratio
    dry_gas_flow: MassFlow
    heat_duty_heater: Power
    heat_duty_recovered: Power
    energy_per_water: SpecificEnergy
    energy_consumption_ratio: Number
    drying_efficiency: Number
    moisture_extraction_rate: SpecificMoistureExtraction


class Inside(NamedTuple):
    """What happens inside the dryer: exhaust before the heat recovery, gas entering, product."""

    inlet: Stream
    outlet: Stream
    product: Stream
    heater: Any
    recovered: Any
    exhaust: Stream
    condensate: Stream


@equipment(
    "convective_dryer", source="keey1978; mujumdar2014; bonazzi2003", title="Convective dryer (balance)"
)
class ConvectiveDryer(Unit):
    """Heats the air, dries the feed with it and gives back part of the exhaust; one statement about the
    outlet fixes the rest.

    Say how hot: ``temperature_inlet`` of the air at the dryer, or the ``heat_duty`` of the heater; with
    neither there is no heater. Say how far, by one of ``moisture_outlet`` of the product,
    ``temperature_outlet`` or ``relative_humidity_outlet`` of the exhaust. The recirculated fraction is of the
    exhaust. ``effectiveness`` is that of an exchanger from the exhaust, which may condense, to the fresh air.
    The product leaves at the temperature of the exhaust unless ``temperature_product`` is given. Only the
    first liquid evaporates, as if pure; the heat of sorption is left out.
    """

    temperature_inlet: Temperature | None = None
    heat_duty: Power | None = None
    moisture_outlet: MoistureDryBasis | None = None
    temperature_outlet: Temperature | None = None
    relative_humidity_outlet: RelativeHumidity | None = None
    temperature_product: Temperature | None = None
    recirculated_fraction: Fraction = 0.0
    effectiveness: Fraction = 0.0
    heat_loss: LostHeat = 0.0
    fan_power: Power = 0.0
    temperature_limit: Temperature | None = None
    isotherm: Annotated[Any, Law("isotherm")] = None

    limits: ClassVar[Limits] = {
        "humid": Limit("relative humidity of the exhaust", 0.0, 1.0, "dimensionless", "keey1978"),
        "energy": Limit("energy per water evaporated", 2.4e6, 6.5e6, "J/kg", "bonazzi2003; houdon2017"),
        "moisture": AS_SPECIFIED["moisture"],
        "exhaust": Limit(
            "temperature of the exhaust against the specification", -1e-6, 1e-6, "delta_degC", "keey1978"
        ),
        "humidity": Limit(
            "relative humidity of the exhaust against the specification",
            -1e-6,
            1e-6,
            "dimensionless",
            "keey1978",
        ),
        "equilibrium": Limit(
            "moisture of the product above equilibrium with the hot air", 0.0, 1e3, "kg/kg", "keey1978"
        ),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "bonazzi2003"),
    } | FLAMMABLE

    utilities: ClassVar[Utilities] = HEATED | HOT_GAS | FANNED

    def __check_init__(self) -> None:
        if self.temperature_inlet is not None and self.heat_duty is not None:
            raise InputError(
                _("Too much is given: one of 'temperature_inlet' and 'heat_duty' follows from the other."),
                name="heat_duty",
            )
        ends = [
            n
            for n in ("moisture_outlet", "temperature_outlet", "relative_humidity_outlet")
            if getattr(self, n) is not None
        ]
        if len(ends) != 1:
            raise InputError(
                _(
                    "One more value fixes this dryer: give exactly one of 'moisture_outlet', "
                    "'temperature_outlet', 'relative_humidity_outlet'; given: {names}."
                ).format(names=", ".join(ends) or _("none")),
                given=ends,
            )

    def outlets(self, inside: Inside, feed: Stream, gas: Stream) -> ConvectiveOutlets:
        heat = inside.heater - self.heat_loss
        return ConvectiveOutlets(
            inside.product, inside.exhaust, inside.condensate, heat, jnp.asarray(self.fan_power)
        )

    def inside(self, feed: Stream, gas: Stream) -> Inside:
        """The whole dryer, solved for the temperature of its exhaust."""
        humid = HumidMixture(feed.mixture)
        water = feed.liquid[0]
        r = self.recirculated_fraction
        back = r / (1.0 - r)
        gas = gas.replace(solid=jnp.zeros_like(gas.solid), liquid=jnp.zeros_like(gas.liquid))
        whole = feed + gas

        def moved(W: Any) -> Stream:
            """Feed and gas when that much water has evaporated."""
            return evaporate(whole.replace(pressure=gas.pressure), safe_divide(W, water))

        def parted(both: Stream, T: Any) -> tuple[Stream, Stream]:
            """Product and exhaust."""
            out = both.replace(
                solid=jnp.zeros_like(both.solid), liquid=jnp.zeros_like(both.liquid), temperature=T
            )
            left = both.replace(
                gas=jnp.zeros_like(both.gas),
                temperature=T if self.temperature_product is None else self.temperature_product,
            )
            return left, out

        def heat_missing(both: Stream, T: Any) -> Any:
            """Heat needed less heat there is; linear in the water."""
            product, out = parted(both, T)
            leaves = product.enthalpy_flow + out.enthalpy_flow
            if self.temperature_inlet is None:
                there = (
                    gas.enthalpy_flow + (0.0 if self.heat_duty is None else self.heat_duty) + self.fan_power
                )
            # the gas through the dryer is hot, fresh and recirculated alike, and what returns to it leaves
            # again
            else:
                mixed = gas.replace(gas=gas.gas + back * out.gas)
                there = mixed.enthalpy_at(self.temperature_inlet) - back * out.enthalpy_flow
            return leaves - there - feed.enthalpy_flow + self.heat_loss

        wet, dry = moved(0.0), moved(water)

        def water_at(T: Any) -> Any:
            none, all_ = heat_missing(wet, T), heat_missing(dry, T)
            return water * none / jnp.where(none == all_, jnp.nan, none - all_)

        known = jnp.asarray(True)
        if self.temperature_outlet is not None:
            W = water_at(self.temperature_outlet)
        elif self.moisture_outlet is not None:
            W = water - self.moisture_outlet * feed.solid_flow
        else:

            def missing(T: Any) -> Any:
                y = humid.fraction(moved(jnp.clip(water_at(T), 0.0, water)))
                return y - self.relative_humidity_outlet * humid.pair.saturated_fraction(
                    T, gas.pressure, False
                )

            asked = find_root(
                missing, COLDEST, HOTTEST if self.temperature_inlet is None else self.temperature_inlet
            )
            known, W = asked.converged, water_at(asked.value)
        W = jnp.clip(W, 0.0, water)
        guess = jnp.minimum(
            gas.temperature if self.temperature_inlet is None else self.temperature_inlet, 320.0
        )
        both = moved(W)
        root = find_root(
            lambda T: heat_missing(both, T) / jnp.maximum(jnp.sum(gas.gas) * 1e3, 1e-300),
            COLDEST,
            HOTTEST,
            start=guess,
            tolerance=1e-14,
        )
        product, out = parted(both, root.value)
        mixed = gas.replace(gas=gas.gas + back * out.gas)
        if self.temperature_inlet is None:
            duty = jnp.asarray(0.0 if self.heat_duty is None else self.heat_duty)
            inlet = mixed.at_enthalpy(gas.enthalpy_flow + back * out.enthalpy_flow + duty + self.fan_power)
        else:
            inlet = mixed.replace(temperature=jnp.asarray(self.temperature_inlet))
            duty = inlet.enthalpy_flow - gas.enthalpy_flow - back * out.enthalpy_flow - self.fan_power
        recovered, exhaust, condensate, cooled = self._recover(gas, out, duty)
        unsolved(known & root.converged & cooled, type(self).card, reason=_UNSOLVED)
        return Inside(inlet, out, product, duty - recovered, recovered, exhaust, condensate)

    def _recover(self, gas: Stream, out: Stream, duty: Any) -> tuple[Any, Stream, Stream, Any]:
        """Heat from the exhaust to the fresh air, never more than the heater needs; the exhaust drains below
        its dew point. Also whether the temperature that this leaves it was found.
        """
        if isinstance(self.effectiveness, float | int) and self.effectiveness == 0:
            return jnp.zeros(()), out, out.part(), jnp.asarray(True)
        # exhaust beyond saturation fails a check of its own; it must not start to condense before it is
        # cooled
        humid = HumidMixture(out.mixture)
        vapor = out.gas[humid.vapor]
        beyond = jnp.maximum(safe_divide(vapor, humid.saturated_vapor(out, out.temperature)), 1.0)

        def drained(T: Any) -> tuple[Stream, Stream]:
            both = humid.moved(
                out, -jnp.maximum(vapor - beyond * humid.saturated_vapor(out, T), 0.0)
            ).replace(temperature=T)
            return both.part(gas=1.0), both.part(liquid=1.0)

        def given(T: Any) -> Any:
            dry, wet = drained(T)
            return out.enthalpy_flow - dry.enthalpy_flow - wet.enthalpy_flow

        most = jnp.minimum(gas.enthalpy_at(out.temperature) - gas.enthalpy_flow, given(gas.temperature))
        passed = jnp.clip(self.effectiveness * most, 0.0, jnp.maximum(duty, 0.0))
        low = jnp.minimum(gas.temperature, out.temperature) - 1.0
        scale = jnp.maximum(jnp.sum(out.gas) * 1e3, 1e-300)
        root = find_root(lambda T: (given(T) - passed) / scale, low, out.temperature + 1.0, tolerance=1e-14)
        dry, wet = drained(root.value)
        return given(root.value), dry, wet, root.converged

    def figures(
        self, inside: Inside, outlets: ConvectiveOutlets, feed: Stream, gas: Stream
    ) -> ConvectiveFigures:
        found = inside
        W = evaporated(feed, found.product)
        bought = found.heater + self.fan_power
        energy = safe_divide(bought, W)
        humid = HumidMixture(feed.mixture)
        latent = humid.heat_of_vaporization(jnp.clip(found.outlet.temperature, ZERO_CELSIUS, 450.0))
        return ConvectiveFigures(
            evaporation_rate=W,
            moisture_dry_basis=found.product.moisture_dry_basis,
            temperature_inlet=found.inlet.temperature,
            temperature_outlet=found.outlet.temperature,
            temperature_product=found.product.temperature,
            humidity_ratio_inlet=humid.humidity_ratio(found.inlet),
            humidity_ratio_outlet=humid.humidity_ratio(found.outlet),
            relative_humidity_outlet=humid.relative_humidity(found.outlet),
            dry_gas_flow=humid.dry_flow(found.inlet),
            heat_duty_heater=found.heater,
            heat_duty_recovered=found.recovered,
            energy_per_water=energy,
            energy_consumption_ratio=energy / latent,
            drying_efficiency=safe_divide(latent, energy),
            moisture_extraction_rate=safe_divide(W, bought),
        )

    def measured(
        self,
        inside: Inside,
        outlets: ConvectiveOutlets,
        figures: ConvectiveFigures,
        feed: Stream,
        gas: Stream,
    ) -> dict[str, Any]:
        X, phi = figures.moisture_dry_basis, figures.relative_humidity_outlet
        found = {"humid": phi} | flammable(inside.outlet)
        if HumidMixture(feed.mixture).solvent == "water":
            found["energy"] = figures.energy_per_water
        if self.moisture_outlet is not None:
            found["moisture"] = X - self.moisture_outlet
        if self.temperature_outlet is not None:  # missed where all the water is gone, or none goes
            found["exhaust"] = figures.temperature_outlet - self.temperature_outlet
        if self.relative_humidity_outlet is not None:
            found["humidity"] = phi - self.relative_humidity_outlet
        if self.isotherm is not None:
            driest = HumidMixture(feed.mixture).relative_humidity(inside.inlet)
            found["equilibrium"] = X - self.isotherm(jnp.clip(driest, 1e-3, 0.99), figures.temperature_inlet)
        if self.temperature_limit is not None:
            found["hot"] = figures.temperature_product - self.temperature_limit
        return found

    def drawn(
        self,
        inside: Inside,
        outlets: ConvectiveOutlets,
        figures: ConvectiveFigures,
        feed: Stream,
        gas: Stream,
    ) -> dict[str, Any]:
        fan = {"electric_power_fan": driven(self.fan_power)}
        return heated(inside.heater, figures.temperature_inlet) | warmth(gas) | fan
