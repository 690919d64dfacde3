"""Any gas and vapor of the property library as an ideal pair, and the usual ones by name."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import law
from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.core.kinds import PositiveNumber
from granum.humid_gas.pairs import LEAST_PRESSURE, MOST_PRESSURE, AbstractIdealPair, integrated, polynomial
from granum.materials.library import Library, session
from granum.materials.pairs import gas_vapor
from granum.numerics import find_root

_COLD, _HOT = 180.0, 1000.0
PSYCHROMETER = 0.567  # exponent of the Lewis number, Bedingfield and Drew


class _Tables:
    """What a pair needs of its two fluids, drawn once from the library as plain numbers."""

    def __init__(self, materials: Library, gas: str, vapor: str):
        carrier, solvent = materials.fluid(gas), materials.fluid(vapor)
        if not solvent.condensable:
            raise ApplicabilityError(
                _("{name} does not condense here: it cannot be the vapor of a pair.").format(
                    name=solvent.label
                )
            )
        self.gas_mass, self.vapor_mass = float(carrier.molar_mass), float(solvent.molar_mass)
        law = solvent.vapor_pressure
        self.low, self.high = float(max(law.low, _COLD)), float(law.high)
        self.gas_enthalpy = integrated(carrier.vapor_heat_capacity.polynomial(_COLD, _HOT, 5))
        self.vapor_enthalpy = integrated(solvent.vapor_heat_capacity.polynomial(_COLD, _HOT, 5))
        self.zero = float(solvent.heat_of_vaporization.value(ZERO_CELSIUS))
        self.latent = solvent.heat_of_vaporization.polynomial(max(self.low, 200.0), 0.9 * self.high, 6)
        self.pressure = law
        self.dippr = None
        if getattr(law.form, "__name__", "") == "correlation_dippr101":
            c = [float(x) for x in np.asarray(law.coefficients)]
            self.dippr = (*c[:4], int(c[4]) if c[4] == int(c[4]) else c[4], float(law.factor))
        top, nearly = float(law.value(self.high)), float(law.value(0.98 * self.high))
        bottom, above = float(law.value(self.low)), float(law.value(1.02 * self.low))
        self.top_pressure = top
        self.slopes = (
            float(np.log(above / bottom) / (1 - 1 / 1.02)),
            float(np.log(top / nearly) / (1 / 0.98 - 1)),
        )
        both = gas_vapor(vapor, gas, materials)
        self.lewis_number = float(both.lewis_number(298.15))

    def saturation_pressure(self, T: Any) -> Any:
        """Fitted law inside its range, beyond either end straight on in 1/T."""
        inside = jnp.where(self.low > T, self.low, jnp.where(self.high < T, self.high, T))
        if self.dippr is not None:
            a, b, c, d, e, factor = self.dippr
            logarithm = a + b / inside + c * jnp.log(inside) + d * inside**e
            pressure = jnp.exp(logarithm) * factor
        else:
            pressure = self.pressure.value(inside)
        return pressure * jnp.exp(
            jnp.where(self.low > T, self.slopes[0], self.slopes[1]) * (1.0 - inside / T)
        )


@lru_cache(maxsize=64)
def _tables(materials: Library, gas: str, vapor: str) -> _Tables:
    with jax.ensure_compile_time_eval():
        return _Tables(materials, gas, vapor)


class AbstractFluidPair(AbstractIdealPair):
    """An ideal pair of two fluids of the library. The condensed phase is the liquid at every temperature."""

    highest_temperature: ClassVar[float] = 1500.0
    heavy_vapor: ClassVar[bool] = True

    gas: eqx.AbstractVar[str]
    vapor: eqx.AbstractVar[str]
    lewis_exponent: eqx.AbstractVar[Any]

    def __check_init__(self) -> None:
        _ = self._of

    def known(self) -> Library:
        """Where the two are found by name."""
        return session()

    @property
    def _of(self) -> _Tables:
        return _tables(self.known(), self.gas, self.vapor)

    @property
    def gas_molar_mass(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """kg/mol."""
        return self._of.gas_mass

    @property
    def vapor_molar_mass(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """kg/mol."""
        return self._of.vapor_mass

    @property
    def lowest_temperature(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Where the vapor-pressure law begins."""
        return self._of.low

    @property
    def highest_condensation(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Where the vapor-pressure law ends: the critical temperature."""
        return self._of.high

    @property
    def freezing_temperature(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Solid solvent is not modeled: freezing lies at the lowest temperature."""
        return self._of.low

    def lewis_factor(self) -> Any:
        return self._of.lewis_number**self.lewis_exponent

    def gas_molar_enthalpy(self, T: Any) -> Any:
        return self.gas_molar_mass * polynomial(self._of.gas_enthalpy, T - ZERO_CELSIUS)

    def vapor_molar_enthalpy(self, T: Any) -> Any:
        return self.vapor_molar_mass * (self._of.zero + polynomial(self._of.vapor_enthalpy, T - ZERO_CELSIUS))

    def saturation_pressure(self, T: Any, frozen: Any) -> Any:
        return self._of.saturation_pressure(T)

    def boiling_temperature(self, P: Any) -> Any:
        tables = self._of
        goal = jnp.log(jnp.asarray(P, dtype=float))
        root = find_root(
            lambda x, y: jnp.log(tables.saturation_pressure(1.0 / x)) - y,
            1.0 / tables.high,
            1.0 / tables.low,
            goal,
        )
        # above the critical pressure
        beyond = jnp.maximum(goal - np.log(tables.top_pressure), 0.0) / tables.slopes[1]
        return jnp.where(beyond > 0, tables.high / jnp.maximum(1.0 - beyond, 0.1), 1.0 / root.value)

    def condensate_molar_enthalpy(self, T: Any, P: Any, frozen: Any) -> Any:
        latent = polynomial(self._of.latent, T - ZERO_CELSIUS)
        return self.vapor_molar_enthalpy(T) - self.vapor_molar_mass * latent


@law(
    "gas_vapor_pair",
    name="gas_and_vapor",
    source="green2008, sec. 2; fuller1966; bedingfield1950",
    title="Gas and vapor of the property library",
    fitted={"pressure": (LEAST_PRESSURE, MOST_PRESSURE)},
    equation=r"\frac{h}{k_Y c} = \mathrm{Le}^{n}",
)
class GasAndVapor(AbstractFluidPair):
    """Any carrier gas and solvent of the property library as ideal gases, with the Lewis factor that
    psychrometers show.

    The exponent 0.567 is Bedingfield and Drew's, measured on wet cylinders with many vapors; Chilton and
    Colburn's analogy has 2/3, with which toluene in air of 60 °C has its wet bulb 1 K higher. The Lewis
    number is that of dilute vapor at 25 °C; it hardly changes with temperature.
    """

    gas: str = eqx.field(static=True, default="nitrogen")
    vapor: str = eqx.field(static=True, default="ethanol")
    lewis_exponent: PositiveNumber = eqx.field(static=True, default=PSYCHROMETER)


class PairOfMixture(AbstractFluidPair):
    """The carrier gas and the solvent of a mixture, which may be materials of one's own."""

    gas: str = eqx.field(static=True, kw_only=True)
    vapor: str = eqx.field(static=True, kw_only=True)
    materials: Library = eqx.field(static=True, kw_only=True)
    lewis_exponent: Any = eqx.field(static=True, default=PSYCHROMETER)

    def known(self) -> Library:
        return self.materials


def _named(carrier: str, solvent: str, name: str, title: str, low: float, high: float) -> type:
    """``low`` and ``high``: temperatures between which the vapor pressure of the solvent is known, K."""

    @law(
        "gas_vapor_pair",
        name=name,
        source="green2008, sec. 2; fuller1966; bedingfield1950",
        title=title,
        fitted={"temperature": (low, high), "pressure": (LEAST_PRESSURE, MOST_PRESSURE)},
    )
    class NamedPair(AbstractFluidPair):
        """A carrier gas and a solvent vapor of the property library as ideal gases."""

        gas: ClassVar[str] = carrier
        vapor: ClassVar[str] = solvent
        lewis_exponent: PositiveNumber = eqx.field(static=True, default=PSYCHROMETER)

    return NamedPair


NitrogenWater = _named("nitrogen", "water", "nitrogen_water", "Nitrogen and water", 273.15, 647.096)
NitrogenEthanol = _named("nitrogen", "ethanol", "nitrogen_ethanol", "Nitrogen and ethanol", 180.0, 514.0)
NitrogenMethanol = _named("nitrogen", "methanol", "nitrogen_methanol", "Nitrogen and methanol", 180.0, 513.38)
NitrogenIsopropanol = _named(
    "nitrogen", "2-propanol", "nitrogen_isopropanol", "Nitrogen and isopropanol", 185.25, 508.25
)
NitrogenAcetone = _named("nitrogen", "acetone", "nitrogen_acetone", "Nitrogen and acetone", 180.0, 508.2)
NitrogenToluene = _named("nitrogen", "toluene", "nitrogen_toluene", "Nitrogen and toluene", 180.0, 591.75)
NitrogenEthylAcetate = _named(
    "nitrogen", "ethyl acetate", "nitrogen_ethyl_acetate", "Nitrogen and ethyl acetate", 189.65, 523.2
)
AirEthanol = _named("dry air", "ethanol", "air_ethanol", "Air and ethanol", 180.0, 514.0)
AirMethanol = _named("dry air", "methanol", "air_methanol", "Air and methanol", 180.0, 513.38)
AirAcetone = _named("dry air", "acetone", "air_acetone", "Air and acetone", 180.0, 508.2)
AirToluene = _named("dry air", "toluene", "air_toluene", "Air and toluene", 180.0, 591.75)
