"""Continuous crystallizer that dissolves fines and classifies its product: a draft tube with a baffle and an
elutriation leg.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.conversion import is_tracer
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Distance,
    GrowthRate,
    Length,
    MassFlow,
    NucleationRate,
    Number,
    PositiveNumber,
    Power,
    RotationSpeed,
    SpecificPower,
    Time,
    Velocity,
    VoidFraction,
    VolumeFlow,
)
from granum.crystallization.equipment.beside import solubility_beside
from granum.crystallization.equipment.colliding import Colliding
from granum.crystallization.equipment.in_time import Crystallized
from granum.crystallization.equipment.msmpr import Evaporative
from granum.crystallization.equipment.roles import Roles, crystal_of, feed_of, saturated_at
from granum.crystallization.formulas.upflow import Upflow
from granum.crystallization.vessels.msmpr import Removal, SteadyState
from granum.streams.stream import Stream

NO_CUT = (
    "The upflow floats no crystals between a micrometer and 5 cm: give a slower one, or crystals that are "
    "heavier than their liquor."
)
CROSSED = (
    "The cut of the fines must be below that of the product: give a larger settling area or less fines "
    "removal, or a faster upflow in the leg."
)
DILUTE = 0.999  # void fraction behind the baffle, where only fines are


class ClassifiedFigures(NamedTuple):
    """Figures of a continuous crystallizer with fines dissolution and classified product."""

    crystal_flow: MassFlow
    yield_fraction: Number
    magma_density: Concentration
    relative_supersaturation: Number
    growth_rate: GrowthRate
    nucleation_rate: NucleationRate
    residence_time: Time
    growth_length: Distance
    mass_median_size: Distance
    evaporation: MassFlow
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower
    fines_flow: VolumeFlow
    cut_size_baffle: Distance
    upflow_velocity_baffle: Velocity
    cut_size_leg: Distance
    upflow_velocity_leg: Velocity


@equipment(
    "classified_crystallizer",
    source="randolph1988, ch. 8; richardson1954",
    title="Continuous crystallizer with fines dissolution and classified product (R–Z)",
    equation=r"\ln\frac{n}{n_0} = -\frac{R\min(L,L_f) + \dots + z\max(0,L-L_p)}{G\tau},\quad "
    r"v_t(L_f) = \frac{(R-1)\dot V}{A_b}",
)
class ClassifiedCrystallizer(Colliding, Evaporative):
    """Continuous crystallizer that dissolves fines and draws coarse product preferentially, with sharp cuts
    (R–Z model).

    A ratio of 1 leaves that stream out. Fines dissolution makes fewer, larger crystals; classified product
    removal evens the sizes. ``oslo_crystallizer`` is the fluidized bed whose sizes follow from its upflow.
    The dissolved fines return with their solute, whose heat cancels. Either the cuts are given, or they
    follow from the upflow of saturated liquor (a draft tube with baffle): that of the fines from the
    ``settling_area`` behind the baffle, through which R − 1 times the flow of the feed rises with little but
    fines in it; that of the product from ``elutriation_flow`` and ``leg_diameter`` of the leg, crowded by
    ``void_fraction_leg``. What rises in the leg is liquor of the vessel, and no feed of its own.
    """

    fines_removal_ratio: PositiveNumber = 1.0
    fines_cut_size: Distance = 0.0
    product_removal_ratio: PositiveNumber = 1.0
    product_cut_size: Distance = 1.0
    settling_area: Area | None = eqx.field(kw_only=True, default=None)
    elutriation_flow: VolumeFlow | None = eqx.field(kw_only=True, default=None)
    leg_diameter: Length | None = eqx.field(kw_only=True, default=None)
    void_fraction_leg: VoidFraction = eqx.field(kw_only=True, default=0.9)

    instead: ClassVar[Mapping[str, str]] = {
        "settling_area": "fines_cut_size",
        "leg_diameter": "product_cut_size",
        "elutriation_flow": "product_cut_size",
    }

    def __check_init__(self) -> None:
        if (self.elutriation_flow is None) != (self.leg_diameter is None):
            raise CaseError(_("An elutriation leg takes both 'elutriation_flow' and 'leg_diameter'."))
        for asked, cut, none, name, by in (
            (self.settling_area, self.fines_cut_size, 0.0, "fines_cut_size", "settling_area"),
            (self.leg_diameter, self.product_cut_size, 1.0, "product_cut_size", "leg_diameter"),
        ):
            if asked is not None and (is_tracer(cut) or float(cut) != none):
                raise CaseError(
                    _("The cut follows from '{by}': leave out '{name}', or give that alone.").format(
                        by=by, name=name
                    )
                )

    def _fines_flow(self, feed: Stream, found: Roles, evaporation: Any) -> Any:
        """Liquor drawn off behind the baffle beside the product, m³/s."""
        entering = feed_of(feed, found)
        crystal = crystal_of(feed.mixture, found, self.temperature, self.volume_shape_factor)
        flow = self._liquor(feed, found, self.temperature)(entering.solute, entering.solvent - evaporation)
        return jnp.maximum(self.fines_removal_ratio - 1.0, 0.0) * (
            flow + jnp.sum(entering.crystals) / crystal.density
        )

    def _upflows(self, feed: Stream, found: Roles, evaporation: Any) -> tuple[Any, Any]:
        """Behind the baffle and in the leg, m/s; zero where there is none."""
        baffle = leg = jnp.zeros(())
        if self.settling_area is not None:
            baffle = self._fines_flow(feed, found, evaporation) / self.settling_area
        if self.leg_diameter is not None:
            leg = jnp.asarray(self.elutriation_flow) / (0.25 * math.pi * self.leg_diameter**2)
        return baffle, leg

    def _removal(self, feed: Stream, found: Roles, evaporation: Any) -> Removal:
        T, cuts = self.temperature, [self.fines_cut_size, self.product_cut_size]
        if self.settling_area is not None or self.leg_diameter is not None:
            soluble = solubility_beside(self.solubility, feed.mixture, found, feed.liquid, T, None)
            liquor = saturated_at(feed, found, soluble, T)
            crystal = crystal_of(feed.mixture, found, T, self.volume_shape_factor)
            given = self.settling_area, self.leg_diameter
            for place, velocity in enumerate(self._upflows(feed, found, evaporation)):
                if given[place] is None:
                    continue
                rises = velocity > 0.0
                upflow = Upflow(
                    jnp.where(rises, velocity, 1e-3), liquor.liquid_density, liquor.liquid_viscosity
                )
                size, some = upflow.size_at((DILUTE, self.void_fraction_leg)[place], crystal)
                unsolved(some, type(self).card, reason=NO_CUT)
                cuts[place] = jnp.where(rises, size, 0.0)
            unsolved(jnp.asarray(cuts[0]) <= jnp.asarray(cuts[1]), type(self).card, reason=CROSSED)
        return Removal(self.fines_removal_ratio, cuts[0], self.product_removal_ratio, cuts[1])

    def figures(
        self, inside: tuple[SteadyState, Roles], outlets: Crystallized, feed: Stream
    ) -> ClassifiedFigures:
        found = inside[1]
        evaporation, _more = self._evaporation(feed, found, self.temperature)
        removal = self._removal(feed, found, evaporation)
        baffle, leg = self._upflows(feed, found, evaporation)
        return ClassifiedFigures(
            *self._common(inside, outlets, feed),
            self._fines_flow(feed, found, evaporation),
            jnp.asarray(removal.fines_cut, dtype=float),
            baffle,
            jnp.where(jnp.asarray(removal.product_ratio) == 1.0, 0.0, removal.product_cut),
            leg,
        )
