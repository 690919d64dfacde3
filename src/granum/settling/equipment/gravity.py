"""What all gravity settlers share: settling velocity of every class, split into underflow and overflow."""

from __future__ import annotations

import abc
from dataclasses import KW_ONLY
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core.constants import STANDARD_GRAVITY
from granum.core.kinds import Concentration, Fraction, Law, Speed, VolumeFlow, Within
from granum.core.limits import Limit
from granum.particles.formulas.drag_modern import drag_coefficient_brown_lawler
from granum.particles.formulas.hindered import hindrance_richardson_zaki
from granum.particles.formulas.numbers import reynolds_number
from granum.particles.formulas.terminal import terminal_velocity
from granum.settling.equipment.carriers import Carrier
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit

Drag = Annotated[Any, Law("drag_coefficient")]
Hindrance = Annotated[Any, Law("hindrance")]
# what leaves thicker than it came cannot hold nothing
Thickness = Annotated[Concentration, Within(1e-3)]
DRAG, HINDRANCE = drag_coefficient_brown_lawler, hindrance_richardson_zaki


class Outlets(NamedTuple):
    """Thick and clear stream."""

    underflow: Stream
    overflow: Stream


class Skimmed(NamedTuple):
    """Thick and clear stream, and what is skimmed off the surface."""

    underflow: Stream
    overflow: Stream
    skimmings: Stream


class Figures(NamedTuple):
    """Figures of a settler."""

    overflow_rate: Speed
    removal_efficiency: Fraction
    underflow_volume_flow: VolumeFlow
    underflow_concentration: Concentration
    overflow_concentration: Concentration


class Settled(NamedTuple):
    """Settling velocity that is removed completely, m/s; the shares that sink and that float out, of each
    species and size class.
    """

    critical: Any
    sunk: Any
    floated: Any


def class_velocities(
    feed: Stream, drag: Any, hindrance: Any, effect: Any = 1.0, carrier: Carrier | None = None
) -> Any:
    """Hindered settling velocity of each species and size class, m/s; negative for what rises.

    In a field of so many times gravity (``effect``) the velocity is told per unit of it, with the drag of the
    Reynolds number that the particle has there. A ``carrier`` takes the place of the liquid's viscosity and
    of the drag.
    """
    m = feed.mixture
    density = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
    size = jnp.asarray(m.sizes) + 0.0 * density
    liquid = feed.liquid_density, feed.liquid_viscosity
    there = jnp.sum(feed.solid, axis=tuple(range(2, feed.solid.ndim))) > 0
    if carrier is None:
        alone = terminal_velocity(size, density, *liquid, effect * STANDARD_GRAVITY, drag)
        reynolds = reynolds_number(size, jnp.abs(alone), *liquid)
    else:
        alone, reynolds = carrier.falling(size, density, feed.liquid_density, there)
    # what is not there shall not be told to lie outside the range of a law
    reynolds = jnp.where(there, reynolds, 1.0)
    crowd = jnp.clip(feed.solids_volume_fraction, 1e-12, 1.0 - 1e-9)
    return alone / effect * hindrance(crowd, reynolds)


def floats(feed: Stream) -> Any:
    """Which species of solid are lighter than the liquid: 1 or 0 of each."""
    return 1.0 * (feed.mixture.densities("solids", feed.temperature) < feed.liquid_density)


def floating_share(feed: Stream) -> Any:
    """Share of the solid, by mass, that is lighter than the liquid."""
    total = feed.solid_flow
    return feed.solid_by_species @ floats(feed) / jnp.where(total > 0, total, 1.0)


def over_axes(share: Any, feed: Stream) -> Any:
    """A matrix over species and sizes shaped to multiply ``solid``."""
    return share.reshape(share.shape + (1,) * len(feed.mixture.axes))


def concentration(stream: Stream) -> Any:
    """Solids per volume of slurry, kg/m³; zero when there is none."""
    volume = stream.slurry_volume_flow
    return jnp.where(volume > 0, stream.solid_flow / jnp.where(volume > 0, volume, 1.0), 0.0)


