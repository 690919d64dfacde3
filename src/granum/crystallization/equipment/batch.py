"""Batch crystallizers in a line: mean flows over the cycle."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.errors import CaseError, GranumError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Distance,
    HeatTransferCoefficient,
    Length,
    Mass,
    MassFlow,
    MassRatio,
    Number,
    PositiveNumber,
    Power,
    Ratio,
    RotationSpeed,
    SpecificPower,
    Temperature,
    TemperatureDifference,
    Time,
    Velocity,
    Volume,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.beside import heard_beside, keeps_solvent, solubility_beside
from granum.crystallization.equipment.colliding import UNSOLVED_BUSY, Colliding
from granum.crystallization.equipment.heat import StreamHeat
from granum.crystallization.equipment.roles import (
    LARGEST,
    Roles,
    crystal_of,
    feed_of,
    given_off,
    refuse_boiling,
    roles,
    suspension_left,
    with_crystals,
)
from granum.crystallization.equipment.stirring import SUSPENDED, Stirred
from granum.crystallization.formulas.encrustation import wall_temperature_jacket
from granum.crystallization.inside_charts import drawn_course
from granum.crystallization.kinds import Dissolution, Growth, Nucleation, Program, Solubility, VesselVolume
from granum.crystallization.population.grid import Collisions, check_only_growing, side_by_side
from granum.crystallization.population.lagrangian import Course, Model, SuspensionVolume, march
from granum.crystallization.population.operations import Flashing, Jacketed, Operation, Programmed
from granum.crystallization.population.packets import Packets, Seeds
from granum.crystallization.vessels.batch import BUSIEST, SEED_PACKETS, narrow_seeds
from granum.crystallization.vessels.crystals import born_share
from granum.crystallization.vessels.driven import wall_undercooling
from granum.numerics.smooth import safe_divide
from granum.streams.formulas.stirring import heat_transfer_coefficient_stirred
from granum.streams.stirrers import slurry_density
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, STIRRED, cooled, heated

STEPS = 300
NARROWEST = 1e-3  # width of a sieve cut over its size, where its crystals are followed in classes
ASKED = 50  # steps after which a liquor is asked what else would crystallize from it
INSIDE = 1000.0  # W/(m² K) on the inside of a jacketed wall, where neither it nor a stirrer is given
TRICKLE = 1e-12  # kg/s of solvent, so that an empty feed gives an empty product


class BatchOutlets(NamedTuple):
    """Suspension and heat taken up, as means over the cycle."""

    product: Stream
    heat_duty: Any


class VacuumBatchOutlets(NamedTuple):
    """Suspension, vapor and heat taken up, as means over the cycle."""

    product: Stream
    vapor: Stream
    heat_duty: Any


class BatchFigures(NamedTuple):
    """Figures of a batch crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    seed_mass: Mass
    volume: Volume
    heat_duty: Power
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class JacketedBatchFigures(NamedTuple):
    """Figures of a batch crystallizer cooled through its jacket."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    seed_mass: Mass
    vessel_count: Ratio
    temperature_end: Temperature
    temperature_difference_maximum: TemperatureDifference
    undercooling_wall_maximum: TemperatureDifference
    heat_duty: Power
    heat_transfer_coefficient_inside: HeatTransferCoefficient
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class VacuumBatchFigures(NamedTuple):
    """Figures of a batch crystallizer under vacuum."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    seed_mass: Mass
    volume: Volume
    evaporation: MassFlow
    evaporation_maximum: MassFlow
    rotation_speed_suspension: RotationSpeed
    tip_speed: Velocity
    specific_power_input: SpecificPower


