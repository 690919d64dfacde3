"""Countercurrent decantation: thickeners in a row that wash a solid."""

from __future__ import annotations

from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import jax
import jax.numpy as jnp

from granum.core import equipment, stand_ins
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    KINDS,
    Area,
    Concentration,
    Fraction,
    Law,
    MassFlow,
    MassFraction,
    MassRatio,
    PositiveNumber,
    Ratio,
    Speed,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.core.units import format_number, show
from granum.numerics.smooth import safe_divide
from granum.settling.equipment.gravity import Outlets, concentration, floating_share, floats, over_axes
from granum.settling.equipment.rakes import RAKED, THICKENER, raked
from granum.settling.flux import limiting_flux_underflow
from granum.settling.formulas.decantation import soluble_loss_countercurrent
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA

Settling = Annotated[Any, Law("settling_velocity")]
MOST_STAGES = 50
TRACE = 1e-12  # of the liquor of an underflow: a wash so small is none


class Loads(NamedTuple):
    """What the stages bear: solid that goes down, kg/s; flux fed and the least that passes, kg/(m² s); rise
    of the liquid over the velocity of the solid in the first stage; liquor of an underflow, kg/s.
    """

    going_down: Any
    applied_flux: Any
    limiting_flux: Any
    clarification_ratio: Any
    liquor: Any
    underflow_concentration: Any


class DecantationFigures(NamedTuple):
    """Figures of a countercurrent decantation."""

    wash_ratio: Ratio
    soluble_loss: Fraction
    loading_ratio: Ratio
    clarification_ratio: Ratio
    overflow_rate: Speed
    underflow_concentration: Concentration
    underflow_volume_flow: VolumeFlow
    overflow_concentration: Concentration


stand_ins.circle("solids_mass_fraction_underflow")


