"""What is in contact: enthalpies of moist solid and moist gas as the streams count them, and the way back to
temperature.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core.constants import GAS_CONSTANT, ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.drying.gas_solid.liquor import deposits
from granum.numerics import safe_divide
from granum.numerics.quick_roots import straight_root
from granum.streams.equilibrium import HumidMixture
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

# enthalpy is nearly linear in temperature: from 20 °C four steps reach rounding up to 1000 °C
NEWTON_STEPS = 4
LIQUID = (200.0, 640.0)  # K
# of the pressure, from which on the driving force goes on as a straight line instead of to infinity
NEAR_BOILING = 0.98
NO_DRY_GAS = 1e-9  # of the carrier


class Matter(eqx.Module):
    """Dry solid by class, its liquid, a gas and vapor. Moisture X is per dry solid, humidity Y per carrier:
    the dry gas, or the steam that entered; enthalpies too, J/kg.
    """

    mixture: Mixture = eqx.field(static=True)
    solid_shares: Any  # species × classes, each class adding up to 1
    gas_shares: Any  # of the carrier; the vapor's share is zero, or that in steam
    pressure: Any
    # per kg of the liquid that can leave, one for each further liquid: what crystallizes as it does
    dissolved: Any = ()

    @classmethod
    def of(cls, feed: Stream, gas: Stream) -> Matter:
        """The matter of two inlets, the feed ``counted`` as dry matter and the liquid that evaporates."""
        m = feed.mixture
        if not m.solids:
            raise InputError(_("A dryer needs a mixture with solids."))
        humid = HumidMixture(m)
        by_class = jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim)))
        overall = safe_divide(jnp.sum(by_class, axis=1), jnp.sum(by_class), 1.0 / len(m.solids))
        total = jnp.sum(by_class, axis=0)
        shares = jnp.where(total > 0, by_class / jnp.where(total > 0, total, 1.0), overall[:, None])
        carrier = humid.carrying(gas)
        return cls(m, shares, carrier / jnp.sum(carrier), gas.pressure)

    @property
    def humid(self) -> HumidMixture:
        """Which gas is the vapor, and what it is."""
        return HumidMixture(self.mixture)

    @property
    def vapor(self) -> int:
        """Its place among the gases."""
        return self.humid.vapor

    def blended(self, feed: Stream) -> Matter:
        """The same with one class of solid, the mean of them all."""
        flow = feed.solid_by_species
        share = safe_divide(flow, jnp.sum(flow), 1.0 / flow.shape[0])
        return eqx.tree_at(lambda m: m.solid_shares, self, share[:, None])

    def solid_enthalpy(self, T: Any) -> Any:
        """Dry solid; the last axis of T runs over the classes."""
        return jnp.einsum("s...m,sm->...m", self.mixture.enthalpies("solids", T), self.solid_shares)

    def liquid_enthalpy(self, T: Any) -> Any:
        """The liquid, with what it costs to keep in solution what is dissolved in it."""
        solvent = found = self.mixture.liquids[0].enthalpy(T)
        for i, (row, bound) in enumerate(deposits(self.mixture) if len(self.dissolved) else ()):
            crystal = (1.0 + bound) * self.mixture.solids[row].enthalpy(T)
            found += self.dissolved[i] * (self.mixture.liquids[i + 1].enthalpy(T) + bound * solvent - crystal)
        return found + self.mixture.heat_of_mixing(self._liquor(), T)

    def _liquor(self) -> Any:
        """The liquids that come with a kilogram of the one that can leave."""
        places = enumerate(deposits(self.mixture)) if len(self.dissolved) else ()
        whole = 1.0 + sum(self.dissolved[i] * bound for i, (_row, bound) in places)
        return (whole, *self.dissolved)

    def vapor_enthalpy(self, T: Any) -> Any:
        """Vapor."""
        return self.mixture.gases[self.vapor].enthalpy(T)

    def gas_enthalpy(self, T: Any) -> Any:
        """The carrier."""
        return jnp.tensordot(self.gas_shares, self.mixture.enthalpies("gases", T), axes=1)

    def moist_solid(self, T: Any, X: Any) -> Any:
        """Solid with its moisture, per kg dry."""
        return self.solid_enthalpy(T) + X * self.liquid_enthalpy(T)

    def moist_gas(self, T: Any, Y: Any) -> Any:
        """Gas with its vapor, per kg of the carrier."""
        return self.gas_enthalpy(T) + Y * self.vapor_enthalpy(T)

    def solid_temperature(self, H: Any, X: Any) -> Any:
        """Temperature of moist solid."""
        return _inverse(lambda T: self.moist_solid(T, X), H)

    def gas_temperature(self, H: Any, Y: Any) -> Any:
        """Temperature of moist gas."""
        return _inverse(lambda T: self.moist_gas(T, Y), H)

    def gas_heat_capacity(self, T: Any, Y: Any) -> Any:
        """Per kg of moist gas."""
        return slope(lambda T: self.moist_gas(T, Y), T)[1] / (1.0 + Y)

    def vapor_heat_capacity(self, T: Any) -> Any:
        """Vapor."""
        return slope(self.vapor_enthalpy, T)[1]

    def heat_of_vaporization(self, T: Any) -> Any:
        """Vapor less liquid at one temperature, as the streams count them."""
        return self.vapor_enthalpy(T) - self.liquid_enthalpy(T)

    @property
    def is_steam(self) -> Any:
        """Whether the vapor carries itself."""
        return self.gas_shares[self.vapor] > 0.0

    @property
    def molar_mass_ratio(self) -> Any:
        """Vapor over dry gas; one where there is none."""
        vapor = self.gas_shares[self.vapor]
        dry = 1.0 - vapor
        moles = self._carrier_moles - vapor
        return jnp.where(dry > NO_DRY_GAS, moles / jnp.where(dry > NO_DRY_GAS, dry, 1.0), 1.0)

    @property
    def _carrier_moles(self) -> Any:
        """In a kilogram of the carrier, over those in a kilogram of vapor."""
        moles = sum(self.gas_shares[i] / g.molar_mass for i, g in enumerate(self.mixture.gases))
        return self.mixture.gases[self.vapor].molar_mass * moles

    def left_over(self, Y: Any) -> Any:
        """Share of the steam that condensation has left to give heat; one for a gas that carries vapor."""
        return jnp.where(self.is_steam, jnp.clip(1.0 + Y, NO_DRY_GAS, 1.0), 1.0)

    def fraction(self, Y: Any) -> Any:
        """Mole fraction of the vapor."""
        return (self.gas_shares[self.vapor] + Y) / (self._carrier_moles + Y)

    def relative_humidity(self, T: Any, Y: Any) -> Any:
        """Partial pressure of the vapor over its saturation pressure."""
        return self.fraction(Y) * self.pressure / self.saturation_pressure(T)

    def saturation_pressure(self, T: Any) -> Any:
        """Of the liquid; held at the ends of a range which only a search on its way to the solution
        leaves.
        """
        return self.humid.saturation_pressure(jnp.clip(T, *LIQUID))

    def driving_force(self, partial_pressure: Any, fraction: Any) -> Any:
        """ln[(1 − w)/(1 − w_s)] of the mass fractions of vapor: Stefan flow in a film from a surface that has
        this partial pressure to gas of a mole fraction.

        Near pure vapor the logarithm goes on straight at either side, so that a surface in steam is as good
        as boiling: within 0.1 K for a gas 100 K hotter.
        """
        ratio = self.molar_mass_ratio

        def log_of(q: Any) -> Any:
            return jnp.log1p(ratio * q / (1.0 - q))

        def continued(q: Any) -> Any:
            value, rise = slope(log_of, jnp.asarray(NEAR_BOILING) + 0.0 * q)
            low = log_of(jnp.minimum(q, NEAR_BOILING))
            return jnp.where(q < NEAR_BOILING, low, value + rise * (q - NEAR_BOILING))

        return continued(partial_pressure / self.pressure) - continued(fraction)

    def gas_density(self, T: Any, Y: Any) -> Any:
        """Carrier per volume of gas, kg/m³."""
        vapor = self.mixture.gases[self.vapor].molar_mass
        return self.pressure * vapor / (GAS_CONSTANT * T * (self._carrier_moles + Y))


def slope(function: Callable[[Any], Any], T: Any) -> tuple[Any, Any]:
    """Value and derivative of an elementwise function."""
    T = jnp.asarray(T, dtype=float)
    return jax.jvp(function, (T,), (jnp.ones_like(T),))


def _inverse(function: Callable[[Any], Any], H: Any) -> Any:
    return temperature_at(function, H, jnp.full_like(H, ZERO_CELSIUS + 20.0))


def temperature_at(function: Callable[[Any], Any], H: Any, T: Any) -> Any:
    """Temperature at which an enthalpy, nearly linear in it, has a value; T is a guess. Derivatives come from
    the last step alone.
    """
    return straight_root(lambda T: function(T) - H, T, NEWTON_STEPS)
