"""Friction of a slurry in its pipe over its velocity."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core.i18n import _
from granum.streams.inside_charts import Axis, Curve, Mark, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Unit

SLOWEST, FASTEST = 0.25, 2.0  # of the velocity as it runs


@eqx.filter_jit
def _friction(unit: Unit, feed: Stream, times: Any) -> tuple[Any, Any]:
    """Velocity and gradient of so many times the feed."""

    def at(scale: Any) -> tuple[Any, Any]:
        made = unit.inside(feed.part(solid=scale, liquid=scale, gas=scale))
        return made.velocity, made.pressure_gradient

    return jax.vmap(at)(times)


def drawn_friction(unit: Unit, feed: Stream, runs: Any, deposition: float = 0.0) -> Any:
    """Pressure gradient of the level pipe over the velocity, at the solids content of a feed, with where the
    solid begins to lie on the bottom.
    """
    times = jnp.linspace(SLOWEST, FASTEST, 71)
    velocity, gradient = (np.asarray(x) for x in _friction(unit, feed, times))

    def on_curve(name: str, speed: float) -> Mark:
        return Mark(name, speed, np.interp(speed, velocity, gradient))

    marks = [on_curve(_("as it runs"), float(runs.velocity))]
    if velocity[0] < deposition < velocity[-1]:
        marks.append(on_curve(_("slower, solid lies on the bottom"), deposition))
    return drawn_along(
        Axis("velocity", "Speed"),
        velocity,
        (Axis("pressure_gradient", "PressureGradient"), [Curve(_("slurry"), gradient, "SOLID")]),
        marks=marks,
    )
