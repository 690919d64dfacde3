"""What all dust collectors share: dust and gas parted by a share of each species and size class, the pressure
that the gas loses, and the emission against its limit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import jax.numpy as jnp

from granum.core.constants import GAS_CONSTANT, STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.limits import Limit
from granum.dust.formulas.emission import emission_concentration
from granum.numerics.smooth import safe_divide
from granum.particles.formulas.slip import knudsen_number, mean_free_path, slip_factor_allen_raabe
from granum.streams.atmosphere import EXPLOSIBLE, VENTED, explosible, vented
from granum.streams.pressures import pressure_left
from granum.streams.stream import Stream
from granum.streams.units import Limits, Unit

LEAST = 1e-9
EMISSION = 20e-6  # kg/m³, dry at 0 °C and 1 atm
SOURCE = "taluft2021, no. 5.2.1"
IGNITION: Limits = (
    EXPLOSIBLE
    | VENTED
    | {  # of dust that burns
        "layer": Limit(
            "ignition temperature of a layer of dust above that of the gas",
            75.0,
            math.inf,
            "delta_degC",
            "en60079_14_2014, § 5.6",
        ),
    }
)


class Cleaned(NamedTuple):
    """Gas with what escapes, and the dust collected."""

    gas: Stream
    dust: Stream


class Seen(NamedTuple):
    """The gas as a collector sees it: m³/s, kg/m³, Pa s; size and density of each species and class."""

    volume_flow: Any
    density: Any
    viscosity: Any
    size: Any
    particle_density: Any


def seen(feed: Stream) -> Seen:
    """Numbers of a stream that may be without gas or dust."""
    m, volume = feed.mixture, feed.gas_volume_flow
    density = jnp.where(volume > 0.0, safe_divide(feed.gas_flow, volume), LEAST)
    each = m.densities("solids", feed.temperature)[:, None] + 0.0 * jnp.asarray(m.sizes)
    return Seen(volume, density, feed.gas_viscosity, jnp.asarray(m.sizes) + 0.0 * each, each)


def slip(gas: Seen, feed: Stream) -> Any:
    """Cunningham's slip correction of each species and class."""
    moles = sum((feed.gas[i] / s.molar_mass for i, s in enumerate(feed.mixture.gases)), jnp.zeros(()))
    molar_mass = safe_divide(feed.gas_flow, moles, otherwise=feed.mixture.gases[0].molar_mass)
    path = mean_free_path.function(feed.temperature, feed.pressure, gas.viscosity, molar_mass)
    return slip_factor_allen_raabe.function(knudsen_number.function(gas.size, path))


def over_axes(share: Any, feed: Stream) -> Any:
    """A matrix over species and sizes shaped to multiply ``solid``."""
    return share.reshape(share.shape + (1,) * len(feed.mixture.axes))


def dry_normal_flow(gas: Stream) -> Any:
    """Volume of the gas without its vapors at 0 °C and 1 atm, m³/s: what is a liquid of the mixture too is a
    vapor.
    """
    liquids = {liquid.name for liquid in gas.mixture.liquids}
    moles = sum(
        (gas.gas[i] / s.molar_mass for i, s in enumerate(gas.mixture.gases) if s.name not in liquids),
        jnp.zeros(()),
    )
    return moles * GAS_CONSTANT * ZERO_CELSIUS / STANDARD_ATMOSPHERE


class Collector(Unit):
    """Abstract dust collector, whose emission has a limit."""

    if TYPE_CHECKING:  # fields of every collector, which a dataclass would put first if they stood here

        @property
        def emission_limit(self) -> Any: ...

        @property
        def oxygen_fraction(self) -> Any: ...

        @property
        def oxygen_reference(self) -> Any: ...

    limits: ClassVar[Limits] = {
        "emission": Limit("emission of dust over its limit", 0.0, 1.0, "dimensionless", SOURCE)
    }

    def emission(self, gas: Stream) -> Any:
        """Dust in the cleaned gas, kg/m³ as permits state it; zero without gas."""
        flow = dry_normal_flow(gas)
        found = emission_concentration(
            gas.solid_flow, jnp.maximum(flow, LEAST), self.oxygen_fraction, self.oxygen_reference
        )
        return jnp.where(flow > 0.0, found, 0.0)

    def over_limit(self, emission: Any) -> Any:
        """Emission over its limit; of a limit of nothing a large number."""
        return emission / jnp.maximum(self.emission_limit, 1e-15)

    def ignition(
        self,
        feed: Stream,
        explosible_concentration: Any,
        layer_ignition_temperature: Any,
        vent: Any = None,
    ) -> dict[str, Any]:
        """What is measured of dust that burns, as far as its data are known: of the sample where they are
        given, else of the library; and of the vent of its vessel.
        """
        found = explosible(feed) | vented(feed, vent)
        if explosible_concentration is not None:
            dust = safe_divide(feed.solid_flow, feed.gas_volume_flow)
            found["explosible"] = dust / jnp.maximum(explosible_concentration, 1e-15)
        if layer_ignition_temperature is not None:
            found["layer"] = layer_ignition_temperature - feed.temperature
        return found

    def parted(self, feed: Stream, share: Any, pressure_drop: Any) -> Cleaned:
        """Gas and dust; liquid travels with the dust."""
        share = over_axes(share, feed)
        total = jnp.where(
            feed.solid_flow > 0.0, safe_divide(jnp.sum(feed.solid * share), feed.solid_flow), 0.0
        )
        dust = feed.part(solid=share, liquid=total)
        gas = feed.replace(solid=feed.solid - dust.solid, liquid=feed.liquid - dust.liquid)
        return Cleaned(gas.replace(pressure=pressure_left(feed, pressure_drop, type(self).card)), dust)
