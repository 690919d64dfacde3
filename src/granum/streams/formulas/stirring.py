"""Stirred vessels: power, shear and heat transfer of a stirrer, and rules that carry them to another size."""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import jax.numpy as jnp

from granum.core import formula, procedure, watch
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    Power,
    Ratio,
    RotationSpeed,
    Series,
    SpecificPower,
    ThermalConductivity,
    Velocity,
    Volume,
)
from granum.streams.formulas.drives import shaft_power_agitator

Impeller = Literal["pitched_blades", "disc_turbine", "paddle", "propeller"]


class Blades(NamedTuple):
    """Turbulent power number, Zwietering's constant (a third of the diameter of the vessel, a quarter of it
    above the bottom; recalled but for 5.8), factor of the Nusselt number at the wall.
    """

    power_number: float
    suspension_constant: float
    nusselt_factor: float


IMPELLERS = {
    "pitched_blades": Blades(1.37, 5.8, 0.53),
    "disc_turbine": Blades(5.0, 7.5, 0.54),
    "paddle": Blades(2.5, 8.0, 0.36),
    "propeller": Blades(0.35, 6.5, 0.54),
}
TURBULENT = 1e4


class Stirring(NamedTuple):
    """What a stirrer does to the contents of its vessel."""

    reynolds: Ratio
    power_number: Ratio
    shaft_power: Power
    specific_power_input: SpecificPower
    tip_speed: Velocity


@formula(
    source="mccabe2005, ch. 9; dickey2012, § 12.1",
    title="Power and shear of a stirrer",
    equation=(
        r"P = N_p\,\rho\left(\frac{\omega}{2\pi}\right)^3 D^5,\quad \varepsilon = \frac{P}{\rho V},\quad "
        r"u_t = \frac{\omega D}{2},\quad \mathrm{Re} = \frac{\rho\,\omega D^2}{2\pi\eta}"
    ),
    fitted={"reynolds": (TURBULENT, jnp.inf)},
    typical={
        "rotation_speed": (5.0, 20.0),
        "impeller_diameter": (0.3, 1.0),
        "volume": (1.0, 10.0),
        "dynamic_viscosity": (5e-4, 2e-3),
    },
)
def stirring(
    rotation_speed: RotationSpeed,
    impeller_diameter: Length,
    volume: Volume,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
    impeller: Impeller = "pitched_blades",
) -> Stirring:
    """Power number, power, tip speed and mean dissipation of a stirrer in a baffled vessel.

    Power numbers of turbulent flow: 1.37 for four pitched blades (Dickey), 5 for a disc turbine, 2.5 for a
    paddle, 0.35 for a propeller (McCabe; recalled, not opened); below a Reynolds number of 10 000 more.
    Dissipation near the blades is ten times the mean and more; attrition goes with the tip speed. The shear
    in the small eddies follows with ``crystallization.shear_rate_turbulent``.

    By hand: 1.4 rev/s, 1.473 m, 1150 kg/m³: 30.0 kW, in 10 m³ 2.6 W/kg.

    >>> made = stirring("84 rpm", 1.473, 10.0, 1150.0, 1e-3)
    >>> round(made.shaft_power / 1e3, 1), round(made.specific_power_input, 2), round(made.tip_speed, 2)
    (30.0, 2.61, 6.48)
    """
    turns = rotation_speed / (2.0 * jnp.pi)
    reynolds = density * turns * impeller_diameter**2 / dynamic_viscosity
    watch(reynolds=reynolds)
    number = IMPELLERS[impeller].power_number
    power = shaft_power_agitator(rotation_speed, impeller_diameter, density, number)
    return Stirring(
        reynolds,
        jnp.full_like(reynolds, number),
        power,
        power / (density * volume),
        0.5 * rotation_speed * impeller_diameter,
    )


