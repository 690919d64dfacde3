"""Isotherms from adsorption theory: BET, n-layer BET, GAB, Hailwood–Horrobin."""

from __future__ import annotations

from typing import Any, ClassVar

import jax.numpy as jnp

from granum.core import law
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.kinds import MoistureDryBasis, MolarEnergy, PositiveNumber, Temperature, WaterActivity
from granum.drying.isotherms.base import ROOM, AbstractIsotherm, activity_by_search, bounded


def _langmuir_like(u: Any, m: Any, C: Any) -> Any:
    return m * C * u / ((1.0 - u) * (1.0 - u + C * u))


def _langmuir_like_inverse(X: Any, m: Any, C: Any) -> Any:
    """The root u of (C − 1) X u² + (m C − (C − 2) X) u − X = 0 that lies between 0 and 1, without
    cancellation.
    """
    b = m * C - (C - 2.0) * X
    return 2.0 * X / (b + jnp.sqrt(jnp.maximum(b * b + 4.0 * (C - 1.0) * X * X, 1e-300)))


@law(
    "isotherm",
    name="isotherm_bet",
    source="brunauer1938; andrade2011",
    fitted={"water_activity": (0.05, 0.5)},
    title="BET isotherm",
    equation=r"X = \frac{m\,C\,a}{(1-a)(1-a+C\,a)}",
    symbols={"monolayer_moisture": "m", "water_activity": "a"},
)
class Bet(AbstractIsotherm):
    """Brunauer, Emmett and Teller: a monolayer of bound water and layers of free water above it. Holds up to
    a water activity of 0.5.

    The lower end of 0.05 is that of the review of Andrade and others, which ends at 0.45.

    >>> round(float(Bet(monolayer_moisture=0.05, monolayer_constant=10.0)(0.3)), 4)
    0.0579
    """

    curve: ClassVar[str] = "bet"
    monolayer_moisture: MoistureDryBasis
    monolayer_constant: PositiveNumber

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)

    def moisture(self, a: Any, T: Any) -> Any:
        return _langmuir_like(bounded(a), self.monolayer_moisture, self.monolayer_constant)

    def activity(self, X: Any, T: Any) -> Any:
        return _langmuir_like_inverse(X, self.monolayer_moisture, self.monolayer_constant)


@law(
    "isotherm",
    name="isotherm_bet_layers",
    source="brunauer1938",
    title="BET isotherm with a finite number of layers",
    equation=r"X = \frac{m\,C\,a}{1-a}\,\frac{1-(n+1)a^n+n\,a^{n+1}}{1+(C-1)a-C\,a^{n+1}}",
    symbols={"monolayer_moisture": "m", "water_activity": "a"},
)
class BetLayers(AbstractIsotherm):
    """BET isotherm whose layers stop at a number n: one layer is Langmuir's isotherm, infinitely many the
    simple BET.

    >>> round(float(BetLayers(monolayer_moisture=0.05, monolayer_constant=10.0, layer_count=60.0)(0.3)), 4)
    0.0579
    """

    curve: ClassVar[str] = "bet_layers"
    monolayer_moisture: MoistureDryBasis
    monolayer_constant: PositiveNumber
    layer_count: PositiveNumber

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)

    def moisture(self, a: Any, T: Any) -> Any:
        a, n, C = bounded(a), self.layer_count, self.monolayer_constant
        top = 1.0 - (n + 1.0) * a**n + n * a ** (n + 1.0)
        return self.monolayer_moisture * C * a / (1.0 - a) * top / (1.0 + (C - 1.0) * a - C * a ** (n + 1.0))

    def activity(self, X: Any, T: Any) -> Any:
        return activity_by_search(self, X, T, highest=0.999)


