"""Batch cake filters: form, wash, drain, open and clean. In a line they stand for several working in turn,
averaged over the cycle.
"""

from __future__ import annotations

import abc
import math
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar

import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STANDARD_ATMOSPHERE
from granum.core.errors import CaseError, InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Diffusivity,
    DynamicViscosity,
    FlowIndex,
    Length,
    PressureDrop,
    Ratio,
    Speed,
    Time,
    VoidFraction,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.filtration.equipment.cake_filter import Caked, CakeFigures, CakeFilter, Plan, Slurry
from granum.filtration.formulas.expression import consolidation_ratio_terzaghi, consolidation_time
from granum.filtration.formulas.non_newtonian import filtration_time_power_law
from granum.filtration.squeezing import void_ratio
from granum.numerics import safe_power
from granum.numerics.smooth import safe_divide
from granum.porous.formulas.non_newtonian import dynamic_viscosity_permeable_christopher_middleman
from granum.streams.cake_course import POINTS, Stage
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import AREA, PUMPED, compressed, pumped

# Gauss–Legendre on the cake that grows at a constant rate, and steps of Newton at each of its points
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
STEPS, LEAST_SHARE = 40, 1e-12


class BatchFilter(CakeFilter):
    """Abstract batch filter: one cake thickness, the times that follow from it, and the times that are
    set.

    A pump that delivers no more than ``filtrate_flux_largest`` filters at that flux until the pressure drop
    is reached, which then is held. It is paid for the pressure that it gives at each moment. Washing and
    draining are at the full pressure drop, and what is to be known of a compressible cake, too.
    """

    _: KW_ONLY
    deliquoring_time: Time = 0.0
    dead_time: Time = 1200.0
    filtrate_flux_largest: Annotated[Speed, Within(1e-9)] | None = None

    utilities: ClassVar[Utilities] = (
        PUMPED | AREA | {"electric_power_compressor": Utility("wakeman2005; turton2018, ch. 11")}
    )

    limits: ClassVar[Limits] = CakeFilter.limits | {
        # the number is our own: at one the pressure is never reached
        "pumped": Limit(
            "share of the cake that is formed before the pump reaches its pressure (beyond, it never does)",
            0.0,
            0.99,
            "dimensionless",
            "geankoplis2003, § 14.2",
            quiet=True,
        )
    }

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

    def through(self, s: Slurry, flux: Any) -> Any:
        """Resistance of cake and medium that the pressure drop drives a flux through."""
        return self.pressure_drop / (s.dynamic_viscosity * flux)

    def loading_of(self, s: Slurry, resistance: Any) -> Any:
        """Dry cake mass per area whose cake has a resistance."""
        return resistance / self.resistance

    def resistance_of(self, s: Slurry, loading: Any) -> Any:
        """Resistance of the cake of a dry mass per area, at the pressure drop."""
        return self.resistance * loading

    def pressed_time(self, s: Slurry, loading: Any) -> Any:
        """Time to form a cake of a dry mass per area at the pressure drop from the start."""
        return super().formation_time(s, loading)

    def at_rate(self, s: Slurry, loading: Any) -> tuple[Any, Any]:
        """Dry cake mass per area that the pump lays down before the pressure drop is reached, and the time
        that takes: whatever the cake does under less pressure, it is as much as the slurry brings.
        """
        flux = self.filtrate_flux_largest
        if flux is None:
            return 0.0, 0.0
        held = jnp.maximum(self.through(s, flux) - self.media_resistance(), 0.0)
        first = jnp.minimum(self.loading_of(s, held), loading)
        return first, first / (s.dry_cake_per_filtrate * flux)

    def pump_pressure(self, s: Slurry, loading: Any) -> Any:
        """Mean pressure of the pump over the filtrate of a cake: its work for the volume that it moves.

        As far as its flux goes it gives what cake and medium resist, and a compressible cake resists by
        that pressure: p = c (α(p) w + R_s).
        """
        flux = self.filtrate_flux_largest
        if flux is None:
            return self.pressure_drop
        first, n = self.at_rate(s, loading)[0], self.compressibility
        part = self.resistance_of(s, 0.5 * first * (1.0 + NODES)) / self.through(s, flux)
        bare = jnp.minimum(self.media_resistance() / self.through(s, flux), 1.0)
        # as a share of the pressure drop: x = bare + part xⁿ, by Newton from the side that it comes down from
        x = jnp.where(n < 1.0, 1.0, bare) + 0.0 * part
        for _step in range(STEPS):
            power = safe_power(x, n - 1.0)
            slope = jnp.maximum(1.0 - n * part * power, 1e-9)
            x = jnp.clip(x - (x - bare - part * power * x) / slope, LEAST_SHARE, 1.0)
        rising = self.pressure_drop * 0.5 * jnp.sum(WEIGHTS * x)
        return self.pressure_drop + (rising - self.pressure_drop) * safe_divide(first, loading)

    def formation_time(self, s: Slurry, loading: Any) -> Any:
        if self.filtrate_flux_largest is None:
            return self.pressed_time(s, loading)
        first, time = self.at_rate(s, loading)
        return time + self.pressed_time(s, loading) - self.pressed_time(s, first)

    def plan(self, s: Slurry, feed: Stream, wash: Stream | None = None) -> Plan:
        loading = self.loading(s)
        formation = self.formation_time(s, loading)
        void = self.full_thickness * self.void_fraction
        wash_time = self.wash_ratio(feed, wash) * void / (self.wash_rate_ratio * self.wash_flux(loading, s))
        cycle = formation + wash_time + self.deliquoring_time + self.dead_time
        return Plan(
            loading,
            jnp.asarray(self.full_thickness, dtype=float),
            formation,
            wash_time,
            jnp.asarray(self.deliquoring_time, dtype=float),
            cycle,
            s.solid_flow * cycle / loading,
            None,  # the wash takes the time it asks for
            None if self.filtrate_flux_largest is None else self.at_rate(s, loading)[1],
        )

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        found = super().measured(inside, outlets, figures, feed, wash)
        loading = self.loading(inside.slurry)
        return found | {"pumped": self.at_rate(inside.slurry, loading)[0] / loading}

    def drawn(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        plan = inside.plan
        washed = 0.0 if wash is None else wash.liquid_volume_flow
        mean = self.pump_pressure(inside.slurry, plan.dry_cake_mass_per_area)
        blown = STANDARD_ATMOSPHERE + self.pressure_drop
        gas = self.gas_flow(inside, feed, blown, STANDARD_ATMOSPHERE) * plan.area_required
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, mean) + pumped(washed, self.pressure_drop),
            "electric_power_compressor": compressed(gas * plan.deliquoring_time / plan.cycle_time, blown),
            "area_installed": self.area,
        }


