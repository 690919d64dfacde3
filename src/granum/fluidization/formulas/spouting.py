"""Spouted beds: one jet through the middle of grains too coarse to bubble."""

from __future__ import annotations

import math
from typing import Any

import jax.numpy as jnp

from granum.core import formula, impossible, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Angle,
    Density,
    DynamicViscosity,
    Length,
    PositiveNumber,
    PressureDrop,
    Speed,
    VoidFraction,
    Volume,
)
from granum.fluidization.formulas.buoyancy import archimedes, excess, larger_root
from granum.particles.definitions import ARCHIMEDES

WIDE_JET = "A jet must be narrower than its vessel."
WEIGHT = {
    "bed_depth": (0.05, 1.0),
    "particle_density": (900.0, 2700.0),
    "fluid_density": (0.4, 5.0),
    "void_fraction": (0.38, 0.5),
}
CONE = math.radians(30.0)  # 60° between opposite walls
VESSEL = {
    "particle_diameter": (1e-3, 6e-3),
    "particle_density": (900.0, 2700.0),
    "fluid_density": (0.4, 5.0),
    "diameter": (0.07, 0.6),
    "inlet_diameter": (0.01, 0.06),
}


def _within(inlet: Any, vessel: Any) -> None:
    """A jet is narrower than its vessel."""
    impossible(inlet >= vessel, inlet, "inlet_diameter", 0.0, vessel, WIDE_JET)


