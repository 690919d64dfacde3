"""How thick a cake may be before gas cracks it as it drains."""

from __future__ import annotations

from typing import Annotated

from granum.core import formula
from granum.core.kinds import (
    Length,
    PositiveNumber,
    PressureDrop,
    SurfaceTension,
    VoidFraction,
    Within,
)


@formula(
    source="abbottcracks; singh2007",
    title="Thickest cake that does not crack",
    equation=r"Z_c = 0.64\,\frac{2\,\sigma\,\sqrt{G\,M\,(1-\varepsilon)}}{p_c^{3/2}}",
    output="cake_thickness_crack_free",
    typical={
        "void_fraction": (0.35, 0.6),
        "surface_tension": (0.02, 0.075),
        "shear_modulus": (1e9, 5e10),
        "capillary_pressure": (2e3, 1e5),
    },
    symbols={"capillary_pressure": "p_c", "cake_thickness_crack_free": "Z_c"},
)
def cake_thickness_crack_free_singh(
    capillary_pressure: PressureDrop,
    surface_tension: SurfaceTension,
    shear_modulus: PressureDrop,
    void_fraction: VoidFraction,
    coordination_number: Annotated[PositiveNumber, Within(2.0, 12.0)] = 6.0,
) -> Length:
    """Thickest saturated cake that suction from its surface does not crack: below it the energy that a crack
    would set free is less than that of the two surfaces that it makes.

    The suction is the threshold pressure of the cake, or the pressure drop where that is lower; the modulus
    that of the solid of the grains (quartz 31 GPa and more, salts and organic crystals 1 to 15). The cake is
    held by its cloth and stays saturated; what is flocculated shrinks more. Thicker cakes may crack, thinner
    ones do not. Found for drying layers of submicron particles; for filter cakes it is an extrapolation.
    Differs from the print: the page that was opened has the power 1/2 on the pressure, with which the surface
    tension would drop out. By hand: contacts whose stress grows as G M (1-ε) times the square of the strain
    store p_c^{3/2}/(G M (1-ε))^{1/2} per volume, and a crack of depth Z has 2 σ to pay per area, which gives
    the power 3/2.

    >>> round(1e3 * cake_thickness_crack_free_singh("20 kPa", "72 mN/m", "30 GPa", 0.45), 1)
    10.3
    """
    stiffness = shear_modulus * coordination_number * (1.0 - void_fraction)
    return 0.64 * 2.0 * surface_tension * stiffness**0.5 / capillary_pressure**1.5
