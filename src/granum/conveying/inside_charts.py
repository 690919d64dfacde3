"""Friction of a slurry in its pipe over its velocity."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from granum.core.i18n import _
from granum.streams.inside_charts import Axis, Curve, Mark, drawn_along
from granum.streams.stream import Stream

SLOWEST, FASTEST = 0.25, 2.0  # of the velocity as it runs


def drawn_friction(inside: Callable[[Stream], Any], feed: Stream, runs: Any, deposition: float = 0.0) -> Any:
    """Pressure gradient of the level pipe over the velocity, at the solids content of a feed, with where the
    solid begins to lie on the bottom.
    """
    times = jnp.linspace(SLOWEST, FASTEST, 71)

    def at(scale: Any) -> tuple[Any, Any]:
        made = inside(feed.part(solid=scale, liquid=scale, gas=scale))
        return made.velocity, made.pressure_gradient if hasattr(made, "pressure_gradient") else made.gradient

    velocity, gradient = (np.asarray(x) for x in jax.jit(jax.vmap(at))(times))

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
