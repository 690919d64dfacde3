"""Isotherm of paper, which gives the water activity and needs a search for the moisture."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.constants import ZERO_CELSIUS
from granum.core.kinds import MoistureDryBasis, Temperature, WaterActivity
from granum.drying.isotherms.base import ROOM, AbstractIsotherm, bounded
from granum.numerics import find_root

WETTEST = 2.0  # kg/kg, far beyond what paper holds at a water activity of 1 − 1e-9


@law(
    "isotherm",
    name="isotherm_heikkila",
    source="heikkila1993; karlsson2000",
    fitted={"water_activity": (0.05, 0.98), "temperature": (283.15, 393.15)},
    title="Isotherm of paper (Heikkilä)",
    equation=r"a = 1 - \exp\left(-47.58\,X^{1.877} - 0.10085\,t\,X^{1.0585}\right)",
)
class Heikkila(AbstractIsotherm):
    """Desorption of paper from pulps of several sorts, over temperature in °C.

    The constants are recalled, not opened. At 23 °C and 50 % it holds 9 % of water, near the 6 to 9 % that
    papers are known for.

    >>> round(float(Heikkila()(0.5, 296.15)), 3)
    0.09
    """

    curve: ClassVar[str] = "heikkila"

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)

    def _exponent(self, X: Any, T: Any) -> Any:
        X, t = jnp.maximum(X, 1e-30), jnp.maximum(jnp.asarray(T) - ZERO_CELSIUS, 0.0)
        return 47.58 * X**1.877 + 0.10085 * t * X**1.0585

    def moisture(self, a: Any, T: Any) -> Any:
        wanted, T = jnp.broadcast_arrays(-jnp.log1p(-bounded(a)), jnp.asarray(T, dtype=float))
        start = (wanted / 80.0) ** 0.6
        return find_root(
            lambda X, wanted, T: jnp.log(self._exponent(X, T)) - jnp.log(wanted),
            1e-12,
            WETTEST,
            wanted,
            T,
            start=start,
            tolerance=1e-12,
        ).value

    def activity(self, X: Any, T: Any) -> Any:
        return bounded(-jnp.expm1(-self._exponent(X, T)))
