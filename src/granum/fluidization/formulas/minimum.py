"""Minimum fluidization velocity: laws of two constants, Re = (a² + b Ar)^½ − a.

The family ``minimum_fluidization_velocity`` is called with the diameter of the sphere of equal volume,
density of the particle, density and viscosity of the fluid. Particles not denser than the fluid cannot be
fluidized upwards: no value.
"""

from __future__ import annotations

from granum.core import formula, watch
from granum.core.constants import STANDARD_GRAVITY
from granum.core.formulas import Formula
from granum.core.kinds import Acceleration, Density, DynamicViscosity, Length, Speed
from granum.fluidization.formulas.buoyancy import TYPICAL, archimedes, larger_root
from granum.particles.definitions import ARCHIMEDES, velocity_of


def _two_constants(
    author: str,
    first: float,
    second: float,
    source: str,
    reynolds: tuple[float, float],
    summary: str,
    remark: str = "",
) -> Formula:
    """One law of the form; each author differs by two numbers and a range."""

    def law(
        particle_diameter: Length,
        particle_density: Density,
        fluid_density: Density,
        dynamic_viscosity: DynamicViscosity,
        gravity: Acceleration = STANDARD_GRAVITY,
    ) -> Speed:
        d, rho, eta = particle_diameter, fluid_density, dynamic_viscosity
        Re = larger_root(first, second * archimedes(d, particle_density, rho, eta, gravity))
        watch(reynolds=Re)
        return Re * eta / (rho * d)

    name = law.__name__ = law.__qualname__ = f"minimum_fluidization_velocity_{author}"
    small = second / (2.0 * first)  # slope of the viscous limit
    ordinary = (first**2 + second * 11798.9) ** 0.5 - first  # Ar of 0.5 mm sand in air: 11 798.9
    law.__doc__ = f"""{summary}

    {remark}Sand of 0.5 mm in air has an Archimedes number of 11 800:

    >>> u = {name}(particle_diameter="0.5 mm", particle_density=2600, fluid_density=1.2, dynamic_viscosity=1.8e-5)
    >>> round(u * 1.2 * 0.5e-3 / 1.8e-5, 2) == {ordinary:.2f}
    True

    Fine particles tend to {small:.3g} d² g Δρ/η:

    >>> u = {name}(particle_diameter=1e-6, particle_density=2001.2, fluid_density=1.2, dynamic_viscosity=1.8e-5, gravity=10.0)
    >>> round(u / (1e-12 * 10.0 * 2000.0 / 1.8e-5), 6) == {small:.6f}
    True
    """  # noqa: E501
    equation = rf"\mathrm{{Re}}_{{mf}} = \sqrt{{{first}^2 + {second}\,\mathrm{{Ar}}}} - {first}"
    equation += velocity_of("U_{mf}", "mf") + ARCHIMEDES
    return formula(source=source, equation=equation, fitted={"reynolds": reynolds}, typical=TYPICAL)(law)


minimum_fluidization_velocity_wen_yu = _two_constants(
    "wen_yu",
    33.7,
    0.0408,
    "wen1966",
    (0.001, 4000.0),
    "Minimum fluidization velocity by Wen and Yu, for gases and liquids.",
    (
        "284 points, standard deviation 34 %. Their constants stand for 1/(ψ ε³) = 14 and (1 - ε)/(ψ² ε³) = "
        "11 in Ergun's equation. "
    ),
)
minimum_fluidization_velocity_grace = _two_constants(
    "grace",
    27.2,
    0.0408,
    "grace1982",
    (0.001, 1000.0),
    "Minimum fluidization velocity by Grace, for gases.",
    "Wen and Yu's form with the first constant moved for fine particles. ",
)
minimum_fluidization_velocity_chitester = _two_constants(
    "chitester",
    28.7,
    0.0494,
    "chitester1984",
    (0.001, 1000.0),
    "Minimum fluidization velocity by Chitester and others, for coarse particles and gases up to 64 bar.",
)
minimum_fluidization_velocity_thonglimp = _two_constants(
    "thonglimp",
    31.6,
    0.0425,
    "thonglimp1984; couderc1985",
    (0.05, 1000.0),
    "Minimum fluidization velocity by Thonglimp and others, for gases.",
    "The constants commonly printed for the second correlation of the same laboratory are 19.9 and 0.03196. ",
)
minimum_fluidization_velocity_thonglimp_fine = _two_constants(
    "thonglimp_fine",
    19.9,
    0.03196,
    "thonglimp1984",
    (0.05, 1000.0),
    "Minimum fluidization velocity by Thonglimp, Hiquily and Laguerie with the constants 19.9 and 0.03196.",
    "The same laboratory also printed 31.6 and 0.0425. ",
)
minimum_fluidization_velocity_richardson = _two_constants(
    "richardson",
    25.7,
    0.0365,
    "richardson1971",
    (0.001, 1000.0),
    "Minimum fluidization velocity by Richardson, for gases and liquids.",
)
minimum_fluidization_velocity_bourgeois_grenier = _two_constants(
    "bourgeois_grenier",
    25.46,
    0.0382,
    "bourgeois1968",
    (0.001, 1000.0),
    "Minimum fluidization velocity by Bourgeois and Grenier, for spheres in gases and liquids.",
)
minimum_fluidization_velocity_saxena_vogel = _two_constants(
    "saxena_vogel",
    25.28,
    0.0571,
    "saxena1977; kunii1991, ch. 3, table 4",
    (6.0, 102.0),
    "Minimum fluidization velocity by Saxena and Vogel, from dolomite at high temperature and pressure.",
    "Runs higher than the others for coarse particles. ",
)
minimum_fluidization_velocity_babu = _two_constants(
    "babu",
    25.25,
    0.0651,
    "babu1978; kunii1991, ch. 3, table 4",
    (0.05, 400.0),
    (
        "Minimum fluidization velocity by Babu, Shah and Talwalkar, from all data known in 1978 on coal and "
        "its kin."
    ),
    "Runs higher than the others for coarse particles. ",
)
