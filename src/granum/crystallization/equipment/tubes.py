"""Tubular crystallizers in a line: each parcel of the feed lives the batch of its residence time."""

from __future__ import annotations

import math
from abc import abstractmethod
from typing import Annotated, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.i18n import _
from granum.core.kinds import (
    Concentration,
    Distance,
    Fraction,
    Frequency,
    Length,
    MassFlow,
    Number,
    PositiveNumber,
    Power,
    PressureDrop,
    Ratio,
    SpecificPower,
    SurfaceTension,
    Time,
    Velocity,
    VolumeFlow,
    Within,
)
from granum.core.limits import Limit
from granum.crystallization.equipment.batch import (
    BatchOutlets,
    BatchVessel,
    ChargedVessel,
    Grown,
    thermal,
)
from granum.crystallization.equipment.colliding import Colliding
from granum.crystallization.equipment.roles import Roles, roles
from granum.crystallization.formulas.slugs import SlugFlow, slug_flow
from granum.crystallization.formulas.tubes import OrificeArea, oscillatory_flow, oscillatory_loss
from granum.crystallization.kinds import Program, VesselVolume
from granum.crystallization.population.lagrangian import Course
from granum.crystallization.population.operations import Operation, Programmed
from granum.crystallization.population.packets import Packets
from granum.numerics.smooth import safe_divide
from granum.streams.stirrers import slurry_density
from granum.streams.stream import Stream
from granum.streams.units import Limits, Utilities
from granum.streams.utilities import COOLED, HEATED, PUMPED, STIRRED, pumped

PARCELS = 5
FEWEST_TANKS = 3.0  # below which the cube root of a stay is no longer near normal


class PlugFlowFigures(NamedTuple):
    """Figures of a plug flow crystallizer."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    residence_time: Time
    heat_duty: Power


class Passed(eqx.Module):
    """A program of the place in the tube, for a parcel that passes it in a multiple of the mean time."""

    program: Any
    stay: Any

    def __call__(self, time: Any) -> Any:
        return self.program(time / self.stay)


class Spread(NamedTuple):
    """Parcels of different stays, their shares of the feed, which species plays which part, and the seed held
    back; it answers for all together what ``Grown`` answers for one.
    """

    course: Course
    shares: Any
    found: Roles
    held: Any

    def kept(self, edges: Any) -> Any:
        """Crystals that leave, by size class, kg/s."""
        one = jax.vmap(lambda course: Grown(course, self.found, self.held).kept(edges))
        return self.shares @ one(self.course)

    @property
    def evaporated(self) -> Any:
        """Nothing leaves a tube as vapor."""
        return jnp.zeros(())

    @property
    def temperature(self) -> Any:
        """At the outlet, K, the same for all parcels."""
        return self.course.temperature[0, -1]

    @property
    def final(self) -> Packets:
        """Crystals of all parcels, the seeds of all first."""
        low, high, number = self.course.final.low, self.course.final.high, self.course.final.number
        low, high, number = (jnp.ravel(v.T) for v in (low, high, self.shares[:, None] * number))
        return Packets(low, high, number)

    @property
    def moments(self) -> Any:
        """Moments 0 to 4 of the crystals of all parcels at the end."""
        return self.shares @ self.course.moments[:, -1]

    @property
    def parcels(self) -> int:
        """Parcels with seeds of their own."""
        return PARCELS


def stays(tanks: Any) -> tuple[Any, Any]:
    """Stays over the mean one and their shares: the gamma distribution of tanks in series by the cube of a
    normal variate (Wilson and Hilferty 1931), in Gauss and Hermite's points.
    """
    x, w = np.polynomial.hermite_e.hermegauss(PARCELS)
    w = w / w.sum()
    t = (1.0 - 1.0 / (9.0 * tanks) + x / (3.0 * jnp.sqrt(tanks))) ** 3
    return t / jnp.sum(w * t), jnp.asarray(w)


class Tube(Colliding, ChargedVessel):
    """A tube along which the temperature follows a program of the time since the inlet."""

    temperature_program: Program
    tank_number_tube: Annotated[PositiveNumber, Within(FEWEST_TANKS, 1e6)] | None = eqx.field(
        kw_only=True, default=None
    )

    @abstractmethod
    def _held(self, feed: Stream) -> Any:
        """Volume of the suspension in the tube, m³."""

    def _time(self, feed: Stream) -> Any:
        return safe_divide(self._held(feed), feed.slurry_volume_flow)

    def followed(self) -> str:
        return _("A parcel on its way through the tube")

    def _operation(self, feed: Stream, found: Roles, duration: Any) -> Operation:
        return Programmed(self.temperature_program)

    def inside(self, feed: Stream) -> Any:
        if self.tank_number_tube is None:
            return super().inside(feed)
        found, mean = roles(feed.mixture, self.solid, self.solvent), self._time(feed)
        model, solvent = self._model(feed, found), feed.liquid[found.solvent]

        def parcel(stay: Any) -> Course:
            operation = Programmed(Passed(self.temperature_program, stay))
            return self._grown(model, operation, feed, found, solvent, stay * mean).course

        times, shares = stays(jnp.asarray(self.tank_number_tube, dtype=float))
        course = jax.vmap(parcel)(times)
        self.calm(course)
        self.heard(feed, found, course)
        held, _seeds = self._seeding(feed, found)
        return Spread(course, shares, found, held)

    def outlets(self, inside: Any, feed: Stream) -> BatchOutlets:
        return self._cooled(inside, feed)


@equipment(
    "plug_flow_crystallizer",
    source="randolph1988, ch. 7; mullin2001, ch. 9; wilson1931",
    title="Plug flow crystallizer",
    equation=r"G\,\frac{\partial n}{\partial L} + \frac{\dot V}{A}\frac{\partial n}{\partial z} = 0",
)
class PlugFlowCrystallizer(Tube):
    """Tubular crystallizer in steady plug flow: every parcel of the feed lives the batch of its residence
    time.

    The temperature along the tube is given by a program of the time since the inlet, which should end at the
    residence time. Backmixing spreads the stays: with ``tank_number_tube`` they are those of so many mixed
    tanks in series (half the Péclet number of axial dispersion, nearly), each parcel on its own, slower or
    faster past the same temperatures; a cascade of a few mixed vessels shares its liquor, which parcels do
    not. Crystals that meet, break or chip are followed as in ``batch_crystallizer``.
    """

    volume: VesselVolume

    utilities: ClassVar[Utilities] = HEATED | COOLED

    def _held(self, feed: Stream) -> Any:
        return self.volume

    def figures(self, inside: Any, outlets: BatchOutlets, feed: Stream) -> PlugFlowFigures:
        figures = self._figures(inside, outlets.product, feed)
        return PlugFlowFigures._make((*figures, self._time(feed), outlets.heat_duty))

    def drawn(
        self, inside: Any, outlets: BatchOutlets, figures: PlugFlowFigures, feed: Stream
    ) -> dict[str, Any]:
        return thermal(outlets.heat_duty, feed, outlets.product)


class BaffledTubeFigures(NamedTuple):
    """Figures of a baffled tube with oscillation."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    residence_time: Time
    heat_duty: Power
    reynolds_oscillatory: Ratio
    reynolds: Ratio
    velocity_ratio_oscillatory: Ratio
    strouhal: Ratio
    specific_power_input: SpecificPower
    pressure_drop: PressureDrop
    pressure_amplitude_friction: PressureDrop
    pressure_amplitude_inertia: PressureDrop


