"""Atomizers of a spray dryer, as laws that give mean drop size and launch speed from the feed."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import law
from granum.core.kinds import Length, MassRatio, PositiveNumber, PressureDifference, Speed, TurningSpeed
from granum.drying.formulas.atomizers import (
    droplet_diameter_elkotb,
    droplet_diameter_friedman,
    droplet_diameter_nukiyama_tanasawa,
)
from granum.streams.formulas.drives import shaft_power_incompressible
from granum.streams.utilities import COMPRESSOR, PUMP

NOZZLE_COEFFICIENT = 0.9  # of the speed of the jet


class Liquor(NamedTuple):
    """The feed as an atomizer meets it."""

    mass_flow: Any
    density: Any
    viscosity: Any
    surface_tension: Any
    gas_density: Any


class AbstractAtomizer(eqx.Module):
    """Breaks a feed into drops."""

    @abstractmethod
    def sauter(self, feed: Liquor) -> Any:
        """Sauter mean diameter of the drops, m."""

    @abstractmethod
    def launch(self, feed: Liquor) -> Any:
        """Speed of the drops along the chamber when they leave, m/s."""

    def shaft_power(self, feed: Liquor) -> Any:
        """Power that breaks up the feed, W; unknown, and left out, of drops that are given."""
        return 0.0 * feed.mass_flow

    def __call__(self, density: PositiveNumber = 1100.0) -> Length:
        return self.sauter(Liquor(0.1, density, 0.01, 0.06, 1.0))


@law("atomizer", name="atomizer_pressure_nozzle", source="elkotb1982; masters1991", title="Pressure nozzle")
class PressureNozzle(AbstractAtomizer):
    """Feed under pressure through a nozzle, drops after Elkotb.

    >>> round(float(PressureNozzle("10 MPa")()) * 1e6)
    128
    """

    pressure_difference: PressureDifference

    def sauter(self, feed: Liquor) -> Any:
        return droplet_diameter_elkotb.function(
            self.pressure_difference, feed.density, feed.viscosity, feed.surface_tension, feed.gas_density
        )

    def launch(self, feed: Liquor) -> Any:
        return NOZZLE_COEFFICIENT * jnp.sqrt(2.0 * self.pressure_difference / feed.density)

    def shaft_power(self, feed: Liquor) -> Any:
        """Of the pump."""
        volume = feed.mass_flow / feed.density
        return shaft_power_incompressible.function(volume, self.pressure_difference, PUMP)


@law("atomizer", name="atomizer_wheel", source="friedman1952; masters1991", title="Atomizer wheel")
class Wheel(AbstractAtomizer):
    """Vaned wheel, drops after Friedman, Gluckert and Marshall; they fly off sideways and take up the speed
    of the gas.

    >>> round(float(Wheel("15000 rpm", 0.2, 0.02)()) * 1e6)
    142
    """

    rotation_speed: TurningSpeed
    diameter: Length
    vane_height: Length
    vane_count: PositiveNumber = 24.0

    def sauter(self, feed: Liquor) -> Any:
        return droplet_diameter_friedman.function(
            feed.mass_flow,
            self.rotation_speed,
            self.diameter,
            self.vane_height,
            feed.density,
            feed.viscosity,
            feed.surface_tension,
            self.vane_count,
        )

    def launch(self, feed: Liquor) -> Any:
        # what little of the tip speed points along the chamber
        return 0.01 * self.rotation_speed * 0.5 * self.diameter

    def shaft_power(self, feed: Liquor) -> Any:
        """What brings the feed to the speed of the rim and lets it go there."""
        return feed.mass_flow * (0.5 * self.rotation_speed * self.diameter) ** 2


@law(
    "atomizer",
    name="atomizer_two_fluid",
    source="nukiyama1939; masters1991; perry2008, ch. 14",
    fitted={"density": (700.0, 1200.0)},
    title="Two-fluid nozzle",
)
class TwoFluidNozzle(AbstractAtomizer):
    """Feed torn off by fast gas, drops after Nukiyama and Tanasawa; mass of atomizing gas per mass of feed.

    The densities are those of ``droplet_diameter_nukiyama_tanasawa``.

    >>> 20 < float(TwoFluidNozzle(200.0, 2.0)()) * 1e6 < 60
    True
    """

    relative_velocity: Speed
    gas_per_feed: MassRatio = 1.0

    def sauter(self, feed: Liquor) -> Any:
        ratio = feed.gas_density / (feed.density * self.gas_per_feed)
        return droplet_diameter_nukiyama_tanasawa.function(
            self.relative_velocity, ratio, feed.density, feed.viscosity, feed.surface_tension
        )

    def launch(self, feed: Liquor) -> Any:
        return 0.5 * self.relative_velocity * self.gas_per_feed / (1.0 + self.gas_per_feed)

    def shaft_power(self, feed: Liquor) -> Any:
        """Of the compressor that gives the gas its speed."""
        return self.gas_per_feed * feed.mass_flow * 0.5 * self.relative_velocity**2 / COMPRESSOR


@law("atomizer", name="atomizer_given", source="masters1991", title="Atomizer of known drop size")
class GivenDrops(AbstractAtomizer):
    """Drops of a measured Sauter mean diameter and launch speed.

    >>> float(GivenDrops("80 um")()) * 1e6
    80.0
    """

    droplet_diameter: Length
    launch_speed: Speed = 10.0

    def sauter(self, feed: Liquor) -> Any:
        return self.droplet_diameter + 0.0 * feed.density

    def launch(self, feed: Liquor) -> Any:
        return self.launch_speed
