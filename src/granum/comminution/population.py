"""Population balance of grinding on size classes: exact, mass-conserving transfer operators.

Classes run from fine to coarse. An operator is a matrix, target class by source class, whose columns add up
to 1.

The laws may mean two things, and parameters are tied to what they were fitted with (``Convention``):

* ``continuous``: rate and fragments of a particle of a size. They are averaged over each class; fragments
    that stay in the class of their parent are counted there. The result converges with the square of the
    class width, on any classes.
* ``root_two``: Austin's discrete convention, in which most constants are published. The rate is that at which
    a root-two class loses mass, by its upper limit; all fragments leave the class, measured from its lower
    limit. Only right on the classes of the fit, so other classes are refused.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any, Literal

import equinox as eqx
import jax.numpy as jnp
import jax.scipy.linalg as linalg
import numpy as np

from granum.core import law
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import OpenFraction, Ratio, Time, Within

Convention = Literal["continuous", "root_two"]
# Nominal openings of root-two sieves (ISO 565, R20/3) stray by up to 1.8 % (180 over 125 µm).
_ROOT_TWO_TOLERANCE = 0.025
# lifetimes after which a batch is ground; the matrix exponential is NaN where it would square more often
GROUND, SQUARINGS = 2e6, 20
_NODES, _WEIGHTS = (
    0.5 * (np.polynomial.legendre.leggauss(3)[0] + 1.0),
    0.5 * np.polynomial.legendre.leggauss(3)[1],
)


def _checked_root_two(edges: Any) -> None:
    limits = np.asarray(edges, dtype=float)[1:]
    off = np.abs(limits[1:] / limits[:-1] / np.sqrt(2.0) - 1.0)
    if np.any(off > _ROOT_TWO_TOLERANCE):
        ratio = float((limits[1:] / limits[:-1])[np.argmax(off)])
        raise InputError(
            _(
                "With the convention 'root_two' the breakage laws hold on classes whose limits have the "
                "ratio 1.414; here two limits have {ratio:.4g}. "
                "Give root-two classes, or laws fitted to single sizes and the convention 'continuous'."
            ).format(ratio=ratio),
            name="breakage_convention",
            value="root_two",
        )


def _below(ratio: Any, breakage: Any) -> Any:
    """Fragments below a size, by that size over the parent's; whatever is not below the parent is all of
    them.
    """
    return jnp.where(ratio >= 1.0 - 1e-12, 1.0, breakage(jnp.minimum(ratio, 1.0)))


def _root_two_fragments(edges: Any, breakage: Any) -> Any:
    lower = edges[:-1]
    n = lower.shape[0]
    parts = jnp.diff(
        _below(edges[1:, None] / jnp.where(lower > 0, lower, 1.0)[None, :], breakage), axis=0, prepend=0.0
    )
    return jnp.where(jnp.arange(n)[:, None] < jnp.arange(n)[None, :], parts, 0.0)


def _parents(edges: Any) -> Any:
    """Sizes that stand for each class but the finest, class by node: evenly spread over the logarithm of
    size.
    """
    return edges[1:-1, None] ** (1.0 - _NODES) * edges[2:, None] ** _NODES


def _averaged(edges: Any, breakage: Any, weight: Any) -> Any:
    """Fragments by class of every parent class, averaged with a weight on its nodes; none of the finest
    class.
    """
    below = _below(edges[1:, None, None] / _parents(edges)[None], breakage)
    parts = jnp.sum(jnp.diff(below, axis=0, prepend=0.0) * (weight * _WEIGHTS)[None], axis=-1)
    return jnp.pad(parts, ((0, 0), (1, 0)))


def fragments(edges: Any, breakage: Any, convention: Convention = "continuous") -> Any:
    """Fragments by class of each parent class, columns adding up to 1; the finest class, which does not
    break, has none.

    >>> from granum.comminution.breakage import AustinBreakage
    >>> b = fragments(jnp.array([0.0, 1e-4, 2e-4, 2.8e-4]), AustinBreakage(1.0, 1.0, 4.0), "continuous")
    >>> [round(float(x), 3) for x in b[:, 1]]
    [0.721, 0.279, 0.0]
    """
    sizes = jnp.asarray(edges, dtype=float)
    if convention == "root_two":
        _checked_root_two(edges)
        return _root_two_fragments(sizes, breakage)
    return _averaged(sizes, breakage, jnp.ones_like(_NODES))


def rate_matrix(edges: Any, selection: Any, breakage: Any, convention: Convention = "continuous") -> Any:
    """Matrix A of dm/dt = A m: breakage out of each class and fragments into finer ones; columns add up to 0.

    The finest class does not break any further.
    """
    sizes = jnp.asarray(edges, dtype=float)
    n = sizes.shape[0] - 1
    if convention == "root_two":
        _checked_root_two(edges)
        rate = selection(sizes[1:]) * (jnp.arange(n) > 0)
        return (_root_two_fragments(sizes, breakage) - jnp.eye(n)) * rate[None, :]
    rates = selection(_parents(sizes))
    return _averaged(sizes, breakage, rates) - jnp.diag(jnp.pad(rates @ jnp.asarray(_WEIGHTS), (1, 0)))


def batch_operator(matrix: Any, time: Any) -> Any:
    """Exact effect of grinding a batch for a time: the matrix exponential.

    After ``GROUND`` lifetimes of the class that breaks fastest nothing changes any more, and squaring further
    would only gather rounding.
    """
    fastest = jnp.max(-jnp.diagonal(matrix))
    longest = GROUND / jnp.where(fastest > 0.0, fastest, 1.0)
    return linalg.expm(
        matrix * jnp.where(fastest > 0.0, jnp.minimum(time, longest), time), max_squarings=SQUARINGS
    )


def reid_solution(matrix: Any, mass: Any, time: Any) -> Any:
    """Reid's closed solution of batch grinding, a sum of exponentials; the rates of all classes must differ.

    Slower and narrower than ``batch_operator``; kept as the analytic check of it.
    """
    matrix, mass = jnp.asarray(matrix, dtype=float), jnp.asarray(mass, dtype=float)
    n = mass.shape[0]
    rate = -jnp.diagonal(matrix)
    modes = jnp.zeros((n, n))
    for i in range(n - 1, -1, -1):  # from the coarsest class down
        row = matrix[i] @ modes * (jnp.arange(n) > i)
        row = jnp.where(jnp.arange(n) > i, row / jnp.where(jnp.arange(n) > i, rate[i] - rate, 1.0), 0.0)
        modes = modes.at[i].set(row).at[i, i].set(mass[i] - jnp.sum(row))
    return modes @ jnp.exp(-rate * time)


class ResidenceTimeLaw(eqx.Module):
    """How long material stays: an operator for linear kinetics."""

    @abstractmethod
    def __call__(self, residence_time: Time, time: Time) -> Ratio:
        """Part of the material that leaves later than a time."""

    @abstractmethod
    def operator(self, matrix: Any, residence_time: Any) -> Any:
        """Feed to product for linear kinetics dm/dt = A m."""


def _mixed(matrix: Any, residence_time: Any) -> Any:
    return jnp.linalg.inv(jnp.eye(matrix.shape[0]) - matrix * residence_time)


@law(
    "residence_time_law",
    name="plug_flow",
    source="levenspiel1999",
    title="Plug flow",
    equation=r"E(t) = \delta(t - \tau)",
)
class PlugFlow(ResidenceTimeLaw):
    """Everything stays for the same time."""

    def __call__(self, residence_time: Time, time: Time) -> Ratio:
        """Part of the material that leaves later than a time."""
        return jnp.where(jnp.asarray(time) < residence_time, 1.0, 0.0)

    def operator(self, matrix: Any, residence_time: Any) -> Any:
        """The batch operator at the mean time."""
        return batch_operator(matrix, residence_time)


@law(
    "residence_time_law",
    name="tanks_in_series",
    source="levenspiel1999",
    title="Equal tanks in series",
    equation=r"\left(I - A\tau/N\right)^{-N}",
)
class TanksInSeries(ResidenceTimeLaw):
    """Equal stirred tanks in a row; one is a fully mixed mill, many approach plug flow."""

    tank_count: Annotated[int, Within(1, 1000)] = 1

    def __call__(self, residence_time: Time, time: Time) -> Ratio:
        """Part of the material that leaves later than a time."""
        t = self.tank_count * jnp.asarray(time, dtype=float) / residence_time
        term, total = jnp.ones_like(t), jnp.ones_like(t)
        for k in range(1, self.tank_count):
            term = term * t / k
            total = total + term
        return total * jnp.exp(-t)

    def operator(self, matrix: Any, residence_time: Any) -> Any:
        """The power of the operator of one tank."""
        return jnp.linalg.matrix_power(_mixed(matrix, residence_time / self.tank_count), self.tank_count)


@law(
    "residence_time_law",
    name="large_and_two_small",
    source="austin1984, ch. 14",
    title="One large and two small tanks (ball mills)",
    equation=r"(I - A\tau_1)^{-1} (I - A\tau_2)^{-2},\ \tau_1 + 2\tau_2 = \tau",
)
class LargeAndTwoSmall(ResidenceTimeLaw):
    """A large stirred tank followed by two equal small ones, as tracer tests of tumbling mills show; 0.7 and
    2 × 0.15 are usual.
    """

    large_share: Annotated[OpenFraction, Within(0.34, 0.999)] = 0.7

    def __call__(self, residence_time: Time, time: Time) -> Ratio:
        """Part of the material that leaves later than a time."""
        a, b = self.large_share * residence_time, 0.5 * (1.0 - self.large_share) * residence_time
        t, r = jnp.asarray(time, dtype=float), a - b
        large = (a / r) ** 2 * jnp.exp(-t / a)
        return large + (1.0 - (a / r) ** 2 - t / r) * jnp.exp(-t / b)

    def operator(self, matrix: Any, residence_time: Any) -> Any:
        """The product of the operators of the tanks."""
        small = _mixed(matrix, 0.5 * (1.0 - self.large_share) * residence_time)
        return small @ small @ _mixed(matrix, self.large_share * residence_time)
