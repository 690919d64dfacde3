"""Scrubbers: drops, impaction, collection in venturis, spray towers and packings, pressure drop."""

from __future__ import annotations

from typing import Annotated

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    Fraction,
    Length,
    PositiveNumber,
    PressureDrop,
    Ratio,
    SpecificSurface,
    Speed,
    VoidFraction,
    Within,
)

FOOT, GALLON = 0.3048, 3.785411784e-3  # m, m³
HORSEPOWER = 745.6998715822702 / (1e3 * FOOT**3 / 60.0)  # J/m³, of 1 hp per 1000 ft³/min
PER_THOUSAND = GALLON / (1e3 * FOOT**3)  # of 1 gal per 1000 ft³, as a ratio of volumes
LiquidToGas = Annotated[Ratio, Within(0.0, 0.1)]
NO_RAIN = "The drops must fall faster than the gas rises, which else takes them along: take larger ones."
NO_ROOM = "The liquid must leave room for the gas in the packing."
_TYPICAL = {"throat_velocity": (40.0, 120.0), "liquid_to_gas": (5e-4, 2e-3)}


@formula(
    source="nukiyama1939; theodore2012, p. 15.7",
    equation=r"d = \frac{16\,400}{v} + 1.45\left(\frac{Q_l}{Q_g}\right)^{1.5}",
    fitted={"throat_velocity": (30.0, 150.0), "liquid_to_gas": (2e-4, 3e-3)},
    typical=_TYPICAL,
    output="droplet_diameter",
    title="Drops of water in the throat of a venturi",
)
def droplet_diameter_venturi(throat_velocity: Speed, liquid_to_gas: LiquidToGas) -> Length:
    """Sauter diameter of drops of water torn off by air, in the print's µm, ft/s and gal per 1000 ft³.

    The handbook's example: 272 ft/s and 8.5 gal per 1000 ft³ give 96.23 µm.

    >>> round(droplet_diameter_venturi("272 ft/s", 8.5 * 1.336806e-4) * 1e6, 1)
    96.2
    """
    v, q = throat_velocity / FOOT, liquid_to_gas / PER_THOUSAND
    return 1e-6 * (16400.0 / v + 1.45 * q**1.5)


@formula(
    source="johnstone1954; theodore2012, p. 15.7",
    equation=r"\psi = \frac{C_c\,\rho_p\,d_p^2\,v}{9\,\eta\,d_c}",
    typical={"gas_velocity": (1.0, 120.0), "obstacle_diameter": (3e-5, 2e-3), "slip_factor": (1.0, 3.0)},
    title="Inertial impaction number",
    symbols={"gas_velocity": "v"},
)
def impaction_number(
    particle_diameter: Length,
    particle_density: Density,
    gas_velocity: Speed,
    dynamic_viscosity: DynamicViscosity,
    obstacle_diameter: Length,
    slip_factor: Annotated[PositiveNumber, Within(1.0, 1e4)] = 1.0,
) -> Ratio:
    """Stopping distance of a particle over the radius of the drop, wire or packing that catches it.

    The velocity is that of the gas past the body, the viscosity that of the gas.

    The handbook's example: 3.002 at 1 µm, with 43.7 lb/ft³, 272 ft/s, 1.5e-5 lb/(ft s) and 96.23 µm.

    >>> round(impaction_number("1 um", 43.7 * 16.01846, "272 ft/s", 1.5e-5 * 1.488164, "96.3168 um"), 2)
    3.0
    """
    return (
        slip_factor
        * particle_density
        * particle_diameter**2
        * gas_velocity
        / (9.0 * dynamic_viscosity * obstacle_diameter)
    )