class Grown(NamedTuple):
    """The batch of one second of feed (everything is proportional to it), which species plays which part, and
    the seed held back.
    """

    course: Course
    found: Roles
    held: Any

    def kept(self, edges: Any) -> Any:
        """Crystals that leave, by size class, kg/s: all but the mass that is held back as seed."""
        left = jnp.maximum(self.course.crystals[-1] - self.held, 0.0)
        classes = self.course.final.in_classes(edges)
        return classes * safe_divide(left, jnp.sum(classes), 0.0)

    @property
    def evaporated(self) -> Any:
        """Solvent that has left, kg/s."""
        return self.course.solvent[0] - self.course.solvent[-1]

    @property
    def temperature(self) -> Any:
        """At the end, K."""
        return self.course.temperature[-1]

    @property
    def final(self) -> Packets:
        """Crystals at the end, seeds first."""
        return self.course.final

    @property
    def moments(self) -> Any:
        """Moments 0 to 4 of the crystals at the end."""
        return self.course.moments[-1]

    @property
    def parcels(self) -> int:
        """Parcels with seeds of their own."""
        return 1


class BatchVessel(Unit):
    """What batches share; each says how long it runs and what drives it. Without a law of dissolution,
    crystals keep in an undersaturated solution.
    """

    solubility: Solubility = eqx.field(kw_only=True)
    growth: Growth = eqx.field(kw_only=True)
    nucleation: Nucleation = eqx.field(kw_only=True)
    seed_mass_per_solvent: MassRatio = eqx.field(kw_only=True, default=0.0)
    seed_size: Length = eqx.field(kw_only=True, default=100e-6)
    seed_width: Distance = eqx.field(kw_only=True, default=0.0)
    volume_shape_factor: PositiveNumber = eqx.field(kw_only=True, default=1.0)
    dissolution: Dissolution | None = eqx.field(kw_only=True, default=None)
    solid: str = eqx.field(kw_only=True, static=True, default="")
    solvent: str = eqx.field(kw_only=True, static=True, default="")

    keeps_solvent: ClassVar[bool] = True
    """Whether all the solvent stays in the vessel."""

    limits: ClassVar[Limits] = {
        "crowded": Limit(
            "solids in the suspension by volume", 0.0, 0.35, "dimensionless", "mullin2001, ch. 9"
        ),
        "highest": Limit("highest relative supersaturation", 0.0, 0.5, "dimensionless", "mullin2001, ch. 5"),
        "largest": Limit(LARGEST, 0.0, 0.05, "dimensionless", "randolph1988, ch. 4"),
        "present": Limit(
            "crystals, or a liquor that needs none",
            1.0,
            1.0,
            "dimensionless",
            "mullin2001, ch. 5",
        ),
    }

    @property
    def collisions(self) -> Collisions | None:
        """What crystals do to each other: nothing, in a vessel that does not ask."""
        return None

    @abstractmethod
    def _time(self, feed: Stream) -> Any:
        """Time from charge to product, s."""

    def _soluble(self, feed: Stream, found: Roles) -> Any:
        """The solubility beside what else is dissolved."""
        same = feed.liquid[found.solvent] if self.keeps_solvent and keeps_solvent(found) else None
        return solubility_beside(self.solubility, feed.mixture, found, feed.liquid, solvent=same)

    def _model(self, feed: Stream, found: Roles) -> Model:
        crystal = crystal_of(feed.mixture, found, feed.temperature, self.volume_shape_factor)
        return Model(
            self._soluble(feed, found),
            self.growth,
            self.nucleation,
            crystal,
            SuspensionVolume(feed.liquid_density),
            self.dissolution,
        )

    def _seeding(self, feed: Stream, found: Roles) -> tuple[Any, Seeds]:
        """Mass of seed held back from the product, and all seeds, those that come with the feed included."""
        entering = feed_of(feed, found)
        cube = self._model(feed, found).crystal.mass_per_cube
        held, width = self.seed_mass_per_solvent * entering.solvent, self.seed_width
        if self.collisions is not None:
            width = jnp.maximum(width, NARROWEST * self.seed_size)
        added = narrow_seeds(self.seed_size, width, held, cube)
        edges = jnp.asarray(feed.mixture.edges)
        low, high = edges[:-1], edges[1:]
        number = entering.crystals / (cube * 0.25 * (low + high) * (low**2 + high**2))
        return held, Seeds(
            jnp.append(added.low, low), jnp.append(added.high, high), jnp.append(added.number, number)
        )

    def _grown(
        self,
        model: Model,
        operation: Operation,
        charge: Stream,
        found: Roles,
        solvent: Any,
        duration: Any = None,
    ) -> Grown:
        """The batch of a charge, one second of feed, with so much solvent."""
        held, seeds = self._seeding(charge, found)
        times = jnp.linspace(0.0, self._time(charge) if duration is None else duration, STEPS + 1)
        solvent = jnp.where(solvent > 0, solvent, TRICKLE)
        if self.collisions is not None:
            check_only_growing(model)
            ends = seeds.high[jnp.array([SEED_PACKETS - 1, -1])]  # of the sieve cut and of the feed's classes
            seeds = side_by_side(seeds, jnp.append(seeds.low, ends))
        course = march(model, operation, seeds, charge.liquid[found.solute], solvent, times, self.collisions)
        return Grown(course, found, held)

    def calm(self, course: Course) -> None:
        """Refuse steps in which too many crystals meet."""
        if self.collisions is not None:
            unsolved(jnp.max(course.collided) <= BUSIEST, type(self).card, reason=UNSOLVED_BUSY)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        if not float(inlets["feed"].liquid_flow) > 0.0 or np.ndim(made.inside.course.time) != 1:
            return {}
        return drawn_course(made.inside.course, self.followed())

    def followed(self) -> str:
        """What the chart over time shows, in words."""
        return _("The batch over time")

    def _product(self, inside: Grown, feed: Stream) -> tuple[Stream, Any]:
        """Suspension leaving, and the solvent that has evaporated (kg/s)."""
        found, gone = inside.found, inside.evaporated
        solid = with_crystals(feed, found, inside.kept(feed.mixture.edges))
        return suspension_left(feed, found, solid, gone, inside.temperature), gone

    def _figures(self, inside: Grown, product: Stream, feed: Stream) -> tuple[Any, ...]:
        """Crystal flow, yield, magma density, highest supersaturation, D[4,3] and mass share of nuclei."""
        course, found = inside.course, inside.found
        entering = feed_of(feed, found)
        made = product.solid_by_species[found.solid]
        fed = entering.solute + found.solute_fraction * jnp.sum(entering.crystals)
        final = inside.final
        if self.collisions is not None:  # who was a nucleus is forgotten where crystals join
            mean, share = safe_divide(inside.moments[4], inside.moments[3]), None
        else:
            mean, share = final.mean_size(4, 3), self._born(inside, feed)
        return (
            made,
            safe_divide(found.solute_fraction * made, fed),
            safe_divide(made, product.slurry_volume_flow),
            jnp.max(course.solute_per_solvent / course.solubility_per_solvent) - 1.0,
            mean,
            share,
        )

    def _born(self, inside: Grown, feed: Stream) -> Any:
        """Mass share of the crystals that were born in the vessel."""
        _mass, seeds = self._seeding(feed, inside.found)
        final = inside.final
        cubes = final.number * 0.25 * (final.low + final.high) * (final.low**2 + final.high**2)
        seeded = jnp.sum(cubes[: inside.parcels * seeds.low.shape[0]])
        return born_share(seeded, jnp.sum(cubes))

    def _cooled(self, inside: Grown, feed: Stream) -> BatchOutlets:
        """The outlets of a vessel that gives up no vapor."""
        product, _gone = self._product(inside, feed)
        return BatchOutlets(product, product.enthalpy_flow - feed.enthalpy_flow)

    def measured(self, inside: Grown, outlets: Any, figures: Any, feed: Stream) -> dict[str, Any]:
        return {
            "crowded": outlets.product.solids_volume_fraction,
            "highest": figures.relative_supersaturation_maximum,
            "largest": outlets.product.size_fractions[-1],
            "present": present(inside.course),
        }


