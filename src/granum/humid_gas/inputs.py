"""From any two given properties to the state (temperature, vapor fraction, fog)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import flags
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.humid_gas.pairs import SLACK, AbstractPair
from granum.humid_gas.relations import Gas
from granum.numerics.roots import find_root

SAMPLES = 49
TWO_STATES = "Two states have these values; the colder and moister one is given."
MOISTURE = ("humidity_ratio", "vapor_pressure", "dew_point_temperature")
WET = ("wet_bulb_temperature", "adiabatic_saturation_temperature")
NAMES = ("temperature", *MOISTURE, "relative_humidity", *WET, "enthalpy", "specific_volume")


def check_pair_of_inputs(given: dict[str, Any]) -> None:
    """One clear error when the state is not fixed by exactly two independent properties."""
    names = list(given)
    listed = ", ".join(NAMES)
    if len(names) != 2:
        raise InputError(
            _("A humid-gas state needs exactly two of {allowed}; given: {names}.").format(
                allowed=listed, names=", ".join(names) or _("none")
            ),
            given=names,
        )
    if all(name in MOISTURE for name in names):
        raise InputError(
            _("{first} and {second} say the same thing at a given pressure; give one of them and another property.").format(
                first=names[0], second=names[1]
            ),
            given=names,
        )
    if all(name in WET for name in names):
        raise InputError(
            _("{first} and {second} nearly coincide and do not fix the state; give one of them and another property.").format(
                first=names[0], second=names[1]
            ),
            given=names,
        )


class Solver:
    """Solves one combination of inputs; ``given`` holds two arrays by name."""

    def __init__(self, pair: AbstractPair, P: Any, lewis: Any, given: dict[str, Any]):
        self.pair, self.P, self.given = pair, P, given
        self.lewis = {"wet_bulb_temperature": lewis, "adiabatic_saturation_temperature": None}

    def solve(self) -> tuple[Gas, Any]:
        """The state, and where it is possible."""
        check_pair_of_inputs(self.given)
        wet = next((name for name in WET if name in self.given), None)
        moisture = next((name for name in MOISTURE if name in self.given), None)
        if "temperature" in self.given:
            return self._with_temperature(wet)
        if moisture is not None:
            return self._with_moisture(self._fraction(moisture), wet, moisture == "humidity_ratio")
        if wet is not None:
            return self._with_wet_surface(wet)
        return self._without_any()

    def _fraction(self, name: str) -> Any:
        value = self.given[name]
        if name == "humidity_ratio":
            return self.pair.fraction(value)
        return value / self.P if name == "vapor_pressure" else rel.saturated_fraction(self.pair, value, self.P)

    def _ys(self, T: Any) -> Any:
        return rel.saturated_fraction(self.pair, T, self.P)

    def _bounded(self, T: Any, y: Any) -> tuple[Gas, Any]:
        """An unsaturated state, possible where the fraction lies between dry and saturated."""
        ys = self._ys(T)
        possible = (y >= -1e-9) & (y <= ys * (1 + 1e-9)) & (y <= 1 + 1e-12)
        return Gas(T, jnp.clip(y, 0.0, jnp.minimum(ys, 1.0)), jnp.zeros_like(y)), possible

    def _with_temperature(self, wet: str | None) -> tuple[Gas, Any]:
        pair, P, T = self.pair, self.P, self.given["temperature"]
        name = next(n for n in self.given if n != "temperature")
        value = self.given[name]
        if name == "humidity_ratio":
            return rel.settled(pair, T, P, pair.fraction(value)), jnp.asarray(True)
        if name in MOISTURE:
            return self._bounded(T, self._fraction(name))
        if name == "relative_humidity":
            return self._bounded(T, value * self._ys(T))
        if wet is not None:
            return self._bounded(T, rel.fraction_at_wet_bulb(pair, T, P, value, self.lewis[wet]))
        if name == "specific_volume":
            return self._bounded(T, rel.fraction_at_volume(pair, T, P, value))
        return self._fog_at_enthalpy(T, value)

    def _fog_at_enthalpy(self, T: Any, h: Any) -> tuple[Gas, Any]:
        pair, P = self.pair, self.P
        y = rel.fraction_at_enthalpy(pair, T, P, h)
        ys = self._ys(T)
        gas, possible = self._bounded(T, y)
        foggy = (y > ys) & (ys < 1) & (pair.freezing_temperature < T)
        saturated = Gas(T, jnp.where(foggy, ys, 0.5), jnp.zeros_like(y))
        liquid = pair.condensate_molar_enthalpy(T, P, False) / pair.gas_molar_mass
        fog = (h - rel.enthalpy(pair, saturated, P)) / jnp.where(foggy, liquid, 1.0)
        return Gas(T, gas.y, jnp.where(foggy, fog, 0.0)), possible | foggy

    def _with_moisture(self, y: Any, wet: str | None, total: bool) -> tuple[Gas, Any]:
        pair, P = self.pair, self.P
        possible = (y >= 0) & (y <= 1)
        y = jnp.clip(y, 0.0, 1.0)
        name = next(n for n in self.given if n not in MOISTURE)
        value = self.given[name]
        if name == "enthalpy":
            T = rel.temperature_at_enthalpy(pair, P, y, value)
            return (rel.settled(pair, T, P, y), possible) if total else self._bounded(T, y)
        if name == "relative_humidity":
            T = self._root(lambda T: value * self._ys(T) - y, pair.lowest_temperature, pair.highest_temperature)
        elif wet is not None:
            T = self._dry_bulb(value, y, self.lewis[wet])
        else:
            T = self._root(
                lambda T: pair.molar_volume(T, P, y) - value * pair.gas_molar_mass * (1.0 - y),
                rel.dew_point(pair, P, y) * (1 - SLACK),
                pair.highest_temperature,
            )
        return self._bounded(T, y)

    def _dry_bulb(self, Ts: Any, y: Any, lewis: Any) -> Any:
        frozen = self.pair.is_frozen(Ts)
        return self._root(
            lambda T: rel.wet_bulb_balance(self.pair, Ts, self.pair.molar_enthalpy(T, self.P, y), self.P, y, frozen, lewis),
            Ts * (1 - SLACK),
            self.pair.highest_temperature,
        )

    def _with_wet_surface(self, wet: str) -> tuple[Gas, Any]:
        pair, P, Ts, lewis = self.pair, self.P, self.given[wet], self.lewis[wet]
        name = next(n for n in self.given if n not in WET)
        value = self.given[name]
        driest = self._dry_bulb(Ts, jnp.zeros_like(Ts * P), lewis)
        driest = jnp.where(jnp.isnan(driest), pair.highest_temperature, driest)

        def fraction(T: Any) -> Any:
            return rel.fraction_at_wet_bulb(pair, T, P, Ts, lewis)

        if name == "relative_humidity":
            T = self._root(lambda T: fraction(T) - value * self._ys(T), Ts * (1 - SLACK), driest * (1 + SLACK))
        elif name == "enthalpy":
            T = self._root(
                lambda T: pair.molar_enthalpy(T, P, fraction(T)) - value * pair.gas_molar_mass * (1.0 - fraction(T)),
                Ts * (1 - SLACK), driest * (1 + SLACK),
            )  # fmt: skip
        else:
            T = self._coldest_root(
                lambda T: pair.molar_volume(T, P, fraction(T)) - value * pair.gas_molar_mass * (1.0 - fraction(T)),
                Ts * (1 - SLACK), driest * (1 + SLACK), value,
            )  # fmt: skip
        return self._bounded(T, fraction(T))

    def _without_any(self) -> tuple[Gas, Any]:
        """Two of relative humidity, enthalpy and volume."""
        pair, P, Mg = self.pair, self.P, self.pair.gas_molar_mass
        h, v = self.given.get("enthalpy"), self.given.get("specific_volume")
        phi = self.given.get("relative_humidity")
        low, high = pair.lowest_temperature, pair.highest_temperature
        if phi is None:
            assert h is not None
            T = self._coldest_root(
                lambda T: pair.molar_enthalpy(T, P, self._at_volume(T)) - h * Mg * (1.0 - self._at_volume(T)), *self._volume_bracket(), v
            )
            return self._bounded(T, self._at_volume(T))

        def fraction(T: Any) -> Any:
            return jnp.minimum(phi * self._ys(T), 1.0)

        if h is not None:
            T = self._root(lambda T: pair.molar_enthalpy(T, P, fraction(T)) - h * Mg * (1.0 - fraction(T)), low, high)
        else:
            assert v is not None
            T = self._root(lambda T: pair.molar_volume(T, P, fraction(T)) - v * Mg * (1.0 - fraction(T)), low, high)
        return self._bounded(T, phi * self._ys(T))

    def _at_volume(self, T: Any) -> Any:
        return rel.fraction_at_volume(self.pair, T, self.P, self.given["specific_volume"])

    def _volume_bracket(self) -> tuple[Any, Any]:
        """From saturated gas to dry gas of the given volume."""
        pair, P, v = self.pair, self.P, self.given["specific_volume"]
        low, high = pair.lowest_temperature, pair.highest_temperature
        dry = self._root(lambda T: pair.molar_volume(T, P, jnp.zeros_like(T)) - v * pair.gas_molar_mass, low, high)
        dry = jnp.where(jnp.isnan(dry), high, dry)
        saturated = self._root(lambda T: self._at_volume(T) - self._ys(T), low, jnp.minimum(dry, pair.boiling_temperature(P)))
        return saturated * (1 - SLACK), dry * (1 + SLACK)

    def _root(self, balance: Callable[[Any], Any], lower: Any, upper: Any) -> Any:
        return find_root(balance, lower, upper, tolerance=1e-13).value

    def _coldest_root(self, balance: Callable[[Any], Any], lower: Any, upper: Any, volume: Any) -> Any:
        """The coldest of the roots of a balance that may turn round: heavy solvents have two states of one wet bulb and volume."""
        lower, upper = jnp.broadcast_arrays(lower, upper)
        share = jnp.linspace(0.0, 1.0, SAMPLES).reshape((-1,) + (1,) * lower.ndim) ** 2  # states lie close near saturation
        T = lower + share * (upper - lower)
        sign = jnp.sign(jax.lax.map(balance, T))
        change = sign[:-1] * sign[1:] < 0
        first = jnp.argmax(change, axis=0)[None]
        low, high = (jnp.take_along_axis(ends, first, axis=0)[0] for ends in (T[:-1], T[1:]))
        flags.limit_active(jnp.sum(change, axis=0) > 1, volume, "specific_volume", TWO_STATES)
        any_change = jnp.any(change, axis=0)
        return self._root(balance, jnp.where(any_change, low, lower), jnp.where(any_change, high, upper))