class FlatFilter(BatchFilter):
    """Abstract batch filter whose cakes grow on flat faces, so that a liquid may thin as it flows: a power
    law of ``consistency``, the viscosity at 1/s, and ``flow_index``, in place of the viscosity of the feed.

    The cake then forms by that law. It drains as if the liquid had the viscosity with which it flowed at the
    end of filtration, and is washed as by a liquid of Newton; a check tells both.
    """

    _: KW_ONLY
    consistency: DynamicViscosity | None = None
    flow_index: FlowIndex | None = None

    limits: ClassVar[Limits] = BatchFilter.limits | {
        "newton": Limit(
            "flow index of a liquid that is washed or drained as one of Newton",
            1.0,
            1.0,
            "dimensionless",
            "christopher1965",
        )
    }

    @property
    def law(self) -> tuple[Any, Any] | None:
        """Consistency and flow index, if the liquid has them."""
        if (self.consistency is None) != (self.flow_index is None):
            raise CaseError(_("A power law needs both 'consistency' and 'flow_index': only one was given."))
        return None if self.consistency is None else (self.consistency, self.flow_index)

    def slurry(self, feed: Stream, wash: Stream | None = None) -> Slurry:
        s, law = super().slurry(feed, wash), self.law
        if law is None:
            return s
        through = self.resistance * self.loading(s) + self.medium_resistance
        at_one = self.at_one(s)
        last = (self.pressure_drop / (at_one * through)) ** (1.0 / law[1])
        if self.filtrate_flux_largest is not None:
            last = jnp.minimum(last, self.filtrate_flux_largest)
        return s._replace(dynamic_viscosity=at_one * last ** (law[1] - 1.0))

    def at_one(self, s: Slurry) -> Any:
        """Viscosity of the thinning liquid in the cake at a flux of 1 m/s."""
        law = self.law
        assert law is not None
        return dynamic_viscosity_permeable_christopher_middleman(
            1.0, self.permeability(s), self.void_fraction, *law
        )

    def through(self, s: Slurry, flux: Any) -> Any:
        law = self.law
        if law is None:
            return super().through(s, flux)
        return self.pressure_drop / (self.at_one(s) * flux ** law[1])

    def pressed_time(self, s: Slurry, loading: Any) -> Any:
        law = self.law
        if law is None:
            return super().pressed_time(s, loading)
        return filtration_time_power_law(
            loading / s.dry_cake_per_filtrate,
            1.0,
            self.pressure_drop,
            *law,
            self.resistance,
            s.dry_cake_per_filtrate,
            self.void_fraction,
            s.solid_density,
            self.medium_resistance,
        )

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        found, law = super().measured(inside, outlets, figures, feed, wash), self.law
        if law is None:
            return found
        later = (inside.wash_ratio > 0.0) | (inside.plan.deliquoring_time > 0.0)
        return found | {"newton": jnp.where(later, law[1], 1.0)}


