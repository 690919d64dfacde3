"""Heat that a web takes besides that of gas, as laws: infrared emitters, and the field of radio waves or
microwaves.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import (
    Fraction,
    Frequency,
    HeatFlux,
    Length,
    MoistureDryBasis,
    OpenFraction,
    PositiveNumber,
    Ratio,
    Temperature,
)
from granum.drying.formulas.heat import dielectric_power_density, heat_duty_radiation, penetration_depth
from granum.drying.kinds import ElectricField

LEAST_LOSS = 1e-6  # of a product that is dry, so that its depth of penetration stays a number


class AbstractRadiantHeat(eqx.Module):
    """Heats a web without touching it."""

    @abstractmethod
    def absorbed(self, X: Any, T: Any) -> Any:
        """Heat that the web takes, W/m² of web, at a moisture and a temperature."""

    def __call__(
        self, moisture_dry_basis: MoistureDryBasis = 0.5, temperature: Temperature = 350.0
    ) -> HeatFlux:
        return self.absorbed(moisture_dry_basis, temperature)


@law(
    "radiant_heat",
    name="infrared_emitter",
    source="keey1978; incropera2007",
    title="Infrared emitters",
    equation=r"q = n\,\frac{F\,\sigma\,(T_r^4 - T^4)}{1/\varepsilon_1 + 1/\varepsilon_2 - 1}",
)
class InfraredEmitter(AbstractRadiantHeat):
    """Emitters of a temperature opposite the web, on one side or on both, gray and as large as the web.

    ``view_factor`` is the share of what they emit that meets the web; ``electric_efficiency`` what reaches
    the web as heat of what the mains give. By hand, black surfaces at 1000 and 300 K: 56.24 kW/m².

    >>> emitter = InfraredEmitter(
    ...     radiator_temperature=1000.0, emissivity_radiator=1.0, emissivity_product=1.0, view_factor=1.0
    ... )
    >>> round(float(emitter.absorbed(0.5, 300.0)) / 1e3, 2)
    56.24
    """

    radiator_temperature: Temperature
    emissivity_radiator: Fraction = 0.85
    emissivity_product: Fraction = 0.9
    view_factor: Fraction = 0.8
    sides: PositiveNumber = 1.0
    electric_efficiency: OpenFraction = 0.5

    def absorbed(self, X: Any, T: Any) -> Any:
        return (
            self.sides
            * heat_duty_radiation.function(
                self.radiator_temperature,
                T,
                1.0,
                1.0,
                jnp.maximum(self.emissivity_product, 1e-9),
                jnp.maximum(self.emissivity_radiator, 1e-9),
                self.view_factor,
            )
            + 0.0 * X
        )


@law(
    "radiant_heat",
    name="dielectric_field",
    source="metaxas1983",
    title="Radio-frequency or microwave field",
    equation=(
        r"q = 2\pi f\,\varepsilon_0\,\varepsilon''\,E^2\,D_p\left(1 - e^{-L/D_p}\right),\quad "
        r"\varepsilon'' = \varepsilon''_0 + \varepsilon''_1\,X"
    ),
)
class DielectricField(AbstractRadiantHeat):
    """A field of known strength at the surface, which decays in the web over its penetration depth (hardly so
    with radio waves); the loss factor grows with the moisture, so that wet places are heated more.

    ``electric_efficiency`` is what the web takes of what the mains give. By hand, 27.12 MHz, ε'' 1, 50 kV/m
    in 1 mm: 0.556e-10 · 2.712e7 · 2.5e9 · 1e-3 = 3.77 kW/m².

    >>> field = DielectricField("27.12 MHz", "50 kV/m", "1 mm", loss_factor_dry=0.5, loss_factor_slope=1.0)
    >>> round(float(field.absorbed(0.5, 350.0)) / 1e3, 2)
    3.77
    """

    frequency: Frequency
    electric_field: ElectricField
    thickness: Length
    dielectric_constant: PositiveNumber = 5.0
    loss_factor_dry: Ratio = 0.05
    loss_factor_slope: Ratio = 1.0
    electric_efficiency: OpenFraction = 0.6

    def absorbed(self, X: Any, T: Any) -> Any:
        loss = self.loss_factor_dry + self.loss_factor_slope * jnp.maximum(X, 0.0) + LEAST_LOSS
        depth = penetration_depth.function(self.frequency, self.dielectric_constant, loss)
        power = dielectric_power_density.function(self.frequency, loss, self.electric_field)
        return power * depth * -jnp.expm1(-self.thickness / depth) + 0.0 * T
