"""Specific resistance of a cake: from its structure, and its dependence on pressure."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, limit_active
from granum.core.kinds import (
    CakeResistance,
    Density,
    Length,
    Permeability,
    PositiveNumber,
    PressureDrop,
    Ratio,
    VoidFraction,
)
from granum.filtration.kinds import OVER_COMPRESSIBLE


@formula(
    source="carman1938",
    equation=r"\alpha = \frac{36\,h_K\,(1 - \varepsilon)}{d_p^2\,\varepsilon^3\,\rho_s}",
    fitted={"void_fraction": (0.3, 0.6)},
)
def cake_resistance_kozeny_carman(
    particle_diameter: Length,
    void_fraction: VoidFraction,
    solid_density: Density,
    kozeny_coefficient: PositiveNumber = 5.0,
) -> CakeResistance:
    """Specific cake resistance from the surface–volume diameter of the particles and the void fraction.

    The coefficient is 4 to 5 for isometric grains, several times more for fibers; real cakes of fine or
    flocculated particles resist up to ten times more. Differs from the print in the notes, which have the
    specific surface where the diameter belongs.

    >>> from granum.core.units import format_number
    >>> format_number(
    ...     cake_resistance_kozeny_carman(particle_diameter="85 um", void_fraction=0.38, solid_density=2630),
    ...     3,
    ... )
    '1.07 × 10⁸'
    """
    e, d = void_fraction, particle_diameter
    return 36.0 * kozeny_coefficient * (1.0 - e) / (d**2 * e**3 * solid_density)


@formula(source="carman1938", equation=r"B = \frac{1}{\alpha\,(1 - \varepsilon)\,\rho_s}")
def cake_permeability(
    cake_resistance: CakeResistance, void_fraction: VoidFraction, solid_density: Density
) -> Permeability:
    """Permeability of a cake from its specific resistance.

    Differs from the print in the notes, which have 1 + ε for 1 − ε.

    >>> round(cake_permeability(cake_resistance=1e10, void_fraction=0.5, solid_density=2000) * 1e13, 6)
    1.0
    """
    return 1.0 / (cake_resistance * (1.0 - void_fraction) * solid_density)


@formula(
    source="mccabe2005, ch. 29",
    title="Cake resistance by a power law",
    fitted={"compressibility": (0.0, 1.0)},
    equation=r"\bar\alpha = \alpha_0\left(\frac{\Delta p}{p_0}\right)^n",
    typical={"compressibility": (0.0, 0.9), "cake_resistance_reference": (1e9, 1e12)},
    symbols={"cake_resistance": r"\bar\alpha", "cake_resistance_reference": r"\alpha_0"},
)
def cake_resistance_power_law(
    pressure_drop: PressureDrop,
    cake_resistance_reference: CakeResistance,
    compressibility: Ratio,
    reference_pressure: PressureDrop = 1.0,
) -> CakeResistance:
    """Mean specific resistance of a compressible cake as a power of the filtration pressure.

    The reference pressure of 1 Pa is the custom of handbooks (α₀ in m/kg at Δp in Pa). A compressibility of
    0 is a rigid cake, 0.2 to 0.8 is common; above 1 more pressure gives less filtrate, which tests seldom
    bear out.

    >>> from granum.core.units import format_number
    >>> format_number(
    ...     cake_resistance_power_law(
    ...         pressure_drop=67e3, cake_resistance_reference=4.37e9, compressibility=0.3
    ...     ),
    ...     4,
    ... )
    '1.225 × 10¹¹'
    """
    limit_active(compressibility > 1.0, compressibility, "compressibility", OVER_COMPRESSIBLE)
    return cake_resistance_reference * (pressure_drop / reference_pressure) ** compressibility


@formula(
    source="tiller1953; mccabe2005, ch. 29",
    title="Cake resistance with a threshold pressure",
    fitted={"compressibility": (0.0, 1.0)},
    equation=r"\bar\alpha = \alpha_0\,\max\left(1, \frac{\Delta p}{p_s}\right)^n",
    typical={"compressibility": (0.0, 0.9), "cake_resistance_reference": (1e9, 1e12)},
    family="cake_resistance",
    symbols={"cake_resistance": r"\bar\alpha", "cake_resistance_reference": r"\alpha_0"},
)
def cake_resistance_threshold(
    pressure_drop: PressureDrop,
    cake_resistance_reference: CakeResistance,
    compressibility: Ratio,
    threshold_pressure: PressureDrop,
) -> CakeResistance:
    """Mean specific resistance of a cake that yields only above a threshold pressure: constant below, a power
    above.

    The range is that of ``cake_resistance_power_law``.

    >>> round(cake_resistance_threshold(1e5, 1e10, 0.5, threshold_pressure=2.5e4) / 1e10, 6)
    2.0
    """
    limit_active(compressibility > 1.0, compressibility, "compressibility", OVER_COMPRESSIBLE)
    return cake_resistance_reference * jnp.maximum(pressure_drop / threshold_pressure, 1.0) ** compressibility
