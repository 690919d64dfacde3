"""Freeboard: transport disengaging height, and the flux of fines entrained, by several authors."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, limit_active
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Acceleration,
    Density,
    Distance,
    DynamicViscosity,
    Length,
    MassFlux,
    SpecificSurface,
    Speed,
)
from granum.numerics import safe_power
from granum.particles.definitions import reynolds_of

SURFACE = {
    "bubble_diameter": (0.03, 0.3),
    "superficial_velocity": (0.2, 1.0),
    "minimum_fluidization_velocity": (0.01, 0.1),
}
ESCAPE = {
    "particle_diameter": (2e-5, 1e-4),
    "superficial_velocity": (0.6, 2.0),
    "terminal_velocity": (0.02, 0.4),
    "fluid_density": (0.4, 5.0),
    "dynamic_viscosity": (1.5e-5, 4e-5),
}
BELOW_TERMINAL = "Below the terminal velocity of a class the gas carries none of it away: the rate is zero."


@formula(source="fung1993", equation=r"\mathrm{TDH} = 13.8\,d_b", typical=SURFACE)
def disengaging_height_fung(bubble_diameter: Length) -> Length:
    """Transport disengaging height by Fung and Hamdullahpur, from the bubbles at the surface.

    >>> round(disengaging_height_fung(bubble_diameter=0.1), 6)
    1.38
    """
    return 13.8 * bubble_diameter


@formula(source="horio1980", equation=r"\mathrm{TDH} = 4.47\,d_b^{1/2}", typical=SURFACE)
def disengaging_height_horio(bubble_diameter: Length) -> Length:
    """Transport disengaging height by Horio and others, from the bubbles at the surface.

    >>> round(disengaging_height_horio(bubble_diameter=0.04), 3)
    0.894
    """
    return 4.47 * jnp.sqrt(bubble_diameter)


@formula(source="pemberton1986", equation=r"\mathrm{TDH} = 18.2\,d_b", typical=SURFACE)
def disengaging_height_pemberton(bubble_diameter: Length) -> Length:
    """Transport disengaging height by Pemberton and Davidson, from the bubbles at the surface.

    >>> round(disengaging_height_pemberton(bubble_diameter=0.1), 6)
    1.82
    """
    return 18.2 * bubble_diameter


@formula(
    source="amitin1968", equation=r"\mathrm{TDH} = 0.85\,U^{1.2}(7.33 - 1.2\log_{10} U)", typical=SURFACE
)
def disengaging_height_amitin(superficial_velocity: Speed) -> Length:
    """Transport disengaging height by Amitin and others, from the gas velocity.

    At 1 m/s the logarithm vanishes:

    >>> round(disengaging_height_amitin(superficial_velocity=1.0), 4)
    6.2305
    """
    return 0.85 * superficial_velocity**1.2 * (7.33 - 1.2 * jnp.log10(superficial_velocity))


@formula(source="fournol1973", equation=r"\mathrm{TDH} = 1000\,U^2/g", typical=SURFACE)
def disengaging_height_fournol(
    superficial_velocity: Speed, gravity: Acceleration = STANDARD_GRAVITY
) -> Length:
    """Transport disengaging height by Fournol and others, for cracking catalyst.

    >>> round(disengaging_height_fournol(superficial_velocity=0.1), 2)
    1.02
    """
    return 1000.0 * superficial_velocity**2 / gravity


@formula(source="smolders2001", equation=r"\mathrm{TDH} = 6\,[(U-U_{mf})\,d_b]^{0.6}", typical=SURFACE)
def disengaging_height_smolders(
    superficial_velocity: Speed, minimum_fluidization_velocity: Speed, bubble_diameter: Distance
) -> Distance:
    """Transport disengaging height by Smolders and Baeyens, from bubbles and excess gas.

    No bubbles throw nothing up: the height is then zero.

    >>> round(
    ...     disengaging_height_smolders(
    ...         superficial_velocity=1.1, minimum_fluidization_velocity=0.1, bubble_diameter=1.0
    ...     ),
    ...     6,
    ... )
    6.0
    """
    extra = jnp.maximum(superficial_velocity - minimum_fluidization_velocity, 1e-12)
    return 6.0 * safe_power(extra * bubble_diameter, 0.6)


@formula(
    source="geldart1979; kunii1991, ch. 7",
    equation=r"K^*_\infty = 23.7\,\rho_f U\,e^{-5.4\,v_t/U}",
    fitted={"superficial_velocity": (0.6, 3.0)},
    typical=ESCAPE,
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_geldart(
    superficial_velocity: Speed, terminal_velocity: Speed, fluid_density: Density
) -> MassFlux:
    """Elutriation rate constant of a size class above the disengaging height by Geldart and others.

    The flux of a class is the constant times its mass fraction in the bed. Gas velocities of 0.6 to 3 m/s.

    >>> round(elutriation_flux_geldart(superficial_velocity=1.0, terminal_velocity=0.5, fluid_density=1.2), 3)
    1.911
    """
    U = superficial_velocity
    return 23.7 * fluid_density * U * jnp.exp(-5.4 * terminal_velocity / U)


@formula(
    source="tasirin1998; kramp2010",
    equation=r"K^*_\infty = 14.5\,\rho_f U^{2.5}\,e^{-5.4\,v_t/U}",
    fitted={"superficial_velocity": (0.2, 0.8)},
    typical={**ESCAPE, "superficial_velocity": (0.4, 0.8)},
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_tasirin_geldart(
    superficial_velocity: Speed, terminal_velocity: Speed, fluid_density: Density
) -> MassFlux:
    """Elutriation rate constant of a size class by Tasirin and Geldart, for a turbulent freeboard.

    Validated from 0.2 to 0.8 m/s, for particles of 68 to 124 µm (Kramp and others).

    >>> round(
    ...     elutriation_flux_tasirin_geldart(
    ...         superficial_velocity=0.5, terminal_velocity=0.25, fluid_density=1.2
    ...     ),
    ...     3,
    ... )
    0.207
    """
    U = superficial_velocity
    return 14.5 * fluid_density * U**2.5 * jnp.exp(-5.4 * terminal_velocity / U)


@formula(
    source="zenz1958; kunii1991, ch. 7",
    equation=(
        r"\frac{K^*_\infty}{\rho_f U} = \begin{cases}1.26\times10^7 X^{1.88} & X < 3\times10^{-4}\\ "
        r"4.31\times10^4 X^{1.18}\end{cases},\ X = \frac{U^2}{g d_p \rho_p^2}"
    ),
    fitted={"particle_diameter": (4e-5, 2e-4)},
    typical={**ESCAPE, "particle_diameter": (4e-5, 1e-4)},
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_zenz_weil(
    superficial_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> MassFlux:
    """Elutriation rate constant of a size class by Zenz and Weil, from cracking catalyst of 40 to 200 µm.

    >>> k = elutriation_flux_zenz_weil(
    ...     superficial_velocity=0.6, particle_diameter="60 um", particle_density=1500, fluid_density=1.2
    ... )
    >>> 0.5 < k < 2.0
    True
    """
    U = superficial_velocity
    X = U**2 / (gravity * particle_diameter * particle_density**2)
    return fluid_density * U * jnp.where(X < 3e-4, 1.26e7 * X**1.88, 4.31e4 * X**1.18)


@formula(
    source="wen1960",
    equation=(
        r"K^*_\infty = 1.52\times10^{-5}\rho_f (U-v_t)\left[\frac{(U-v_t)^2}{g "
        r"d_p}\right]^{1/2}\mathrm{Re}_t^{0.725}\left(\frac{\rho_p-\rho_f}{\rho_f}\right)^{1.15}"
    )
    + reynolds_of("v_t", "t"),
    fitted={"particle_diameter": (4e-5, 2.7e-4)},
    typical={**ESCAPE, "particle_diameter": (4e-5, 1e-4)},
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_wen_hashinger(
    superficial_velocity: Speed,
    terminal_velocity: Speed,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> MassFlux:
    """Elutriation rate constant of a size class by Wen and Hashinger, from 40 to 270 µm; none below the
    terminal velocity.

    The constant is that of Kunii and Levenspiel's example 7.5; some reprints have 1.7e-5.

    >>> round(
    ...     elutriation_flux_wen_hashinger(
    ...         superficial_velocity=0.6,
    ...         terminal_velocity=0.3,
    ...         particle_diameter="60 um",
    ...         particle_density=1500,
    ...         fluid_density=1.2,
    ...         dynamic_viscosity=1.8e-5,
    ...     ),
    ...     3,
    ... )
    0.281
    >>> elutriation_flux_wen_hashinger(
    ...     superficial_velocity=0.2,
    ...     terminal_velocity=0.3,
    ...     particle_diameter="60 um",
    ...     particle_density=1500,
    ...     fluid_density=1.2,
    ...     dynamic_viscosity=1.8e-5,
    ... )
    0.0
    """
    d, rho = particle_diameter, fluid_density
    limit_active(
        superficial_velocity <= terminal_velocity,
        superficial_velocity,
        "superficial_velocity",
        BELOW_TERMINAL,
    )
    slip = jnp.maximum(superficial_velocity - terminal_velocity, 0.0)
    Re = rho * terminal_velocity * d / dynamic_viscosity
    heavy = jnp.maximum(particle_density - rho, 1e-12) / rho
    return 1.52e-5 * rho * slip**2 / jnp.sqrt(gravity * d) * Re**0.725 * heavy**1.15


@formula(
    source="lin1980",
    equation=r"K^*_\infty = 9.43\times10^{-4}\,\rho_f U\left(\frac{U^2}{g d_p}\right)^{1.65}",
    typical={**ESCAPE, "superficial_velocity": (0.1, 0.3)},
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_lin(
    superficial_velocity: Speed,
    particle_diameter: Length,
    fluid_density: Density,
    gravity: Acceleration = STANDARD_GRAVITY,
) -> MassFlux:
    """Elutriation rate constant of a size class by Lin, Sears and Wen, from char finer than 30 to 150 µm.

    >>> round(
    ...     elutriation_flux_lin(
    ...         superficial_velocity=1.0, particle_diameter=1.0, fluid_density=1.0, gravity=1.0
    ...     ),
    ...     6,
    ... )
    0.000943
    """
    U = superficial_velocity
    return 9.43e-4 * fluid_density * U * (U**2 / (gravity * particle_diameter)) ** 1.65


@formula(
    source="colakyan1984; kramp2010",
    equation=r"K^*_\infty = 33\,(1 - v_t/U)^2",
    fitted={"superficial_velocity": (0.9, 3.7)},
    typical={**ESCAPE, "superficial_velocity": (0.9, 2.0)},
    symbols={"elutriation_flux": r"K^*_\infty"},
)
def elutriation_flux_colakyan_levenspiel(superficial_velocity: Speed, terminal_velocity: Speed) -> MassFlux:
    """Elutriation rate constant of coarse particles by Colakyan and Levenspiel; none below the terminal
    velocity.

    Validated from 0.9 to 3.7 m/s, for particles of 300 to 1000 µm (Kramp and others).

    >>> round(elutriation_flux_colakyan_levenspiel(superficial_velocity=1.0, terminal_velocity=0.5), 6)
    8.25
    """
    return 33.0 * jnp.maximum(1.0 - terminal_velocity / superficial_velocity, 0.0) ** 2


@formula(
    source="kunii1991, ch. 7",
    title="Entrained solids flux along the freeboard",
    equation=r"G_s = G_s^* + (G_{s,0} - G_s^*)\,e^{-a z}",
    typical={
        "entrainment_flux_carried": (0.1, 2.0),
        "entrainment_flux_ejected": (3.0, 10.0),
        "height": (0.5, 4.0),
    },
    symbols={"entrainment_flux_carried": "G_s^*", "entrainment_flux_ejected": "G_{s,0}", "height": "z"},
)
def entrainment_flux_freeboard(
    entrainment_flux_carried: MassFlux,
    entrainment_flux_ejected: MassFlux,
    entrainment_decay: SpecificSurface,
    height: Distance,
) -> MassFlux:
    """Solids flux at a height of the freeboard: from what the bubbles throw up it falls to what the gas
    carries away.

    Kunii and Levenspiel's example 7.6, an outlet 2 m above the bed, where 38 % more leaves than with a tall
    freeboard:

    >>> round(
    ...     entrainment_flux_freeboard(
    ...         entrainment_flux_carried=0.654,
    ...         entrainment_flux_ejected=5.0,
    ...         entrainment_decay=0.72 / 0.503,
    ...         height=2.0,
    ...     ),
    ...     3,
    ... )
    0.902
    """
    carried = entrainment_flux_carried
    return carried + (entrainment_flux_ejected - carried) * jnp.exp(-entrainment_decay * height)
