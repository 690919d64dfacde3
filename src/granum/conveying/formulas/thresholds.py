"""Gas velocities at which particles settle out in a level pipe, choke a rising one, or are picked up."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, unconverged
from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    MassFlow,
    MassFlux,
    MassRatio,
    PositiveNumber,
    Speed,
    VoidFraction,
    Within,
)
from granum.numerics import find_root
from granum.particles.formulas.criteria import archimedes_number

_PIPE = {
    "mass_flux": (20.0, 200.0),
    "particle_diameter": (1e-4, 3e-3),
    "particle_density": (800.0, 3000.0),
    "fluid_density": (1.0, 3.0),
    "terminal_velocity": (0.3, 8.0),
    "diameter": (0.05, 0.2),
}
PUNWANI = 2250.0  # m^(-1.31) kg^0.77 s^-2, from the print
YANG = 0.01
PositiveMassRatio = Annotated[MassRatio, Within(1e-6, 1e3)]
SHALLOW, DEEP = 1e-13, 0.6  # share of the pipe that particles take up
ZONES = (0.45, 16.5)


def _typical(*names: str) -> dict[str, tuple[float, float]]:
    return {name: _PIPE[name] for name in names}


@formula(
    source="rizk1973",
    equation=(
        r"\frac{G}{\rho_f\,v_s} = 10^{-(1440\,d_p + 1.96)}"
        r"\left(\frac{v_s}{\sqrt{g\,D}}\right)^{1100\,d_p + 2.5}"
    ),
    typical=_typical("mass_flux", "particle_diameter", "fluid_density", "diameter"),
)
def saltation_velocity_rizk(
    mass_flux: MassFlux, particle_diameter: Length, fluid_density: Density, diameter: Length
) -> Speed:
    """Gas velocity in a level pipe below which particles begin to settle out by Rizk; the mass flux is that
    of the solid.

    Measured with plastics; for particles of other sizes and densities half as much again is taken.

    Rhodes's example: 0.25 kg/s of 100 µm in a pipe of 78 mm.

    >>> round(saltation_velocity_rizk(0.25 / (3.14159265 / 4 * 0.078**2), "100 um", 1.2, "78 mm"), 2)
    9.88
    """
    a, b = 1440.0 * particle_diameter + 1.96, 1100.0 * particle_diameter + 2.5
    speed = jnp.sqrt(STANDARD_GRAVITY * diameter)
    # by logarithms: large particles lead to powers of hundreds
    ratio = jnp.log(jnp.maximum(mass_flux, 1e-300) / (fluid_density * speed)) + a * jnp.log(10.0)
    return jnp.where(mass_flux > 0.0, speed * jnp.exp(ratio / (1.0 + b)), 0.0)


@formula(
    source="matsumoto1977",
    equation=(
        r"\frac{G}{\rho_f\,v_s} = \begin{cases} 5560\left(\frac{d_p}{D}\right)^{1.43}\mathrm{Fr}^4 & "
        r"d_p \le d^* \\ 0.373\left(\frac{\rho_p}{\rho_f}"
        r"\right)^{1.06}\left(\frac{v_t}{10\sqrt{g\,d_p}}\right)^{-3.7}\mathrm{Fr}^{3.61} & "
        r"d_p > d^*\end{cases},\quad \mathrm{Fr} = \frac{v_s}{10\sqrt{g\,D}},\ "
        r"d^* = 1.39\,D\left(\frac{\rho_p}{\rho_f}\right)^{-0.74}"
    ),
    typical=_typical(
        "mass_flux", "particle_diameter", "particle_density", "fluid_density", "terminal_velocity", "diameter"
    ),
)
def saltation_velocity_matsumoto(
    mass_flux: MassFlux,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    terminal_velocity: Speed,
    diameter: Length,
) -> Speed:
    """Gas velocity in a level pipe below which particles begin to settle out by Matsumoto and others; the
    mass flux is that of the solid.

    Coarse and fine particles follow laws of their own, which meet with a step.

    >>> 15 < saltation_velocity_matsumoto(127.3, "1 mm", 1000.0, 1.2, 5.24, "0.1 m") < 18
    True
    """
    density, froude = particle_density / fluid_density, 10.0 * jnp.sqrt(STANDARD_GRAVITY * diameter)
    flux = jnp.maximum(mass_flux, 1e-300) / (fluid_density * froude)
    fine = flux / (5560.0 * (particle_diameter / diameter) ** 1.43)
    fall = jnp.maximum(terminal_velocity, 1e-9) / (10.0 * jnp.sqrt(STANDARD_GRAVITY * particle_diameter))
    coarse = flux / (0.373 * density**1.06 * fall**-3.7)
    is_fine = particle_diameter <= 1.39 * diameter * density**-0.74
    found = froude * jnp.where(is_fine, fine**0.2, coarse ** (1.0 / 4.61))
    return jnp.where(mass_flux > 0.0, found, 0.0)


@formula(
    source="schade1987; setia2015",
    equation=(
        r"\frac{v_s}{\sqrt{g\,D}} = \left(\frac{G}{\rho_f\,v_s}\right)^{0.11}"
        r"\left(\frac{D}{d_p}\right)^{0.025}\left(\frac{\rho_p}{\rho_f}\right)^{0.34}"
    ),
    typical=_typical("mass_flux", "particle_diameter", "particle_density", "fluid_density", "diameter"),
)
def saltation_velocity_schade(
    mass_flux: MassFlux,
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    diameter: Length,
) -> Speed:
    """Gas velocity in a level pipe below which particles begin to settle out by Schade; the mass flux is that
    of the solid.

    >>> 13 < saltation_velocity_schade(127.3, "1 mm", 1000.0, 1.2, "0.1 m") < 14
    True
    """
    speed = jnp.sqrt(STANDARD_GRAVITY * diameter)
    shape = (diameter / particle_diameter) ** 0.025 * (particle_density / fluid_density) ** 0.34
    flux = jnp.maximum(mass_flux, 1e-300) / (fluid_density * speed)
    return jnp.where(mass_flux > 0.0, speed * (flux**0.11 * shape) ** (1.0 / 1.11), 0.0)


@formula(
    source="weber1981; gomes2014",
    equation=(
        r"\frac{v_s}{\sqrt{g\,D}} = \min\left(7 + \tfrac83 v_t,\ 15\right)"
        r"\left(\frac{G}{\rho_f\,v_s}\right)^{0.25}\left(\frac{d_p}{D}\right)^{0.1}"
    ),
    typical=_typical("mass_flux", "particle_diameter", "fluid_density", "terminal_velocity", "diameter"),
)
def saltation_velocity_weber(
    mass_flux: MassFlux,
    particle_diameter: Length,
    fluid_density: Density,
    terminal_velocity: Speed,
    diameter: Length,
) -> Speed:
    """Gas velocity in a level pipe below which particles begin to settle out by Weber; the mass flux is that
    of the solid, the terminal velocity in m/s.

    >>> 15 < saltation_velocity_weber(127.3, "1 mm", 1.2, 4.0, "0.1 m") < 16
    True
    """
    speed = jnp.sqrt(STANDARD_GRAVITY * diameter)
    shape = jnp.minimum(7.0 + 8.0 / 3.0 * terminal_velocity, 15.0) * (particle_diameter / diameter) ** 0.1
    flux = jnp.maximum(mass_flux, 1e-300) / (fluid_density * speed)
    return jnp.where(mass_flux > 0.0, speed * (flux**0.25 * shape) ** 0.8, 0.0)


class Choked(NamedTuple):
    """Gas velocity at choking, over the whole section, and the share of the pipe that is gas."""

    choking_velocity: Speed
    void_fraction: VoidFraction


def _choked(flux: Any, particle_density: Any, fall: Any, diameter: Any, factor: Any) -> Choked:
    """Where 2 g D (ε^−4.7 − 1)/(U/ε − v)² is a factor; U/ε − v is the velocity of the particles."""
    some = flux > 0.0
    flux = jnp.where(some, flux, 1.0)

    def apart(logarithm: Any, flux: Any, density: Any, diameter: Any, factor: Any) -> Any:
        solid = jnp.exp(logarithm)
        spread = jnp.expm1(-4.7 * jnp.log1p(-solid))
        return jnp.log(2.0 * STANDARD_GRAVITY * diameter * spread * (solid * density / flux) ** 2 / factor)

    root = find_root(apart, jnp.log(SHALLOW), jnp.log(DEEP), flux, particle_density, diameter, factor)
    unconverged(root.converged)
    solid = jnp.where(some, jnp.exp(root.value), SHALLOW)
    slip = jnp.where(some, flux / (particle_density * solid), 0.0)
    return Choked((1.0 - solid) * (fall + slip), 1.0 - solid)


@formula(
    source="punwani1976; rhodes2008, eq. 8.1–8.2",
    equation=(
        r"\rho_f^{0.77} = \frac{2250\,D\,(\varepsilon^{-4.7} - 1)}{(U_{ch}/\varepsilon - v_t)^2},\quad "
        r"\frac{U_{ch}}{\varepsilon} - v_t = \frac{G}{\rho_p(1 - \varepsilon)}"
    ),
    typical=_typical("mass_flux", "particle_density", "fluid_density", "terminal_velocity", "diameter"),
    title="Choking of a rising pipe (Punwani)",
)
def choking_punwani(
    mass_flux: MassFlux,
    particle_density: Density,
    fluid_density: Density,
    terminal_velocity: Speed,
    diameter: Length,
) -> Choked:
    """Gas velocity in a rising pipe below which the gas no longer carries the particles singly by Punwani and
    others; the mass flux is that of the solid.

    The constant is that of SI units.

    >>> 1.5 < choking_punwani(21.2, 2000.0, 1.2, 0.443, "50 mm").choking_velocity < 3.0
    True
    """
    factor = 2.0 * STANDARD_GRAVITY * fluid_density**0.77 / PUNWANI
    return _choked(mass_flux, particle_density, terminal_velocity, diameter, factor)


@formula(
    source="yang1975",
    equation=(
        r"\frac{2\,g\,D\,(\varepsilon^{-4.7} - 1)}{(U_{ch}/\varepsilon - v_t)^2} = 0.01,\quad "
        r"\frac{U_{ch}}{\varepsilon} - v_t = \frac{G}{\rho_p(1 - \varepsilon)}"
    ),
    typical=_typical("mass_flux", "particle_density", "terminal_velocity", "diameter"),
    title="Choking of a rising pipe (Yang)",
)
def choking_yang(
    mass_flux: MassFlux, particle_density: Density, terminal_velocity: Speed, diameter: Length
) -> Choked:
    """Gas velocity in a rising pipe below which the gas no longer carries the particles singly by Yang; the
    mass flux is that of the solid.

    For air near the atmosphere: there it is what Punwani's law says. Constant recalled, not opened.

    >>> 1.5 < choking_yang(21.2, 2000.0, 0.443, "50 mm").choking_velocity < 3.0
    True
    """
    return _choked(mass_flux, particle_density, terminal_velocity, diameter, YANG)


@formula(
    source="kalman2005",
    equation=(
        r"\frac{\rho_f U_{pu} d_p}{\eta\,(1.4 - 0.8\,e^{-D/(1.5\,D_{50})})} = \begin{cases} "
        r"21.8\,\mathrm{Ar}^{1/3} & \mathrm{Ar} < 0.45 \\ 16.7 & \mathrm{Ar} < 16.5 \\ "
        r"5\,\mathrm{Ar}^{3/7} & \mathrm{Ar} \ge 16.5\end{cases},\quad "
        r"\mathrm{Ar} = \frac{\rho_f(\rho_p - \rho_f)\,g\,d_p^3}{\eta^2},\ D_{50} = 50\ \mathrm{mm}"
    ),
    typical=_typical("particle_diameter", "particle_density", "fluid_density", "diameter")
    | {"dynamic_viscosity": (1.7e-5, 2.2e-5)},
)
def pickup_velocity_kalman(
    particle_diameter: Length,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    diameter: Length,
) -> Speed:
    """Gas velocity in a pipe that lifts particles from a layer at rest by Kalman and others: of single coarse
    particles, of fine ones that cling to each other, and of powders that move in lumps.

    Constants recalled, not opened; that the three zones meet speaks for them.

    >>> 5 < pickup_velocity_kalman("0.5 mm", 2600.0, 1.2, 1.8e-5, "50 mm") < 15
    True
    """
    ar = archimedes_number.function(particle_diameter, particle_density, fluid_density, dynamic_viscosity)
    low, high = ZONES
    ar = jnp.maximum(ar, 0.0)
    lumps = 21.8 * jnp.where(ar > 0.0, ar, 1.0) ** (1.0 / 3.0) * (ar > 0.0)
    coarse = 5.0 * jnp.where(ar > low, ar, 1.0) ** (3.0 / 7.0)
    reynolds = jnp.where(ar < low, lumps, jnp.where(ar < high, 16.7, coarse))
    pipe = 1.4 - 0.8 * jnp.exp(-diameter / (1.5 * 0.05))
    return reynolds * pipe * dynamic_viscosity / (fluid_density * particle_diameter)


@formula(
    source="rizk1973",
    equation=(
        r"D^{2.5} = \frac{4\,\dot m}{\pi\,\mu\,\rho_f\,\sqrt g}"
        r"\left(m^{1 + b}\,\mu\,10^{1440\,d_p + 1.96}\right)^{-1/b},\quad b = 1100\,d_p + 2.5"
    ),
    typical={
        "mass_flow": (0.1, 5.0),
        "solids_loading": (1.0, 10.0),
        "particle_diameter": (1e-4, 3e-3),
        "fluid_density": (1.0, 3.0),
        "velocity_margin": (1.2, 2.0),
    },
    output="diameter",
    title="Pipe of a pneumatic line for a duty (Rizk)",
)
def diameter_pneumatic(
    mass_flow: MassFlow,
    solids_loading: PositiveMassRatio,
    particle_diameter: Length,
    fluid_density: Density,
    velocity_margin: PositiveNumber = 1.5,
) -> Length:
    """Diameter of the level pipe in which a flow of solid, carried by so much gas, goes a margin faster than
    it settles out by Rizk.

    The gas is that at the place where the solid enters. The derivation is ours: Rizk's law at the margin,
    with the velocity that solid and loading give in that diameter.

    Checked by putting the diameter into Rizk's law:

    >>> section = 3.14159265358979 / 4 * diameter_pneumatic(0.25, 3.0, "100 um", 1.2) ** 2
    >>> settles = saltation_velocity_rizk(
    ...     0.25 / section, "100 um", 1.2, diameter_pneumatic(0.25, 3.0, "100 um", 1.2)
    ... )
    >>> round(0.25 / 3.0 / 1.2 / section / settles, 6)
    1.5
    """
    a, b = 1440.0 * particle_diameter + 1.96, 1100.0 * particle_diameter + 2.5
    lifted = (1.0 + b) * jnp.log(velocity_margin) + jnp.log(solids_loading) + a * jnp.log(10.0)
    flux = solids_loading * fluid_density * jnp.sqrt(STANDARD_GRAVITY) * jnp.exp(lifted / b)
    return (4.0 * mass_flow / (jnp.pi * flux)) ** 0.4
