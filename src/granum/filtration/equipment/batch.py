"""Batch cake filters: form, wash, drain, open and clean. In a line they stand for several working in turn, averaged over the cycle."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Any

import jax.numpy as jnp

from granum.core import equipment
from granum.core.kinds import Diffusivity, Length, Time, VoidFraction
from granum.filtration.equipment.cake_filter import CakeFilter, Plan, Slurry
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure
from granum.filtration.formulas.expression import consolidation_ratio_terzaghi, consolidation_time
from granum.streams.cakes import Filtered
from granum.streams.sharing import shared
from granum.streams.stream import Stream
from granum.streams.units import Check

_PRESS = "pressure drop of a press"
_LEAF = "pressure drop of a pressure vessel filter"
_NUTSCHE = "pressure drop of a Nutsche"
_CHAMBER = "chamber depth"
_LEAF_CAKE = "cake thickness on a leaf"
_NUTSCHE_CAKE = "cake thickness in a Nutsche"
_CANDLE = "cake thickness over candle radius"
_REACHED = "share of the possible squeezing reached"
_SQUEEZED = "void fraction after squeezing over before"


class BatchFilter(CakeFilter):
    """Abstract batch filter: one cake thickness, the times that follow from it, and the times that are set."""

    _: KW_ONLY
    deliquoring_time: Time = 0.0
    dead_time: Time = 1200.0

    @property
    @abc.abstractmethod
    def full_thickness(self) -> Any:
        """Cake thickness at which filtration ends."""

    @property
    def wash_rate_ratio(self) -> Any:
        """Wash flow over what would flow along the way of the filtrate."""
        return 1.0

    def loading(self, s: Slurry) -> Any:
        """Dry cake mass per area when the filter is full."""
        return self.full_thickness * (1.0 - self.void_fraction) * s.solid_density

    def formation_time(self, s: Slurry) -> Any:
        """Time to fill."""
        return filtration_time_constant_pressure(
            self.loading(s) / s.dry_cake_per_filtrate, 1.0, self.pressure_drop, s.dynamic_viscosity, self.resistance,
            s.dry_cake_per_filtrate, self.medium_resistance,
        )  # fmt: skip

    @shared
    def plan(self, feed: Stream, wash: Stream | None = None) -> Plan:
        s = self.slurry(feed)
        loading, formation = self.loading(s), self.formation_time(s)
        void = self.full_thickness * self.void_fraction
        wash_time = self.wash_ratio(feed, wash) * void / (self.wash_rate_ratio * self.wash_flux(loading, feed, wash))
        cycle = formation + wash_time + self.deliquoring_time + self.dead_time
        return Plan(
            loading, jnp.asarray(self.full_thickness, dtype=float), formation, wash_time, jnp.asarray(self.deliquoring_time, dtype=float),
            cycle, s.solid_flow * cycle / loading, jnp.zeros(()),
        )  # fmt: skip


class Press(BatchFilter):
    """Abstract filter press: two cakes grow towards each other and fill a chamber."""

    chamber_depth: Length

    @property
    def full_thickness(self) -> Any:
        return 0.5 * self.chamber_depth

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        return (
            *super().checks(inlets, outlets),
            Check(_PRESS, self.pressure_drop, 1e5, 2.5e6, "Pa", "wakeman2005"),
            Check(_CHAMBER, self.chamber_depth, 0.01, 0.06, "m", "wakeman2005"),
        )


@equipment("plate_and_frame_press", source="geankoplis2003, § 14.2", title="Plate-and-frame filter press")
class PlateAndFramePress(Press):
    """Frames between plates; wash liquor crosses the whole frame on half of the area, at a quarter of the final filtrate rate.

    The area is that of both faces of all frames, the chamber depth that of a frame.
    """

    @property
    def wash_rate_ratio(self) -> Any:
        return 0.25


@equipment("chamber_press", source="wakeman2005", title="Chamber (recessed-plate) filter press")
class ChamberPress(Press):
    """Recessed plates that form chambers; washed the way the filtrate went, which full chambers make uneven.

    The area is that of both faces of all chambers.
    """


@equipment("membrane_press", source="wakeman2005", title="Membrane filter press")
class MembranePress(Press):
    """Chamber press whose membranes squeeze the washed cake towards a lower void fraction in a squeezing time.

    With a consolidation coefficient the cake approaches that void fraction by Terzaghi's law, half a chamber draining on one face; without,
    it is taken as reached.
    """

    void_fraction_squeezed: VoidFraction
    squeezing_time: Time = 600.0
    consolidation_coefficient: Diffusivity | None = None

    @property
    def consolidation_ratio(self) -> Any:
        """Share of the possible squeezing that its time reaches."""
        if self.consolidation_coefficient is None:
            return 1.0
        solid = self.full_thickness * (1.0 - self.void_fraction)
        return consolidation_ratio_terzaghi(consolidation_time(self.squeezing_time, self.consolidation_coefficient, solid))

    def squeezed(self) -> Any:
        after, before = self.void_fraction_squeezed, self.void_fraction
        whole = (after / (1.0 - after)) / (before / (1.0 - before))
        return 1.0 - self.consolidation_ratio * (1.0 - whole)

    @shared
    def plan(self, feed: Stream, wash: Stream | None = None) -> Plan:
        plan = super().plan(feed, wash)
        longer = (plan.cycle_time + self.squeezing_time) / plan.cycle_time
        return plan._replace(cycle_time=plan.cycle_time * longer, area_required=plan.area_required * longer)

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        return (
            *super().checks(inlets, outlets),
            Check(_SQUEEZED, self.void_fraction_squeezed / self.void_fraction, 0.3, 1.0, "dimensionless", "wakeman2005"),
            Check(_REACHED, self.consolidation_ratio, 0.8, 1.0, "dimensionless", "shirato1974"),
        )


@equipment("nutsche", source="wakeman2005", title="Nutsche filter")
class Nutsche(BatchFilter):
    """Closed vessel with one flat filter bottom: deep cakes, smoothed, washed and blown in place."""

    full_cake_thickness: Length

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        return (
            *super().checks(inlets, outlets),
            Check(_NUTSCHE, self.pressure_drop, 5e4, 6e5, "Pa", "wakeman2005"),
            Check(_NUTSCHE_CAKE, self.full_cake_thickness, 0.05, 0.5, "m", "wakeman2005"),
        )


@equipment("pressure_leaf_filter", source="wakeman2005", title="Pressure leaf filter")
class PressureLeafFilter(BatchFilter):
    """Leaves in a pressure vessel, cake on both faces, dropped by vibration or sluicing; the area is that of all faces."""

    full_cake_thickness: Length

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        return (
            *super().checks(inlets, outlets),
            Check(_LEAF, self.pressure_drop, 1e5, 6e5, "Pa", "wakeman2005"),
            Check(_LEAF_CAKE, self.full_cake_thickness, 0.005, 0.04, "m", "wakeman2005"),
        )


@equipment("candle_filter", source="wakeman2005", title="Candle filter",
           equation=r"t = \frac{\eta}{\Delta p\,W}\left[\alpha\,(1-\varepsilon)^2\rho_s^2\left(\frac{r^2}{2}\ln\frac{r}{r_0} - \frac{r^2 - r_0^2}{4}\right)"
           r" + R_s M/\Omega\right]")  # fmt: skip
class CandleFilter(BatchFilter):
    """Cylindrical elements in a pressure vessel: the cake grows outward and thins the flow through it; area that of the candles."""

    full_cake_thickness: Length
    candle_radius: Length

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def loading(self, s: Slurry) -> Any:
        r0, r = self.candle_radius, self.candle_radius + self.full_cake_thickness
        return (1.0 - self.void_fraction) * s.solid_density * (r**2 - r0**2) / (2.0 * r0)

    def formation_time(self, s: Slurry) -> Any:
        r0, r = self.candle_radius, self.candle_radius + self.full_cake_thickness
        packed = (1.0 - self.void_fraction) * s.solid_density
        cake = self.resistance * packed**2 * (0.5 * r**2 * jnp.log(r / r0) - 0.25 * (r**2 - r0**2))
        return s.dynamic_viscosity / (self.pressure_drop * s.dry_cake_per_filtrate) * (cake + self.medium_resistance * self.loading(s))

    def checks(self, inlets: Mapping[str, Stream], outlets: Filtered) -> tuple[Check, ...]:
        return (
            *super().checks(inlets, outlets),
            Check(_LEAF, self.pressure_drop, 1e5, 6e5, "Pa", "wakeman2005"),
            Check(_CANDLE, self.full_cake_thickness / self.candle_radius, 0.0, 1.0, "dimensionless", "wakeman2005"),
        )
