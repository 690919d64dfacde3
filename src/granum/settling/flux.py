"""Solids-flux theory of a continuous thickener: limiting flux, state point, steady state of the ideal (Kynch)
unit.

The flux of solids through a layer of the thickening zone is ``f(C) + q C``: settling and withdrawal. Whatever
layer between the feed and the underflow passes least decides. That one statement holds Coe–Clevenger's
greatest area, Yoshioka's tangent, Keinath's state point and Diehl's steady states.
"""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import Area, Concentration, Law, MassFlow, MassFlux, Ratio, Speed, VolumeFlow
from granum.numerics.extremes import least

MORE_BELOW = "The underflow would take more than the feed brings."
Settling = Annotated[Any, Law("settling_velocity")]
_SLUDGE = {
    "solids_concentration": (1.0, 10.0),
    "feed_concentration": (2.0, 4.0),
    "underflow_concentration": (6.0, 12.0),
}


def settling_flux(concentration: Any, settling: Any) -> Any:
    """Flux of settling solids, kg/(m² s)."""
    return concentration * settling(concentration)


def passing_flux(
    feed_concentration: Any, underflow_velocity: Any, settling: Any, densest: Any
) -> tuple[Any, Any]:
    """Greatest flux that a thickening zone passes at an underflow velocity, and the concentration of the
    layer that limits it.

    The minimum of ``f + q C`` over all layers from the feed concentration up.
    """
    return least(lambda C: settling_flux(C, settling) + underflow_velocity * C, feed_concentration, densest)


class Limit(NamedTuple):
    """Limiting flux and the layer that causes it."""

    limiting_flux: MassFlux
    limiting_concentration: Concentration


class StatePoint(NamedTuple):
    """Where a clarifier works on its flux diagram."""

    applied_flux: MassFlux
    limiting_flux: MassFlux
    loading_ratio: Ratio
    clarification_ratio: Ratio
    underflow_concentration: Concentration
    overflow_concentration: Concentration
    limiting_concentration: Concentration


THICK = (
    "The feed is as thick as this underflow, or thicker: nothing is left to thicken. Ask for a thicker "
    "underflow or give the feed more liquid."
)


@formula(source="kynch1952", title="Solids flux by settling", equation=r"G = C\,v(C)", typical=_SLUDGE)
def solids_flux_settling(solids_concentration: Concentration, settling: Settling = "takacs") -> MassFlux:
    """Flux of solids by settling alone: concentration times settling velocity.

    >>> round(
    ...     solids_flux_settling(
    ...         2.0, {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    ...     )
    ...     * 3600,
    ...     4,
    ... )
    3.6788
    """
    return settling_flux(solids_concentration, settling)


@formula(
    source="yoshioka1957; jernqvist1965",
    equation=r"G_L = \min_{C_F \le C < C_u} \frac{C\,v(C)}{1 - C/C_u}",
    typical=_SLUDGE,
    title="Limiting flux for an underflow concentration",
)
def limiting_flux_underflow(
    underflow_concentration: Concentration, feed_concentration: Concentration, settling: Settling = "takacs"
) -> Limit:
    """Greatest solids flux that a thickener can bring to an underflow concentration: Yoshioka's tangent,
    found numerically.

    Inside the range the limiting layer is where a line from the underflow concentration touches the flux
    curve; otherwise it is the feed layer itself. The same minimum is Coe and Clevenger's greatest unit area.

    >>> sludge = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    >>> limit = limiting_flux_underflow(10.0, 2.5, sludge)
    >>> round(limit.limiting_flux * 3600, 4), round(limit.limiting_concentration, 4)
    (3.5128, 7.2361)
    """
    Cu, Cf = jnp.asarray(underflow_concentration), jnp.asarray(feed_concentration)
    top = Cu * (1.0 - 1e-9)
    possible = Cf < top
    impossible(~possible, Cu, "underflow_concentration", Cf, jnp.inf, THICK)
    low = jnp.where(possible, Cf, 0.5 * Cu)

    def flux(C: Any) -> Any:
        return settling_flux(C, settling) / jnp.maximum(1.0 - C / Cu, 1e-12)

    value, where = least(flux, low, top)
    return Limit(jnp.where(possible, value, jnp.nan), jnp.where(possible, where, jnp.nan))


