"""Beds of grains that gas passes from below: well mixed, or so many tanks in series."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp

from granum.core.errors import InputError
from granum.core.i18n import _
from granum.drying.gas_solid.cells import Contact, Inlet, Network, Profile
from granum.drying.gas_solid.dryer import CellDryer, Through, ready
from granum.drying.gas_solid.liquor import composition, counted
from granum.drying.gas_solid.matter import Matter
from granum.drying.gas_solid.mixed import Bed, Gas, Solid, steady_bed, steady_tanks
from granum.fluidization.formulas.heat import nusselt_number_gunn
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream


class BedDryer(CellDryer):
    """With one cell the gas is one and particles stay for exponentially distributed times; with more, solid
    flows through that many tanks, each with fresh gas. Part of the gas may pass by the grains.
    """

    if TYPE_CHECKING:

        @property
        def cells(self) -> int: ...

        @property
        def void_fraction(self) -> Any: ...

    @abstractmethod
    def extent(self) -> Any:
        """Area that the gas crosses, m²."""

    @abstractmethod
    def holdup(self, feed: Stream) -> Any:
        """Dry solid in the bed, kg."""

    @abstractmethod
    def bypass(self, feed: Stream, gas: Stream) -> Any:
        """Share of the gas that leaves as it entered."""

    @property
    @abstractmethod
    def lost(self) -> Any:
        """Heat that the bed loses, W."""

    def _specific(self, feed: Stream, gas: Stream) -> Any:
        """Heat transfer coefficient times surface per dry solid of each size, W/(K kg), with Gunn's Nusselt
        number.
        """
        sizes = jnp.asarray(feed.mixture.sizes)
        conductivity = gas.gas_conductivity
        Re = gas.gas_flow / self.extent() * sizes / gas.gas_viscosity
        nusselt = nusselt_number_gunn.function(
            Re, gas.gas_heat_capacity * gas.gas_viscosity / conductivity, self.void_fraction
        )
        return nusselt * conductivity / sizes * 6.0 / (sizes * feed.solid_density)

    def contact(self, feed: Stream, gas: Stream) -> Contact:
        """Tanks in series; one tank has no ages, for which ``through`` is there."""
        n, bed = self.cells, self.bed(feed, gas)
        time, solid = bed.time / n, jnp.broadcast_to(bed.flow * bed.time / n, (n, bed.flow.shape[0]))
        return Contact(
            bed.matter,
            self.kinetics,
            solid,
            jnp.full_like(solid, 1.0) / time,
            bed.gas_flow,
            Network.cross_current(n),
            lambda X, Ts, Tg, Y: bed.exchange,
            heat_loss=self.lost / n,
        )

    def bed(self, feed: Stream, gas: Stream) -> Bed:
        """The whole bed, the feed ``counted`` as dry matter and water."""
        matter = Matter.of(feed, gas)
        dry = matter.humid.carrier_flow(gas) * (1.0 - self.bypass(feed, gas))
        time = self.holdup(feed) / jnp.maximum(feed.solid_flow, 1e-12)
        return Bed(matter, self.kinetics, self._specific(feed, gas), feed.solid_by_size, time, dry, self.lost)

    def through(self, feed: Stream, gas: Stream) -> Through:
        found, share = _passed(self, feed, gas), self.bypass(counted(feed), gas)  # as the bed counts it
        humid = HumidMixture(feed.mixture)
        vapor = humid.vapor_per_carrier(gas) * humid.carrier_flow(gas)
        past = gas.part(gas=share).enthalpy_flow  # what bypasses rejoins above the bed
        found = found._replace(vapor=found.vapor + share * vapor, gas_enthalpy=found.gas_enthalpy + past)
        return Through(found, 1.0 * self.holdup(feed))

    def dynamic(
        self, feed: Stream, gas: Stream, step: Any, inlets: Inlet, start: Any = None
    ) -> tuple[Profile, Any]:
        """In time, of a bed with tanks in series."""
        if self.cells == 1:
            raise InputError(
                _(
                    "A well-mixed bed in time would need the ages of its particles: take a fluidized bed "
                    "with 'cells' = 2 or more for a bed in time."
                )
            )
        return super().dynamic(feed, gas, step, inlets, start)


@ready
def _passed(dryer: BedDryer, feed: Stream, gas: Stream) -> Profile:
    dry, n = counted(feed), dryer.cells
    bed = dryer.bed(dry, gas)
    bed = replace(bed, matter=replace(bed.matter, dissolved=composition(feed)))
    X = jnp.full(len(feed.mixture.sizes), 1.0) * dry.moisture_dry_basis
    before, fresh = (
        Solid(X, jnp.full_like(X, 1.0) * feed.temperature),
        Gas(bed.matter.humid.vapor_per_carrier(gas), jnp.asarray(gas.temperature, dtype=float)),
    )
    if n == 1:
        return steady_bed(bed, before, fresh)
    return steady_tanks(
        replace(bed, time=bed.time / n, gas_flow=bed.gas_flow / n, heat_loss=bed.heat_loss / n),
        before,
        fresh,
        n,
    )
