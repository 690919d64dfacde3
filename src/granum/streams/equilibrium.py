"""Vapor and liquid of one substance in a gas stream: which they are, and their equilibrium at a temperature
or at the enthalpy of the stream.

Nothing else knows which gas of a mixture is the vapor and which liquid it belongs to.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core.constants import ZERO_CELSIUS
from granum.core.errors import ApplicabilityError
from granum.core.i18n import _
from granum.humid_gas.pairs import AIR_WATER, AbstractPair
from granum.humid_gas.relations import dew_point
from granum.materials.fluids import Fluid
from granum.materials.library import Library
from granum.materials.pairs import gas_vapor
from granum.numerics import find_root
from granum.streams.mixture import AIR, STEAM, Mixture, carrier_of
from granum.streams.stream import Stream

COLDEST, HOTTEST = 200.0, 1500.0
PURE = 1e6  # humidity ratio of a gas that is all vapor
NEARLY_PURE = 1e-9  # dry gas over vapor below which there is a boiling point and no dew point


@lru_cache(maxsize=64)
def _pair(materials: Library, carrier: str, vapor: str) -> AbstractPair:
    from granum.humid_gas.solvents import PairOfMixture

    return (
        AIR_WATER
        if (carrier, vapor) == (AIR, "water")
        else PairOfMixture(gas=carrier, vapor=vapor, materials=materials)
    )


class HumidMixture:
    """The gas–vapor pair in a mixture: the vapor is the gas of the name of its first liquid, wherever it
    stands; the rest of the gas carries it.

    Of several carriers the pair is made with dry air, else with the first by name; all of them count in
    humidity and saturation. A vapor ``alone`` has no carrier: steam.
    """

    def __init__(self, mixture: Mixture, *, alone: bool = False):
        names = [g.name for g in mixture.gases]
        if not mixture.liquids or mixture.liquids[0].name not in names:
            raise ApplicabilityError(
                _(
                    "The mixture needs its first liquid among the gases too, as its vapor: gases = "
                    '["dry air", "{liquid}"]; it has {gases}.'
                ).format(
                    liquid=mixture.liquids[0].name if mixture.liquids else "water",
                    gases=", ".join(names) or _("none"),
                )
            )
        self.mixture = mixture
        self.solvent = mixture.liquids[0].name
        self.vapor = mixture.index("gases", self.solvent)
        self.carrier = carrier_of(names, self.solvent)
        if self.carrier is None and not alone:
            raise ApplicabilityError(
                _(
                    'The mixture needs a gas that carries the vapor of {liquid}: gases = ["dry air", '
                    '"{liquid}"]. With superheated steam alone the two stand there too, and the feed says '
                    'gas = {{ "{liquid}" = 1.0 }}.'
                ).format(liquid=self.solvent)
            )
        # alone it saturates as in any gas
        self.pair = _pair(mixture.materials, self.carrier or AIR, self.solvent)
        self.molar_masses = np.array([g.molar_mass for g in mixture.gases])

    @property
    def fluid(self) -> Fluid:
        """The substance that evaporates."""
        return self.mixture.materials.fluid(self.solvent)

    @property
    def lewis_factor(self) -> Any:
        """Heat over mass transfer, h/(k_Y c): one for water in air."""
        factor = self.pair.lewis_factor()
        return 1.0 if factor is None else factor

    def diffusivity(self, T: Any, P: Any) -> Any:
        """Of the vapor in the carrier, m²/s."""
        return gas_vapor(self.solvent, self.carrier or AIR, self.mixture.materials).diffusivity(T, P)

    def saturation_pressure(self, T: Any) -> Any:
        """Over liquid, Pa."""
        return self.pair.saturated_fraction(T, 1.0, False)

    def boiling_temperature(self, P: Any) -> Any:
        """Of the liquid, K."""
        return self.pair.boiling_temperature(P)

    @property
    def freezing_temperature(self) -> float:
        """Of the liquid, K; for solvents where the vapor pressure of the liquid begins."""
        return ZERO_CELSIUS if self.solvent == "water" else float(self.pair.freezing_temperature)

    def heat_of_vaporization(self, T: Any) -> Any:
        """Of the real fluid, J/kg; the difference of the enthalpies of the streams lies within their
        approximation of it.
        """
        return self.fluid.heat_of_vaporization.value(T)

    def dry_flow(self, stream: Stream) -> Any:
        """Gas less its vapor, kg/s."""
        return stream.gas_flow - stream.gas[self.vapor]

    def _dry_moles(self, stream: Stream) -> Any:
        moles = stream.gas / self.molar_masses
        return jnp.sum(moles) - moles[self.vapor]

    def fraction(self, stream: Stream) -> Any:
        """Mole fraction of the vapor in the gas; zero where there is no gas."""
        moles = stream.gas[self.vapor] / self.molar_masses[self.vapor]
        total = self._dry_moles(stream) + moles
        return moles / jnp.where(total > 0, total, 1.0)

    def saturated_vapor(self, stream: Stream, T: Any) -> Any:
        """Vapor that the dry gas of a stream holds at saturation over liquid, kg/s; more than there is from
        the boiling point on.
        """
        y = self.pair.saturated_fraction(T, jnp.asarray(stream.pressure, dtype=float), False)
        below = jnp.minimum(y, 1.0 - 1e-9)
        return jnp.where(
            y < 1.0,
            self._dry_moles(stream) * below / (1.0 - below) * self.molar_masses[self.vapor],
            1e9 * stream.mass_flow,
        )

    def carrying(self, stream: Stream) -> Any:
        """The gas, kg/s of each species, that carries the vapor which a dryer counts: the dry gas; steam is
        its own carrier.
        """
        dry = stream.gas.at[self.vapor].set(0.0)
        return jnp.where(stream.gas[self.vapor] > STEAM * stream.gas_flow, stream.gas, dry)

    def carrier_flow(self, stream: Stream) -> Any:
        """All of it, kg/s."""
        return jnp.sum(self.carrying(stream))

    def vapor_per_carrier(self, stream: Stream) -> Any:
        """The vapor besides, kg/kg: humidity of a gas, zero for steam."""
        carrier = self.carrying(stream)
        total = jnp.sum(carrier)
        return (stream.gas[self.vapor] - carrier[self.vapor]) / jnp.where(total > 0, total, 1.0)

    def humidity_ratio(self, stream: Stream) -> Any:
        """Vapor per dry gas, by mass; a million for pure vapor."""
        vapor = stream.gas[self.vapor]
        dry = jnp.maximum(self.dry_flow(stream), vapor / PURE)
        return vapor / jnp.where(dry > 0, dry, 1.0)

    def superheat(self, stream: Stream) -> Any:
        """Temperature of a gas above that at which its vapor begins to condense, K."""
        P = jnp.asarray(stream.pressure, dtype=float)
        return stream.temperature - dew_point(self.pair, P, self.fraction(stream))

    def relative_humidity(self, stream: Stream) -> Any:
        """Partial pressure of the vapor over its saturation pressure."""
        return self.fraction(stream) / self.pair.saturated_fraction(
            jnp.asarray(stream.temperature), jnp.asarray(stream.pressure, dtype=float), False
        )

    def moved(self, stream: Stream, evaporated: Any) -> Stream:
        """The same temperature with some more of the liquid as vapor, kg/s; negative condenses."""
        return stream.replace(
            gas=stream.gas.at[self.vapor].add(evaporated), liquid=stream.liquid.at[0].add(-evaporated)
        )

    def at_temperature(self, stream: Stream, T: Any) -> Stream:
        """Equilibrium at a temperature: saturated gas over liquid, or no liquid."""
        total = stream.gas[self.vapor] + stream.liquid[0]
        vapor = jnp.minimum(total, self.saturated_vapor(stream, T))
        return self.moved(stream, vapor - stream.gas[self.vapor]).replace(
            temperature=jnp.asarray(T, dtype=float)
        )

    def at_own_enthalpy(self, stream: Stream) -> Stream:
        """Equilibrium reached adiabatically: liquid evaporates until it is gone or the gas is saturated;
        excess vapor condenses.
        """
        enthalpy, scale = stream.enthalpy_flow, jnp.maximum(stream.mass_flow, 1e-300) * 1e3
        root = find_root(
            lambda T: (self.at_temperature(stream, T).enthalpy_flow - enthalpy) / scale,
            COLDEST,
            HOTTEST,
            start=stream.temperature,
        )
        known = stream.mass_flow > 0
        found = self.at_temperature(
            stream, jnp.where(known, jnp.where(root.converged, root.value, jnp.nan), stream.temperature)
        )
        total = stream.gas[self.vapor] + stream.liquid[0]
        alone = (self.dry_flow(stream) <= NEARLY_PURE * total) & (total > 0)
        return lax.cond(alone, lambda: self._boiling(stream, enthalpy, found), lambda: found)

    def _boiling(self, stream: Stream, enthalpy: Any, otherwise: Stream) -> Stream:
        """A vapor without gas boils at one temperature, at which its enthalpy says how much of it is
        liquid.
        """
        T = jnp.asarray(self.boiling_temperature(stream.pressure), dtype=float)
        total = stream.gas[self.vapor] + stream.liquid[0]
        liquid = self.moved(stream, -stream.gas[self.vapor]).replace(temperature=T)
        latent = self.moved(liquid, total).enthalpy_flow - liquid.enthalpy_flow
        share = (enthalpy - liquid.enthalpy_flow) / latent
        both = self.moved(liquid, jnp.clip(share, 0.0, 1.0) * total)
        return jax.tree.map(lambda a, b: jnp.where((share > 0.0) & (share < 1.0), a, b), both, otherwise)
