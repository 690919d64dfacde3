"""Bubbles of gas-fluidized beds: size by height, rise, share of the bed, exchange with the emulsion."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp

from granum.core import formula, limit_active, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    AreaOrZero,
    Diffusivity,
    Distance,
    Fraction,
    Frequency,
    Length,
    NumberPerArea,
    Speed,
    VoidFraction,
)
from granum.numerics import safe_sqrt

SPEEDS = {
    "superficial_velocity": (0.2, 1.0),
    "minimum_fluidization_velocity": (0.01, 0.1),
    "height": (0.2, 1.5),
}


NO_BUBBLES = "At or below minimum fluidization no gas is left over for bubbles: there are none."


def surplus(U: Any, U_mf: Any) -> Any:
    """Gas beyond minimum fluidization; none, with a flag, below it."""
    extra = jnp.asarray(U - U_mf, dtype=float)
    limit_active(extra <= 0.0, U, "superficial_velocity", NO_BUBBLES)
    return jnp.maximum(extra, 1e-12)


@formula(
    source="davidson1963; davies1950",
    title="Rise velocity of a single bubble",
    equation=r"u_{b\infty} = 0.711\sqrt{g d_b}",
    symbols={"bubble_rise_velocity": r"u_{b\infty}"},
)
def bubble_rise_velocity_single(bubble_diameter: Length, gravity: Acceleration = STANDARD_GRAVITY) -> Speed:
    """Rise velocity of a single bubble in a bed at minimum fluidization by Davidson and Harrison.

    >>> round(bubble_rise_velocity_single(bubble_diameter=0.1), 3)
    0.704
    """
    return 0.711 * jnp.sqrt(gravity * bubble_diameter)


@formula(source="davidson1963", equation=r"u_b = U - U_{mf} + 0.711\sqrt{g d_b}", typical=SPEEDS)
def bubble_rise_velocity_davidson_harrison(
    superficial_velocity: Speed,
    minimum_fluidization_velocity: Speed,
    bubble_diameter: Length,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Rise velocity of the bubbles of a bubbling bed by Davidson and Harrison.

    >>> round(
    ...     bubble_rise_velocity_davidson_harrison(
    ...         superficial_velocity=0.3, minimum_fluidization_velocity=0.05, bubble_diameter=0.1
    ...     ),
    ...     3,
    ... )
    0.954
    """
    extra = surplus(superficial_velocity, minimum_fluidization_velocity)
    return extra + 0.711 * jnp.sqrt(gravity * bubble_diameter)


