"""Mills and crushers: population balance, Bond, and Whiten's cone crusher."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple

import jax.numpy as jnp
import jax.scipy.linalg as linalg

from granum.comminution.equipment.screens import size_passing
from granum.comminution.formulas.energy import product_size_bond, specific_energy_bond
from granum.comminution.kinds import WorkIndex
from granum.comminution.population import Convention, TanksInSeries, batch_operator, fragments, rate_matrix
from granum.core import equipment
from granum.core.errors import InputError
from granum.core.flags import unsolved
from granum.core.i18n import _
from granum.core.kinds import (
    Law,
    Length,
    Mass,
    MassFlow,
    PositiveNumber,
    Power,
    Ratio,
    SpecificEnergy,
    Time,
    Within,
)
from granum.core.limits import Limit
from granum.numerics.smooth import safe_divide
from granum.streams.stream import Stream
from granum.streams.units import Dynamic, Limits, Unit, Utilities
from granum.streams.utilities import DRIVE, driven

_TINY = 1e-12
OWN_LIMIT = "bond1961, the 80 % size only: that it has to lie within the grid of sizes is our own choice"
OWN_CLASSES = "bond1961, the law only: what wide size classes may add is our own choice"
_IDLE = (
    "What enters cannot take up the shaft power: nothing comes in, or it would be hotter than anything its "
    "properties are known for."
)


class Ground(NamedTuple):
    """Ground product and the power taken up."""

    product: Stream
    shaft_power: Any


def _warmed(ground: Stream, shaft_power: Any, card: Any) -> Ground:
    """The product with the heat that the shaft power becomes."""
    product = ground.heated(shaft_power)
    taken = (ground.mass_flow > 0) | (jnp.asarray(shaft_power) == 0.0)
    unsolved(taken & jnp.isfinite(product.temperature), card, reason=_IDLE)
    return Ground(product, jnp.asarray(shaft_power))


def _power(shaft_power: Any, work_index: Any, feed: Stream, ground: Stream) -> Any:
    """The stated power, else that of Bond's law between the sizes that 80 % pass, else none."""
    if shaft_power is not None or work_index is None:
        return 0.0 if shaft_power is None else shaft_power
    coarse = size_passing(feed)
    fine = jnp.minimum(size_passing(ground), coarse)  # to rounding, where nothing is broken
    return feed.solid_flow * specific_energy_bond.function(coarse, fine, work_index)


INSTEAD = {"work_index": "shaft_power", "shaft_power": "work_index"}


def _one_power(unit: BallMill | ConeCrusher) -> None:
    if unit.shaft_power is not None and unit.work_index is not None:
        raise InputError(
            _("The power is given by 'shaft_power' or by 'work_index': give one of the two."),
            name="work_index",
        )


def _energy(unit: BallMill | ConeCrusher, power: Any, feed: Stream) -> Any:
    """Per mass of solid; None where neither power nor work index is known."""
    known = unit.shaft_power is not None or unit.work_index is not None
    return safe_divide(power, feed.solid_flow) if known else None


class MillFigures(NamedTuple):
    """Figures of a mill."""

    residence_time: Time
    feed_size: Length
    product_size: Length
    reduction_ratio: Ratio
    specific_energy: SpecificEnergy | None


