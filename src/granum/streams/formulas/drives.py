"""Shaft power of fans, pumps, compressors, vacuum pumps and stirrers."""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import HOUR, STANDARD_ATMOSPHERE, STANDARD_GRAVITY
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Length,
    MassFlow,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Pressure,
    PressureDifference,
    RotationSpeed,
    Volume,
    VolumeFlow,
    Within,
)

Efficiency = Annotated[PositiveNumber, Within(0.01, 1.0)]
HeatCapacityRatio = Annotated[PositiveNumber, Within(1.01, 1.7)]
_DRAWN = {"pressure_inlet": (2e4, 1.0e5), "pressure_outlet": (1.01e5, 3e5), "machine_efficiency": (0.4, 0.8)}
TORR = 133.322368
LEAKS = ((1.0, 0.124), (3.0, 0.248), (20.0, 0.403), (90.0, 0.713))  # below so many torr, kg/h and m³
LEAKS_MOST = 0.947
EXPANDS = "What leaves a compressor has at least the pressure of what enters."


@formula(
    source="mccabe2005, ch. 8; turton2018, ch. 11",
    equation=r"P = \frac{Q\,\Delta p}{\eta}",
    typical={"pressure_rise": (1e3, 5e5), "machine_efficiency": (0.5, 0.8)},
    title="Shaft power of a pump or fan",
)
def shaft_power_incompressible(
    volume_flow: VolumeFlow, pressure_rise: PressureDifference, machine_efficiency: Efficiency = 0.7
) -> Power:
    """Power to raise the pressure of a liquid, or of a gas by so little that its density stays.

    A fan counts as one up to some 10 kPa: at 3 kPa the error is 1 % of the work.

    By hand: 1 m³/s through 2 kPa at 65 %.

    >>> round(shaft_power_incompressible(1.0, "2 kPa", 0.65))
    3077
    """
    return volume_flow * pressure_rise / machine_efficiency


def _check(pressure_inlet: Any, pressure_outlet: Any) -> None:
    impossible(
        jnp.asarray(pressure_outlet) < jnp.asarray(pressure_inlet),
        pressure_outlet,
        "pressure_outlet",
        pressure_inlet,
        jnp.inf,
        EXPANDS,
    )


@formula(
    source="mccabe2005, ch. 8; turton2018, ch. 11",
    equation=r"P = \frac{p_1Q}{\eta}\,\ln\frac{p_2}{p_1}",
    typical=_DRAWN,
    title="Shaft power of an isothermal compressor or vacuum pump",
)
def shaft_power_isothermal(
    volume_flow: VolumeFlow,
    pressure_inlet: Pressure,
    pressure_outlet: Pressure,
    machine_efficiency: Efficiency = 0.5,
) -> Power:
    """Power to compress an ideal gas at constant temperature, as a liquid-ring pump nearly does; the volume
    is that at the inlet.

    By hand: 100 m³/h out of 0.4 bar into 1 bar at 50 %, 40 kPa · 0.02778 m³/s · ln 2.5 / 0.5.

    >>> round(shaft_power_isothermal("100 m^3/hour", "0.4 bar", "1 bar", 0.5))
    2036
    """
    _check(pressure_inlet, pressure_outlet)
    return (
        pressure_inlet * volume_flow / machine_efficiency * jnp.log(_ratio(pressure_inlet, pressure_outlet))
    )


@formula(
    source="mccabe2005, ch. 8",
    equation=(
        r"P = \frac{p_1Q}{\eta}\,\frac{\gamma}{\gamma - 1}\left[\left(\frac{p_2}{p_1}\right)^{(\gamma"
        r" - 1)/\gamma} - 1\right]"
    ),
    typical=_DRAWN | {"heat_capacity_ratio": (1.1, 1.4)},
    title="Shaft power of an adiabatic compressor",
)
def shaft_power_adiabatic(
    volume_flow: VolumeFlow,
    pressure_inlet: Pressure,
    pressure_outlet: Pressure,
    machine_efficiency: Efficiency = 0.75,
    heat_capacity_ratio: HeatCapacityRatio = 1.4,
) -> Power:
    """Power to compress an ideal gas in one stage without cooling; the volume is that at the inlet.

    By hand: 1 m³/s of air at 1 bar doubled without loss, 350 kPa · (2^0.2857 − 1).

    >>> round(shaft_power_adiabatic(1.0, "1 bar", "2 bar", 1.0) / 1e3, 1)
    76.7
    """
    _check(pressure_inlet, pressure_outlet)
    a = (heat_capacity_ratio - 1.0) / heat_capacity_ratio
    work = jnp.expm1(a * jnp.log(_ratio(pressure_inlet, pressure_outlet))) / a
    return pressure_inlet * volume_flow / machine_efficiency * work


def _ratio(low: Any, high: Any) -> Any:
    low, high = jnp.asarray(low), jnp.asarray(high)
    return jnp.where(low > 0, high, 1.0) / jnp.where(low > 0, low, 1.0)


