"""Vapor and liquid of one substance in a gas stream: equilibrium at a temperature, or at the enthalpy the stream has."""

from __future__ import annotations

from functools import cache
from typing import Any

import jax.numpy as jnp

from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.humid_gas.pairs import AIR_WATER, AbstractPair
from granum.numerics import find_root
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream

COLDEST, HOTTEST = 200.0, 1500.0


@cache
def _pair(carrier: str, vapor: str) -> AbstractPair:
    from granum.humid_gas.solvents import GasAndVapor

    return AIR_WATER if (carrier, vapor) == ("dry air", "water") else GasAndVapor(gas=carrier, vapor=vapor)


class HumidMixture:
    """The gas–vapor pair in a mixture: its first gas carries the vapor of its first liquid."""

    def __init__(self, mixture: Mixture):
        names = [g.name for g in mixture.gases]
        if not mixture.liquids or mixture.liquids[0].name not in names or len(names) < 2:
            raise ApplicabilityError(
                _('The mixture needs a carrier gas, and its first liquid among the gases too: gases = ["dry air", "water"].')
            )
        self.vapor = mixture.index("gases", mixture.liquids[0].name)
        self.molar_masses = jnp.array([g.molar_mass for g in mixture.gases])
        carrier = next(g for i, g in enumerate(mixture.gases) if i != self.vapor)
        self.pair = _pair(carrier.name, mixture.liquids[0].name)

    def _dry_moles(self, stream: Stream) -> Any:
        moles = stream.gas / self.molar_masses
        return jnp.sum(moles) - moles[self.vapor]

    def saturated_vapor(self, stream: Stream, T: Any) -> Any:
        """Vapor that the dry gas of a stream holds at saturation over liquid, kg/s; very much above the boiling point."""
        y = jnp.minimum(self.pair.saturated_fraction(T, jnp.asarray(stream.pressure, dtype=float), False), 1.0 - 1e-9)
        return self._dry_moles(stream) * y / (1.0 - y) * self.molar_masses[self.vapor]

    def humidity_ratio(self, stream: Stream) -> Any:
        """Vapor per dry gas, by mass."""
        dry = stream.gas_flow - stream.gas[self.vapor]
        return stream.gas[self.vapor] / jnp.where(dry > 0, dry, 1.0)

    def relative_humidity(self, stream: Stream) -> Any:
        """Partial pressure of the vapor over its saturation pressure."""
        moles = stream.gas[self.vapor] / self.molar_masses[self.vapor]
        total = self._dry_moles(stream) + moles
        y = moles / jnp.where(total > 0, total, 1.0)
        return y / self.pair.saturated_fraction(jnp.asarray(stream.temperature), jnp.asarray(stream.pressure, dtype=float), False)

    def moved(self, stream: Stream, evaporated: Any) -> Stream:
        """The same temperature with some more of the liquid as vapor, kg/s; negative condenses."""
        return stream.replace(gas=stream.gas.at[self.vapor].add(evaporated), liquid=stream.liquid.at[0].add(-evaporated))

    def at_temperature(self, stream: Stream, T: Any) -> Stream:
        """Equilibrium at a temperature: saturated gas over liquid, or no liquid."""
        total = stream.gas[self.vapor] + stream.liquid[0]
        vapor = jnp.minimum(total, self.saturated_vapor(stream, T))
        return self.moved(stream, vapor - stream.gas[self.vapor]).replace(temperature=jnp.asarray(T, dtype=float))

    def at_own_enthalpy(self, stream: Stream) -> Stream:
        """Equilibrium reached adiabatically: liquid evaporates until it is gone or the gas is saturated; excess vapor condenses."""
        enthalpy, scale = stream.enthalpy_flow, jnp.maximum(stream.mass_flow, 1e-300) * 1e3
        root = find_root(
            lambda T: (self.at_temperature(stream, T).enthalpy_flow - enthalpy) / scale, COLDEST, HOTTEST, start=stream.temperature
        )
        return self.at_temperature(
            stream, jnp.where(stream.mass_flow > 0, jnp.where(root.converged, root.value, jnp.nan), stream.temperature)
        )
