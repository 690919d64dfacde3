"""``Salt``: a sparingly soluble salt known by its solubility product."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core.constants import GAS_CONSTANT
from granum.core.i18n import _, current_language
from granum.materials.formulas.precipitation import (
    ROOM,
    activity_coefficient_davies,
    salt_molality_from_product,
)
from granum.numerics import safe_log


class Salt(eqx.Module):
    """A salt of one cation and one anion, ``salt("barium sulfate")``; molalities in mol per kg of
    water.

    Parameters
    ----------
    name, french, formula: what it is.
    cation, anion: the ions.
    cation_count, anion_count: of each in the formula.
    cation_charge, anion_charge: signed charge numbers.
    solubility_product: on activities, at 25 °C.
    enthalpy_of_dissolution: J per mol of formula units, by which the product changes with temperature; None
        where the library has none: the product is then that of 25 °C.
    source: key in the bibliography.
    """

    name: str = eqx.field(static=True)
    french: str = eqx.field(static=True)
    formula: str = eqx.field(static=True)
    cation: str = eqx.field(static=True)
    anion: str = eqx.field(static=True)
    cation_count: float
    anion_count: float
    cation_charge: float
    anion_charge: float
    solubility_product: float
    enthalpy_of_dissolution: float | None
    source: str = eqx.field(static=True)

    @property
    def label(self) -> str:
        """Its name in the current language."""
        return self.french if current_language() == "fr" and self.french else self.name

    @property
    def ion_count(self) -> float:
        """Ions in the formula."""
        return self.cation_count + self.anion_count

    def product_at(self, temperature: Any) -> Any:
        """Solubility product at a temperature, van 't Hoff."""
        heat = 0.0 if self.enthalpy_of_dissolution is None else self.enthalpy_of_dissolution
        return self.solubility_product * jnp.exp(heat / GAS_CONSTANT * (1.0 / ROOM - 1.0 / temperature))

    def saturation_index(
        self, cation_molality: Any, anion_molality: Any, ionic_strength: Any, temperature: Any = ROOM
    ) -> Any:
        """Decimal logarithm of the ion activity product over the solubility product."""
        charges, I, T = (self.cation_charge, self.anion_charge), ionic_strength, temperature
        cation, anion = (
            activity_coefficient_davies(z, I, T) * m
            for z, m in zip(charges, (cation_molality, anion_molality), strict=True)
        )
        logs = (
            self.cation_count * safe_log(cation)
            + self.anion_count * safe_log(anion)
            - jnp.log(self.product_at(temperature))
        )
        return logs / jnp.log(10.0)

    def saturated_molality(self) -> float:
        """Formula units per kg of pure water at saturation, ideal solution, no hydrolysis."""
        return salt_molality_from_product(self.solubility_product, self.cation_count, self.anion_count)

    def __repr__(self) -> str:
        return _("salt {name} ({formula})").format(name=self.label, formula=self.formula)
