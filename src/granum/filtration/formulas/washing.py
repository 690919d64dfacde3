"""Displacement washing of a cake: what is left of the mother liquor after a volume of wash liquor."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Diffusivity, Fraction, Length, PositiveNumber, Ratio, Speed
from granum.porous import displacement


@formula(
    source="sherman1964; wakeman2005",
    equation=r"\varphi = 1 - \tfrac12\left[\operatorname{erfc}\left(\tfrac{1-w}{2\sqrt w}\sqrt{D_n}\right)"
    r" + e^{D_n}\operatorname{erfc}\left(\tfrac{1+w}{2\sqrt w}\sqrt{D_n}\right)\right]",
    fitted={"dispersion_number": (1e-2, 1e3)},
)
def wash_effluent_concentration(wash_ratio: Ratio, dispersion_number: PositiveNumber) -> Fraction:
    """Solute concentration leaving a cake that is being washed, over that of the mother liquor, by the
    dispersion model.

    The cake is saturated at the start, the wash liquor clean, the solute not adsorbed. At large dispersion
    numbers the liquor is displaced as a plug, at small ones the cake acts as a stirred vessel.

    >>> round(wash_effluent_concentration(wash_ratio=1.0, dispersion_number=1e3), 2)
    0.49
    """
    return displacement.effluent_concentration(wash_ratio, dispersion_number)


@formula(
    source="sherman1964; wakeman2005",
    title="Solute left in the cake, with dispersion",
    equation=r"F = 1 - w + \tfrac12\left[(w-1)\operatorname{erfc}\left(\tfrac{1-w}{2\sqrt w}\sqrt{D_n}\right)"
    r" + (w+1)\,e^{D_n}\operatorname{erfc}\left(\tfrac{1+w}{2\sqrt w}\sqrt{D_n}\right)\right]",
    fitted={"dispersion_number": (1e-2, 1e3)},
    typical={"wash_ratio": (0.1, 2.0), "dispersion_number": (0.5, 50.0)},
)
def solute_remaining_dispersion(wash_ratio: Ratio, dispersion_number: PositiveNumber) -> Fraction:
    """Fraction of the mother liquor's solute still in a cake after washing, by the dispersion model.

    The integral of the effluent curve in closed form; F is never below 1 − w, the plug displacement.

    >>> round(solute_remaining_dispersion(wash_ratio=1.5, dispersion_number=10.0), 3)
    0.048
    """
    return displacement.remaining_fraction(wash_ratio, dispersion_number)


@formula(
    source="choudhury1957",
    equation=r"F = (1 - E)^{w}",
    fitted={"displacement_efficiency": (0.35, 0.86)},
)
def solute_remaining_dahlstrom(wash_ratio: Ratio, displacement_efficiency: Fraction = 0.7) -> Fraction:
    """Fraction of the solute still in a cake after washing on a drum, by the displacement efficiency of one
    void volume.

    >>> round(solute_remaining_dahlstrom(wash_ratio=2.0, displacement_efficiency=0.7), 6)
    0.09
    """
    return jnp.maximum(1.0 - displacement_efficiency, 1e-300) ** wash_ratio


@formula(
    source="wakeman2005",
    title="Axial dispersion in a cake",
    equation=r"D_L = D\left(\frac{1}{\sqrt2} + 1.75\,\frac{v d_p}{D}\right)",
    typical={"velocity": (1e-5, 1e-3), "particle_diameter": (1e-5, 2e-4)},
)
def axial_dispersion_cake(
    velocity: Speed, particle_diameter: Length, diffusivity: Diffusivity
) -> Diffusivity:
    """Axial dispersion of a solute in the pores of a thin cake (up to about 10 cm) at a pore velocity.

    >>> round(axial_dispersion_cake(velocity=1e-4, particle_diameter="50 um", diffusivity=1e-9) * 1e9, 3)
    9.457
    """
    return displacement.axial_dispersion(velocity, particle_diameter, diffusivity)


@formula(
    source="sherman1964",
    equation=r"D_n = \frac{v Z}{D_L}",
    typical={"velocity": (1e-5, 1e-3), "axial_dispersion": (1e-9, 1e-7)},
)
def dispersion_number(
    velocity: Speed, cake_thickness: Length, axial_dispersion: Diffusivity
) -> PositiveNumber:
    """Dispersion number of cake washing: pore velocity and cake thickness over axial dispersion.

    >>> round(dispersion_number(velocity=1e-4, cake_thickness="2 cm", axial_dispersion=1e-7), 6)
    20.0
    """
    return velocity * cake_thickness / axial_dispersion


@formula(
    source="wakeman2005",
    equation=r"F = (1 + R)^{-N}",
    title="Solute left after reslurry washing",
    output="solute_remaining",
)
def solute_remaining_reslurry(reslurry_ratio: Ratio, wash_stages: PositiveNumber = 1.0) -> Fraction:
    """Fraction of the solute left when a cake is stirred up in wash liquor and filtered again, stage after
    stage.

    The ratio is fresh wash liquor per liquor held by the cake, in each stage.

    >>> round(solute_remaining_reslurry(reslurry_ratio=4.0, wash_stages=2), 6)
    0.04
    """
    return (1.0 + reslurry_ratio) ** (-wash_stages)
