"""A thin web on its way: one moisture and one temperature through its thickness, heat from hot surfaces and
gas, vapor to the gas on its sides.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.drying.isotherms.base import AbstractIsotherm
from granum.numerics import find_root
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream

NEARLY_BOILING = 0.999  # share of vapor beyond which the logarithm of Stefan goes on as its tangent
SHARE = 1.0 / (2.0 + 2.0**0.5)  # of Rosenbrock's method of second order that damps what is stiff


class Air(NamedTuple):
    """Gas beside a web: temperature, mole fraction of vapor, pressure, and vapor per heat transferred."""

    temperature: Any
    vapor: Any
    pressure: Any
    vapor_per_heat: Any  # molar mass of the vapor over the molar heat capacity of the gas, kg K/J

    @classmethod
    def of(cls, gas: Stream, humid: HumidMixture) -> Air:
        """The surroundings that a stream makes."""
        moles = jnp.sum(gas.gas / humid.molar_masses)
        capacity = gas.gas_heat_capacity * gas.gas_flow / jnp.where(moles > 0, moles, 1.0)
        mass = humid.molar_masses[humid.vapor]
        vapor = jnp.minimum(humid.fraction(gas), 1.0 - 1e-6)
        return cls(
            gas.temperature,
            vapor,
            jnp.asarray(gas.pressure, dtype=float),
            mass / (jnp.where(capacity > 0, capacity, 1.0) * humid.lewis_factor),
        )


class Phase(NamedTuple):
    """A stretch of the way: a hot surface on one side (temperature, coefficient as a function of moisture),
    and the coefficients of heat and of vapor transfer (as heat) summed over the sides open to the gas; heat
    that the web absorbs besides, W/m², as a function of moisture and temperature.
    """

    hot: Any
    contact: Callable[[Any], Any]
    exchange: Any
    evaporation: Any
    absorbed: Callable[[Any, Any], Any] | None = None


class Web(NamedTuple):
    """The web: dry mass per area, heat capacities of dry solid and liquid, what it evaporates."""

    dry_mass: Any
    solid_capacity: Any
    liquid_capacity: Any
    isotherm: AbstractIsotherm
    humid: HumidMixture

    def flux(self, X: Any, T: Any, phase: Phase, air: Air) -> Any:
        """Vapor given off, kg/(m² s); none is taken back."""
        activity = self.isotherm.activity(jnp.maximum(X, 1e-9), T)
        y = activity * self.humid.saturation_pressure(T) / air.pressure
        below = jnp.minimum(y, NEARLY_BOILING)
        stefan = jnp.log((1.0 - air.vapor) / (1.0 - below)) + (y - below) / (1.0 - NEARLY_BOILING)
        return phase.evaporation * air.vapor_per_heat * jnp.maximum(stefan, 0.0)

    def slopes(self, state: tuple[Any, Any], phase: Phase, air: Air) -> tuple[Any, Any, Any]:
        """Rates of moisture, temperature, and heat taken from the hot surface and absorbed."""
        X, T = state
        flux = self.flux(X, T, phase, air)
        given = phase.contact(jnp.maximum(X, 0.0)) * (phase.hot - T)
        if phase.absorbed is not None:
            given = given + phase.absorbed(jnp.maximum(X, 0.0), T)
        heat = given + phase.exchange * (air.temperature - T)
        sorbed = jnp.maximum(self.isotherm.net_isosteric_heat(jnp.maximum(X, 1e-6), T), 0.0)
        latent = self.humid.heat_of_vaporization(T) + sorbed
        capacity = self.dry_mass * (self.solid_capacity + jnp.maximum(X, 0.0) * self.liquid_capacity)
        return -flux / self.dry_mass, (heat - flux * latent) / capacity, given

    def step(self, state: tuple[Any, Any], h: Any, phase: Phase, air: Air) -> tuple[Any, Any, Any]:
        """One step of Rosenbrock's method of second order, and the heat from the hot surface, J/m²."""

        def rates(y: tuple[Any, Any]) -> tuple[Any, Any, Any]:
            return self.slopes(y, phase, air)

        one, none = jnp.ones(()), jnp.zeros(())
        (fX, fT, fq), (aX, aT, aq) = jax.jvp(rates, (state,), ((one, none),))
        (bX, bT, bq) = jax.jvp(rates, (state,), ((none, one),))[1]
        d = SHARE * h
        m11, m12, m21, m22 = 1.0 - d * aX, -d * bX, -d * aT, 1.0 - d * bT
        determinant = m11 * m22 - m12 * m21

        def solved(rX: Any, rT: Any) -> tuple[Any, Any]:
            return (m22 * rX - m12 * rT) / determinant, (m11 * rT - m21 * rX) / determinant

        kX, kT = solved(fX, fT)
        kq = fq + d * (aq * kX + bq * kT)
        gX, gT, gq = rates((state[0] + 0.5 * h * kX, state[1] + 0.5 * h * kT))
        lX, lT = solved(gX - kX, gT - kT)
        lq = gq - kq + d * (aq * lX + bq * lT)
        return (
            jnp.maximum(state[0] + h * (kX + lX), 0.0),
            state[1] + h * (kT + lT),
            h * (kq + lq),
        )

    def along(self, state: tuple[Any, Any], time: Any, phase: Phase, air: Air, steps: int) -> tuple[Any, ...]:
        """State after a stretch, heat from the hot surface (J/m²) and highest temperature on it."""
        h = time / steps

        def one(carry: tuple[Any, ...], _none: Any) -> tuple[tuple[Any, ...], None]:
            X, T, q, top = carry
            X, T, more = self.step((X, T), h, phase, air)
            return (X, T, q + more, jnp.maximum(top, T)), None

        first = (
            *(jnp.asarray(v, dtype=float) for v in state),
            jnp.zeros(()),
            jnp.asarray(state[1], dtype=float),
        )
        return jax.lax.scan(one, first, None, length=steps)[0]


def no_contact(X: Any) -> Any:
    """The coefficient of a hot surface where there is none."""
    return 0.0 * X


def in_its_own_vapor(X1: Any, run: Callable[[Any], tuple[Any, Any]]) -> tuple[Any, Any, Any]:
    """Moisture reached, whatever else ``run`` tells, and whether it was found, of a web whose gas is as humid
    as it makes it itself; ``run`` is told the share of the feed's liquid that the gas carries away.
    """
    root = find_root(lambda share: X1 - run(share)[0] - share * X1, 0.0, 1.0, start=0.8, tolerance=1e-10)
    some = X1 > 1e-9
    X2, more = run(jnp.where(some, root.value, 0.0))
    return jnp.minimum(X2, X1), more, root.converged | ~some


def web_of(feed: Stream, dry_mass: Any, isotherm: AbstractIsotherm, humid: HumidMixture) -> Web:
    """The web that a moist solid makes."""
    T = feed.temperature

    def capacity(part: Stream, flow: Any) -> Any:
        rise = part.enthalpy_at(T + 0.5) - part.enthalpy_at(T - 0.5)
        return rise / jnp.where(flow > 0, flow, 1.0)

    solid = capacity(feed.part(solid=1.0), feed.solid_flow)
    liquid = capacity(feed.part(liquid=1.0), feed.liquid[0])
    return Web(
        jnp.asarray(dry_mass, dtype=float),
        jnp.where(solid > 0, solid, 1000.0),
        jnp.where(liquid > 0, liquid, 4186.0),
        isotherm,
        humid,
    )
