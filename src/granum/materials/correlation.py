"""``Correlation``: one property of one material as a function of temperature, with its range and source."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.core.compiling import once
from granum.core.constants import ZERO_CELSIUS
from granum.core.conversion import convert
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _, current_language
from granum.core.kinds import Kind, kind_of
from granum.core.kinds import MassRatio as _MassRatio
from granum.core.kinds import Pressure as _Pressure
from granum.core.kinds import Temperature as _Temperature
from granum.core.parameters import Parameter
from granum.numerics.interpolation import MonotoneCubic, slopes_steffen


def _reader(name: str, annotation: Any) -> Callable[[Any], Any]:
    kind = kind_of(annotation)
    assert isinstance(kind, Kind)
    parameter = Parameter(name, kind)
    return lambda value: convert(value, parameter, several=True)


as_temperature = _reader("temperature", _Temperature)
as_pressure = _reader("pressure", _Pressure)
as_solute_ratio = _reader("solute_per_solvent", _MassRatio)


class Owner(str):
    """Material and property that a message is about, ``water: liquid density``; ``label`` says it in the
    language of whoever reads it.
    """

    french: str
    of: str
    of_french: str

    @classmethod
    def of_property(
        cls, material: str, what: str, french: str = "", of: str = "", of_french: str = ""
    ) -> Owner:
        """A property of a material, of one of its crystals where ``of`` names it."""
        made = cls(f"{material}: {what}" + (f" ({of})" if of else ""))
        made.french, made.of, made.of_french = french, of, of_french
        return made

    @property
    def label(self) -> str:
        """As a message names it."""
        material, _colon, what = self.partition(": ")
        french = current_language() == "fr"
        named, of = (self.french if french else "") or material, (self.of_french if french else "") or self.of
        told = _("{material}: {what}").format(
            material=named, what=_(what.removesuffix(f" ({self.of})") if self.of else what)
        )
        return f"{told} ({of})" if of and of != named else told


class Correlation(eqx.Module):
    """A property over temperature. Call it with K, text with a unit, arrays or tracers; the value is in SI
    units.

    Parameters
    ----------
    form: the formula that turns temperature and coefficients into the value.
    coefficients: as printed in the source; None for a form that needs none.
    factor: from the printed unit to SI.
    low, high: temperatures between which it was fitted, K; outside, the value is kept and flagged.
    owner: material and property, for messages.
    source: key in the bibliography, with table or page.
    """

    form: Any = eqx.field(static=True)
    coefficients: tuple[float, ...] | None = eqx.field(static=True)
    factor: float
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    owner: Owner = eqx.field(static=True)
    source: str = eqx.field(static=True)

    def __call__(self, temperature: Any) -> Any:
        T = as_temperature(temperature)
        self.check_range(T)
        return self.value(T)

    def value(self, temperature: Any) -> Any:
        """The value without looking at the range: for the inside of integrals and roots."""
        found = (
            self.form(temperature)
            if self.coefficients is None
            else self.form(temperature, np.asarray(self.coefficients))
        )
        return found * self.factor

    def check_range(self, temperature: Any) -> None:
        """Flag the temperatures outside the fitted range, if anybody collects flags."""
        flag_outside(self, temperature)

    def polynomial(self, low: Any, high: Any, degree: int = 2) -> tuple[float, ...]:
        """Least-squares polynomial in degrees Celsius between two temperatures, lowest power first: what
        stream species take.
        """
        ends = np.array([float(as_temperature(low)), float(as_temperature(high))])
        # Chebyshev nodes: near-minimax error
        nodes = np.cos(np.pi * (np.arange(4 * degree + 8) + 0.5) / (4 * degree + 8))
        T = ends.mean() + 0.5 * (ends[1] - ends[0]) * nodes
        fitted = np.polynomial.Polynomial.fit(T - ZERO_CELSIUS, np.asarray(once(self.value, T)), degree)
        return tuple(float(c) for c in fitted.convert().coef)


class Tabulated(eqx.Module):
    """A positive property by a monotone cubic through a table, ln y over 1/T; a straight line there (van 't
    Hoff) beyond its ends.

    ``low``, ``high``, ``owner`` and ``source`` as of ``Correlation``.
    """

    points: tuple[tuple[float, float, float], ...] = eqx.field(static=True)
    """-1/T, ln y and its slope, by rising temperature."""
    low: float = eqx.field(static=True)
    high: float = eqx.field(static=True)
    owner: Owner = eqx.field(static=True)
    source: str = eqx.field(static=True)

    @classmethod
    def through(cls, temperatures: Any, values: Any, *about: Any) -> Tabulated:
        """The curve through values at rising temperatures, K; then low, high, owner and source."""
        curve = MonotoneCubic.through(-1.0 / np.asarray(temperatures), np.log(values), slopes_steffen)
        columns = (np.asarray(column).tolist() for column in (curve.points, curve.values, curve.slopes))
        return cls(tuple(zip(*columns, strict=True)), *about)

    def value(self, temperature: Any) -> Any:
        """The value without looking at the range."""
        curve = MonotoneCubic(*jnp.asarray(self.points).T)
        return jnp.exp(curve(-1.0 / jnp.asarray(temperature, dtype=float))[0])

    def check_range(self, temperature: Any) -> None:
        """As of ``Correlation``."""
        flag_outside(self, temperature)


def flag_outside(law: Correlation | Tabulated, temperature: Any) -> None:
    """Flag the temperatures outside the range of a law, if anybody collects flags."""
    mask = (temperature < law.low) | (temperature > law.high)
    flags.record(
        flags.EXTRAPOLATED, mask, temperature, "temperature", law.owner, law.low, law.high, law.source
    )


class Missing(eqx.Module):
    """Stands where a material has no value for a property; says so when called."""

    owner: Owner = eqx.field(static=True)

    def __call__(self, *_values: Any) -> Any:
        raise ApplicabilityError(
            _(
                "The library has no value for {owner}. State it with the material, in the case or in a "
                "materials file."
            ).format(owner=self.owner.label)
        )

    value = check_range = polynomial = __call__
