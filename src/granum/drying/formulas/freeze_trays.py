"""Sublimation of a frozen layer on a tray that is heated from above and from below."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.constants import STEFAN_BOLTZMANN
from granum.core.kinds import (
    Concentration,
    Fraction,
    Length,
    MassFlux,
    Pressure,
    Temperature,
    ThermalConductivity,
    Time,
)
from granum.drying.formulas.freeze_drying import COLD
from granum.drying.formulas.vials import COLDEST, NODES, SUBLIMATION_HEAT
from granum.drying.kinds import AddedHeatTransferCoefficient, VaporPermeability
from granum.humid_gas.pairs import ice_vapor_pressure
from granum.numerics import find_root
from granum.numerics.quadrature import gauss_legendre


class TrayDrying(NamedTuple):
    """Sublimation of a layer on a tray."""

    drying_time: Time
    temperature_front: Temperature
    temperature_bottom: Temperature
    surface_temperature: Temperature
    sublimation_flux: MassFlux
    sublimation_flux_highest: MassFlux


class Layer(NamedTuple):
    """A frozen layer between two shelves of one temperature, SI."""

    shelf: Any
    pressure: Any
    thickness: Any
    dry_conductivity: Any
    frozen_conductivity: Any
    permeability: Any
    emissivity: Any
    contact: Any

    def radiated(self, surface: Any) -> Any:
        """Heat that the dry surface gets from the shelf above, W/m²."""
        return self.emissivity * STEFAN_BOLTZMANN * (self.shelf**4 - surface**4)

    def at(self, depth: Any) -> tuple[Any, Any, Any, Any]:
        """Temperatures of surface, front and bottom, and the flux, with the front at a depth.

        The surface temperature is the one unknown: the front follows from what the surface passes on.
        """
        x, below = depth, self.thickness - depth
        from_below = self.contact / (1.0 + self.contact * below / self.frozen_conductivity)

        def state(surface: Any) -> tuple[Any, Any, Any]:
            above = self.radiated(surface)
            front = surface - above * x / self.dry_conductivity
            conducted = from_below * (self.shelf - front)
            return front, above + conducted, conducted

        def balance(surface: Any) -> Any:
            front, heat, _conducted = state(surface)
            driving = ice_vapor_pressure(jnp.maximum(front, 0.5 * COLDEST)) - self.pressure
            return SUBLIMATION_HEAT * self.permeability * driving - heat * x

        low = jnp.minimum(COLDEST, 0.9 * self.shelf)
        surface = find_root(
            balance, low, self.shelf + 0.0 * x, start=self.shelf - 20.0, tolerance=1e-12
        ).value
        front, heat, conducted = state(surface)
        return surface, front, front + conducted * below / self.frozen_conductivity, heat / SUBLIMATION_HEAT


@formula(
    source="king1971; pikal1985; iapws2011melting",
    fitted={"temperature_front": (150.0, 273.16)},
    equation=(
        r"\Delta H_s\,g = q_1 + q_2,\quad "
        r"q_1 = \varepsilon\sigma\,(T_{sh}^4 - T_s^4) = \frac{\lambda_d}{x}(T_s - T_f),\quad "
        r"q_2 = \frac{T_{sh} - T_f}{1/U_k + (L-x)/\lambda_f},\quad "
        r"g = \frac{b}{x}\,[p_i(T_f) - P_c],\quad t = \rho_i\int_0^L\frac{dx}{g},\quad "
        r"T_b = T_f + q_2\frac{L-x}{\lambda_f}"
    ),
    typical={
        "temperature_shelf": (310.0, 350.0),
        "pressure_chamber": (20.0, 100.0),
        "thickness": (5e-3, 3e-2),
        "ice_concentration": (400.0, 800.0),
        "thermal_conductivity_dry": (0.03, 0.15),
        "vapor_permeability": (1e-8, 5e-8),
        "thermal_conductivity_frozen": (1.0, 2.0),
        "emissivity": (0.7, 0.95),
        "conduction_coefficient": (0.0, 20.0),
    },
    symbols={
        "temperature_front": "T_f",
        "temperature_bottom": "T_b",
        "thermal_conductivity_dry": r"\lambda_d",
        "thermal_conductivity_frozen": r"\lambda_f",
        "drying_time": "t",
    },
    output="freeze_drying_tray",
    title="Freeze drying of a layer on a tray",
)
def freeze_drying_tray(
    temperature_shelf: Temperature,
    pressure_chamber: Pressure,
    thickness: Length,
    ice_concentration: Concentration,
    thermal_conductivity_dry: ThermalConductivity,
    vapor_permeability: VaporPermeability,
    thermal_conductivity_frozen: ThermalConductivity = 1.5,
    emissivity: Fraction = 0.9,
    conduction_coefficient: AddedHeatTransferCoefficient = 5.0,
) -> TrayDrying:
    """Time for the ice front to run down through a frozen layer between two shelves of the same temperature,
    and the highest temperatures on the way.

    The shelf above radiates to the dry surface, and this heat passes through the dry layer; the shelf below
    heats the tray by ``conduction_coefficient`` (some 5 W/(m² K) where trays hang free and only radiation
    reaches them, 10 to 20 on shelves), and this heat passes through the ice. Vapor leaves through the dry
    layer. Steady from moment to moment; the layer keeps its thickness; conduction of the thin gas above and
    heat taken up by the vapor on its way are left out. ``emissivity`` is that of the pair. No value where the
    shelf is too cold for ice to sublime.

    >>> tray = freeze_drying_tray("20 degC", "100 ubar", "10 mm", 500.0, 0.035, "2e-8 kg/(m*s*Pa)")
    >>> bool(0.0 < tray.sublimation_flux < tray.sublimation_flux_highest)
    True

    A thick layer without heat from below is King's slab (``freeze_drying_slab``) with the shelf at its
    surface: his coffee extract, 30 °C and 97 µm Hg, has its front at −29.4 °C by his chart.

    >>> thick = freeze_drying_tray(
    ...     "30 degC",
    ...     "0.097 mmHg",
    ...     1.0,
    ...     500.0,
    ...     0.035,
    ...     3.5e-9 / 0.133322,
    ...     emissivity=1.0,
    ...     conduction_coefficient=0.0,
    ... )
    >>> round(thick.temperature_front - 273.15, 1)
    -29.3
    """
    layer = Layer(
        jnp.asarray(temperature_shelf, dtype=float),
        pressure_chamber,
        thickness,
        thermal_conductivity_dry,
        thermal_conductivity_frozen,
        vapor_permeability,
        emissivity,
        conduction_coefficient,
    )
    warm = (emissivity > 0.0) | (conduction_coefficient > 0.0)
    subliming = (ice_vapor_pressure(layer.shelf) > pressure_chamber) & warm
    impossible(~subliming, temperature_shelf, "temperature_shelf", reason=COLD)

    def slowness(x: Any) -> Any:
        flux = layer.at(x)[3]
        return 1.0 / jnp.where(flux > 0.0, flux, jnp.nan)

    shape = jnp.broadcast_shapes(*(jnp.shape(part) for part in layer))
    L = jnp.broadcast_to(jnp.asarray(thickness, dtype=float), shape)
    resistance = gauss_legendre(slowness, jnp.zeros(shape), L, order=NODES)
    places = jnp.linspace(0.0, 1.0, NODES + 1).reshape((-1,) + (1,) * len(shape)) * L
    surface, front, bottom, flux = (jnp.where(subliming, part, jnp.nan) for part in layer.at(places))
    return TrayDrying(
        ice_concentration * resistance,
        jnp.max(front, axis=0),
        jnp.max(bottom, axis=0),
        jnp.max(surface, axis=0),
        L / resistance,
        jnp.max(flux, axis=0),
    )
