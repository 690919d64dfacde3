"""One-dimensional hindered settling with compression in batch columns and continuous clarifier-thickeners.

The scheme of Bürger, Diehl and co-workers: Godunov flux for settling, upwind bulk flow, central differences
of the primitive of the compression diffusivity, explicit steps at the limit of stability, compression in
several short ones per step. It is monotone and conservative: shocks and fans appear where they must,
concentrations stay between zero and the packed limit, and the mass of solids closes to rounding. First order
in the cell size.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import lax

from granum.core.constants import STANDARD_GRAVITY
from granum.core.conversion import is_tracer
from granum.core.errors import ApplicabilityError, InputError
from granum.core.i18n import _
from granum.numerics.extremes import least

COURANT = 0.98  # of a cell crossed in one step
# the same where compression acts too: what flows out and what is squeezed out together stay below what is
# there
BED_COURANT = 0.4
FRONT = 3  # cells above and below a front within which it is smeared
# of the packed concentration: a law that has no limit of its own is brought to zero over this last stretch
FADE = 0.05


class Suspension(eqx.Module):
    """What settles: velocity law, compression law, densities, and the concentration at which it is packed.

    Parameters
    ----------
    settling: settling velocity against concentration.
    compression: effective stress against concentration; None for none.
    solid_density, liquid_density: kg/m³, for the buoyant weight that compresses.
    packed_concentration: kg/m³, where solids no longer move against each other; the solid density when not
        given.
    """

    settling: Any
    compression: Any = None
    solid_density: Any = 1050.0
    liquid_density: Any = 998.0
    packed_concentration: Any = None

    @property
    def packed(self) -> Any:
        """The packed concentration."""
        return self.solid_density if self.packed_concentration is None else self.packed_concentration

    def velocity_function(self) -> Any:
        """Settling velocity as a function of concentration, zero at the packed one."""
        limit = jnp.asarray(self.packed, dtype=float)
        vanishes = self.settling(limit) <= 1e-9 * self.settling(0.5 * limit)
        steepness = jnp.where(vanishes, 1e9, 1.0 / FADE) / limit
        return lambda C: self.settling(C) * jnp.clip((limit - C) * steepness, 0.0, 1.0)

    def velocity(self, C: Any) -> Any:
        """Settling velocity at a concentration."""
        return self.velocity_function()(C)

    def flux(self, C: Any) -> Any:
        """Settling flux."""
        return C * self.velocity(C)

    def stiffness(self, C: Any) -> Any:
        """Compression diffusivity over settling velocity, at or above the critical concentration, m."""
        factor = self.solid_density / (STANDARD_GRAVITY * (self.solid_density - self.liquid_density))
        return factor * self.compression.slope(C)

    def peak(self) -> Any:
        """Concentration of the greatest settling flux."""
        share = jnp.geomspace(1e-4, 1.0, 400)
        best = share[jnp.argmax(self.flux(share * self.packed))] * self.packed
        return lax.stop_gradient(
            least(lambda C: -self.flux(C), 0.97 * best, jnp.minimum(1.03 * best, self.packed))[1]
        )

    def fastest(self) -> tuple[Any, Any, Any]:
        """Greatest speed of a wave, m/s, the same where the bed is compressed, and greatest compression
        diffusivity, m²/s.
        """
        C = self.packed * jnp.concatenate(
            [jnp.zeros(1), jnp.geomspace(1e-5, 1.0, 800), jnp.linspace(1 - FADE, 1.0, 40)]
        )
        speed = jnp.abs(jax.jvp(self.flux, (C,), (jnp.ones_like(C),))[1])
        if self.compression is None:
            return jnp.max(speed), jnp.zeros(()), jnp.zeros(())
        bed = jnp.maximum(C, self.compression.critical_concentration)
        slow = jnp.max(jnp.where(bed == C, jnp.maximum(speed, self.velocity(C)), self.velocity(bed)))
        return jnp.max(speed), slow, jnp.max(self.velocity(bed) * self.stiffness(bed))

    def check(self) -> None:
        """Raise when the flux has more than one hump, for which this scheme's flux is not made; only for
        known numbers.
        """
        if any(is_tracer(leaf) for leaf in jax.tree.leaves(self)):
            return
        f = np.asarray(self.flux(jnp.geomspace(1e-4, 1.0, 1500) * self.packed))
        turns = np.diff(np.sign(np.diff(f)[np.abs(np.diff(f)) > 1e-12 * f.max()]))
        if np.count_nonzero(turns) > 1:
            raise ApplicabilityError(
                _(
                    "The settling flux of this law rises and falls more than once below {limit} kg/m³; "
                    "give a lower 'packed_concentration'."
                ).format(limit=round(float(self.packed), 3))
            )


class Operation(NamedTuple):
    """What is done with a column, piecewise constant: one value per interval between the times, volume flows
    per area in m/s.
    """

    times: Any
    feed_velocity: Any
    underflow_velocity: Any
    feed_concentration: Any


class Simulation(eqx.Module):
    """Course of a column.

    Parameters
    ----------
    times: s. depths: of the cell centers below the surface, m.
    concentration: kg/m³, (times × cells), from the top.
    overflow_concentration, underflow_concentration: mean over each interval, kg/m³.
    overflowed, underflowed, fed: solids per area, kg/m², from the start to each time.
    area_shares: cross section of the cells over that at the top.
    """

    times: Any
    depths: Any
    concentration: Any
    overflow_concentration: Any
    underflow_concentration: Any
    overflowed: Any
    underflowed: Any
    fed: Any
    area_shares: Any

    @property
    def held(self) -> Any:
        """Solids in the column, kg/m² of its area at the top."""
        cell = self.depths[1] - self.depths[0]
        return jnp.sum(self.concentration * self.area_shares, axis=-1) * cell

    @property
    def mass_error(self) -> Any:
        """Solids lost or made, relative to all that was ever there: the audit of the simulation."""
        missing = self.held - self.held[..., :1] - self.fed + self.underflowed + self.overflowed
        return jnp.max(jnp.abs(missing)) / jnp.max(self.held[..., 0] + self.fed[..., -1])

    def interface_height(self, threshold: Any) -> Any:
        """Height above the bottom of the first crossing of a concentration from the top, one per time.

        The front is where two even layers, of the concentrations just above and just below, would hold the
        solids of the cells around the crossing: a front smeared over them, or one that fills part of a cell,
        is placed without bias.
        """
        cell = self.depths[1] - self.depths[0]
        bottom = self.depths[-1] + 0.5 * cell
        wide = [(0, 0)] * (self.concentration.ndim - 1)
        padded = jnp.pad(jnp.pad(self.concentration, [*wide, (FRONT, 0)]), [*wide, (0, FRONT)], mode="edge")
        reached = self.concentration >= threshold
        first = jnp.argmax(reached, axis=-1)

        def near(shift: int) -> Any:
            return jnp.take_along_axis(padded, (first + FRONT + shift)[..., None], axis=-1)[..., 0]

        above, below = near(-FRONT), near(FRONT - 1)
        inside = sum(near(k) for k in range(1 - FRONT, FRONT - 1))
        count = 2 * FRONT - 2
        jump = jnp.where(below > above, below - above, 1.0)
        share = jnp.where(below > above, (count * below - inside) / jump, FRONT - 0.5)
        place = (first + 1 - FRONT + jnp.clip(share, 0.0, count)) * cell
        return bottom - jnp.where(jnp.any(reached, axis=-1), jnp.clip(place, 0.0, bottom), bottom)


class Cone(NamedTuple):
    """A tank whose lower part narrows to a smaller cross section.

    Parameters
    ----------
    height_share: of the cone in the depth. area_share: of the bottom in the area at the top.
    """

    height_share: Any
    area_share: Any

    def areas(self, cells: int) -> tuple[Any, Any]:
        """Cross section at the faces and mean of the cells, over that at the top; volumes are exact."""

        def filled(depth: Any) -> Any:
            """Volume above a depth (both as shares), from the cube of the narrowing diameter."""
            narrow = 1.0 - jnp.sqrt(self.area_share)
            x = jnp.clip((depth - 1.0 + self.height_share) / self.height_share, 0.0, 1.0)
            cone = self.height_share * (x - narrow * x**2 + narrow**2 * x**3 / 3.0)
            return jnp.minimum(depth, 1.0 - self.height_share) + cone

        edge = jnp.linspace(0.0, 1.0, cells + 1)
        x = jnp.clip((edge - 1.0 + self.height_share) / self.height_share, 0.0, 1.0)
        return (1.0 - (1.0 - jnp.sqrt(self.area_share)) * x) ** 2, jnp.diff(filled(edge)) * cells


def simulate(
    suspension: Suspension,
    depth: Any,
    initial: Any,
    operation: Operation,
    *,
    feed_depth: Any = 0.5,
    steps: Steps | None = None,
    cone: Cone | None = None,
) -> Simulation:
    """Follow a column through an operation.

    Parameters
    ----------
    depth: of the column, m. ``initial``: concentration of the cells from the top, kg/m³; its length is the
        number of cells.
    operation: times (edges of the intervals, s) and what is done in each.
    feed_depth: share of the depth at which the feed enters.
    steps: whole numbers of time steps; as many as stability asks for when not given. Fix them (see
        ``steps_needed``) for ``vmap`` and for reverse-mode derivatives; forward-mode derivatives need
        nothing.
    cone: narrowing of the lower part; flows stay those per area at the top.
    """
    suspension.check()
    initial = jnp.asarray(initial, dtype=float)
    if initial.ndim != 1 or initial.shape[0] < 3:
        raise InputError(_("A column needs at least three cells."))
    fixed = None if steps is None else Steps(*map(int, steps))
    return _run(suspension, jnp.asarray(depth, dtype=float), initial, operation, feed_depth, fixed, cone)


def settle(
    suspension: Suspension,
    height: Any,
    concentration: Any,
    times: Any,
    *,
    cells: int = 100,
    steps: Steps | None = None,
) -> Simulation:
    """Batch settling of a uniform suspension of a height and concentration, at given times (the first being
    the start).
    """
    intervals = jnp.shape(jnp.asarray(times))[0] - 1
    still = jnp.zeros(intervals)
    initial = jnp.broadcast_to(jnp.asarray(concentration, dtype=float), (cells,))
    return simulate(
        suspension,
        height,
        initial,
        Operation(jnp.asarray(times, dtype=float), still, still, still),
        steps=steps,
    )


class Steps(NamedTuple):
    """Time steps per interval, and short steps of compression in each."""

    steps: Any
    compression: Any


def steps_needed(
    suspension: Suspension, depth: Any, cells: int, operation: Operation, cone: Cone | None = None
) -> Steps:
    """Steps that keep the scheme monotone in every interval."""
    return Steps(
        *(
            jnp.ceil(jnp.max(count)).astype(int)
            for count in _steps_by_interval(suspension, depth, cells, operation, cone)
        )
    )


def _steps_by_interval(
    suspension: Suspension, depth: Any, cells: int, operation: Operation, cone: Cone | None
) -> Steps:
    """Steps as real numbers: the last one is shorter, so that a course has no jumps where a parameter asks
    for one step more.
    """
    speed, dense_speed, spread = suspension.fastest()
    size = depth / cells
    span, bulk = jnp.diff(operation.times), jnp.max(operation.feed_velocity)
    if cone is not None:
        faces, areas = cone.areas(cells)
        wider = jnp.max(faces[:-1] / areas)
        speed, dense_speed, spread, bulk = (
            speed * wider,
            dense_speed * wider,
            spread * wider,
            bulk / jnp.min(areas),
        )
    crossed = jnp.maximum((speed + bulk) / COURANT, (dense_speed + bulk) / BED_COURANT)
    steps = jnp.maximum(span * crossed / size, 1.0)
    return Steps(steps, jnp.maximum(2.0 * spread * span / (steps * size**2), 1.0))


def _part(number: Any, count: Any) -> Any:
    """Share of a whole that one of so many steps takes, a real number of which the last has what is left."""
    return jnp.minimum(1.0, count - number) / count


def _whole(count: Any) -> Any:
    return count if isinstance(count, int) else jnp.ceil(count).astype(int)


@eqx.filter_jit
def _run(
    suspension: Suspension,
    depth: Any,
    initial: Any,
    operation: Operation,
    feed_depth: Any,
    steps: Steps | None,
    cone: Cone | None,
) -> Simulation:
    cells = initial.shape[0]
    wide: Any
    inner_wide: Any
    wide, inner_wide, areas, roomy = 1.0, 1.0, jnp.ones(cells), 1.0
    if cone is not None:
        wide, areas = cone.areas(cells)
        inner_wide, roomy = wide[1:-1], jnp.pad(areas, 1, constant_values=1.0)
    size = depth / cells
    feed_cell = jnp.clip(jnp.floor(jnp.asarray(feed_depth) * cells), 0, cells - 1) + 1
    index, face = jnp.arange(cells + 2), jnp.arange(cells + 1)
    inside = (face > 0) & (face < cells)
    peak = suspension.peak()
    top_flux = suspension.flux(peak)
    velocity, compression = suspension.velocity_function(), suspension.compression
    critical = jnp.asarray(0.0 if compression is None else compression.critical_concentration, dtype=float)
    at_critical = 0.0 if compression is None else velocity(critical)
    # Whole numbers that are given stay outside the scan: a loop of known length has reverse-mode derivatives.
    counts = (
        lax.stop_gradient(_steps_by_interval(suspension, depth, cells, operation, cone))
        if steps is None
        else None
    )

    def interval(carry: Any, given: Any) -> Any:
        stable, span, q, qu, Cf = given
        count = stable if steps is None else steps
        # Faces under the feed carry the underflow down, those above the overflow up.
        downward, upward = jnp.where(face >= feed_cell, qu, 0.0), -jnp.where(face >= feed_cell, 0.0, q - qu)
        fed_here = jnp.where(index == feed_cell, q * Cf, 0.0)

        def step(i: Any, C: Any) -> Any:
            share = span * _part(i, count.steps) / size
            down, up, source = share * downward, share * upward, share * fed_here
            # The first and the last element are not cells: they gather what left over the weir and with the
            # underflow.
            v = velocity(C)
            f = C * v
            supply, demand = jnp.where(peak > C, f, top_flux), jnp.where(peak < C, f, top_flux)
            inner = (
                share * inner_wide * jnp.minimum(supply[1:-2], demand[2:-1])
                + down[1:-1] * C[1:-2]
                + up[1:-1] * C[2:-1]
            )
            # Joined from pieces, so that the compiler computes each face once and not anew for every
            # neighbor.
            faces = jnp.concatenate([up[:1] * C[1:2], inner, down[-1:] * C[-2:-1]])
            change = (source + jnp.concatenate([-faces[:1], faces[:-1] - faces[1:], faces[-1:]])) / roomy
            if compression is None:
                return C + change
            # Compression takes several short steps, each with its share of the change by flow, so that steady
            # states are
            # exact; its coefficient is kept meanwhile, but not what lies above the critical concentration:
            # the top of a bed
            # would come and go from step to step and never rest.
            # Where the bed is at rest the velocity cancels against that of the settling flux, which is the
            # one of the denser
            # cell: taken alike here, the bed does not stand too high on coarse grids.
            stiff, slow = (
                suspension.stiffness(jnp.maximum(C, critical)),
                jnp.where(critical < C, v, at_critical),
            )
            spread = (
                0.5
                * share
                / size
                * wide
                * inside
                * jnp.minimum(slow[1:], slow[:-1])
                * (stiff[1:] + stiff[:-1])
            )

            def compress(j: Any, C: Any) -> Any:
                bed = jnp.maximum(C, critical)
                rise = spread * (bed[1:] - bed[:-1])
                return C + _part(j, count.compression) * (
                    change + (jnp.pad(rise, (0, 1)) - jnp.pad(rise, (1, 0))) / roomy
                )

            return lax.fori_loop(0, _whole(count.compression), compress, C)

        held, over, under, fed = carry
        state = lax.fori_loop(0, _whole(count.steps), step, jnp.pad(held, 1))
        gone_over, gone_under = state[0] * size, state[-1] * size
        after = (state[1:-1], over + gone_over, under + gone_under, fed + q * Cf * span)
        qe = q - qu
        means = (
            gone_over / jnp.where(qe > 0, qe * span, jnp.inf),
            gone_under / jnp.where(qu > 0, qu * span, jnp.inf),
        )
        return after, (after, means)

    spans = jnp.diff(operation.times)
    given = tuple(jnp.broadcast_to(jnp.asarray(x, dtype=float), spans.shape) for x in operation[1:])
    zero = jnp.zeros(())
    first = (initial, zero, zero, zero)
    _last, (states, means) = lax.scan(interval, first, (counts, spans, *given))
    course = jax.tree.map(lambda a, b: jnp.concatenate([a[None], b]), first, states)
    depths = (jnp.arange(cells) + 0.5) * size
    return Simulation(
        operation.times, depths, course[0], means[0], means[1], course[1], course[2], course[3], areas
    )
