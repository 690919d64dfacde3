"""Freeze drying: primary drying of vials with the limits of product and machine, slabs, choked flow and
secondary drying.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import flags, formula
from granum.core.constants import GAS_CONSTANT
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Frequency,
    HeatTransferCoefficient,
    Length,
    MassFlow,
    MassFlux,
    MoistureDryBasis,
    MolarEnergy,
    PositiveNumber,
    Pressure,
    Temperature,
    TemperatureRate,
    ThermalConductivity,
    Time,
    Volume,
)
from granum.drying.formulas.vials import (
    COLDEST,
    ICE_CONDUCTIVITY,
    MODEL,
    NODES,
    SUBLIMATION_HEAT,
    WARMEST,
    dry,
    vial_of,
)
from granum.drying.kinds import (
    HeatTransferPerPressure,
    PerLength,
    PerPressure,
    VaporPermeability,
    VaporResistance,
    VaporResistanceGradient,
)
from granum.humid_gas.pairs import ice_vapor_pressure
from granum.numerics import find_root
from granum.numerics.quadrature import gauss_legendre


class PrimaryDrying(NamedTuple):
    """Primary drying of a vial."""

    drying_time: Time
    temperature_product: Temperature
    temperature_front: Temperature
    sublimation_flux: MassFlux
    sublimation_flux_highest: MassFlux
    sublimation_flux_end: MassFlux
    frozen_height: Length


COLD = "Ice does not sublime at this temperature and chamber pressure."
_TYPICAL = {
    "pressure_chamber": (5.0, 25.0), "temperature_shelf": (263.0, 298.0), "temperature_shelf_start": (233.0, 240.0), "ramp_rate": (0.005, 0.03),  # noqa: E501
    "area_vial": (3.5e-4, 4e-4), "area_product": (3e-4, 3.2e-4), "volume_fill": (1e-6, 4e-6), "concentration": (30.0, 100.0),  # noqa: E501
    "vial_coefficient_contact": (8.0, 14.0), "vial_coefficient_gas": (0.15, 0.4), "vial_coefficient_saturation": (2e-3, 5e-3),  # noqa: E501
    "vapor_resistance": (4e4, 8e4), "vapor_resistance_slope": (3e7, 9e7), "vapor_resistance_saturation": (0.0, 50.0),  # noqa: E501
    "solid_density": (1400.0, 1600.0),
}  # fmt: skip


@formula(
    source=MODEL + "; iapws2011melting",
    fitted={"temperature_product": (150.0, 273.16), "temperature_front": (150.0, 273.16)},
    equation=(
        r"A_v K_v (T_{sh}-T_b) = \Delta H_s A_p\frac{p_i(T_s)-P_c}{R_p(L)},\quad T_b = T_s + "
        r"\frac{\Delta H_s\,\dot m (L_0-L)}{A_p k_i},\quad \frac{dL}{dt} = \frac{\dot "
        r"m\,L_0}{m_i},\quad K_v = K_C + \frac{K_P P_c}{1 + K_D P_c},\ R_p = R_0 + \frac{A_1 L}{1 + A_2 "
        r"L},\quad L_0 = L_0(V_f, c, A_p)"
    ),
    typical=_TYPICAL,
    title="Primary drying of a vial",
    symbols={"temperature_product": "T_b"},
)
def primary_drying(
    pressure_chamber: Pressure,
    temperature_shelf: Temperature,
    area_vial: Area,
    area_product: Area,
    volume_fill: Volume,
    concentration: Concentration,
    vial_coefficient_contact: HeatTransferCoefficient,
    vial_coefficient_gas: HeatTransferPerPressure,
    vapor_resistance: VaporResistance,
    vapor_resistance_slope: VaporResistanceGradient = 0.0,
    vapor_resistance_saturation: PerLength = 0.0,
    vial_coefficient_saturation: PerPressure = 0.0,
    temperature_shelf_start: Temperature = 238.15,
    ramp_rate: TemperatureRate = 1.0 / 60.0,
    solid_density: Density = 1500.0,
) -> PrimaryDrying:
    """Time, highest product temperature and fluxes of the sublimation of a frozen fill, quasi-steady from
    moment to moment.

    The shelf warms at the ramp rate from its first temperature and is then held; the chamber pressure is
    constant. The product temperature is that of the vial bottom, the highest in the product. Not possible (no
    value) where the shelf is too cold for ice to sublime. Constants of ice after Shivkumar et al.; its vapor
    pressure is IAPWS's, within 0.5 % of theirs.

    Their example ends between 6.65 and 6.66 h, at −14.77 °C.

    The vapor pressure of ice is that of IAPWS, up to the triple point.

    >>> found = primary_drying(
    ...     "150 mtorr",
    ...     "20 degC",
    ...     "3.8 cm^2",
    ...     "3.14 cm^2",
    ...     "2 mL",
    ...     "0.05 g/mL",
    ...     "2.75e-4 cal/(s*K*cm^2)",
    ...     "8.93e-4 cal/(s*K*cm^2*torr)",
    ...     "1.4 cm^2*hour*torr/g",
    ...     "16 cm*hour*torr/g",
    ...     0.0,
    ...     "0.46 1/torr",
    ...     "-35 degC",
    ...     "1 kelvin/min",
    ... )
    >>> round(found.drying_time / 3600, 2), round(found.temperature_product - 273.15, 1)
    (6.65, -14.8)
    """
    vial = vial_of(
        area_vial,
        area_product,
        volume_fill,
        concentration,
        solid_density,
        vial_coefficient_contact,
        vial_coefficient_gas,
        vial_coefficient_saturation,
        vapor_resistance,
        vapor_resistance_slope,
        vapor_resistance_saturation,
        pressure_chamber,
    )
    total, path = dry(vial, temperature_shelf_start, temperature_shelf, ramp_rate)
    flags.impossible(~jnp.isfinite(total), temperature_shelf, "temperature_shelf", reason=COLD)
    mean = vial.ice_per_height * vial.height / total
    ends = path.flux[-1]
    return PrimaryDrying(
        total,
        jnp.max(path.bottom, axis=0),
        jnp.max(path.front, axis=0),
        mean,
        jnp.max(path.flux, axis=0),
        ends,
        vial.height + 0.0 * total,
    )


class VialLimit(NamedTuple):
    """The fastest primary drying that keeps the product at its limit, and the fastest the machine allows."""

    temperature_shelf: Temperature
    drying_time: Time
    sublimation_flux: MassFlux
    sublimation_flux_end: MassFlux
    drying_time_equipment: Time
    sublimation_flux_equipment: MassFlux


@formula(
    source="nail2008; shivkumar2019; iapws2011melting",
    fitted={"temperature_limit": (150.0, 273.16)},
    equation=(
        r"\frac{\Delta H_s\,g\,(L_0-L)}{k_i} = T_{max} - T_s,\quad g = \frac{p_i(T_s)-P_c}{R_p},\quad "
        r"T_{sh} = T_{max} + \frac{\Delta H_s\,g\,A_p}{K_v A_v},\quad g_{eq} = \frac{\dot m_{max}}{N "
        r"A_p},\quad K_v = K_C + \frac{K_P P_c}{1 + K_D P_c},\ R_p = R_0 + \frac{A_1 L}{1 + A_2 "
        r"L},\quad L_0 = L_0(V_f, c, A_p)"
    ),
    typical={
        **_TYPICAL,
        "temperature_limit": (245.0, 265.0),
        "sublimation_capacity": (3e-4, 6e-4),
        "vial_count": (300.0, 500.0),
    },
    title="Design space of primary drying",
)
def freeze_drying_limit(
    pressure_chamber: Pressure,
    temperature_limit: Temperature,
    sublimation_capacity: MassFlow,
    vial_count: PositiveNumber,
    area_vial: Area,
    area_product: Area,
    volume_fill: Volume,
    concentration: Concentration,
    vial_coefficient_contact: HeatTransferCoefficient,
    vial_coefficient_gas: HeatTransferPerPressure,
    vapor_resistance: VaporResistance,
    vapor_resistance_slope: VaporResistanceGradient = 0.0,
    vapor_resistance_saturation: PerLength = 0.0,
    vial_coefficient_saturation: PerPressure = 0.0,
    solid_density: Density = 1500.0,
) -> VialLimit:
    """Edges of the design space at one pressure: product at its limit all the time, and the machine at its
    capacity all the time.

    ``temperature_shelf`` is the highest constant one that never passes the limit. ``sublimation_capacity`` is
    what chamber, duct and condenser carry at that pressure, for all vials. No value where the product at its
    limit has less vapor pressure than the chamber.

    Shivkumar et al., example at 150 mTorr and −5 °C: 1.98 h at 3.11 kg/(m² h), 2.29 at the end; the machine
    0.489 h.

    The vapor pressure of ice is that of IAPWS, up to the triple point.

    >>> edge = freeze_drying_limit(
    ...     "150 mtorr",
    ...     "-5 degC",
    ...     "1.573 kg/hour",
    ...     398.0,
    ...     "3.8 cm^2",
    ...     "3.14 cm^2",
    ...     "2 mL",
    ...     "0.05 g/mL",
    ...     "2.75e-4 cal/(s*K*cm^2)",
    ...     "8.93e-4 cal/(s*K*cm^2*torr)",
    ...     "1.4 cm^2*hour*torr/g",
    ...     "16 cm*hour*torr/g",
    ...     0.0,
    ...     "0.46 1/torr",
    ... )
    >>> round(edge.drying_time / 3600, 2), round(edge.drying_time_equipment / 3600, 2)
    (1.98, 0.49)
    """
    vial = vial_of(
        area_vial,
        area_product,
        volume_fill,
        concentration,
        solid_density,
        vial_coefficient_contact,
        vial_coefficient_gas,
        vial_coefficient_saturation,
        vapor_resistance,
        vapor_resistance_slope,
        vapor_resistance_saturation,
        pressure_chamber,
    )
    shape = jnp.broadcast_shapes(*(jnp.shape(x) for x in (*vial, temperature_limit)))
    limit = jnp.broadcast_to(jnp.asarray(temperature_limit, dtype=float), shape)
    subliming = ice_vapor_pressure(limit) > vial.pressure
    flags.impossible(~subliming, limit, "temperature_limit", reason=COLD)

    def flux_at(L: Any) -> Any:
        """Flux when the bottom is at the limit."""
        R = vial.resistance_at(L)

        def balance(T: Any) -> Any:
            flux = (ice_vapor_pressure(T) - vial.pressure) / R
            return SUBLIMATION_HEAT * flux * (vial.height - L) / ICE_CONDUCTIVITY - (limit - T)

        T = find_root(balance, COLDEST, limit + 1e-9, start=limit - 1.0, tolerance=1e-12).value
        return jnp.where(subliming, (ice_vapor_pressure(T) - vial.pressure) / R, jnp.nan)

    L0 = jnp.broadcast_to(vial.height, shape)
    time = gauss_legendre(lambda L: vial.ice_per_height / flux_at(L), jnp.zeros_like(L0), L0, order=NODES)
    depths = jnp.linspace(0.0, 1.0, 9).reshape((-1,) + (1,) * L0.ndim) * L0
    fluxes = flux_at(depths)
    shelf = limit + SUBLIMATION_HEAT * jnp.min(fluxes, axis=0) * vial.area_product / (
        vial.heat_transfer * vial.area
    )
    mass = vial.ice_per_height * vial.height
    most = sublimation_capacity / (vial_count * area_product)
    return VialLimit(shelf, time, mass / time, fluxes[-1], mass / most + 0.0 * time, most + 0.0 * time)


class SlabFreezeDrying(NamedTuple):
    """Freeze drying of a layer heated through its dry part."""

    temperature_front: Temperature
    vapor_pressure: Pressure
    drying_time: Time


@formula(
    source="king1971; iapws2011melting",
    fitted={"temperature_front": (150.0, 273.16)},
    equation=(
        r"\lambda\,(T_s - T_f) = \Delta H_s\,b\,[p_i(T_f) - P_c],\qquad t = \frac{\Delta H_s\,\rho_d "
        r"(X_0 - X) L^2}{2\lambda\,(T_s-T_f)}"
    ),
    typical={
        "surface_temperature": (300.0, 340.0),
        "pressure_chamber": (5.0, 60.0),
        "thermal_conductivity": (0.03, 0.15),
        "vapor_permeability": (1e-8, 5e-8),
        "thickness": (2e-3, 1e-2),
        "dry_density": (80.0, 300.0),
        "moisture_dry_basis_inlet": (2.0, 9.0),
        "moisture_dry_basis_outlet": (0.05, 0.2),
    },
    output="freeze_drying_slab",
    title="Freeze drying of a layer of food",
    symbols={"temperature_front": "T_f", "moisture_dry_basis_inlet": "X_0", "vapor_pressure": "p_i"},
)
def freeze_drying_slab(
    surface_temperature: Temperature,
    pressure_chamber: Pressure,
    thermal_conductivity: ThermalConductivity,
    vapor_permeability: VaporPermeability,
    thickness: Length,
    dry_density: Density,
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_dry_basis_outlet: MoistureDryBasis = 0.0,
) -> SlabFreezeDrying:
    """Temperature of the ice front, which stays the same, and time for it to cross a layer from the heated
    surface (uniformly retreating ice).

    Heat comes and vapor leaves through the dry layer; both fluxes fall alike as it grows. ``thickness`` is
    the way of the front: half of a piece that is heated from both sides. Pressure and temperature are those
    at the surface of the product.

    Coffee extract at 30 °C and 97 µm Hg with 0.035 W/(m K) and 3.5e-9 kg/(m s µm Hg): −29.4 °C and 301 µm Hg
    by King's chart.

    The vapor pressure of ice is that of IAPWS, up to the triple point.

    >>> coffee = freeze_drying_slab("30 degC", "0.097 mmHg", 0.035, 3.5e-9 / 0.133322, "5 mm", 250.0, 2.0)
    >>> round(coffee.temperature_front - 273.15, 1), round(coffee.vapor_pressure / 0.133322)
    (-29.3, 306)
    """
    T0, P0 = jnp.asarray(surface_temperature), pressure_chamber
    b, k = vapor_permeability, thermal_conductivity

    def balance(T: Any) -> Any:
        return SUBLIMATION_HEAT * b * (ice_vapor_pressure(T) - P0) - k * (T0 - T)

    T = find_root(balance, COLDEST, WARMEST, start=245.0, tolerance=1e-12).value
    subliming = (ice_vapor_pressure(T) > P0) & (T < T0)
    flags.impossible(~subliming, T0, "surface_temperature", reason=COLD)
    water = dry_density * jnp.maximum(moisture_dry_basis_inlet - moisture_dry_basis_outlet, 0.0)
    time = SUBLIMATION_HEAT * water * thickness**2 / (2.0 * k * jnp.where(subliming, T0 - T, jnp.nan))
    return SlabFreezeDrying(T, ice_vapor_pressure(T), time)


@formula(
    source="patel2010; searles2004",
    fitted={"discharge_coefficient": (0.0, 1.0)},
    equation=(
        r"\dot m^* = C_d\,\frac{\pi D^2}{4}\,P_c\sqrt{\frac{\gamma M}{R "
        r"T}}\left(\frac{2}{\gamma+1}\right)^{\frac{\gamma+1}{2(\gamma-1)}}"
    ),
    typical={
        "duct_diameter": (0.1, 0.6),
        "pressure_chamber": (3.0, 30.0),
        "temperature": (260.0, 300.0),
        "discharge_coefficient": (0.6, 1.0),
    },
    title="Choked flow in the duct of a freeze dryer",
)
def choked_flow_rate(
    pressure_chamber: Pressure,
    duct_diameter: Length,
    temperature: Temperature = 283.15,
    discharge_coefficient: PositiveNumber = 0.75,
) -> MassFlow:
    """Most water vapor that the duct to the condenser carries at a chamber pressure: sonic flow of an ideal
    gas, heat-capacity ratio 1.33.

    Beyond it the pressure can no longer be controlled. The discharge coefficient falls with the length of the
    duct: about 0.9 for two and 0.75 for five diameters of a smooth duct, less with baffles.

    By hand: 10 Pa on 1 m² at 300 K without loss is 10·√(1.33/(461.5·300))·0.5826 = 18.1 g/s.

    A coefficient of 1 is the duct without loss.

    >>> round(choked_flow_rate(10.0, (4 / 3.141592653589793) ** 0.5, 300.0, 1.0) * 1e3, 1)
    18.1
    """
    gamma = 1.33
    sonic = jnp.sqrt(gamma * 0.018015268 / (GAS_CONSTANT * temperature)) * (2.0 / (gamma + 1.0)) ** (
        (gamma + 1.0) / (2.0 * (gamma - 1.0))
    )
    return discharge_coefficient * jnp.pi / 4.0 * duct_diameter**2 * pressure_chamber * sonic


@formula(
    source="pikal1990; fissore2011",
    equation=(
        r"\int_0^{t_2} k_d\,e^{-\frac{E}{R}\left(\frac{1}{T_{sh}} - \frac{1}{T_r}\right)}\,dt = "
        r"\ln\frac{X_0 - X_e}{X - X_e}"
    ),
    typical={
        "moisture_dry_basis_inlet": (0.15, 0.25),
        "moisture_dry_basis_outlet": (0.01, 0.03),
        "moisture_dry_basis_equilibrium": (0.0, 0.005),
        "temperature_shelf": (293.0, 313.0),
        "temperature_shelf_start": (255.0, 265.0),
        "ramp_rate": (1e-3, 5e-3),
        "desorption_rate": (1e-5, 1e-4),
        "activation_energy": (3e4, 5e4),
    },
    title="Time of secondary drying",
    symbols={
        "moisture_dry_basis_inlet": "X_0",
        "moisture_dry_basis_outlet": "X",
        "moisture_dry_basis_equilibrium": "X_e",
        "temperature_shelf_start": "T_{sh,0}",
    },
)
def secondary_drying_time(
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_dry_basis_outlet: MoistureDryBasis,
    temperature_shelf: Temperature,
    desorption_rate: Frequency,
    activation_energy: MolarEnergy = 4e4,
    moisture_dry_basis_equilibrium: MoistureDryBasis = 0.0,
    temperature_shelf_start: Temperature = 253.15,
    ramp_rate: TemperatureRate = 0.1 / 60.0,
    reference_temperature: Temperature = 293.15,
) -> Time:
    """Time to desorb the water that did not freeze, first order in the moisture above equilibrium, the
    product being as warm as the shelf.

    ``desorption_rate`` holds at the reference temperature. The shelf warms at the ramp rate and is then held.

    Held from the start, from 0.2 to 0.02 at 1e-4 1/s: ln(10)/1e-4 = 23 026 s.

    >>> round(secondary_drying_time(0.2, 0.02, 293.15, 1e-4, temperature_shelf_start=293.15))
    23026
    """
    X0, X, Xe = moisture_dry_basis_inlet, moisture_dry_basis_outlet, moisture_dry_basis_equilibrium
    possible = (Xe < X) & (X0 > X)
    flags.impossible(~possible, X, "moisture_dry_basis_outlet", Xe, X0)
    needed = jnp.log(jnp.where(possible, X0 - Xe, 1.0) / jnp.where(possible, X - Xe, 1.0))

    def rate(T: Any) -> Any:
        return desorption_rate * jnp.exp(
            activation_energy / GAS_CONSTANT * (1.0 / reference_temperature - 1.0 / T)
        )

    start, end = (
        jnp.asarray(temperature_shelf_start, dtype=float),
        jnp.asarray(temperature_shelf, dtype=float),
    )
    warming = jnp.abs(end - start) / ramp_rate

    def reached(t: Any) -> Any:
        """Integral of the rate over the warming up to a time."""
        share = jnp.where(warming > 0, t / jnp.where(warming > 0, warming, 1.0), 0.0)
        return t * gauss_legendre(
            lambda x: rate(start + (end - start) * share * x),
            jnp.zeros_like(share),
            jnp.ones_like(share),
            order=12,
        )

    during = reached(warming)
    held = warming + (needed - during) / rate(end)
    early = find_root(lambda t: reached(t) - needed, 0.0, jnp.maximum(warming, 1e-9)).value
    return jnp.where(possible, jnp.where(needed >= during, held, early), jnp.nan)
