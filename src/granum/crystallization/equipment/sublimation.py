"""Sublimation with a carrier gas or in a vacuum: a vaporizer whose solids go to vapor, and a condenser where
vapors become solid again.
"""

from __future__ import annotations

from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp

from granum.core import equipment
from granum.core.errors import CaseError
from granum.core.i18n import _
from granum.core.kinds import Fraction, Length, MassFlow, PositiveNumber, Power, Ratio, Temperature
from granum.core.limits import Limit
from granum.crystallization.equipment.roles import LARGEST, Roles, with_crystals
from granum.crystallization.formulas.sublimation import vapors_held
from granum.crystallization.kinds import GasPressure, Saturated
from granum.numerics.smooth import safe_divide
from granum.particles.size_laws import LogNormal
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, empty
from granum.streams.units import Limits, Unit, Utilities
from granum.streams.utilities import COOLED, HEATED, cooled, heated

SOURCE = "mullin2001, ch. 8; richardson2002, ch. 15"


class Volatile(NamedTuple):
    """A solid that sublimes, its vapor and its law: places among solids and gases, material."""

    solid: int
    gas: int
    material: Any


class Sublimed(NamedTuple):
    """Which solids sublime, and how much of each is vapor behind the apparatus, kg/s."""

    volatile: list[Volatile]
    vapors: Any


def volatile(mixture: Mixture) -> list[Volatile]:
    """The solids of a mixture whose vapor is among its gases."""
    gases = [g.name for g in mixture.gases]
    found = [
        Volatile(i, gases.index(s.name), mixture.materials.solid(s.name))
        for i, s in enumerate(mixture.solids)
        if s.name in gases
        and s.name in mixture.materials.names("solid")
        and mixture.materials.solid(s.name).sublimes
    ]
    if not found:
        raise CaseError(
            _(
                "No solid of the mixture sublimes: one is needed whose 'sublimation_pressure' is known and "
                "whose name stands among the gases too, such as naphthalene."
            )
        )
    return found


def _saturation(found: list[Volatile], temperature: Any, pressure: Any) -> Any:
    """Pressure of each vapor at saturation over that of the gas."""
    T = jnp.asarray(temperature, dtype=float)
    return jnp.stack([v.material.sublimation_pressure(T) for v in found]) / pressure


def _vapors(found: list[Volatile], feed: Stream, offered: Any, shares: Any) -> Any:
    """Mass of each vapor that the gas of a feed holds where so much is offered, kg/s."""
    gases = feed.mixture.gases
    masses = jnp.asarray([gases[v.gas].molar_mass for v in found])
    places = [v.gas for v in found]
    others = sum(feed.gas[k] / g.molar_mass for k, g in enumerate(gases) if k not in places)
    return vapors_held(jnp.asarray(others, dtype=float), offered / masses, shares) * masses


class SublimerFigures(NamedTuple):
    """Figures of a sublimation vaporizer."""

    sublimed_flow: MassFlow
    sublimed_share: Ratio
    vapor_flow: MassFlow
    heat_duty: Power


class SublimerOutlets(NamedTuple):
    """Gas with the vapors, solids that are left, and the heat taken up."""

    vapor: Stream
    residue: Stream
    heat_duty: Any


