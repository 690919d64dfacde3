"""Lines of constant temperature, relative humidity, wet bulb, enthalpy and volume inside a window of
temperature and humidity.
"""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np

import granum.humid_gas.relations as rel
from granum.core.constants import ZERO_CELSIUS
from granum.core.packing import as_arrays, compiled
from granum.humid_gas.formulas.state import state
from granum.humid_gas.pairs import AbstractPair

POINTS = 321
BLOCK = 512


def nice_steps(low: float, high: float, count: int) -> np.ndarray:
    """Round values from low to high, about so many."""
    raw = (high - low) / max(count, 1)
    power = 10.0 ** np.floor(np.log10(raw))
    step = power * min((1.0, 2.0, 2.5, 5.0, 10.0), key=lambda m: abs(np.log(m * power / raw)))
    return np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1) * step


@compiled
def _enthalpy(pair: AbstractPair, P: Any, T: Any, w: Any) -> Any:
    return rel.enthalpy_of(pair, rel.Gas(T, pair.fraction(w), jnp.zeros_like(T)), P)


@compiled
def _at_relative_humidity(pair: AbstractPair, P: Any, _lewis: Any, phi: Any, T: Any) -> Any:
    return phi * rel.saturated_fraction(pair, T, P)


@compiled
def _at_enthalpy(pair: AbstractPair, P: Any, _lewis: Any, h: Any, T: Any) -> Any:
    return rel.fraction_at_enthalpy(pair, T, P, h)


@compiled
def _at_volume(pair: AbstractPair, P: Any, _lewis: Any, v: Any, T: Any) -> Any:
    return pair.fraction_at_volume(T, P, v)


@compiled
def _at_wet_bulb(pair: AbstractPair, P: Any, lewis: Any, wet: Any, T: Any) -> Any:
    return rel.fraction_at_wet_bulb(pair, T, P, wet, lewis)


ALONG = {
    "relative_humidity": _at_relative_humidity,
    "enthalpy": _at_enthalpy,
    "specific_volume": _at_volume,
    "wet_bulb_temperature": _at_wet_bulb,
}
"""Mole fractions of vapor along a line over the temperature."""


