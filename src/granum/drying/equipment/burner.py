"""Direct firing in a flowsheet: a burner whose flame goes straight into the drying air."""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import Fraction, HumidityRatio, MassFlow, MassRatio, Power, Temperature
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.materials.fluids import Combustion
from granum.numerics import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import AIR, Mixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities

HOTTEST = 1400.0  # K, up to which the flue gas may be taken as air
MOST = 1e3  # air over air needed


class Fired(NamedTuple):
    """Fired gas, and the heat taken up from outside (negative: the loss)."""

    product: Stream
    heat_duty: Any


class BurnerFigures(NamedTuple):
    """Figures of a burner."""

    temperature: Temperature
    humidity_ratio: HumidityRatio
    excess_air_ratio: MassRatio
    fuel_flow: MassFlow
    heat_duty_heater: Power


@equipment("burner", source="keey1978; haynes2014", title="Burner fired into the drying air")
class Burner(Unit):
    """Burns a gaseous fuel of the mixture in the air: its flue gas, diluted by the air that is too much,
    dries directly.

    Complete combustion; the dry flue gas is counted as air, within 1 % of its enthalpy from four times the
    air needed. The fuel brings water of its own: about 2.2 kg for a kilogram of methane. ``heat_loss_share``
    is of the heating value. Without fuel the gas passes as it is, with a ratio of excess air of zero.
    """

    heat_loss_share: Fraction = 0.0

    limits: ClassVar[Limits] = {
        "enough": Limit("air supplied over air needed by the fuel", 1.05, MOST, "kg/kg", "keey1978"),
        "hot": Limit("temperature of the fired gas", 273.15, HOTTEST, "K", "keey1978"),
    }

    utilities: ClassVar[Utilities] = {"heat_input_fuel_gas": Utility("keey1978", inlet="fuel")}

    def outlets(self, inside: None, gas: Stream, fuel: Stream) -> Fired:
        both = gas + fuel
        fuels, m = _fuels(gas.mixture), gas.mixture
        air, vapor = m.index("gases", AIR), m.index("gases", "water")
        burnt = both.gas
        for i, burns in fuels.items():
            water = burnt[i] * burns.water
            burnt = burnt.at[air].add(burnt[i] - water).at[vapor].add(water).at[i].set(0.0)
        loss = self.heat_loss_share * self._heat(both)
        enthalpy = gas.enthalpy_flow + fuel.enthalpy_flow - loss
        return Fired(both.replace(gas=burnt, pressure=gas.pressure).at_enthalpy(enthalpy), -loss)

    @staticmethod
    def _heat(both: Stream) -> Any:
        """Heating value of what burns, W."""
        return sum(
            (both.gas[i] * burns.lower_heating_value for i, burns in _fuels(both.mixture).items()),
            jnp.zeros(()),
        )

    def figures(self, inside: None, outlets: Fired, gas: Stream, fuel: Stream) -> BurnerFigures:
        fuels = _fuels(gas.mixture)
        flows = gas.gas + fuel.gas
        needed = sum((flows[i] * burns.air for i, burns in fuels.items()), jnp.zeros(()))
        return BurnerFigures(
            temperature=outlets.product.temperature,
            humidity_ratio=HumidMixture(gas.mixture).humidity_ratio(outlets.product),
            excess_air_ratio=safe_divide(flows[gas.mixture.index("gases", AIR)], needed),
            fuel_flow=sum((flows[i] for i in fuels), jnp.zeros(())),
            heat_duty_heater=self._heat(gas.replace(gas=flows)),
        )

    def measured(
        self, inside: None, outlets: Fired, figures: BurnerFigures, gas: Stream, fuel: Stream
    ) -> dict[str, Any]:
        # without fuel no air is needed
        enough = jnp.where(figures.fuel_flow > 0, figures.excess_air_ratio, MOST)
        return {"enough": enough, "hot": figures.temperature}

    def drawn(
        self, inside: None, outlets: Fired, figures: BurnerFigures, gas: Stream, fuel: Stream
    ) -> dict[str, Any]:
        return {"heat_input_fuel_gas": figures.heat_duty_heater}


def _fuels(mixture: Mixture) -> dict[int, Combustion]:
    """Places of the fuels among the gases, and how they burn."""
    found = {
        i: burns
        for i, gas in enumerate(mixture.gases)
        if (burns := mixture.materials.fluid(gas.name).combustion) is not None
    }
    if not found or not {AIR, "water"} <= {gas.name for gas in mixture.gases}:
        raise InputError(
            _("A burner needs a mixture with the gases dry air, water and a fuel, such as methane.")
        )
    return found
