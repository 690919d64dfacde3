"""Pleated filters: the more medium is folded in, the less it costs and the more the narrow channels do."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Distance, DynamicViscosity, Length, PressureDrop, Speed
from granum.filtration.kinds import ResidualDrag
from granum.numerics import find_root

WIDEST = 100.0  # pitches in multiples of the thinnest channel's width and of the height
_PLEAT = {
    "superficial_velocity": (0.5, 3.0),
    "pleat_height": (0.02, 0.1),
    "pleat_pitch": (3e-3, 8e-3),
    "mat_thickness": (3e-4, 8e-4),
    "dynamic_viscosity": (1.7e-5, 2e-5),
    "medium_drag": (200.0, 4000.0),
}


def _parts(v: Any, h: Any, p: Any, t: Any, eta: Any, k: Any) -> tuple[Any, Any]:
    gap = p / 2.0 - t
    impossible(gap <= 0.0, p, "pleat_pitch", 2.0 * t, jnp.inf)
    safe = jnp.where(gap > 0, gap, jnp.nan)
    return k * v * p / (2.0 * h), 8.0 * eta * v * p * h / safe**3


@formula(
    source="chen1995",
    title="Pressure drop of a pleated filter",
    equation=r"\Delta p = K_1\frac{U p}{2h} + \frac{8\,\eta\,U\,p\,h}{(p/2 - L)^3}",
    output="pressure_drop",
    typical=_PLEAT,
)
def pressure_drop_pleated(
    superficial_velocity: Speed,
    pleat_height: Length,
    pleat_pitch: Length,
    mat_thickness: Distance,
    dynamic_viscosity: DynamicViscosity,
    medium_drag: ResidualDrag,
) -> PressureDrop:
    """Pressure drop of a pleated filter: the medium at the velocity through its own area, and laminar flow in
    the channels between folds.

    Rectangular folds, even flow through the medium; the velocity is that in front of the filter, the drag of
    the medium its pressure drop over the velocity through it (see ``pressure_drop_fibers``). No value where
    the folds touch.

    >>> round(pressure_drop_pleated(1.0, "5 cm", "5 mm", "0.5 mm", 1.8e-5, medium_drag=2000.0), 1)
    104.5
    """
    medium, channel = _parts(
        superficial_velocity, pleat_height, pleat_pitch, mat_thickness, dynamic_viscosity, medium_drag
    )
    return medium + channel


@formula(
    source="chen1995",
    title="Best pitch of the pleats",
    equation=(
        r"\frac{\partial\Delta p}{\partial p} = 0,\quad \Delta p = K_1\frac{v p}{2h} + "
        r"\frac{8\,\eta\,v\,p\,h}{(p/2 - L)^3}"
    ),
    output="pleat_pitch",
    typical=_PLEAT,
)
def pleat_pitch_best(
    pleat_height: Length,
    mat_thickness: Distance,
    dynamic_viscosity: DynamicViscosity,
    medium_drag: ResidualDrag,
) -> Length:
    """Pitch of the folds at which a pleated filter of given height costs the least pressure, whatever the
    velocity.

    For a thin medium (256 η h²/K)^⅓:

    >>> round(1e3 * pleat_pitch_best("5 cm", 0.0, 1.8e-5, medium_drag=2000.0), 3)
    1.793
    """
    h, t, eta, k = pleat_height, mat_thickness, dynamic_viscosity, medium_drag

    def slope(p: Any) -> Any:  # of the pressure drop over the velocity, times the cube of the channel
        gap = p / 2.0 - t
        return k / (2.0 * h) * gap**4 + 8.0 * eta * h * (gap - 1.5 * p)

    thin = (256.0 * eta * h**2 / k) ** (1.0 / 3.0)
    return find_root(slope, 2.0 * t + 1e-6 * thin, WIDEST * (thin + t), start=2.0 * t + thin).value
