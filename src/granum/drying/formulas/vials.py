"""A vial in freeze drying: heat to it, resistance of its dry cake, and its sublimation from moment to
moment.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Area,
    Concentration,
    Density,
    Distance,
    HeatTransferCoefficient,
    Length,
    Pressure,
    Volume,
)
from granum.drying.kinds import (
    HeatTransferPerPressure,
    PerLength,
    PerPressure,
    VaporResistance,
    VaporResistanceGradient,
)
from granum.humid_gas.pairs import ice_vapor_pressure
from granum.numerics import find_root
from granum.numerics.quadrature import gauss_legendre

ICE_DENSITY, WATER_DENSITY = 918.0, 1000.0
SUBLIMATION_HEAT = 678.0 * 4184.0  # J/kg
ICE_CONDUCTIVITY = 0.0059 * 418.4  # W/(m K)
COLDEST, WARMEST = 150.0, 400.0  # K, between which the sublimation temperature is sought
RAMP_STEPS, NODES = 24, 16
MODEL = "pikal1985; shivkumar2019"


@formula(source=MODEL, equation=r"K_v = K_C + \frac{K_P\,P_c}{1 + K_D\,P_c}", title="Heat transfer to a vial")
def vial_heat_transfer(
    pressure_chamber: Pressure,
    vial_coefficient_contact: HeatTransferCoefficient,
    vial_coefficient_gas: HeatTransferPerPressure,
    vial_coefficient_saturation: PerPressure = 0.0,
) -> HeatTransferCoefficient:
    """Coefficient from shelf to vial: contact and radiation, and conduction by the gas in the gap, which
    grows with pressure and levels off.

    Shivkumar et al., example: 2.75e-4 + 8.93e-4·0.15/(1 + 0.46·0.15) = 4.0e-4 cal/(s K cm²), that is
    16.75 W/(m² K).

    >>> K = vial_heat_transfer(
    ...     "150 mtorr", "2.75e-4 cal/(s*K*cm^2)", "8.93e-4 cal/(s*K*cm^2*torr)", "0.46 1/torr"
    ... )
    >>> round(K, 2)
    16.75
    """
    return vial_coefficient_contact + vial_coefficient_gas * pressure_chamber / (
        1.0 + vial_coefficient_saturation * pressure_chamber
    )


@formula(
    source=MODEL, equation=r"R_p = R_0 + \frac{A_1 L}{1 + A_2 L}", title="Resistance of a dry cake to vapor"
)
def cake_vapor_resistance(
    dry_layer_thickness: Distance,
    vapor_resistance: VaporResistance,
    vapor_resistance_slope: VaporResistanceGradient = 0.0,
    vapor_resistance_saturation: PerLength = 0.0,
) -> VaporResistance:
    """Resistance to vapor, times the area, of the cake that has dried from the top down to a depth.

    By hand, 1.4 + 16·0.5 = 9.4 cm² h Torr/g; one of these is 4.7996e4 m/s.

    >>> R = cake_vapor_resistance("5 mm", "1.4 cm^2*hour*torr/g", "16 cm*hour*torr/g")
    >>> round(R / 1e3, 1)
    451.2
    """
    return vapor_resistance + vapor_resistance_slope * dry_layer_thickness / (
        1.0 + vapor_resistance_saturation * dry_layer_thickness
    )


@formula(
    source=MODEL,
    equation=r"L_0 = \frac{V_f}{A_p\rho_i}\left[\rho_w - \frac{c\,(\rho_w-\rho_i)}{\rho_s}\right]",
    title="Height of a frozen fill",
    typical={
        "volume_fill": (1e-6, 5e-6),
        "area_product": (2e-4, 4e-4),
        "concentration": (20.0, 150.0),
        "solid_density": (1400.0, 1600.0),
    },
)
def frozen_height(
    volume_fill: Volume, area_product: Area, concentration: Concentration, solid_density: Density = 1500.0
) -> Length:
    """Height of the frozen product in a vial; the solute keeps its volume, the water grows as it freezes.

    Shivkumar et al., example: 2 mL of a 5 % solution on 3.14 cm².

    >>> round(frozen_height("2 mL", "3.14 cm^2", "0.05 g/mL") * 100, 4)
    0.6919
    """
    impossible(concentration >= solid_density, concentration, "concentration", 0.0, solid_density)
    return (
        volume_fill
        / (area_product * ICE_DENSITY)
        * (WATER_DENSITY - concentration * (WATER_DENSITY - ICE_DENSITY) / solid_density)
    )


class Vial(NamedTuple):
    """One vial, or arrays of vials, and the pressure around it, SI."""

    area: Any
    area_product: Any
    height: Any
    ice_per_height: Any
    heat_transfer: Any
    resistance: Any
    resistance_slope: Any
    resistance_saturation: Any
    pressure: Any

    def resistance_at(self, L: Any) -> Any:
        """Resistance of the cake at a dry depth."""
        return self.resistance + self.resistance_slope * L / (1.0 + self.resistance_saturation * L)

    def sublimation(self, shelf: Any, L: Any, guess: Any = None) -> tuple[Any, Any, Any]:
        """Mass flux and temperatures of ice front and vial bottom: heat through bottom and ice equals heat of
        sublimation.

        Vapor does not freeze back onto the product: without a driving pressure the flux is zero.
        """
        R = self.resistance_at(L)
        thermal = self.area_product / (self.heat_transfer * self.area) + (self.height - L) / ICE_CONDUCTIVITY
        share = R / (SUBLIMATION_HEAT * thermal)

        def balance(T: Any) -> Any:
            return ice_vapor_pressure(T) - self.pressure - share * (shelf - T)

        T = find_root(balance, COLDEST, WARMEST, start=guess, tolerance=1e-12).value
        flux = jnp.maximum(ice_vapor_pressure(T) - self.pressure, 0.0) / R
        return flux, T, T + SUBLIMATION_HEAT * flux * (self.height - L) / ICE_CONDUCTIVITY


def vial_of(
    area: Any,
    area_product: Any,
    volume: Any,
    concentration: Any,
    solid_density: Any,
    contact: Any,
    gas: Any,
    saturation: Any,
    R0: Any,
    A1: Any,
    A2: Any,
    pressure: Any,
) -> Vial:
    """The vial of named parameters."""
    height = frozen_height.function(volume, area_product, concentration, solid_density)
    ice = volume * WATER_DENSITY * (1.0 - concentration / solid_density)
    K = vial_heat_transfer.function(pressure, contact, gas, saturation)
    return Vial(area, area_product, height, ice / (area_product * height), K, R0, A1, A2, pressure)


class History(NamedTuple):
    """Points of a primary drying: time, depth, shelf, front, bottom and flux."""

    time: Any
    depth: Any
    shelf: Any
    front: Any
    bottom: Any
    flux: Any


def dry(vial: Vial, shelf_start: Any, shelf: Any, ramp_rate: Any) -> tuple[Any, History]:
    """Primary drying time and history: stepped in time while the shelf warms, then integrated over the depth,
    which needs no steps.

    At constant shelf temperature the time is the integral of dL/(dL/dt), of which Gauss and Legendre's rule
    gives ten digits.
    """
    shape = jnp.broadcast_shapes(*(jnp.shape(x) for x in (*vial, shelf_start, shelf, ramp_rate)))
    L0, zero = jnp.broadcast_to(vial.height, shape), jnp.zeros(shape)
    warming = jnp.abs(shelf - shelf_start) / ramp_rate
    h = warming / RAMP_STEPS

    def speed(t: Any, L: Any, guess: Any) -> tuple[Any, Any, Any]:
        at = shelf_start + (shelf - shelf_start) * jnp.where(
            warming > 0, t / jnp.where(warming > 0, warming, 1.0), 1.0
        )
        flux, front, bottom = vial.sublimation(at, jnp.minimum(L, L0), guess)
        return flux / vial.ice_per_height, front, (at, front, bottom, flux)

    def step(carry: Any, k: Any) -> tuple[Any, Any]:
        L, guess, end = carry
        t = k * h
        a, front, state = speed(t, L, guess)
        b, mid, _s = speed(t + h / 2, L + h / 2 * a, front)
        c, _mid, _s = speed(t + h / 2, L + h / 2 * b, mid)
        d, last, _s = speed(t + h, L + h * c, mid)
        ahead = L + h / 6 * (a + 2 * b + 2 * c + d)
        crossing = (ahead >= L0) & (L < L0)
        share = (L0 - L) / jnp.where(crossing, ahead - L, 1.0)
        return (ahead, last, jnp.where(crossing, t + share * h, end)), (
            t + zero,
            jnp.minimum(L, L0),
            *(x + zero for x in state),
        )

    first = (zero, jnp.minimum(shelf_start + zero, 272.0) - 5.0, zero + jnp.nan)
    (L1, guess, early), points = jax.lax.scan(step, first, jnp.arange(RAMP_STEPS, dtype=float))
    L1 = jnp.minimum(L1, L0)

    def slowness(L: Any) -> Any:
        flux = vial.sublimation(shelf, L, guess)[0]
        return vial.ice_per_height / jnp.where(flux > 0, flux, jnp.nan)

    rest = gauss_legendre(slowness, L1, L0, order=NODES)
    total = jnp.where(jnp.isfinite(early), early, warming + rest)
    # the same times at even depths, for the history: a rule between each two of them
    share = jnp.linspace(0.0, 1.0, NODES + 1).reshape((-1,) + (1,) * len(shape))
    depths = L1 + (L0 - L1) * share
    pieces = gauss_legendre(slowness, depths[:-1], depths[1:], order=3)
    times = warming + jnp.concatenate([jnp.zeros((1, *shape)), jnp.cumsum(pieces, axis=0)])
    flux, front, bottom = vial.sublimation(shelf, depths, guess)
    later = (times, depths, shelf + 0.0 * depths, front, bottom, flux)
    whole = (jnp.concatenate([a, b]) for a, b in zip(points, later, strict=True))
    return total, History(*whole)
