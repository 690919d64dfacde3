"""Solubility against temperature or antisolvent: Apelblat, van 't Hoff, polynomial and log-linear fits, ready
to use as laws.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import lab_test
from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.i18n import _
from granum.core.kinds import MassFraction, MassRatio, MolarEnergy, MolarMass, Number, Series, Temperature
from granum.crystallization.formulas.solubility_laws import (
    AntisolventSolubility,
    ApelblatSolubility,
    PolynomialSolubility,
    VantHoffSolubility,
)
from granum.crystallization.kinds import MolarEntropy
from granum.estimation import Fit, LabTest
from granum.estimation.lines import polynomial, straight_line


class _Solubility(LabTest):
    """Mole fractions of the measured mass ratios, and the chart of all three fits."""

    holds_for: ClassVar = ("temperature",)
    axes: ClassVar = {"temperature": Temperature, "solute_per_solvent": MassRatio}

    def _mole_fractions(self) -> np.ndarray:
        self.above_zero("solute_per_solvent")
        moles = np.asarray(self.solute_per_solvent) / self.molar_mass
        return moles / (moles + 1.0 / self.solvent_molar_mass)

    @abstractmethod
    def law(self) -> Any:
        """The fitted solubility as a law for simulations."""

    def chart(self) -> Any:
        """Solubility against temperature with the fitted line."""
        from granum.core.charts import add_line, add_points, axis_title, figure

        T = np.asarray(self.temperature)
        grid = np.linspace(T.min(), T.max(), 100)
        drawing = figure(
            axis_title("temperature", "degC"),
            axis_title("solute_per_solvent", "kg/kg"),
            title=type(self).card.title,
        )
        add_line(drawing, grid - ZERO_CELSIUS, np.asarray(self.law()(grid)), _("model"))
        add_points(drawing, T - ZERO_CELSIUS, np.asarray(self.solute_per_solvent), _("data"))
        return drawing


@lab_test(
    "solubility_apelblat",
    source="apelblat1999",
    title="Solubility fitted with Apelblat's equation",
    equation=r"\ln x = A + B/T + C\ln T",
)
class SolubilityApelblat(_Solubility):
    """Apelblat coefficients from the solubility at several temperatures, fitted on the logarithm of the mole
    fraction.
    """

    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    molar_mass: MolarMass
    solvent_molar_mass: MolarMass = 0.0180153

    least_points: ClassVar[int] = 4
    estimates: ClassVar = {"apelblat_a": Number, "apelblat_b": Number, "apelblat_c": Number}

    def fit(self) -> Fit:
        """Coefficients with 95 % intervals and the enthalpy of dissolution at the mean temperature."""
        T, y = np.asarray(self.temperature), np.log(self._mole_fractions())
        a, b, c = np.linalg.lstsq(np.stack([np.ones_like(T), 1 / T, np.log(T)], 1), y, rcond=None)[0]
        mean = float(T.mean())
        return self.fitted(
            lambda p, T: p["apelblat_a"] + p["apelblat_b"] / T + p["apelblat_c"] * jnp.log(T),
            {"apelblat_a": float(a), "apelblat_b": float(b), "apelblat_c": float(c)},
            T,
            y,
            derived=lambda p: {
                "enthalpy_of_dissolution": GAS_CONSTANT * (p["apelblat_c"] * mean - p["apelblat_b"])
            },
            kinds={"enthalpy_of_dissolution": MolarEnergy},
        )

    def law(self) -> ApelblatSolubility:
        return ApelblatSolubility(
            **self.fit().values, molar_mass=self.molar_mass, solvent_molar_mass=self.solvent_molar_mass
        )


@lab_test(
    "solubility_vant_hoff",
    source="mullin2001, ch. 3",
    title="Solubility fitted with the van 't Hoff equation",
    equation=r"\ln x = -\frac{\Delta H}{RT} + \frac{\Delta S}{R}",
)
class SolubilityVantHoff(_Solubility):
    """Enthalpy and entropy of dissolution from the solubility at several temperatures."""

    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]
    molar_mass: MolarMass
    solvent_molar_mass: MolarMass = 0.0180153

    estimates: ClassVar = {"enthalpy_of_dissolution": MolarEnergy, "entropy_of_dissolution": MolarEntropy}

    def fit(self) -> Fit:
        """Enthalpy and entropy of dissolution with 95 % intervals."""
        T, y = np.asarray(self.temperature), np.log(self._mole_fractions())
        slope, level = straight_line(1 / T, y)
        return self.fitted(
            lambda p, T: (p["entropy_of_dissolution"] - p["enthalpy_of_dissolution"] / T) / GAS_CONSTANT,
            {
                "enthalpy_of_dissolution": float(-slope * GAS_CONSTANT),
                "entropy_of_dissolution": float(level * GAS_CONSTANT),
            },
            T,
            y,
        )

    def law(self) -> VantHoffSolubility:
        return VantHoffSolubility(
            **self.fit().values, molar_mass=self.molar_mass, solvent_molar_mass=self.solvent_molar_mass
        )


@lab_test(
    "solubility_polynomial",
    source="mullin2001, ch. 3",
    title="Solubility fitted with a polynomial",
    equation=r"C^* = a_0 + a_1\theta + a_2\theta^2",
)
class SolubilityPolynomial(_Solubility):
    """Coefficients of a parabola in degrees Celsius from the solubility at several temperatures."""

    temperature: Annotated[Temperature, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]

    least_points: ClassVar[int] = 4
    estimates: ClassVar = {
        "constant_coefficient": Number,
        "linear_coefficient": Number,
        "quadratic_coefficient": Number,
    }

    def fit(self) -> Fit:
        """Coefficients with 95 % intervals."""
        theta, y = np.asarray(self.temperature) - ZERO_CELSIUS, np.asarray(self.solute_per_solvent)
        a, b, c = polynomial(theta, y, 2)
        return self.fitted(
            lambda p, t: (
                p["constant_coefficient"] + t * (p["linear_coefficient"] + t * p["quadratic_coefficient"])
            ),
            {
                "constant_coefficient": float(a),
                "linear_coefficient": float(b),
                "quadratic_coefficient": float(c),
            },
            theta,
            y,
        )

    def law(self) -> PolynomialSolubility:
        return PolynomialSolubility(list(self.fit().values.values()))


@lab_test(
    "solubility_antisolvent",
    source="yalkowsky1981",
    title="Solubility fitted against the antisolvent",
    equation=r"\ln C^* = \ln C^*_0 - \kappa\,w - \kappa_2\,w^2",
)
class SolubilityAntisolvent(LabTest):
    """Power and curvature of an antisolvent from the solubility in mixtures of two solvents at one
    temperature, per mass of the mixture.
    """

    antisolvent_fraction: Annotated[MassFraction, Series("points")]
    solute_per_solvent: Annotated[MassRatio, Series("points")]

    least_points: ClassVar[int] = 4
    estimates: ClassVar = {
        "solubility_per_solvent": MassRatio,
        "antisolvent_power": Number,
        "antisolvent_curvature": Number,
    }
    holds_for: ClassVar = ("antisolvent_fraction",)
    axes: ClassVar = {"antisolvent_fraction": MassFraction, "solute_per_solvent": MassRatio}

    def fit(self) -> Fit:
        """Solubility in the pure solvent, power and curvature with 95 % intervals, fitted on the
        logarithm.
        """
        self.above_zero("solute_per_solvent")
        w, y = np.asarray(self.antisolvent_fraction), np.log(np.asarray(self.solute_per_solvent))
        a, b, c = polynomial(w, y, 2)
        return self.fitted(
            lambda p, w: (
                jnp.log(p["solubility_per_solvent"])
                - w * (p["antisolvent_power"] + w * p["antisolvent_curvature"])
            ),
            {
                "solubility_per_solvent": float(np.exp(a)),
                "antisolvent_power": float(-b),
                "antisolvent_curvature": float(-c),
            },
            w,
            y,
            bounds={"solubility_per_solvent": (0.0, np.inf)},
        )

    def law(self) -> AntisolventSolubility:
        """The fitted solubility as a law for simulations, at the temperature of the test."""
        pure, power, curvature = self.fit().values.values()
        return AntisolventSolubility(PolynomialSolubility([pure]), power, curvature)

    def chart(self) -> Any:
        """Solubility against the mass fraction of antisolvent, with the fitted curve."""
        from granum.core.charts import add_line, add_points, axis_title, figure

        w, c = np.asarray(self.antisolvent_fraction), np.asarray(self.solute_per_solvent)
        grid = np.linspace(w.min(), w.max(), 100)
        drawing = figure(
            axis_title("antisolvent_fraction", "percent"),
            axis_title("solute_per_solvent", "kg/kg"),
            title=type(self).card.title,
            y_log=True,
        )
        add_line(drawing, 100 * grid, np.exp(self.fit().predict(grid).value), _("model"))
        add_points(drawing, 100 * w, c, _("data"))
        return drawing