@equipment(
    "countercurrent_decantation",
    source="coe1916; yoshioka1957; richardson2002, sec. 10.7",
    title="Countercurrent decantation",
    equation=(r"F = \frac{1}{f\,\frac{w^N - 1}{w - 1} + w^N}\ (E_m = 1),\quad G \le \min_k G_L(C_k, C_u)"),
)
class CountercurrentDecantation(Unit):
    """Equal thickeners in a row that wash a solid: it goes down from one to the next, the wash enters at the
    last and flows over from each to the one before.

    Every underflow carries the same liquor with the solid, whose share of what it mixes with is
    ``mixing_efficiency``; nothing dissolves or is adsorbed on the way. The solid goes down as far as flux
    theory lets it through the first stage, which the feed dilutes, and the others; what exceeds that leaves
    with the overflow of the first. Solid and liquor of a stage have one temperature. Whether the liquor
    follows Newton or not is in the settling velocity, which is that of a test in it.
    """

    stage_count: Annotated[PositiveNumber, Within(1.0, 50.0)]
    area: Area
    solids_mass_fraction_underflow: Annotated[MassFraction, Within(1e-3, 0.95)]
    settling: Settling
    _: KW_ONLY
    mixing_efficiency: Annotated[Fraction, Within(0.5, 1.0)] = 0.98

    limits: ClassVar[Limits] = {
        "thickening": Limit("loading of the thickening zone", 0.0, 1.0, "dimensionless", "yoshioka1957"),
        "clarification": Limit("loading of the clarification zone", 0.0, 1.0, "dimensionless", "coe1916"),
        "wash": Limit("wash over liquor of an underflow", 1.0, 5.0, "dimensionless", "richardson2002"),
        "stages": Limit("number of stages", 2.0, 10.0, "dimensionless", "thermopedia2011decantation"),
        "floats": Limit(
            "floating matter, which has no outlet here", 0.0, 0.01, "dimensionless", "coe1916", quiet=True
        ),
        "diameter": Limit("diameter", 0.0, 60.0, "m", "degremont2007"),
    }

    utilities: ClassVar[Utilities] = RAKED | AREA

    def inside(self, feed: Stream, wash: Stream) -> Loads:
        """Loads by flux theory; the solid that a wash may bring passes the last stage alone and is not
        counted.
        """
        sinking = jnp.sum(feed.solid_by_species * (1.0 - floats(feed)))
        per_solid = 1.0 / self.solids_mass_fraction_underflow - 1.0
        thick = feed.solid_density, feed.liquid_density
        under = 1.0 / (1.0 / thick[0] + per_solid / thick[1])
        first = _concentration(sinking, feed.liquid_flow + wash.liquid_flow, *thick)
        others = _concentration(sinking, per_solid * sinking + wash.liquid_flow, *thick)
        fluxes = [
            limiting_flux_underflow(under, jnp.minimum(c, under), self.settling).limiting_flux
            for c in (first, others)
        ]
        # a feed as thick as the underflow is its own limiting layer: it passes as it is
        limit = jnp.minimum(*(jnp.where(jnp.isfinite(flux), flux, jnp.inf) for flux in fluxes))
        applied = sinking / self.area
        passes = jnp.where(applied > limit, limit / jnp.where(applied > 0, applied, 1.0), 1.0)
        down = passes * sinking
        liquor = jnp.minimum(per_solid * down, feed.liquid_flow + wash.liquid_flow)
        rising = (feed.liquid_flow + wash.liquid_flow - liquor) / feed.liquid_density / self.area
        return Loads(
            down,
            applied,
            jnp.where(jnp.isfinite(limit), limit, applied),
            safe_divide(rising, self.settling(first)),
            liquor,
            under,
        )

    def _left(self, feed: Any, wash: Any, underflow: Any, mixing: Any) -> Any:
        """Of what comes with the feed, the share that leaves with the last underflow."""
        some = underflow > 0.0
        under = jnp.where(some, underflow, 1.0)
        w, f = wash / under, jnp.maximum(feed / under, TRACE)
        f = jnp.maximum(f, 1.0 - w)  # the rounding of flows that all go down
        lost = soluble_loss_countercurrent.function(w, self.stage_count, f, mixing)
        return jnp.where(some, jnp.clip(lost, 0.0, 1.0), 0.0)

    def outlets(self, inside: Loads, feed: Stream, wash: Stream) -> Outlets:
        sinking = jnp.sum(feed.solid_by_species * (1.0 - floats(feed)))
        share = over_axes((safe_divide(inside.going_down, sinking) * (1.0 - floats(feed)))[:, None], feed)
        left = self._left(feed.liquid_flow, wash.liquid_flow, inside.liquor, self.mixing_efficiency)
        kept = safe_divide(inside.liquor - left * feed.liquid_flow, wash.liquid_flow)
        joined = feed + wash
        under = joined.replace(
            solid=feed.solid * share + wash.solid,
            liquid=left * feed.liquid + jnp.clip(kept, 0.0, 1.0) * wash.liquid,
            gas=0.0 * joined.gas,
        )
        over = joined.replace(
            solid=joined.solid - under.solid, liquid=joined.liquid - under.liquid, gas=joined.gas
        )
        return Outlets(*self._warmed(inside, joined, feed, wash, under, over))

    def _warmed(
        self, inside: Loads, joined: Stream, feed: Stream, wash: Stream, under: Stream, over: Stream
    ) -> tuple[Stream, Stream]:
        """Heat is washed like a solute whose liquor takes the heat capacity of the solid along: the greater
        of both streams by that, the lesser never beyond feed and wash, the balance exact.
        """
        above = feed.temperature - wash.temperature
        heat = [_capacity(part) for part in (feed, wash, under.replace(temperature=feed.temperature))]
        left = self._left(heat[0], heat[1], heat[2], 1.0)
        out = _capacity(over.replace(temperature=feed.temperature))
        down, up = (
            wash.temperature + jnp.clip(safe_divide(share * heat[0], capacity), 0.0, 1.0) * above
            for share, capacity in ((left, heat[2]), (1.0 - left, out))
        )
        some = (over.mass_flow > 0) & (under.mass_flow > 0)
        below = heat[2] < out  # told by its temperature, the other by the balance
        small, large = (
            _either(below, under, over).replace(
                temperature=jnp.where(some, jnp.where(below, down, up), joined.temperature)
            ),
            _either(below, over, under),
        )
        large = large.at_enthalpy(joined.enthalpy_flow - small.enthalpy_flow, guess=joined.temperature)
        return _either(below, small, large), _either(below, large, small)

    def figures(self, inside: Loads, outlets: Outlets, feed: Stream, wash: Stream) -> DecantationFigures:
        left = self._left(feed.liquid_flow, wash.liquid_flow, inside.liquor, self.mixing_efficiency)
        return DecantationFigures(
            safe_divide(wash.liquid_flow, inside.liquor),
            left,
            safe_divide(inside.applied_flux, inside.limiting_flux),
            inside.clarification_ratio,
            outlets.overflow.slurry_volume_flow / self.area,
            concentration(outlets.underflow),
            outlets.underflow.slurry_volume_flow,
            concentration(outlets.overflow),
        )

    def measured(
        self, inside: Loads, outlets: Outlets, figures: DecantationFigures, feed: Stream, wash: Stream
    ) -> dict[str, Any]:
        return {
            "thickening": figures.loading_ratio,
            "clarification": figures.clarification_ratio,
            "wash": figures.wash_ratio,
            "stages": jnp.asarray(self.stage_count, dtype=float),
            "floats": floating_share(feed),
            "diameter": jnp.sqrt(4.0 * self.area / jnp.pi),
        }

    def drawn(
        self, inside: Loads, outlets: Outlets, figures: DecantationFigures, feed: Stream, wash: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_rake": self.stage_count * raked(self.area, THICKENER),
            "area_installed": self.stage_count * self.area,
        }

    @classmethod
    def size(
        cls,
        mass_flow: MassFlow,
        underflow_liquid_ratio: MassRatio,
        feed_liquid_ratio: MassRatio,
        wash_ratio: Ratio,
        soluble_loss: Fraction,
        solid_density: Any,
        liquid_density: Any,
        settling: Any,
        mixing_efficiency: Fraction = 0.98,
        safety_factor: Ratio = 1.25,
    ) -> CountercurrentDecantation:
        """The least whole number of thickeners that loses at most a share of the solute, and the area of each
        by flux theory with a factor.
        """
        f = feed_liquid_ratio / underflow_liquid_ratio
        lost = {
            n: float(soluble_loss_countercurrent(wash_ratio, float(n), f, mixing_efficiency))
            for n in range(1, MOST_STAGES + 1)
        }
        stages = next((n for n, share in lost.items() if share <= soluble_loss), None)
        if stages is None:
            raise InputError(
                _(
                    "{stages} thickeners with a wash of {wash} liquors of an underflow still lose {least} "
                    "of the solute: give more wash, a thicker underflow, or allow more than {wanted}."
                ).format(
                    stages=MOST_STAGES,
                    wash=format_number(wash_ratio),
                    least=show(min(lost.values()), KINDS["Fraction"]),
                    wanted=show(soluble_loss, KINDS["Fraction"]),
                )
            )
        under = 1.0 / (1.0 / solid_density + underflow_liquid_ratio / liquid_density)
        met = [
            1.0 / (1.0 / solid_density + liquor / liquid_density)
            for liquor in (
                feed_liquid_ratio + wash_ratio * underflow_liquid_ratio,
                (1.0 + wash_ratio) * underflow_liquid_ratio,
            )
        ]
        limit = min(float(limiting_flux_underflow(under, c, settling).limiting_flux) for c in met)
        return cls(
            stage_count=float(stages),
            area=safety_factor * mass_flow / limit,
            solids_mass_fraction_underflow=1.0 / (1.0 + underflow_liquid_ratio),
            settling=settling,
            mixing_efficiency=mixing_efficiency,
        )


def _concentration(solid: Any, liquid: Any, solid_density: Any, liquid_density: Any) -> Any:
    """Solid per volume, kg/m³; zero of none."""
    return safe_divide(solid, solid / solid_density + liquid / liquid_density)


def _either(first: Any, one: Stream, other: Stream) -> Stream:
    """One stream or the other."""
    return jax.tree.map(lambda a, b: jnp.where(first, a, b), one, other)


def _capacity(stream: Stream) -> Any:
    """Heat capacity flow about its temperature, W/K."""
    return 0.5 * (stream.enthalpy_at(stream.temperature + 1.0) - stream.enthalpy_at(stream.temperature - 1.0))
