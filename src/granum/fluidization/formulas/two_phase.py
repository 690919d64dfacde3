"""Two-phase theory of a bubbling bed: gas in bubbles, gas in the emulsion, and what passes between them. For
dryers and reactors.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import formula, limit_active, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Area,
    Diffusivity,
    Distance,
    Fraction,
    Frequency,
    Length,
    Ratio,
    Speed,
    VoidFraction,
)
from granum.fluidization.formulas.bubbles import (
    NO_BUBBLES,
    SPEEDS,
    bubble_diameter_darton,
    bubble_exchange_rate,
    bubble_fraction_davidson_harrison,
    bubble_rise_velocity_davidson_harrison,
)

_points, _weights = np.polynomial.legendre.leggauss(8)
NODES, WEIGHTS = 0.5 * (1.0 + _points), 0.5 * _weights
BED = {
    **SPEEDS,
    "diffusivity": (1e-5, 1e-4),
    "diameter": (1.0, 2.0),
    "catchment_area": (1e-5, 1e-3),
    "bypass_fraction": (0.05, 0.8),
}


class TwoPhaseBed(NamedTuple):
    """A bubbling bed by the two-phase theory."""

    bubble_diameter: Distance
    bubble_rise_velocity: Speed
    bubble_fraction: Fraction
    height_expanded: Length
    bubble_exchange_rate: Frequency
    transfer_units: Ratio
    bypass_fraction: Fraction


@formula(
    source="davidson1963; kunii1991, ch. 6 and 10; darton1977",
    equation=r"X = \int_0^H \frac{K_{be}(D)}{u_b}\,dz,\quad B = \left(1 - \frac{U_{mf}}{U}\right)e^{-X}",
    fitted={"bubble_ratio": (0.0, 0.6)},
    typical=BED,
    symbols={"bypass_fraction": "B", "transfer_units": "X"},
)
def two_phase_bed(
    superficial_velocity: Speed,
    minimum_fluidization_velocity: Speed,
    height: Length,
    diffusivity: Diffusivity,
    void_fraction: VoidFraction = 0.45,
    catchment_area: Area = 1e-4,
    diameter: Length | None = None,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> TwoPhaseBed:
    """Bubbles, expansion and gas exchange of a bubbling bed: emulsion at minimum fluidization, the surplus
    gas in bubbles.

    Height and void fraction are those at minimum fluidization. Bubbles grow by Darton, not beyond the vessel;
    size, rise and share are reported at half the height, expansion and exchange are summed over it, most of
    the exchange being near the distributor. The bypass is the share of the gas that leaves as it came, in
    bubbles through a well-mixed emulsion: of a dryer whose emulsion gas is saturated, the gas leaves with one
    minus the bypass of the possible load. With the thermal diffusivity in place of the diffusivity the same
    holds for heat.

    A bed of known diameter slugs where its bubbles are wider than 0.6 of it (Kunii and Levenspiel).

    Never more than the surplus gas passes by:

    >>> 0.0 < two_phase_bed(
    ...     superficial_velocity=0.2, minimum_fluidization_velocity=0.05, height=0.3, diffusivity=2.5e-5
    ... ).bypass_fraction < 0.75
    True

    At minimum fluidization there are no bubbles: the bed is not expanded and all gas meets the solid.

    >>> bed = two_phase_bed(
    ...     superficial_velocity=0.05, minimum_fluidization_velocity=0.05, height=0.3, diffusivity=2.5e-5
    ... )
    >>> bed.bypass_fraction, bed.bubble_diameter, bed.height_expanded
    (0.0, 0.0, 0.3)
    """
    first, start = minimum_fluidization_velocity, 4.0 * jnp.sqrt(catchment_area)
    bubbling = superficial_velocity > first
    limit_active(~jnp.asarray(bubbling), superficial_velocity, "superficial_velocity", NO_BUBBLES)
    U = jnp.where(bubbling, superficial_velocity, 2.0 * first)

    def at(z: Any) -> tuple[Any, Any, Any, Any]:
        bubble = bubble_diameter_darton(U, first, z, catchment_area, gravity)
        bubble = bubble if diameter is None else jnp.minimum(bubble, diameter)
        rise = bubble_rise_velocity_davidson_harrison(U, first, bubble, gravity)
        share = jnp.minimum(bubble_fraction_davidson_harrison(U, first, rise), 0.999)
        return bubble, rise, share, bubble_exchange_rate(first, bubble, diffusivity, void_fraction, gravity)

    span = jnp.log1p(height / start)  # even steps of ln(z + 4√A0): the bubble grows with a power of it
    expanded = units = 0.0
    for node, weight in zip(NODES, WEIGHTS, strict=True):
        level = start * jnp.exp(span * node)
        _bubble, rise, share, exchange = at(level - start)
        step = weight * span * level / (1.0 - share)
        expanded, units = expanded + step, units + step * exchange / rise
    bubble, rise, share, exchange = at(height / 2.0)
    if diameter is not None:
        watch(bubble_ratio=jnp.where(bubbling, bubble / diameter, 0.0))
    bypass = jnp.maximum(1.0 - first / U, 0.0) * jnp.exp(-units)
    found = TwoPhaseBed(bubble, rise, share, expanded, exchange, units, bypass)
    none = TwoPhaseBed(0.0, 0.0, 0.0, height, 0.0, 0.0, 0.0)
    return TwoPhaseBed(*(jnp.where(bubbling, some, rest) for some, rest in zip(found, none, strict=True)))


@formula(
    source="davidson1963",
    equation=r"\frac{c}{c_0} = B + \frac{(1-B)^2}{1 - B + k H_{mf}/U}",
    typical={**BED, "rate_constant": (0.5, 5.0)},
    symbols={"bypass_fraction": "B", "height": "H_{mf}"},
)
def unconverted_fraction_davidson_harrison(
    bypass_fraction: Fraction, rate_constant: Frequency, height: Length, superficial_velocity: Speed
) -> Fraction:
    """Share of a gas left unconverted by a bubbling bed of well-mixed emulsion, by Davidson and Harrison.

    The rate constant is of first order, per volume of emulsion; the height that at minimum fluidization. The
    bypass comes from ``two_phase_bed``. However fast the reaction, the bypass is left:

    >>> round(
    ...     unconverted_fraction_davidson_harrison(
    ...         bypass_fraction=0.2, rate_constant=1e9, height=1.0, superficial_velocity=0.5
    ...     ),
    ...     6,
    ... )
    0.2
    """
    met = 1.0 - bypass_fraction
    return bypass_fraction + met**2 / jnp.maximum(met + rate_constant * height / superficial_velocity, 1e-12)
