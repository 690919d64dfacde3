"""The core: classes of moist solid and moist gas through a row of cells, steady and in time, water and energy
conserved.

Solid flows from the first cell to the last (or stands still); gas flows along a network between neighboring
cells. Everything is counted per dry mass, with the enthalpies of the streams, so that what closes here closes
in the flowsheet.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.drying.gas_solid.kinetics import AbstractKinetics, Meeting
from granum.drying.gas_solid.matter import Matter, slope
from granum.numerics import Cells, Rates, advance_chain, solve_chain

ENTHALPY = 1e5  # J/kg, the unit of enthalpy among the unknowns
WARMEST_STEP = 0.4  # largest change of an enthalpy in one step of the solver, in that unit
NO_WATER = 1e-6  # of the wettest moisture
MIXED = 1e6  # flow between neighbors, over the flow through, that counts as well mixed


class Network(eqx.Module):
    """Flows of dry gas relative to the whole: into each cell from the cell before, from the cell after and
    from outside, and to the outside.

    ``one_way``: nothing comes back from the cell after, so that a steady state is found cell by cell.
    """

    from_before: Any
    from_after: Any
    inlet: Any
    outlet: Any
    one_way: bool = eqx.field(static=True, default=False)

    @classmethod
    def co_current(cls, n: int) -> Network:
        """With the solid."""
        first, last = jnp.zeros(n).at[0].set(1.0), jnp.zeros(n).at[-1].set(1.0)
        return cls(1.0 - first, jnp.zeros(n), first, last, one_way=True)

    @classmethod
    def counter_current(cls, n: int) -> Network:
        """Against the solid."""
        first, last = jnp.zeros(n).at[0].set(1.0), jnp.zeros(n).at[-1].set(1.0)
        return cls(jnp.zeros(n), 1.0 - last, last, first)

    @classmethod
    def cross_current(cls, n: int) -> Network:
        """Fresh gas to every cell."""
        return cls(jnp.zeros(n), jnp.zeros(n), jnp.full(n, 1.0 / n), jnp.full(n, 1.0 / n))

    def dispersed(self, flow: Any) -> Network:
        """The same with an exchange flow between all neighbors: axial dispersion."""
        n = len(self.inlet)
        inner = jnp.arange(n)
        return Network(
            self.from_before + flow * (inner > 0),
            self.from_after + flow * (inner < n - 1),
            self.inlet,
            self.outlet,
        )

    def matrix(self) -> Any:
        """What the flow of gas brings to each cell, by what is in all of them."""
        own = self.from_before + self.from_after + self.inlet
        return jnp.diag(-own) + jnp.diag(self.from_before[1:], -1) + jnp.diag(self.from_after[:-1], 1)

    @classmethod
    def mixed(cls, n: int) -> Network:
        """One gas in all cells."""
        return cls.cross_current(n).dispersed(MIXED)


class Inlet(NamedTuple):
    """What enters: moisture and temperature of each class of solid, humidity and temperature of the gas (one,
    or one for each cell).
    """

    moisture: Any
    temperature: Any
    humidity: Any
    gas_temperature: Any


class Entering(NamedTuple):
    """What enters as the core counts it: moisture and enthalpy of solid and gas, enthalpies in 10⁵ J/kg."""

    moisture: Any
    enthalpy: Any
    humidity: Any
    gas_enthalpy: Any


class Profile(NamedTuple):
    """State of every place (places × classes or layers for the solid; gas as it leaves the place) and the
    flows out, W and kg/s.
    """

    shares: Any  # of the classes in the product
    place: Any  # 0 … 1 along the path of the solid
    moisture: Any
    temperature: Any
    humidity: Any
    gas_temperature: Any
    water: Any  # with the solid, by class
    solid_enthalpy: Any
    vapor: Any  # with the gas
    gas_enthalpy: Any
    heat_duty: Any  # taken up from walls less lost
    converged: Any
    leaves: Any  # whether solid leaves the dryer from a place

    @property
    def wettest(self) -> Any:
        """Moisture of the wettest class that leaves the dryer."""
        there = self.leaves[:, None] & (self.shares > 1e-9)
        return jnp.max(jnp.where(there, self.moisture, 0.0))


class CellRow(NamedTuple):
    """Of one cell: solid by class, its renewal, heat lost."""

    solid: Any
    renewal: Any
    heat_loss: Any


def largest_change(moisture: Any, *more: Any) -> Cells:
    """Of the unknowns in one step of the solver."""
    return Cells(jnp.stack([0.2 * jnp.max(moisture) + 0.01, jnp.asarray(WARMEST_STEP), *more]), jnp.inf)


def march(
    rates: Callable[[Cells, Cells, Any], Rates],
    first: Cells,
    rows: Any,
    steps: Any,
    limit: Cells,
    most: Any = 2000,
) -> tuple[Cells, Any]:
    """Steady states of cells of which each depends on the one before alone: ``rates(u, before, row)``
    vanishes, u having one cell.

    On its way there the gas, too, has something to hold, for ``steps`` of time: bare, it would run ahead of
    grains so fine that they follow it. ``most`` is the number of steps that each may take.
    """

    def cell(carry: tuple[Any, Any], given: tuple[Any, Any]) -> tuple[tuple[Any, Any], Any]:
        (before, well), (row, step) = carry, given
        start = jax.tree.map(lambda leaf: leaf[None], before)
        found = solve_chain(
            lambda u: rates(u, before, row),
            start,
            Cells(1.0, step),
            first_step=step,
            largest_change=limit,
            max_steps=most,
        )
        state = jax.tree.map(lambda leaf: leaf[0], found.state)
        return (state, well & found.converged), state

    (_last, well), states = jax.lax.scan(cell, (first, jnp.asarray(True)), (rows, steps))
    return states, well


class Contact(eqx.Module):
    """A dryer as the core sees it.

    Parameters
    ----------
    matter, kinetics: what meets, and how fast it dries.
    solid: dry solid in each cell, kg (cells × classes).
    renewal: share of that which flows on per second (cells × classes); zero for solid that stands.
    gas_flow: dry gas, kg/s. network: how it flows. gas_time: residence time of the gas in the whole, s; at
        zero it holds nothing.
    exchange: function of (X, T_s, T_g, Y) → W/(K kg of dry solid); arrays of cells × classes.
    wall_exchange, wall_temperature: conduction from a hot wall to the solid, W/(K kg), K.
    heat_loss: W lost by the gas in each cell.
    """

    matter: Matter
    kinetics: AbstractKinetics
    solid: Any
    renewal: Any
    gas_flow: Any
    network: Network
    exchange: Callable[..., Any]
    wall_exchange: Any = 0.0
    wall_temperature: Any = 293.15
    heat_loss: Any = 0.0
    gas_time: Any = 0.0

    @property
    def solid_flow(self) -> Any:
        """Dry solid by class, kg/s (zero when it stands)."""
        return self.solid[-1] * self.renewal[-1]

    def state(self, X: Any, T: Any, Y: Any, Tg: Any) -> Cells:
        """The unknowns from moistures and temperatures (cells × classes, cells)."""
        H, Hg = self.matter.moist_solid(T, X) / ENTHALPY, self.matter.moist_gas(Tg, Y) / ENTHALPY
        return Cells(jnp.stack([X, H], axis=-1), jnp.stack([Y, Hg], axis=-1))

    def temperatures(self, u: Cells) -> tuple[Any, Any]:
        """Of solid and gas."""
        X, H, Y, Hg = unpacked(u)
        return self.matter.solid_temperature(ENTHALPY * H, X), self.matter.gas_temperature(ENTHALPY * Hg, Y)

    def meeting(self, u: Cells) -> Meeting:
        """Where solid meets gas, in every cell."""
        X, _H, Y, _Hg = unpacked(u)
        Ts, Tg = self.temperatures(u)
        Y, Tg = Y[:, None], Tg[:, None]
        exchange = jnp.broadcast_to(self.exchange(X, Ts, Tg, Y) * self.matter.left_over(Y), X.shape)
        return Meeting(X, Ts, Tg, Y, exchange, self.matter)

    def _transfer(self, u: Cells) -> tuple[Any, Any, Any, Any]:
        """Per kg of dry solid: water evaporated, enthalpy it carries at the surface, heat from the gas, heat
        from walls.
        """
        at = self.meeting(u)
        rate = self.kinetics.rate(at)
        carried, heat_capacity = slope(self.matter.vapor_enthalpy, at.temperature)
        blow = rate * heat_capacity / at.exchange
        small = abs(blow) < 1e-6
        safe = jnp.where(small, 1.0, blow)
        # Ackermann: vapor leaving the surface hinders the heat
        slowed = jnp.where(small, 1.0 - 0.5 * blow, safe / jnp.expm1(safe))
        heat = at.exchange * slowed * (at.gas_temperature - at.temperature)
        return rate, rate * carried, heat, self.wall_exchange * (self.wall_temperature - at.temperature)

    def entering(self, inlet: Inlet) -> Entering:
        """The inlet in moistures and enthalpies."""
        n, m = self.solid.shape
        X, T = jnp.broadcast_to(inlet.moisture, (m,)), jnp.broadcast_to(inlet.temperature, (m,))
        Y, Tg = jnp.broadcast_to(inlet.humidity, (n,)), jnp.broadcast_to(inlet.gas_temperature, (n,))
        return Entering(
            X, self.matter.moist_solid(T, X) / ENTHALPY, Y, self.matter.moist_gas(Tg, Y) / ENTHALPY
        )

    def rates(self, u: Cells, fresh: Entering) -> Rates:
        """Rates of change: per kg of dry solid for solid, per kg/s of dry gas flow times ``gas_time``/n for
        gas.
        """
        X, H, Y, Hg = unpacked(u)
        rate, carried, heat, wall = self._transfer(u)
        dX = self._moved(X, fresh.moisture) - rate
        dH = self._moved(H, fresh.enthalpy) + (heat + wall - carried) / ENTHALPY
        given = self.solid * jnp.stack([rate, (carried - heat) / ENTHALPY]) / self.gas_flow
        dY, dHg = (
            self._blown(Y, fresh.humidity),
            self._blown(Hg, fresh.gas_enthalpy) - self.heat_loss / (self.gas_flow * ENTHALPY),
        )
        return Rates(jnp.stack([dX, dH], axis=-1), jnp.moveaxis(given, 0, -1), jnp.stack([dY, dHg], axis=-1))

    def _moved(self, q: Any, q_in: Any) -> Any:
        """What the flow of solid brings, per kg in the cell and second."""
        return self.renewal * (jnp.concatenate([q_in[None], q[:-1]]) - q)

    def _blown(self, q: Any, q_in: Any) -> Any:
        """What the flow of gas brings, relative to the whole flow."""
        w = self.network
        before, after = jnp.concatenate([q[:1], q[:-1]]), jnp.concatenate([q[1:], q[-1:]])
        return w.from_before * (before - q) + w.from_after * (after - q) + w.inlet * (q_in - q)

    def outflow(self, u: Cells) -> Any:
        """Water and enthalpy (10⁵ W) that leave with each class of solid, then with the gas: linear in the
        unknowns.
        """
        X, H, Y, Hg = unpacked(u)
        out = self.gas_flow * self.network.outlet
        return jnp.concatenate(
            [
                self.solid_flow * X[-1],
                self.solid_flow * H[-1],
                jnp.sum(out * Y)[None],
                jnp.sum(out * Hg)[None],
            ]
        )

    def capacity(self) -> Cells:
        """What the cells hold: solid by itself, gas by its time."""
        return Cells(1.0, self.gas_time / self.solid.shape[0])

    def start(self, inlet: Inlet) -> Cells:
        """A first guess: solid and gas as they enter."""
        n, m = self.solid.shape
        Y, Tg = (
            jnp.sum(jnp.broadcast_to(v, (n,)) * self.network.inlet)
            for v in (inlet.humidity, inlet.gas_temperature)
        )
        X, T = (jnp.broadcast_to(v, (n, m)) for v in (inlet.moisture, inlet.temperature))
        return self.state(X, T, jnp.full(n, Y), jnp.full(n, Tg))

    def cell(self, row: CellRow) -> Contact:
        """One cell on its own, in a row through which solid and gas flow together."""
        return Contact(
            self.matter,
            self.kinetics,
            row.solid[None],
            row.renewal[None],
            self.gas_flow,
            Network.co_current(1),
            self.exchange,
            self.wall_exchange,
            self.wall_temperature,
            row.heat_loss[None],
        )

    def steady(self, inlet: Inlet) -> Profile:
        """The steady state."""
        n, m = self.solid.shape
        limit = largest_change(inlet.moisture)
        fresh = self.entering(inlet)
        if self.network.one_way:
            rows = CellRow(
                self.solid, jnp.broadcast_to(self.renewal, (n, m)), jnp.broadcast_to(self.heat_loss, (n,))
            )
            first = jax.tree.map(lambda leaf: leaf[0], self.start(inlet))
            steps = 0.1 / jnp.max(rows.renewal, axis=1)
            states, converged = march(
                lambda u, before, row: self.cell(row).rates(u, left(before)), first, rows, steps, limit
            )
            return self.profile(states, converged)
        step = 0.1 / jnp.max(self.renewal)
        # on its way there the gas, too, has something to hold
        held = Cells(1.0, jnp.maximum(self.gas_time / n, step))
        found = solve_chain(
            lambda u: self.rates(u, fresh), self.start(inlet), held, first_step=step, largest_change=limit
        )
        return self.profile(found.state, found.converged)

    def profile(self, u: Cells, converged: Any = True) -> Profile:
        """A state in words."""
        X, _H, Y, _Hg = unpacked(u)
        Ts, Tg = self.temperatures(u)
        m = X.shape[-1]
        out = self.outflow(u)
        n, F = X.shape[0], self.solid_flow
        shares = F / jnp.where(jnp.sum(F) > 0, jnp.sum(F), 1.0)
        place = (jnp.arange(n) + 0.5) / n
        wall = self.wall_exchange * (self.wall_temperature - Ts)
        duty = jnp.sum(self.solid * wall) - jnp.sum(self.heat_loss * jnp.ones(n))
        water, heat = out[:m], ENTHALPY * out[m : 2 * m]
        return Profile(
            shares,
            place,
            X,
            Ts,
            Y,
            Tg,
            water,
            heat,
            out[-2],
            ENTHALPY * out[-1],
            duty,
            converged,
            jnp.arange(n) == n - 1,
        )

    def dynamic(self, start: Cells, inlets: Inlet, step: Any) -> tuple[Profile, Any]:
        """States over time from a state, inlets having a leading axis of steps; and the water and heat (10⁵
        J) that left up to each.
        """
        wettest = jnp.maximum(jnp.max(start.lanes[..., 0]), jnp.max(inlets.moisture))

        def reach(u: Cells, change: Cells) -> Any:
            """No water that is not there."""
            X, falling = u.lanes[..., 0], change.lanes[..., 0] < 0
            return jnp.min(
                jnp.where(
                    falling,
                    (X + NO_WATER * wettest) / jnp.where(falling, -change.lanes[..., 0], 1.0),
                    jnp.inf,
                )
            )

        found = advance_chain(
            lambda u, given: self.rates(u, self.entering(given)),
            start,
            self.capacity(),
            step,
            inlets,
            lambda u, _given: self.outflow(u),
            reach,
            largest_change(wettest),
        )
        profiles = jax.vmap(self.profile)(found.states)
        return profiles._replace(
            converged=jnp.broadcast_to(found.converged, profiles.place.shape[:1])
        ), found.outflow


def unpacked(u: Cells) -> tuple[Any, Any, Any, Any]:
    """Moisture, enthalpy, humidity and gas enthalpy (in units of 10⁵ J/kg) from the unknowns."""
    return u.lanes[..., 0], u.lanes[..., 1], u.shared[..., 0], u.shared[..., 1]


def left(before: Cells) -> Entering:
    """What a cell receives from the one before."""
    return Entering(before.lanes[:, 0], before.lanes[:, 1], before.shared[:1], before.shared[1:])
