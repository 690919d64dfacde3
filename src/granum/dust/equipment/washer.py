"""What all scrubbers share: gas that leaves in equilibrium with its water, and the dust in the water."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core.flags import unsolved
from granum.dust.equipment.collector import Collector, over_axes
from granum.numerics.smooth import safe_divide
from granum.streams.equilibrium import HumidMixture
from granum.streams.equipment.humid_gas import UNSOLVED
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream
from granum.streams.units import Utilities
from granum.streams.utilities import FANNED, fanned

MOST_LIQUID = 0.1  # volume of liquid per gas
SLOWEST = 1e-3  # m/s


class Scrubbed(NamedTuple):
    """Moist gas with what escapes, and the water with the dust."""

    gas: Stream
    slurry: Stream


class Washed(NamedTuple):
    """What happens in a scrubber: gas velocity, water per gas, size of the bodies that catch, pressure lost,
    the mixture in equilibrium, and the share caught of each species and class.
    """

    velocity: Any
    ratio: Any
    body: Any
    lost: Any
    mixed: Stream
    share: Any


class Washer(Collector):
    """Abstract scrubber: gas and water leave in equilibrium, all water out of the gas."""

    if TYPE_CHECKING:

        def inside(self, feed: Stream, water: Stream) -> Washed: ...

    utilities: ClassVar[Utilities] = FANNED

    def ratio(self, feed: Stream, water: Stream) -> Any:
        """Volume of water per volume of gas."""
        found = safe_divide(water.liquid_volume_flow, feed.gas_volume_flow)
        return jnp.where(feed.gas_volume_flow > 0.0, jnp.minimum(found, MOST_LIQUID), 0.0)

    def mixed(self, feed: Stream, water: Stream, lost: Any) -> Stream:
        """Gas and water in equilibrium at their own enthalpy, at the pressure that is left."""
        both = feed + water
        both = both.replace(pressure=pressure_left(feed, lost, type(self).card))
        found = HumidMixture(feed.mixture).at_own_enthalpy(both)
        unsolved(jnp.isfinite(found.temperature), type(self).card, reason=UNSOLVED)
        return found

    def outlets(self, inside: Washed, feed: Stream, water: Stream) -> Scrubbed:
        mixed = inside.mixed
        kept = water.solid + feed.solid * over_axes(inside.share, feed)
        return Scrubbed(
            mixed.replace(solid=mixed.solid - kept, liquid=jnp.zeros_like(mixed.liquid)),
            mixed.replace(solid=kept, gas=jnp.zeros_like(mixed.gas)),
        )

    def cleaned(self, inside: Washed, outlets: Scrubbed, feed: Stream, water: Stream) -> tuple[Any, ...]:
        """The figures that every scrubber ends with: temperature, water evaporated, efficiency, emission."""
        gone = feed.liquid_flow + water.liquid_flow - outlets.slurry.liquid_flow
        caught = jnp.sum(feed.solid * over_axes(inside.share, feed))
        return (
            outlets.gas.temperature,
            jnp.maximum(gone, 0.0),
            safe_divide(caught, feed.solid_flow),
            self.emission(outlets.gas),
        )

    def drawn(
        self, inside: Washed, outlets: Scrubbed, figures: Any, feed: Stream, water: Stream
    ) -> dict[str, Any]:
        return {"electric_power_fan": fanned(feed.gas_volume_flow, inside.lost)}