@law(
    "isotherm",
    name="isotherm_gab",
    source="vandenberg1981",
    fitted={"water_activity": (0.0, 0.95)},
    title="GAB isotherm",
    equation=(
        r"X = \frac{m\,C\,K a}{(1-Ka)(1-Ka+C\,Ka)},\quad m = m_0 e^{H_m/RT},\ C = C_0 e^{H_C/RT},\ K = K_0 "
        r"e^{H_K/RT}"
    ),
    symbols={
        "monolayer_moisture": "m_0",
        "monolayer_constant": "C_0",
        "multilayer_constant": "K_0",
        "water_activity": "a",
    },
)
class Gab(AbstractIsotherm):
    """Guggenheim, Anderson and de Boer: BET with multilayer water bound differently from free water; to a
    water activity of 0.95.

    The energies carry the temperature; zero, the default, leaves the constants as they are. Moistures beyond
    the pole at K a = 1 do not exist.

    >>> round(
    ...     float(Gab(monolayer_moisture=0.209, monolayer_constant=4.416, multilayer_constant=0.976)(0.5)), 3
    ... )
    0.33
    """

    curve: ClassVar[str] = "gab"
    monolayer_moisture: MoistureDryBasis
    monolayer_constant: PositiveNumber
    multilayer_constant: PositiveNumber
    monolayer_moisture_energy: MolarEnergy = 0.0
    monolayer_energy: MolarEnergy = 0.0
    multilayer_energy: MolarEnergy = 0.0

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)

    def _constants(self, T: Any) -> tuple[Any, Any, Any]:
        r = 1.0 / (GAS_CONSTANT * jnp.asarray(T))
        return (
            self.monolayer_moisture * jnp.exp(self.monolayer_moisture_energy * r),
            self.monolayer_constant * jnp.exp(self.monolayer_energy * r),
            self.multilayer_constant * jnp.exp(self.multilayer_energy * r),
        )

    def moisture(self, a: Any, T: Any) -> Any:
        m, C, K = self._constants(T)
        u = K * bounded(a)
        return jnp.where(u < 1.0, _langmuir_like(jnp.where(u < 1.0, u, 0.5), m, C), jnp.inf)

    def activity(self, X: Any, T: Any) -> Any:
        m, C, K = self._constants(T)
        return jnp.minimum(_langmuir_like_inverse(X, m, C) / K, 1.0)


@law(
    "isotherm",
    name="isotherm_hailwood_horrobin",
    source="hailwood1946; glass2010, eq. 4-5",
    fitted={"water_activity": (0.05, 0.95), "temperature": (272.05, 405.35)},
    title="Hailwood–Horrobin isotherm of wood",
    equation=r"M = \frac{1800}{W}\left[\frac{Ka}{1-Ka}+\frac{K_1Ka+2K_1K_2K^2a^2}{1+K_1Ka+K_1K_2K^2a^2}\right]",  # noqa: E501,
    symbols={"water_activity": "a"},
)
class HailwoodHorrobin(AbstractIsotherm):
    """Equilibrium moisture of wood, two hydrates and dissolved water, with the coefficients of the Wood
    Handbook over temperature.

    The Handbook's table gives 9.2 % at 21.1 °C and 50 %, 16.0 % at 80 %.

    The table runs from 5 to 95 % and from −1.1 to 132.2 °C.

    >>> wood = HailwoodHorrobin()
    >>> round(float(wood(0.5, 294.25)), 3), round(float(wood(0.8, 294.25)), 3)
    (0.092, 0.16)
    """

    curve: ClassVar[str] = "hailwood_horrobin"

    def __call__(self, water_activity: WaterActivity, temperature: Temperature = ROOM) -> MoistureDryBasis:
        return self.moisture(water_activity, temperature)

    def moisture(self, a: Any, T: Any) -> Any:
        t = jnp.asarray(T) - ZERO_CELSIUS
        W = 349.0 + 1.29 * t + 0.0135 * t**2
        K = 0.805 + 0.000736 * t - 0.00000273 * t**2
        K1 = 6.27 - 0.00938 * t - 0.000303 * t**2
        K2 = 1.91 + 0.0407 * t - 0.000293 * t**2
        u = K * bounded(a)
        hydrates = (K1 * u + 2.0 * K1 * K2 * u**2) / (1.0 + K1 * u + K1 * K2 * u**2)
        return 18.0 / W * (u / (1.0 - u) + hydrates)

    def activity(self, X: Any, T: Any) -> Any:
        return activity_by_search(self, X, T)
