"""Belt press: sludge drains on a belt, then is squeezed between two belts around ever smaller rollers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.i18n import _
from granum.core.kinds import (
    Angle,
    CakeResistance,
    Diffusivity,
    Distance,
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
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.filtration.charts_presses import drawn_pressing
from granum.filtration.formulas.gravity import filtrate_depth_falling_head
from granum.filtration.kinds import FlowPerWidth, ForcePerWidth, LoadPerWidth
from granum.filtration.squeezing import DENSEST, squeezed, void_ratio
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, DRIVE, driven, pumped

SOURCE = "metcalf2003, ch. 14"
BELTS = 2.0
WASH_PRESSURE = 7e5  # Pa of the belt sprays


class Pressed(NamedTuple):
    """Cake, and filtrate with wash water and what solid went through the belts."""

    cake: Stream
    filtrate: Stream


class PressFigures(NamedTuple):
    """Figures of a belt press."""

    solids_loading_width: LoadPerWidth
    volume_flow_width: FlowPerWidth
    gravity_share: Fraction
    solids_fraction_drained: VolumeFraction
    pressure_last: PressureDrop
    consolidation_ratio: Fraction
    solids_mass_fraction: MassFraction
    moisture_dry_basis: MoistureDryBasis
    cake_thickness: Distance
    polymer_flow: MassFlow
    shaft_power: Power


class Course(NamedTuple):
    """Height of the sludge on the belt, what gravity drains of it, solid per area, void ratios after draining
    and after the rollers, share of the squeezing reached.
    """

    height: Any
    drained: Any
    solid: Any
    before: Any
    after: Any
    reached: Any


@equipment(
    "belt_press",
    source="metcalf2003, ch. 14; shirato1974; terzaghi1943",
    title="Belt press",
    equation=(
        r"p_j = \frac{2\,T}{D_j},\qquad e = e_0 - \sum_j\left(e_{j-1} - e_j\right)U\left[\frac{4\,C_e\,(t - "
        r"t_j)}{\omega_0^2}\right],\qquad \frac{1}{1 + e_j} = \varphi_0\left(\frac{p_j}{p_0}\right)^\beta"
    ),
)
class BeltPress(Unit):
    """Flocculated sludge drains by its own weight on a belt, then consolidates between two belts, in a wedge
    and around rollers of falling diameter, each pressing by the tension of the belt over its radius.

    Draining is that of a cake of constant resistance under a falling head, as far as the sludge packs by
    itself. Squeezing follows Terzaghi, drained on both faces, the steps of pressure superposed; the shear
    between the rollers, which helps, is left out. The cake is even, and the polymer counts as a material that
    is bought but not as matter of the streams.
    """

    belt_width: Length
    belt_speed: Annotated[Speed, Within(1e-4)]
    belt_tension: ForcePerWidth
    cake_resistance: CakeResistance
    solids_fraction_gel: OpenFraction
    solids_fraction_reference: OpenFraction
    consolidation_coefficient: Diffusivity
    _: KW_ONLY
    compaction_exponent: Annotated[Ratio, Within(0.0, 1.0)] = 0.15
    reference_pressure: PressureDrop = 1e5
    medium_resistance: Annotated[MediumResistance, Within(1e3)] = 1e8
    gravity_length: Length = 3.0
    wedge_length: Length = 1.0
    wedge_pressure: PressureDrop = 5e3
    roller_count: Annotated[int, Within(1, 50)] = eqx.field(static=True, default=8)
    roller_diameter_first: Length = 0.6
    roller_diameter_last: Length = 0.2
    wrap_angle: Angle = 2.8
    solids_recovery: Fraction = 0.95
    polymer_dose: MassRatio = 0.005
    braked_share: Fraction = 0.5

    limits: ClassVar[Limits] = {
        "solids": Limit("dry solids per width of belt", 90.0 / 3600.0, 680.0 / 3600.0, "kg/(m*s)", SOURCE),
        "flow": Limit("sludge per width of belt", 0.0, 6.3e-3, "m^2/s", SOURCE),
        "speed": Limit("belt speed", 0.5 / 60.0, 10.0 / 60.0, "m/s", SOURCE),
        "thick": Limit("drained sludge on the belt", 0.0, 0.05, "m", SOURCE),
        "thinner": Limit("feed thinner than drained sludge", 0.0, 1.0, "dimensionless", SOURCE),
        "reached": Limit("share of the possible squeezing reached", 0.5, 1.0, "dimensionless", "shirato1974"),
    }
    utilities: ClassVar[Utilities] = (
        DRIVE | AREA | {"electric_power_pump": Utility(SOURCE), "consumption_polymer": Utility(SOURCE)}
    )

    def steps(self) -> tuple[Any, Any]:
        """Pressures of the wedge and the rollers, and how long each presses."""
        diameters = jnp.linspace(self.roller_diameter_first, self.roller_diameter_last, self.roller_count)
        pressures = jnp.append(jnp.asarray(self.wedge_pressure), 2.0 * self.belt_tension / diameters)
        lengths = jnp.append(jnp.asarray(self.wedge_length), 0.5 * self.wrap_angle * diameters)
        return pressures, lengths / self.belt_speed

    def laid(self, feed: Stream) -> tuple[Any, Any, Any, Any]:
        """Height of the sludge on the belt, solid and most filtrate of it per area, solid that a filtrate
        leaves behind.
        """
        flow, fraction = feed.slurry_volume_flow, feed.solids_volume_fraction
        some = (flow > 0.0) & (fraction > 0.0)
        height = jnp.where(some, flow, 1e-3) / (self.belt_width * self.belt_speed)
        share = jnp.where(some, jnp.clip(fraction, 1e-9, DENSEST), 0.01)
        gel = jnp.maximum(jnp.asarray(self.solids_fraction_gel), share)
        load = feed.solid_density * share / jnp.maximum(1.0 - share / gel, 1e-6)
        return height, share * height, height * (1.0 - share / gel), load

    def drained(self, time: Any, feed: Stream) -> Any:
        """Filtrate per area after a time on the belt."""
        height, _solid, most, load = self.laid(feed)
        fallen = filtrate_depth_falling_head(
            time,
            height,
            self.cake_resistance,
            self.medium_resistance,
            load,
            feed.liquid_viscosity,
            feed.liquid_density,
        )
        return jnp.minimum(fallen, most)

    def ratios(self) -> Any:
        """Void ratios that the sludge would take in the end in the wedge and at each roller."""
        return void_ratio(
            self.steps()[0],
            self.solids_fraction_reference,
            self.reference_pressure,
            self.compaction_exponent,
            self.solids_fraction_gel,
        )

    def inside(self, feed: Stream, wash: Stream | None = None) -> Course:
        height, solid, _most, _load = self.laid(feed)
        drained = self.drained(self.gravity_length / self.belt_speed, feed)
        before = (height - drained) / solid - 1.0
        left = jnp.cumsum(self.steps()[1][::-1])[::-1]
        after, reached = squeezed(before, self.ratios(), left, self.consolidation_coefficient, solid, BELTS)
        return Course(height, drained, solid, before, after, reached)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, course = inlets["feed"], made.inside
        if not float(feed.solid_flow) > 0.0:
            return {}
        pressures, times = (np.asarray(x) for x in self.steps())
        edges = np.concatenate([[0.0], np.cumsum(times)])
        draining = float(self.gravity_length / self.belt_speed) * np.linspace(0.0, 1.0, 41)
        before_each = edges[1:-1] * (1.0 - 1e-9)  # the pressure rises there at once
        pressing = np.unique(np.concatenate([np.linspace(0.0, edges[-1], 161), edges, before_each]))
        loose = (course.height - jax.vmap(lambda t: self.drained(t, feed))(draining)) / course.solid - 1.0
        tight, _reached = jax.vmap(
            lambda t: squeezed(
                course.before,
                self.ratios(),
                jnp.maximum(t - edges[:-1], 0.0),
                self.consolidation_coefficient,
                course.solid,
                BELTS,
            )
        )(pressing)
        step = np.clip(np.searchsorted(edges, pressing, side="right") - 1, 0, len(times) - 1)
        drawn = drawn_pressing(
            (draining, pressing),
            (loose, tight),
            (np.zeros(draining.size), pressures[step]),
            feed,
            (
                (0.0, draining[-1], draining[-1] + times[0], draining[-1] + edges[-1]),
                (_("draining by its weight"), _("wedge of the belts"), _("rollers")),
            ),
        )
        return {_("Sludge on its way through the press"): drawn}

    def outlets(self, inside: Course, feed: Stream, wash: Stream | None = None) -> Pressed:
        kept = self.solids_recovery * feed.solid_volume_flow
        share = jnp.clip(safe_divide(inside.after * kept, feed.liquid_volume_flow, 0.0), 0.0, 1.0)
        cake = feed.part(solid=self.solids_recovery, liquid=share)
        filtrate = feed.part(solid=1.0 - self.solids_recovery, liquid=1.0 - share, gas=1.0)
        return Pressed(cake, filtrate if wash is None else filtrate + wash)

    def figures(
        self, inside: Course, outlets: Pressed, feed: Stream, wash: Stream | None = None
    ) -> PressFigures:
        whole = inside.height - inside.solid * (1.0 + inside.after)
        return PressFigures(
            feed.solid_flow / self.belt_width,
            feed.slurry_volume_flow / self.belt_width,
            jnp.clip(safe_divide(inside.drained, whole, 0.0), 0.0, 1.0),
            1.0 / (1.0 + inside.before),
            self.steps()[0][-1],
            inside.reached,
            outlets.cake.solids_mass_fraction,
            outlets.cake.moisture_dry_basis,
            outlets.cake.slurry_volume_flow / (self.belt_width * self.belt_speed),
            self.polymer_dose * feed.solid_flow,
            BELTS * self.braked_share * self.belt_tension * self.belt_width * self.belt_speed,
        )

    def measured(
        self,
        inside: Course,
        outlets: Pressed,
        figures: PressFigures,
        feed: Stream,
        wash: Stream | None = None,
    ) -> dict[str, Any]:
        return {
            "solids": figures.solids_loading_width,
            "flow": figures.volume_flow_width,
            "speed": jnp.asarray(self.belt_speed),
            "thick": inside.height - inside.drained,
            "thinner": feed.solids_volume_fraction / self.solids_fraction_gel,
            "reached": inside.reached,
        }

    def drawn(
        self,
        inside: Course,
        outlets: Pressed,
        figures: PressFigures,
        feed: Stream,
        wash: Stream | None = None,
    ) -> dict[str, Any]:
        sprayed = 0.0 if wash is None else wash.liquid_volume_flow
        return {
            "electric_power_drive": driven(figures.shaft_power),
            "electric_power_pump": pumped(sprayed, WASH_PRESSURE),
            "consumption_polymer": figures.polymer_flow,
            "area_installed": self.belt_width * (self.gravity_length + self.wedge_length),
        }