@formula(
    source="mccabe2005, ch. 9",
    equation=r"P = N_p\,\rho\left(\frac{\omega}{2\pi}\right)^3 D^5",
    typical={"power_number": (0.3, 6.0), "rotation_speed": (3.0, 30.0), "impeller_diameter": (0.2, 2.0)},
    title="Shaft power of a stirrer",
)
def shaft_power_agitator(
    rotation_speed: RotationSpeed, impeller_diameter: Length, density: Density, power_number: PositiveNumber
) -> Power:
    """Power of a stirrer in turbulent flow with baffles: about 5 for a disc turbine, 1.3 for pitched blades,
    0.3 for a propeller.

    By hand: 84 rev/min, 1.473 m, 1150 kg/m³ and 1.37 are 1.4³ · 1.473⁵ · 1150 · 1.37.

    >>> round(shaft_power_agitator("84 rpm", 1.473, 1150.0, 1.37) / 1e3, 1)
    30.0
    """
    return power_number * density * (rotation_speed / (2.0 * jnp.pi)) ** 3 * impeller_diameter**5


@formula(
    source="zwietering1958; mccabe2005, ch. 9",
    equation=(
        r"\frac{\omega}{2\pi} = S\left(\frac{\eta}{\rho_l}\right)^{0.1} d_p^{0.2} "
        r"\left(\frac{g\,|\rho_p - \rho_l|}{\rho_l}\right)^{0.45} "
        r"\left(\frac{100}{X}\right)^{0.13} D^{-0.85}"
    ),
    typical={
        "impeller_diameter": (0.2, 2.0),
        "moisture_dry_basis": (2.0, 50.0),
        "suspension_constant": (3.0, 8.0),
    },
    output="rotation_speed",
    title="Speed at which a stirrer just suspends all solid (Zwietering)",
)
def rotation_speed_zwietering(
    impeller_diameter: Length,
    particle_diameter: Length,
    particle_density: Density,
    liquid_density: Density,
    dynamic_viscosity: DynamicViscosity,
    moisture_dry_basis: MoistureDryBasis,
    suspension_constant: PositiveNumber = 5.8,
) -> RotationSpeed:
    """Lowest speed of a stirrer at which no particle rests on the bottom for longer than a second or two.

    B is 100 kg of solid per kg of liquid. The constant 5.8 is that of pitched blades of a third of the
    diameter of the vessel, a quarter of it above the bottom. Solid as light as the liquid needs no speed.

    By hand: 0.15 mm sand of 2650 kg/m³ in water, 1 kg in 10 kg of water, 0.5 m blades: 2.13 rev/s.

    >>> round(rotation_speed_zwietering(0.5, "0.15 mm", 2650.0, 1000.0, 1e-3, 10.0) / (2 * 3.14159265), 2)
    2.13
    """
    apart = jnp.maximum(jnp.abs(particle_density - liquid_density) / liquid_density, 1e-12)
    solid = 100.0 / jnp.maximum(moisture_dry_basis, 1e-12)
    speed = (
        suspension_constant
        * (dynamic_viscosity / liquid_density) ** 0.1
        * particle_diameter**0.2
        * (STANDARD_GRAVITY * apart) ** 0.45
        * solid**0.13
        / impeller_diameter**0.85
    )
    return 2.0 * jnp.pi * speed


@formula(
    source="hei2000",
    equation=(
        r"\dot m = k\,V^{2/3},\quad k = \begin{cases}0.124 & p < 1\ \mathrm{torr} \\ 0.248 & p < 3 \\ "
        r"0.403 & p < 20 \\ 0.713 & p < 90 \\ 0.947 & p \ge 90\end{cases}\quad"
        r"\left(\mathrm{kg/h},\ \mathrm{m^3}\right)"
    ),
    typical={"volume": (1.0, 100.0), "pressure": (500.0, 5e4)},
    title="Air that leaks into a vacuum (Heat Exchange Institute)",
)
def mass_flow_leakage_hei(volume: Volume, pressure: Pressure) -> MassFlow:
    """Air that leaks into a plant under vacuum that is tight as bought, by its volume; nothing from the
    pressure of the atmosphere on.

    The steps of the chart, as a public sheet that was read prints them. Seals of turning shafts come on top.

    By hand: 0.403 kg/h times 4 for 8 m³ at 1 kPa, which is 7.5 torr.

    >>> round(mass_flow_leakage_hei("8 m3", "1 kPa") * 3600, 3)
    1.612
    """
    torr = jnp.asarray(pressure) / TORR
    per = jnp.select([torr < step for step, _k in LEAKS], [k for _step, k in LEAKS], LEAKS_MOST)
    return jnp.where(pressure < STANDARD_ATMOSPHERE, per * volume ** (2.0 / 3.0), 0.0) / HOUR
