"""Depth filtration: Iwasaki's law, deposit, head loss and run time; capture by a single collector."""

from __future__ import annotations

import jax.numpy as jnp

from granum.core import formula, watch
from granum.core.constants import BOLTZMANN, STANDARD_GRAVITY
from granum.core.kinds import (
    Concentration,
    Density,
    Distance,
    DynamicViscosity,
    Energy,
    Length,
    PositiveNumber,
    Ratio,
    SpecificSurface,
    Speed,
    Temperature,
    Time,
    VoidFraction,
)
from granum.filtration.kinds import HeadLossPerDeposit

_BED = {
    "bed_depth": (0.3, 1.5),
    "filter_coefficient": (1.0, 10.0),
    "concentration_inlet": (0.005, 0.1),
    "superficial_velocity": (1e-3, 5e-3),
    "time": (3600.0, 1e5),
}


@formula(
    source="iwasaki1937",
    equation=r"c = c_0\,e^{-\lambda L}",
    output="concentration",
    typical=_BED,
    symbols={"concentration_inlet": "c_0"},
)
def concentration_iwasaki(
    concentration_inlet: Concentration, filter_coefficient: SpecificSurface, bed_depth: Distance
) -> Concentration:
    """Concentration of suspended matter after a depth of clean filter bed.

    >>> round(concentration_iwasaki(concentration_inlet=0.02, filter_coefficient=3.0, bed_depth=1.0), 6)
    0.000996
    """
    return concentration_inlet * jnp.exp(-filter_coefficient * bed_depth)


@formula(
    source="iwasaki1937; ives1970",
    equation=r"\sigma = \lambda\,U\,c_0\,t\,e^{-\lambda L}",
    typical=_BED,
    output="specific_deposit",
    symbols={"concentration_inlet": "c_0"},
)
def specific_deposit_iwasaki(
    concentration_inlet: Concentration,
    filter_coefficient: SpecificSurface,
    bed_depth: Distance,
    superficial_velocity: Speed,
    time: Time,
) -> Concentration:
    """Mass retained per bed volume at a depth after a time, the filter coefficient taken as constant.

    >>> round(specific_deposit_iwasaki(0.02, 3.0, 0.0, 1e-3, 1e5), 6)
    6.0
    """
    return (
        filter_coefficient
        * superficial_velocity
        * concentration_inlet
        * time
        * jnp.exp(-filter_coefficient * bed_depth)
    )


@formula(
    source="ives1970",
    title="Head loss of a clogging deep bed",
    equation=r"H = H_0 + K\,U\,c_0\,t\,(1 - e^{-\lambda L})",
    typical=_BED,
    output="head_loss",
    symbols={"concentration_inlet": "c_0"},
)
def head_loss_deep_bed(
    head_loss_clean: Distance,
    head_loss_per_deposit: HeadLossPerDeposit,
    concentration_inlet: Concentration,
    filter_coefficient: SpecificSurface,
    bed_depth: Distance,
    superficial_velocity: Speed,
    time: Time,
) -> Distance:
    """Head loss of a deep bed after a time: that of the clean bed and what the deposit adds, in proportion.

    >>> round(head_loss_deep_bed(0.4, 0.5, 0.02, 50.0, 1.0, 1e-3, 1e5), 6)
    1.4
    """
    caught = superficial_velocity * concentration_inlet * time * -jnp.expm1(-filter_coefficient * bed_depth)
    return head_loss_clean + head_loss_per_deposit * caught


@formula(
    source="ives1970",
    title="Run time of a deep bed",
    equation=r"t = \frac{H_{max} - H_0}{K\,U\,c_0\,(1 - e^{-\lambda L})}",
    typical={**_BED, "head_loss_clean": (0.2, 0.5), "head_loss_allowed": (1.5, 3.0)},
    output="run_time",
    symbols={"concentration_inlet": "c_0"},
)
def run_time_deep_bed(
    head_loss_allowed: Distance,
    head_loss_clean: Distance,
    head_loss_per_deposit: HeadLossPerDeposit,
    concentration_inlet: Concentration,
    filter_coefficient: SpecificSurface,
    bed_depth: Distance,
    superficial_velocity: Speed,
) -> Time:
    """Run time of a deep bed until the head loss reaches what is available and the bed must be backwashed.

    >>> round(run_time_deep_bed(1.4, 0.4, 0.5, 0.02, 50.0, 1.0, 1e-3))
    100000
    """
    rate = (
        head_loss_per_deposit
        * superficial_velocity
        * concentration_inlet
        * -jnp.expm1(-filter_coefficient * bed_depth)
    )
    return jnp.maximum(head_loss_allowed - head_loss_clean, 0.0) / rate


@formula(
    source="yao1971",
    equation=r"\lambda = \frac{3\,(1-\varepsilon)\,\alpha\,\eta}{2\,d_c}",
    typical={"collector_efficiency": (1e-4, 1e-1)},
)
def filter_coefficient(
    collector_efficiency: Ratio,
    collector_diameter: Length,
    void_fraction: VoidFraction,
    attachment_efficiency: Ratio = 1.0,
) -> SpecificSurface:
    """Filter coefficient of a bed of grains from what one grain catches.

    >>> round(
    ...     filter_coefficient(collector_efficiency=0.004, collector_diameter="0.6 mm", void_fraction=0.4), 6
    ... )
    6.0
    """
    return 1.5 * (1.0 - void_fraction) * attachment_efficiency * collector_efficiency / collector_diameter


