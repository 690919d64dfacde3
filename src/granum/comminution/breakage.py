"""Selection and breakage functions: how fast a size breaks, and into what."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.comminution.kinds import MassPerEnergy
from granum.core import formula, impossible, law
from granum.core.kinds import Fraction, Frequency, Length, Mass, PositiveNumber, Power, Ratio
from granum.numerics.smooth import safe_divide


class SelectionFunction(eqx.Module):
    """Rate of breakage of a size."""

    @abstractmethod
    def __call__(self, particle_diameter: Length) -> Frequency:
        """Part of the material of a size that breaks per time, 1/s."""


@law(
    "selection_function",
    name="austin_selection",
    source="austin1984, ch. 5",
    title="Austin's selection function",
    equation=r"S(x) = a \left(\frac{x}{x_0}\right)^{\alpha} \frac{1}{1 + (x/\mu)^{\Lambda}}",
    symbols={"particle_diameter": "x", "reference_size": "x_0"},
)
class AustinSelection(SelectionFunction):
    """Power of the size, with a fall-off for particles too large for the grinding media.

    ``x_0`` is 1 mm by custom. Without a largest size well ground there is no fall-off. The rate is that of a
    single size; where the convention of the mill is ``root_two``, as that of published constants, it is that
    of a root-two class by its upper limit.

    >>> round(float(AustinSelection(selection_rate="0.6 1/min", selection_exponent=0.8)(1e-3)) * 60, 6)
    0.6
    """

    selection_rate: Frequency
    selection_exponent: Ratio
    falloff_size: Length | None = None
    falloff_exponent: PositiveNumber = 3.0
    reference_size: Length = 1e-3

    def __call__(self, particle_diameter: Length) -> Frequency:
        """Part of the material of a size that breaks per time, 1/s."""
        x = jnp.asarray(particle_diameter, dtype=float)
        rate = self.selection_rate * (x / self.reference_size) ** self.selection_exponent
        return (
            rate
            if self.falloff_size is None
            else rate / (1.0 + (x / self.falloff_size) ** self.falloff_exponent)
        )


class BreakageFunction(eqx.Module):
    """Fragments of a breaking particle."""

    @abstractmethod
    def __call__(self, size_ratio: Fraction) -> Fraction:
        """Mass fraction of the fragments below a size, by that size over the parent's (lower limit of its
        class in the convention ``root_two``).
        """


@law(
    "breakage_function",
    name="austin_breakage",
    source="austin1984, ch. 4",
    title="Austin's breakage function",
    equation=r"B(y) = \Phi\,y^{\gamma} + (1 - \Phi)\,y^{\beta}",
)
class AustinBreakage(BreakageFunction):
    """Two power laws: fines with the exponent gamma, the coarse rest with beta; normalized, the same for
    every parent size.

    The ratio is taken to the size of the parent; where the convention of the mill is ``root_two``, as in the
    source, to the lower limit of its root-two class, which all fragments leave.

    >>> round(float(AustinBreakage(fines_share=0.6, fines_exponent=0.9, coarse_exponent=4.0)(0.5)), 4)
    0.3465
    """

    fines_share: Fraction
    fines_exponent: PositiveNumber
    coarse_exponent: PositiveNumber

    def __call__(self, size_ratio: Fraction) -> Fraction:
        """Mass fraction of the fragments below a size."""
        y = jnp.clip(jnp.asarray(size_ratio, dtype=float), 0.0, 1.0)
        positive = y > 0
        t = jnp.where(positive, y, 1.0)
        return jnp.where(
            positive,
            self.fines_share * t**self.fines_exponent + (1.0 - self.fines_share) * t**self.coarse_exponent,
            0.0,
        )


@law(
    "breakage_function",
    name="broadbent_callcott",
    source="broadbent1956",
    title="Broadbent–Callcott breakage function",
    equation=r"B(y) = \frac{1 - e^{-y}}{1 - e^{-1}}",
)
class BroadbentCallcottBreakage(BreakageFunction):
    """Fragments of coal and rock without any fitted parameter.

    >>> round(float(BroadbentCallcottBreakage()(0.5)), 4)
    0.6225
    """

    def __call__(self, size_ratio: Fraction) -> Fraction:
        """Mass fraction of the fragments below a size."""
        return jnp.expm1(-jnp.clip(jnp.asarray(size_ratio, dtype=float), 0.0, 1.0)) / jnp.expm1(-1.0)


@formula(
    source="herbst1980",
    equation=r"a = S^E\,\frac{P}{H}",
    title="Selection rate from the specific power (Herbst–Fuerstenau)",
)
def selection_rate_herbst_fuerstenau(
    specific_selection: MassPerEnergy, shaft_power: Power, holdup_mass: Mass
) -> Frequency:
    """Breakage rate in proportion to the power per mass in the mill.

    >>> round(selection_rate_herbst_fuerstenau("1 tonne/kWh", "10 kW", "1 tonne") * 3600, 6)
    10.0
    """
    impossible(shaft_power < 0.0, shaft_power, "shaft_power", 0.0, jnp.inf)
    return safe_divide(specific_selection * shaft_power, holdup_mass, jnp.nan)


@law(
    "selection_probability",
    name="whiten_classification",
    source="whiten1972; napiermunn1996",
    title="Whiten's crusher classification",
    equation=r"C(x) = 0\ (x < K_1),\ 1 - \left(\frac{K_2 - x}{K_2 - K_1}\right)^{K_3},\ 1\ (x > K_2)",
    symbols={"particle_diameter": "x"},
)
class WhitenClassification(eqx.Module):
    """Chance that a particle is nipped and broken before it leaves a cone or jaw crusher; class means are
    taken over its limits.

    >>> [round(float(c), 3) for c in WhitenClassification("10 mm", "30 mm")(jnp.array([5e-3, 20e-3, 40e-3]))]
    [0.0, 0.797, 1.0]
    """

    always_passing_size: Length
    always_broken_size: Length
    classification_exponent: PositiveNumber = 2.3

    def __call__(self, particle_diameter: Length) -> Fraction:
        """Chance of breakage."""
        low, high = self.always_passing_size, self.always_broken_size
        left = jnp.clip((high - jnp.asarray(particle_diameter, dtype=float)) / (high - low), 0.0, 1.0)
        positive = left > 0
        return jnp.where(positive, 1.0 - jnp.where(positive, left, 1.0) ** self.classification_exponent, 1.0)

    def over(self, lower: Any, upper: Any) -> Any:
        """Mean chance over size classes."""
        low, high, k = self.always_passing_size, self.always_broken_size, self.classification_exponent

        def integral(x: Any) -> Any:
            left = jnp.clip((high - x) / (high - low), 0.0, 1.0)
            return jnp.maximum(x - low, 0.0) - (high - low) / (k + 1.0) * (1.0 - left ** (k + 1.0))

        return (integral(upper) - integral(lower)) / (upper - lower)