def present(course: Any) -> Any:
    """0 where a batch ends supersaturated and without any crystals: it had no seeds, and none were born."""
    ratio, saturated, crystals = (
        row[..., -1] for row in (course.solute_per_solvent, course.solubility_per_solvent, course.crystals)
    )
    return jnp.where(jnp.all((ratio > (1.0 + 1e-6) * saturated) & (crystals <= 0.0)), 0.0, 1.0)


class ChargedVessel(BatchVessel):
    """A batch to which nothing is added on its way."""

    @abstractmethod
    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        """What drives the contents; one second of feed stands for the charge."""

    def heard(self, feed: Stream, found: Roles, course: Course) -> None:
        """Ask the solubility once more where its flags are heard: inside what is compiled they are lost."""
        self.solubility(course.temperature)
        free = course.solvent - (1.0 - found.solute_fraction) * course.crystals
        some = (course.temperature, course.solute_per_solvent, free)
        there = tuple(x[..., ::ASKED] for x in some)
        heard_beside(self.solubility, feed.mixture, found, feed.liquid, there, type(self).card)

    def inside(self, feed: Stream) -> Grown:
        found = roles(feed.mixture, self.solid, self.solvent)
        model, operation = self._model(feed, found), self._operation(feed, found, self._time(feed))
        grown = self._grown(model, operation, feed, found, feed.liquid[found.solvent])
        self.calm(grown.course)
        self.heard(feed, found, grown.course)
        return grown


