"""From streams to the core and back: what every dryer built on the contact core shares."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import scipy
from jax.core import Tracer

from granum.core.errors import ApplicabilityError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    HumidityRatio,
    Mass,
    MoistureDryBasis,
    Power,
    Ratio,
    SignedMassFlow,
    Temperature,
    TemperatureDifference,
    Time,
)
from granum.core.limits import Limit
from granum.core.utilities import Utility
from granum.drying.gas_solid.airborne import dried_on
from granum.drying.gas_solid.cells import Contact, Inlet, Profile
from granum.drying.gas_solid.kinetics import AbstractKinetics, Meeting
from granum.drying.gas_solid.liquor import composition, counted, moistened
from granum.drying.gas_solid.matter import Matter, temperature_at
from granum.numerics import safe_divide
from granum.streams import fines
from granum.streams.atmosphere import EXPLOSIBLE, FLAMMABLE, explosible, flammable, vented
from granum.streams.equilibrium import HumidMixture
from granum.streams.stream import Stream
from granum.streams.units import Limits, Operated, Unit, Utilities
from granum.streams.utilities import DUCT, HOT_GAS, ducted, warmth

WIDER = 3.0  # steps in which a size is sought
NOTES = "houdon2017, notes D table {table}"
UNSOLVED = (
    "The steady state of the dryer was not found: its figures are no result. Take less solid in it, or "
    "more gas; where gas and solid come to equilibrium at once, fewer cells or layers, or a smaller surface "
    "or heat transfer coefficient, help too."
)
ALL_DRY = 1e-4  # kg/kg
ROUNDING = 1e-7  # of the water that comes, to which profiles are exact
NOTHING_TO_DRY = (
    "The steady state of the dryer was not found: its figures are no result. Its feed is all but dry and "
    "takes the vapor out of the gas at once: give the feed the moisture it has in ambient air, or leave the "
    "dryer out."
)
# ready four times as soon; small arrays run as fast
LEAST_EVAPORATION = 1e-6  # kg per hour and m² or m³, below which it is rounding
PLAIN = {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 0}


def ready(solve: Callable[..., Any]) -> Callable[..., Any]:
    """Compiled when called from outside of compiled code, quickly rather than for speed: a dryer's arrays are
    small.
    """
    built: list[Callable[..., Any]] = []

    def call(*given: Any) -> Any:
        if isinstance(jnp.zeros(()) + 0.0, Tracer):  # inside compiled code, which has options of its own
            return solve(*given)
        if not built:
            options: dict[str, Any] = {"compiler_options": PLAIN} if jax.default_backend() == "cpu" else {}
            built.append(eqx.filter_jit(solve, **options))
        return built[0](*given)

    return call


class Dried(NamedTuple):
    """Dried solid, exhaust gas and the heat taken up from outside (negative: the loss)."""

    product: Stream
    exhaust: Stream
    heat_duty: Any


class DryerFigures(NamedTuple):
    """Figures that every continuous dryer has."""

    # negative where the solid came in drier than it is in equilibrium with the gas
    evaporation_rate: SignedMassFlow
    moisture_dry_basis: MoistureDryBasis
    moisture_dry_basis_highest: MoistureDryBasis
    temperature_product: Temperature
    temperature_product_highest: Temperature
    temperature_exhaust: Temperature
    humidity_ratio: HumidityRatio
    relative_humidity: Ratio
    superheat: TemperatureDifference
    solid_holdup: Mass
    residence_time: Time
    heat_duty: Power


class Through(NamedTuple):
    """What happens in a dryer in steady state: moisture and temperature through it and what leaves it, the
    dry solid in it (kg), and, of a grain column with a cooling zone, vapor and enthalpy of the air that
    cooled.
    """

    profile: Profile
    holdup: Any
    cooling: tuple[Any, Any] | None = None


class Dryer(Unit):
    """A dryer fed with wet solid and gas. A subclass says what happens in it (``through``); streams, figures
    and limits are here.
    """

    # fields of every subclass, which are not declared here because a dataclass would put them first
    if TYPE_CHECKING:

        @property
        def kinetics(self) -> AbstractKinetics: ...

        @property
        def temperature_limit(self) -> Any: ...

    gas_direction = None  # of gas that flows along the solid or against it
    explosion_vent = None  # of those that have one
    dust_dries_on: ClassVar[bool] = True  # to equilibrium with the exhaust

    limits: ClassVar[Limits] = {
        "humid": Limit("relative humidity of the exhaust", 0.0, 0.9, "dimensionless", "mujumdar2014, ch. 1"),
        "over": Limit(
            "moisture of the product above equilibrium with the inlet gas",
            -1e-6,
            math.inf,
            "kg/kg",
            "keey1978",
        ),
        "hot": Limit("product temperature over its limit", -math.inf, 0.0, "delta_degC", "keey1978"),
    } | (FLAMMABLE | EXPLOSIBLE)

    utilities: ClassVar[Utilities] = HOT_GAS | {"electric_power_fan": Utility(DUCT)}

    @abstractmethod
    def through(self, *inlets: Any) -> Through:
        """The steady state."""

    @abstractmethod
    def extent(self) -> Any:
        """Volume (m³) or area (m²) to which capacities refer."""

    def profile(self, *inlets: Any) -> Profile:
        """Moisture and temperature through the dryer in steady state, and what leaves it."""
        return self.through(*inlets).profile

    def charged(self, feed: Stream, gas: Stream) -> Stream:
        """What goes through, ``counted`` as dry matter and water."""
        return counted(feed)

    def inside(self, feed: Stream, gas: Stream, *more: Any, **others: Any) -> Through:
        found = self.through(feed, gas, *more, *others.values())
        solid, card = counted(feed), type(self).card
        dry, known = solid.moisture_dry_basis < ALL_DRY, found.profile.converged
        unsolved(known | dry, card, reason=UNSOLVED)
        unsolved(known | ~dry, card, reason=NOTHING_TO_DRY)
        humidity, T = found.profile.humidity, found.profile.gas_temperature
        self.kinetics.tell(Matter.of(solid, gas).relative_humidity(T, humidity), T)
        return found

    def outlets(self, inside: Through, feed: Stream, gas: Stream) -> Dried:
        return self.dusted(dried(feed, gas, inside.profile), inside.profile)

    def entrained(self, product: Stream, exhaust: Stream) -> Any:
        """Share of each species and size class of the product that the exhaust takes along; None unless a
        dryer says how much.
        """
        return None

    def dusted(self, made: Dried, found: Profile) -> Dried:
        """The outlets with the dust where it goes: as moist as its size classes are, and dried on in the
        exhaust where it meets that only on its way out.
        """
        share = self.entrained(made.product, made.exhaust)
        if share is None:
            return made
        by_class = found.water.shape[0] == share.shape[1]  # a layer has one moisture for all sizes
        product, dust = fines.parted(made.product, share, found.water if by_class else None)
        exhaust = made.exhaust
        if self.dust_dries_on:
            dust, exhaust = dried_on(dust, exhaust, self.kinetics)
        return Dried(product, exhaust + dust, made.heat_duty)

    def figures(
        self, inside: Through, outlets: Any, feed: Stream, gas: Stream, **_others: Any
    ) -> DryerFigures:
        feed, exhaust = counted(feed), outlets.exhaust
        left = counted(outlets.product).liquid[0] + counted(exhaust).liquid[0] - counted(gas).liquid[0]
        found, humid = inside.profile, HumidMixture(feed.mixture)
        some = found.shares > 1e-9
        return DryerFigures(
            evaporation_rate=feed.liquid[0] - left,
            moisture_dry_basis=dried_moisture(outlets, gas),
            moisture_dry_basis_highest=found.wettest,
            temperature_product=outlets.product.temperature,
            temperature_product_highest=jnp.max(jnp.where(some, found.temperature, 0.0)),
            temperature_exhaust=exhaust.temperature,
            humidity_ratio=humid.humidity_ratio(exhaust),
            relative_humidity=humid.relative_humidity(exhaust),
            superheat=humid.superheat(exhaust),
            solid_holdup=inside.holdup,
            residence_time=safe_divide(inside.holdup, feed.solid_flow),
            heat_duty=outlets.heat_duty,
        )

    def measured(
        self, inside: Through, outlets: Any, figures: DryerFigures, feed: Stream, gas: Stream, **_others: Any
    ) -> dict[str, Any]:
        found = {
            "humid": figures.relative_humidity,
            "over": figures.moisture_dry_basis - equilibrium(self.kinetics, feed, gas),
        } | (flammable(outlets.exhaust) | explosible(outlets.exhaust))
        dusty = outlets.exhaust.replace(solid=outlets.exhaust.solid + outlets.product.solid)
        found |= vented(dusty, self.explosion_vent, coarse=True)
        if self.temperature_limit is not None:
            dusty = outlets.exhaust.solid_flow > gas.solid_flow
            dust = jnp.where(dusty, outlets.exhaust.temperature, 0.0)
            hottest = jnp.maximum(figures.temperature_product_highest, dust)
            found["hot"] = hottest - self.temperature_limit
        return found

    def drawn(
        self,
        inside: Through,
        outlets: Any,
        figures: DryerFigures,
        feed: Stream,
        gas: Stream,
        **_others: Any,
    ) -> dict[str, Any]:
        return warmth(gas) | {"electric_power_fan": ducted(gas, self.pressure_lost(feed, gas))}

    def pressure_lost(self, feed: Stream, gas: Stream) -> Any:
        """Pressure that the gas loses in the dryer itself, Pa; none worth counting unless a dryer says so."""
        return 0.0

    def charts(self, made: Operated, inlets: Mapping[str, Stream]) -> dict[str, Any]:
        from granum.drying.profile_charts import drawn_air, drawn_profile

        found = made.inside.profile
        drawn = {_("Profiles in a dryer"): drawn_profile(found)}
        if self.gas_direction is not None:
            against = self.gas_direction == "counter-current"
            path = drawn_air(found, inlets["feed"], inlets["gas"], made.outlets.exhaust, against)
            drawn |= {} if path is None else {_("Path of the air in a dryer"): path}
        return drawn

    def hourly(self, figures: DryerFigures) -> Any:
        """Water evaporated per volume or area and hour, kg; none where a dry solid is cooled or heated."""
        rate = figures.evaporation_rate * 3600.0 / self.extent()
        return jnp.where(jnp.abs(rate) < LEAST_EVAPORATION, 0.0, rate)

    def temperature_drying(self, figures: DryerFigures, gas: Stream) -> Any:
        """Of the gas at the inlet, K; 0 where nothing is dried."""
        return jnp.where(self.hourly(figures) == 0.0, 0.0, gas.temperature)


class CellDryer(Dryer):
    """A dryer whose solid flows through cells: a subclass says how solid and gas flow and meet
    (``contact``).
    """

    @abstractmethod
    def contact(self, feed: Stream, gas: Stream) -> Contact:
        """The core's view of the dryer with these inlets, the feed ``counted`` as dry matter and water."""

    def core(self, feed: Stream, gas: Stream) -> Contact:
        """The same for a feed whose moisture may be a solution."""
        return solved(self.contact(counted(feed), gas), feed)

    def inlet(self, feed: Stream, gas: Stream) -> Inlet:
        """What enters the core: every class of the solid brings the same moisture."""
        X = jnp.full(len(feed.mixture.sizes), 1.0) * feed.moisture_dry_basis
        return Inlet(
            X,
            jnp.full_like(X, 1.0) * feed.temperature,
            HumidMixture(gas.mixture).vapor_per_carrier(gas),
            gas.temperature,
        )

    def through(self, feed: Stream, gas: Stream) -> Through:
        return _steady(self, feed, gas)

    def dynamic(
        self, feed: Stream, gas: Stream, step: Any, inlets: Inlet, start: Any = None
    ) -> tuple[Profile, Any]:
        """Profiles over time from a start (by default the steady state for ``feed`` and ``gas``), with inlets
        that change from step to step.
        """
        core = self.core(feed, gas)
        if start is None:
            found = self.profile(feed, gas)
            start = core.state(found.moisture, found.temperature, found.humidity, found.gas_temperature)
        return core.dynamic(start, inlets, step)


