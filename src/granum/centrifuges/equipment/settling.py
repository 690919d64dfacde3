"""Clarifying centrifuges in a line: tubular bowl, disc stack, solid basket. Each species and size class by
its own grade efficiency.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.centrifuges.equipment.bowls import (
    CRITICAL,
    Bowl,
    held_liquid,
    machine_limits,
    no_floats,
    slender,
)
from granum.centrifuges.formulas.clarifying import (
    grade_efficiency_tubular,
    sigma_factor_disc,
    sigma_factor_tubular_half_area,
)
from granum.centrifuges.formulas.field import centrifugal_effect
from granum.centrifuges.formulas.mechanics import critical_speed_bowl, discharge_interval
from granum.core import equipment
from granum.core.constants import RPM
from granum.core.i18n import _
from granum.core.kinds import (
    Angle,
    Area,
    Distance,
    Fraction,
    Length,
    MassFlow,
    MoistureDryBasis,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    Stress,
    Time,
    Volume,
    Within,
)
from granum.core.limits import Limit
from granum.settling.equipment.gravity import over_axes
from granum.streams.inside_charts import Axis, Curve, Mark, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated

SCALED = (0.1, 3.0)  # of the feed, between which the catch is drawn


class Clarified(NamedTuple):
    """Sediment with the liquid it holds, and the clarified liquid with the solid that escapes."""

    sediment: Stream
    overflow: Stream


class ClarifierFigures(NamedTuple):
    """Figures of a settling centrifuge."""

    solids_recovery: Fraction
    cut_size_centrifuge: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow


class EmptiedFigures(NamedTuple):
    """Figures of a settling centrifuge that is emptied from time to time."""

    solids_recovery: Fraction
    cut_size_centrifuge: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow
    discharge_interval: Time


class TubularFigures(NamedTuple):
    """Figures of a tubular bowl."""

    solids_recovery: Fraction
    cut_size_centrifuge: Distance
    sigma_factor: Area
    centrifugal_effect: Ratio
    shaft_power: Power
    power_acceleration: Power
    power_windage: Power
    hoop_stress_bowl: Stress
    moisture_dry_basis: MoistureDryBasis
    mass_flow_sediment: MassFlow
    discharge_interval: Time
    critical_speed: RotationSpeed


def clarified(unit: Bowl, feed: Stream, grade: Any, solids_fraction: Any) -> Clarified:
    """Feed parted into sediment, with its voids full, and the rest."""
    caught = feed.part(solid=over_axes(grade, feed))
    share = held_liquid(caught, feed.liquid_volume_flow, solids_fraction)
    sediment = caught.replace(liquid=share * feed.liquid, gas=0.0 * feed.gas)
    overflow = feed.replace(solid=feed.solid - sediment.solid, liquid=feed.liquid - sediment.liquid)
    return Clarified(sediment, overflow)


def clarifier_figures(unit: Bowl, feed: Stream, outlets: Clarified, conveying: Any = 0.0) -> dict[str, Any]:
    """Figures that clarifying machines share, by name."""
    total = feed.solid_flow
    accelerated, windage = unit.acceleration(outlets.sediment, outlets.overflow), unit.windage()
    return {
        "solids_recovery": outlets.sediment.solid_flow / jnp.where(total > 0, total, 1.0),
        "cut_size_centrifuge": unit.cut_size(feed, unit.sigma()),
        "sigma_factor": jnp.asarray(unit.sigma(), dtype=float),
        "centrifugal_effect": centrifugal_effect(unit.radius_outer, unit.rotation_speed),
        "shaft_power": accelerated + windage + conveying,
        "power_acceleration": accelerated,
        "power_windage": windage,
        "hoop_stress_bowl": unit.stress(feed),
        "moisture_dry_basis": outlets.sediment.moisture_dry_basis,
        "mass_flow_sediment": outlets.sediment.mass_flow,
    }


class SettlingCentrifuge(Bowl):
    """Abstract clarifier with one liquid outlet, through which whatever floats leaves too."""

    def outlets(self, inside: None, feed: Stream) -> Clarified:
        return clarified(self, feed, self.grade(feed), self.sediment_solids_fraction)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed = inlets["feed"]
        if not float(feed.solid_flow) > 0.0:
            return {}
        times = np.linspace(*SCALED, 41)
        caught, cut = _catching(self, feed, jnp.asarray(times))
        drawn = drawn_along(
            Axis("volume_flow", "VolumeFlow"),
            times * float(feed.slurry_volume_flow),
            (Axis("solids_recovery", "Fraction", "percent"), [Curve(_("solids caught"), caught, "SOLID")]),
            (Axis("cut_size_centrifuge", "Distance"), [Curve(_("cut size"), cut, "LIQUID", "dash")]),
            marks=[Mark(_("as it runs"), feed.slurry_volume_flow, made.figures.solids_recovery)],
        )
        return {_("What it catches of more or less feed"): drawn}

    @abc.abstractmethod
    def figures(self, inside: None, outlets: Clarified, feed: Stream) -> Any:
        """Figures of the data sheet."""

    def measured(self, inside: None, outlets: Clarified, figures: Any, feed: Stream) -> dict[str, Any]:
        return self.measured_bowl(feed, figures)


@eqx.filter_jit
def _catching(unit: SettlingCentrifuge, feed: Stream, times: Any) -> tuple[Any, Any]:
    """Share of the solid caught, and cut size, of so many times the feed."""

    def at(scale: Any) -> tuple[Any, Any]:
        fed = feed.part(solid=scale, liquid=scale, gas=scale)
        caught = jnp.sum(over_axes(unit.grade(fed), fed) * fed.solid) / fed.solid_flow
        return caught, unit.cut_size(fed, unit.sigma())

    return jax.vmap(at)(times)


class Tube(Bowl):
    """Abstract slender bowl with plug flow."""

    bowl_length: Length

    @property
    def outside_length(self) -> Any:
        return self.bowl_length

    def sigma(self) -> Any:
        return sigma_factor_tubular_half_area(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        return grade_efficiency_tubular(
            velocity, flow, self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )

    def critical(self, feed: Stream) -> Any:
        """First critical speed, rad/s."""
        return critical_speed_bowl(
            self.bowl_length,
            self.wall,
            self.radius_inner,
            self.thickness,
            feed.liquid_density,
            self.wall_density,
        )

    def space(self, given: Any) -> Any:
        """Room for sediment: half of the bowl unless given, m³."""
        whole = jnp.pi * (self.radius_outer**2 - self.radius_inner**2) * self.bowl_length
        return 0.5 * whole if given is None else given


TUBE_LIMITS: Limits = (
    machine_limits(
        solids=(0.0, 0.01), flow=(0.1 / 3600, 5.0 / 3600), effect=(1000.0, 60000.0), source="robatel1989"
    )
    | slender(8.0, 16.0)
    | CRITICAL
    | {"emptied": Limit("interval between cleanings", 0.5, math.inf, "hour", "robatel1989")}
)


@equipment(
    "tubular_bowl",
    source="ambler1959; svarovsky2001",
    title="Tubular bowl centrifuge",
    equation=r"\Sigma = \frac{\pi L\,\omega^2 (r_2^2 - r_1^2)}{g \ln[2r_2^2/(r_1^2 + r_2^2)]}",
)
class TubularBowl(Tube, SettlingCentrifuge):
    """Slender bowl at very high speed: fine particles at low concentration, cleaned by hand when full.

    ``sludge_volume`` is the room for sediment, half of the bowl unless given.
    """

    _: KW_ONLY
    sigma_efficiency: PositiveNumber = 0.9
    sludge_volume: Volume | None = None

    limits: ClassVar[Limits] = TUBE_LIMITS | no_floats("robatel1989")

    def figures(self, inside: None, outlets: Clarified, feed: Stream) -> TubularFigures:
        return TubularFigures(
            **clarifier_figures(self, feed, outlets),
            discharge_interval=discharge_interval(
                self.space(self.sludge_volume), outlets.sediment.slurry_volume_flow
            ),
            critical_speed=self.critical(feed),
        )

    def measured(
        self, inside: None, outlets: Clarified, figures: TubularFigures, feed: Stream
    ) -> dict[str, Any]:
        return self.measured_bowl(feed, figures) | {
            "slender": self.bowl_length / self.radius_outer,
            "critical": self.rotation_speed / figures.critical_speed,
            "emptied": figures.discharge_interval / 3600.0,
        }


class Discs(Bowl):
    """Abstract bowl with a stack of conical discs between ``radius_inner`` and ``radius_outer``. Its wall
    stands 1.3 times as far out as the discs unless given, and it is as high as wide.
    """

    disc_number: PositiveNumber
    disc_angle: Angle = 0.7
    _: KW_ONLY
    sigma_efficiency: PositiveNumber = 0.55

    @property
    def wall(self) -> Any:
        return 1.3 * self.radius_outer if self.bowl_radius is None else self.bowl_radius

    @property
    def outside_length(self) -> Any:
        return 2.0 * self.wall

    def sigma_between(self, inner: Any, outer: Any) -> Any:
        """Equivalent settling area of the discs between two radii, m²."""
        return sigma_factor_disc(self.disc_number, inner, outer, self.rotation_speed, self.disc_angle)

    def sigma(self) -> Any:
        return self.sigma_between(self.radius_inner, self.radius_outer)


DISC_SPEED: Limits = {"speed": Limit("rotation speed", 0.0, 12000 * RPM, "radian/s", "robatel1989")}
EJECTED: Limits = {"emptied": Limit("interval between discharges", 1.0, math.inf, "min", "leung1998")}
DISC_LIMITS: Limits = (
    machine_limits(
        solids=(0.0, 0.15), flow=(0.0, 100.0 / 3600), effect=(3000.0, 20000.0), source="robatel1989"
    )
    | DISC_SPEED
)


@equipment(
    "disc_stack",
    source="ambler1959; svarovsky2001",
    title="Disc stack centrifuge",
    equation=r"\Sigma = \frac{2\pi n\,\omega^2 (r_2^3 - r_1^3)}{3 g\tan\theta}",
)
class DiscStack(Discs, SettlingCentrifuge):
    """Stack of conical discs with narrow gaps: much settling area in a small bowl, for fine solids; the bowl
    opens when its sludge space is full.

    A clarifier: what is lighter than the liquid stays in it. Emulsions and light solids go to a disc
    separator.
    """

    _: KW_ONLY
    sludge_volume: Volume = 0.005

    limits: ClassVar[Limits] = DISC_LIMITS | EJECTED | no_floats("robatel1989")

    def figures(self, inside: None, outlets: Clarified, feed: Stream) -> EmptiedFigures:
        return EmptiedFigures(
            **clarifier_figures(self, feed, outlets),
            discharge_interval=discharge_interval(self.sludge_volume, outlets.sediment.slurry_volume_flow),
        )

    def measured(
        self, inside: None, outlets: Clarified, figures: EmptiedFigures, feed: Stream
    ) -> dict[str, Any]:
        return self.measured_bowl(feed, figures) | {"emptied": figures.discharge_interval / 60.0}


@equipment("solid_basket", source="ambler1959; svarovsky2001", title="Solid-basket centrifuge")
class SolidBasket(SettlingCentrifuge):
    """Wide unperforated basket that fills with sediment and is then skimmed and plowed; averaged over its
    cycle.
    """

    bowl_length: Length
    working_share: Annotated[Fraction, Within(0.01, 1.0)] = 0.8
    _: KW_ONLY
    wall_thickness: Length | None = 0.015

    limits: ClassVar[Limits] = (
        machine_limits(
            solids=(0.0, 0.1), flow=(0.0, 20.0 / 3600), effect=(300.0, 2000.0), source="perry2008, § 18"
        )
        | no_floats("perry2008, § 18")
        | {"pond": Limit("inner over outer radius", 0.5, 0.95, "dimensionless", "perry2008, § 18")}
    )

    @property
    def flow_multiple(self) -> Any:
        return 2.0 * self.working_share

    @property
    def outside_length(self) -> Any:
        return self.bowl_length

    def sigma(self) -> Any:
        return sigma_factor_tubular_half_area(
            self.bowl_length, self.radius_inner, self.radius_outer, self.rotation_speed
        )

    def efficiency(self, velocity: Any, flow: Any) -> Any:
        return grade_efficiency_tubular(
            velocity,
            flow / self.working_share,
            self.bowl_length,
            self.radius_inner,
            self.radius_outer,
            self.rotation_speed,
        )

    def figures(self, inside: None, outlets: Clarified, feed: Stream) -> ClarifierFigures:
        return ClarifierFigures(**clarifier_figures(self, feed, outlets))
