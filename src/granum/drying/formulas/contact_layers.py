"""A resting layer on a hot plate that boils behind a drying front, as on the shelves of a vacuum dryer."""

from __future__ import annotations

from typing import NamedTuple

import jax.numpy as jnp

from granum.core import formula, impossible
from granum.core.kinds import (
    Density,
    HeatCapacity,
    HeatTransferCoefficient,
    Length,
    MassFlux,
    MoistureDryBasis,
    SpecificEnergy,
    Temperature,
    ThermalConductivity,
    Time,
)
from granum.numerics import safe_divide

HOTTEST = 1000.0  # K
COLD_PLATE = "The plate must be hotter than the layer boils."


class ContactLayer(NamedTuple):
    """Time to dry, what evaporates at the start and at the end, and the temperature at the plate then."""

    drying_time: Time
    drying_flux_inlet: MassFlux
    drying_flux_outlet: MassFlux
    temperature_bottom: Temperature


@formula(
    source="mollekopf1984",
    equation=(
        r"z = L\left(1 - \frac{X_2}{X_1}\right),\quad r = \frac1h,\quad w = \frac zk,\quad "
        r"t = \frac{\rho_b X_1\,L_v}{T_w - T_b}\left(\frac zh + \frac{z^2}{2k}\right) + "
        r"\frac{\rho_b c_p k}{2}\left(\frac{w^2}{2} + r w - r^2\ln\frac{r + w}{r}\right)"
    ),
    typical={
        "thickness": (0.01, 0.05),
        "bulk_density_dry": (300.0, 1000.0),
        "moisture_dry_basis_inlet": (0.2, 2.0),
        "moisture_outlet": (0.0, 0.05),
        "wall_temperature": (323.0, 393.0),
        "temperature_bed": (285.0, 318.0),
        "heat_transfer_coefficient": (30.0, 200.0),
        "thermal_conductivity_dry": (0.1, 0.5),
        "heat_of_vaporization": (2.3e6, 2.5e6),
    },
    title="Contact drying of a resting layer",
    symbols={
        "thickness": "L",
        "temperature_bed": "T_b",
        "wall_temperature": "T_w",
        "moisture_dry_basis_inlet": "X_1",
        "moisture_outlet": "X_2",
        "thermal_conductivity_dry": "k",
        "heat_transfer_coefficient": "h",
    },
)
def contact_layer_drying(
    thickness: Length,
    bulk_density_dry: Density,
    moisture_dry_basis_inlet: MoistureDryBasis,
    moisture_outlet: MoistureDryBasis,
    wall_temperature: Temperature,
    temperature_bed: Temperature,
    heat_transfer_coefficient: HeatTransferCoefficient,
    thermal_conductivity_dry: ThermalConductivity,
    heat_of_vaporization: SpecificEnergy,
    specific_heat_capacity: HeatCapacity = 1000.0,
) -> ContactLayer:
    """A wet layer lies still on a plate; a front runs up from it, dry below and boiling above, and its heat
    passes the contact and the dry part.

    The front is slow, so that the dry part has a straight profile; what warms it is counted. Vapor leaves
    upwards through the wet part without resistance, and nothing evaporates from the top by itself. It comes
    near Neumann's solution, on which the law of a bed at rest by Schlünder and Mollekopf stands. Source not
    opened; derived from the balance of heat at the front.

    By hand: 2 cm of 500 kg/m³ with 0.5 of water, 60 K, 100 W/(m² K), 0.2 W/(m K), without warming:
    500·0.5·2.4e6/60·(2e-4 + 1e-3) s.

    >>> round(contact_layer_drying(0.02, 500.0, 0.5, 0.0, 370.0, 310.0, 100.0, 0.2, 2.4e6, 1e-6).drying_time)
    12000
    """
    X1, X2 = moisture_dry_basis_inlet, moisture_outlet
    cold = wall_temperature <= temperature_bed
    impossible(cold, wall_temperature, "wall_temperature", temperature_bed, jnp.inf, COLD_PLATE)
    span = jnp.where(cold, 1.0, wall_temperature - temperature_bed)
    z = thickness * jnp.clip(1.0 - safe_divide(X2, X1, 1.0), 0.0, 1.0)
    k, r = thermal_conductivity_dry, 1.0 / heat_transfer_coefficient
    w = z / k
    evaporates = bulk_density_dry * X1 * heat_of_vaporization / span * (z * r + 0.5 * z * w)
    warms = (
        0.5 * bulk_density_dry * specific_heat_capacity * k * (0.5 * w**2 + r * w - r**2 * jnp.log1p(w / r))
    )
    end = span / (r + w)
    bottom = wall_temperature - r * end
    latent = X1 * heat_of_vaporization
    # at the end part of the heat warms the dry part: as much as goes into it while the front moves on
    sensible = 0.5 * specific_heat_capacity * span * w * (w + 2.0 * r) / (r + w) ** 2
    found = evaporates + warms
    return ContactLayer(
        jnp.where(cold, jnp.nan, found),
        span / r / heat_of_vaporization,
        end / heat_of_vaporization * latent / (latent + sensible),
        bottom,
    )