@formula(
    source="johnstone1954; theodore2012, p. 15.7",
    equation=r"E = 1 - \exp\left(-k\,\frac{Q_l}{Q_g}\,\sqrt\psi\right)",
    fitted={"johnstone_constant": (740.0, 1500.0)},
    typical=_TYPICAL | {"impaction_number": (0.5, 100.0), "johnstone_constant": (800.0, 1450.0)},
    output="grade_efficiency",
    title="Grade efficiency of a venturi scrubber (Johnstone)",
)
def grade_efficiency_johnstone(
    impaction_number: Ratio, liquid_to_gas: LiquidToGas, johnstone_constant: PositiveNumber = 1500.0
) -> Fraction:
    """Share of a particle size caught by the drops.

    The constant is 0.1 to 0.2 (1000 ft³/gal) for a throat, half as much to as much as the default by volume.

    The handbook's example: 8.5 gal per 1000 ft³ with 0.2 at an impaction number of 3.002 leave exp(−2.94).

    >>> round(grade_efficiency_johnstone(3.002, 8.5 * 1.336806e-4, 0.2 / 1.336806e-4), 3)
    0.947
    """
    return -jnp.expm1(-johnstone_constant * liquid_to_gas * jnp.sqrt(jnp.maximum(impaction_number, 1e-300)))


@formula(
    source="calvert1970",
    equation=r"\Delta p = \beta\,\rho_l\,v^2\,\frac{Q_l}{Q_g}",
    typical=_TYPICAL | {"momentum_share": (0.8, 1.0)},
    output="pressure_drop",
    title="Pressure drop of a venturi scrubber (Calvert)",
)
def pressure_drop_venturi(
    throat_velocity: Speed,
    liquid_to_gas: LiquidToGas,
    liquid_density: Density,
    momentum_share: Annotated[PositiveNumber, Within(0.01, 2.0)] = 1.0,
) -> PressureDrop:
    """Pressure that the gas spends on bringing the drops to its own speed; the share is of that speed reached
    in the throat.

    Calvert's simplified form, 1e-6 v² L in cm of water with cm/s and L/m³, prints 187.2 for 120 m/s and 1.3
    L/m³; all of the momentum is 190.9.

    >>> round(pressure_drop_venturi("120 m/s", 1.3e-3, 1000.0) / 98.0665, 1)
    190.9
    """
    return momentum_share * liquid_density * throat_velocity**2 * liquid_to_gas


@formula(
    source="calvert1972",
    equation=r"\eta_d = \left(\frac{\psi}{\psi + 0.7}\right)^2",
    typical={"impaction_number": (0.05, 100.0)},
    output="target_efficiency",
    title="Share that one drop catches on its way (Calvert)",
    symbols={"target_efficiency": r"\eta_d"},
)
def target_efficiency_drop(impaction_number: Ratio) -> Fraction:
    """Share of the particles in the path of a drop that hit it, by inertia.

    The scrubber handbook was not opened; the relation is as widely reprinted.

    By hand: half of the particles, one to the root of two of the number, at 0.7 times 2.414.

    >>> round(target_efficiency_drop(0.7 / (2.0**0.5 - 1.0)), 6)
    0.5
    """
    return (impaction_number / (impaction_number + 0.7)) ** 2