def divide(feed: Stream, removed: Any, underflow_concentration: Any) -> Outlets:
    """Underflow with the removed share of the solids, thickened to a concentration; the rest is overflow.

    When the feed does not hold enough liquid for that concentration, all of it goes down: the underflow is
    then thicker.
    """
    settled = feed.part(solid=removed)
    liquid = settled.solid_flow / underflow_concentration - settled.solid_volume_flow
    available = feed.liquid_volume_flow
    share = jnp.clip(liquid / jnp.where(available > 0, available, 1.0), 0.0, 1.0)
    return Outlets(
        feed.part(solid=removed, liquid=share), feed.part(solid=1.0 - removed, liquid=1.0 - share, gas=1.0)
    )


def skim(feed: Stream, sunk: Any, floated: Any, below: Any, above: Any) -> Skimmed:
    """Underflow and skimmings with their shares of the solids, each thickened to its concentration; the rest
    is overflow.

    When the feed does not hold enough liquid for both, what there is is shared out.
    """
    bottom, top = feed.part(solid=sunk), feed.part(solid=floated)
    available = feed.liquid_volume_flow

    def liquid(part: Stream, concentration: Any) -> Any:
        wanted = jnp.maximum(part.solid_flow / concentration - part.solid_volume_flow, 0.0)
        return wanted / jnp.where(available > 0, available, 1.0)

    under, over = liquid(bottom, below), liquid(top, above)
    scale = 1.0 / jnp.maximum(under + over, 1.0)
    under, over = under * scale, over * scale
    return Skimmed(
        feed.part(solid=sunk, liquid=under),
        feed.part(solid=1.0 - sunk - floated, liquid=1.0 - under - over, gas=1.0),
        feed.part(solid=floated, liquid=over),
    )


class AbstractSettler(Unit):
    """A settler that removes each size class by its settling velocity against a velocity of the equipment:
    what sinks with the underflow, what is lighter than the liquid by rising to a skimmer.
    """

    if TYPE_CHECKING:  # a field of every subclass
        underflow_concentration: Any

    _: KW_ONLY
    skimmings_concentration: Thickness = 500.0

    limits: ClassVar[Limits] = {
        "thinner": Limit("feed thinner than the underflow", 0.0, 1.0, "dimensionless", "coe1916")
    }

    @abc.abstractmethod
    def critical_velocity(self, feed: Stream) -> Any:
        """Settling velocity that is removed completely, m/s."""

    @abc.abstractmethod
    def removed(self, velocity: Any, critical: Any) -> Any:
        """Share removed at each speed of sinking or rising."""

    @abc.abstractmethod
    def velocities(self, feed: Stream) -> Any:
        """Settling velocity of each species and size class, m/s; negative for what rises."""

    def inside(self, feed: Stream) -> Settled:
        critical, velocity = self.critical_velocity(feed), self.velocities(feed)
        share = self.removed(jnp.abs(velocity), critical)
        return Settled(critical, jnp.where(velocity > 0, share, 0.0), jnp.where(velocity < 0, share, 0.0))

    def outlets(self, inside: Settled, feed: Stream) -> Skimmed:
        shares = over_axes(inside.sunk, feed), over_axes(inside.floated, feed)
        return skim(feed, *shares, self.underflow_concentration, self.skimmings_concentration)

    def figures(self, inside: Settled, outlets: Skimmed, feed: Stream) -> Figures:
        some = jnp.where(feed.solid_flow > 0, feed.solid_flow, 1.0)
        return Figures(
            inside.critical,
            (outlets.underflow.solid_flow + outlets.skimmings.solid_flow) / some,
            outlets.underflow.slurry_volume_flow,
            concentration(outlets.underflow),
            concentration(outlets.overflow),
        )

    def measured(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        return {"thinner": concentration(feed) / self.underflow_concentration}
