"""Clarifier-thickener in a line: the split by flux theory at a given underflow, the sludge it holds by the
settling-compression model.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import equipment, stand_ins
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Distance,
    Fraction,
    Law,
    Length,
    Mass,
    Ratio,
    Speed,
    Time,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.settling.column import Cone, Operation, Simulation, Suspension, simulate
from granum.settling.equipment.gravity import Outlets, concentration, divide, floating_share
from granum.settling.equipment.rakes import RAKED, THICKENER, raked
from granum.settling.flux import passing_flux, steady_state
from granum.streams.holdup import filled, trapezoid
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Dynamic, Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA

PERIODS = 12  # of the approach to the steady state


class ClarifierThickenerFigures(NamedTuple):
    """Figures of a clarifier-thickener at rest."""

    loading_ratio: Ratio
    clarification_ratio: Ratio
    overflow_rate: Speed
    underflow_concentration: Concentration
    overflow_concentration: Concentration
    blanket_height: Distance
    bottom_concentration: Concentration
    solids_held: Mass
    retention_time: Time


class Sludge(NamedTuple):
    """What the tank holds: kg of solid by cell from the top, species and class; kg of each liquid; the
    temperature of all.
    """

    solid: Any
    liquid: Any
    temperature: Any


stand_ins.circle("underflow_volume_flow", "height")


@equipment(
    "clarifier_thickener",
    source="diehl2001; burger2011; burger2013",
    title="Clarifier-thickener",
    equation=(
        r"\frac{\partial C}{\partial t} + \frac{\partial}{\partial z}\left[f(C) + q(z)\,C - "
        r"d(C)\frac{\partial C}{\partial z}\right] = s"
    ),
)
class ClarifierThickener(Unit, Dynamic):
    """Tank of a given area and depth from which a given underflow is drawn; feed enters between the two
    zones.

    What the thickening zone cannot pass at that underflow leaves over the weir (solids-flux theory, all sizes
    settling together). Blanket and sludge held are those of the settling-compression model, started empty and
    followed for a settling time, which should be several retention times of the sludge. Over a day of
    changing loads use ``continuous_simulation``. Whether the liquid follows Newton or not is in the settling
    velocity, which is that of a test in it.
    """

    area: Area
    height: Length
    underflow_volume_flow: VolumeFlow
    settling: Annotated[Any, Law("settling_velocity")]
    compression: Annotated[Any, Law("solids_stress")] | None = None
    feed_depth_share: Fraction = 0.5
    cone_height_share: Fraction = 0.0
    bottom_area_share: Fraction = 1.0
    settling_time: Annotated[Time, Within(60.0)] = 10 * 86400.0
    concentration_maximum: Concentration = 1000.0
    cells: Annotated[int, Within(5, 5000)] = eqx.field(static=True, default=40)

    limits: ClassVar[Limits] = {
        "thickening": Limit("loading of the thickening zone", 0.0, 1.0, "dimensionless", "yoshioka1957"),
        "clarification": Limit("loading of the clarification zone", 0.0, 1.0, "dimensionless", "coe1916"),
        "blanket": Limit("blanket over the depth below the feed", 0.0, 1.0, "dimensionless", "keinath1985"),
        "gathering": Limit("sludge still gathering, of what is fed", 0.0, 0.02, "dimensionless", "diehl2001"),
        "floats": Limit(
            "floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", "coe1916", quiet=True
        ),
        "diameter": Limit("diameter", 0.0, 60.0, "m", "degremont2007"),
        "drawn": Limit("underflow asked for over the feed", 0.0, 1.0, "dimensionless", "coe1916"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def _velocities(self, feed: Stream) -> tuple[Any, Any]:
        """Feed and underflow per area, m/s; the underflow is at most the feed."""
        flow = feed.slurry_volume_flow
        return flow / self.area, jnp.minimum(self.underflow_volume_flow, flow) / self.area

    def _cone(self) -> Cone | None:
        plain = isinstance(self.cone_height_share, float) and self.cone_height_share == 0.0
        return (
            None
            if plain
            else Cone(jnp.maximum(self.cone_height_share, 1e-6), jnp.maximum(self.bottom_area_share, 1e-3))
        )

    def inside(self, feed: Stream) -> Simulation:
        """The way to the steady state."""
        q, qu = self._velocities(feed)
        suspension = Suspension(self.settling, self.compression, feed.solid_density, feed.liquid_density)
        still = jnp.ones(PERIODS)
        operation = Operation(
            self.settling_time * jnp.linspace(0.0, 1.0, PERIODS + 1),
            q * still,
            qu * still,
            concentration(feed) * still,
        )
        return simulate(
            suspension,
            self.height,
            jnp.zeros(self.cells),
            operation,
            feed_depth=self.feed_depth_share,
            cone=self._cone(),
        )

    def outlets(self, inside: Simulation, feed: Stream) -> Outlets:
        q, qu = self._velocities(feed)
        C = concentration(feed)
        down, under, _over, _where = steady_state(
            C, q, qu, self.settling, jnp.maximum(self.concentration_maximum, C)
        )
        applied = q * C
        share = jnp.where(applied > 0, down / jnp.where(applied > 0, applied, 1.0), 0.0)
        thick = divide(feed, share, jnp.where(under > 0, under, 1.0))
        clear = feed.liquid_volume_flow > 0
        # Without solids the underflow is liquid alone.
        part = jnp.where(clear, qu * self.area / jnp.where(clear, feed.liquid_volume_flow, 1.0), 0.0)
        plain = Outlets(
            feed.part(liquid=jnp.minimum(part, 1.0)), feed.part(liquid=1.0 - jnp.minimum(part, 1.0), gas=1.0)
        )
        some = applied > 0
        return Outlets(*(_either(some, a, b) for a, b in zip(thick, plain, strict=True)))

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        from granum.settling.charts import flux_diagram, layered

        feed = inlets["feed"]
        if float(feed.solid_flow) <= 0.0:
            return {}
        flow = float(feed.slurry_volume_flow)
        below = min(float(self.underflow_volume_flow), flow)
        state = flux_diagram(flow, float(concentration(feed)), below, float(self.area), self.settling)
        last = made.inside.concentration[-1]
        return {
            _("Flux diagram with state point"): state,
            _("Sludge over the depth"): layered(last, self.height),
        }

    # -- in time
    # ---------------------------------------------------------------------------------------------------
    def _shares(self) -> tuple[Any, Any]:
        """Volume of each cell, and of the tank, m³."""
        cone = self._cone()
        shares = jnp.ones(self.cells) if cone is None else cone.areas(self.cells)[1]
        volumes = shares * self.area * self.height / self.cells
        return volumes, jnp.sum(volumes)

    def initial_holdup(self, mixture: Mixture) -> Sludge:
        water = filled(mixture, self._shares()[1])
        return Sludge(jnp.zeros((self.cells, *mixture.solid_shape)), water.liquid, water.temperature)

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Sludge:
        feed = inlets["feed"]
        volumes, tank = self._shares()
        by_cell = self.inside(feed).concentration[-1] * volumes
        kinds = feed.solid / jnp.where(feed.solid_flow > 0, feed.solid_flow, 1.0)
        liquid = (
            feed.liquid
            / jnp.maximum(feed.liquid_volume_flow, 1e-300)
            * (tank - jnp.sum(by_cell) / feed.solid_density)
        )
        return Sludge(
            by_cell.reshape((-1,) + (1,) * kinds.ndim) * kinds,
            liquid,
            jnp.asarray(feed.temperature, dtype=float),
        )

    def held_mass(self, state: Sludge) -> Any:
        return jnp.sum(state.solid) + jnp.sum(state.liquid)

    def _drawn(self, feed: Stream, last: Any, first: Any) -> tuple[Any, Any, Any, Any]:
        """Volumes drawn below and over the weir per second, and the liquid in each, from the concentrations
        there.
        """
        q, qu = self._velocities(feed)
        below, above = qu * self.area, (q - qu) * self.area
        density = feed.solid_density
        return below, above, below * (1.0 - last / density), above * (1.0 - first / density)

    def advance(
        self,
        state: Sludge,
        before: Mapping[str, Stream],
        after: Mapping[str, Stream],
        step: Any,
        prepared: Any,
    ) -> tuple[Sludge, Outlets]:
        """Sludge by the settling model inside the tank, by the trapezoidal rule where it leaves; its sizes
        and species travel with it.

        The liquid is one mixed volume, at one temperature with the sludge.
        """
        then, now = before["feed"], after["feed"]
        volumes, tank = self._shares()
        held = jnp.sum(state.solid, axis=tuple(range(1, state.solid.ndim)))
        C = held / volumes
        flow = 0.5 * (then.slurry_volume_flow + now.slurry_volume_flow)
        fed = 0.5 * (then.solid_flow + now.solid_flow)
        below, above, wet_below, wet_above = self._drawn(then, C[-1], C[0])
        below_now, above_now, *_rest = self._drawn(now, 0.0, 0.0)
        span = jnp.where(step > 0, step, 1.0)
        operation = Operation(
            jnp.stack([0.0 * span, span]),
            jnp.reshape(flow / self.area, (1,)),
            jnp.reshape(0.5 * (below + below_now) / self.area, (1,)),
            jnp.reshape(fed / jnp.maximum(flow, 1e-300), (1,)),
        )
        suspension = Suspension(self.settling, self.compression, now.solid_density, now.liquid_density)
        made = simulate(
            suspension, self.height, C, operation, feed_depth=self.feed_depth_share, cone=self._cone()
        )
        # What the model moved into the outermost cells leaves them by the trapezoidal rule.
        after_model = made.concentration[-1] * volumes
        top = after_model[0] + made.overflowed[-1] * self.area - 0.5 * span * above * C[0]
        bottom = after_model[-1] + made.underflowed[-1] * self.area - 0.5 * span * below * C[-1]
        masses = after_model.at[0].set(top / (1.0 + 0.5 * span * above_now / volumes[0]))
        masses = masses.at[-1].set(bottom / (1.0 + 0.5 * span * below_now / volumes[-1]))
        masses = jnp.where(step > 0, masses, held)
        solid = self._carried(state, then, now, masses, (above, above_now), (below, below_now), step)

        C = masses / volumes
        _below, _above, wet_below_now, wet_above_now = self._drawn(now, C[-1], C[0])
        density = now.solid_density
        room, room_now = tank - jnp.sum(held) / density, tank - jnp.sum(masses) / density
        lost, losing = (wet_below + wet_above) / room, (wet_below_now + wet_above_now) / room_now
        liquid = trapezoid(state.liquid, then.liquid + now.liquid, lost, losing, step)
        gone = _outlets(
            then.replace(temperature=state.temperature),
            state.solid / volumes.reshape((-1,) + (1,) * then.solid.ndim),
            state.liquid / room,
            (below, above, wet_below, wet_above),
        )
        going = _outlets(
            now,
            solid / volumes.reshape((-1,) + (1,) * now.solid.ndim),
            liquid / room_now,
            (below_now, above_now, wet_below_now, wet_above_now),
        )
        # The heat of what is held and, for half the step, of what leaves, gives the temperature of both.
        dry = [s.replace(gas=0.0 * s.gas).enthalpy_flow for s in (then, now, *gone)]
        within = now.replace(
            solid=jnp.sum(state.solid, axis=0),
            liquid=state.liquid,
            gas=0.0 * now.gas,
            temperature=state.temperature,
        )
        heat = within.enthalpy_flow + 0.5 * step * (dry[0] + dry[1] - dry[2] - dry[3])
        leaving = going.underflow.solid + going.overflow.solid, going.underflow.liquid + going.overflow.liquid
        end = within.replace(
            solid=jnp.sum(solid, axis=0) + 0.5 * step * leaving[0], liquid=liquid + 0.5 * step * leaving[1]
        ).at_enthalpy(heat)
        going = Outlets(*(s.replace(temperature=end.temperature) for s in going))
        return Sludge(solid, liquid, end.temperature), going._replace(
            overflow=going.overflow.replace(gas=now.gas)
        )

    def _carried(
        self, state: Sludge, then: Stream, now: Stream, masses: Any, over: Any, under: Any, step: Any
    ) -> Any:
        """Species and sizes of every cell after a step: each face carries those of the cell it comes from, at
        the end of the step.
        """
        volumes, _tank = self._shares()
        rows = state.solid.reshape(self.cells, -1)
        fed = (
            jnp.zeros((self.cells, rows.shape[1]))
            .at[_feed_cell(self.feed_depth_share, self.cells)]
            .set(0.5 * step * (then.solid + now.solid).reshape(-1))
        )
        first, last = 0.5 * step * over[0] / volumes[0], 0.5 * step * under[0] / volumes[-1]
        known = (rows + fed).at[0].add(-first * rows[0]).at[-1].add(-last * rows[-1])
        first, last = (
            0.5 * step * over[1] / volumes[0] * masses[0],
            0.5 * step * under[1] / volumes[-1] * masses[-1],
        )
        out = jnp.zeros(self.cells).at[0].add(first).at[-1].add(last)
        down = jnp.cumsum(jnp.sum(known, axis=1) - masses - out)[:-1]  # over each inner face, kg in the step
        fall, rise = jnp.maximum(down, 0.0), jnp.maximum(-down, 0.0)
        # what flows through cells that are empty yet is rounding, and may turn any way
        rounding = 1e-16 * jnp.sum(masses) + 1e-300
        diagonal = masses + out + jnp.pad(fall, (0, 1)) + jnp.pad(rise, (1, 0)) + rounding
        shares = jax.lax.linalg.tridiagonal_solve(
            jnp.pad(-fall, (1, 0)), diagonal, jnp.pad(-rise, (0, 1)), known
        )
        return (shares * masses[:, None]).reshape(state.solid.shape)

    def figures(self, inside: Simulation, outlets: Outlets, feed: Stream) -> ClarifierThickenerFigures:
        q, qu = self._velocities(feed)
        C = concentration(feed)
        limit = passing_flux(C, qu, self.settling, jnp.maximum(self.concentration_maximum, C))[0]
        held = inside.held[-1] * self.area
        return ClarifierThickenerFigures(
            safe_divide(q * C, limit),
            (q - qu) / self.settling(C),
            q - qu,
            concentration(outlets.underflow),
            concentration(outlets.overflow),
            inside.interface_height(0.5 * C)[-1],
            inside.concentration[-1, -1],
            held,
            held / jnp.where(feed.solid_flow > 0, feed.solid_flow, jnp.inf),
        )

    def measured(
        self, inside: Simulation, outlets: Outlets, figures: ClarifierThickenerFigures, feed: Stream
    ) -> dict[str, Any]:
        gained = inside.held[-1] - inside.held[-2]
        fed = inside.fed[-1] - inside.fed[-2]
        return {
            "drawn": safe_divide(self.underflow_volume_flow, feed.slurry_volume_flow),
            "thickening": figures.loading_ratio,
            "clarification": figures.clarification_ratio,
            "blanket": figures.blanket_height / (self.height * (1.0 - self.feed_depth_share)),
            "gathering": jnp.abs(gained) / jnp.where(fed > 0, fed, 1.0),
            "floats": floating_share(feed),
            "diameter": jnp.sqrt(4.0 * self.area / jnp.pi),
        }

    def drawn(
        self, inside: Simulation, outlets: Outlets, figures: ClarifierThickenerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"electric_power_rake": raked(self.area, THICKENER), "area_installed": self.area}


def _feed_cell(share: Any, cells: int) -> Any:
    return jnp.clip(jnp.floor(jnp.asarray(share) * cells), 0, cells - 1).astype(int)


def _outlets(stream: Stream, concentration: Any, density: Any, drawn: tuple[Any, Any, Any, Any]) -> Outlets:
    """What is drawn from the lowest and the highest cell: solid per volume of slurry, liquid per volume of
    liquid.
    """
    below, above, wet_below, wet_above = drawn
    gas = 0.0 * stream.gas
    return Outlets(
        stream.replace(solid=below * concentration[-1], liquid=wet_below * density, gas=gas),
        stream.replace(solid=above * concentration[0], liquid=wet_above * density, gas=gas),
    )


def _either(condition: Any, a: Stream, b: Stream) -> Stream:
    return a.replace(
        solid=jnp.where(condition, a.solid, b.solid), liquid=jnp.where(condition, a.liquid, b.liquid)
    )
