"""Pairs of salts of the library that share an ion: where both are saturated, and what one leaves room for of
the other.

The solubility of each salt alone is that of the library; what the other does to it comes from Pitzer's
equations.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import flags
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.materials.activities import SLACK, ElectrolyteActivity
from granum.materials.formulas.activity import WATER, moller_function
from granum.materials.formulas.common_ion import Binary, activity_products, osmotic_coefficient_mixed
from granum.materials.library import Library, session
from granum.materials.solutes import SoluteSystem
from granum.numerics import find_root

COLDEST, HOTTEST = 273.15, 373.15
"""K, where the solubilities of the salts alone are known."""


class Mixing(NamedTuple):
    """What two like ions and the common ion do to each other: two coefficients a + b/T each."""

    theta: tuple[float, float]
    psi: tuple[float, float]
    source: str


# as transcribed in the open-source package pytzer; the print was not opened
MIXINGS = {
    frozenset({"sodium chloride", "potassium chloride"}): Mixing(
        (-5.02312111e-2, 14.0213141), (1.34211308e-2, -5.10212917), "greenberg1989, table 3"
    )
}


class CommonIon(eqx.Module):
    """Two salts in water. Molalities are mol per kg of water, in the order of the salts."""

    first: SoluteSystem = eqx.field(static=True)
    second: SoluteSystem = eqx.field(static=True)
    mixing: Mixing = eqx.field(static=True)

    @property
    def molar_masses(self) -> tuple[float, float]:
        """Of both salts, kg/mol."""
        return float(self.first.molar_mass), float(self.second.molar_mass)

    def _given(self, T: Any) -> tuple[Binary, Binary, Any, Any]:
        t = jnp.clip(jnp.asarray(T, dtype=float), COLDEST, 573.15)
        pairs = []
        for system in (self.first, self.second):
            law = system.activity_law
            assert isinstance(law, ElectrolyteActivity)
            pairs.append(Binary(*(moller_function(t, a) for a in (law.beta_zero, law.beta_one, law.c_phi))))
        theta, psi = (a + b / t for a, b in (self.mixing.theta, self.mixing.psi))
        return pairs[0], pairs[1], theta, psi

    def products(self, T: Any, first: Any, second: Any) -> tuple[Any, Any]:
        """Logarithm of both ion activity products."""
        return activity_products(first, second, *self._given(T), T)

    def alone(self, T: Any) -> tuple[Any, Any]:
        """Solubility of each salt alone, mol/kg."""
        systems, masses = (self.first, self.second), self.molar_masses
        return tuple(s.solubility(T, None) / M for s, M in zip(systems, masses, strict=True))  # type: ignore[return-value]

    def saturation(self, T: Any, first: Any, second: Any) -> tuple[Any, Any]:
        """Logarithm of the saturation ratio of both salts: zero at saturation."""
        T = jnp.asarray(T, dtype=float)
        outside = (T < COLDEST - SLACK) | (T > HOTTEST + SLACK)
        key = "materials.common_ion"
        flags.record(flags.EXTRAPOLATED, outside, T, "temperature", key, COLDEST, HOTTEST, self.mixing.source)
        one, other = self.alone(T)
        here = self.products(T, first, second)
        return here[0] - self.products(T, one, 0.0)[0], here[1] - self.products(T, 0.0, other)[1]

    def room(self, T: Any, which: int, beside: Any) -> Any:
        """Molality at which one salt is saturated beside a molality of the other."""
        most = self.alone(T)[which]

        def excess(m: Any) -> Any:
            pair = (m, beside) if which == 0 else (beside, m)
            return self.saturation(T, *pair)[which]

        return find_root(excess, 1e-6 * most, 1.05 * most, start=0.6 * most).value

    def invariant(self, T: Any) -> tuple[Any, Any]:
        """Molalities at which both salts are saturated."""
        top = self.alone(T)[1]

        def excess(m: Any) -> Any:
            return self.saturation(T, self.room(T, 0, m), m)[1]

        second = find_root(excess, 1e-3 * top, 1.05 * top, start=0.4 * top).value
        return self.room(T, 0, second), second

    def water_activity(self, T: Any, first: Any, second: Any) -> Any:
        """Activity of water over a solution of both."""
        phi = osmotic_coefficient_mixed(first, second, *self._given(T), T)
        return jnp.exp(-2.0 * (first + second) * WATER * phi)


@lru_cache(maxsize=32)
def salts_of_pairs() -> list[str]:
    """The salts that stand in a pair, by name."""
    return sorted({name for pair in MIXINGS for name in pair})


def common_ion(first: str, second: str, materials: Library | None = None) -> CommonIon:
    """The pair of two solutes by name."""
    known = materials or session()
    one, other = known.solute(first), known.solute(second)
    names = [next((n for n in MIXINGS if s.name in n), None) for s in (one, other)]
    mixing = MIXINGS.get(frozenset({one.name, other.name}))
    if mixing is None or None in names:
        raise InputError(
            _(
                "How {first} and {second} act on each other in water is not known here; known pairs: {pairs}."
            ).format(
                first=first,
                second=second,
                pairs="; ".join(", ".join(sorted(pair)) for pair in MIXINGS),
            )
        )
    return CommonIon(one, other, mixing)
