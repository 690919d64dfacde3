"""Mesh pad: mist, and dust that is coarse enough, caught by knitted wire."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np

from granum.core import equipment
from granum.core.i18n import _
from granum.core.kinds import (
    Area,
    Concentration,
    Fraction,
    Length,
    MassFlow,
    MoleFraction,
    PressureDrop,
    SpecificSurface,
    Speed,
    VoidFraction,
)
from granum.core.limits import Limit
from granum.dust.equipment.collector import EMISSION, Collector, over_axes, seen, slip
from granum.dust.formulas.scrubbers import grade_efficiency_mesh, impaction_number, target_efficiency_wire
from granum.numerics.smooth import safe_divide
from granum.streams.inside_charts import Mark, drawn_grade
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Utilities
from granum.streams.utilities import FANNED, fanned

FRICTION = 0.3  # of the gas along the wires of a dry pad
SLOWEST = 1e-3  # m/s
DROPS = np.geomspace(0.5e-6, 50e-6, 81)  # m, of the curve that is drawn
WATER = 1000.0  # kg/m³, of mist where the mixture has no liquid


class Demisted(NamedTuple):
    """Gas with what escapes, and what drains from the pad."""

    gas: Stream
    drained: Stream


class MeshFigures(NamedTuple):
    """Figures of a mesh pad."""

    superficial_velocity: Speed
    load_factor: Speed
    pressure_drop: PressureDrop
    mass_flow_drained: MassFlow
    removal_efficiency: Fraction
    emission_concentration: Concentration


class Meshed(NamedTuple):
    """Gas velocity, load factor, pressure lost, share caught of the mist and of each species and class."""

    velocity: Any
    load: Any
    lost: Any
    mist: Any
    share: Any


@equipment(
    "mesh_pad",
    source="carpenter1955; landahl1949; york1954; perry2008, ch. 14",
    title="Mesh pad (demister)",
    equation=(
        r"E = 1 - \exp\left(-\frac{2}{3\pi}\,a\,L\,\eta_d\right),\ "
        r"k = U\sqrt{\frac{\rho_g}{\rho_l - \rho_g}},\ \Delta p = f\,a\,L\,\frac{\rho_g\,U^2}{\varepsilon^3}"
    ),
)
class MeshPad(Collector):
    """The liquid in the gas is mist of one drop size, caught by wires that it runs into; dust is caught the
    same way, by its own size.

    Too fast gas tears drops off the pad again, too slow gas carries them around the wires: the load factor
    says so. Dust that does not dissolve plugs a pad. The drained liquid has the temperature of the gas.
    Limits recalled, not opened.
    """

    area: Area
    droplet_diameter: Length = 1e-5
    thickness: Length = 0.15
    wire_diameter: Length = 2.8e-4
    mesh_surface: SpecificSurface = 280.0
    void_fraction: VoidFraction = 0.98
    emission_limit: Concentration = EMISSION
    oxygen_fraction: MoleFraction | None = None
    oxygen_reference: MoleFraction | None = None

    limits: ClassVar[Limits] = Collector.limits | {
        "load": Limit("load factor of the gas in a mesh pad", 0.03, 0.107, "m/s", "perry2008, ch. 14"),
        "drop": Limit("pressure drop of a mesh pad", 0.0, 500.0, "Pa", "york1954"),
    }

    utilities: ClassVar[Utilities] = FANNED

    def inside(self, feed: Stream) -> Meshed:
        gas = seen(feed)
        velocity = jnp.maximum(gas.volume_flow / self.area, SLOWEST)
        heavy = self.heavy(feed)
        return Meshed(
            velocity,
            velocity * jnp.sqrt(gas.density / (heavy - gas.density)),
            FRICTION * self.mesh_surface * self.thickness * gas.density * velocity**2 / self.void_fraction**3,
            self.caught(feed, velocity, self.droplet_diameter, heavy, 1.0),
            self.caught(feed, velocity, gas.size, gas.particle_density, slip(gas, feed)),
        )

    def heavy(self, feed: Stream) -> Any:
        """Density of the mist, kg/m³."""
        liquid = feed.liquid_density if feed.mixture.liquids else WATER
        return jnp.maximum(liquid, 2.0 * seen(feed).density)

    def caught(self, feed: Stream, velocity: Any, size: Any, density: Any, slipping: Any) -> Any:
        """Share of a size caught by the whole pad."""
        drag = (velocity, feed.gas_viscosity, self.wire_diameter)
        target = target_efficiency_wire(impaction_number(size, density, *drag, slipping))
        return grade_efficiency_mesh(target, self.mesh_surface, self.thickness)

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        feed, inside = inlets["feed"], made.inside
        if not float(feed.gas_flow) > 0.0:
            return {}
        mist = self.caught(feed, inside.velocity, jnp.asarray(DROPS), self.heavy(feed), 1.0)
        works = Mark(_("the mist here"), self.droplet_diameter, inside.mist)
        drawn = drawn_grade(DROPS, mist, marks=[works], across="droplet_diameter")
        return {_("Drops that the pad catches"): drawn}

    def outlets(self, inside: Meshed, feed: Stream) -> Demisted:
        drained = feed.part(solid=over_axes(inside.share, feed), liquid=inside.mist)
        gas = feed.replace(solid=feed.solid - drained.solid, liquid=feed.liquid - drained.liquid)
        return Demisted(gas.replace(pressure=pressure_left(feed, inside.lost, type(self).card)), drained)

    def figures(self, inside: Meshed, outlets: Demisted, feed: Stream) -> MeshFigures:
        carried = feed.solid_flow + feed.liquid_flow
        return MeshFigures(
            inside.velocity,
            inside.load,
            inside.lost,
            outlets.drained.mass_flow,
            safe_divide(outlets.drained.mass_flow, carried),
            self.emission(outlets.gas),
        )

    def measured(
        self, inside: Meshed, outlets: Demisted, figures: MeshFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "emission": self.over_limit(figures.emission_concentration),
            "load": inside.load,
            "drop": inside.lost,
        }

    def drawn(self, inside: Meshed, outlets: Demisted, figures: MeshFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_fan": fanned(feed.gas_volume_flow, inside.lost)}