class Isolines:
    """Isolines of one pair at one pressure."""

    def __init__(
        self,
        pair: AbstractPair,
        P: float,
        T_low: float,
        T_high: float,
        w_high: float,
        states: tuple[np.ndarray, np.ndarray] | None = None,
    ):
        self.pair, self.P, self.T_low, self.T_high, self.w_high = pair, P, T_low, T_high, w_high
        self.lewis = pair.lewis_factor()
        self.T = np.linspace(T_low, T_high, POINTS)
        self.saturated = self._humidity(rel.saturated_fraction(pair, jnp.asarray(self.T), P))
        self._describe(states)

    def _humidity(self, y: Any) -> np.ndarray:
        y = np.asarray(y, dtype=float)
        return np.asarray(np.where(y < 1.0, self.pair.humidity_ratio(np.where(y < 1.0, y, 0.0)), np.inf))

    def enthalpy(self, T: np.ndarray, w: np.ndarray) -> np.ndarray:
        """J per kg of dry gas, never fog."""
        T, w = np.broadcast_arrays(np.asarray(T, dtype=float), np.asarray(w, dtype=float))
        padded = np.zeros((2, BLOCK * -(-max(T.size, 1) // BLOCK)))  # lines of any length are one program
        padded[:, : T.size] = T.ravel(), w.ravel()
        found = _enthalpy(*as_arrays((self.pair, float(self.P))), *padded)
        return found[: T.size].reshape(T.shape)

    def line(self, kind: str, value: float) -> tuple[np.ndarray, np.ndarray]:
        """Temperatures and humidities along a line, from its cold end, cut at saturation and at the
        window.
        """
        if kind == "temperature":
            top = min(float(np.interp(value, self.T, np.minimum(self.saturated, 1e3))), self.w_high)
            w = np.linspace(0.0, top, 41)
            return np.full_like(w, value), w
        T = self.T
        given = as_arrays((self.pair, float(self.P), self.lewis, float(value)))
        w = self._humidity(ALONG[kind](*given, T))
        if kind == "wet_bulb_temperature":
            w = np.where(value <= T, w, np.nan)
        limit = np.minimum(self.saturated * (1.0 + 1e-9), self.w_high)
        if kind == "relative_humidity":
            limit = np.full_like(T, self.w_high)
        return self._cut(T, w, limit)

    def _cut(self, T: np.ndarray, w: np.ndarray, limit: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The part of a line between zero and the limit, its ends interpolated."""
        inside = (w >= 0.0) & (w <= limit) & np.isfinite(w)
        if not inside.any():
            return np.array([]), np.array([])
        first, last = int(np.argmax(inside)), len(T) - 1 - int(np.argmax(inside[::-1]))
        Ts, ws = list(T[first : last + 1]), list(w[first : last + 1])
        for outer, inner, insert in ((first - 1, first, 0), (last + 1, last, len(Ts))):
            if 0 <= outer < len(T) and np.isfinite(w[outer]):
                over = np.array([w[outer] - min(limit[outer], 1e9), w[inner] - min(limit[inner], 1e9)])
                under = np.array([-w[outer], -w[inner]])
                gap = over if over[0] > 0 else under
                share = gap[0] / (gap[0] - gap[1]) if gap[0] != gap[1] else 1.0
                Ts.insert(insert, T[outer] + share * (T[inner] - T[outer]))
                ws.insert(insert, w[outer] + share * (w[inner] - w[outer]))
        return np.array(Ts), np.clip(np.array(ws), 0.0, self.w_high)

    def range_of(self, kind: str) -> tuple[float, float]:
        """Smallest and largest value of a quantity inside the window."""
        w = np.minimum(self.saturated, self.w_high)
        if kind == "enthalpy":
            return float(self.enthalpy(self.T, 0.0 * w).min()), float(self.enthalpy(self.T, w).max())
        if kind == "wet_bulb":
            return self.T_low, self._wettest
        found = [
            rel.volume_of(
                self.pair, rel.Gas(jnp.asarray(T), self.pair.fraction(jnp.asarray(h)), jnp.zeros(())), self.P
            )
            for T, h in ((self.T_low, 0.0), (self.T_high, float(w[-1])))
        ]
        return float(found[0]), float(found[1])

    def _describe(self, states: tuple[np.ndarray, np.ndarray] | None) -> None:
        """Full states of a grid over the window, of its upper right corner and of the states given, in one
        call.
        """
        T, w = (
            a.ravel()
            for a in np.meshgrid(np.linspace(self.T_low, self.T_high, 61), np.linspace(0.0, self.w_high, 46))
        )
        top = np.minimum(self.saturated, self.w_high)
        inside = w <= np.interp(T, self.T, np.minimum(self.saturated, 1e3))
        more = (np.array([]), np.array([])) if states is None else states
        T, w = np.concatenate([T, [self.T_high], more[0]]), np.concatenate([w, [float(top[-1])], more[1]])
        found = state(temperature=T, humidity_ratio=w, pressure=self.P, pair=self.pair)
        data = np.stack(
            [
                T - ZERO_CELSIUS,
                1e3 * w,
                100.0 * np.asarray(found.relative_humidity),
                np.asarray(found.wet_bulb_temperature) - ZERO_CELSIUS,
                np.asarray(found.dew_point_temperature) - ZERO_CELSIUS,
                np.asarray(found.enthalpy) / 1e3,
                np.asarray(found.specific_volume),
            ],
            axis=1,
        )
        count = inside.size
        self._wettest = float(data[count, 3]) + ZERO_CELSIUS
        self.grid = (T[:count][inside], w[:count][inside], np.round(data[:count][inside], 4))
        self.states = data[count + 1 :]
