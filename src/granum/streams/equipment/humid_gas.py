"""Humid gas in a line: mixing with fog, cooling with condensation, a cold coil, an adiabatic humidifier,
injected steam or water.
"""

from __future__ import annotations

import math
from functools import reduce
from operator import add
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.kinds import Fraction, HumidityRatio, MassFlow, Power, RelativeHumidity, Temperature
from granum.core.limits import Limit
from granum.numerics import find_root
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, cooled, heated

COLDEST = 200.0
UNSOLVED = (
    "No temperature was found at which gas and liquid are in equilibrium with the heat they bring: check "
    "the temperatures and flows that enter."
)


def _drained(stream: Stream) -> tuple[Stream, Stream]:
    """Gas (with its dust) and the liquid that drains from it."""
    return stream.part(1.0, 0.0, 1.0), stream.part(0.0, 1.0, 0.0)


def _above_freezing(source: str) -> Limits:
    return {"liquid": Limit("temperature above the freezing point", 0.0, math.inf, "delta_degC", source)}


class MixedGas(NamedTuple):
    """Mixed gas; its liquid is fog."""

    product: Stream


class HumidFigures(NamedTuple):
    """State of the gas, and the liquid that floats in it."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    mass_flow: MassFlow
    condensate_flow: MassFlow


@equipment("humid_mixer", source="ashrae2017, ch. 1", title="Mixer of humid gases, steam and water")
class HumidMixer(Unit):
    """Joins humid gases, steam and water sprays adiabatically to equilibrium: liquid evaporates while the gas
    takes it, excess vapor becomes fog.

    Steam injection and spraying are this unit with a steam or water inlet; what does not evaporate leaves
    with the gas as liquid.
    """

    limits: ClassVar[Limits] = _above_freezing("ashrae2017")

    def outlets(self, inside: None, **inlets: Stream) -> MixedGas:
        mixed = reduce(add, inlets.values())
        product = HumidMixture(mixed.mixture).at_own_enthalpy(mixed)
        unsolved(jnp.isfinite(product.temperature), type(self).card, reason=UNSOLVED)
        return MixedGas(product)

    def figures(self, inside: None, outlets: MixedGas, **inlets: Stream) -> HumidFigures:
        gas = outlets.product
        humid = HumidMixture(gas.mixture)
        return HumidFigures(
            gas.temperature,
            humid.humidity_ratio(gas),
            humid.relative_humidity(gas),
            gas.mass_flow,
            gas.liquid_flow,
        )

    def measured(
        self, inside: None, outlets: MixedGas, figures: HumidFigures, **inlets: Stream
    ) -> dict[str, Any]:
        return {
            "liquid": outlets.product.temperature - HumidMixture(outlets.product.mixture).freezing_temperature
        }


class Cooled(NamedTuple):
    """Cooled gas, the liquid drained from it, and the heat taken up (negative)."""

    product: Stream
    condensate: Stream
    heat_duty: Any


class CoolerFigures(NamedTuple):
    """Figures of a cooler."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    condensate_flow: MassFlow
    heat_duty: Power


def _cooler_figures(outlets: Cooled) -> CoolerFigures:
    gas = outlets.product
    humid = HumidMixture(gas.mixture)
    return CoolerFigures(
        gas.temperature,
        humid.humidity_ratio(gas),
        humid.relative_humidity(gas),
        outlets.condensate.liquid_flow,
        outlets.heat_duty,
    )


@equipment("condenser_cooler", source="ashrae2017, ch. 1", title="Cooler of a humid gas, with condensation")
class CondenserCooler(Unit):
    """Brings a humid gas to a temperature; vapor above saturation condenses and drains at that temperature.
    Also heats.
    """

    temperature: Temperature

    limits: ClassVar[Limits] = _above_freezing("ashrae2017")

    utilities: ClassVar[Utilities] = HEATED | COOLED

    def outlets(self, inside: None, gas: Stream) -> Cooled:
        out = HumidMixture(gas.mixture).at_temperature(gas, self.temperature)
        return Cooled(*_drained(out), out.enthalpy_flow - gas.enthalpy_flow)

    def figures(self, inside: None, outlets: Cooled, gas: Stream) -> CoolerFigures:
        return _cooler_figures(outlets)

    def measured(self, inside: None, outlets: Cooled, figures: CoolerFigures, gas: Stream) -> dict[str, Any]:
        return {
            "liquid": outlets.product.temperature - HumidMixture(outlets.product.mixture).freezing_temperature
        }

    def drawn(self, inside: None, outlets: Cooled, figures: CoolerFigures, gas: Stream) -> dict[str, Any]:
        return heated(outlets.heat_duty, self.temperature) | cooled(outlets.heat_duty, self.temperature)


