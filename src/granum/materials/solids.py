"""``Solid``: a solid substance, as crystals, mineral or product."""

from __future__ import annotations

from typing import Any

import equinox as eqx

from granum.core.constants import ZERO_CELSIUS
from granum.core.i18n import _, current_language
from granum.materials.correlation import Correlation, Missing, as_temperature
from granum.numerics import gauss_legendre

Property = Correlation | Missing


class Solid(eqx.Module):
    """A solid. ``density``, ``heat_capacity`` and ``conductivity`` are functions of temperature.

    Parameters
    ----------
    name, french, formula: what it is.
    molar_mass: kg/mol; NaN for rocks, foods and polymers.
    sphericity: ordinary value for its crushed or crystallized particles; NaN when not given.
    mohs_hardness: on Mohs' scale; NaN when not given.
    dust: the tested dust that its own burns like, by name; empty for what does not burn or is not known.
    """

    name: str = eqx.field(static=True)
    french: str = eqx.field(static=True)
    formula: str = eqx.field(static=True)
    molar_mass: float
    sphericity: float
    mohs_hardness: float
    density: Property
    heat_capacity: Property
    conductivity: Property
    dust: str = eqx.field(static=True, default="")

    @property
    def label(self) -> str:
        """Its name in the current language."""
        return self.french if current_language() == "fr" and self.french else self.name

    def enthalpy(self, temperature: Any) -> Any:
        """Specific enthalpy, J/kg, zero at 0 °C."""
        T = as_temperature(temperature)
        self.heat_capacity.check_range(T)
        return gauss_legendre(self.heat_capacity.value, ZERO_CELSIUS, T, order=8)

    def __repr__(self) -> str:
        return _("solid {name} ({formula})").format(name=self.label, formula=self.formula)
