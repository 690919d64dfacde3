"""Pipe flow of liquids that do not follow Newton: power law, Bingham and Herschel–Bulkley.

The consistency is given as the viscosity of the power law at a reference shear rate, 1 s⁻¹ unless given,
where it has the number of the consistency index in Pa·sⁿ, whose own unit changes with the exponent.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula, unconverged
from granum.core.kinds import (
    Density,
    DynamicViscosity,
    FlowIndex,
    Length,
    PositiveNumber,
    PressureGradient,
    Ratio,
    ShearRate,
    Speed,
    Within,
    YieldStress,
)
from granum.numerics import find_root, safe_power

_PIPE = {
    "velocity": (0.5, 3.0),
    "diameter": (0.05, 0.3),
    "fluid_density": (1000.0, 1500.0),
    "plastic_viscosity": (5e-3, 0.1),
    "consistency": (0.05, 5.0),
    "flow_index": (0.4, 0.9),
    "yield_stress": (1.0, 20.0),
    "reynolds": (3e3, 3e4),
    "hedstrom_number": (1e4, 1e6),
}


@formula(
    source="metzner1955; chhabra2008, ch. 3",
    equation=(
        r"\mathrm{Re} = \frac{\rho_f v^{2-n} D^n}{8^{n-1} K \left(\frac{3n+1}{4n}\right)^n},\quad "
        r"K = \eta_1\,\dot\gamma_1^{1-n}"
    ),
    typical=_PIPE,
)
def reynolds_metzner_reed(
    velocity: Speed,
    diameter: Length,
    fluid_density: Density,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    reference_shear_rate: ShearRate = 1.0,
) -> Ratio:
    """Reynolds number of a power-law liquid in a pipe, on which its laminar friction factor is 64/Re.

    Sources not opened; derived again from the exact laminar flow.

    >>> round(reynolds_metzner_reed(1.0, 0.1, 1000.0, 0.5, 0.5), 2)
    1600.0
    """
    n = flow_index
    shear = 8.0 * velocity / diameter / reference_shear_rate
    thick = consistency * safe_power(shear, n - 1.0) * ((3.0 * n + 1.0) / (4.0 * n)) ** n
    return jnp.where(velocity > 0.0, fluid_density * velocity * diameter / thick, 0.0)


@formula(
    source="ryan1959; chhabra2008, ch. 3",
    equation=r"\mathrm{Re}_c = \frac{6464\,n}{(3n+1)^2}\,(n+2)^{(n+2)/(n+1)}",
    typical=_PIPE,
)
def reynolds_critical_ryan_johnson(flow_index: FlowIndex) -> PositiveNumber:
    """Metzner and Reed's Reynolds number at which the laminar pipe flow of a power-law liquid ends.

    From the stability parameter whose value, 808, is set by Newton's liquids at 2100.
    Sources not opened.

    >>> round(reynolds_critical_ryan_johnson(1.0))
    2099
    """
    n = flow_index
    return 6464.0 * n / (3.0 * n + 1.0) ** 2 * (n + 2.0) ** ((n + 2.0) / (n + 1.0))


@formula(
    source="dodge1959; chhabra2008, ch. 3",
    equation=(
        r"\frac{1}{\sqrt{f/4}} = \frac{4}{n^{0.75}}\log_{10}\left[\mathrm{Re}\,(f/4)^{1-n/2}\right] - "
        r"\frac{0.4}{n^{1.2}}"
    ),
    fitted={"reynolds": (2900.0, 36000.0), "flow_index": (0.36, 1.0)},
    typical=_PIPE,
)
def friction_factor_dodge_metzner(reynolds: Ratio, flow_index: FlowIndex) -> PositiveNumber:
    """Friction factor after Darcy of the turbulent flow of a power-law liquid in a smooth pipe.

    Four times the factor after Fanning, on Metzner and Reed's Reynolds number. With n = 1 it is Nikuradse's
    law of smooth pipes. Sources not opened; the range is recalled, the equation as other programs have it.

    >>> round(friction_factor_dodge_metzner(1e4, 1.0), 4)
    0.0309
    """
    n = flow_index
    slope = 4.0 / n**0.75 * (2.0 - n)
    known = 4.0 / n**0.75 * jnp.log10(jnp.maximum(reynolds, 1e-6)) - 0.4 / n**1.2

    def equation(u: Any, slope: Any, known: Any) -> Any:
        return u + slope * jnp.log10(u) - known

    low = 10.0 ** (jnp.minimum(known, 0.0) / slope - 1.0)
    root = find_root(equation, low, jnp.maximum(known, 1.0), slope, known)
    unconverged(root.converged)
    return 4.0 / root.value**2


@formula(
    source="govier1972; chhabra2008, ch. 3",
    equation=(
        r"\frac{2v}{D} = n\left(\frac{\tau_w}{K}\right)^{1/n}(1-x)^{1+1/n}\left[\frac{(1-x)^2}{3n+1} + "
        r"\frac{2x(1-x)}{2n+1} + \frac{x^2}{n+1}\right],\quad x = \frac{\tau_y}{\tau_w},\ "
        r"\frac{\Delta p}{L} = \frac{4\tau_w}{D},\ K = \eta_1\,\dot\gamma_1^{1-n}"
    ),
    typical=_PIPE,
    title="Pressure gradient of a Herschel–Bulkley liquid in a pipe, laminar",
)
def pressure_gradient_herschel_bulkley(
    velocity: Speed,
    diameter: Length,
    consistency: DynamicViscosity,
    flow_index: FlowIndex = 1.0,
    yield_stress: YieldStress = 0.0,
    reference_shear_rate: ShearRate = 1.0,
) -> PressureGradient:
    """Pressure that a Herschel–Bulkley liquid loses per length of pipe in laminar flow, exact.

    Without a yield stress it is a power-law liquid, with n = 1 a Bingham liquid (Buckingham and Reiner), with
    both Newton's. At rest it is what just moves the plug, 4 τ_y/D. Sources not opened; derived again.

    By hand, Newton: 32·η·v/D².

    >>> round(pressure_gradient_herschel_bulkley("0.1 m/s", "10 mm", 1e-2), 6)
    320.0
    """
    n = flow_index
    shear = 2.0 * velocity / diameter / reference_shear_rate
    alone = consistency * reference_shear_rate * safe_power((3.0 * n + 1.0) / n * shear, n)

    def equation(wall: Any, alone: Any, yielding: Any, n: Any) -> Any:
        """Stress of the power law alone at the velocity that a wall stress makes, less what it should be."""
        x = jnp.minimum(yielding / wall, 1.0)
        free = 1.0 - x
        parts = free**2 + (3.0 * n + 1.0) * (2.0 * x * free / (2.0 * n + 1.0) + x**2 / (n + 1.0))
        return wall * safe_power(free, n + 1.0) * safe_power(parts, n) - alone

    flows = alone > 0.0
    sought = jnp.where(flows, alone, 1.0)
    low, high = jnp.maximum(yield_stress, 0.5 * sought), 4.0 * yield_stress + 2.0 * sought
    root = find_root(equation, low, high, sought, yield_stress, n)
    unconverged(root.converged | ~flows)
    return 4.0 * jnp.where(flows, root.value, yield_stress) / diameter


@formula(
    source="hedstrom1952",
    equation=r"\mathrm{He} = \frac{\rho_f D^2 \tau_y}{\eta_p^2}",
    typical=_PIPE,
)
def hedstrom_number(
    diameter: Length,
    fluid_density: Density,
    yield_stress: YieldStress,
    plastic_viscosity: DynamicViscosity,
) -> Ratio:
    """Hedström's number of a Bingham liquid in a pipe: yield stress times inertia over viscosity squared.

    >>> round(hedstrom_number("0.254 m", 1300.0, 6.0, 0.02))
    1258062
    """
    return fluid_density * diameter**2 * yield_stress / plastic_viscosity**2


@formula(
    source="darby1981; darby2001, ch. 6",
    equation=(
        r"f = \left(f_L^m + f_T^m\right)^{1/m},\quad f_T = \frac{4\cdot 10^a}{\mathrm{Re}^{0.193}},\quad "
        r"a = -1.47\left(1 + 0.146\,e^{-2.9\cdot 10^{-5}\,\mathrm{He}}\right),\quad "
        r"m = 1.7 + \frac{40000}{\mathrm{Re}}"
    ),
    fitted={"hedstrom_number": (1e3, 1e8)},
    typical=_PIPE,
)
def friction_factor_darby_melson(reynolds: Ratio, hedstrom_number: Ratio) -> PositiveNumber:
    """Friction factor after Darcy of a Bingham liquid in a smooth pipe: laminar, turbulent and between.

    The laminar part is Buckingham and Reiner's, on the plastic viscosity. Darby and Melson (1981) had −1.378
    in the place of Darby's later −1.47. At small Hedström numbers it falls short of the smooth pipe of
    Newton's liquids. Sources not opened; the range is recalled, the equation as another program has it.

    >>> round(friction_factor_darby_melson(37973.0, 1258062.4), 5)
    0.01905
    """
    re = jnp.maximum(reynolds, 1e-6)
    # a pipe of unit diameter, velocity and density: the viscosity is 1/Re, the yield stress He/Re²
    gradient = pressure_gradient_herschel_bulkley.function(1.0, 1.0, 1.0 / re, 1.0, hedstrom_number / re**2)
    laminar = jnp.log(2.0 * gradient)
    a = -1.47 * (1.0 + 0.146 * jnp.exp(-2.9e-5 * hedstrom_number))
    turbulent = jnp.log(4.0) + a * jnp.log(10.0) - 0.193 * jnp.log(re)
    m = 1.7 + 4e4 / re
    return jnp.exp(jnp.logaddexp(m * laminar, m * turbulent) / m)


@formula(
    source="metzner1955; ryan1959; dodge1959",
    equation=r"\frac{\Delta p}{L} = f\,\frac{\rho_f v^2}{2D},\quad f = \frac{64}{\mathrm{Re}}\ "
    r"(\mathrm{Re} < \mathrm{Re}_c),\quad \mathrm{Re} = \mathrm{Re}(v, D, \rho_f, \eta_1, n)",
    typical=_PIPE,
    title="Pressure gradient of a power-law liquid in a pipe",
)
def pressure_gradient_power_law(
    velocity: Speed,
    diameter: Length,
    fluid_density: Density,
    consistency: DynamicViscosity,
    flow_index: FlowIndex,
    reference_shear_rate: ShearRate = 1.0,
) -> PressureGradient:
    """Pressure that a power-law liquid loses per length of smooth pipe, laminar or turbulent.

    Laminar up to Ryan and Johnson's Reynolds number, by Dodge and Metzner from there on; between the two the
    pressure jumps, as in Moody's chart.

    >>> round(pressure_gradient_power_law(1.0, 0.1, 1000.0, 0.5, 0.5), 3)
    200.0
    """
    re = reynolds_metzner_reed.function(
        velocity, diameter, fluid_density, consistency, flow_index, reference_shear_rate
    )
    critical = reynolds_critical_ryan_johnson.function(flow_index)
    calm = re < critical
    rough = friction_factor_dodge_metzner.function(jnp.maximum(re, critical), flow_index)
    slow = pressure_gradient_herschel_bulkley.function(
        velocity, diameter, consistency, flow_index, 0.0, reference_shear_rate
    )
    return jnp.where(calm, slow, rough * fluid_density * velocity**2 / (2.0 * diameter))


@formula(
    source="hedstrom1952; darby2001, ch. 6",
    equation=r"\frac{\Delta p}{L} = f\left(\mathrm{Re}, \mathrm{He}\right)\frac{\rho_f v^2}{2D},\quad "
    r"\mathrm{Re} = \frac{v D \rho_f}{\eta_p},\ \mathrm{He} = \frac{\rho_f D^2\tau_y}{\eta_p^2}",
    typical=_PIPE,
    title="Pressure gradient of a Bingham liquid in a pipe",
)
def pressure_gradient_bingham(
    velocity: Annotated[Speed, Within(1e-6, 1e3)],
    diameter: Length,
    fluid_density: Density,
    yield_stress: YieldStress,
    plastic_viscosity: DynamicViscosity,
) -> PressureGradient:
    """Pressure that a Bingham liquid loses per length of smooth pipe, laminar or turbulent.

    >>> round(pressure_gradient_bingham("2.3 m/s", "0.254 m", 1300.0, 6.0, 0.02))
    258
    """
    re = velocity * diameter * fluid_density / plastic_viscosity
    he = hedstrom_number.function(diameter, fluid_density, yield_stress, plastic_viscosity)
    return friction_factor_darby_melson.function(re, he) * fluid_density * velocity**2 / (2.0 * diameter)