@formula(
    source="tufenkji2004",
    fitted={"particle_diameter": (1e-8, 1e-5)},
    equation=(
        r"\eta_0 = 2.4A_S^{1/3}N_R^{-0.081}N_{Pe}^{-0.715}N_{vdW}^{0.052} + 0.55A_S "
        r"N_R^{1.675}N_A^{0.125} + 0.22N_R^{-0.24}N_G^{1.11}N_{vdW}^{0.053},\quad A_S = "
        r"\frac{2(1-\gamma^5)}{2 - 3\gamma + 3\gamma^5 - 2\gamma^6},\ \gamma = "
        r"(1-\varepsilon)^{1/3},\quad N_R = \frac{d_p}{d_c},\ N_{Pe} = \frac{3\pi\eta\,d_p d_c U}{kT},\ "
        r"N_{vdW} = \frac{A_H}{kT},\ N_A = \frac{A_H}{3\pi\eta\,d_p^2 U},\ N_G = "
        r"\frac{d_p^2(\rho_p-\rho_f)g}{18\,\eta\,U}"
    ),
    output="collector_efficiency",
    typical={
        "particle_diameter": (1e-7, 5e-6),
        "collector_diameter": (2e-4, 1e-3),
        "superficial_velocity": (1e-4, 3e-3),
        "particle_density": (1030.0, 2600.0),
        "fluid_density": (990.0, 1000.0),
        "void_fraction": (0.35, 0.45),
        "temperature": (280.0, 310.0),
        "hamaker_constant": (3e-21, 3e-20),
    },
    symbols={"collector_efficiency": r"\eta_0", "hamaker_constant": "A_H"},
)
def collector_efficiency_tufenkji(
    particle_diameter: Length,
    collector_diameter: Length,
    superficial_velocity: Speed,
    void_fraction: VoidFraction,
    particle_density: Density,
    fluid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    temperature: Temperature = 293.15,
    hamaker_constant: Energy = 1e-20,
) -> PositiveNumber:
    """Single-collector contact efficiency in a granular bed: diffusion, interception and gravity with van der
    Waals attraction.

    A buoyant particle gets no gravity term.

    Trajectories were computed for particles of 0.01 to 10 µm.

    >>> round(collector_efficiency_tufenkji("1 um", "0.6 mm", "2 mm/s", 0.4, 1050, 998, 1e-3), 5)
    0.00053
    """
    dp, dc, U, mu = particle_diameter, collector_diameter, superficial_velocity, dynamic_viscosity
    g = (1.0 - void_fraction) ** (1.0 / 3.0)
    A_s = 2.0 * (1.0 - g**5) / (2.0 - 3.0 * g + 3.0 * g**5 - 2.0 * g**6)
    kT = BOLTZMANN * temperature
    N_R, N_vdW = dp / dc, hamaker_constant / kT
    N_Pe = U * dc * 3.0 * jnp.pi * mu * dp / kT
    N_A = hamaker_constant / (3.0 * jnp.pi * mu * dp**2 * U)
    N_G = (dp**2 / 18.0) * jnp.maximum(particle_density - fluid_density, 1e-9) * STANDARD_GRAVITY / (mu * U)
    diffusion = 2.4 * A_s ** (1 / 3) * N_R**-0.081 * N_Pe**-0.715 * N_vdW**0.052
    return diffusion + 0.55 * A_s * N_R**1.675 * N_A**0.125 + 0.22 * N_R**-0.24 * N_G**1.11 * N_vdW**0.053


@formula(
    source="carman1938; carman1937",
    title="Head loss of the clean bed",
    fitted={"reynolds_bed": (0.0, 10.0)},
    equation=(
        r"\frac{H}{L} = \frac{36\,h_K\,\eta\,U\,(1-\varepsilon)^2}{\rho_l\,g\,\psi^2 "
        r"d_c^2\,\varepsilon^3}"
    ),
    output="head_loss",
    typical={
        "bed_depth": (0.3, 1.5),
        "collector_diameter": (4e-4, 1e-3),
        "superficial_velocity": (1e-3, 4e-3),
        "void_fraction": (0.36, 0.45),
    },
)
def head_loss_clean_bed(
    bed_depth: Distance,
    collector_diameter: Length,
    superficial_velocity: Speed,
    void_fraction: VoidFraction,
    dynamic_viscosity: DynamicViscosity,
    liquid_density: Density,
    kozeny_coefficient: PositiveNumber = 5.0,
) -> Distance:
    """Head loss of a clean bed of sand in laminar flow; the diameter is the surface–volume one.

    Laminar up to a Reynolds number of the bed of 10, as for ``pressure_gradient_kozeny_carman``.

    >>> round(head_loss_clean_bed(1.0, "0.6 mm", "2 mm/s", 0.4, 1e-3, 1000), 3)
    0.574
    """
    e = void_fraction
    watch(
        reynolds_bed=liquid_density
        * superficial_velocity
        * collector_diameter
        / (dynamic_viscosity * (1.0 - e))
    )
    return (
        36.0
        * kozeny_coefficient
        * dynamic_viscosity
        * superficial_velocity
        * (1.0 - e) ** 2
        * bed_depth
        / (liquid_density * STANDARD_GRAVITY * collector_diameter**2 * e**3)
    )
