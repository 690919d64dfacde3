"""Characteristic drying curves: relative rate f over characteristic moisture Φ = (X − X_e)/(X_c − X_e)."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Fraction, PositiveNumber


class AbstractCharacteristicCurve(eqx.Module):
    """f(Φ), 1 at the critical moisture and above, 0 at equilibrium."""

    @abstractmethod
    def rate(self, phi: Any) -> Any:
        """Relative drying rate."""


@law(
    "characteristic_rate",
    name="characteristic_power",
    source="vanmeel1958",
    title="Characteristic curve, power",
    equation=r"f = \Phi^{\,n}",
)
class PowerCurve(AbstractCharacteristicCurve):
    """Power of the characteristic moisture: n = 1 is the straight line, below 1 coarse capillary solids,
    above 1 hygroscopic ones.

    >>> float(PowerCurve(2.0)(0.5))
    0.25
    """

    characteristic_exponent: PositiveNumber = 1.0

    def __call__(self, characteristic_moisture: Fraction) -> Fraction:
        return self.rate(characteristic_moisture)

    def rate(self, phi: Any) -> Any:
        return jnp.clip(phi, 1e-30, 1.0) ** self.characteristic_exponent


@law(
    "characteristic_rate",
    name="characteristic_hyperbolic",
    source="burgschweiger1999",
    title="Characteristic curve, one-parameter hyperbola",
    equation=r"f = \frac{k\,\Phi}{1 + \Phi\,(k-1)}",
)
class HyperbolicCurve(AbstractCharacteristicCurve):
    """Hyperbola with one parameter: k = 1 is the straight line, above 1 the rate falls late.

    >>> round(float(HyperbolicCurve(3.5)(0.5)), 4)
    0.7778
    """

    characteristic_parameter: PositiveNumber = 3.5

    def __call__(self, characteristic_moisture: Fraction) -> Fraction:
        return self.rate(characteristic_moisture)

    def rate(self, phi: Any) -> Any:
        phi, k = jnp.clip(phi, 0.0, 1.0), self.characteristic_parameter
        return k * phi / (1.0 + phi * (k - 1.0))


CHARACTERISTIC_LINEAR = PowerCurve(1.0)