class CycledVessel(Stirred, BatchVessel):
    """A batch vessel that works in cycles of batch and dead time."""

    duration: Time = eqx.field(kw_only=True)
    dead_time: Time = eqx.field(kw_only=True, default=3600.0)

    limits: ClassVar[Limits] = BatchVessel.limits | SUSPENDED

    @property
    def cycle(self) -> Any:
        """Time from charge to charge, s."""
        return self.duration + self.dead_time

    def _time(self, feed: Stream) -> Any:
        return self.duration

    def _seed(self, feed: Stream, found: Roles) -> Any:
        """Mass of seed held back in each cycle of the whole flow, kg."""
        return self.seed_mass_per_solvent * feed_of(feed, found).solvent * self.cycle

    def _vessel(self, figures: Any) -> Any:
        """Volume of one vessel, m³."""
        return figures.volume

    def measured(self, inside: Grown, outlets: Any, figures: Any, feed: Stream) -> dict[str, Any]:
        stirrer = self.stirrer_measured(outlets.product, self._vessel(figures))
        return super().measured(inside, outlets, figures, feed) | stirrer


def thermal(duty: Any, feed: Stream, product: Stream) -> dict[str, Any]:
    """Heat and cold of a vessel whose contents go from one temperature to another, by the carriers that its
    ends ask for.
    """
    hot, cold = (f(feed.temperature, product.temperature) for f in (jnp.maximum, jnp.minimum))
    return heated(duty, hot) | cooled(duty, cold)


