"""``Salt``: a sparingly soluble salt known by its solubility product."""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax.numpy as jnp

from granum.core.i18n import _, current_language
from granum.materials.formulas.precipitation import activity_coefficient_davies, salt_molality_from_product
from granum.numerics import safe_log


class Salt(eqx.Module):
    """A salt of one cation and one anion, ``salt("barium sulfate")``; molalities in mol per kg of water,
    25 °C.

    Parameters
    ----------
    name, french, formula: what it is.
    cation, anion: the ions.
    cation_count, anion_count: of each in the formula.
    cation_charge, anion_charge: signed charge numbers.
    solubility_product: on activities.
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
    source: str = eqx.field(static=True)

    @property
    def label(self) -> str:
        """Its name in the current language."""
        return self.french if current_language() == "fr" and self.french else self.name

    @property
    def ion_count(self) -> float:
        """Ions in the formula."""
        return self.cation_count + self.anion_count

    def saturation_index(self, cation_molality: Any, anion_molality: Any, ionic_strength: Any) -> Any:
        """Decimal logarithm of the ion activity product over the solubility product."""
        cation = activity_coefficient_davies(self.cation_charge, ionic_strength) * cation_molality
        anion = activity_coefficient_davies(self.anion_charge, ionic_strength) * anion_molality
        logs = (
            self.cation_count * safe_log(cation)
            + self.anion_count * safe_log(anion)
            - jnp.log(self.solubility_product)
        )
        return logs / jnp.log(10.0)

    def saturated_molality(self) -> float:
        """Formula units per kg of pure water at saturation, ideal solution, no hydrolysis."""
        return salt_molality_from_product(self.solubility_product, self.cation_count, self.anion_count)

    def __repr__(self) -> str:
        return _("salt {name} ({formula})").format(name=self.label, formula=self.formula)