@equipment(
    "baffled_tube_crystallizer",
    source="ni1997; stonestreet1999; jealous1955; randolph1988, ch. 7; wilson1931",
    title="Oscillatory baffled tube crystallizer",
    equation=r"\psi = \frac{2\pi f x_0}{U},\quad "
    r"\varepsilon = \frac{1/S^2 - 1}{2 C_d^2\,l}\,\overline{|U + 2\pi f x_0 \sin 2\pi f t|^3}",
)
class BaffledTubeCrystallizer(Tube):
    """Plug flow crystallizer whose suspension a piston moves to and fro through orifice baffles, so that a
    slow flow is mixed across and hardly along the tube.

    The temperature along the tube is given by a program of the time since the inlet. Crystals are those of
    plug flow, which holds where the oscillation is two to four times as fast as the net flow; the checks tell
    where it is not, and where it is too weak to fill the cells with vortices. The power is what the baffles
    take and becomes heat, which is small and left out. The kinetics must be those of this mixing: a baffled
    tube strikes crystals less than a stirrer. They agglomerate and break by the laws that are given, as in
    ``batch_crystallizer``; the laws take the shear and power that they are given, not those of the baffles.
    ``tank_number_tube`` spreads the stays as in ``plug_flow_crystallizer``.
    """

    diameter: Length
    length: Length
    oscillation_frequency: Frequency
    oscillation_amplitude: Length
    baffle_spacing: Length
    baffle_open_area: OrificeArea = eqx.field(kw_only=True, default=0.25)

    limits: ClassVar[Limits] = BatchVessel.limits | {
        "vortices": Limit(
            "oscillatory Reynolds number", 100.0, math.inf, "dimensionless", "ni1997; stonestreet1999"
        ),
        "ratio": Limit(
            "oscillation over net flow, by velocity", 2.0, 4.0, "dimensionless", "stonestreet1999"
        ),
    }

    utilities: ClassVar[Utilities] = STIRRED | HEATED | COOLED

    def _held(self, feed: Stream) -> Any:
        return 0.25 * jnp.pi * self.diameter**2 * self.length

    def figures(self, inside: Any, outlets: BatchOutlets, feed: Stream) -> BaffledTubeFigures:
        product = outlets.product
        velocity = feed.slurry_volume_flow / (0.25 * jnp.pi * self.diameter**2)
        density = slurry_density(product)
        stroke = (self.oscillation_frequency, self.oscillation_amplitude)
        groups = oscillatory_flow(*stroke, self.diameter, velocity, density, product.liquid_viscosity)
        loss = oscillatory_loss(
            *stroke, velocity, density, self.length, self.baffle_spacing, self.baffle_open_area
        )
        crystals = self._figures(inside, product, feed)
        return BaffledTubeFigures._make((*crystals, self._time(feed), outlets.heat_duty, *groups, *loss))

    def measured(
        self, inside: Any, outlets: BatchOutlets, figures: BaffledTubeFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {
            "vortices": figures.reynolds_oscillatory,
            "ratio": figures.velocity_ratio_oscillatory,
        }

    def drawn(
        self, inside: Any, outlets: BatchOutlets, figures: BaffledTubeFigures, feed: Stream
    ) -> dict[str, Any]:
        mass = self._held(feed) * slurry_density(outlets.product)
        moved = {"electric_power_agitator": figures.specific_power_input * mass}
        return thermal(outlets.heat_duty, feed, outlets.product) | moved


class SlugTubeFigures(NamedTuple):
    """Figures of a tube with slugs."""

    crystal_flow: MassFlow
    yield_fraction: Ratio
    magma_density: Concentration
    relative_supersaturation_maximum: Number
    mean_diameter_mass: Distance
    nuclei_mass_fraction: Ratio | None
    residence_time: Time
    heat_duty: Power
    velocity_bubble: Velocity
    film_thickness_slug: Length
    gas_fraction_slug: Fraction
    bubble_length: Length
    slug_frequency: Frequency
    capillary_number_slug: Ratio
    eotvos_number: Ratio
    reynolds: Ratio
    pressure_drop: PressureDrop


@equipment(
    "slug_flow_crystallizer",
    source="jiang2014; aussillous2000; kreutzer2005; wilson1931",
    title="Slug-flow tube crystallizer",
    equation=r"\tau = \frac{A L\,(1-\varepsilon)}{\dot V_L},\quad \varepsilon = \frac{\dot V_G}{A\,U_b}",
)
class SlugFlowCrystallizer(Tube):
    """Plug flow crystallizer of a narrow tube in which bubbles of gas part the suspension into slugs, each
    one a small vessel stirred by its own circulation.

    The temperature along the tube is given by a program of the time since the inlet. Gas and liquid meet at
    the inlet and slugs form by themselves; their length is measured, or chosen where the gas comes in pulses.
    The flow of the gas is that at the pressure of the tube, in which it takes up neither heat nor vapor. The
    stay is that of the liquid, which the gas shortens. The kinetics must be those of this gentle mixing,
    a kernel and a law of breakage too, where crystals meet or break.
    What the film at the wall passes from slug to slug is left out, or spread by ``tank_number_tube`` as in
    ``plug_flow_crystallizer``. Above an Eötvös number of about 3.4 bubbles rise in the liquid.
    """

    diameter: Length
    length: Length
    gas_volume_flow: VolumeFlow
    slug_length: Length
    surface_tension: SurfaceTension = eqx.field(kw_only=True, default=0.072)

    limits: ClassVar[Limits] = BatchVessel.limits | {
        "held": Limit("Eötvös number of the tube", 0.0, 3.37, "dimensionless", "bretherton1961"),
        "film": Limit("capillary number of the bubbles", 0.0, 1.4, "dimensionless", "aussillous2000"),
    }

    utilities: ClassVar[Utilities] = PUMPED | HEATED | COOLED

    def _flow(self, feed: Stream) -> SlugFlow:
        """Of the feed and the gas."""
        area = 0.25 * jnp.pi * self.diameter**2
        return slug_flow(
            feed.slurry_volume_flow / area,
            self.gas_volume_flow / area,
            self.diameter,
            self.length,
            self.slug_length,
            slurry_density(feed),
            feed.liquid_viscosity,
            self.surface_tension,
        )

    def _held(self, feed: Stream) -> Any:
        gas = self._flow(feed).gas_fraction_slug
        return 0.25 * jnp.pi * self.diameter**2 * self.length * (1.0 - gas)

    def figures(self, inside: Any, outlets: BatchOutlets, feed: Stream) -> SlugTubeFigures:
        crystals = self._figures(inside, outlets.product, feed)
        flow = self._flow(feed)
        return SlugTubeFigures._make((*crystals, self._time(feed), outlets.heat_duty, *flow))

    def measured(
        self, inside: Any, outlets: BatchOutlets, figures: SlugTubeFigures, feed: Stream
    ) -> dict[str, Any]:
        return super().measured(inside, outlets, figures, feed) | {
            "held": figures.eotvos_number,
            "film": figures.capillary_number_slug,
        }

    def drawn(
        self, inside: Any, outlets: BatchOutlets, figures: SlugTubeFigures, feed: Stream
    ) -> dict[str, Any]:
        moved = {"electric_power_pump": pumped(feed.slurry_volume_flow, figures.pressure_drop)}
        return thermal(outlets.heat_duty, feed, outlets.product) | moved