@formula(
    source="kern1950, eq. 20.1; perry2008, § 11",
    title="Heat transfer coefficient at the wall of a stirred vessel",
    equation=(
        r"\frac{h D_v}{\lambda} = a\left(\frac{\rho\,\omega D^2}{2\pi\eta}\right)^{2/3}"
        r"\left(\frac{c_p\,\eta}{\lambda}\right)^{1/3}"
    ),
    fitted={"reynolds": (300.0, 3e5)},
    output="heat_transfer_coefficient",
    typical={
        "rotation_speed": (5.0, 20.0),
        "impeller_diameter": (0.1, 0.3),
        "vessel_diameter": (0.3, 0.9),
        "dynamic_viscosity": (1e-3, 5e-3),
    },
)
def heat_transfer_coefficient_stirred(
    rotation_speed: RotationSpeed,
    impeller_diameter: Length,
    vessel_diameter: Length,
    density: Density,
    dynamic_viscosity: DynamicViscosity,
    specific_heat_capacity: HeatCapacity,
    thermal_conductivity: ThermalConductivity,
    impeller: Impeller = "pitched_blades",
) -> HeatTransferCoefficient:
    """Heat transfer coefficient between the contents of a stirred vessel and its jacketed wall.

    a = 0.36 for a paddle (Kern), 0.54 for disc turbine and propeller, 0.53 for pitched blades (Perry;
    recalled, not opened). The factor (η/η_w)^0.14 is left out: the wall may be twice as viscous before it is
    worth a tenth. Suspended crystals change little below a fifth by volume.

    Kern, example 20.1: a paddle of 0.6 ft at 125 rev/min in a vessel of 1.01 ft, an aqueous liquor at 150 °F;
    588 Btu/(h ft² °F) read off the chart of the same equation, 3.34 kW/(m² K).

    >>> h = heat_transfer_coefficient_stirred(
    ...     "125 rpm", "0.6 ft", "1.01 ft", 1001.0, 4.38e-4, 4187.0, 0.6577, "paddle"
    ... )
    >>> round(h, -2)
    3200.0
    """
    turns = rotation_speed / (2.0 * jnp.pi)
    reynolds = density * turns * impeller_diameter**2 / dynamic_viscosity
    watch(reynolds=reynolds)
    prandtl = specific_heat_capacity * dynamic_viscosity / thermal_conductivity
    nusselt = IMPELLERS[impeller].nusselt_factor * jnp.cbrt(reynolds) ** 2 * jnp.cbrt(prandtl)
    return nusselt * thermal_conductivity / vessel_diameter


class Scaled(NamedTuple):
    """Rules of scale-up side by side."""

    scale_up_rule: Annotated[str, Series("rules")]
    rotation_speed_large: Annotated[RotationSpeed, Series("rules")]
    tip_speed_ratio: Annotated[Ratio, Series("rules")]
    specific_power_ratio: Annotated[Ratio, Series("rules")]
    suspension_ratio: Annotated[Ratio, Series("rules")]
    heat_transfer_ratio: Annotated[Ratio, Series("rules")]


SUSPENDED_EXPONENT = 0.85


@procedure(
    source="mccabe2005, ch. 9; dickey2012, § 12.9; zwietering1958",
    title="Scale-up of a stirrer",
    typical={
        "rotation_speed": (10.0, 60.0),
        "impeller_diameter": (0.05, 0.2),
        "impeller_diameter_large": (0.5, 2.0),
    },
)
def scale_up_stirrer(
    rotation_speed: RotationSpeed, impeller_diameter: Length, impeller_diameter_large: Length
) -> Scaled:
    """Speed of a vessel of the same shape and another size by each rule, and what the rule does to the rest.

    Large over small: tip speed (attrition), power per mass (mass transfer, mean dissipation), speed over the
    just suspended one (Zwietering), heat transfer coefficient at the wall. No rule keeps two of them; heat
    must pass through less wall per volume besides. For turbulent flow.

    Same power per mass, ten times the size: (1/10)^(2/3) of the speed, 2.15 times the tip speed.

    >>> rules = scale_up_stirrer("300 rpm", 0.1, 1.0)
    >>> [round(float(x), 2) for x in rules.tip_speed_ratio]
    [2.15, 1.0, 1.41, 3.16, 10.0, 0.1]
    """
    size = float(impeller_diameter_large) / float(impeller_diameter)
    rules = (
        (_("same power per mass"), 2.0 / 3.0),
        (_("same tip speed"), 1.0),
        (_("just suspended (Zwietering)"), SUSPENDED_EXPONENT),
        (_("same heat transfer coefficient at the wall"), 0.5),
        (_("same speed, same time of mixing"), 0.0),
        (_("same Reynolds number"), 2.0),
    )
    slower = jnp.asarray([size**-n for _rule, n in rules])
    columns: Any = (
        tuple(rule for rule, _n in rules),
        float(rotation_speed) * slower,
        slower * size,
        slower**3 * size**2,
        slower * size**SUSPENDED_EXPONENT,
        slower ** (2.0 / 3.0) * size ** (1.0 / 3.0),
    )
    return Scaled(*columns)