@formula(
    source="calvert1972",
    equation=(
        r"E = 1 - \exp\left(-\frac{3}{2}\,\frac{Q_l}{Q_g}\,"
        r"\frac{H}{d}\,\frac{v_s}{v_s - U}\,\eta_d\right)"
    ),
    typical={
        "target_efficiency": (0.05, 0.95),
        "liquid_to_gas": (5e-4, 3e-3),
        "height": (2.0, 15.0),
        "droplet_diameter": (3e-4, 2e-3),
        "settling_velocity": (2.0, 6.0),
        "superficial_velocity": (0.3, 1.5),
    },
    output="grade_efficiency",
    title="Grade efficiency of a spray tower (Calvert)",
    symbols={"target_efficiency": r"\eta_d"},
)
def grade_efficiency_spray_tower(
    target_efficiency: Fraction,
    liquid_to_gas: LiquidToGas,
    height: Length,
    droplet_diameter: Length,
    settling_velocity: Speed,
    superficial_velocity: Speed,
) -> Fraction:
    """Share of a particle size caught by drops that fall against rising gas.

    Each drop sweeps its cross-section along its way through the gas; the settling velocity is that of the
    drops in still gas. Drops that fall no faster than the gas rises are no rain, and there is no answer. The
    scrubber handbook was not opened; the relation follows from a balance over a slice.

    By hand: 1 L/m³ of 1 mm drops in a tower of 5 m that fall four times as fast as the gas rises, all hit:
    1 − exp(−1.5·0.001·5000·4/3).

    >>> round((1 - grade_efficiency_spray_tower(1.0, 1e-3, 5.0, 1e-3, 4.0, 1.0)) * 1e5, 2)
    4.54
    """
    falls = settling_velocity > superficial_velocity
    impossible(~falls, superficial_velocity, "superficial_velocity", 0.0, settling_velocity, NO_RAIN)
    rain = jnp.where(falls, settling_velocity - superficial_velocity, 1.0)
    swept = 1.5 * liquid_to_gas * height / droplet_diameter * settling_velocity / rain
    return jnp.where(falls, -jnp.expm1(-swept * target_efficiency), jnp.nan)


@formula(
    source="calvert1972",
    equation=(r"E = 1 - \exp\left(-\frac{\pi}{2\,(j + j^2)\,(\varepsilon - h)}\,\frac{H}{d_c}\,\psi\right)"),
    fitted={"channel_ratio": (0.16, 0.19)},
    typical={
        "impaction_number": (1e-3, 0.1),
        "height": (0.5, 5.0),
        "obstacle_diameter": (0.01, 0.05),
        "void_fraction": (0.6, 0.95),
        "liquid_holdup": (0.02, 0.1),
        "channel_ratio": (0.16, 0.19),
    },
    output="grade_efficiency",
    title="Grade efficiency of a packed scrubber (Calvert)",
)
def grade_efficiency_packed_scrubber(
    impaction_number: Ratio,
    height: Length,
    obstacle_diameter: Length,
    void_fraction: VoidFraction = 0.75,
    liquid_holdup: Fraction = 0.05,
    channel_ratio: Annotated[PositiveNumber, Within(0.01, 1.0)] = 0.165,
) -> Fraction:
    """Share of a particle size thrown on a wet packing by the bends of its channels.

    The impaction number has the size of the packing and the velocity of the gas in the empty tower; the
    channels are 0.16 to 0.19 packings wide for rings and saddles of 1 to 4 cm. The scrubber handbook was not
    opened.

    By hand: 1 m of 2.5 cm saddles, 0.7 free of gas, ψ = 0.01: 1 − exp(−11.67·40·0.01).

    >>> round(grade_efficiency_packed_scrubber(0.01, 1.0, 0.025, 0.75, 0.05, 0.165), 4)
    0.9906
    """
    free = void_fraction - liquid_holdup
    some = free > 0.0
    impossible(~some, liquid_holdup, "liquid_holdup", 0.0, void_fraction, NO_ROOM)
    j = channel_ratio
    each = jnp.pi / (2.0 * (j + j**2) * jnp.where(some, free, 1.0))
    return jnp.where(some, -jnp.expm1(-each * height / obstacle_diameter * impaction_number), jnp.nan)


@formula(
    source="landahl1949",
    equation=r"\eta_d = \frac{\psi^3}{\psi^3 + 0.77\,\psi^2 + 0.22}",
    typical={"impaction_number": (0.05, 20.0)},
    output="target_efficiency",
    title="Share that one wire catches on its way (Landahl–Herrmann)",
    symbols={"target_efficiency": r"\eta_d"},
)
def target_efficiency_wire(impaction_number: Ratio) -> Fraction:
    """Share of the drops or particles in the path of a cylinder that hit it, by inertia.

    Fitted to a Reynolds number of the wire near 10; faster gas catches more. The paper was not opened.

    By hand: 1/1.99 at one.

    >>> round(target_efficiency_wire(1.0), 4)
    0.5025
    """
    cube = impaction_number**3
    return cube / (cube + 0.77 * impaction_number**2 + 0.22)