@equipment(
    "sublimer",
    source=SOURCE,
    title="Sublimation vaporizer",
    equation=r"\dot n_i = \min\left(\dot n_{i,0},\ \varphi\,\frac{p_i(T)}{P}\,\sum_j \dot n_j\right)",
)
class Sublimer(Unit):
    """Solids go to vapor at a temperature, into a carrier gas that they saturate or, where their vapor has
    the pressure of the vessel, without one (vacuum).

    Every solid of the mixture whose vapor is among its gases sublimes as if it were alone: solids that do not
    mix with each other. What is left keeps its sizes; liquid stays with it, and vapor is never caught here.
    Without a pressure that of the gas is kept.
    """

    temperature: Temperature
    pressure: GasPressure | None = None
    vapor_saturation: Saturated = 1.0

    limits: ClassVar[Limits] = {
        "vapor": Limit("share of the volatile solids that goes to vapor", 0.5, 1.0, "dimensionless", SOURCE)
    }
    utilities: ClassVar[Utilities] = HEATED | COOLED

    def _pressure(self, feed: Stream) -> Any:
        return feed.pressure if self.pressure is None else jnp.asarray(self.pressure, dtype=float)

    def inside(self, feed: Stream) -> Sublimed:
        found = volatile(feed.mixture)
        by_species = feed.solid_by_species
        here = jnp.stack([feed.gas[v.gas] for v in found])
        offered = jnp.stack([by_species[v.solid] for v in found]) + here
        shares = self.vapor_saturation * _saturation(found, self.temperature, self._pressure(feed))
        return Sublimed(found, jnp.maximum(_vapors(found, feed, offered, shares), here))

    def outlets(self, inside: Sublimed, feed: Stream) -> SublimerOutlets:
        T, solid, gas = jnp.asarray(self.temperature, dtype=float), feed.solid, feed.gas
        by_species = feed.solid_by_species
        for v, held in zip(inside.volatile, inside.vapors, strict=True):
            gone = jnp.clip(held - gas[v.gas], 0.0, by_species[v.solid])
            solid = solid.at[v.solid].multiply(1.0 - safe_divide(gone, by_species[v.solid], 0.0))
            gas = gas.at[v.gas].add(gone)
        pressure = self._pressure(feed)
        vapor = empty(feed.mixture, T).replace(gas=gas, pressure=pressure)
        residue = feed.replace(solid=solid, gas=0.0 * gas, temperature=T, pressure=pressure)
        duty = vapor.enthalpy_flow + residue.enthalpy_flow - feed.enthalpy_flow
        return SublimerOutlets(vapor, residue, duty)

    def figures(self, inside: Sublimed, outlets: SublimerOutlets, feed: Stream) -> SublimerFigures:
        by_species = feed.solid_by_species
        there = sum(by_species[v.solid] for v in inside.volatile)
        gone = sum(by_species[v.solid] - outlets.residue.solid_by_species[v.solid] for v in inside.volatile)
        vapor = sum(outlets.vapor.gas[v.gas] for v in inside.volatile)
        return SublimerFigures(gone, safe_divide(gone, there, 0.0), vapor, outlets.heat_duty)

    def measured(
        self, inside: Sublimed, outlets: SublimerOutlets, figures: SublimerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"vapor": figures.sublimed_share}

    def drawn(
        self, inside: Sublimed, outlets: SublimerOutlets, figures: SublimerFigures, feed: Stream
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        return heated(duty, T) | cooled(duty, T)


class DesublimerFigures(NamedTuple):
    """Figures of a condenser from which vapors come as solid."""

    snow_flow: MassFlow
    product_recovery: Ratio
    vapor_flow: MassFlow
    purity: Fraction
    heat_duty: Power


class DesublimerOutlets(NamedTuple):
    """Solid product, gas that leaves, and the heat taken up."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


@equipment(
    "desublimer",
    source=SOURCE,
    title="Desublimation condenser",
    equation=r"\dot n_i = \min\left(\dot n_{i,0},\ \frac{p_i(T)}{P}\,\sum_j \dot n_j\right)",
)
class Desublimer(Unit):
    """Cools a gas until vapors of solids leave it as snow; what saturates the gas at the temperature of the
    condenser is lost with it.

    Condensers one behind the other, each colder, take the vapors apart (fractional desublimation): each
    becomes solid where the gas is saturated with it, as a solid of its own. Fresh crystals have the given
    sizes; solids and liquid of the feed leave with the product. Without a pressure that of the feed is kept.
    """

    temperature: Temperature
    pressure: GasPressure | None = None
    crystal_size: Length = eqx.field(kw_only=True, default=100e-6)
    geometric_standard_deviation: PositiveNumber = eqx.field(kw_only=True, default=1.8)

    limits: ClassVar[Limits] = {
        "caught": Limit("share of the vapors that becomes solid", 0.5, 1.0, "dimensionless", SOURCE),
        "largest": Limit(LARGEST, 0.0, 0.05, "dimensionless", SOURCE),
    }
    utilities: ClassVar[Utilities] = HEATED | COOLED

    def _pressure(self, feed: Stream) -> Any:
        return feed.pressure if self.pressure is None else jnp.asarray(self.pressure, dtype=float)

    def inside(self, feed: Stream) -> Sublimed:
        found = volatile(feed.mixture)
        offered = jnp.stack([feed.gas[v.gas] for v in found])
        shares = _saturation(found, self.temperature, self._pressure(feed))
        return Sublimed(found, _vapors(found, feed, offered, shares))

    def outlets(self, inside: Sublimed, feed: Stream) -> DesublimerOutlets:
        T, solid, gas = jnp.asarray(self.temperature, dtype=float), feed.solid, feed.gas
        edges = jnp.asarray(feed.mixture.edges)
        passing = LogNormal(self.crystal_size, self.geometric_standard_deviation)(edges)
        shares = jnp.diff(passing.at[0].set(0.0).at[-1].set(1.0))
        for v, held in zip(inside.volatile, inside.vapors, strict=True):
            made = jnp.maximum(gas[v.gas] - held, 0.0)
            own = solid[v.solid]
            classes = jnp.sum(own, axis=tuple(range(1, own.ndim))) + made * shares
            role = Roles(v.solid, 0, 0, v.gas, 1.0)
            solid = with_crystals(feed.replace(solid=solid), role, classes)
            gas = gas.at[v.gas].add(-made)
        pressure = self._pressure(feed)
        product = feed.replace(solid=solid, gas=0.0 * gas, temperature=T, pressure=pressure)
        exhaust = empty(feed.mixture, T).replace(gas=gas, pressure=pressure)
        duty = product.enthalpy_flow + exhaust.enthalpy_flow - feed.enthalpy_flow
        return DesublimerOutlets(product, exhaust, duty)

    def figures(self, inside: Sublimed, outlets: DesublimerOutlets, feed: Stream) -> DesublimerFigures:
        came = jnp.stack([feed.gas[v.gas] for v in inside.volatile])
        made = came - jnp.stack([outlets.exhaust.gas[v.gas] for v in inside.volatile])
        every = jnp.sum(made)
        return DesublimerFigures(
            every,
            safe_divide(every, jnp.sum(came), 0.0),
            jnp.sum(came - made),
            jnp.clip(jnp.where(every > 0.0, safe_divide(jnp.max(made), every, 1.0), 1.0), 0.0, 1.0),
            outlets.heat_duty,
        )

    def measured(
        self, inside: Sublimed, outlets: DesublimerOutlets, figures: DesublimerFigures, feed: Stream
    ) -> dict[str, Any]:
        return {"caught": figures.product_recovery, "largest": outlets.product.size_fractions[-1]}

    def drawn(
        self, inside: Sublimed, outlets: DesublimerOutlets, figures: DesublimerFigures, feed: Stream
    ) -> dict[str, Any]:
        duty, T = outlets.heat_duty, self.temperature
        return heated(duty, T) | cooled(duty, T)