class Press(FlatFilter):
    """Abstract filter press: two cakes grow towards each other and fill a chamber."""

    chamber_depth: Length

    limits: ClassVar[Limits] = FlatFilter.limits | {
        "pressure": Limit("pressure drop of a press", 1e5, 2.5e6, "Pa", "wakeman2005"),
        "chamber": Limit("chamber depth", 0.01, 0.06, "m", "wakeman2005"),
    }

    @property
    def full_thickness(self) -> Any:
        return 0.5 * self.chamber_depth

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "pressure": self.pressure_drop,
            "chamber": self.chamber_depth,
        }


@equipment("plate_and_frame_press", source="geankoplis2003, § 14.2", title="Plate-and-frame filter press")
class PlateAndFramePress(Press):
    """Frames between plates; wash liquor crosses the whole frame on half of the area, at a quarter of the
    final filtrate rate.

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


HARDER = Limit("squeezing pressure over filtration pressure", 1.0, math.inf, "dimensionless", "wakeman2005")


class SqueezingFilter(BatchFilter):
    """Abstract batch filter that squeezes its washed cake towards a lower void fraction, draining on one
    face.

    With a consolidation coefficient the cake approaches that void fraction by Terzaghi's law in the squeezing
    time; without, it is taken as reached.
    """

    closed: ClassVar[bool] = True
    _: KW_ONLY
    squeezing_time: Time = 600.0
    consolidation_coefficient: Diffusivity | None = None

    utilities: ClassVar[Utilities] = BatchFilter.utilities | {
        "electric_power_squeeze": Utility("wakeman2005")
    }

    limits: ClassVar[Limits] = BatchFilter.limits | {
        "squeezed": Limit(
            "void fraction after squeezing over before", 0.3, 1.0, "dimensionless", "wakeman2005"
        ),
        "reached": Limit("share of the possible squeezing reached", 0.8, 1.0, "dimensionless", "shirato1974"),
    }

    @property
    @abc.abstractmethod
    def void_fraction_packed(self) -> Any:
        """Void fraction of a cake that was only ever under the squeezing pressure."""

    @property
    def void_fraction_end(self) -> Any:
        """Void fraction that squeezing leads to in the end: no cake is loosened by it."""
        return jnp.minimum(self.void_fraction_packed, self.void_fraction)

    @property
    def pressure_end(self) -> Any:
        """Pressure at which what is squeezed out is moved."""
        return self.pressure_drop

    def consolidated(self, time: Any) -> Any:
        """Share of the possible squeezing that a time reaches."""
        assert self.consolidation_coefficient is not None
        solid = self.full_thickness * (1.0 - self.void_fraction)
        return consolidation_ratio_terzaghi(consolidation_time(time, self.consolidation_coefficient, solid))

    @property
    def consolidation_ratio(self) -> Any:
        """Share of the possible squeezing that its time reaches."""
        if self.consolidation_coefficient is None:
            return jnp.where(jnp.asarray(self.squeezing_time) > 0.0, 1.0, 0.0)
        return self.consolidated(self.squeezing_time)

    def void_left(self, reached: Any) -> Any:
        """Void volume per solid over that before squeezing, at a share of the possible squeezing."""
        after, before = self.void_fraction_end, self.void_fraction
        whole = (after / (1.0 - after)) / (before / (1.0 - before))
        return 1.0 - reached * (1.0 - whole)

    def squeezed(self) -> Any:
        return self.void_left(self.consolidation_ratio)

    def stages(self, inside: Caked, feed: Stream, wash: Stream | None = None) -> list[Stage]:
        forming, washing, draining, rest = super().stages(inside, feed, wash)
        share = np.linspace(0.0, 1.0, POINTS) ** 2
        time = float(self.squeezing_time) * share
        # without a coefficient only the end is known: a straight line leads there
        reached = share if self.consolidation_coefficient is None else self.consolidated(time)
        solid = 1.0 - self.void_fraction
        thick = forming.thickness[-1] * np.asarray(solid + self.void_fraction * self.void_left(reached))
        thin = np.full(POINTS, thick[-1])
        squeezing = Stage(_("squeezing"), time, thick, np.ones(POINTS))
        shorter = rest._replace(time=rest.time * max(1.0 - time[-1] / max(rest.time[-1], 1e-9), 0.0))
        return [forming, washing, squeezing, draining._replace(thickness=thin), shorter]

    def plan(self, s: Slurry, feed: Stream, wash: Stream | None = None) -> Plan:
        plan = super().plan(s, feed, wash)
        longer = (plan.cycle_time + self.squeezing_time) / plan.cycle_time
        return plan._replace(cycle_time=plan.cycle_time * longer, area_required=plan.area_required * longer)

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "squeezed": self.void_fraction_packed / self.void_fraction,
            "reached": self.consolidation_ratio,
        }

    def drawn(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        pressed = (1.0 - self.squeezed()) * inside.slurry.void_volume_flow
        return super().drawn(inside, outlets, figures, feed, wash) | {
            "electric_power_squeeze": pumped(pressed, self.pressure_end)
        }


@equipment("membrane_press", source="wakeman2005; tiller1953", title="Membrane filter press")
class MembranePress(SqueezingFilter, Press):
    """Chamber press whose membranes squeeze the washed cake towards a lower void fraction in a squeezing
    time.

    With a consolidation coefficient the cake approaches that void fraction by Terzaghi's law, half a chamber
    draining on one face; without, it is taken as reached. Membranes press as hard as the slurry pump unless
    a ``squeezing_pressure`` is given; the solids of the squeezed cake then grow with its power
    ``compaction_exponent`` over the pressure of the pump, for which ``void_fraction_squeezed`` holds.
    """

    void_fraction_squeezed: VoidFraction
    _: KW_ONLY
    squeezing_pressure: PressureDrop | None = None
    compaction_exponent: Annotated[Ratio, Within(0.0, 0.5)] | None = None

    def __check_init__(self) -> None:
        if self.compaction_exponent is not None and self.squeezing_pressure is None:
            raise InputError(
                _(
                    "The exponent of compaction tells how a cake yields to a 'squeezing_pressure' beyond "
                    "that of the pump: give one, or leave the exponent out."
                ),
                name="compaction_exponent",
            )

    limits: ClassVar[Limits] = (
        Press.limits
        | SqueezingFilter.limits
        | {
            "squeeze": Limit("squeezing pressure", 4e5, 2.5e6, "Pa", "wakeman2005"),
            "harder": HARDER,
        }
    )

    @property
    def pressure_end(self) -> Any:
        return self.pressure_drop if self.squeezing_pressure is None else self.squeezing_pressure

    @property
    def void_fraction_packed(self) -> Any:
        packed = 1.0 - self.void_fraction_squeezed
        exponent = 0.0 if self.compaction_exponent is None else self.compaction_exponent
        ratio = void_ratio(self.pressure_end, packed, self.pressure_drop, exponent, 0.0)
        return ratio / (1.0 + ratio)

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        found = super().measured(inside, outlets, figures, feed, wash)
        if self.squeezing_pressure is None:
            return found
        return found | {
            "squeeze": self.squeezing_pressure,
            "harder": self.squeezing_pressure / self.pressure_drop,
        }


@equipment("nutsche", source="wakeman2005", title="Nutsche filter")
class Nutsche(FlatFilter):
    """Closed vessel with one flat filter bottom: deep cakes, smoothed, washed and blown in place."""

    full_cake_thickness: Length

    limits: ClassVar[Limits] = FlatFilter.limits | {
        "pressure": Limit("pressure drop of a Nutsche", 5e4, 6e5, "Pa", "wakeman2005"),
        "cake": Limit("cake thickness in a Nutsche", 0.05, 0.5, "m", "wakeman2005"),
    }

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "pressure": self.pressure_drop,
            "cake": self.full_cake_thickness,
        }


@equipment("pressure_leaf_filter", source="wakeman2005", title="Pressure leaf filter")
class PressureLeafFilter(FlatFilter):
    """Leaves in a pressure vessel, cake on both faces, dropped by vibration or sluicing; the area is that of
    all faces.
    """

    full_cake_thickness: Length

    limits: ClassVar[Limits] = FlatFilter.limits | {
        "pressure": Limit("pressure drop of a pressure vessel filter", 1e5, 6e5, "Pa", "wakeman2005"),
        "cake": Limit("cake thickness on a leaf", 0.005, 0.04, "m", "wakeman2005"),
    }

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "pressure": self.pressure_drop,
            "cake": self.full_cake_thickness,
        }


@equipment(
    "candle_filter",
    source="wakeman2005",
    title="Candle filter",
    equation=r"t = \frac{\eta}{\Delta p\,W}\left[\alpha\,(1-\varepsilon)^2\rho_s^2\left(\frac{r^2}{2}\ln\frac{r}{r_0} - \frac{r^2 - r_0^2}{4}\right)"  # noqa: E501
    r" + R_s M/\Omega\right]",
)
class CandleFilter(BatchFilter):
    """Cylindrical elements in a pressure vessel: the cake grows outward and thins the flow through it; area
    that of the candles.

    For liquids of Newton: on a cylinder there is no power law here.
    """

    full_cake_thickness: Length
    candle_radius: Length

    limits: ClassVar[Limits] = BatchFilter.limits | {
        "pressure": Limit("pressure drop of a pressure vessel filter", 1e5, 6e5, "Pa", "wakeman2005"),
        "curved": Limit("cake thickness over candle radius", 0.0, 1.0, "dimensionless", "wakeman2005"),
    }

    @property
    def full_thickness(self) -> Any:
        return self.full_cake_thickness

    def loading(self, s: Slurry) -> Any:
        r0, r = self.candle_radius, self.candle_radius + self.full_cake_thickness
        return (1.0 - self.void_fraction) * s.solid_density * (r**2 - r0**2) / (2.0 * r0)

    def thickness(self, loading: Any, solid_density: Any) -> Any:
        r0, packed = self.candle_radius, (1.0 - self.void_fraction) * solid_density
        return jnp.sqrt(r0**2 + 2.0 * r0 * loading / packed) - r0

    def loading_of(self, s: Slurry, resistance: Any) -> Any:
        r0, packed = self.candle_radius, (1.0 - self.void_fraction) * s.solid_density
        turns = jnp.minimum(resistance / (self.resistance * packed * r0), 20.0)  # beyond, thicker than any
        return 0.5 * packed * r0 * jnp.expm1(2.0 * turns)

    def resistance_of(self, s: Slurry, loading: Any) -> Any:
        r0, packed = self.candle_radius, (1.0 - self.void_fraction) * s.solid_density
        return 0.5 * self.resistance * packed * r0 * jnp.log1p(2.0 * loading / (packed * r0))

    def pressed_time(self, s: Slurry, loading: Any) -> Any:
        r0, packed = self.candle_radius, (1.0 - self.void_fraction) * s.solid_density
        r = r0 + self.thickness(loading, s.solid_density)
        cake = self.resistance * packed**2 * (0.5 * r**2 * jnp.log(r / r0) - 0.25 * (r**2 - r0**2))
        return (
            s.dynamic_viscosity
            / (self.pressure_drop * s.dry_cake_per_filtrate)
            * (cake + self.medium_resistance * loading)
        )

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed, wash) | {
            "pressure": self.pressure_drop,
            "curved": self.full_cake_thickness / self.candle_radius,
        }