@formula(
    source="jernqvist1965; diehl2001",
    equation=r"G_L = \min_{C \ge C_F} \left[C\,v(C) + q_u C\right]",
    typical=_SLUDGE,
    title="Limiting flux at an underflow velocity",
)
def limiting_flux_withdrawal(
    underflow_velocity: Speed,
    feed_concentration: Concentration,
    concentration_maximum: Concentration = 100.0,
    settling: Settling = "takacs",
) -> Limit:
    """Greatest solids flux that a thickener passes at a given underflow velocity (underflow volume per area).

    >>> sludge = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    >>> limit = limiting_flux_withdrawal("0.35128 m/hour", 2.5, 50.0, sludge)
    >>> round(limit.limiting_flux * 3600, 3), round(limit.limiting_concentration, 2)
    (3.513, 7.24)
    """
    Cf, top = jnp.asarray(feed_concentration), jnp.asarray(concentration_maximum)
    return Limit(*passing_flux(Cf, underflow_velocity, settling, jnp.maximum(top, Cf)))


def steady_state(
    feed_concentration: Any, feed_velocity: Any, underflow_velocity: Any, settling: Any, densest: Any
) -> tuple[Any, Any, Any, Any]:
    """Ideal continuous thickener at rest: flux to the underflow, concentrations of underflow and overflow,
    limiting layer.

    Velocities are volume flows per area. What the thickening zone cannot pass leaves with the overflow.
    """
    applied = feed_velocity * feed_concentration
    limit, where = passing_flux(feed_concentration, underflow_velocity, settling, densest)
    down = jnp.minimum(applied, limit)
    over = feed_velocity - underflow_velocity
    safe = jnp.where(over > 0, over, 1.0)
    return down, down / underflow_velocity, jnp.where(over > 0, (applied - down) / safe, 0.0), where


@formula(
    source="keinath1985; diehl2001",
    equation=r"G_a = C_F\frac{Q_F}{A} \le G_L = \min_{C \ge C_F}\left[C\,v(C) + \frac{Q_u}{A} C\right]",
    title="State point of a clarifier or thickener",
    typical=_SLUDGE
    | {"volume_flow": (0.1, 0.3), "underflow_volume_flow": (0.04, 0.09), "area": (500.0, 1500.0)},
    symbols={"volume_flow": "Q_F"},
)
def state_point_clarifier(
    volume_flow: VolumeFlow,
    feed_concentration: Concentration,
    underflow_volume_flow: VolumeFlow,
    area: Area,
    concentration_maximum: Concentration = 100.0,
    settling: Settling = "takacs",
) -> StatePoint:
    """State point of a clarifier or thickener: loading of both zones and the steady state an ideal unit
    settles at.

    ``volume_flow`` is the whole feed, recycle included. A loading ratio above one means that the thickening
    zone is overloaded: the blanket rises until the excess leaves over the weir. A clarification ratio above
    one means that feed-strength suspension settles slower than the overflow rises.

    >>> sludge = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    >>> state = state_point_clarifier("800 m^3/hour", 2.5, "300 m^3/hour", "1000 m^2", settling=sludge)
    >>> (
    ...     round(state.underflow_concentration, 4),
    ...     round(state.overflow_concentration, 6),
    ...     round(state.loading_ratio, 3),
    ... )
    (6.6667, 0.0, 0.639)
    """
    impossible(
        underflow_volume_flow > volume_flow,
        underflow_volume_flow,
        "underflow_volume_flow",
        0.0,
        volume_flow,
        MORE_BELOW,
    )
    q, qu = volume_flow / area, underflow_volume_flow / area
    C, top = jnp.asarray(feed_concentration), jnp.asarray(concentration_maximum)
    _down, Cu, Ce, where = steady_state(C, q, qu, settling, jnp.maximum(top, C))
    limit = passing_flux(C, qu, settling, jnp.maximum(top, C))[0]
    return StatePoint(q * C, limit, q * C / limit, (q - qu) / settling(C), Cu, Ce, where)


@formula(
    source="yoshioka1957",
    equation=r"A = \frac{\dot m_s}{G_L},\quad G_L = \min_{C_F \le C < C_u} \frac{C\,v(C)}{1 - C/C_u}",
    title="Area of a thickener by solids flux",
    typical=_SLUDGE | {"mass_flow": (0.1, 1.0)},
    symbols={"mass_flow": r"\dot m_s"},
)
def thickener_area_flux(
    mass_flow: MassFlow,
    feed_concentration: Concentration,
    underflow_concentration: Concentration,
    settling: Settling = "takacs",
) -> Area:
    """Area at which an ideal thickener just reaches an underflow concentration with a solids flow.

    >>> sludge = {"law": "vesilind", "vesilind_velocity": "5 m/hour", "vesilind_coefficient": 0.5}
    >>> round(thickener_area_flux("3512.8 kg/hour", 2.5, 10.0, sludge), 1)
    1000.0
    """
    return (
        mass_flow
        / limiting_flux_underflow(underflow_concentration, feed_concentration, settling).limiting_flux
    )
