"""Psychrometric relations of any pair, on temperature T, pressure P and vapor mole fraction y: balances and
their bracketed roots.

Every unknown is sought between physical ends at which the balance has opposite signs, so no search can fail
inside the range.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.humid_gas.pairs import NEARLY_LINEAR, SLACK, AbstractPair
from granum.numerics.blocks import blockwise
from granum.numerics.quick_roots import falling_root, newton_root

LARGE = 1000  # elements from which a second, ice-free copy of the search is worth compiling


class Gas(NamedTuple):
    """A state: temperature, gas-phase vapor fraction (at most saturated) and condensate per dry gas, mol/mol,
    that floats as fog.
    """

    T: Any
    y: Any
    fog: Any


def saturated_fraction(pair: AbstractPair, T: Any, P: Any) -> Any:
    """Vapor fraction at saturation over the phase that is stable at T."""
    return pair.saturated_fraction(T, P, pair.is_frozen(T))


def enthalpy_of(pair: AbstractPair, gas: Gas, P: Any) -> Any:
    """J per kg of dry gas, fog included."""
    h = pair.molar_enthalpy(gas.T, P, gas.y) / (1.0 - gas.y)
    fog = jnp.where(
        gas.fog > 0, gas.fog * pair.condensate_molar_enthalpy(gas.T, P, pair.is_frozen(gas.T)), 0.0
    )
    return (h + fog) / pair.gas_molar_mass


def volume_of(pair: AbstractPair, gas: Gas, P: Any) -> Any:
    """Gas-phase volume, m³ per kg of dry gas (the volume of fog drops is left out)."""
    return pair.molar_volume(gas.T, P, gas.y) / ((1.0 - gas.y) * pair.gas_molar_mass)


def humidity_of(pair: AbstractPair, gas: Gas) -> Any:
    """All vapor and fog per dry gas."""
    return pair.humidity_ratio(gas.y) + pair.molar_mass_ratio * gas.fog


def settled(pair: AbstractPair, T: Any, P: Any, y: Any) -> Gas:
    """The state of temperature T and total vapor fraction y: what is above saturation becomes fog."""
    ys = saturated_fraction(pair, T, P)
    foggy = y > ys
    ys = jnp.where(foggy, ys, 0.5)
    total = jnp.where(foggy, y, 0.5)
    fog = total / (1.0 - total) - ys / (1.0 - ys)
    return Gas(T, jnp.where(foggy, ys, y), jnp.where(foggy, fog, 0.0))


def wet_bulb_balance(pair: AbstractPair, Ts: Any, h: Any, P: Any, y: Any, frozen: Any, lewis: Any) -> Any:
    """Heat given by the gas less heat taken by evaporation at a wet surface of temperature Ts; zero at the
    wet bulb.

    ``h`` is the molar enthalpy of the gas. Scaled by (1 − y)(1 − ys), which keeps it finite up to pure vapor
    and to the boiling point. Without a Lewis factor it is the adiabatic-saturation balance of enthalpies.
    """
    ys = pair.saturated_fraction(Ts, P, frozen)
    saturated = pair.molar_enthalpy(Ts, P, ys)
    condensate = pair.condensate_molar_enthalpy(Ts, P, frozen)
    adiabatic = (1.0 - ys) * h + (ys - y) * condensate - (1.0 - y) * saturated
    if lewis is None:
        return adiabatic
    evaporation = (ys - y) * (pair.vapor_partial_enthalpy(Ts, P, ys) - condensate)
    return lewis * adiabatic + (lewis - 1.0) * evaporation


def wet_bulb(pair: AbstractPair, T: Any, P: Any, y: Any, lewis: Any) -> Any:
    """Temperature of the wet surface at which the balance closes: liquid where such a state exists, else
    ice.
    """
    if lewis is None:
        return blockwise(lambda T, P, y: _wet_bulb(pair, T, P, y, None), T, P, y)
    return blockwise(lambda T, P, y, lewis: _wet_bulb(pair, T, P, y, lewis), T, P, y, lewis)


def polished_wet_bulb(pair: AbstractPair, T: Any, P: Any, y: Any, lewis: Any) -> Any:
    """The wet bulb to the last digit, by one more Newton step: beside an enthalpy it fixes the state a
    million times less sharply.
    """

    def one(T: Any, P: Any, y: Any, *factor: Any) -> Any:
        lewis = factor[0] if factor else None
        Ts, h = _wet_bulb(pair, T, P, y, lewis), pair.molar_enthalpy(T, P, y)
        frozen = jax.lax.stop_gradient(pair.is_frozen(Ts))
        value, slope = jax.jvp(
            lambda Ts: wet_bulb_balance(pair, Ts, h, P, y, frozen, lewis), (Ts,), (jnp.ones_like(Ts),)
        )
        slope = jax.lax.stop_gradient(slope)
        step = jnp.where(slope < 0, value / jnp.where(slope < 0, slope, -1.0), 0.0)
        return Ts - jnp.where(abs(step) < 1e-9 * Ts, step, 0.0)

    return blockwise(one, T, P, y) if lewis is None else blockwise(one, T, P, y, lewis)


def wet_bulb_of_total(pair: AbstractPair, T: Any, P: Any, w: Any, lewis: Any) -> Any:
    """Wet bulb from the humidity ratio, fog included, block by block."""

    def one(T: Any, P: Any, w: Any, *factor: Any) -> Any:
        y = pair.fraction(w) + 0.0 * T
        cheap = pair.simplified()
        if cheap is None or y.size < LARGE:
            y = settled(pair, T, P, y).y
        # the cheaper saturation lies below the true one: where nothing passes it there is no fog to look for
        else:
            doubtful = jnp.any(y > saturated_fraction(cheap, T, P))
            y = jax.lax.cond(doubtful, lambda T, P, y: settled(pair, T, P, y).y, lambda T, P, y: y, T, P, y)
        return _wet_bulb(pair, T + 0.0 * y, P, y, factor[0] if factor else None)

    return blockwise(one, T, P, w) if lewis is None else blockwise(one, T, P, w, lewis)


def _wet_bulb(pair: AbstractPair, T: Any, P: Any, y: Any, lewis: Any) -> Any:
    Tf = pair.freezing_temperature
    boiling = pair.boiling_temperature(P)
    top = jnp.minimum(T, boiling)
    h = pair.molar_enthalpy(T, P, y)
    # at a fixed temperature everything but h and y is the same for all elements of one pressure
    liquid = (Tf <= T) & (wet_bulb_balance(pair, jnp.asarray(Tf, dtype=float), h, P, y, False, lewis) >= 0)
    frozen = jax.lax.stop_gradient(~liquid)
    guess = _refined_guess(pair, T, P, y, h, boiling)
    lower = jnp.minimum(Tf, top) * (1 - SLACK)

    def over_liquid(h: Any, P: Any, y: Any) -> Any:
        def balance(Ts: Any, h: Any, P: Any, y: Any) -> Any:
            return wet_bulb_balance(pair, Ts, h, P, y, False, lewis)

        return falling_root(
            balance,
            lower,
            top * (1 + SLACK),
            h,
            P,
            y,
            start=guess,
            rough_slope=_rough_slope(pair, T, P, y, lewis),
        )

    def over_either(h: Any, P: Any, y: Any) -> Any:
        def balance(Ts: Any, h: Any, P: Any, y: Any) -> Any:
            return wet_bulb_balance(pair, Ts, h, P, y, frozen, lewis)

        low = jnp.where(frozen, pair.lowest_temperature, lower)
        high = jnp.where(frozen, jnp.minimum(top, Tf), top) * (1 + SLACK)
        return falling_root(balance, low, high, h, P, y, start=guess)

    if frozen.size < LARGE:
        return over_either(h, P, y)
    return jax.lax.cond(jnp.any(frozen), over_either, over_liquid, h, P, y)


def _refined_guess(pair: AbstractPair, T: Any, P: Any, y: Any, h: Any, boiling: Any) -> Any:
    """Start value, brought by a Newton step each to the wet bulb of the two cheaper pairs if there are
    such.
    """
    cheap, near = pair.simplified(), pair.nearby()
    guess = _wet_bulb_guess(cheap or pair, T, P, y, boiling)
    if cheap is None or near is None:
        return guess
    for easier, enthalpy in ((cheap, cheap.molar_enthalpy(T, P, y)), (near, h)):
        value, slope = jax.jvp(
            lambda t, p=easier, h=enthalpy: wet_bulb_balance(p, t, h, P, y, False, None),
            (guess,),
            (jnp.ones_like(guess),),
        )
        guess = jnp.clip(
            guess - value / slope, guess - 5.0, jnp.minimum(guess + 5.0, jnp.minimum(T, boiling))
        )
    return guess


def _rough_slope(pair: AbstractPair, T: Any, P: Any, y: Any, lewis: Any) -> Callable[[Any], Any] | None:
    """Derivative of the balance over liquid with respect to the surface temperature, from the cheaper pair if
    there is one.
    """
    cheap = pair.simplified()
    if cheap is None:
        return None
    h = cheap.molar_enthalpy(T, P, y)
    return lambda Ts: jax.jvp(
        lambda t: wet_bulb_balance(cheap, t, h, P, y, False, lewis), (Ts,), (jnp.ones_like(Ts),)
    )[1]


def _wet_bulb_guess(pair: AbstractPair, T: Any, P: Any, y: Any, boiling: Any) -> Any:
    """Start value: saturation line exponential in T, its decay exp(−d) replaced by the inverse of a short
    series, constant capacities.
    """
    R = jnp.minimum(T, boiling)
    ys, slope = jax.jvp(lambda T: pair.saturated_fraction(T, P, False), (R,), (jnp.ones_like(R),))
    b = slope / ys
    k = (29.2 + 5.0 * y) / 44e3  # molar heat capacity over heat of vaporization, air and water
    a, C = k / b, k * (T - R)
    B = y + C + a - ys * a
    d = (jnp.sqrt(jnp.maximum(B * B - 4 * a * (y + C - ys * (1 + C)), 0.0)) - B) / (2 * a)
    for _pass in range(4):
        steep = 1 + d * (1 + d * (1 / 2 + d / 6))
        decay = steep + d * d * d * d / 24
        value = (y + C + a * d) * decay - ys * (1 + C + a * d)
        d = d - value / (a * decay + (y + C + a * d) * steep - ys * a)
    return R - d / (b + d / R)


class WetSurface(NamedTuple):
    """What a wet surface of known temperature asks of the gas, all molar: h (1 − ys) + (ys − y) taken = (1 −
    y) saturated.
    """

    ys: Any
    saturated: Any
    taken: Any
    latent: Any

    def balance(self, h: Any, y: Any) -> Any:
        """Zero where gas of a molar enthalpy and a vapor fraction has this wet surface; it rises with
        both.
        """
        return (1.0 - self.ys) * h + (self.ys - y) * self.taken - (1.0 - y) * self.saturated

    def enthalpy(self, y: Any) -> Any:
        """Molar enthalpy of the gas of vapor fraction y with this wet surface."""
        dry = 1.0 - self.ys
        return ((1.0 - y) * self.saturated - (self.ys - y) * self.taken) / jnp.where(dry > 0, dry, jnp.nan)

    def fraction(self, h: Any) -> Any:
        """Vapor fraction of the gas with this wet surface and an enthalpy of h per mole of dry gas."""
        excess = (1.0 - self.ys) * h - self.saturated
        below = excess + self.taken
        return (excess + self.ys * self.taken) / jnp.where(below == 0, jnp.nan, below)


def wet_surface(pair: AbstractPair, Ts: Any, P: Any, lewis: Any) -> WetSurface:
    """The wet surface at Ts: the enthalpy of its evaporating liquid, raised by the latent heat where the
    Lewis factor is not one.
    """
    frozen = pair.is_frozen(Ts)
    ys = jnp.minimum(pair.saturated_fraction(Ts, P, frozen), 1.0)
    condensate = pair.condensate_molar_enthalpy(Ts, P, frozen)
    latent = pair.vapor_partial_enthalpy(Ts, P, ys) - condensate
    taken = condensate if lewis is None else condensate + (1.0 - 1.0 / lewis) * latent
    return WetSurface(ys, pair.molar_enthalpy(Ts, P, ys), taken, latent)


def fraction_over(surface: WetSurface, pair: AbstractPair, T: Any, P: Any) -> Any:
    """Vapor fraction of gas at T with a wet surface; negative where even dry gas is wetter than that. Nearly
    linear in y.
    """
    return newton_root(
        lambda y: surface.balance(pair.molar_enthalpy(T, P, y), y), surface.ys + 0.0 * T, NEARLY_LINEAR
    )


def fraction_at_wet_bulb(pair: AbstractPair, T: Any, P: Any, Ts: Any, lewis: Any) -> Any:
    """Vapor fraction of gas at T whose wet bulb is Ts."""
    return fraction_over(wet_surface(pair, Ts, P, lewis), pair, T, P)


def fraction_at_enthalpy(pair: AbstractPair, T: Any, P: Any, h: Any) -> Any:
    """Vapor fraction of unsaturated gas of an enthalpy per kg dry gas."""
    first = jnp.zeros_like(T * P * h)
    return newton_root(
        lambda y: pair.molar_enthalpy(T, P, y) - h * pair.gas_molar_mass * (1.0 - y), first, NEARLY_LINEAR
    )


def dew_point(pair: AbstractPair, P: Any, y: Any) -> Any:
    """Temperature at which gas of vapor fraction y becomes saturated: dew point, or frost point where the ice
    forms first.
    """
    return blockwise(lambda P, y: _dew_point(pair, P, y), P, y)


def _dew_point(pair: AbstractPair, P: Any, y: Any) -> Any:
    return temperature_of_saturation(pair, P, y, pair.boiling_temperature(P))


def temperature_of_saturation(pair: AbstractPair, P: Any, ys: Any, upper: Any) -> Any:
    """Temperature, at most ``upper``, at which the saturated fraction has a value; the lowest of the pair
    where it would lie below.
    """
    Tf = pair.freezing_temperature
    frozen = jax.lax.stop_gradient(ys < pair.saturated_fraction(Tf, P, False))
    lowest = pair.lowest_temperature
    lower = jnp.where(frozen, lowest, Tf)
    upper = jnp.where(frozen, Tf, upper) * (1 + SLACK)
    ys = jnp.maximum(ys, pair.saturated_fraction(lowest, P, True) * (1 + SLACK))

    def balance(x: Any, P: Any, ys: Any) -> Any:
        return jnp.log(pair.saturated_fraction(1.0 / x, P, frozen)) - jnp.log(ys)

    return 1.0 / falling_root(balance, 1.0 / upper, 1.0 / (lower * (1 - SLACK)), P, ys)


def temperature_at_enthalpy(pair: AbstractPair, P: Any, y: Any, h: Any) -> Any:
    """Temperature of gas of total vapor fraction y and given enthalpy, fog included; the freezing point where
    ice and water coexist.
    """
    return blockwise(lambda P, y, h: _temperature_at_enthalpy(pair, P, y, h), P, y, h)


def _temperature_at_enthalpy(pair: AbstractPair, P: Any, y: Any, h: Any) -> Any:
    dew = dew_point(pair, P, y)
    Tf = pair.freezing_temperature
    total = y / (1.0 - jnp.minimum(y, 1 - 1e-15))

    def at(T: Any, P: Any, y: Any, total: Any, frozen: Any, fogged: Any) -> Any:
        ys = jnp.where(fogged, jnp.minimum(pair.saturated_fraction(T, P, frozen), y), y)
        fog = total - ys / (1.0 - ys)
        liquid = jnp.where(fogged, fog * pair.condensate_molar_enthalpy(T, P, frozen), 0.0)
        return (pair.molar_enthalpy(T, P, ys) / (1.0 - ys) + liquid) / pair.gas_molar_mass

    def balance(T: Any, P: Any, y: Any, total: Any, frozen: Any, fogged: Any, h: Any) -> Any:
        return h - at(T, P, y, total, frozen, fogged)

    fogged = h < at(dew, P, y, total, pair.is_frozen(dew), False)
    warm = dew > Tf
    above = h >= at(jnp.asarray(Tf), P, y, total, False, True)
    below = h < at(jnp.asarray(Tf), P, y, total, True, True)
    frozen = fogged & (~warm | below)
    lower = jnp.where(fogged, jnp.where(frozen, pair.lowest_temperature, Tf), dew * (1 - SLACK))
    upper = jnp.where(fogged, jnp.where(frozen & warm, Tf, dew), pair.highest_temperature) * (1 + SLACK)
    fogged, frozen = jax.lax.stop_gradient((fogged, frozen))
    T = falling_root(balance, lower, upper, P, y, total, frozen, fogged, h)
    possible = (pair.lowest_temperature * (1 + 1e-8) < T) & (pair.highest_temperature * (1 - 1e-8) > T)
    return jnp.where(fogged & warm & ~above & ~below, Tf, jnp.where(possible, T, jnp.nan))