@equipment(
    "batch_crystallizer",
    source="mullin2001, ch. 9; miller1994",
    title="Seeded batch crystallizer",
    equation=r"\dot m = m_{batch} / (t_f + t_{dead})",
)
class BatchCrystallizer(Colliding, CycledVessel, ChargedVessel):
    """Cooling batch that treats a continuous feed in cycles of batch and dead time; outlets are means over
    the cycle.

    Crystals that come with the feed are the seeds, together with ``seed_mass_per_solvent`` of a sieve cut,
    which is taken from the product (a share of the crystals is held back for the next batch, so that the line
    balances). Other salts count as in ``msmpr``. The duty is the mean one; its peak is larger. The vessel is
    as high as wide; without a ``rotation_speed`` its stirrer turns just fast enough to keep all crystals off
    the bottom. With ``agglomeration_kernel`` or ``breakage_law`` crystals meet, break or chip while they
    grow, followed in classes that move with the growth; which of them began as nuclei is then not told.
    """

    temperature_program: Program

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        return Programmed(self.temperature_program)

    def outlets(self, inside: Grown, feed: Stream) -> BatchOutlets:
        return self._cooled(inside, feed)

    def figures(self, inside: Grown, outlets: BatchOutlets, feed: Stream) -> BatchFigures:
        figures = self._figures(inside, outlets.product, feed)
        volume = outlets.product.slurry_volume_flow * self.cycle
        stirrer = self.stirrer_figures(outlets.product, volume)
        return BatchFigures._make(
            (*figures, self._seed(feed, inside.found), volume, outlets.heat_duty, *stirrer)
        )

    def drawn(
        self, inside: Grown, outlets: BatchOutlets, figures: BatchFigures, feed: Stream
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer


@equipment(
    "jacketed_batch_crystallizer",
    source="mullin2001, ch. 9; kern1950, ch. 20",
    title="Batch crystallizer cooled through a jacket",
    equation=r"\frac{dT}{dt} = \frac{U A (T_j - T) + q_c\,\dot m_c}{m c_p}",
)
class JacketedBatchCrystallizer(Colliding, CycledVessel, ChargedVessel):
    """Batch vessels of a given volume and jacket that treat a continuous feed in cycles; the temperature
    follows from the heat balance.

    The charge starts at the temperature of the feed. The wall is checked against encrustation: its
    undercooling should stay within the metastable zone width. The coefficient on its inside follows from the
    stirrer where its speed is given, and is 1000 W/(m² K) where neither is.
    """

    jacket_program: Program
    volume: VesselVolume
    area: Area
    heat_transfer_coefficient: HeatTransferCoefficient
    heat_transfer_coefficient_inside: HeatTransferCoefficient | None = None
    metastable_width: TemperatureDifference = 5.0

    limits: ClassVar[Limits] = CycledVessel.limits | {
        "crust": Limit(
            "undercooling at the cooled wall",
            -math.inf,
            "metastable_width",
            "delta_degC",
            "mullin2001, ch. 9",
        )
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        exchange = self.heat_transfer_coefficient * self.area * feed.slurry_volume_flow / self.volume
        return Jacketed(feed.temperature, self.jacket_program, exchange, StreamHeat.of(feed, found))

    def outlets(self, inside: Grown, feed: Stream) -> BatchOutlets:
        return self._cooled(inside, feed)

    def _vessel(self, figures: Any) -> Any:
        return self.volume

    def _inside_coefficient(self, found: Roles, product: Stream) -> Any:
        """Heat transfer coefficient on the inside of the wall, W/(m² K): given, or that of the stirrer."""
        if self.heat_transfer_coefficient_inside is not None:
            return self.heat_transfer_coefficient_inside
        if self.rotation_speed is None:
            return INSIDE
        made, liquid = self.stirred(product, self.volume), product.part(liquid=1.0)
        name = product.mixture.liquids[found.solvent].name
        try:
            conductivity = product.mixture.materials.fluid(name).liquid_conductivity.value(
                product.temperature
            )
        except GranumError:
            conductivity = None
        if not made.known or conductivity is None:
            raise CaseError(
                _(
                    "The heat transfer coefficient of the stirrer needs the viscosity of the liquid and the "
                    "thermal conductivity of '{solvent}': name a solvent of the library, or give "
                    "'heat_transfer_coefficient_inside'."
                ).format(solvent=name)
            )
        T = product.temperature
        heat_capacity = safe_divide(
            liquid.enthalpy_at(T + 0.5) - liquid.enthalpy_at(T - 0.5), liquid.liquid_flow, 4000.0
        )
        return heat_transfer_coefficient_stirred(
            self.rotation_speed,
            made.diameter,
            made.vessel,
            slurry_density(product),
            product.liquid_viscosity,
            heat_capacity,
            conductivity,
            self.impeller,
        )

    def figures(self, inside: Grown, outlets: BatchOutlets, feed: Stream) -> JacketedBatchFigures:
        inner = self._inside_coefficient(inside.found, outlets.product)
        figures, course = self._figures(inside, outlets.product, feed), inside.course
        T, T_j = course.temperature, self.jacket_program(course.time) + jnp.zeros_like(course.time)
        wall = wall_temperature_jacket(T, T_j, self.heat_transfer_coefficient, inner)
        found = inside.found
        soluble = self._soluble(feed, found)
        free = course.solvent - (1.0 - found.solute_fraction) * course.crystals
        cold = jnp.max(wall_undercooling(soluble, course.solute_per_solvent, wall, free))
        count = feed.slurry_volume_flow * self.cycle / self.volume
        return JacketedBatchFigures._make(
            (
                *figures,
                safe_divide(self._seed(feed, inside.found), count),
                count,
                T[-1],
                jnp.max(T - T_j),
                cold,
                outlets.heat_duty,
                jnp.asarray(inner, dtype=float),
                *self.stirrer_figures(outlets.product, self.volume),
            )
        )

    def measured(
        self, inside: Grown, outlets: BatchOutlets, figures: JacketedBatchFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {"crust": figures.undercooling_wall_maximum}

    def drawn(
        self, inside: Grown, outlets: BatchOutlets, figures: JacketedBatchFigures, feed: Stream
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, self.volume, figures.vessel_count)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer


@equipment(
    "vacuum_batch_crystallizer",
    source="mullin2001, ch. 8 and 9",
    title="Batch crystallizer cooled by boiling under vacuum",
    equation=r"L_v\,\dot m_v = -m c_p \frac{dT}{dt} + q_c\,\dot m_c",
)
class VacuumBatchCrystallizer(Colliding, CycledVessel, ChargedVessel):
    """Batch vessels that cool by boiling under falling pressure, with no cooled wall to grow a crust, for a
    continuous feed in cycles.

    The program is that of the boiling temperature; the feed flashes down to its start. Heat given back by the
    seeds that are held over is the small duty.
    """

    temperature_program: Program

    keeps_solvent: ClassVar[bool] = False

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        if found.vapor is None:
            raise CaseError(_("Evaporation needs a vapor of the solvent among the gases of the mixture."))
        heat = StreamHeat.of(feed, found)
        return Flashing(self.temperature_program, heat.latent, heat, feed.temperature)

    def outlets(self, inside: Grown, feed: Stream) -> VacuumBatchOutlets:
        course, found, _held = inside
        product, gone = self._product(inside, feed)
        assert found.vapor is not None
        released = -jnp.diff(course.solvent)
        middle = 0.5 * (course.temperature[1:] + course.temperature[:-1])
        T = jnp.where(
            gone > 0, jnp.sum(released * middle) / jnp.where(gone > 0, gone, 1.0), product.temperature
        )
        vapor = given_off(feed, found, gone, T)
        refuse_boiling(vapor.gas[found.vapor], product, feed, found, type(self).card)
        product = product.replace(gas=0.0 * feed.gas)
        return VacuumBatchOutlets(
            product, vapor, product.enthalpy_flow + vapor.enthalpy_flow - feed.enthalpy_flow
        )

    def figures(self, inside: Grown, outlets: VacuumBatchOutlets, feed: Stream) -> VacuumBatchFigures:
        figures, course = self._figures(inside, outlets.product, feed), inside.course
        # after the first flash
        fastest = jnp.max(-jnp.diff(course.solvent)[1:] / jnp.diff(course.time)[1:]) * self.cycle
        gone, volume = course.solvent[0] - course.solvent[-1], outlets.product.slurry_volume_flow * self.cycle
        stirrer = self.stirrer_figures(outlets.product, volume)
        return VacuumBatchFigures._make(
            (*figures, self._seed(feed, inside.found), volume, gone, fastest, *stirrer)
        )

    def drawn(
        self, inside: Grown, outlets: VacuumBatchOutlets, figures: VacuumBatchFigures, feed: Stream
    ) -> dict[str, Any]:
        stirrer = self.stirrer_power(outlets.product, figures.volume)
        return thermal(outlets.heat_duty, feed, outlets.product) | stirrer