@ready
def _steady(dryer: CellDryer, feed: Stream, gas: Stream) -> Through:
    core = dryer.core(feed, gas)
    return Through(core.steady(dryer.inlet(counted(feed), gas)), jnp.sum(core.solid))


def solved(core: Contact, feed: Stream) -> Contact:
    """The core with what the moisture of a feed holds in solution."""
    if len(feed.mixture.liquids) < 2:
        return core
    return replace(core, matter=replace(core.matter, dissolved=composition(feed)))


def dried(feed: Stream, gas: Stream, found: Profile) -> Dried:
    """Streams from what leaves the core. Gas that came with the feed, and dust with the gas, pass to the
    exhaust.
    """
    return parted(counted(feed), composition(feed), gas, found)


def dried_moisture(outlets: Any, gas: Stream) -> Any:
    """Moisture of what was dried, also where all of it flies."""
    product, exhaust = outlets.product, outlets.exhaust
    flown = safe_divide(exhaust.liquid_flow - gas.liquid_flow, exhaust.solid_flow - gas.solid_flow)
    return jnp.where(product.solid_flow > 0.0, product.moisture_dry_basis, flown)


def parted(feed: Stream, dissolved: Any, gas: Stream, found: Profile) -> Dried:
    """The same for a feed already ``counted``."""
    humid = HumidMixture(feed.mixture)
    stray_feed, stray_gas = feed.part(gas=1.0), gas.part(solid=1.0, liquid=1.0)
    water = jnp.sum(found.water)
    owed = jnp.clip(water, -ROUNDING * feed.liquid[0], 0.0)  # less than nothing is left where all of it goes
    product = moistened(feed, water - owed, dissolved).replace(gas=0.0 * feed.gas, pressure=gas.pressure)
    exhaust = gas.replace(
        gas=humid.carrying(gas).at[humid.vapor].add(found.vapor + owed) + stray_feed.gas,
        solid=stray_gas.solid,
        liquid=stray_gas.liquid,
    )
    gas_enthalpy = found.gas_enthalpy + stray_feed.enthalpy_flow + stray_gas.enthalpy_flow
    return Dried(
        warmed(product, jnp.sum(found.solid_enthalpy)), warmed(exhaust, gas_enthalpy), found.heat_duty
    )