@equipment("dehumidifying_coil", source="ashrae2017, ch. 1; mcquiston2005", title="Dehumidifying coil")
class DehumidifyingCoil(Unit):
    """A cold coil: part of the gas leaves saturated at the surface temperature, the rest passes unchanged;
    the condensate drains cold.
    """

    coil_temperature: Temperature
    coil_bypass_fraction: Fraction = 0.1

    limits: ClassVar[Limits] = _above_freezing("mcquiston2005")

    utilities: ClassVar[Utilities] = COOLED

    def outlets(self, inside: None, gas: Stream) -> Cooled:
        share = 1.0 - self.coil_bypass_fraction
        humid = HumidMixture(gas.mixture)
        cold, condensate = _drained(
            humid.at_temperature(gas.part(share, share, share), self.coil_temperature)
        )
        b = self.coil_bypass_fraction
        product = humid.at_own_enthalpy(cold + gas.part(b, b, b))
        unsolved(jnp.isfinite(product.temperature), type(self).card, reason=UNSOLVED)
        duty = product.enthalpy_flow + condensate.enthalpy_flow - gas.enthalpy_flow
        return Cooled(product, condensate, duty)

    def figures(self, inside: None, outlets: Cooled, gas: Stream) -> CoolerFigures:
        return _cooler_figures(outlets)

    def measured(self, inside: None, outlets: Cooled, figures: CoolerFigures, gas: Stream) -> dict[str, Any]:
        return {
            "liquid": outlets.condensate.temperature
            - HumidMixture(outlets.condensate.mixture).freezing_temperature
        }

    def drawn(self, inside: None, outlets: Cooled, figures: CoolerFigures, gas: Stream) -> dict[str, Any]:
        return cooled(outlets.heat_duty, self.coil_temperature)


class Humidified(NamedTuple):
    """Moist gas and the water that did not evaporate."""

    product: Stream
    drain: Stream


class HumidifierFigures(NamedTuple):
    """Figures of a humidifier."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: RelativeHumidity
    evaporation_rate: MassFlow


@equipment("adiabatic_humidifier", source="ashrae2017, ch. 1; mcquiston2005", title="Adiabatic humidifier")
class AdiabaticHumidifier(Unit):
    """A washer or wet pad: water evaporates into the gas without heat from outside, up to a share of what
    would saturate it.

    Water that does not evaporate drains at the temperature at which it came. A washer that circulates its
    water settles at the wet bulb, and then only the water that evaporates has to be fed.
    """

    saturation_effectiveness: Fraction = 0.9

    limits: ClassVar[Limits] = {
        "drain": Limit("water left at the drain of the humidifier", 1e-7, 100.0, "percent", "ashrae2017")
    }

    def outlets(self, inside: None, gas: Stream, water: Stream) -> Humidified:
        humid = HumidMixture(gas.mixture)
        available = water.liquid[0]

        def wetted(evaporated: Any) -> Stream:
            taken = water.replace(liquid=jnp.zeros_like(water.liquid).at[0].set(evaporated))
            drain = water.replace(liquid=water.liquid - taken.liquid)
            moist = humid.moved(gas + taken, evaporated)
            given = gas.enthalpy_flow + water.enthalpy_flow - drain.enthalpy_flow
            return moist.at_enthalpy(given, guess=gas.temperature)

        def surplus(T: Any) -> Any:
            """Water that cooling the gas to T evaporates, less what it then takes to saturation."""
            gained = (
                humid.moved(gas, 1.0).replace(temperature=T).enthalpy_flow
                - gas.replace(temperature=T).enthalpy_flow
            )
            per_kg = gained + m.enthalpies("liquids", T)[0] - m.enthalpies("liquids", water.temperature)[0]
            by_heat = (gas.enthalpy_flow - gas.replace(temperature=T).enthalpy_flow) / per_kg
            return (by_heat - humid.saturated_vapor(gas, T) + gas.gas[humid.vapor]) / jnp.maximum(
                gas.mass_flow, 1e-300
            )

        m = gas.mixture
        root = find_root(surplus, COLDEST, gas.temperature)
        # at its own temperature: none where it is saturated
        thirst = humid.saturated_vapor(gas, gas.temperature) - gas.gas[humid.vapor]
        full = jnp.where(root.converged, humid.saturated_vapor(gas, root.value) - gas.gas[humid.vapor], 0.0)
        evaporated = jnp.clip(self.saturation_effectiveness * full, 0.0, available)
        drain = water.replace(liquid=water.liquid.at[0].add(-evaporated))
        product = wetted(evaporated)
        unsolved(
            jnp.isfinite(product.temperature) & (root.converged | (thirst <= 0.0)),
            type(self).card,
            reason=UNSOLVED,
        )
        return Humidified(product, drain)

    def figures(self, inside: None, outlets: Humidified, gas: Stream, water: Stream) -> HumidifierFigures:
        moist = outlets.product
        humid = HumidMixture(moist.mixture)
        evaporated = water.liquid[0] - outlets.drain.liquid[0]
        return HumidifierFigures(
            moist.temperature, humid.humidity_ratio(moist), humid.relative_humidity(moist), evaporated
        )

    def measured(
        self, inside: None, outlets: Humidified, figures: HumidifierFigures, gas: Stream, water: Stream
    ) -> dict[str, Any]:
        return {"drain": 100.0 * outlets.drain.liquid_flow / jnp.maximum(water.liquid_flow, 1e-300)}
