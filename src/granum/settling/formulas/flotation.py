"""Flotation by dissolved air: what water holds and lets go, and bubbles that meet flocs."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula
from granum.core.constants import BOLTZMANN, STANDARD_ATMOSPHERE, STANDARD_GRAVITY
from granum.core.kinds import (
    Concentration,
    Density,
    Fraction,
    Length,
    PositiveNumber,
    Pressure,
    Ratio,
    Speed,
    Temperature,
    Time,
    VolumeFraction,
    Within,
)

REFERENCE = 298.15
# share in dry air, kg/mol, mol/(m³ Pa) at 25 °C, K: Sander's recommended values, recalled, not opened
GASES = (
    (0.2095, 0.031998, 1.2e-5, 1700.0),
    (0.7808, 0.028014, 6.4e-6, 1300.0),
    (0.0093, 0.039948, 1.4e-5, 1500.0),
)
_BUBBLES = {
    "bubble_diameter": (4e-5, 8e-5),
    "particle_diameter": (1e-5, 1e-4),
    "particle_density": (1002.0, 1100.0),
    "fluid_density": (995.0, 1000.0),
    "temperature": (278.0, 303.0),
}


@formula(
    source="sander2015; metcalf2003, § 5-8",
    equation=r"C = p\,\sum_j y_j\,M_j\,H_j\,\exp\left[a_j\left(\frac{1}{T} - \frac{1}{298.15}\right)\right]",
    title="Solubility of air in water",
    typical={"pressure": (1e5, 7e5), "temperature": (278.0, 303.0)},
)
def air_solubility(
    temperature: Temperature = 293.15, pressure: Pressure = STANDARD_ATMOSPHERE
) -> Concentration:
    """Air that water holds in equilibrium with air at a pressure, by Henry's law for oxygen, nitrogen and
    argon.

    In a saturator that is not vented nitrogen gathers in the gas and the water holds up to a tenth less.
    Constants recalled, not opened. Metcalf and Eddy have 18.7 mL/L at 20 °C (recalled), which are 22.5 to
    24.3 g/m³ by the density that is taken.

    >>> round(1e3 * air_solubility("20 degC"), 1)
    24.8
    """
    inverse = 1.0 / jnp.asarray(temperature) - 1.0 / REFERENCE
    return pressure * sum(y * M * H * jnp.exp(a * inverse) for y, M, H, a in GASES)


@formula(
    source="edzwald2010; metcalf2003, § 5-8",
    equation=r"C_b = \frac{r}{1 + r}\left[f\,C(p_s) - C(p_0)\right]",
    typical={
        "pressure_saturator": (4e5, 7e5),
        "recycle_ratio": (0.05, 0.5),
        "saturator_efficiency": (0.5, 0.95),
    },
    symbols={"pressure_saturator": "p_s"},
    title="Air set free in a flotation tank",
)
def air_released(
    pressure_saturator: Pressure,
    recycle_ratio: Ratio,
    saturator_efficiency: Fraction = 0.8,
    temperature: Temperature = 293.15,
) -> Concentration:
    """Air that comes out as bubbles, per volume of feed and recycle, when water from a saturator is let down
    to the atmosphere; the feed is taken as saturated with air itself.

    By hand at 20 °C: a tenth of recycle from 5 atm at 80 % lets go 24.8 · (4 − 1)/11.

    >>> round(1e3 * air_released("5 atm", recycle_ratio=0.1), 1)
    6.8
    """
    open_ = air_solubility(temperature, STANDARD_ATMOSPHERE)
    held = saturator_efficiency * air_solubility(temperature, pressure_saturator)
    return jnp.maximum(held - open_, 0.0) * recycle_ratio / (1.0 + recycle_ratio)


@formula(
    source="metcalf2003, § 5-8",
    equation=r"\frac{A}{S} = \frac{C_b\,(1 + r)}{C}",
    typical={"air_released": (1e-3, 2e-2), "solids_concentration": (0.2, 5.0), "recycle_ratio": (0.05, 1.5)},
)
def air_to_solids_ratio(
    air_released: Concentration,
    recycle_ratio: Ratio,
    solids_concentration: Annotated[Concentration, Within(1e-6)],
) -> Ratio:
    """Air set free per solids of the feed, by mass.

    By hand: 6.6 g/m³ of 1.1 volumes for 300 g/m³.

    >>> round(air_to_solids_ratio("6.6 g/m^3", recycle_ratio=0.1, solids_concentration="300 g/m^3"), 4)
    0.0242
    """
    return air_released * (1.0 + recycle_ratio) / solids_concentration


@formula(
    source="edzwald2010, eq. 5 to 8",
    equation=(
        r"\eta = 6.18\left(\frac{k_BT}{g\,\rho_f}\right)^{2/3}d_p^{-2/3}d_b^{-2} + x^2 - \frac{3x}{2} + "
        r"\frac{1}{2x} + \frac{\rho_p - \rho_f}{\rho_f}\left(\frac{d_p}{d_b}\right)^2,\qquad "
        r"x = 1 + \frac{d_p}{d_b}"
    ),
    title="Collision efficiency of a bubble",
    output="collector_efficiency",
    typical=_BUBBLES,
)
def collector_efficiency_bubble(
    particle_diameter: Length,
    bubble_diameter: Length,
    particle_density: Density,
    fluid_density: Density = 998.0,
    temperature: Temperature = 293.15,
) -> PositiveNumber:
    """Particles that meet a rising bubble over those that lie in its path: by diffusion, interception and
    settling.

    Written for bubbles that are not much smaller than the flocs; a floc larger than the bubble meets it for
    certain. By hand, 30 µm flocs of 1010 kg/m³ before 60 µm: 2.25 − 2.25 + 1/3 + 0.003.

    >>> round(collector_efficiency_bubble("30 um", "60 um", 1010.0), 3)
    0.336
    """
    d, db, rho = particle_diameter, bubble_diameter, fluid_density
    by_diffusion = 6.18 * (BOLTZMANN * temperature / (STANDARD_GRAVITY * rho)) ** (2.0 / 3.0)
    by_diffusion = by_diffusion * d ** (-2.0 / 3.0) / db**2
    x = 1.0 + d / db
    return (
        by_diffusion
        + x**2
        - 1.5 * x
        + 0.5 / x
        + jnp.maximum(particle_density - rho, 0.0) / rho * (d / db) ** 2
    )


@formula(
    source="edzwald2010, eq. 4",
    equation=r"E = 1 - \exp\left(-\frac{3\,\alpha\,\eta\,\varphi_b\,u_b\,t_R}{2\,d_b}\right)",
    title="Share of particles that meet a bubble",
    output="removal_efficiency",
    typical={
        "collector_efficiency": (0.01, 1.0),
        "attachment_efficiency": (0.1, 1.0),
        "bubble_volume_fraction": (2e-3, 1e-2),
        "bubble_rise_velocity": (1e-3, 3e-3),
        "contact_time": (60.0, 180.0),
        "bubble_diameter": (4e-5, 8e-5),
    },
)
def removal_efficiency_contact(
    collector_efficiency: PositiveNumber,
    attachment_efficiency: Fraction,
    bubble_volume_fraction: VolumeFraction,
    bubble_rise_velocity: Speed,
    contact_time: Time,
    bubble_diameter: Length,
) -> Fraction:
    """Share of particles to which a bubble has stuck after the contact zone of a flotation tank, in plug flow
    through white water.

    By hand: half of the collisions of efficiency 0.1 stick, 5 per mille of bubbles of 60 µm that rise 2 mm/s,
    90 s: 1 − exp(−1.125).

    >>> round(removal_efficiency_contact(0.1, 0.5, 0.005, "2 mm/s", 90.0, "60 um"), 3)
    0.675
    """
    load = 1.5 * attachment_efficiency * collector_efficiency * bubble_volume_fraction / bubble_diameter
    return -jnp.expm1(-load * bubble_rise_velocity * contact_time)