def warmed(stream: Stream, enthalpy: Any) -> Stream:
    """The stream at the temperature of its enthalpy; the polynomials of its species are trusted near their
    own range only.
    """
    some = stream.mass_flow > 0
    flow = jnp.where(some, stream.mass_flow, 1.0)
    T = temperature_at(
        lambda T: stream.enthalpy_at(T) / flow, enthalpy / flow, jnp.asarray(stream.temperature, dtype=float)
    )
    return stream.replace(temperature=jnp.where(some, T, stream.temperature))


def equilibrium(kinetics: AbstractKinetics, feed: Stream, gas: Stream) -> Any:
    """Moisture of the product in equilibrium with the gas that enters."""
    feed = counted(feed)
    matter = Matter.of(feed, gas)
    Y = matter.humid.vapor_per_carrier(gas)
    X = jnp.full((1,), 1.0) * feed.moisture_dry_basis
    at = Meeting(X, gas.temperature + 0.0 * X, gas.temperature + 0.0 * X, Y + 0.0 * X, 1.0 + 0.0 * X, matter)
    return kinetics.equilibrium(at)[0]


def sized(
    dryer: Any,
    name: str,
    target: Any,
    low: float,
    high: float,
    feed: Stream,
    gas: Stream,
    gas_velocity: Any = None,
) -> Any:
    """The dryer with one parameter such that the product has a moisture; an error that says why where there
    is none.

    With ``gas_velocity`` the gas flow follows the size of the trial dryer: it crosses its extent at this
    speed.
    """
    least = float(equilibrium(dryer.kinetics, feed, gas))
    shown = f"{float(target):.4g}"
    if float(target) <= least:
        raise ApplicabilityError(
            _(
                "A moisture of {value} kg/kg cannot be reached: equilibrium with the inlet gas is "
                "{limit} kg/kg; take drier or hotter gas."
            ).format(value=shown, limit=f"{least:.4g}")
        )
    if float(target) >= float(counted(feed).moisture_dry_basis):
        raise ApplicabilityError(_("The feed is already as dry as {value} kg/kg.").format(value=shown))
    # numbers as arrays, so that dryers of one shape share compiled code; a zero may switch a part off and
    # stays
    given = jax.tree.map(
        lambda x: np.asarray(x, dtype=float) if isinstance(x, float) and x else x,
        (dryer, feed, gas, gas_velocity),
    )

    def over(x: float) -> float:
        return float(
            np.log(max(float(_moisture(name, jnp.asarray(x, dtype=float), *given)), 1e-12) / float(target))
        )

    bounds = np.log(low), np.log(high)
    size = float(np.clip(np.log(getattr(dryer, name)), *bounds))
    first = last = over(size)
    other = size
    way = np.log(WIDER) if first > 0 else -np.log(WIDER)
    while last * first > 0 and other != bounds[int(way > 0)]:
        size, other, first = other, float(np.clip(other + way, *bounds)), last
        last = over(other)
    if last * first > 0 or not np.isfinite(last):
        if last < 0:
            told = _(
                "No dryer is small enough to leave {value} kg/kg in the product: already one of {name} = "
                "{size} dries it to {best} kg/kg; take less or cooler gas."
            )
        else:
            told = _(
                "The gas cannot dry the product to {value} kg/kg: even a dryer of {name} = {size} leaves "
                "{best} kg/kg, because the exhaust saturates or the gas cools to the solid; take more or "
                "hotter gas."
            )
        best = f"{float(target) * np.exp(last):.4g}"
        raise ApplicabilityError(told.format(value=shown, name=name, size=f"{np.exp(other):.3g}", best=best))
    ends = sorted([(size, first), (other, last)])
    known = dict(ends)
    found = scipy.optimize.root_scalar(
        lambda x: known.get(x) or over(x),
        bracket=[x for x, _y in ends],
        method="toms748",
        xtol=1e-12,
        rtol=1e-12,
    ).root
    return eqx.tree_at(lambda d: getattr(d, name), dryer, float(np.exp(found)))


@ready
def _moisture(name: str, x: Any, dryer: Any, feed: Stream, gas: Stream, gas_velocity: Any) -> Any:
    """Of the product of a dryer with the logarithm of its size."""
    changed = eqx.tree_at(lambda d: getattr(d, name), dryer, jnp.exp(x))
    if gas_velocity is not None:
        gas = gas.part(gas=gas_velocity * changed.extent() * gas.gas_density / gas.gas_flow)
    found = jnp.sum(changed.profile(feed, gas).water)
    return moistened(changed.charged(feed, gas), found, composition(feed)).moisture_dry_basis
