"""Solid of many classes in a gas that is mixed with it: a well-mixed bed with all its ages, or tanks in
series, each with fresh gas.

Whatever the gas in a bed is like, the moisture and temperature of each class follow from it one by one; and
the gas has but two unknowns, humidity and temperature, between bounds that no dryer can leave. Each search
here is for the one root of something that rises or falls:

* of a class in a stretch of its life: the more it dries, the drier and colder it is, the slower it dries;
* of the gas: the more humid it is, the less goes into it; the hotter, the more water and the less heat is
    left over for it.

Ages: of the solid in a well-mixed bed the share e^(−y) is older than y mean residence times. On each stretch
of ages moisture falls in a straight line down to equilibrium and temperature is one. The balance over the
stretch is exact for that line, so that kinetics of first order give 1/(1 + kτ) and a constant rate its closed
form on any grid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.drying.gas_solid.cells import Profile
from granum.drying.gas_solid.kinetics import LEAST, AbstractKinetics, Meeting
from granum.drying.gas_solid.matter import Matter, slope, temperature_at
from granum.numerics import crossing_pair
from granum.numerics.quick_roots import falling_root, straight_root

# ages in residence times: the first stretch, the oldest particle, how many stretches
FIRST, LAST, STRETCHES = 0.002, 10.0, 20
HEAT_STEPS = 3  # of Newton's method: enthalpy is nearly linear in temperature
COLD, HOT = 180.0, 2500.0  # K, between which the search for a temperature stays
# K that the gas may be below the wet bulb of dry gas as cold as the coldest inlet, and above the hottest one
COOLER = WARMER = 5.0
CONDENSING = 2500.0  # K by which gas is warmed, per humidity, at most, if its vapor goes into the solid
ENTHALPY = 1e5  # J/kg
DEW_STEPS = 5
MOST_CONDENSED = 0.999  # of steam
NEARLY, GUESSES = 0.9, 8  # relative humidity of the guess; its halvings
# of Gauss and Legendre between 0 and 1
_NODES, _WEIGHTS = (0.5 * (1.0 - 3.0**-0.5), 0.5 * (1.0 + 3.0**-0.5)), (0.5, 0.5)


class Gas(NamedTuple):
    """Gas that meets the solid."""

    humidity: Any
    temperature: Any


class Solid(NamedTuple):
    """Solid by class."""

    moisture: Any
    temperature: Any


class Life(NamedTuple):
    """Stretches of age: length in residence times, share of all solid that is older at the end than at the
    beginning.
    """

    length: Any
    older: Any  # at the beginning

    @property
    def share(self) -> Any:
        """Of all solid, on each."""
        return -self.older * np.expm1(-self.length)


class Spread(NamedTuple):
    """How a class that loses so much per residence time is spread over a stretch of its life."""

    points: Any  # moisture there
    weights: Any  # of the points, adding up to one
    drying: Any  # share of the stretch in which it dries; of those that enter
    whole: Any  # share of those that enter which is on the stretch
    end: Any  # moisture at the end


class Lived(NamedTuple):
    """What became of a class on a stretch: moisture and enthalpy of those who leave it there, per kg of all;
    means; loss per residence time.
    """

    water: Any
    enthalpy: Any
    moisture: Any
    temperature: Any
    loss: Any


class Found(NamedTuple):
    """Of a bed or tank: gas, mean moisture and enthalpy that leave, the solid on its way, whether it was
    solved.
    """

    gas: Gas
    moisture: Any
    enthalpy: Any
    lived: Lived
    converged: Any


def life() -> Life:
    """Stretches that grow in proportion."""
    growth = 1.0 + np.geomspace(1e-3, 9.0, 20001)
    ends = FIRST * (growth**STRETCHES - 1.0) / (growth - 1.0)
    factor = float(np.interp(LAST, ends, growth))
    length = FIRST * factor ** np.arange(STRETCHES)
    return Life(length, np.exp(-(np.cumsum(length) - length)))


class Bed(eqx.Module):
    """Solid that stays for a mean time in a mixed gas.

    flow: dry solid by class, kg/s. time: mean residence time, s. exchange: W/(K kg of dry solid) by class.
        gas_flow: dry gas, kg/s.
    heat_loss: of the gas, W.
    """

    matter: Matter
    kinetics: AbstractKinetics
    exchange: Any
    flow: Any
    time: Any
    gas_flow: Any
    heat_loss: Any = 0.0

    def meeting(self, X: Any, T: Any, gas: Gas, wet_bulb: Any) -> Meeting:
        """Where this solid meets the gas."""
        return Meeting(X, T, gas.temperature, gas.humidity, self.given(gas), self.matter, wet_bulb)

    def given(self, gas: Gas) -> Any:
        """The exchange with this gas."""
        return self.exchange * self.matter.left_over(gas.humidity)

    def lived(
        self, before: Solid, gas: Gas, known: tuple[Any, Any], spread: Any, most: Any, start: Any
    ) -> tuple[Any, Any, Spread]:
        """Loss per residence time of each class on a stretch, at ``most`` so much, its temperature there and
        its spread, which ``spread`` gives from the loss.
        """
        rest, bulb = known
        X0, T0 = before
        m, warm, exchange = self.matter, gas.temperature, self.given(gas)
        H0 = m.moist_solid(T0, X0)

        def temperature(loss: Any) -> Any:
            """From the heat that solid and vapor take up."""
            s = spread(loss)
            left, gone = X0 - loss * s.drying, loss * s.drying
            rate = gone / (s.whole * self.time)

            def surplus(T: Any) -> Any:
                heat = exchange * hindered(m, rate, T, exchange) * (warm - T)
                return m.moist_solid(T, left) - H0 - s.whole * self.time * heat + gone * m.vapor_enthalpy(T)

            return straight_root(surplus, T0 + 0.0 * loss, HEAT_STEPS, within=(COLD, HOT))

        def rates(X: Any, T: Any) -> Any:
            return self.time * self.kinetics.rate(self.meeting(X, T, gas, bulb))

        def balance(loss: Any) -> Any:
            s = spread(loss)
            return jnp.sum(s.weights * rates(s.points, temperature(loss)), axis=0) - loss

        # colder than cold nothing dries; what is drier than its equilibrium does not dry either
        low, high = lax.stop_gradient(
            rates(jnp.stack([X0, X0]), jnp.stack([COLD + 0.0 * T0, jnp.maximum(T0, warm)]))
        )
        high = jnp.where(rest < X0, jnp.minimum(jnp.maximum(high, 0.0), most), 0.0)
        size = jnp.max(abs(X0)) + jnp.max(abs(rest))
        slack = 1e-9 * size
        bounds = jnp.minimum(low, 0.0) - slack, high + slack
        loss = falling_root(balance, *bounds, start=start, size=1e-2 * size)
        return loss, temperature(loss), spread(loss)

    def tank(self, before: Solid, gas: Gas, known: tuple[Any, Any], start: Any) -> Lived:
        """All at the moisture at which it leaves."""
        one = jnp.ones_like(before.moisture)

        def spread(loss: Any) -> Spread:
            end = before.moisture - loss
            return Spread(end[None], one[None], one, one, end)

        loss, T, s = self.lived(before, gas, known, spread, before.moisture - known[0], start)
        return Lived(s.end, self.matter.moist_solid(T, s.end), s.end, T, loss)

    def stretch(
        self, before: Solid, gas: Gas, known: tuple[Any, Any], length: Any, older: Any, start: Any
    ) -> tuple[Solid, Lived]:
        """One stretch of ages."""
        X0 = before.moisture
        over = X0 - known[0]
        nodes, weights = (jnp.asarray(v)[:, None] for v in (_NODES, _WEIGHTS))

        def spread(loss: Any) -> Spread:
            """In a straight line to equilibrium, on the way to it."""
            reached = (loss * over > 0) & (abs(loss) * length > abs(over))
            stays = jnp.where(reached, over / jnp.where(reached, loss, 1.0), length)
            shares = weights * jnp.exp(-stays * nodes)
            end = jnp.where(reached, X0 - over, X0 - loss * length)
            return Spread(
                X0 - loss * stays * nodes,
                shares / jnp.sum(shares, axis=0),
                -jnp.expm1(-stays),
                -jnp.expm1(-length),
                end,
            )

        loss, T, s = self.lived(before, gas, known, spread, jnp.inf, start)
        here = older * s.whole
        water = older * (X0 - loss * s.drying) - (older - here) * s.end
        enthalpy = here * self.matter.solid_enthalpy(T) + water * self.matter.liquid_enthalpy(T)
        return Solid(s.end, T), Lived(water, enthalpy, water / here, T, loss)

    def aged(self, before: Solid, gas: Gas, known: tuple[Any, Any], start: Any) -> Lived:
        """Through all ages; the leading axis of what is returned runs over the stretches."""
        stretches = life()

        def on(carry: tuple[Solid, Any], row: tuple) -> tuple[tuple[Solid, Any], Lived]:
            (solid, last), (length, older, likely) = carry, row
            after, lived = self.stretch(
                solid, gas, known, length, older, jnp.where(jnp.isfinite(likely), likely, last)
            )
            return (after, lived.loss), lived

        like = jax.tree.map(lambda v: v + 0.0 * (gas.temperature + gas.humidity), before)
        (oldest, _loss), lived = lax.scan(
            on, (like, jnp.nan * like.moisture), (*map(jnp.asarray, stretches), start)
        )
        rest = stretches.older[-1] * np.exp(-stretches.length[-1])
        water, enthalpy = (
            rest * oldest.moisture,
            rest * self.matter.moist_solid(oldest.temperature, oldest.moisture),
        )
        return lived._replace(
            water=lived.water.at[-1].add(water), enthalpy=lived.enthalpy.at[-1].add(enthalpy)
        )

    def cleared(self, x: Any) -> Any:
        """Gas so warm that it holds its vapor: no bed leaves it beyond saturation, where its signs would tell
        nothing.
        """
        Y, T = x
        for _step in range(DEW_STEPS):
            beyond = jnp.log(jnp.maximum(self.matter.relative_humidity(T, Y), LEAST))
            fall = slope(lambda T: -jnp.log(self.matter.saturation_pressure(T)), T)[1]
            T = T + jnp.maximum(beyond, 0.0) / jnp.maximum(-fall, 1e-3)
        return jnp.stack([Y, T])

    def known(self, gas: Gas, before: Solid) -> tuple[Any, Any]:
        """What hangs on the gas alone: equilibrium and wet bulb."""
        bulb = (
            self.meeting(before.moisture, before.temperature, gas, None).wet_bulb
            if self.kinetics.asks_wet_bulb
            else None
        )
        return self.kinetics.equilibrium(self.meeting(before.moisture, before.temperature, gas, bulb)), bulb

    def likely(self, before: Solid, fresh: Gas, enthalpy: Any) -> Gas:
        """Gas and solid of one temperature, most of the water evaporated or the gas nearly saturated; so much
        enthalpy per kg of dry gas.
        """
        m, F = self.matter, self.flow / self.gas_flow
        water = jnp.sum(F * before.moisture)

        def met(share: Any) -> Gas:
            def held(T: Any) -> Any:
                return m.moist_gas(T, Y) + jnp.sum(
                    F * m.moist_solid(T * jnp.ones_like(F), before.moisture * (1.0 - share))
                )

            Y = fresh.humidity + share * water
            T = temperature_at(held, enthalpy, fresh.temperature)
            return Gas(Y, jnp.clip(T, COLD, HOT))

        def halve(_step: int, carry: tuple[Any, Any, Gas]) -> tuple[Any, Any, Gas]:
            low, high, _last = carry
            middle = 0.5 * (low + high)
            gas = met(middle)
            wet = m.relative_humidity(gas.temperature, gas.humidity) > NEARLY
            return jnp.where(wet, low, middle), jnp.where(wet, middle, high), gas

        zero = 0.0 * (enthalpy + water + fresh.humidity + fresh.temperature)
        return lax.fori_loop(0, GUESSES, halve, (zero, zero + 1.0, Gas(zero, zero)))[2]

    def solved(self, before: Solid, fresh: Gas, ages: bool, guess: Gas | None = None) -> Found:
        """The gas that leaves what enters it, and the solid in it."""
        m, F = self.matter, self.flow / self.gas_flow
        H0, Hg0 = (
            m.moist_solid(before.temperature, before.moisture),
            m.moist_gas(fresh.temperature, fresh.humidity),
        )
        inlets = jnp.append(before.temperature, fresh.temperature)
        shares = jnp.asarray(life().share)[:, None] if ages else 1.0
        most = fresh.humidity + jnp.sum(F * before.moisture)
        # dry gas as cold as whatever enters: far below its wet bulb solid would drink from gas that has
        # nothing to give, and the signs of the balances would tell nothing
        coldest = self.meeting(before.moisture, before.temperature, Gas(0.0, jnp.min(inlets)), None)
        chilled = self.heat_loss / (self.gas_flow * m.gas_heat_capacity(fresh.temperature, 0.0))
        low = jnp.stack(
            [
                -1e-9 - MOST_CONDENSED * m.is_steam,
                jnp.maximum(coldest.wet_bulb - jnp.maximum(chilled, 0.0) - COOLER, COLD),
            ]
        )
        high = jnp.stack([most * (1.0 + 1e-6) + 1e-9, jnp.max(inlets) + WARMER + CONDENSING * fresh.humidity])

        def lacks(x: Any, start: Any) -> tuple[Any, Any, Any]:
            gas = Gas(x[0], x[1])
            known = self.known(gas, before)
            lived = self.aged(before, gas, known, start) if ages else self.tank(before, gas, known, start)
            X, H = (jnp.sum(v, axis=0) if ages else v for v in (lived.water, lived.enthalpy))
            water = gas.humidity - fresh.humidity - jnp.sum(F * (before.moisture - X))
            heat = (
                m.moist_gas(gas.temperature, gas.humidity)
                - Hg0
                - jnp.sum(F * (H0 - H))
                + self.heat_loss / self.gas_flow
            )
            # with the water balance so much of it, evaporation cancels where all solid has one temperature:
            # what is left is smooth
            weights = (
                jnp.where(jnp.sum(F) > 0.0, F, 1.0) * shares * (abs(before.moisture - lived.moisture) + LEAST)
            )
            reference = m.liquid_enthalpy(jnp.sum(weights * lived.temperature) / jnp.sum(weights))
            return (
                jnp.stack([water / (1e-3 + most), (heat - reference * water) / ENTHALPY]),
                lived.loss,
                (X, H, lived),
            )

        nothing = jnp.full(((STRETCHES,) if ages else ()) + before.moisture.shape, jnp.nan)
        likely = lax.stop_gradient(
            self.likely(before, fresh, Hg0 + jnp.sum(F * H0) - self.heat_loss / self.gas_flow)
        )
        if guess is not None:
            likely = jax.tree.map(
                lambda known, made: jnp.where(jnp.isfinite(known), known, made), guess, likely
            )
        start = jnp.stack(likely)
        found = crossing_pair(lacks, low, high, start, nothing, self.cleared)
        moisture, enthalpy, lived = found.made
        return Found(Gas(found.value[0], found.value[1]), moisture, enthalpy, lived, found.converged)


def steady_bed(bed: Bed, before: Solid, fresh: Gas) -> Profile:
    """A well-mixed bed; the places are its ages, the first of them the solid as it enters, which leaves from
    everywhere.
    """
    found = bed.solved(before, fresh, True)
    stretches = life()
    entered = jax.tree.map(
        lambda first, later: jnp.concatenate([first[None], later]),
        before,
        Solid(found.lived.moisture, found.lived.temperature),
    )
    older = stretches.older * np.exp(-0.5 * stretches.length)
    like = jnp.ones(STRETCHES + 1)
    return Profile(
        _shares(bed.flow),
        jnp.append(0.0, 1.0 - older),
        entered.moisture,
        entered.temperature,
        found.gas.humidity * like,
        found.gas.temperature * like,
        bed.flow * found.moisture,
        bed.flow * found.enthalpy,
        bed.gas_flow * found.gas.humidity,
        bed.gas_flow * bed.matter.moist_gas(found.gas.temperature, found.gas.humidity),
        -bed.heat_loss * jnp.ones(()),
        found.converged,
        like > 0,
    )


def steady_tanks(tank: Bed, before: Solid, fresh: Gas, number: int) -> Profile:
    """So many equal tanks in series, each with its share of the gas."""

    def on(carry: tuple[Solid, Gas], _none: None) -> tuple[tuple[Solid, Gas], Found]:
        solid, guess = carry
        found = tank.solved(solid, fresh, False, guess)
        return (Solid(found.moisture, found.lived.temperature), found.gas), found

    _last, found = lax.scan(on, (before, Gas(*2 * (jnp.asarray(jnp.nan),))), length=number)
    gas_enthalpy = tank.matter.moist_gas(found.gas.temperature, found.gas.humidity)
    return Profile(
        _shares(tank.flow),
        (jnp.arange(number) + 0.5) / number,
        found.moisture,
        found.lived.temperature,
        *found.gas,
        tank.flow * found.moisture[-1],
        tank.flow * found.enthalpy[-1],
        tank.gas_flow * jnp.sum(found.gas.humidity),
        tank.gas_flow * jnp.sum(gas_enthalpy),
        -number * tank.heat_loss * jnp.ones(()),
        jnp.all(found.converged),
        jnp.arange(number) == number - 1,
    )


def _shares(flow: Any) -> Any:
    return flow / jnp.where(jnp.sum(flow) > 0, jnp.sum(flow), 1.0)


def hindered(matter: Matter, rate: Any, T: Any, exchange: Any) -> Any:
    """Ackermann: vapor that leaves the surface hinders the heat."""
    blow = rate * matter.vapor_heat_capacity(T) / exchange
    small = abs(blow) < 1e-6
    safe = jnp.where(small, 1.0, blow)
    return jnp.where(small, 1.0 - 0.5 * blow, safe / jnp.expm1(safe))