@formula(
    source="darton1977",
    equation=r"d_b = 0.54\,(U-U_{mf})^{0.4}(z + 4\sqrt{A_0})^{0.8} g^{-0.2}",
    typical=SPEEDS,
    symbols={"height": "z"},
)
def bubble_diameter_darton(
    superficial_velocity: Speed,
    minimum_fluidization_velocity: Speed,
    height: Distance,
    catchment_area: AreaOrZero = 0.0,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Bubble diameter at a height above the distributor by Darton and others.

    The catchment area is the distributor area per orifice; for a porous plate put 0.56 cm², so that 4√A₀ is
    3 cm.

    >>> round(
    ...     bubble_diameter_darton(
    ...         superficial_velocity=0.3, minimum_fluidization_velocity=0.05, height=0.5, catchment_area=1e-4
    ...     ),
    ...     4,
    ... )
    0.12
    """
    extra = surplus(superficial_velocity, minimum_fluidization_velocity)
    return 0.54 * extra**0.4 * (height + 4.0 * safe_sqrt(catchment_area)) ** 0.8 * gravity**-0.2


@formula(
    source="mori1975; kunii1991, ch. 6",
    equation=r"d_b = d_{bm} - (d_{bm} - d_{b0})\,e^{-0.3 z/D},\ d_{bm} = 1.64\,[A(U-U_{mf})]^{0.4}",
    fitted={"diameter": (0.0, 1.3), "minimum_fluidization_velocity": (0.005, 0.2)},
    typical={**SPEEDS, "diameter": (0.2, 1.2), "orifices_per_area": (500.0, 5000.0)},
    symbols={"height": "z"},
)
def bubble_diameter_mori_wen(
    superficial_velocity: Speed,
    minimum_fluidization_velocity: Speed,
    height: Distance,
    diameter: Length,
    orifices_per_area: NumberPerArea | None = None,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Bubble diameter at a height above the distributor by Mori and Wen, growing from the plate to the
    largest the vessel allows.

    Orifices per square meter of plate; left out, a porous plate. In the print's centimeters the constants are
    0.652, 0.347 and 0.00376. Kunii and Levenspiel put 1.30/g^0.2 for 0.347, and start from 2.78 (U - U_mf)²/g
    where the first bubbles would overlap: their example 6.2 has 20 cm for 18.6 cm here.

    Far above the plate only the largest size is left:

    >>> round(
    ...     bubble_diameter_mori_wen(
    ...         superficial_velocity=0.3, minimum_fluidization_velocity=0.05, height=100.0, diameter=1.0
    ...     ),
    ...     3,
    ... )
    0.854
    """
    extra = surplus(superficial_velocity, minimum_fluidization_velocity)
    A = jnp.pi / 4.0 * diameter**2
    centimeters = 1e-2 * (1e6) ** 0.4  # of the print: cm³/s to the power 0.4, in cm
    largest = 0.652 * centimeters * (A * extra) ** 0.4
    if orifices_per_area is None:
        first = 0.00376 * 1e-2 * (100.0 * extra) ** 2 * (STANDARD_GRAVITY / gravity)
    else:
        first = 0.347 * centimeters * (extra / orifices_per_area) ** 0.4
    return largest - (largest - jnp.minimum(first, largest)) * jnp.exp(-0.3 * height / diameter)


@formula(
    source="werther1976; kunii1991, ch. 6",
    equation=r"d_b = 0.00853\,[1 + 27.2(U-U_{mf})]^{1/3}(1 + 6.84 z)^{1.21}",
    fitted={"minimum_fluidization_velocity": (0.01, 0.08), "excess_velocity": (0.05, 0.3)},
    typical={**SPEEDS, "superficial_velocity": (0.15, 0.3), "minimum_fluidization_velocity": (0.01, 0.08)},
    symbols={"height": "z"},
)
def bubble_diameter_werther(
    superficial_velocity: Speed, minimum_fluidization_velocity: Speed, height: Distance
) -> Length:
    """Bubble diameter at a height above a porous plate by Werther, for powders of group B in vessels wider
    than 0.2 m.

    Grains of 100 to 350 µm, 5 to 30 cm/s of gas beyond minimum fluidization (Kunii and Levenspiel).

    >>> round(
    ...     bubble_diameter_werther(superficial_velocity=0.3, minimum_fluidization_velocity=0.05, height=0.0),
    ...     4,
    ... )
    0.0169
    """
    extra = surplus(superficial_velocity, minimum_fluidization_velocity)
    watch(excess_velocity=superficial_velocity - minimum_fluidization_velocity)
    return 0.00853 * (1.0 + 27.2 * extra) ** (1.0 / 3.0) * (1.0 + 6.84 * height) ** 1.21


@formula(
    source="davidson1963; geldart1986",
    title="Largest stable bubble",
    equation=r"d_{b,\max} = \frac{2 v_t^2}{g}",
    typical={"terminal_velocity": (0.1, 1.5)},
    symbols={"bubble_diameter": r"d_{b,\max}"},
)
def bubble_diameter_maximum_stable(
    terminal_velocity: Speed, gravity: Acceleration = STANDARD_GRAVITY
) -> Length:
    """Largest stable bubble: one that rises faster than its particles fall is eaten up from below.

    Geldart puts the terminal velocity of particles of 2.7 times the mean diameter.

    >>> round(bubble_diameter_maximum_stable(terminal_velocity=0.7), 3)
    0.1
    """
    return 2.0 * terminal_velocity**2 / gravity


@formula(
    source="kunii1991, ch. 6",
    equation=r"\delta = \frac{U - U_{mf}}{u_b}",
    typical={**SPEEDS, "bubble_rise_velocity": (1.2, 3.0)},
)
def bubble_fraction_davidson_harrison(
    superficial_velocity: Speed, minimum_fluidization_velocity: Speed, bubble_rise_velocity: Speed
) -> Fraction:
    """Share of a bubbling bed taken by bubbles by the two-phase theory; the bed is higher by 1/(1 - δ).

    >>> round(
    ...     bubble_fraction_davidson_harrison(
    ...         superficial_velocity=0.3, minimum_fluidization_velocity=0.05, bubble_rise_velocity=1.0
    ...     ),
    ...     3,
    ... )
    0.25
    """
    return jnp.minimum(
        surplus(superficial_velocity, minimum_fluidization_velocity) / bubble_rise_velocity, 1.0
    )


@formula(
    source="davidson1963; kunii1991, ch. 10",
    title="Exchange between bubble and cloud",
    equation=r"K_{bc} = 4.5\frac{U_{mf}}{d_b} + 5.85\frac{D^{1/2} g^{1/4}}{d_b^{5/4}}",
    typical={"diffusivity": (1e-5, 1e-4), "bubble_diameter": (0.02, 0.2)},
    symbols={"bubble_exchange_rate": "K_{bc}"},
)
def bubble_exchange_rate_cloud(
    minimum_fluidization_velocity: Speed,
    bubble_diameter: Length,
    diffusivity: Diffusivity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Frequency:
    """Gas exchanged between a bubble and its cloud per bubble volume and time.

    >>> round(
    ...     bubble_exchange_rate_cloud(
    ...         minimum_fluidization_velocity=0.02, bubble_diameter=0.1, diffusivity=2e-5
    ...     ),
    ...     3,
    ... )
    1.723
    """
    d = bubble_diameter
    return 4.5 * minimum_fluidization_velocity / d + 5.85 * jnp.sqrt(diffusivity) * gravity**0.25 / d**1.25


@formula(
    source="kunii1991, ch. 10",
    title="Exchange between cloud and emulsion",
    equation=r"K_{ce} = 6.77\left(\frac{\varepsilon_{mf} D\, u_{br}}{d_b^3}\right)^{1/2}",
    typical={"diffusivity": (1e-5, 1e-4), "bubble_diameter": (0.02, 0.2)},
    symbols={"bubble_exchange_rate": "K_{ce}", "void_fraction": r"\varepsilon_{mf}"},
)
def bubble_exchange_rate_emulsion(
    bubble_diameter: Length,
    diffusivity: Diffusivity,
    void_fraction: VoidFraction,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Frequency:
    """Gas exchanged between the cloud of a bubble and the emulsion per bubble volume and time.

    >>> round(bubble_exchange_rate_emulsion(bubble_diameter=0.1, diffusivity=2e-5, void_fraction=0.5), 3)
    0.568
    """
    rise = bubble_rise_velocity_single(bubble_diameter, gravity)
    return 6.77 * jnp.sqrt(void_fraction * diffusivity * rise / bubble_diameter**3)


@formula(
    source="kunii1991, ch. 10",
    equation=(
        r"\frac{1}{K_{be}} = \frac{1}{K_{bc}} + \frac{1}{K_{ce}},\quad K_{bc} = 4.5\frac{U_{mf}}{d_b} + "
        r"5.85\frac{D^{1/2} g^{1/4}}{d_b^{5/4}},\ K_{ce} = 6.77\left(\frac{\varepsilon_{mf} D\, "
        r"u_{br}}{d_b^3}\right)^{1/2}"
    ),
    typical={"diffusivity": (1e-5, 1e-4), "bubble_diameter": (0.02, 0.2)},
    symbols={"void_fraction": r"\varepsilon_{mf}"},
)
def bubble_exchange_rate(
    minimum_fluidization_velocity: Speed,
    bubble_diameter: Length,
    diffusivity: Diffusivity,
    void_fraction: VoidFraction,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Frequency:
    """Gas exchanged between bubbles and emulsion per bubble volume and time: bubble to cloud and cloud to
    emulsion in series.

    >>> k = bubble_exchange_rate(
    ...     minimum_fluidization_velocity=0.02, bubble_diameter=0.1, diffusivity=2e-5, void_fraction=0.5
    ... )
    >>> round(1 / (1 / 1.7233 + 1 / 0.5678), 3) == round(k, 3)
    True
    """
    cloud = bubble_exchange_rate_cloud(minimum_fluidization_velocity, bubble_diameter, diffusivity, gravity)
    emulsion = bubble_exchange_rate_emulsion(bubble_diameter, diffusivity, void_fraction, gravity)
    return cloud * emulsion / (cloud + emulsion)
