"""``GasVapor``: a carrier gas and the vapor it can hold, with what humid-gas calculations need."""

from __future__ import annotations

from typing import Any

import equinox as eqx

from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.materials.correlation import as_pressure, as_temperature
from granum.materials.fluids import Fluid
from granum.materials.formulas.diffusivity import diffusivity_fuller, diffusivity_marrero_mason, lewis_number
from granum.materials.library import Library, session


class GasVapor(eqx.Module):
    """A gas–vapor pair such as dry air and water, or nitrogen and ethanol.

    Parameters
    ----------
    gas, vapor: the two fluids.
    """

    gas: Fluid
    vapor: Fluid

    @property
    def molar_mass_ratio(self) -> float:
        """Molar mass of the vapor over that of the gas: 0.622 for water in air."""
        return self.vapor.molar_mass / self.gas.molar_mass

    def diffusivity(self, temperature: Any, pressure: Any = STANDARD_ATMOSPHERE) -> Any:
        """Diffusivity of the vapor in the gas, m²/s: Marrero and Mason for water in air, otherwise Fuller."""
        T, p = as_temperature(temperature), as_pressure(pressure)
        if (self.gas.name, self.vapor.name) == ("dry air", "water"):
            return diffusivity_marrero_mason(T, p)
        for one in (self.gas, self.vapor):
            if one.diffusion_volume != one.diffusion_volume:
                raise ApplicabilityError(
                    _("{name} has no 'diffusion_volume' in the library.").format(name=one.label)
                )
        return diffusivity_fuller(
            T,
            self.vapor.molar_mass,
            self.vapor.diffusion_volume,
            self.gas.molar_mass,
            self.gas.diffusion_volume,
            p,
        )

    def lewis_number(self, temperature: Any, pressure: Any = STANDARD_ATMOSPHERE) -> Any:
        """Lewis number of the vapor in the nearly dry gas."""
        T, p = as_temperature(temperature), as_pressure(pressure)
        gas = self.gas
        return lewis_number(
            gas.vapor_conductivity(T),
            gas.vapor_density(T, p),
            gas.vapor_heat_capacity(T),
            self.diffusivity(T, p),
        )


def gas_vapor(vapor: str = "water", gas: str = "dry air", materials: Library | None = None) -> GasVapor:
    """A vapor and its carrier gas by name, among ``materials`` or those of the session.

    >>> round(gas_vapor("water", "dry air").molar_mass_ratio, 3)
    0.622
    """
    known = materials or session()
    return GasVapor(known.fluid(gas), known.fluid(vapor))
