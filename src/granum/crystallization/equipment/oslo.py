"""Fluidized-bed crystallizer (Oslo, Krystal): the upflow suspends the crystals and sorts them."""

from __future__ import annotations

import math
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.constants import STANDARD_GRAVITY
from granum.core.conversion import is_tracer
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    GrowthRate,
    Length,
    Mass,
    MassFlow,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    PressureDrop,
    Ratio,
    Speed,
    Temperature,
    Time,
    Velocity,
    VoidFraction,
    VolumeFlow,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.beside import heard_beside, keeps_solvent, solubility_beside
from granum.crystallization.equipment.in_time import Crystallized
from granum.crystallization.equipment.roles import (
    LARGEST,
    Roles,
    crystal_of,
    feed_of,
    given_off,
    refuse_boiling,
    roles,
    saturated_at,
    with_crystals,
)
from granum.crystallization.formulas.upflow import Upflow
from granum.crystallization.kinds import Growth, Nucleation, Solubility
from granum.crystallization.vessels.classified_bed import Bed, steady_bed
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import AREA, COOLED, HEATED, PUMPED, cooled, heated, pumped

_NO_BED = (
    "The upflow keeps no crystals of this density between a micrometer and 5 cm in suspension: give a slower "
    "upflow, or crystals that are heavier than their liquor."
)
_UNSOLVED = "No supersaturation was found at which the bed grows the crystals that the solute balance leaves."
_ORDER = "The bed must be denser at its bottom than at its top: void_fraction_bottom below void_fraction_top."