@formula(
    source="mathur1955, as written in an open program",
    equation=(
        r"U_{sp} = \frac{d_p}{D}\left(\frac{D_i}{D}\right)^{1/3}"
        r"\sqrt{\frac{2 g L (\rho_p - \rho_f)}{\rho_f}}"
    ),
    fitted={"diameter": (0.0, 0.6)},
    typical=VESSEL | {"bed_depth": (0.05, 0.6)},
)
def minimum_spouting_velocity_mathur_gishler(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    diameter: Length,
    inlet_diameter: Length,
    bed_depth: Length,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Speed:
    """Minimum superficial velocity of a bed through whose middle a jet keeps a spout open, by Mathur and
    Gishler.

    Over the section of the whole vessel. Wider vessels than 0.6 m ask for more than this tells (recalled).

    >>> u = minimum_spouting_velocity_mathur_gishler(
    ...     "2.18 mm", 2400, 1.18, diameter="76 mm", inlet_diameter="9.5 mm", bed_depth="10 cm"
    ... )
    >>> round(u, 3)
    0.906
    """
    _within(inlet_diameter, diameter)
    head = 2.0 * gravity * bed_depth * excess(particle_density, fluid_density) / fluid_density
    return particle_diameter / diameter * jnp.cbrt(inlet_diameter / diameter) * jnp.sqrt(head)


@formula(
    source="mcnab1977, recalled; mathur1955; wen1966",
    equation=(
        r"L_m = \frac{D^2}{d_p}\left(\frac{D}{D_i}\right)^{2/3}\frac{568\,b^2}{\mathrm{Ar}}\left(\sqrt{1 + "
        r"35.9\times 10^{-6}\,\mathrm{Ar}} - 1\right)^2" + ARCHIMEDES
    ),
    fitted={"diameter": (0.0, 0.6), "reynolds": (0.001, 4000.0)},
    typical=VESSEL | {"dynamic_viscosity": (1.5e-5, 4e-5)},
)
def spoutable_depth_mcnab_bridgwater(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    diameter: Length,
    inlet_diameter: Length,
    spouting_ratio: PositiveNumber = 1.11,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> Length:
    """Depth of the deepest bed that spouts, by McNab and Bridgwater: there the spout asks for
    ``spouting_ratio`` times the velocity at which all of the bed fluidizes.

    The velocities are those of Mathur and Gishler and of Wen and Yu.

    >>> depth = spoutable_depth_mcnab_bridgwater(
    ...     "3 mm", 1300, 1.2, 1.8e-5, diameter="15 cm", inlet_diameter="2 cm"
    ... )
    >>> 0.3 < depth < 0.8
    True
    """
    _within(inlet_diameter, diameter)
    d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
    Ar = archimedes(d, particle_density, rho, eta, gravity)
    Re = larger_root(33.7, 0.0408 * Ar)
    watch(reynolds=Re)
    slender = diameter**2 / d * jnp.cbrt(diameter / inlet_diameter) ** 2
    return slender * spouting_ratio**2 * Re**2 / (2.0 * Ar)


@formula(
    source="mathur1974, recalled",
    equation=(
        r"L = \frac{d - D_i}{2\tan\gamma},\quad d = \sqrt[3]{D_i^3 + \frac{24\,V\tan\gamma}{\pi}}\ (d < D);"
        r"\quad L = L_c + \frac{4\,(V - V_c)}{\pi D^2}\ \text{beyond}"
    ),
    typical={
        "volume": (1e-3, 0.2),
        "diameter": (0.1, 0.6),
        "inlet_diameter": (0.01, 0.06),
        "cone_angle": (0.35, 0.8),
    },
    output="bed_depth",
    family="bed_depth",
    title="Depth of a bed in a cone and the cylinder above it",
)
def bed_depth_cone_cylinder(
    volume: Volume, diameter: Length, inlet_diameter: Length, cone_angle: Angle = CONE
) -> Length:
    """Depth above the inlet of so much bed in a vessel whose bottom is a cone, as spouted beds have.

    The correlations of spouted beds count their depth from the inlet.

    >>> round(bed_depth_cone_cylinder("1 L", diameter="152 mm", inlet_diameter="19 mm"), 4)
    0.1265
    """
    _within(inlet_diameter, diameter)
    slope = jnp.tan(cone_angle)
    cone = jnp.pi / (24.0 * slope) * (diameter**3 - inlet_diameter**3)
    wide = jnp.cbrt(inlet_diameter**3 + 24.0 * slope / jnp.pi * jnp.minimum(volume, cone))
    above = jnp.maximum(volume - cone, 0.0) / (0.25 * jnp.pi * diameter**2)
    return (wide - inlet_diameter) / (2.0 * slope) + above


def _carried(depth: Any, rho_p: Any, rho: Any, void_fraction: Any, gravity: Any) -> Any:
    """Pressure that carries the whole bed, Pa."""
    return (1.0 - void_fraction) * excess(rho_p, rho) * gravity * depth


@formula(
    source="lefroy1969, recalled",
    equation=r"\Delta p_s = \frac{2}{\pi}\,(1 - \varepsilon)(\rho_p - \rho_f)\,g\,L",
    typical=WEIGHT,
)
def spouting_pressure_drop_lefroy_davidson(
    bed_depth: Length,
    particle_density: Density,
    fluid_density: Density,
    void_fraction: VoidFraction = 0.42,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> PressureDrop:
    """Pressure drop of a bed with an open spout, by Lefroy and Davidson: two thirds of what would carry all
    of it.

    The gradient in the annulus rises as a quarter of a sine from the inlet to the surface, where the gas
    carries the grains. So in deep beds; shallow ones lose less.

    >>> round(spouting_pressure_drop_lefroy_davidson("30 cm", 1300, 1.2, void_fraction=0.42))
    1411
    """
    carried = _carried(bed_depth, particle_density, fluid_density, void_fraction, gravity)
    return 2.0 / jnp.pi * carried


@formula(
    source="asenjo1977, recalled",
    equation=r"\Delta p_M = (1 - \varepsilon)(\rho_p - \rho_f)\,g\,L\left(1 + 2.8\,e^{-0.312\,L/D}\right)",
    typical=WEIGHT | {"diameter": (0.07, 0.6)},
)
def starting_pressure_drop_asenjo(
    bed_depth: Length,
    diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    void_fraction: VoidFraction = 0.42,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> PressureDrop:
    """Highest pressure drop of a settled bed before the jet has broken through it, by Asenjo and others: what
    the fan must give for a moment at the start.

    >>> round(starting_pressure_drop_asenjo("30 cm", "15 cm", 1300, 1.2, void_fraction=0.42))
    5541
    """
    carried = _carried(bed_depth, particle_density, fluid_density, void_fraction, gravity)
    return carried * (1.0 + 2.8 * jnp.exp(-0.312 * bed_depth / diameter))
