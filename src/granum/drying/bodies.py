"""Coupled heat and moisture transfer in a plate, cylinder or sphere that dries in humid gas and may
shrink.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import procedure
from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE
from granum.core.errors import ConvergenceError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Density,
    Diffusivity,
    HeatCapacity,
    HeatTransferCoefficient,
    HumidityRatio,
    Length,
    MassTransferCoefficient,
    MoistureDryBasis,
    MolarEnergy,
    Ratio,
    Series,
    SignedMassFlux,
    Temperature,
    ThermalConductivity,
    Time,
    Within,
)
from granum.drying.formulas.moisture import POTATO, IsothermLaw
from granum.humid_gas.formulas.transport import transport
from granum.humid_gas.pairs import AIR_WATER
from granum.materials.formulas.water import water_vapor_pressure
from granum.numerics import integrate

LIQUID_HEAT_CAPACITY, VAPORIZATION_AT_ZERO, LATENT_SLOPE = 4186.0, 2500.9e3, -2361.0
SCALE = 300.0  # kelvin: makes temperature a number like moisture for the integrator
# ratio of neighboring cells, of 24: the one at the surface is thin enough to stand for the surface
FINEST = 0.82
_GEOMETRY = {"plate": 0, "cylinder": 1, "sphere": 2}
_Times = Annotated[Time, Series("points")]


class BodyDrying(NamedTuple):
    """A body over time."""

    time: _Times
    moisture_dry_basis: Annotated[MoistureDryBasis, Series("points")]
    moisture_dry_basis_center: Annotated[MoistureDryBasis, Series("points")]
    moisture_dry_basis_surface: Annotated[MoistureDryBasis, Series("points")]
    temperature_center: Annotated[Temperature, Series("points")]
    surface_temperature: Annotated[Temperature, Series("points")]
    drying_flux: Annotated[SignedMassFlux, Series("points")]
    half_thickness: Annotated[Length, Series("points")]


class Body(NamedTuple):
    """Everything the balance needs: arrays, so that bodies of all shapes share one compiled integration."""

    # dry-solid mass of each cell per unit of surface (plate), length/(2π) (cylinder) or 4π (sphere)
    shares: Any
    geometry: Any  # 0 plate, 1 cylinder, 2 sphere
    dry_density: Any
    shrinkage: Any
    diffusivity: Any
    activation: Any
    conductivity: Any
    solid_heat: Any
    isotherm: Any
    gas_temperature: Any
    gas_density: Any  # dry gas per volume of gas
    humidity: Any
    h: Any
    hm: Any


def _shape(X: Any, b: Body) -> tuple[Any, Any, Any]:
    """Radii of the faces, areas of the faces and thickness of the cells, from the volume that each cell has
    now.
    """
    volume = b.shares * (1.0 + b.shrinkage * X) / b.dry_density
    n = b.geometry + 1
    cubes = jnp.concatenate([jnp.zeros(1), jnp.cumsum(volume)]) * n
    r = jnp.concatenate([jnp.zeros(1), cubes[1:] ** (1.0 / n)])
    # a power of zero has no derivative
    area = jnp.where(b.geometry == 0, 1.0, jnp.where(b.geometry == 1, r, r * r))
    return r, area, jnp.diff(r)


def surface_flux(X: Any, T: Any, b: Body) -> Any:
    """Evaporation flux at a surface of given moisture and temperature, kg/(m² s)."""
    a = b.isotherm.activity(jnp.maximum(X, 1e-6), T)
    vapor = jnp.minimum(a * water_vapor_pressure.function(T), 0.999 * STANDARD_ATMOSPHERE)
    return (
        b.hm
        * b.gas_density
        * (AIR_WATER.molar_mass_ratio * vapor / (STANDARD_ATMOSPHERE - vapor) - b.humidity)
    )


def rates(_t: Any, state: tuple[Any, Any], b: Body) -> tuple[Any, Any]:
    """dX/dt and dT/dt of every cell: moisture by diffusion in the moving body, heat by conduction and by the
    moisture it carries.
    """
    X, T = state
    _r, area, dz = _shape(X, b)
    D = b.diffusivity * jnp.exp(-b.activation / (GAS_CONSTANT * T))
    dry = b.dry_density / (1.0 + b.shrinkage * X)
    gap = 0.5 * (dz[1:] + dz[:-1])
    inner = 2.0 / (1.0 / (D[1:] * dry[1:]) + 1.0 / (D[:-1] * dry[:-1])) * (X[:-1] - X[1:]) / gap
    out = surface_flux(X[-1], T[-1], b)
    moisture = area * jnp.concatenate([jnp.zeros(1), inner, out[None]])
    net = b.isotherm.net_isosteric_heat(jnp.maximum(X[-1], 1e-4), T[-1])
    latent = (
        VAPORIZATION_AT_ZERO
        + LATENT_SLOPE * (T[-1] - 273.15)
        + jnp.where(jnp.isfinite(net), jnp.clip(net, 0.0, 3e6), 0.0)
    )
    surface = out * latent - b.h * (b.gas_temperature - T[-1])
    conducted = b.conductivity * (T[:-1] - T[1:]) / gap
    upwind = jnp.where(inner > 0, T[:-1], T[1:])
    heat = area * jnp.concatenate(
        [jnp.zeros(1), conducted + inner * LIQUID_HEAT_CAPACITY * (upwind - 273.15), surface[None]]
    )
    carried = out * LIQUID_HEAT_CAPACITY * (T[-1] - 273.15) * area[-1]
    heat = heat.at[-1].add(carried)
    dX = -jnp.diff(moisture) / b.shares
    capacity = b.solid_heat + X * LIQUID_HEAT_CAPACITY
    dT = (-jnp.diff(heat) / b.shares - LIQUID_HEAT_CAPACITY * (T - 273.15) * dX) / capacity
    return dX, dT


def _scaled(t: Any, state: tuple[Any, Any], b: Body) -> tuple[Any, Any]:
    dX, dT = rates(t, (state[0], SCALE * state[1]), b)
    return dX, dT / SCALE


@eqx.filter_jit
def _integrated(start: tuple[Any, Any], times: Any, body: Body) -> tuple[Any, tuple[Any, ...]]:
    """Whether it went to the end, and the columns of the result."""
    found = integrate(_scaled, start, times, body, stiff=True, rtol=1e-6, atol=1e-7, max_steps=20000)
    X, T = found.states[0], SCALE * found.states[1]
    flux = jax.vmap(lambda x, t: surface_flux(x[-1], t[-1], body))(X, T)
    radius = jax.vmap(lambda x: _shape(x, body)[0][-1])(X)
    mean = (X @ body.shares) / body.shares.sum()
    return found.converged, (mean, X[:, 0], X[:, -1], T[:, 0], T[:, -1], flux, radius)


@procedure(
    source="keey1978; crank1975; mayor2004",
    title="Drying of a body, heat and moisture coupled",
    typical={"diffusivity_preexponential": (1e-10, 1e-8)},
)
def body_drying(
    time: _Times,
    half_thickness: Length,
    initial_moisture: MoistureDryBasis,
    temperature: Temperature,
    humidity_ratio: HumidityRatio,
    heat_transfer_coefficient: HeatTransferCoefficient,
    diffusivity_preexponential: Diffusivity,
    diffusion_activation_energy: MolarEnergy = 0.0,
    isotherm: IsothermLaw = POTATO,
    shape: Literal["plate", "cylinder", "sphere"] = "plate",
    initial_temperature: Temperature = 293.15,
    dry_density: Density = 1400.0,
    shrinkage_coefficient: Ratio = 1.4,
    specific_heat_capacity: HeatCapacity = 1500.0,
    thermal_conductivity: ThermalConductivity = 0.4,
    mass_transfer_coefficient: MassTransferCoefficient | None = None,
    cells: Annotated[int, Within(2, 1000)] = 24,
) -> BodyDrying:
    """Moisture and temperature inside a body that dries in gas of constant temperature and humidity, from
    center to surface.

    Moisture moves by diffusion with an Arrhenius diffusivity (its pre-exponential factor is the diffusivity
    itself when no activation energy is given), the surface is in sorption equilibrium with the film,
    evaporation takes its latent and sorption heat there. The grid rides on the dry solid, so that shrinkage
    loses none of it. The mass transfer coefficient follows from the heat transfer coefficient by Chilton and
    Colburn unless given. ``dry_density`` is mass of dry solid over volume at zero moisture; with a shrinkage
    coefficient of dry density over 1000 kg/m³ the body shrinks by the volume of its water.

    >>> body_drying(
    ...     time=[0.0, 3600.0],
    ...     half_thickness="5 mm",
    ...     initial_moisture=4.0,
    ...     temperature="60 degC",
    ...     humidity_ratio=0.01,
    ...     heat_transfer_coefficient=30.0,
    ...     diffusivity_preexponential=5e-10,
    ... ).moisture_dry_basis[0]
    4.0
    """
    times = np.asarray(time, dtype=float)
    if len(times) < 2 or np.any(np.diff(times) <= 0):
        raise InputError(_("'time' must increase from point to point, two at least."), name="time")
    gas = transport(temperature=temperature, humidity_ratio=humidity_ratio)
    y = float(AIR_WATER.fraction(humidity_ratio))
    hm = mass_transfer_coefficient
    if hm is None:
        density = (
            STANDARD_ATMOSPHERE
            * ((1 - y) * AIR_WATER.gas_molar_mass + y * AIR_WATER.vapor_molar_mass)
            / (GAS_CONSTANT * temperature)
        )
        hm = (
            heat_transfer_coefficient
            / (density * gas.specific_heat_capacity)
            * gas.lewis_number ** (-2.0 / 3.0)
        )
    n = _GEOMETRY[shape] + 1
    width = (FINEST ** (24.0 / cells)) ** np.arange(cells)
    edge = np.concatenate([[0.0], np.cumsum(width) / width.sum()])
    solid = dry_density / (1.0 + shrinkage_coefficient * initial_moisture) * half_thickness**n / n
    body = Body(
        shares=jnp.asarray(solid * np.diff(edge**n)),
        geometry=n - 1,
        dry_density=dry_density,
        shrinkage=shrinkage_coefficient,
        diffusivity=diffusivity_preexponential,
        activation=diffusion_activation_energy,
        conductivity=thermal_conductivity,
        solid_heat=specific_heat_capacity,
        isotherm=isotherm,
        gas_temperature=temperature,
        gas_density=(1 - y) * STANDARD_ATMOSPHERE * AIR_WATER.gas_molar_mass / (GAS_CONSTANT * temperature),
        humidity=humidity_ratio,
        h=heat_transfer_coefficient,
        hm=hm,
    )
    start = (jnp.full(cells, float(initial_moisture)), jnp.full(cells, float(initial_temperature) / SCALE))

    numbers = {
        name: value if name == "isotherm" else jnp.asarray(value, dtype=float)
        for name, value in body._asdict().items()
    }
    converged, columns = _integrated(start, jnp.asarray(times), Body(**numbers))
    if not bool(converged):
        raise ConvergenceError(
            _(
                "The drying of the body could not be integrated to the end; check the diffusivity and "
                "the isotherm."
            )
        )
    return BodyDrying(times, *(np.asarray(c) for c in columns))