class OsloFigures(NamedTuple):
    """Figures of a fluidized-bed crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Number
    size_bed_top: Length
    size_bed_bottom: Length
    carrying_velocity: Velocity
    bed_void_fraction: Fraction
    crystals_in_bed: Mass
    magma_density: Concentration
    relative_supersaturation: Number
    supersaturation_inlet: Number
    growth_rate: GrowthRate
    time_in_bed: Time
    nucleation_rate: NucleationRate
    nuclei_surplus: Ratio
    circulation_upflow: VolumeFlow
    pressure_drop: PressureDrop
    evaporation: MassFlow
    heat_duty: Power


@equipment(
    "oslo_crystallizer",
    source="mullin2001, ch. 9; richardson1954; mccabe2005, ch. 27",
    title="Fluidized-bed crystallizer from its upflow (Oslo, Krystal)",
    equation=(
        r"A H = \dot N k_v \int_{L_t}^{L_p} \frac{L^3\,\mathrm{d}L}{G\,(1-\varepsilon)},\quad "
        r"\varepsilon = \left(\frac{U}{v_t(L)}\right)^{1/n}"
    ),
    typical={"superficial_velocity": (0.01, 0.06), "area": (1.0, 10.0), "height": (0.5, 3.0)},
)
class OsloCrystallizer(Unit):
    """Crystals that circulating liquor keeps floating, sorted by size: fines are carried off at the top,
    product leaves at the bottom, all of one size.

    Sizes follow from the upflow: at each void fraction floats the size that Richardson and Zaki's law says,
    with the exponent of Rowe and the terminal velocity of the sphere of equal volume, in liquor that is
    saturated. On its way up the liquor gives its supersaturation to ever smaller crystals; the one with which
    it enters must not be more than the metastable zone allows, or circulate more. Nuclei beyond those that
    the product needs, and crystals that come with the feed, are dissolved outside the bed; where too few are
    born, it wants a seed. The pressure drop is that of the bed, without pipes; the pump is counted for a bed
    that is as dense throughout as at its bottom. Crystals only grow here: what joins or chips in the bed is
    left out.
    """

    temperature: Temperature
    area: Area
    height: Length
    superficial_velocity: Speed
    solubility: Solubility
    growth: Growth
    nucleation: Nucleation
    void_fraction_bottom: VoidFraction = 0.55
    void_fraction_top: VoidFraction = 0.9
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    evaporation: MassFlow = eqx.field(kw_only=True, default=0.0)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    limits: ClassVar[Limits] = {
        "born": Limit("nuclei born over those needed", 1.0, math.inf, "dimensionless", "mullin2001, ch. 9"),
        "largest": Limit(LARGEST, 0.0, 0.05, "dimensionless", "randolph1988, ch. 4"),
        "drying": Limit("solvent evaporated", 0.0, math.inf, "kg/s", "randolph1988, ch. 4"),
    }

    utilities: ClassVar[Utilities] = PUMPED | HEATED | COOLED | AREA

    def __check_init__(self) -> None:
        low, high = self.void_fraction_bottom, self.void_fraction_top
        if not (is_tracer(low) or is_tracer(high)) and np.any(np.asarray(low) >= np.asarray(high)):
            raise InputError(_(_ORDER), name="void_fraction_bottom")

    def _soluble(self, feed: Stream, found: Roles) -> Any:
        left = feed.liquid[found.solvent] - self.evaporation if keeps_solvent(found) else None
        T = self.temperature
        return solubility_beside(self.solubility, feed.mixture, found, feed.liquid, T, left)

    def inside(self, feed: Stream) -> tuple[Bed, Roles, Upflow]:
        """The steady bed, which species plays which part, and the liquor that rises."""
        found, T = roles(feed.mixture, self.solid, self.solvent), self.temperature
        liquor = saturated_at(feed, found, self._soluble(feed, found), T)
        upflow = Upflow(self.superficial_velocity, liquor.liquid_density, liquor.liquid_viscosity)
        bed = steady_bed(
            feed_of(feed, found),
            T,
            self.area,
            self.height,
            upflow,
            (self.void_fraction_top, self.void_fraction_bottom),
            self._soluble(feed, found),
            self.growth,
            self.nucleation,
            crystal_of(feed.mixture, found, T, self.volume_shape_factor),
            self.evaporation,
        )
        unsolved(bed.found, type(self).card, reason=_NO_BED)
        unsolved(bed.converged, type(self).card, reason=_UNSOLVED)
        there = T, bed.solute_per_solvent, bed.solvent
        heard_beside(self.solubility, feed.mixture, found, feed.liquid, there, type(self).card)
        return bed, found, upflow

    def outlets(self, inside: tuple[Bed, Roles, Upflow], feed: Stream) -> Crystallized:
        bed, found, _upflow = inside
        T = jnp.asarray(self.temperature, dtype=float)
        edges = jnp.asarray(feed.mixture.edges)
        place = jnp.clip(jnp.searchsorted(edges, bed.largest) - 1, 0, edges.shape[0] - 2)
        crystals = jnp.zeros(edges.shape[0] - 1).at[place].set(bed.product)
        liquid = feed.liquid.at[found.solute].set(bed.solute).at[found.solvent].set(bed.solvent)
        product = feed.replace(
            solid=with_crystals(feed, found, crystals), liquid=liquid, gas=0.0 * feed.gas, temperature=T
        )
        vapor = given_off(feed, found, self.evaporation, T)
        if found.vapor is not None:
            refuse_boiling(vapor.gas[found.vapor], product, feed, found, type(self).card)
        return Crystallized(product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow)

    def figures(self, inside: tuple[Bed, Roles, Upflow], outlets: Crystallized, feed: Stream) -> OsloFigures:
        bed, found, upflow = inside
        crystal = crystal_of(feed.mixture, found, self.temperature, self.volume_shape_factor)
        entering, volume = feed_of(feed, found), self.area * self.height
        fed = entering.solute + found.solute_fraction * jnp.sum(entering.crystals)
        grown = bed.largest - bed.smallest
        return OsloFigures(
            bed.product,
            safe_divide(found.solute_fraction * bed.product, fed),
            bed.smallest,
            bed.largest,
            upflow.falls(bed.smallest, crystal)[0],
            1.0 - bed.held / (crystal.density * volume),
            bed.held,
            bed.held / volume,
            bed.relative_supersaturation,
            bed.supersaturation_inlet,
            safe_divide(grown, bed.time),
            bed.time,
            bed.births / volume,
            safe_divide(bed.births, bed.number, 1.0),
            self.superficial_velocity * self.area,
            STANDARD_GRAVITY * bed.held * (1.0 - upflow.density / crystal.density) / self.area,
            jnp.asarray(self.evaporation, dtype=float),
            outlets.heat_duty,
        )

    def measured(
        self,
        inside: tuple[Bed, Roles, Upflow],
        outlets: Crystallized,
        figures: OsloFigures,
        feed: Stream,
    ) -> dict[str, Any]:
        return {
            "born": figures.nuclei_surplus,
            "largest": outlets.product.size_fractions[-1],
            "drying": figures.evaporation,
        }

    def drawn(
        self,
        inside: tuple[Bed, Roles, Upflow],
        outlets: Crystallized,
        figures: OsloFigures,
        feed: Stream,
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, outlets.product.temperature
        _bed, found, upflow = inside
        crystal = crystal_of(feed.mixture, found, self.temperature, self.volume_shape_factor)
        densest = (1.0 - self.void_fraction_bottom) * (crystal.density - upflow.density) * self.height
        return (
            heated(duty, T)
            | cooled(duty, T)
            | {
                "electric_power_pump": pumped(
                    figures.circulation_upflow, STANDARD_GRAVITY * jnp.maximum(densest, 0.0)
                ),
                "area_installed": self.area,
            }
        )
