"""Filters that give back a thickened slurry instead of a cake: what they catch is pushed or sheared off."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    CakeResistance,
    Distance,
    Fraction,
    MassPerAreaOrZero,
    MassTransferCoefficient,
    MediumResistance,
    PowerPerArea,
    PressureDrop,
    Ratio,
    Speed,
    Time,
    VoidFraction,
    VolumeFlow,
    VolumeFraction,
    Within,
)
from granum.core.limits import Limit
from granum.filtration.equipment.cake_filter import OPEN, THIN
from granum.filtration.formulas.constant_pressure import (
    filtrate_volume_constant_pressure,
    filtration_time_constant_pressure,
)
from granum.filtration.formulas.resistance import cake_resistance_power_law
from granum.filtration.kinds import VolumePerArea
from granum.numerics.smooth import safe_divide
from granum.streams.cakes import sinking_solids
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, PUMPED, pumped

SOURCE = "ruth1935; cheryan1998; cumming1999"
MOST_PACKED = 0.999  # of a packed cake, above which a slurry around the elements counts as that full
LEAST_FLUX = 1e-12  # m/s, of shear that is none
SWALLOWED = (
    "The pulses take back all the filtrate that is made between them: filter longer, push back less, or give "
    "more pressure or an opener medium."
)
PACKED = "The slurry wanted is thicker than a packed cake: ask for less, or give a denser cake."


class Thickened(NamedTuple):
    """Thickened slurry and clear filtrate."""

    thickened: Stream
    filtrate: Stream


class ThickeningFigures(NamedTuple):
    """Figures of a thickening filter."""

    area_required: Area
    capacity_use: Ratio
    filtrate_flux: Speed
    filtrate_flux_last: Speed
    filtrate_flow: VolumeFlow
    cake_thickness: Distance
    dry_cake_mass_per_area: MassPerAreaOrZero
    backwash_share: Fraction
    solids_volume_fraction: VolumeFraction


class Pulsed(NamedTuple):
    """Shares of solid and liquid to the thickened slurry, volumes per area of a cycle: filtered and net; mean
    and last flux; cake; area needed; what Ruth's law is given, and the time and the flux at which shear stops
    the cake.
    """

    solid: Any
    liquid: Any
    filtered: Any
    net: Any
    flux: Any
    last: Any
    loading: Any
    thickness: Any
    needed: Any
    law: tuple[Any, ...]
    until: Any
    carried: Any


@equipment(
    "thickening_filter",
    source=SOURCE,
    title="Thickening filter",
    equation=(
        r"u = \frac{V(t) - V_w}{t + t_{mort}},\qquad \frac{\eta\,(\alpha W V' + R_s)}{\Delta p} \le "
        r"\frac{1}{u_s},\quad u_s = k\,\ln\frac{1-\varepsilon}{\varphi}"
    ),
)
class ThickeningFilter(Unit):
    """Candles, tubes, leaves or turning discs in a vessel, whose cake is thrown back into the slurry: pulses
    of filtrate every ``filtration_time``, shear that keeps it thin (delayed cake), or both.

    Filtrate leaves as much as thickens the slurry to the given volume fraction.
    Between pulses the cake grows by Ruth; under shear only until its flux has fallen to what shear carries
    away, with ``mass_transfer_coefficient`` as in films of membranes: its value comes from a trial, which
    finds that flux in proportion to the logarithm of the solids. Without shear give none. Clods of a pulsed
    cake sink, and the elements stand in slurry like the feed (a check tells of solids that would float); in a
    vessel that is stirred all through they stand in thickened slurry (``vessel_contents``). Each pulse is
    filtered again, and clears the medium. Limits recalled, not opened.
    """

    area: Area
    pressure_drop: PressureDrop
    cake_resistance: CakeResistance
    void_fraction: VoidFraction
    solids_volume_fraction_thickened: Annotated[VolumeFraction, Within(1e-4, 0.7)]
    _: KW_ONLY
    compressibility: Ratio = 0.0
    reference_pressure: PressureDrop = 1e5
    medium_resistance: MediumResistance = 0.0
    solids_recovery: Fraction = 1.0
    filtration_time: Annotated[Time, Within(1.0)] = 600.0
    dead_time: Time = 30.0
    backwash_volume_per_area: VolumePerArea = 0.002
    mass_transfer_coefficient: MassTransferCoefficient | None = None
    vessel_contents: Literal["feed", "thickened"] = eqx.field(static=True, default="feed")
    drive_power_per_area: PowerPerArea = 0.0

    limits: ClassVar[Limits] = {
        "capacity": Limit("share of the filtration capacity in use", 0.0, 1.0, "dimensionless", "ruth1935"),
        "pressure": Limit("pressure drop of a thickening filter", 1e4, 6e5, "Pa", "wakeman2005"),
        "thin": Limit("cake thickness between pulses", 0.0, 0.01, "m", "wakeman2005"),
        "flows": Limit(
            "thickened solids over those of a packed cake", 0.0, 0.8, "dimensionless", "wakeman2005"
        ),
        "thicker": Limit("thickened solids over those of the feed", 1.0, 1e4, "dimensionless", "wakeman2005"),
        "sinking": Limit(
            "share of the solids that is heavier than the liquid",
            1.0 - 1e-3,
            1.0,
            "dimensionless",
            "wakeman2005",
        ),
        "pulses": Limit(
            "share of the filtrate that pulses take back", 0.0, 0.2, "dimensionless", "wakeman2005"
        ),
    }

    utilities: ClassVar[Utilities] = PUMPED | AREA | {"electric_power_drive": PUMPED["electric_power_pump"]}

    def split(self, feed: Stream) -> tuple[Any, Any]:
        """Shares of solid and liquid that leave thickened."""
        solid = self.solids_recovery * feed.solid_flow / feed.solid_density
        wanted = self.solids_volume_fraction_thickened
        liquid = solid * (1.0 - wanted) / wanted
        return jnp.asarray(self.solids_recovery, dtype=float), jnp.minimum(
            safe_divide(liquid, feed.liquid_volume_flow, 1.0), 1.0
        )

    def inside(self, feed: Stream) -> Pulsed:
        solid, liquid = self.split(feed)
        packed = 1.0 - self.void_fraction
        unsolved(self.solids_volume_fraction_thickened < packed, type(self).card, reason=PACKED)
        around = (
            feed.solids_volume_fraction
            if self.vessel_contents == "feed"
            else jnp.where(feed.solid_flow > 0.0, self.solids_volume_fraction_thickened, 0.0)
        )
        around = jnp.minimum(around, MOST_PACKED * packed)
        per_filtrate = jnp.maximum(around * feed.solid_density / (1.0 - around / packed), THIN)
        resistance = cake_resistance_power_law(
            self.pressure_drop, self.cake_resistance, self.compressibility, self.reference_pressure
        )
        law = (
            1.0,
            self.pressure_drop,
            feed.liquid_viscosity,
            resistance,
            per_filtrate,
            self.medium_resistance,
        )
        # under shear: the cake stops where its flux is that which is carried away
        open_flux = safe_divide(
            self.pressure_drop / feed.liquid_viscosity, jnp.asarray(self.medium_resistance, dtype=float), 1e6
        )
        carried = jnp.minimum(self.carried(around, packed), open_flux)
        through = self.pressure_drop / (feed.liquid_viscosity * carried) - self.medium_resistance
        most = jnp.maximum(through, 0.0) / (resistance * per_filtrate)
        until = filtration_time_constant_pressure(most, *law)
        growing, filtered = _filtered(self.filtration_time, until, carried, law)
        loading = per_filtrate * jnp.minimum(growing, most)
        resists = jnp.maximum(resistance * loading + self.medium_resistance, OPEN)
        last = self.pressure_drop / (feed.liquid_viscosity * resists)
        some = feed.liquid_flow > 0.0
        net = jnp.where(some, filtered - self.backwash_volume_per_area, 0.0)
        unsolved((net > 0.0) | ~some, type(self).card, reason=SWALLOWED)
        flux = net / (self.filtration_time + self.dead_time)
        needed = safe_divide((1.0 - liquid) * feed.liquid_volume_flow, flux, 0.0)
        return Pulsed(
            solid,
            liquid,
            filtered,
            net,
            flux,
            last,
            loading,
            loading / (packed * feed.solid_density),
            needed,
            law,
            until,
            carried,
        )

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, pulsed = inlets["feed"], made.inside
        if not float(feed.solid_flow) > 0.0:
            return {}
        _area, pressure, viscosity, resistance, load, medium = pulsed.law
        time = float(self.filtration_time) * np.linspace(0.0, 1.0, 161) ** 2  # steepest at first
        growing, _filtrate = jax.vmap(lambda t: _filtered(t, pulsed.until, pulsed.carried, pulsed.law))(time)
        loading = jnp.minimum(load * growing, pulsed.loading)
        flux = pressure / (viscosity * jnp.maximum(resistance * loading + medium, OPEN))
        tall = max(
            4.0 * float(pulsed.flux), 2.0 * float(pulsed.last)
        )  # the first moments would hide the rest
        drawn = drawn_along(
            Axis("time", "Time"),
            time,
            (
                Axis("filtrate_flux", "Speed"),
                [
                    Curve(_("flux"), np.where(flux <= tall, flux, np.nan), "LIQUID"),
                    Curve(_("mean of the cycle"), np.full(time.shape, float(pulsed.flux)), "LIQUID", "dot"),
                ],
            ),
            (
                Axis("cake_thickness", "Distance"),
                [
                    Curve(
                        _("cake"),
                        loading / ((1.0 - self.void_fraction) * feed.solid_density),
                        "SOLID",
                        "dash",
                    )
                ],
            ),
        )
        return {_("Between two pulses"): drawn}

    def carried(self, around: Any, packed: Any) -> Any:
        """Flux whose solid shear carries away from the cake, m/s; hardly any without shear."""
        if self.mass_transfer_coefficient is None:
            return jnp.asarray(LEAST_FLUX)
        room = jnp.log(packed / jnp.maximum(around, 1e-9))
        return jnp.maximum(self.mass_transfer_coefficient * room, LEAST_FLUX)

    def outlets(self, inside: Pulsed, feed: Stream) -> Thickened:
        thick = feed.part(solid=inside.solid, liquid=inside.liquid)
        return Thickened(
            thick, feed.replace(solid=feed.solid - thick.solid, liquid=feed.liquid - thick.liquid)
        )

    def figures(self, inside: Pulsed, outlets: Thickened, feed: Stream) -> ThickeningFigures:
        return ThickeningFigures(
            inside.needed,
            inside.needed / self.area,
            inside.flux,
            inside.last,
            outlets.filtrate.liquid_volume_flow,
            inside.thickness,
            inside.loading,
            jnp.clip(
                safe_divide(self.backwash_volume_per_area + 0.0 * inside.net, inside.filtered, 0.0), 0.0, 1.0
            ),
            outlets.thickened.solids_volume_fraction,
        )

    def measured(
        self, inside: Pulsed, outlets: Thickened, figures: ThickeningFigures, feed: Stream
    ) -> dict[str, Any]:
        thick = outlets.thickened.solids_volume_fraction
        sinking, _density = sinking_solids(feed)
        return {
            "capacity": figures.capacity_use,
            "pressure": jnp.asarray(self.pressure_drop),
            "thin": inside.thickness,
            "flows": thick / (1.0 - self.void_fraction),
            "thicker": safe_divide(
                self.solids_volume_fraction_thickened + 0.0 * thick, feed.solids_volume_fraction, 1.0
            ),
            "sinking": sinking if self.vessel_contents == "feed" else 1.0 + 0.0 * sinking,
            "pulses": figures.backwash_share,
        }

    def drawn(
        self, inside: Pulsed, outlets: Thickened, figures: ThickeningFigures, feed: Stream
    ) -> dict[str, Any]:
        back = safe_divide(figures.filtrate_flow * self.backwash_volume_per_area, inside.net, 0.0)
        return {
            # what pulses push back is pumped against the pressure twice: back, and again through the cake
            "electric_power_pump": pumped(feed.slurry_volume_flow + 2.0 * back, self.pressure_drop),
            "electric_power_drive": self.drive_power_per_area * self.area,
            "area_installed": self.area,
        }


def _filtered(time: Any, until: Any, carried: Any, law: tuple[Any, ...]) -> tuple[Any, Any]:
    """Filtrate per area that grows a cake up to a time, and all of it with that at the flux under shear."""
    growing = filtrate_volume_constant_pressure(jnp.minimum(time, until), *law)
    return growing, growing + carried * jnp.maximum(time - until, 0.0)
