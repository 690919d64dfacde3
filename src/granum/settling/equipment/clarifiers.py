"""Clarifiers rated by grade efficiency: any plan, circular scraped, rectangular, lamella, grit chamber."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import jax.numpy as jnp

from granum.core import equipment
from granum.core.constants import DAY, HOUR
from granum.core.kinds import Angle, Area, Length, PositiveNumber, Ratio, VolumeFlow
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.settling.equipment.carriers import Carried
from granum.settling.equipment.gravity import (
    DRAG,
    HINDRANCE,
    AbstractSettler,
    Drag,
    Figures,
    Hindrance,
    Settled,
    Skimmed,
    Thickness,
    class_velocities,
)
from granum.settling.equipment.rakes import CLARIFIER, RAKED, raked, scraped
from granum.settling.formulas.basins import removal_efficiency_camp, removal_efficiency_hazen
from granum.settling.formulas.lamella import (
    critical_velocity_cocurrent,
    critical_velocity_countercurrent,
    critical_velocity_crosscurrent,
)
from granum.streams.holdup import Held, at_rest, filled, mass, mixed
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream
from granum.streams.units import Dynamic, Limits, Utilities
from granum.streams.utilities import AREA


def grade_efficiency(velocity: Any, critical: Any, tank_number: Any) -> Any:
    """Share removed at each settling velocity: ideal basin, or mixed tanks in series when their number is
    given.
    """
    falling = jnp.maximum(velocity, 1e-300)
    critical = jnp.maximum(critical, 1e-150)  # nothing flows: its square still divides, for the derivative
    share = (
        removal_efficiency_camp(falling, critical)
        if tank_number is None
        else removal_efficiency_hazen(falling, critical, tank_number)
    )
    return jnp.where(velocity > 0, share, 0.0)


class AbstractBasin(Carried, AbstractSettler):
    """A settler whose critical velocity is its overflow rate: volume flow of the feed over a settling
    area.
    """

    if TYPE_CHECKING:  # fields of every subclass
        tank_number: Any
        drag: Any
        hindrance: Any

    @abc.abstractmethod
    def settling_area(self) -> Any:
        """Area on which solids settle, m²."""

    def critical_velocity(self, feed: Stream) -> Any:
        return feed.slurry_volume_flow / self.settling_area()

    def velocities(self, feed: Stream) -> Any:
        return class_velocities(feed, self.drag, self.hindrance, carrier=self.carrier)

    def removed(self, velocity: Any, critical: Any) -> Any:
        return grade_efficiency(velocity, critical, self.tank_number)


@equipment("clarifier", source="hazen1904; camp1946", title="Clarifier")
class Clarifier(AbstractBasin):
    """Gravity settler of a given area that removes each size class by its hindered settling velocity.

    Ideal basin (Camp) unless a number of mixed tanks (Hazen) is given. The overflow rate is that of the whole
    feed, which is on the safe side of the true one by the underflow. Sizing and rating are the same
    statement: area times critical velocity is the feed's volume flow.

    A liquid that does not follow Newton is given by its ``consistency``, viscosity at 1/s, with the
    ``flow_index`` of a power law, the ``yield_stress`` of a Bingham liquid, or both. Grains then fall as
    single spheres in it at rest, whatever the flow thins, and hinder one another as in a liquid of Newton
    at the same Reynolds number: our own simplification.
    """

    area: Area
    underflow_concentration: Thickness
    tank_number: PositiveNumber | None = None
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE

    utilities: ClassVar[Utilities] = RAKED | AREA

    def settling_area(self) -> Any:
        return self.area

    @classmethod
    def size(
        cls, volume_flow: VolumeFlow, settling_velocity: Any, underflow_concentration: Any, **more: Any
    ) -> Clarifier:
        """The clarifier that just removes completely what settles at a given (hindered) velocity."""
        return cls(
            area=volume_flow / settling_velocity, underflow_concentration=underflow_concentration, **more
        )

    def drawn(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_rake": raked(self.area, CLARIFIER), "area_installed": self.area}


class _Deep(AbstractBasin, Dynamic):
    """A basin of known depth: over time it evens out its feed as one mixed volume, which then settles as it
    does at rest.

    The sludge on its floor is scraped out at once. A start-up begins with a basin full of the first liquid.
    """

    if TYPE_CHECKING:
        height: Any

    @property
    def volume(self) -> Any:
        """Of the basin, m³."""
        return self.settling_area() * self.height

    def initial_holdup(self, mixture: Mixture) -> Held:
        return filled(mixture, self.volume)

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Held:
        return at_rest(inlets["feed"], self.volume)

    def held_mass(self, state: Held) -> Any:
        return mass(state)

    def advance(
        self, state: Held, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any
    ) -> tuple[Held, Skimmed]:
        state, evened = mixed(state, before["feed"], after["feed"], self.volume, step)
        return state, self(evened)


WEIRS: Limits = {
    "surface": Limit("overflow rate", 0.0, 120.0 / DAY, "m/s", "metcalf2003"),
    "weir": Limit("flow over the weir per length", 0.0, 500.0, "m^2/day", "metcalf2003"),
}


@equipment("circular_clarifier", source="degremont2007; hazen1904", title="Circular scraped clarifier")
class CircularClarifier(_Deep):
    """Circular clarifier with a rotating scraper, fed in the center.

    Practical limits: diameter at most 50 to 60 m, depth at the wall 2 to 3.5 m, bottom slope 4 to 8 %; at
    peak flow 120 m/d on its area and 500 m²/d over its weir, which is the wall unless a length is given.
    """

    diameter: Length
    height: Length
    underflow_concentration: Thickness
    bottom_slope: Ratio = 0.06
    tank_number: PositiveNumber | None = 3.0
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE
    weir_length: Length | None = None

    limits: ClassVar[Limits] = (
        AbstractBasin.limits
        | WEIRS
        | {
            "diameter": Limit("diameter", 0.0, 60.0, "m", "degremont2007"),
            "depth": Limit("depth at the wall", 2.0, 3.5, "m", "degremont2007"),
            "slope": Limit("bottom slope", 0.04, 0.08, "dimensionless", "degremont2007"),
            "time": Limit("residence time", 1.5, 4.0, "hour", "metcalf2003"),
        }
    )

    utilities: ClassVar[Utilities] = RAKED | AREA

    def settling_area(self) -> Any:
        return jnp.pi / 4.0 * self.diameter**2

    def measured(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        weir = jnp.pi * self.diameter if self.weir_length is None else self.weir_length
        return super().measured(inside, outlets, figures, feed) | {
            "surface": figures.overflow_rate,
            "weir": outlets.overflow.slurry_volume_flow / weir * DAY,
            "diameter": self.diameter,
            "depth": self.height,
            "slope": self.bottom_slope,
            "time": self.volume / feed.slurry_volume_flow / HOUR,
        }

    def drawn(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        area = self.settling_area()
        return {"electric_power_rake": raked(area, CLARIFIER), "area_installed": area}


@equipment("rectangular_clarifier", source="degremont2007; camp1946", title="Rectangular clarifier")
class RectangularClarifier(_Deep):
    """Rectangular clarifier with a traveling bridge or chain scraper.

    Practical limits: width to length about 1 to 6, depth 2.5 to 4 m, and a horizontal velocity that does not
    scour the sludge; at peak flow 120 m/d on its area and, where the length of its weirs is given, 500 m²/d
    over them.
    """

    length: Length
    width: Length
    height: Length
    underflow_concentration: Thickness
    tank_number: PositiveNumber | None = 3.0
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE
    weir_length: Length | None = None

    limits: ClassVar[Limits] = (
        AbstractBasin.limits
        | WEIRS
        | {
            "shape": Limit("length over width", 3.0, 6.5, "dimensionless", "degremont2007"),
            "depth": Limit("depth", 2.5, 4.0, "m", "degremont2007"),
            "velocity": Limit("horizontal velocity", 0.0, 0.025, "m/s", "metcalf2003"),
            "time": Limit("residence time", 1.5, 4.0, "hour", "metcalf2003"),
        }
    )

    utilities: ClassVar[Utilities] = RAKED | AREA

    def settling_area(self) -> Any:
        return self.length * self.width

    def measured(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        flow, clear = feed.slurry_volume_flow, outlets.overflow.slurry_volume_flow
        weir = {} if self.weir_length is None else {"weir": clear / self.weir_length * DAY}
        return (
            super().measured(inside, outlets, figures, feed)
            | weir
            | {
                "surface": figures.overflow_rate,
                "shape": self.length / self.width,
                "depth": self.height,
                "velocity": flow / (self.width * self.height),
                "time": self.volume / flow / HOUR,
            }
        )

    def drawn(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        return {
            "electric_power_rake": scraped(self.length, self.width),
            "area_installed": self.settling_area(),
        }


_FLOWS = {
    "countercurrent": critical_velocity_countercurrent,
    "cocurrent": critical_velocity_cocurrent,
    "crosscurrent": critical_velocity_crosscurrent,
}


@equipment("lamella", source="yao1970; degremont2007", title="Lamella settler")
class Lamella(Carried, AbstractSettler):
    """Lamella settler: a pack of inclined plates, with the water against, with or across the sliding
    sludge.

    The critical velocity is Yao's. Practical limits: 45 to 60° from the horizontal, spacing 10 to 20 cm on
    raw water (down to 5 cm on clean duties), Reynolds number between the plates below 800.

    A liquid that does not follow Newton is given by its ``consistency``, viscosity at 1/s, with
    ``flow_index``, ``yield_stress`` or both. Yao's velocity between wide plates is the same whatever the
    profile of the flow. Grains fall as in that liquid at rest, though between plates it is sheared, and
    one that thins would let them fall faster: on the safe side.
    """

    plate_number: PositiveNumber
    plate_length: Length
    plate_width: Length
    plate_spacing: Length
    underflow_concentration: Thickness
    plate_angle: Angle = 1.0471975511965976
    flow_direction: Literal["countercurrent", "cocurrent", "crosscurrent"] = "countercurrent"
    tank_number: PositiveNumber | None = None
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE

    limits: ClassVar[Limits] = AbstractSettler.limits | {
        "angle": Limit("angle of the plates", 45.0, 60.0, "degree", "degremont2007"),
        "spacing": Limit("spacing of the plates", 0.05, 0.2, "m", "degremont2007"),
        "reynolds": Limit("Reynolds number between the plates", 0.0, 800.0, "dimensionless", "degremont2007"),
    }

    utilities: ClassVar[Utilities] = AREA

    def plate_velocity(self, feed: Stream) -> Any:
        """Mean velocity of the water between the plates, m/s."""
        across = self.plate_length if self.flow_direction == "crosscurrent" else self.plate_width
        return feed.slurry_volume_flow / (self.plate_number * across * self.plate_spacing)

    def critical_velocity(self, feed: Stream) -> Any:
        along = self.plate_width if self.flow_direction == "crosscurrent" else self.plate_length
        return _FLOWS[self.flow_direction](
            self.plate_velocity(feed), along, self.plate_spacing, self.plate_angle
        )

    def velocities(self, feed: Stream) -> Any:
        return class_velocities(feed, self.drag, self.hindrance, carrier=self.carrier)

    def removed(self, velocity: Any, critical: Any) -> Any:
        return grade_efficiency(velocity, critical, self.tank_number)

    def measured(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        speed, gap, carrier = self.plate_velocity(feed), self.plate_spacing, self.carrier
        thick = feed.liquid_viscosity if carrier is None else carrier.between_plates(speed, gap)
        return super().measured(inside, outlets, figures, feed) | {
            "angle": jnp.rad2deg(self.plate_angle),
            "spacing": gap,
            "reynolds": safe_divide(2.0 * speed * gap * feed.liquid_density, thick),
        }

    def drawn(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        return {"area_installed": self.plate_number * self.plate_length * self.plate_width}


@equipment("grit_chamber", source="camp1946; metcalf2003", title="Grit chamber")
class GritChamber(AbstractBasin):
    """Grit chamber: a channel fast enough to carry organic matter through and slow enough to let sand settle.

    Practical limits: horizontal velocity about 0.3 m/s (0.25 to 0.4), residence time 45 to 90 s.
    """

    length: Length
    width: Length
    height: Length
    underflow_concentration: Thickness = 500.0
    tank_number: PositiveNumber | None = None
    drag: Drag = DRAG
    hindrance: Hindrance = HINDRANCE

    limits: ClassVar[Limits] = AbstractBasin.limits | {
        "velocity": Limit("horizontal velocity", 0.25, 0.4, "m/s", "metcalf2003"),
        "time": Limit("residence time", 45.0, 90.0, "s", "metcalf2003"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def settling_area(self) -> Any:
        return self.length * self.width

    def measured(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        flow = feed.slurry_volume_flow
        return super().measured(inside, outlets, figures, feed) | {
            "velocity": flow / (self.width * self.height),
            "time": self.settling_area() * self.height / flow,
        }

    def drawn(self, inside: Settled, outlets: Skimmed, figures: Figures, feed: Stream) -> dict[str, Any]:
        return {
            "electric_power_rake": scraped(self.length, self.width),
            "area_installed": self.settling_area(),
        }