@formula(
    source="carpenter1955",
    equation=r"E = 1 - \exp\left(-\frac{2}{3\pi}\,a\,L\,\eta_d\right)",
    typical={"target_efficiency": (0.05, 0.95), "mesh_surface": (200.0, 600.0), "thickness": (0.05, 0.3)},
    output="grade_efficiency",
    title="Grade efficiency of a mesh pad (Carpenter–Othmer)",
    symbols={"target_efficiency": r"\eta_d"},
)
def grade_efficiency_mesh(
    target_efficiency: Fraction, mesh_surface: SpecificSurface, thickness: Length
) -> Fraction:
    """Share of a drop size caught by knitted wires that lie across the gas at random.

    Of the wire surface a π-th faces the gas, and two thirds of that lies across it. The paper was not opened.

    By hand: 360 m⁻¹, 15 cm, all that is in the way: 1 − exp(−11.46).

    >>> round((1 - grade_efficiency_mesh(1.0, 360.0, 0.15)) * 1e5, 2)
    1.06
    """
    return -jnp.expm1(-2.0 / (3.0 * jnp.pi) * mesh_surface * thickness * target_efficiency)


@formula(
    source="semrau1963; theodore2012",
    equation=r"P_T = \Delta p + p_l\,\frac{Q_l}{Q_g}",
    typical={
        "pressure_drop": (200.0, 2e4),
        "pressure_drop_liquid": (1e4, 1e6),
        "liquid_to_gas": (1e-4, 5e-3),
    },
    symbols={"pressure_drop_liquid": "p_l"},
    title="Contacting power of a scrubber",
)
def contacting_power(
    pressure_drop: PressureDrop, liquid_to_gas: LiquidToGas, pressure_drop_liquid: PressureDrop
) -> PressureDrop:
    """Energy that gas and liquid spend in a scrubber per volume of gas, J/m³, which is Pa.

    A horsepower per 1000 ft³/min is 1.58 kPa. Handbooks write it 0.157 per inch of water and 0.583 times psi
    times gallons per cubic foot: 5 in of water and 80 psi at 5 gal per 1000 ft³ make 0.785 + 0.233 = 1.018,
    which is 1.022 with the inch unrounded.

    >>> power = contacting_power(5 * 249.089, 5.0 * 1.336806e-4, "80 psi")
    >>> round(power / (745.7 / (1000 * 0.3048**3 / 60)), 3)
    1.022
    """
    return pressure_drop + pressure_drop_liquid * liquid_to_gas


@formula(
    source="semrau1963; theodore2012",
    equation=r"E = 1 - \exp\left[-\alpha\left(\frac{P_T}{P_1}\right)^\beta\right]",
    typical={
        "contacting_power": (500.0, 2e4),
        "contacting_coefficient": (0.5, 3.0),
        "contacting_exponent": (0.3, 1.5),
    },
    output="removal_efficiency",
    title="Removal efficiency of a scrubber from its power (Semrau)",
)
def removal_efficiency_semrau(
    contacting_power: PressureDrop,
    contacting_coefficient: PositiveNumber,
    contacting_exponent: PositiveNumber,
) -> Fraction:
    """Share of a dust that any scrubber collects by the power it spends: what counts is the energy, not the
    machine.

    Coefficient and exponent are those of a dust, found in trials and printed for a power P₁ of 1 hp per
    1000 ft³/min, which is 1.58 kPa.

    By hand: 1.47 and 1.05 at twice that power make 1.47 · 2.071 = 3.044 transfer units, and 4.77 % escape.

    >>> round(removal_efficiency_semrau(2 * 1580.05, 1.47, 1.05), 3)
    0.952
    """
    units = (
        contacting_coefficient * (jnp.maximum(contacting_power, 1e-300) / HORSEPOWER) ** contacting_exponent
    )
    return -jnp.expm1(-units)