@equipment("ball_mill", source="austin1984; reid1965", title="Mill with a population balance")
class BallMill(Unit, Dynamic):
    """Continuous mill of fixed holdup: first-order breakage of every size class, with the residence time law
    of the shell.

    The mean residence time is the mass of solid in the mill over the feed of solid. The shaft power heats the
    product; it does not set the breakage rates (see ``selection_rate_herbst_fuerstenau``). Where none is
    given, a work index gives that of Bond's law for the sizes that 80 % of feed and product pass. Batch
    grinding is plug flow.

    The laws are those of single sizes (``continuous``) unless the convention is ``root_two``, which most
    published constants of Austin's laws have: rates of root-two classes by their upper limit, fragments
    measured from their lower limit.
    """

    selection: Annotated[Any, Law("selection_function")]
    breakage: Annotated[Any, Law("breakage_function")]
    holdup_mass: Mass
    mixing: Annotated[Any, Law("residence_time_law")] = TanksInSeries(1)
    shaft_power: Annotated[Power, Within(0.0)] | None = None
    breakage_convention: Convention = "continuous"
    work_index: WorkIndex | None = None

    instead: ClassVar[Mapping[str, str]] = INSTEAD
    utilities: ClassVar[Utilities] = DRIVE

    def __check_init__(self) -> None:
        _one_power(self)

    def _residence_time(self, feed: Stream) -> Any:
        return self.holdup_mass / jnp.maximum(feed.solid_flow, _TINY)

    def _matrix(self, mixture: Any) -> Any:
        return rate_matrix(mixture.edges, self.selection, self.breakage, self.breakage_convention)

    def outlets(self, inside: None, feed: Stream) -> Ground:
        matrix = self._matrix(feed.mixture)
        ground = feed.regraded(self.mixing.operator(matrix, self._residence_time(feed)))
        return _warmed(ground, _power(self.shaft_power, self.work_index, feed, ground), type(self).card)

    def figures(self, inside: None, outlets: Ground, feed: Stream) -> MillFigures:
        coarse, fine = size_passing(feed), size_passing(outlets.product)
        energy = _energy(self, outlets.shaft_power, feed)
        return MillFigures(self._residence_time(feed), coarse, fine, coarse / fine, energy)

    def drawn(self, inside: None, outlets: Ground, figures: MillFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_drive": driven(outlets.shaft_power)}

    # -- in time: the shell as one mixed vessel of constant holdup
    # ------------------------------------------------
    def initial_holdup(self, mixture: Any) -> Any:
        # Full of ground product; full of feed, a circuit could not take a first particle.
        return jnp.zeros(mixture.solid_shape).at[(0,) * (2 + len(mixture.axes))].set(1.0) * self.holdup_mass

    def steady_holdup(self, inlets: Mapping[str, Stream]) -> Any:
        product = self(**inlets).product
        return product.solid / jnp.maximum(product.solid_flow, _TINY) * self.holdup_mass

    def held_mass(self, state: Any) -> Any:
        return jnp.sum(state)

    def prepare(self, mixture: Any, step: Any) -> Any:
        matrix = self._matrix(mixture)
        return matrix, batch_operator(matrix, step)

    def advance(
        self, state: Any, before: Mapping[str, Stream], after: Mapping[str, Stream], step: Any, prepared: Any
    ) -> tuple[Any, Ground]:
        """Exact for grinding and for feeds that are linear over the step; the turnover is that of its
        middle.
        """
        matrix, ground = prepared
        then, now = before["feed"], after["feed"]
        rate = jnp.maximum(0.5 * (then.solid_flow + now.solid_flow) / self.holdup_mass, 1e-9)
        still = matrix - rate * jnp.eye(matrix.shape[0])

        def on_sizes(operator: Any, held: Any) -> Any:
            return jnp.moveaxis(jnp.tensordot(operator, held, axes=([1], [1])), 0, 1)

        def undone(held: Any) -> Any:
            """Solves still · x = held; fragments are finer, so that the matrix is upper triangular."""
            rows = jnp.moveaxis(held, 1, 0)
            flat = linalg.solve_triangular(still, rows.reshape(rows.shape[0], -1), lower=False)
            return jnp.moveaxis(flat.reshape(rows.shape), 0, 1)

        moving = step > 0
        slope = jnp.where(moving, (now.solid - then.solid) / jnp.where(moving, step, 1.0), 0.0)
        b = -undone(slope)
        a = undone(b - then.solid)
        # state(t) = e^{still t} (state(0) - a) + a + b t solves  state' = still state + inlet
        state = jnp.exp(-rate * step) * on_sizes(ground, state - a) + a + b * step
        state = state * (self.holdup_mass / jnp.sum(state))
        out = now.replace(solid=state * (now.solid_flow / self.holdup_mass))
        power = _power(self.shaft_power, self.work_index, now, out)
        return state, Ground(out.at_enthalpy(now.enthalpy_flow + power), jnp.asarray(power))


class CrusherFigures(NamedTuple):
    """Figures of a crusher."""

    feed_size: Length
    product_size: Length
    reduction_ratio: Ratio
    specific_energy: SpecificEnergy | None


@equipment("bond_mill", source="bond1952; bond1961", title="Crusher or mill by Bond's law")
class BondMill(Unit):
    """Size reduction by a given power: every size shrinks by the ratio of the 80 % sizes that Bond's law
    allows.

    The product keeps the shape of the feed's distribution; a self-similar product is what Bond's law assumes.
    Its 80 % size is told as the law gives it; a check says where size classes are too wide to hold it.
    """

    shaft_power: Annotated[Power, Within(0.0)]
    work_index: WorkIndex
    efficiency_factor: PositiveNumber = 1.0

    limits: ClassVar[Limits] = {
        "finest": Limit("product in the finest size class", 0.0, 20.0, "percent", OWN_LIMIT),
        "classes": Limit(
            "80 % size of the product as its size classes hold it over that of the law",
            0.95,
            1.05,
            "dimensionless",
            OWN_CLASSES,
        ),
    }

    utilities: ClassVar[Utilities] = DRIVE

    def _product_size(self, feed: Stream) -> Any:
        energy = safe_divide(jnp.asarray(self.shaft_power), feed.solid_flow) / self.efficiency_factor
        return product_size_bond(size_passing(feed), energy, self.work_index)

    def outlets(self, inside: None, feed: Stream) -> Ground:
        edges = jnp.asarray(feed.mixture.edges)
        ratio = self._product_size(feed) / size_passing(feed)
        lower, upper = ratio * edges[:-1], ratio * edges[1:]
        below = jnp.clip((edges[:, None] - lower[None, :]) / (upper - lower)[None, :], 0.0, 1.0)
        below = below.at[0].set(0.0)  # what leaves the grid at its fine end stays in the finest class
        ground = feed.regraded(jnp.diff(below, axis=0))
        return _warmed(ground, self.shaft_power, type(self).card)

    def figures(self, inside: None, outlets: Ground, feed: Stream) -> CrusherFigures:
        coarse, fine = size_passing(feed), self._product_size(feed)
        return CrusherFigures(
            coarse, fine, coarse / fine, safe_divide(jnp.asarray(self.shaft_power), feed.solid_flow)
        )

    @classmethod
    def size(
        cls,
        mass_flow: MassFlow,
        feed_size: Length,
        product_size: Length,
        work_index: WorkIndex,
        efficiency_factor: float = 1.0,
    ) -> BondMill:
        """The machine whose power brings a flow from one 80 % size to another."""
        energy = specific_energy_bond(feed_size, product_size, work_index)
        return cls(mass_flow * energy * efficiency_factor, work_index, efficiency_factor)

    def measured(
        self, inside: None, outlets: Ground, figures: CrusherFigures, feed: Stream
    ) -> dict[str, Any]:
        return {
            "finest": 100.0 * outlets.product.size_fractions[0],
            "classes": jnp.where(
                feed.solid_flow > 0.0, size_passing(outlets.product) / figures.product_size, 1.0
            ),
        }

    def drawn(self, inside: None, outlets: Ground, figures: CrusherFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_drive": driven(outlets.shaft_power)}


@equipment("cone_crusher", source="whiten1972; napiermunn1996", title="Cone or jaw crusher (Whiten)")
class ConeCrusher(Unit):
    """Whiten's crusher: particles are classified, those nipped are broken and classified again, until they
    pass.

    The product is p = (I - C)(I - B C)^-1 f with the chances of breakage C and the fragments B; all mass is
    kept. What a breakage function means is said by the convention, as for ``ball_mill``, and so is the power
    where none is given.
    """

    always_passing_size: Length
    always_broken_size: Length
    breakage: Annotated[Any, Law("breakage_function")]
    classification_exponent: PositiveNumber = 2.3
    shaft_power: Annotated[Power, Within(0.0)] | None = None
    breakage_convention: Convention = "continuous"
    work_index: WorkIndex | None = None

    instead: ClassVar[Mapping[str, str]] = INSTEAD
    utilities: ClassVar[Utilities] = DRIVE

    def __check_init__(self) -> None:
        _one_power(self)
        low, high = self.always_passing_size, self.always_broken_size
        if isinstance(low, float) and isinstance(high, float) and low >= high:
            raise InputError(
                _("The size that always passes must be smaller than the size that is always broken."),
                name="always_passing_size",
            )

    def outlets(self, inside: None, feed: Stream) -> Ground:
        from granum.comminution.breakage import WhitenClassification

        edges = jnp.asarray(feed.mixture.edges)
        chance = WhitenClassification(
            self.always_passing_size, self.always_broken_size, self.classification_exponent
        )
        c = chance.over(edges[:-1], edges[1:]).at[0].set(0.0)
        b = fragments(feed.mixture.edges, self.breakage, self.breakage_convention)
        operator = jnp.linalg.solve((jnp.eye(c.shape[0]) - b * c[None, :]).T, jnp.diag(1.0 - c)).T
        ground = feed.regraded(operator)
        return _warmed(ground, _power(self.shaft_power, self.work_index, feed, ground), type(self).card)

    def figures(self, inside: None, outlets: Ground, feed: Stream) -> CrusherFigures:
        coarse, fine = size_passing(feed), size_passing(outlets.product)
        return CrusherFigures(coarse, fine, coarse / fine, _energy(self, outlets.shaft_power, feed))

    def drawn(self, inside: None, outlets: Ground, figures: CrusherFigures, feed: Stream) -> dict[str, Any]:
        return {"electric_power_drive": driven(outlets.shaft_power)}
