"""What a residual costs: squared, or growing only linearly beyond a threshold so that stray points lose their
pull.
"""

from __future__ import annotations

import abc
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Loss(abc.ABC):
    """A loss rho(z) of the squared residual z = (residual / (threshold · scale))², with its first two
    derivatives.

    ``threshold`` is counted in robust standard deviations of the residuals; the scale is found with the fit.
    """

    threshold: float = np.inf

    @abc.abstractmethod
    def rho(self, z: np.ndarray) -> np.ndarray:
        """Rows: rho, rho', rho'' at z, as SciPy takes them."""

    def influence(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """psi(u) and its derivative at residuals in units of the scale: what enters the covariance."""
        c = self.threshold
        _, first, second = self.rho((u / c) ** 2)
        return u * first, first + 2.0 * (u / c) ** 2 * second

    @property
    def robust(self) -> bool:
        """Whether large residuals are weighted down."""
        return np.isfinite(self.threshold)


@dataclass(frozen=True)
class LeastSquares(Loss):
    """Ordinary least squares."""

    def rho(self, z: np.ndarray) -> np.ndarray:
        return np.stack([z, np.ones_like(z), np.zeros_like(z)])


@dataclass(frozen=True)
class Huber(Loss):
    """Squared up to the threshold, linear beyond (Huber 1964); 95 % efficient on normal errors at 1.345."""

    threshold: float = 1.345

    def rho(self, z: np.ndarray) -> np.ndarray:
        beyond = z > 1.0
        root = np.sqrt(np.where(beyond, z, 1.0))
        return np.stack(
            [
                np.where(beyond, 2.0 * root - 1.0, z),
                np.where(beyond, 1.0 / root, 1.0),
                np.where(beyond, -0.5 / root**3, 0.0),
            ]
        )


@dataclass(frozen=True)
class SoftL1(Loss):
    """Smooth passage from squared to linear: 2(√(1+z) − 1)."""

    threshold: float = 1.345

    def rho(self, z: np.ndarray) -> np.ndarray:
        root = np.sqrt(1.0 + z)
        return np.stack([2.0 * (root - 1.0), 1.0 / root, -0.5 / root**3])
