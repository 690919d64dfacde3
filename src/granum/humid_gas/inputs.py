"""From any two given properties to the state (temperature, vapor fraction, fog)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp

import granum.humid_gas.relations as rel
from granum.core import flags
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.humid_gas.given import MOISTURE, NAMES, WET, check_pair_of_inputs
from granum.humid_gas.pairs import SLACK, AbstractPair
from granum.humid_gas.relations import Gas
from granum.numerics.blocks import blockwise
from granum.numerics.extremes import golden_section
from granum.numerics.quick_roots import falling_root
from granum.numerics.roots import find_root

SAMPLES = 49
SECTIONS = 44  # golden ones, down to 1e-9 of the interval
ROUNDING = 1e-9
ROOM_FOR_REAL = 1.25  # over the temperature at which dry ideal gas has a volume: a real gas may be warmer
TWO_STATES = "Two states have these values; the colder and moister one is given."
NEARLY_PARALLEL = (
    "Lines of constant wet bulb and of constant enthalpy are nearly parallel: a change of 0.1 kJ/kg "
    "moves the temperature by more "
    "than 1 K. Give the temperature or the humidity in place of one of them."
)
# enthalpy of the evaporating liquid over its latent heat: below this the temperature moves by more than 1 K
PARALLEL_SHARE = 0.1
OVER_SATURATION = "The vapor would be more than saturates the gas at this temperature."
ABOVE_TOTAL = (
    "The vapor pressure cannot be above the total pressure, nor the dew point above the boiling point."
)
BETWEEN_WET = (
    "The limits are the wet bulb of dry gas at this temperature, and the dry bulb or the boiling point."
)
BETWEEN_DRY_AND_SATURATED = "The limits are those of dry and of saturated gas at this temperature."
OVER_DRY = "The limits are those of dry gas at this temperature and, below freezing, of saturated gas."
OVER_DEW = "The limit is that of the gas saturated, at its dew point."
FROM_DEW = "The limits are the dew point and the boiling point."
BELOW_BOILING = "The limit is the boiling point."
ALONG_WET = "The limits are those of saturated and of dry gas with this wet bulb."
ALONG_VOLUME = "The limits are those of dry and of saturated gas of this volume."
DRY = "Dry gas has the relative humidity 0 at every temperature: give its temperature."
NO_TEMPERATURE = "No temperature of this gas–vapor pair's range has these values."


class Solver:
    """Solves one combination of inputs; ``given`` holds two arrays by name."""

    def __init__(self, pair: AbstractPair, P: Any, lewis: Any, given: dict[str, Any]):
        self.pair, self.P, self.given = pair, P, given
        self.lewis = {"wet_bulb_temperature": lewis, "adiabatic_saturation_temperature": None}

    def solve(self) -> tuple[Gas, Any]:
        """The state, and where it is possible."""
        check_pair_of_inputs(self.given)
        names, lewis = list(self.given), self.lewis["wet_bulb_temperature"]
        # a block cannot tell what it has to say
        if flags.listening() or (lewis is not None and jnp.ndim(lewis) > 0):
            return self._solve()

        def one(P: Any, *values: Any) -> tuple[Gas, Any]:
            gas, possible = Solver(self.pair, P, lewis, dict(zip(names, values, strict=True)))._solve()
            shape = jnp.broadcast_shapes(*(jnp.shape(x) for x in (P, *values)))
            return jax.tree.map(lambda x: jnp.broadcast_to(x, shape), (gas, possible))

        return blockwise(one, self.P, *self.given.values())

    def _solve(self) -> tuple[Gas, Any]:
        names = sorted(self.given, key=NAMES.index)
        roles = ["moisture" if n in MOISTURE else "wet_bulb" if n in WET else n for n in names]
        gas, possible = getattr(self, "_" + "_and_".join(roles))(*names)
        possible = possible & jnp.isfinite(gas.T) & jnp.isfinite(gas.y)
        flags.impossible(~possible, self.given[names[1]], names[1], reason=NO_TEMPERATURE)
        return gas, possible

    def _fraction(self, name: str) -> tuple[Any, Any]:
        """Vapor fraction of a given moisture, and whether there can be so much."""
        value = self.given[name]
        if name == "humidity_ratio":
            return self.pair.fraction(value), jnp.asarray(True)
        pressure = name == "vapor_pressure"
        y = value / self.P if pressure else rel.saturated_fraction(self.pair, value, self.P)
        possible = y <= 1.0 + ROUNDING
        self._tell(
            ~possible,
            name,
            lambda: (0.0, self.P) if pressure else (-jnp.inf, self.pair.boiling_temperature(self.P)),
            ABOVE_TOTAL,
        )
        return jnp.clip(y, 0.0, 1.0), possible

    def _ys(self, T: Any) -> Any:
        return rel.saturated_fraction(self.pair, T, self.P)

    def _per_gas(self, value: Any, y: Any) -> Any:
        """What is given per mass of dry gas, per mole of mixture."""
        return value * self.pair.gas_molar_mass * (1.0 - y)

    def _tell(self, wrong: Any, name: str, limits: Callable[[], tuple[Any, Any]], reason: str) -> None:
        """Where no state exists: the given value, what it may be beside the other one, and why."""
        if flags.listening():
            low, high = limits()
            flags.impossible(wrong, self.given[name], name, low, high, reason)

    def _bounded(
        self, T: Any, y: Any, name: str, limits: Callable[[], tuple[Any, Any]], reason: str
    ) -> tuple[Gas, Any]:
        """An unsaturated state, possible where the fraction lies between dry and saturated."""
        ys = jnp.minimum(self._ys(T), 1.0)
        possible = (y >= -ROUNDING) & (y <= ys * (1 + ROUNDING))
        self._tell(~possible & jnp.isfinite(T), name, limits, reason)
        return Gas(T, jnp.clip(y, 0.0, ys), jnp.zeros_like(T * y)), possible

    def _specific(self, quantity: str, T: Any, y: Any) -> Any:
        """Enthalpy or volume of the gas per mass of dry gas."""
        gas = Gas(T, y, jnp.zeros_like(T * y))
        return (
            rel.enthalpy_of(self.pair, gas, self.P)
            if quantity == "enthalpy"
            else rel.volume_of(self.pair, gas, self.P)
        )

    def _molar(self, quantity: str) -> Callable[..., Any]:
        return self.pair.molar_enthalpy if quantity == "enthalpy" else self.pair.molar_volume

    def _falling(self, balance: Callable[[Any], Any], lower: Any, upper: Any, start: Any = None) -> Any:
        """The temperature at which a falling balance is zero; NaN where it is not zero between the ends."""
        T = falling_root(balance, lower * (1 - SLACK), upper * (1 + SLACK), start=start)
        return jnp.where((lower * (1 - 0.5 * SLACK) < T) & (upper * (1 + 0.5 * SLACK) > T), T, jnp.nan)

    # --- temperature and another

    def _temperature_and_moisture(self, _T: str, name: str) -> tuple[Gas, Any]:
        T = self.given["temperature"]
        y, possible = self._fraction(name)
        if name == "humidity_ratio":
            return rel.settled(self.pair, T, self.P, y), possible

        def limits() -> tuple[Any, Any]:
            return (
                (0.0, jnp.minimum(self._ys(T), 1.0) * self.P) if name == "vapor_pressure" else (-jnp.inf, T)
            )

        gas, inside = self._bounded(T, y, name, limits, OVER_SATURATION)
        return gas, possible & inside

    def _temperature_and_relative_humidity(self, _T: str, name: str) -> tuple[Gas, Any]:
        T = self.given["temperature"]
        return self._bounded(
            T, self.given[name] * self._ys(T), name, lambda: (0.0, 1.0 / self._ys(T)), ABOVE_TOTAL
        )

    def _temperature_and_wet_bulb(self, _T: str, name: str) -> tuple[Gas, Any]:
        pair, P, T, lewis = self.pair, self.P, self.given["temperature"], self.lewis[name]

        def limits() -> tuple[Any, Any]:
            return rel.wet_bulb(pair, T, P, jnp.zeros_like(T * P), lewis), jnp.minimum(
                T, pair.boiling_temperature(P)
            )

        return self._bounded(
            T, rel.fraction_at_wet_bulb(pair, T, P, self.given[name], lewis), name, limits, BETWEEN_WET
        )

    def _temperature_and_specific_volume(self, _T: str, name: str) -> tuple[Gas, Any]:
        T = self.given["temperature"]
        y = self.pair.fraction_at_volume(T, self.P, self.given[name])
        return self._bounded(T, y, name, lambda: self._dry_and_saturated(name, T), BETWEEN_DRY_AND_SATURATED)

    def _dry_and_saturated(self, name: str, T: Any) -> tuple[Any, Any]:
        ys = self._ys(T)
        below = ys < 1.0
        saturated = jnp.where(below, self._specific(name, T, jnp.where(below, ys, 0.5)), jnp.inf)
        return self._specific(name, T, 0.0 * ys), saturated

    def _temperature_and_enthalpy(self, _T: str, name: str) -> tuple[Gas, Any]:
        pair, P, T, h = self.pair, self.P, self.given["temperature"], self.given["enthalpy"]
        y = rel.fraction_at_enthalpy(pair, T, P, h)
        ys = self._ys(T)
        # ice takes enthalpy away, so such a mixture is not told apart
        foggy = (y > ys) & (ys < 1) & (pair.freezing_temperature < T)
        gas, possible = self._bounded(
            T,
            jnp.where(foggy, ys, y),
            name,
            lambda: (
                self._specific(name, T, 0.0 * ys),
                jnp.where(pair.is_frozen(T), self._dry_and_saturated(name, T)[1], jnp.inf),
            ),
            OVER_DRY,
        )
        saturated = Gas(T, jnp.where(foggy, ys, 0.5), jnp.zeros_like(y))
        liquid = pair.condensate_molar_enthalpy(T, P, False) / pair.gas_molar_mass
        fog = (h - rel.enthalpy_of(pair, saturated, P)) / jnp.where(foggy, liquid, 1.0)
        return Gas(T, gas.y, jnp.where(foggy, fog, 0.0)), possible

    # --- moisture and another

    def _moisture_and_relative_humidity(self, moisture: str, name: str) -> tuple[Gas, Any]:
        (y, possible), phi = self._fraction(moisture), self.given[name]
        ys = y / jnp.where(phi > 0, phi, jnp.nan)
        T = rel.temperature_of_saturation(self.pair, self.P, ys, self.pair.highest_temperature)
        possible = possible & (y > 0) & (phi * self._ys(self.pair.highest_temperature) >= y)
        self._tell((y <= 0) & (phi <= 0), name, lambda: (-jnp.inf, jnp.inf), DRY)
        return Gas(jnp.where(possible, T, jnp.nan), y + 0.0 * T, jnp.zeros_like(T)), possible

    def _moisture_and_wet_bulb(self, moisture: str, name: str) -> tuple[Gas, Any]:
        y, possible = self._fraction(moisture)
        gas, inside = self._with_surface(y, name)
        return gas, possible & inside

    def _with_surface(self, y: Any, name: str) -> tuple[Gas, Any]:
        """Gas of a vapor fraction over a wet surface: its enthalpy is known, hence its temperature."""
        pair, P, Ts = self.pair, self.P, self.given[name]
        wet = rel.wet_surface(pair, Ts, P, self.lewis[name])
        above = y <= wet.ys * (1 + ROUNDING)

        def limits() -> tuple[Any, Any]:
            return rel.dew_point(pair, P, y), pair.boiling_temperature(P)

        self._tell(~above | (wet.ys >= 1.0), name, limits, FROM_DEW)
        y = jnp.minimum(y, wet.ys)
        h = wet.enthalpy(y)
        T = self._falling(
            lambda T: h - pair.molar_enthalpy(T, P, y), Ts + 0.0 * y, pair.highest_temperature, start=Ts
        )
        return Gas(T, y + 0.0 * T, jnp.zeros_like(T)), above

    def _moisture_and_enthalpy(self, moisture: str, name: str) -> tuple[Gas, Any]:
        if moisture != "humidity_ratio":
            return self._moisture_and_specific(moisture, name)
        y = self.pair.fraction(self.given[moisture])
        T = rel.temperature_at_enthalpy(self.pair, self.P, y, self.given[name])
        return rel.settled(self.pair, T, self.P, y), jnp.asarray(True)

    def _moisture_and_specific_volume(self, moisture: str, name: str) -> tuple[Gas, Any]:
        return self._moisture_and_specific(moisture, name)

    def _moisture_and_specific(self, moisture: str, name: str) -> tuple[Gas, Any]:
        """Unsaturated gas of a vapor fraction and an enthalpy or volume, which rise with temperature from the
        dew point on.
        """
        y, possible = self._fraction(moisture)
        dew = (
            self.given[moisture]
            if moisture == "dew_point_temperature"
            else rel.dew_point(self.pair, self.P, y)
        )
        goal, of = self._per_gas(self.given[name], y), self._molar(name)
        T = self._falling(lambda T: goal - of(T, self.P, y), dew + 0.0 * goal, self.pair.highest_temperature)
        self._tell(
            goal < of(dew, self.P, y) * (1 - SLACK),
            name,
            lambda: (self._specific(name, dew, y), jnp.inf),
            OVER_DEW,
        )
        return Gas(T, y + 0.0 * T, jnp.zeros_like(T)), possible

    # --- wet bulb and another

    def _relative_humidity_and_wet_bulb(self, other: str, name: str) -> tuple[Gas, Any]:
        pair, P, Ts, phi = self.pair, self.P, self.given[name], self.given[other]
        surface = rel.wet_surface(pair, Ts, P, self.lewis[name])

        def fraction(T: Any) -> Any:
            return jnp.minimum(phi * self._ys(T), 1.0)

        def balance(T: Any) -> Any:
            return -surface.balance(pair.molar_enthalpy(T, P, fraction(T)), fraction(T))

        boiling = pair.boiling_temperature(P)
        self._tell(Ts >= boiling, name, lambda: (-jnp.inf, boiling), BELOW_BOILING)
        top = self._holding(surface.ys, phi)
        T = self._falling(balance, Ts + 0.0 * top, top, start=top)
        return Gas(T, fraction(T), jnp.zeros_like(T)), boiling > Ts

    def _wet_bulb_and_enthalpy(self, wet: str, name: str) -> tuple[Gas, Any]:
        pair, P, h = self.pair, self.P, self.given[name]
        surface = rel.wet_surface(pair, self.given[wet], P, self.lewis[wet])
        y = surface.fraction(h * pair.gas_molar_mass)
        flags.limit_active(abs(surface.taken) < PARALLEL_SHARE * surface.latent, h, name, NEARLY_PARALLEL)
        possible = (y >= -ROUNDING) & (y <= surface.ys * (1 + ROUNDING))
        self._tell(~possible, name, lambda: self._between(surface), ALONG_WET)
        gas, inside = self._with_surface(jnp.clip(y, 0.0, surface.ys), wet)
        return gas, possible & inside

    def _between(self, surface: rel.WetSurface) -> tuple[Any, Any]:
        """Least and greatest enthalpy along a line of constant wet bulb."""
        ends = [surface.enthalpy(y) / (1.0 - y) / self.pair.gas_molar_mass for y in (0.0, surface.ys)]
        return jnp.minimum(*ends), jnp.maximum(*ends)

    def _wet_bulb_and_specific_volume(self, wet: str, name: str) -> tuple[Gas, Any]:
        pair, P, Ts, v = self.pair, self.P, self.given[wet], self.given[name]
        surface = rel.wet_surface(pair, Ts, P, self.lewis[wet])

        def driest() -> Any:
            T = self._with_surface(jnp.zeros_like(Ts * P * v), wet)[0].T
            return jnp.where(jnp.isnan(T), pair.highest_temperature, T)

        if pair.heavy_vapor:  # its volume turns along the line of the wet bulb, so that line is followed

            def fraction(T: Any) -> Any:
                return rel.fraction_over(surface, pair, T, P)

            def balance(T: Any) -> Any:
                y = fraction(T)
                return self._per_gas(v, y) - pair.molar_volume(T, P, y)

            T = self._coldest(balance, Ts + 0.0 * P * v, driest(), v)
        else:  # the line of the volume asks for no saturation on the way

            def fraction(T: Any) -> Any:
                return pair.fraction_at_volume(T, P, v)

            def balance(T: Any) -> Any:
                y = fraction(T)
                return surface.balance(pair.molar_enthalpy(T, P, y), y)

            dry = ROOM_FOR_REAL * P * v * pair.gas_molar_mass / GAS_CONSTANT
            T = self._falling(balance, Ts + 0.0 * dry, jnp.clip(dry, Ts, pair.highest_temperature))

        y = fraction(T)
        possible = jnp.isfinite(T) & (y >= -ROUNDING)

        def limits() -> tuple[Any, Any]:
            ends = [(Ts, surface.ys), (driest(), jnp.zeros_like(Ts * P * v))]
            saturated, dry = (self._specific(name, T, jnp.clip(y, 0.0, 1 - SLACK)) for T, y in ends)
            return jnp.minimum(saturated, dry), jnp.maximum(saturated, dry)

        self._tell(~possible, name, limits, ALONG_WET)
        return Gas(T, jnp.minimum(jnp.clip(y, 0.0, 1.0), self._ys(T)), jnp.zeros_like(T)), possible

    def _holding(self, y: Any, phi: Any) -> Any:
        """Temperature at which gas of a relative humidity holds a vapor fraction; the highest of the pair for
        dry gas.
        """
        T = rel.temperature_of_saturation(
            self.pair, self.P, y / jnp.maximum(phi, 1e-12), self.pair.highest_temperature
        )
        return jnp.where(phi > 1e-9, T * (1 + 1e-6), self.pair.highest_temperature)

    # --- two of relative humidity, enthalpy and volume

    def _relative_humidity_and_enthalpy(self, other: str, name: str) -> tuple[Gas, Any]:
        phi, of = self.given[other], self._molar(name)

        def fraction(T: Any) -> Any:
            return jnp.minimum(phi * self._ys(T), 1.0)

        def balance(T: Any) -> Any:
            return self._per_gas(self.given[name], fraction(T)) - of(T, self.P, fraction(T))

        low, high = self.pair.lowest_temperature, self.pair.highest_temperature
        if name == "enthalpy":  # which is zero at 0 °C: no warmer than if the vapor alone held it
            zero = ZERO_CELSIUS
            vapor = (
                self.pair.vapor_partial_enthalpy(jnp.asarray(zero, dtype=float), self.P, 1e-6)
                / self.pair.vapor_molar_mass
            )
            held = self.pair.fraction(jnp.maximum(self.given[name], 1.0) / vapor)
            high = jnp.where(self.given[name] > 0, jnp.maximum(self._holding(held, phi), zero), zero) * (
                1 + SLACK
            )
        T = self._falling(balance, low + 0.0 * phi * self.P * self.given[name], high, start=high)
        return Gas(T, fraction(T), jnp.zeros_like(T)), jnp.asarray(True)

    _relative_humidity_and_specific_volume = _relative_humidity_and_enthalpy

    def _enthalpy_and_specific_volume(self, other: str, name: str) -> tuple[Gas, Any]:
        pair, P = self.pair, self.P
        h, v = self.given[other], self.given[name]
        cold, dry = self._saturated_and_dry(v * pair.gas_molar_mass)

        def fraction(T: Any) -> Any:
            return pair.fraction_at_volume(T, P, v)

        def balance(T: Any) -> Any:
            y = fraction(T)
            return pair.molar_enthalpy(T, P, y) - self._per_gas(h, y)

        T = self._coldest(balance, cold + 0.0 * h, dry + 0.0 * h, v)

        def limits() -> tuple[Any, Any]:
            least, most = (
                self._specific("enthalpy", T, jnp.clip(fraction(T), 0.0, 1 - SLACK)) for T in (dry, cold)
            )
            return least, most

        self._tell(jnp.isnan(T), other, limits, ALONG_VOLUME)
        y = fraction(T)
        return Gas(T, jnp.clip(y, 0.0, 1.0), jnp.zeros_like(T)), (y >= -ROUNDING) & (
            y <= self._ys(T) * (1 + ROUNDING)
        )

    def _saturated_and_dry(self, v: Any) -> tuple[Any, Any]:
        """Temperatures of saturated and of dry gas whose volume per mole of dry gas is given."""
        pair, P = self.pair, self.P
        low, high = pair.lowest_temperature + 0.0 * v * P, pair.highest_temperature
        dry = falling_root(lambda T: v - pair.molar_volume(T, P, jnp.zeros_like(T)), low, high)

        def saturated(T: Any) -> Any:
            ys = jnp.minimum(self._ys(T), 1.0)
            return v * (1.0 - ys) - pair.molar_volume(T, P, ys)

        return falling_root(saturated, low, jnp.minimum(dry, pair.boiling_temperature(P)) * (1 + SLACK)), dry

    def _coldest(self, balance: Callable[[Any], Any], lower: Any, upper: Any, volume: Any) -> Any:
        """The coldest root of a balance that falls, or that may turn round: heavy solvents have two states of
        one volume.
        """
        if not self.pair.heavy_vapor:
            return self._falling(balance, lower, upper)
        lower, upper = jnp.broadcast_arrays(lower * (1 - SLACK), upper * (1 + SLACK))
        # states lie close near saturation
        share = jnp.linspace(0.0, 1.0, SAMPLES).reshape((-1,) + (1,) * lower.ndim) ** 2
        T = lower + share * (upper - lower)
        values = jax.lax.map(balance, T)
        change = values[:-1] * values[1:] < 0
        found = jnp.any(change, axis=0)
        first = jnp.argmax(change, axis=0)[None]
        ends = tuple(jnp.take_along_axis(t, first, axis=0)[0] for t in (T[:-1], T[1:]))
        hidden = jax.lax.cond(
            jnp.all(found), lambda: (lower, upper, ~found), lambda: _between_samples(balance, T, values)
        )
        crossed = ~found & hidden[2]
        low, high = (
            jnp.where(found, a, jnp.where(crossed, b, c))
            for a, b, c in zip(ends, hidden, (lower, upper), strict=False)
        )
        flags.limit_active((jnp.sum(change, axis=0) > 1) | crossed, volume, "specific_volume", TWO_STATES)
        return find_root(balance, low, high, tolerance=1e-13).value


def _between_samples(balance: Callable[[Any], Any], T: Any, values: Any) -> tuple[Any, Any, Any]:
    """Where samples of one sign are nearest to zero: the sample before and the turning point, and whether the
    balance crosses zero there.
    """
    T, values = jax.lax.stop_gradient((T, values))
    nearest = jnp.argmin(jnp.abs(values), axis=0)[None]
    at = [jnp.take_along_axis(T, jnp.clip(nearest + step, 0, SAMPLES - 1), axis=0)[0] for step in (-1, 1)]
    side = jnp.sign(values[0])
    low, high = golden_section(lambda T: side * balance(T), at[0], at[1], SECTIONS)
    turn = 0.5 * (low + high)
    return at[0], turn, side * balance(turn) < 0
