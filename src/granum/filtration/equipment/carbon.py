"""Beds of activated carbon for gas and for liquid: life to breakthrough, carbon used, pressure drop."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import KW_ONLY
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Density,
    Fraction,
    Law,
    Length,
    Mass,
    MassFlow,
    MassRatio,
    OpenFraction,
    Pressure,
    Speed,
    Sphericity,
    Time,
    VoidFraction,
    Within,
)
from granum.core.limits import Limit
from granum.filtration.formulas.adsorption import (
    breakthrough_fraction_bohart_adams,
    breakthrough_time_wheeler_jonas,
)
from granum.filtration.kinds import AdsorptionRate
from granum.numerics.smooth import safe_divide
from granum.porous.formulas.packed_beds import pressure_gradient_ergun
from granum.streams.equilibrium import HumidMixture
from granum.streams.inside_charts import Axis, Curve, drawn_along
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream, settled
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import AREA, FANNED, PUMPED, fanned, pumped

SOURCE = "sorrels2018, ch. 1"
WATER = "water"
ENDLESS = 1e10  # s: the life of a bed that takes up nothing
BROKEN = (
    "The bed lets the substance through from the first moment: give more bed depth or area, finer grains, or "
    "a higher breakthrough fraction."
)


class Purified(NamedTuple):
    """What leaves the bed, and what the carbon holds when it is changed or regenerated, in the phase in which
    it came.
    """

    cleaned: Stream
    adsorbed: Stream


class CarbonFigures(NamedTuple):
    """Figures of a carbon bed."""

    superficial_velocity: Speed
    contact_time_bed: Time
    adsorbate_loading: MassRatio
    run_time: Time
    bed_use: Fraction
    carbon_mass: Mass
    carbon_use: MassFlow
    removal_efficiency: Fraction
    pressure_drop_bed: Pressure


class Bedded(NamedTuple):
    """Velocity, contact time, loading, run, share of the capacity used, mean share removed, pressure lost,
    depth over that of the front.
    """

    velocity: Any
    contact: Any
    loading: Any
    run: Any
    use: Any
    removed: Any
    lost: Any
    depth: Any


class Fluid(NamedTuple):
    """What flows through: m³/s, kg/m³, Pa s, and of the substance kg/s."""

    volume: Any
    density: Any
    viscosity: Any
    amount: Any


class CarbonBed(Unit):
    """Abstract bed of activated carbon that takes one substance out of a fluid until it breaks through."""

    area: Area
    bed_depth: Annotated[Length, Within(1e-3, 30.0)]
    particle_diameter: Annotated[Length, Within(1e-5, 0.1)]
    adsorption_isotherm: Annotated[Any, Law("adsorption_isotherm")]
    adsorption_rate: AdsorptionRate
    _: KW_ONLY
    adsorbate: str = eqx.field(static=True, default="")
    breakthrough_fraction: Annotated[OpenFraction, Within(1e-6, 0.5)] = 0.05
    bed_density: Annotated[Density, Within(50.0, 2000.0)] = 450.0
    void_fraction: VoidFraction = 0.4
    sphericity: Sphericity = 0.75

    PHASE: ClassVar[str]

    def place(self, feed: Stream) -> int:
        """Where the substance stands in its phase: as named, else the only one beside the carrier."""
        names = [s.name for s in getattr(feed.mixture, self.PHASE)]
        if self.adsorbate:
            return feed.mixture.index(self.PHASE, self.adsorbate)
        rest = self.candidates(feed, names)
        if len(rest) != 1:
            raise CaseError(
                _("Which substance does the carbon take up? Name one of {names} as 'adsorbate'.").format(
                    names=", ".join(names) or "—"
                )
            )
        return names.index(rest[0])

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        bed, seen = made.inside, self.fluid(inlets["feed"])
        run = float(bed.run)
        if not 0.0 < run < ENDLESS:
            return {}
        inlet = seen.amount / seen.volume
        # to where 99 % passes
        exhausted = run * float(
            (self.adsorption_rate * bed.contact + _odds(0.99))
            / (self.adsorption_rate * bed.contact + _odds(self.breakthrough_fraction))
        )
        time = np.linspace(0.0, max(exhausted, run), 161)
        passes = breakthrough_fraction_bohart_adams.function(
            time, bed.contact, inlet, bed.loading, self.bed_density, self.adsorption_rate
        )
        drawn = drawn_along(
            Axis("time", "Time"),
            time,
            (Axis("breakthrough_fraction", "Fraction", "%"), [Curve(_("behind the bed"), passes, "LIQUID")]),
            stages=((0.0, run, float(time[-1])), (_("in use"), _("breaking through"))),
        )
        return {_("Breakthrough of a bed"): drawn}

    @abstractmethod
    def candidates(self, feed: Stream, names: list[str]) -> list[str]:
        """What may be meant where nothing is named."""

    @abstractmethod
    def fluid(self, feed: Stream) -> Fluid:
        """The fluid as the bed sees it."""

    def inside(self, feed: Stream) -> Bedded:
        seen = self.fluid(feed)
        flows = (seen.volume > 0.0) & (seen.amount > 0.0)
        volume = jnp.where(seen.volume > 0.0, seen.volume, self.area * 1e-9)
        inlet = jnp.where(flows, seen.amount / volume, 1e-9)
        velocity, contact = volume / self.area, self.area * self.bed_depth / volume
        loading = jnp.maximum(self.adsorption_isotherm(inlet), 1e-9)
        run = breakthrough_time_wheeler_jonas.function(
            contact, inlet, loading, self.bed_density, self.adsorption_rate, self.breakthrough_fraction
        )
        unsolved(~flows | (run > 0.0), type(self).card, reason=BROKEN)
        # what passes meanwhile: the logistic curve integrated up to the end of the run
        k, steep = self.adsorption_rate, self.adsorption_rate * inlet / (loading * self.bed_density)
        passed = (jax.nn.softplus(steep * run - k * contact) - jax.nn.softplus(-k * contact)) / steep
        removed = jnp.clip(1.0 - safe_divide(passed, run), 0.0, 1.0)
        front = jnp.log((1.0 - self.breakthrough_fraction) / self.breakthrough_fraction) / k
        gradient = pressure_gradient_ergun.function(
            velocity,
            self.particle_diameter,
            self.void_fraction,
            seen.density,
            seen.viscosity,
            self.sphericity,
        )
        return Bedded(
            jnp.where(seen.volume > 0.0, velocity, 0.0),
            contact,
            jnp.where(flows, loading, 0.0),
            jnp.where(flows, jnp.minimum(run, ENDLESS), ENDLESS),
            jnp.where(
                flows, jnp.clip(removed * inlet * run / (loading * self.bed_density * contact), 0, 1), 0.0
            ),
            jnp.where(flows, removed, 0.0),
            jnp.where(seen.volume > 0.0, gradient * self.bed_depth, 0.0),
            jnp.where(flows, contact / front, math.inf),
        )

    def outlets(self, inside: Bedded, feed: Stream) -> Purified:
        phase = self.PHASE.removesuffix("es") if self.PHASE == "gases" else "liquid"
        all_of_it = getattr(feed, phase)
        place = self.place(feed)
        taken = jnp.zeros_like(all_of_it).at[place].set(inside.removed * all_of_it[place])
        nothing = feed.part(solid=0.0, liquid=0.0, gas=0.0)
        product = feed.replace(**{phase: all_of_it - taken}, pressure=self.left(feed, inside))
        return Purified(*settled(feed.enthalpy_flow, product, nothing.replace(**{phase: taken})))

    def left(self, feed: Stream, inside: Bedded) -> Any:
        """Pressure behind the bed."""
        return feed.pressure

    def figures(self, inside: Bedded, outlets: Purified, feed: Stream) -> CarbonFigures:
        mass = self.bed_density * self.area * self.bed_depth
        return CarbonFigures(
            inside.velocity,
            inside.contact,
            inside.loading,
            inside.run,
            inside.use,
            mass,
            mass / jnp.maximum(inside.run, 1.0),
            inside.removed,
            inside.lost,
        )


def _odds(share: Any) -> Any:
    return np.log(share / (1.0 - share))


@equipment(
    "gas_carbon_bed",
    source=f"lodewyckx2004; {SOURCE}",
    title="Activated carbon bed for gas",
    equation=r"t = \frac{q(c)\,\rho_b}{c}\left[\tau - \frac{1}{k_v}\ln\frac{1 - x_b}{x_b}\right]",
)
class GasCarbonBed(CarbonBed):
    """Takes the vapor of a solvent out of a gas until it breaks through; beds take turns, so that flows are
    averages of a run.

    One vapor, without others that would displace it; water beyond half of saturation takes its place, which
    the check tells and the loading does not. The bed stays at the temperature of the gas: strong vapor warms
    it. Dust and mist pass. What the carbon holds leaves as it came, so that its heat of adsorption and the
    steam of a regeneration are left out. Limits recalled, not opened.
    """

    PHASE: ClassVar[str] = "gases"

    limits: ClassVar[Limits] = {
        "velocity": Limit("gas velocity through a carbon bed", 0.05, 0.5, "m/s", SOURCE),
        "warm": Limit("temperature of the gas in a carbon bed", 253.15, 328.15, "K", SOURCE),
        "depth": Limit("bed depth over that of the front", 2.0, math.inf, "dimensionless", SOURCE),
        "humid": Limit("relative humidity before a carbon bed", 0.0, 0.5, "dimensionless", SOURCE),
        "dust": Limit("solids before a carbon bed", 0.0, 2e-5, "kg/m^3", SOURCE, quiet=True),
    }
    utilities: ClassVar[Utilities] = FANNED | AREA

    def candidates(self, feed: Stream, names: list[str]) -> list[str]:
        vapors = {s.name for s in feed.mixture.liquids}
        return [name for name in names if name in vapors and name != WATER]

    def fluid(self, feed: Stream) -> Fluid:
        density = jnp.where(feed.gas_volume_flow > 0.0, feed.gas_density, 1.0)
        return Fluid(feed.gas_volume_flow, density, feed.gas_viscosity, feed.gas[self.place(feed)])

    def left(self, feed: Stream, inside: Bedded) -> Any:
        return pressure_left(feed, inside.lost, type(self).card)

    def measured(
        self, inside: Bedded, outlets: Purified, figures: CarbonFigures, feed: Stream
    ) -> dict[str, Any]:
        m, found = feed.mixture, {}
        if m.liquids and m.liquids[0].name == WATER and any(s.name == WATER for s in m.gases):
            found["humid"] = HumidMixture(m).relative_humidity(feed)
        return found | {
            "velocity": inside.velocity,
            "warm": feed.temperature,
            "depth": inside.depth,
            "dust": safe_divide(feed.solid_flow, feed.gas_volume_flow),
        }

    def drawn(
        self, inside: Bedded, outlets: Purified, figures: CarbonFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_fan": fanned(feed.gas_volume_flow, inside.lost),
            "area_installed": self.area,
        }


@equipment(
    "liquid_carbon_bed",
    source="crittenden2012, ch. 15; bohart1920",
    title="Activated carbon bed for liquid",
    equation=r"t = \frac{q(c)\,\rho_b}{c}\left[\tau - \frac{1}{k_v}\ln\frac{1 - x_b}{x_b}\right]",
)
class LiquidCarbonBed(CarbonBed):
    """Takes a dissolved substance out of a liquid until it breaks through; beds take turns, so that flows are
    averages of a run.

    One substance, without the natural organic matter that takes part of the places in water. Solids pass, and
    clog the bed sooner than the check allows. What the carbon holds leaves as it came. Limits recalled, not
    opened.
    """

    PHASE: ClassVar[str] = "liquids"

    limits: ClassVar[Limits] = {
        "velocity": Limit("filtration rate of a carbon bed", 3.0, 20.0, "m/hour", "crittenden2012, ch. 15"),
        "contact": Limit("contact time of the empty bed", 5.0, 60.0, "min", "crittenden2012, ch. 15"),
        "depth": Limit("bed depth over that of the front", 2.0, math.inf, "dimensionless", SOURCE),
        "solids": Limit(
            "solids before a carbon bed", 0.0, 0.01, "kg/m^3", "crittenden2012, ch. 15", quiet=True
        ),
    }
    utilities: ClassVar[Utilities] = PUMPED | AREA

    def candidates(self, feed: Stream, names: list[str]) -> list[str]:
        return names[1:]

    def fluid(self, feed: Stream) -> Fluid:
        volume = feed.liquid_volume_flow
        density = jnp.where(volume > 0.0, feed.liquid_density, 1000.0)
        return Fluid(volume, density, feed.liquid_viscosity, feed.liquid[self.place(feed)])

    def measured(
        self, inside: Bedded, outlets: Purified, figures: CarbonFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "velocity": 3600.0 * inside.velocity,
            "contact": inside.contact / 60.0,
            "depth": inside.depth,
            "solids": safe_divide(feed.solid_flow, feed.liquid_volume_flow),
        }

    def drawn(
        self, inside: Bedded, outlets: Purified, figures: CarbonFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "electric_power_pump": pumped(feed.slurry_volume_flow, inside.lost),
            "area_installed": self.area,
        }
