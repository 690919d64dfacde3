"""Population balance of grinding on size classes: exact, mass-conserving transfer operators.

Classes run from fine to coarse. An operator is a matrix, target class by source class, whose columns add up to 1.
"""

from __future__ import annotations

from abc import abstractmethod
from typing import Annotated, Any

import equinox as eqx
import jax.numpy as jnp
import jax.scipy.linalg as linalg

from granum.core import law
from granum.core.kinds import OpenFraction, Ratio, Time, Within


def fragments(edges: Any, breakage: Any) -> Any:
    """Fragments by class of each parent class: zero on and above the diagonal, columns adding up to 1 (the finest class has none).

    >>> from granum.comminution.breakage import AustinBreakage
    >>> b = fragments(jnp.array([0.0, 1e-4, 2e-4, 4e-4]), AustinBreakage(1.0, 1.0, 4.0))
    >>> [[round(float(x), 3) for x in row] for row in b]
    [[0.0, 1.0, 0.5], [0.0, 0.0, 0.5], [0.0, 0.0, 0.0]]
    """
    edges = jnp.asarray(edges, dtype=float)
    lower = edges[:-1]
    usable = lower > 0
    ratio = edges[1:, None] / jnp.where(usable, lower, 1.0)[None, :]
    below = jnp.where(ratio >= 1.0 - 1e-12, 1.0, breakage(jnp.minimum(ratio, 1.0)))
    parts = jnp.diff(below, axis=0, prepend=0.0)
    n = lower.shape[0]
    return jnp.where(jnp.arange(n)[:, None] < jnp.arange(n)[None, :], parts, 0.0)


def rate_matrix(edges: Any, selection: Any, breakage: Any) -> Any:
    """Matrix A of dm/dt = A m: breakage out of each class and fragments into finer ones; columns add up to 0.

    The size of a class, for its rate, is its upper limit; the finest class does not break any further.
    """
    edges = jnp.asarray(edges, dtype=float)
    b = fragments(edges, breakage)
    rate = selection(edges[1:]) * (jnp.arange(edges.shape[0] - 1) > 0)
    return (b - jnp.eye(b.shape[0])) * rate[None, :]


def batch_operator(matrix: Any, time: Any) -> Any:
    """Exact effect of grinding a batch for a time: the matrix exponential."""
    return linalg.expm(matrix * time)


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


@law("residence_time_law", name="plug_flow", source="levenspiel1999", title="Plug flow", equation=r"E(t) = \delta(t - \tau)")
class PlugFlow(ResidenceTimeLaw):
    """Everything stays for the same time."""

    def __call__(self, residence_time: Time, time: Time) -> Ratio:
        """Part of the material that leaves later than a time."""
        return jnp.where(jnp.asarray(time) < residence_time, 1.0, 0.0)

    def operator(self, matrix: Any, residence_time: Any) -> Any:
        """The batch operator at the mean time."""
        return batch_operator(matrix, residence_time)


@law("residence_time_law", name="tanks_in_series", source="levenspiel1999", title="Equal tanks in series",
     equation=r"\left(I - A\tau/N\right)^{-N}")  # fmt: skip
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


@law("residence_time_law", name="large_and_two_small", source="austin1984, ch. 14", title="One large and two small tanks (ball mills)",
     equation=r"(I - A\tau_1)^{-1} (I - A\tau_2)^{-2},\ \tau_1 + 2\tau_2 = \tau")  # fmt: skip
class LargeAndTwoSmall(ResidenceTimeLaw):
    """A large stirred tank followed by two equal small ones, as tracer tests of tumbling mills show; 0.7 and 2 × 0.15 are usual."""

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
