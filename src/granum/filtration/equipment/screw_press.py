"""Screw press: sludge or fiber filters through a barrel, then is squeezed against a cone by a slow screw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    CakeResistance,
    Diffusivity,
    Fraction,
    Length,
    MassFlow,
    MassFraction,
    MassRatio,
    MediumResistance,
    MoistureDryBasis,
    OpenFraction,
    Power,
    PressureDrop,
    Ratio,
    Speed,
    Time,
    Torque,
    TurningSpeed,
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.core.units import format_number
from granum.core.utilities import Utility
from granum.filtration.charts_presses import drawn_pressing
from granum.filtration.equipment.belt_press import Pressed
from granum.filtration.formulas.constant_pressure import (
    filtrate_volume_constant_pressure,
    filtration_time_constant_pressure,
)
from granum.filtration.formulas.screw import screw_torque
from granum.filtration.squeezing import DENSEST, squeezed, void_ratio
from granum.numerics import find_root
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, DRIVE, driven, pumped

SOURCE = "judd2022"
STEPS = 16  # of the rising pressure
TRICKLE = 1e-6  # m³/s, so that no feed gives numbers
OUTWARD = 1.0  # faces through which the cake drains: that of the barrel


class ScrewFigures(NamedTuple):
    """Figures of a screw press."""

    conveying_velocity: Speed
    residence_time: Time
    filtering_share: Ratio
    solids_fraction_drained: VolumeFraction
    consolidation_ratio: Fraction
    solids_mass_fraction: MassFraction
    moisture_dry_basis: MoistureDryBasis
    conveying_share: Ratio
    compression_ratio: Ratio
    barrel_pressure: PressureDrop
    polymer_flow: MassFlow
    screw_torque: Torque
    shaft_power: Power


class Passage(NamedTuple):
    """Axial velocity, stay, time of filtering over it, void ratios before and after squeezing, share of the
    squeezing reached.
    """

    velocity: Any
    stay: Any
    filtering: Any
    before: Any
    after: Any
    reached: Any


@equipment(
    "screw_press",
    source="elidrissi2020; shirato1974; terzaghi1943; darnell1956",
    title="Screw press",
    equation=(
        r"p(z) = p_0\left(\frac{p_1}{p_0}\right)^{(z - z_f)/(L - z_f)},\qquad e = e_0 - \sum_j\left("
        r"e_{j-1} - e_j\right)U\left[\frac{C_e\,(t - t_j)}{\omega_0^2}\right],\qquad "
        r"T = \mu\,\bar p\,\pi D L\,\frac{D}{2}"
    ),
)
class ScrewPress(Unit):
    """Flocculated sludge, fiber or fodder is pumped into a perforated barrel and filters to a cake there,
    which a slow screw with a thickening shaft pushes on and squeezes against a cone.

    The cake fills the barrel at its end, and that sets how fast all of it moves along: it slips in the screw,
    whose turns only have to carry it that far. It filters at the pressure of the feed; from where no slurry
    is left the pressure rises by a constant factor per length to that with which the cone holds back, and the
    cake consolidates by Terzaghi, drained at the barrel, the steps of pressure superposed. The kneading
    between the flights, which helps, is left out, and so is the breaking of cells: when the oil inside seeds
    comes out is not told. Torque and power are the greatest, with the pressure rising from the feed on. The
    polymer counts as a material that is bought but not as matter of the streams.
    """

    screw_diameter: Length
    screw_length: Length
    screw_pitch: Length
    rotation_speed: TurningSpeed
    shaft_diameter_first: Length
    shaft_diameter_last: Length
    cone_pressure: PressureDrop
    cake_resistance: CakeResistance
    solids_fraction_gel: OpenFraction
    solids_fraction_reference: OpenFraction
    consolidation_coefficient: Diffusivity
    _: KW_ONLY
    feed_pressure: PressureDrop = 1e4
    barrel_friction: Ratio = 0.2
    compaction_exponent: Annotated[Ratio, Within(0.0, 1.0)] = 0.15
    reference_pressure: PressureDrop = 1e5
    medium_resistance: Annotated[MediumResistance, Within(1e3)] = 1e9
    solids_recovery: Annotated[Fraction, Within(0.1, 1.0)] = 0.92
    polymer_dose: MassRatio = 0.009

    limits: ClassVar[Limits] = {
        "filtering": Limit("filtering time over the stay", 0.0, 1.0, "dimensionless", "elidrissi2020"),
        "advance": Limit(
            "advance of the cake over the pitch in a turn", 0.1, 1.0, "dimensionless", "zhong1991"
        ),
        "reached": Limit("share of the possible squeezing reached", 0.5, 1.0, "dimensionless", "shirato1974"),
    }
    utilities: ClassVar[Utilities] = (
        DRIVE | AREA | {"electric_power_pump": Utility(SOURCE), "consumption_polymer": Utility(SOURCE)}
    )

    def __check_init__(self) -> None:
        for name in ("shaft_diameter_first", "shaft_diameter_last"):
            _below(getattr(self, name), self.screw_diameter, name, "screw_diameter")
        _below(self.feed_pressure, self.cone_pressure, "feed_pressure", "cone_pressure")

    def annulus(self, shaft: Any) -> Any:
        """Free section of the barrel around the shaft, m²."""
        return 0.25 * jnp.pi * (self.screw_diameter**2 - shaft**2)

    def entering(self, velocity: Any, feed: Stream) -> tuple[Any, Any, Any, tuple[Any, ...]]:
        """Of the feed per area of barrel, when its cake moves at an axial velocity: its volume, its solid and
        its most filtrate; and what Ruth's law is given.
        """
        fraction = feed.solids_volume_fraction
        some = (feed.slurry_volume_flow > 0.0) & (fraction > 0.0)
        height = jnp.where(some, feed.slurry_volume_flow, TRICKLE) / (jnp.pi * self.screw_diameter * velocity)
        share = jnp.where(some, jnp.clip(fraction, 1e-9, DENSEST), 0.01)
        gel = jnp.maximum(jnp.asarray(self.solids_fraction_gel), share)
        load = feed.solid_density * share / jnp.maximum(1.0 - share / gel, 1e-6)
        cake = (
            1.0,
            self.feed_pressure,
            feed.liquid_viscosity,
            self.cake_resistance,
            load,
            self.medium_resistance,
        )
        return height, share * height, height * (1.0 - share / gel), cake

    def passage(self, velocity: Any, feed: Stream) -> Passage:
        """What becomes of the feed when its cake moves at an axial velocity."""
        stay = self.screw_length / velocity
        some = (feed.slurry_volume_flow > 0.0) & (feed.solids_volume_fraction > 0.0)
        height, solid, most, cake = self.entering(velocity, feed)
        needed = filtration_time_constant_pressure(most, *cake)
        filtered = jnp.minimum(filtrate_volume_constant_pressure(stay, *cake), most)
        before = (height - filtered) / solid - 1.0
        longest = jnp.maximum(stay - needed, 0.0)
        after, reached = self.squeezing(longest, longest, before, solid)
        return Passage(velocity, stay, jnp.where(some, needed / stay, 0.0), before, after, reached)

    def squeezing(self, time: Any, longest: Any, before: Any, solid: Any) -> tuple[Any, Any]:
        """Void ratio after a part of the time of squeezing, and the share of it that is reached."""
        along = jnp.linspace(0.0, 1.0, STEPS + 1)
        left = jnp.maximum(time - longest * jnp.maximum(along - 0.5 / STEPS, 0.0), 0.0)
        return squeezed(before, self.ratios(along), left, self.consolidation_coefficient, solid, OUTWARD)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, passed = inlets["feed"], made.inside
        if not float(feed.solid_flow) > 0.0:
            return {}
        height, solid, most, cake = self.entering(passed.velocity, feed)
        stay = float(passed.stay)
        filters = min(float(passed.filtering), 1.0) * stay
        longest = stay - filters
        filtering = filters * np.linspace(0.0, 1.0, 81) ** 2  # steepest at first
        taken = jnp.minimum(jax.vmap(lambda t: filtrate_volume_constant_pressure(t, *cake))(filtering), most)
        along = np.linspace(0.0, 1.0, 161)
        tight, _reached = jax.vmap(lambda t: self.squeezing(t, longest, passed.before, solid))(
            along * longest
        )
        rise = self.cone_pressure / self.feed_pressure
        drawn = drawn_pressing(
            (filtering, along * longest),
            ((height - taken) / solid - 1.0, tight),
            (np.full(filtering.size, self.feed_pressure), self.feed_pressure * rise**along),
            feed,
            ((0.0, filters, stay), (_("filtering"), _("squeezing")))
            if longest > 0.0
            else ((0.0, stay), (_("filtering"),)),
        )
        return {_("Sludge on its way through the press"): drawn}

    def ratios(self, along: Any) -> Any:
        """Void ratios that the cake would take in the end, along the part of the barrel that squeezes."""
        return void_ratio(
            self.feed_pressure * (self.cone_pressure / self.feed_pressure) ** along,
            self.solids_fraction_reference,
            self.reference_pressure,
            self.compaction_exponent,
            self.solids_fraction_gel,
        )

    def inside(self, feed: Stream) -> Passage:
        fraction = feed.solids_volume_fraction
        loosest = 1.0 / jnp.where(fraction > 0.0, jnp.clip(fraction, 1e-9, DENSEST), 0.01) - 1.0
        kept = self.solids_recovery * feed.solid_volume_flow
        per_area = jnp.where(kept > 0.0, kept, TRICKLE) / self.annulus(self.shaft_diameter_last)
        root = find_root(
            lambda e: e - self.passage(per_area * (1.0 + e), feed).after,
            0.5 * jnp.minimum(self.ratios(1.0), loosest),
            loosest * (1.0 + 1e-9),
        )
        unsolved(root.converged, type(self).card)
        return self.passage(per_area * (1.0 + root.value), feed)

    def outlets(self, inside: Passage, feed: Stream) -> Pressed:
        kept = self.solids_recovery * feed.solid_volume_flow
        share = jnp.clip(safe_divide(inside.after * kept, feed.liquid_volume_flow, 0.0), 0.0, 1.0)
        return Pressed(
            feed.part(solid=self.solids_recovery, liquid=share),
            feed.part(solid=1.0 - self.solids_recovery, liquid=1.0 - share, gas=1.0),
        )

    def figures(self, inside: Passage, outlets: Pressed, feed: Stream) -> ScrewFigures:
        rise = self.cone_pressure / self.feed_pressure
        pressure = self.feed_pressure * (rise - 1.0) / jnp.log(rise)
        torque = screw_torque(self.screw_diameter, self.screw_length, pressure, self.barrel_friction)
        furthest = self.screw_pitch * self.rotation_speed / (2.0 * jnp.pi)
        return ScrewFigures(
            inside.velocity,
            inside.stay,
            inside.filtering,
            1.0 / (1.0 + inside.before),
            inside.reached,
            outlets.cake.solids_mass_fraction,
            outlets.cake.moisture_dry_basis,
            jnp.where(feed.solid_flow > 0.0, inside.velocity / furthest, 0.0),
            self.annulus(self.shaft_diameter_first) / self.annulus(self.shaft_diameter_last),
            pressure,
            self.polymer_dose * feed.solid_flow,
            torque,
            torque * self.rotation_speed,
        )

    def measured(
        self, inside: Passage, outlets: Pressed, figures: ScrewFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "filtering": inside.filtering,
            "advance": figures.conveying_share,
            "reached": inside.reached,
        }

    def drawn(self, inside: Passage, outlets: Pressed, figures: ScrewFigures, feed: Stream) -> dict[str, Any]:
        return {
            "electric_power_drive": driven(figures.shaft_power),
            "electric_power_pump": pumped(feed.slurry_volume_flow, self.feed_pressure),
            "consumption_polymer": figures.polymer_flow,
            "area_installed": self.screw_diameter * self.screw_length,
        }


def _below(value: Any, bound: Any, name: str, other: str) -> None:
    """Refuse a known number that is not below another one."""
    if isinstance(value, int | float) and isinstance(bound, int | float) and not value < bound:
        raise InputError(
            _("'{name}' = {value} must be smaller than '{other}' = {bound}.").format(
                name=name, value=format_number(value), other=other, bound=format_number(bound)
            ),
            name=name,
        )
