"""What all cake filters share: the split of a slurry into cake, filtrate and washings, washing and
deliquoring of the cake.
"""

from __future__ import annotations

import abc
import math
from dataclasses import KW_ONLY
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core.constants import DARCY
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    CakeResistance,
    Distance,
    Fraction,
    MassPerAreaOrZero,
    MoistureDryBasis,
    MoistureWetBasis,
    PressureDrop,
    Ratio,
    Time,
    VoidFraction,
    VolumeFlow,
)
from granum.core.limits import Limit
from granum.filtration.formulas.constant_pressure import filtration_time_constant_pressure
from granum.filtration.formulas.cracking import cake_thickness_crack_free_singh
from granum.filtration.formulas.deliquoring import (
    capillary_number_cake,
    gas_velocity_deliquoring,
    irreducible_saturation,
    saturation_after_deliquoring,
    threshold_pressure_cake,
)
from granum.filtration.formulas.resistance import cake_permeability, cake_resistance_power_law
from granum.numerics.smooth import safe_divide
from granum.streams.cake_course import POINTS, Stage, still
from granum.streams.cake_maker import CakeMaker
from granum.streams.cakes import Filtered
from granum.streams.stream import Stream
from granum.streams.units import Limits
from granum.streams.utilities import AIR_VISCOSITY

# so that a feed without solid or without liquid gives numbers: m³/s of filtrate, kg of cake per m³ of it,
# resistance 1/m of nothing
TRICKLE, THIN, OPEN = 1e-15, 1e-9, 1e3
PORE_SIZE_INDEX = 5.0  # of Brooks and Corey, for cakes


class Plan(NamedTuple):
    """How one cake passes through its cycle."""

    dry_cake_mass_per_area: Any
    cake_thickness: Any
    formation_time: Any
    wash_time: Any
    deliquoring_time: Any
    cycle_time: Any
    area_required: Any
    wash_use: Any
    pressure_rise_time: Any = None


class CakeFigures(NamedTuple):
    """Figures of a cake filter."""

    area_required: Area
    capacity_use: Ratio
    cake_thickness: Distance
    dry_cake_mass_per_area: MassPerAreaOrZero
    cycle_time: Time
    formation_time: Time
    wash_time: Time
    deliquoring_time: Time
    filtrate_flow: VolumeFlow
    wash_ratio: Ratio
    wash_use: Ratio | None  # of a filter whose washing has a given time
    solute_remaining: Fraction
    cake_saturation: Fraction
    moisture_dry_basis: MoistureDryBasis
    dissolved_share: Fraction
    pressure_rise_time: Time | None = None  # of a filter whose pump has a largest flow


class Slurry(NamedTuple):
    """What the filter sees of its feed."""

    solid_flow: Any
    solid_density: Any
    liquid_density: Any
    dynamic_viscosity: Any
    dry_cake_per_filtrate: Any
    void_volume_flow: Any
    wash_viscosity: Any


class Caked(NamedTuple):
    """The cake of a filter: its slurry and cycle, wash liquor per void volume, mother liquor that washing
    leaves in it, saturation at discharge.
    """

    slurry: Slurry
    plan: Plan
    wash_ratio: Any
    left: Any
    saturation: Any


