"""Clarifier-thickener in a line: the split by flux theory at a given underflow, the sludge it holds by the settling-compression model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Area, Concentration, Distance, Fraction, Law, Length, Mass, Ratio, Speed, Time, VolumeFlow
from granum.settling.column import Cone, Operation, Simulation, Suspension, simulate
from granum.settling.equipment.gravity import Outlets, concentration, divide
from granum.settling.flux import passing_flux, steady_state
from granum.streams.sharing import shared
from granum.streams.stream import Stream
from granum.streams.units import Check, Unit

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


@equipment("clarifier_thickener", source="diehl2001; burger2011; burger2013", title="Clarifier-thickener",
           equation=r"\frac{\partial C}{\partial t} + \frac{\partial}{\partial z}\left[f(C) + q(z)\,C - d(C)\frac{\partial C}{\partial z}\right] = s")  # fmt: skip
class ClarifierThickener(Unit):
    """Tank of a given area and depth from which a given underflow is drawn; feed enters between the two zones.

    What the thickening zone cannot pass at that underflow leaves over the weir (solids-flux theory, all sizes settling together). Blanket and sludge
    held are those of the settling-compression model, started empty and followed for a settling time, which should be several retention
    times of the sludge. Over a day of changing loads use ``continuous_simulation``.
    """

    area: Area
    height: Length
    underflow_volume_flow: VolumeFlow
    settling: Annotated[Any, Law("settling_velocity")]
    compression: Annotated[Any, Law("solids_stress")] | None = None
    feed_depth_share: Fraction = 0.5
    cone_height_share: Fraction = 0.0
    bottom_area_share: Fraction = 1.0
    settling_time: Time = 10 * 86400.0
    concentration_maximum: Concentration = 1000.0
    cells: int = eqx.field(static=True, default=40)

    def _velocities(self, feed: Stream) -> tuple[Any, Any]:
        """Feed and underflow per area, m/s; the underflow is at most the feed."""
        flow = feed.slurry_volume_flow
        return flow / self.area, jnp.minimum(self.underflow_volume_flow, flow) / self.area

    def _cone(self) -> Cone | None:
        plain = isinstance(self.cone_height_share, float) and self.cone_height_share == 0.0
        return None if plain else Cone(jnp.maximum(self.cone_height_share, 1e-6), jnp.maximum(self.bottom_area_share, 1e-3))

    @shared
    def course(self, feed: Stream) -> Simulation:
        """The way to the steady state."""
        q, qu = self._velocities(feed)
        suspension = Suspension(self.settling, self.compression, feed.solid_density, feed.liquid_density)
        still = jnp.ones(PERIODS)
        operation = Operation(self.settling_time * jnp.linspace(0.0, 1.0, PERIODS + 1), q * still, qu * still, concentration(feed) * still)
        return simulate(suspension, self.height, jnp.zeros(self.cells), operation, feed_depth=self.feed_depth_share, cone=self._cone())

    def __call__(self, feed: Stream) -> Outlets:
        q, qu = self._velocities(feed)
        C = concentration(feed)
        down, under, _over, _where = steady_state(C, q, qu, self.settling, jnp.maximum(self.concentration_maximum, C))
        applied = q * C
        share = jnp.where(applied > 0, down / jnp.where(applied > 0, applied, 1.0), 0.0)
        thick = divide(feed, share, jnp.where(under > 0, under, 1.0))
        clear = feed.liquid_volume_flow > 0
        # Without solids the underflow is liquid alone.
        part = jnp.where(clear, qu * self.area / jnp.where(clear, feed.liquid_volume_flow, 1.0), 0.0)
        plain = Outlets(feed.part(liquid=jnp.minimum(part, 1.0)), feed.part(liquid=1.0 - jnp.minimum(part, 1.0), gas=1.0))
        some = applied > 0
        return Outlets(*(_either(some, a, b) for a, b in zip(thick, plain, strict=True)))

    def results(self, inlets: Mapping[str, Stream], outlets: Outlets) -> ClarifierThickenerFigures:
        feed = inlets["feed"]
        q, qu = self._velocities(feed)
        C, course = concentration(feed), self.course(feed)
        limit = passing_flux(C, qu, self.settling, jnp.maximum(self.concentration_maximum, C))[0]
        held = course.held[-1] * self.area
        return ClarifierThickenerFigures(
            q * C / limit, (q - qu) / self.settling(C), q - qu, concentration(outlets.underflow), concentration(outlets.overflow),
            course.interface_height(0.5 * C)[-1], course.concentration[-1, -1], held,
            held / jnp.where(feed.solid_flow > 0, feed.solid_flow, jnp.inf),
        )  # fmt: skip

    def checks(self, inlets: Mapping[str, Stream], outlets: Outlets) -> tuple[Check, ...]:
        figures, course = self.results(inlets, outlets), self.course(inlets["feed"])
        gained = course.held[-1] - course.held[-2]
        fed = course.fed[-1] - course.fed[-2]
        settled = jnp.abs(gained) / jnp.where(fed > 0, fed, 1.0)
        return (
            Check("loading of the thickening zone", figures.loading_ratio, 0.0, 1.0, "dimensionless", "yoshioka1957"),
            Check("loading of the clarification zone", figures.clarification_ratio, 0.0, 1.0, "dimensionless", "coe1916"),
            Check("blanket below the feed", figures.blanket_height, 0.0, self.height * (1.0 - self.feed_depth_share), "m", "keinath1985"),
            Check("sludge still gathering, of what is fed", settled, 0.0, 0.02, "dimensionless", "diehl2001"),
            Check("diameter", jnp.sqrt(4.0 * self.area / jnp.pi), 0.0, 60.0, "m", "degremont2007"),
        )


def _either(condition: Any, a: Stream, b: Stream) -> Stream:
    return a.replace(solid=jnp.where(condition, a.solid, b.solid), liquid=jnp.where(condition, a.liquid, b.liquid))