class CakeFilter(CakeMaker):
    """Abstract cake filter: area, driving pressure and cake properties; the kind of filter says how its cycle
    goes.

    The resistance of the cake is ``cake_resistance`` at ``reference_pressure`` and grows with the power
    ``compressibility`` of the pressure drop. Gas drains it only above its threshold pressure, and never below
    what Brooks and Corey's capillarity holds. What is compressible shrinks as it is drained, and may crack,
    unless it was squeezed before: a check says so beyond a compressibility of 0.5, our own number. With the
    ``shear_modulus`` of its grains a cake that is drained is held against the thickest that does not crack.
    With a ``transportable_moisture_limit`` the moisture of the cake is checked against it.
    """

    area: Area
    pressure_drop: PressureDrop
    cake_resistance: CakeResistance
    void_fraction: VoidFraction
    _: KW_ONLY  # so that subclasses may add fields without a default
    compressibility: Ratio = 0.0
    reference_pressure: PressureDrop = 1e5
    transportable_moisture_limit: MoistureWetBasis | None = None
    shear_modulus: PressureDrop | None = None

    limits: ClassVar[Limits] = {
        "capacity": Limit("share of the filtration capacity in use", 0.0, 1.0, "dimensionless", "ruth1935"),
        "wash": Limit(
            "share of the washing capacity in use", 0.0, 1.0, "dimensionless", "mccabe2005, ch. 29"
        ),
        "packed": Limit(
            "solids in the feed over those of a packed cake", 0.0, 0.9, "dimensionless", "mccabe2005, ch. 29"
        ),
        # above 1e-11 m² the source would rather drain or spin the crystals, which is no fault of a filter
        # 1e-16 m² in the print, of which the power alone is meant
        "filterable": Limit("permeability of the cake", 1e-4 * DARCY, math.inf, "m^2", "anlauf2019, § 6.3"),
        "entered": Limit(
            "pressure drop over the threshold pressure of a cake that is drained",
            1.0,
            math.inf,
            "dimensionless",
            "wakeman2005",
        ),
        # what draws gas and cake together below the entry pressure is in the source, the number is our own
        "cracks": Limit(
            "compressibility of a cake drained but not squeezed: beyond, it shrinks and cracks",
            0.0,
            0.5,
            "dimensionless",
            "strubel, abstract only: the number is our own",
            quiet=True,
        ),
        "thick": Limit(
            "thickness of a cake drained but not squeezed over the thickest that does not crack",
            0.0,
            1.0,
            "dimensionless",
            "singh2007",
        ),
        "flowing": Limit(
            "cake moisture, wet basis", 0.0, "transportable_moisture_limit", "kg/kg", "imsbc2008, app. 2"
        ),
    }

    closed: ClassVar[bool] = False
    """Whether a squeeze has closed the cake before gas enters it."""

    @abc.abstractmethod
    def plan(self, s: Slurry, feed: Stream, wash: Stream | None = None) -> Plan:
        """The cycle of one cake at this feed."""

    @property
    def resistance(self) -> Any:
        """Specific resistance of the cake at the driving pressure."""
        return cake_resistance_power_law(
            self.pressure_drop, self.cake_resistance, self.compressibility, self.reference_pressure
        )

    def permeability(self, s: Slurry) -> Any:
        """Permeability of the cake at the driving pressure."""
        return cake_permeability(self.resistance, self.void_fraction, s.solid_density)

    def media_resistance(self) -> Any:
        """Resistance of what carries the cake."""
        return self.medium_resistance

    def slurry(self, feed: Stream, wash: Stream | None = None) -> Slurry:
        """Flows and properties that the filtration equations need."""
        solid, liquid = self.solids_recovery * feed.solid_flow, feed.liquid_volume_flow
        void = self.void_flow(feed)
        filtrate = jnp.maximum(liquid - jnp.minimum(void, liquid), 1e-12 * liquid + TRICKLE)
        cake = jnp.maximum(solid / filtrate, THIN)
        own = feed.liquid_viscosity
        return Slurry(
            solid,
            feed.solid_density,
            feed.liquid_density,
            own,
            cake,
            void,
            own if wash is None else wash.liquid_viscosity,
        )

    def wash_flux(self, loading: Any, s: Slurry) -> Any:
        """Superficial velocity of wash liquor through a cake of that dry mass per area."""
        return self.pressure_drop / (
            s.wash_viscosity * jnp.maximum(self.resistance * loading + self.media_resistance(), OPEN)
        )

    def thickness(self, loading: Any, solid_density: Any) -> Any:
        """Cake thickness of a dry mass per area."""
        return loading / ((1.0 - self.void_fraction) * solid_density)

    def formation_time(self, s: Slurry, loading: Any) -> Any:
        """Time to form a cake of a dry mass per area."""
        return filtration_time_constant_pressure(
            loading / s.dry_cake_per_filtrate,
            1.0,
            self.pressure_drop,
            s.dynamic_viscosity,
            self.resistance,
            s.dry_cake_per_filtrate,
            self.media_resistance(),
        )

    def formed(self, inside: Caked) -> Stage:
        """The cake as it grows in its time: thinner than it should be where that is too short."""
        s, plan = inside.slurry, inside.plan
        loading = plan.dry_cake_mass_per_area * np.linspace(0.0, 1.0, POINTS)
        time = np.asarray(self.formation_time(s, loading))
        thick = np.asarray(self.thickness(loading, s.solid_density))
        clock = float(plan.formation_time) * np.linspace(0.0, 1.0, POINTS) ** 2
        return Stage(_("forming"), clock, np.interp(clock, time, thick), np.ones(POINTS))

    def stages(self, inside: Caked, feed: Stream, wash: Stream | None = None) -> list[Stage]:
        plan, forming = inside.plan, self.formed(inside)
        thick = forming.thickness[-1]

        def wet(time: Any) -> Any:
            return self.saturation(inside.slurry, feed, plan._replace(deliquoring_time=time))

        rest = plan.cycle_time - plan.formation_time - plan.wash_time - plan.deliquoring_time
        return [
            forming,
            still(_("washing"), plan.wash_time, thick),
            still(_("draining"), plan.deliquoring_time, thick, wet),
            still(_("discharge and return"), jnp.maximum(rest, 0.0), np.nan, np.nan),
        ]

    def squeezed(self) -> Any:
        """Void volume per solid after mechanical squeezing over that before; 1 where the filter does not
        squeeze.
        """
        return 1.0

    def solute_left(self, s: Slurry, feed: Stream, wash: Stream | None, plan: Plan) -> Any:
        """Fraction of the mother liquor that washing leaves in the cake."""
        if wash is None:
            return jnp.ones(())
        velocity = self.wash_flux(plan.dry_cake_mass_per_area, s)
        return self.left_by_washing(velocity, jnp.maximum(plan.cake_thickness, 1e-9), feed, wash)

    def saturation(self, s: Slurry, feed: Stream, plan: Plan) -> Any:
        """Saturation of the cake at discharge."""
        thick = jnp.maximum(plan.cake_thickness, 1e-9)
        capillary = capillary_number_cake(
            self.diameter(feed),
            self.void_fraction,
            thick,
            self.pressure_drop,
            s.liquid_density,
            self.surface_tension,
        )
        lowest = irreducible_saturation(capillary)
        drained = saturation_after_deliquoring(
            plan.deliquoring_time,
            self.pressure_drop,
            self.permeability(s),
            s.dynamic_viscosity,
            self.void_fraction,
            thick,
            lowest,
        )
        # however long it is blown, capillarity holds this: all where gas cannot enter
        held = jnp.minimum(1.0 / self.over_threshold(feed), 1.0) ** PORE_SIZE_INDEX
        return jnp.maximum(drained, lowest + (1.0 - lowest) * held)

    def over_threshold(self, feed: Stream) -> Any:
        """Pressure drop over that at which gas enters the cake."""
        return self.pressure_drop / threshold_pressure_cake(
            self.diameter(feed), self.void_fraction, self.surface_tension
        )

    def gas_flow(self, inside: Caked, feed: Stream, pressure: Any, pressure_outlet: Any) -> Any:
        """Gas that blows through the drained cake and its medium, m³/s at its outlet and per area; at the
        saturation of the end, when most passes.
        """
        s, thick = inside.slurry, jnp.maximum(inside.plan.cake_thickness, 1e-9)
        lowest = irreducible_saturation(
            capillary_number_cake(
                self.diameter(feed),
                self.void_fraction,
                thick,
                self.pressure_drop,
                s.liquid_density,
                self.surface_tension,
            )
        )
        velocity = gas_velocity_deliquoring(
            self.permeability(s),
            thick,
            pressure,
            pressure_outlet,
            AIR_VISCOSITY,
            jnp.clip((inside.saturation - lowest) / (1.0 - lowest), 0.0, 1.0),
        )
        medium = AIR_VISCOSITY * jnp.maximum(self.media_resistance(), OPEN)
        bare = (pressure**2 - pressure_outlet**2) / (2.0 * pressure_outlet * medium)
        return jnp.where(feed.solid_flow > 0.0, safe_divide(velocity * bare, velocity + bare), 0.0)

    def inside(self, feed: Stream, wash: Stream | None = None) -> Caked:
        s = self.slurry(feed, wash)
        plan = self.plan(s, feed, wash)
        return Caked(
            s,
            plan,
            self.wash_ratio(feed, wash),
            self.solute_left(s, feed, wash, plan),
            self.saturation(s, feed, plan),
        )

    def outlets(self, inside: Caked, feed: Stream, wash: Stream | None = None) -> Filtered:
        return self.parted(feed, wash, saturation=inside.saturation * self.squeezed(), left=inside.left)

    def figures(
        self, inside: Caked, outlets: Filtered, feed: Stream, wash: Stream | None = None
    ) -> CakeFigures:
        plan, cake = inside.plan, outlets.cake
        return CakeFigures(
            area_required=plan.area_required,
            capacity_use=plan.area_required / self.area,
            cake_thickness=plan.cake_thickness,
            dry_cake_mass_per_area=plan.dry_cake_mass_per_area,
            cycle_time=plan.cycle_time,
            formation_time=plan.formation_time,
            wash_time=plan.wash_time,
            deliquoring_time=plan.deliquoring_time,
            filtrate_flow=outlets.filtrate.liquid_volume_flow,
            wash_ratio=inside.wash_ratio,
            wash_use=plan.wash_use,
            solute_remaining=inside.left,
            cake_saturation=inside.saturation,
            moisture_dry_basis=cake.moisture_dry_basis,
            dissolved_share=self.dissolved(feed, cake),
            pressure_rise_time=plan.pressure_rise_time,
        )

    def measured(
        self, inside: Caked, outlets: Filtered, figures: CakeFigures, feed: Stream, wash: Stream | None = None
    ) -> dict[str, Any]:
        found = {
            "capacity": figures.capacity_use,
            "packed": feed.solids_volume_fraction / (1.0 - self.void_fraction),
            "filterable": self.permeability(inside.slurry),
        }
        if inside.plan.wash_use is not None:
            found["wash"] = inside.plan.wash_use
        enters = self.over_threshold(feed)
        found["entered"] = jnp.where(inside.plan.deliquoring_time > 0.0, enters, jnp.maximum(enters, 1.0))
        drained = (inside.plan.deliquoring_time > 0.0) & (not self.closed)
        found["cracks"] = jnp.where(drained, self.compressibility, 0.0)
        if self.shear_modulus is not None:
            suction = self.pressure_drop / jnp.maximum(enters, 1.0)
            whole = cake_thickness_crack_free_singh.function(
                suction, self.surface_tension, self.shear_modulus, self.void_fraction
            )
            found["thick"] = jnp.where(drained, inside.plan.cake_thickness / whole, 0.0)
        if self.transportable_moisture_limit is not None:
            moisture = outlets.cake.moisture_dry_basis
            found["flowing"] = moisture / (1.0 + moisture)
        return found

    @classmethod
    def size(
        cls, feed: Stream, wash: Stream | None = None, *, capacity_use: float = 1.0, **fields: Any
    ) -> Any:
        """The filter whose area this feed just fills to the share ``capacity_use``, everything else given."""
        trial = cls(area=1.0, **fields)
        return cls(
            area=trial.plan(trial.slurry(feed, wash), feed, wash).area_required / capacity_use, **fields
        )
