"""Slowing of a sphere on the axis of a cylinder: velocity in the vessel over velocity in an unbounded
fluid.
"""

from __future__ import annotations

from typing import Annotated, Any

import jax.numpy as jnp

from granum.core import formula
from granum.core.kinds import Law, PositiveNumber, Ratio, Velocity, Within

WallRatio = Annotated[Ratio, Within(0.0, 0.999)]


@formula(
    source="haberman1958; clift1978, table 9.2",
    equation=r"k = \frac{1 - 2.105\lambda + 2.0865\lambda^3 - 1.7068\lambda^5 + 0.72603\lambda^6}{1 - 0.75857\lambda^5}",  # noqa: E501
    fitted={"wall_ratio": (0.0, 0.8), "reynolds": (0.0, 0.1)},
)
def wall_factor_haberman_sayre(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a rigid sphere in creeping flow by Haberman and Sayre.

    >>> round(wall_factor_haberman_sayre(wall_ratio=0.1), 4)
    0.7916
    """
    x = wall_ratio
    k = (1.0 - 2.105 * x + 2.0865 * x**3 - 1.7068 * x**5 + 0.72603 * x**6) / (1.0 - 0.75857 * x**5)
    return jnp.broadcast_arrays(k, reynolds)[0]


@formula(
    source="francis1933; clift1978, table 9.2",
    equation=r"k = \left(\frac{1-\lambda}{1-0.475\lambda}\right)^4",
    fitted={"wall_ratio": (0.0, 0.97), "reynolds": (0.0, 1.0)},
)
def wall_factor_francis(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a rigid sphere in creeping flow by Francis, over nearly the whole range of size ratios.

    Textbooks also quote (1 − λ)^2.25 under his name: see ``wall_factor_francis_power``.

    >>> round(wall_factor_francis(wall_ratio=0.1), 4)
    0.7971
    """
    x = wall_ratio
    return jnp.broadcast_arrays(((1.0 - x) / (1.0 - 0.475 * x)) ** 4, reynolds)[0]


@formula(
    source="richardson2002, section 3.3.2",
    equation=r"k = (1-\lambda)^{2.25}\quad (\mathrm{Re}<0.2)",
    fitted={"wall_ratio": (0.0, 0.97), "reynolds": (0.0, 0.2)},
)
def wall_factor_francis_power(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a rigid sphere in creeping flow, the power that textbooks quote from Francis.

    >>> round(wall_factor_francis_power(wall_ratio=0.1), 4)
    0.7889
    """
    return jnp.broadcast_arrays((1.0 - wall_ratio) ** 2.25, reynolds)[0]


@formula(
    source="ladenburg1907; richardson2002, section 3.3.2",
    equation=r"k = \frac{1}{1 + 2.4\lambda}",
    fitted={"wall_ratio": (0.0, 0.1), "reynolds": (0.0, 0.2)},
)
def wall_factor_ladenburg(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a small rigid sphere in creeping flow by Ladenburg.

    >>> round(wall_factor_ladenburg(wall_ratio=0.1), 4)
    0.8065
    """
    return jnp.broadcast_arrays(1.0 / (1.0 + 2.4 * wall_ratio), reynolds)[0]


@formula(
    source="faxen1923; clift1978, table 9.2",
    equation=r"k = 1 - 2.104\lambda + 2.09\lambda^3 - 0.95\lambda^5",
    fitted={"wall_ratio": (0.0, 0.6), "reynolds": (0.0, 0.1)},
    typical={"wall_ratio": (0.0, 0.4)},
)
def wall_factor_faxen(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a rigid sphere in creeping flow by Faxén.

    >>> round(wall_factor_faxen(wall_ratio=0.1), 4)
    0.7917
    """
    x = wall_ratio
    return jnp.broadcast_arrays(1.0 - 2.104 * x + 2.09 * x**3 - 0.95 * x**5, reynolds)[0]


@formula(
    source="munroe1888; clift1978, chapter 9",
    equation=r"k = 1 - \lambda^{3/2}",
    fitted={"wall_ratio": (0.0, 0.8), "reynolds": (1e3, 1e5)},
)
def wall_factor_munroe(wall_ratio: WallRatio, reynolds: PositiveNumber = 1e4) -> Ratio:
    """Wall factor of a rigid sphere in turbulent flow by Munroe.

    >>> round(wall_factor_munroe(wall_ratio=0.25), 4)
    0.875
    """
    positive = wall_ratio > 0.0
    return jnp.broadcast_arrays(
        1.0 - jnp.where(positive, jnp.where(positive, wall_ratio, 1.0) ** 1.5, 0.0), reynolds
    )[0]


@formula(
    source="difelice1996",
    equation=r"k = \left(\frac{1-\lambda}{1-0.33\lambda}\right)^{\alpha},\quad \frac{3.3-\alpha}{\alpha-0.85} = 0.1\,\mathrm{Re}",  # noqa: E501
    fitted={"wall_ratio": (0.0, 0.97), "reynolds": (0.0, 3e4)},
)
def wall_factor_di_felice(wall_ratio: WallRatio, reynolds: PositiveNumber = 0.01) -> Ratio:
    """Wall factor of a rigid sphere from creeping to turbulent flow by Di Felice, on the unbounded Reynolds
    number.

    >>> round(wall_factor_di_felice(wall_ratio=0.25, reynolds=0.5), 4)
    0.5264
    >>> round(wall_factor_di_felice(wall_ratio=0.25, reynolds=1e-9), 4)
    0.5142
    """
    alpha = (3.3 + 0.085 * reynolds) / (1.0 + 0.1 * reynolds)
    return ((1.0 - wall_ratio) / (1.0 - 0.33 * wall_ratio)) ** alpha


@formula(
    source="kehlenbeck1999",
    equation=r"k = \frac{1-\lambda^p}{1+(\lambda/\lambda_0)^p},\ \frac{\lambda_0-0.283}{1.2-\lambda_0} = 0.041\,\mathrm{Re}^{0.524},"  # noqa: E501
    r"\ p = 1.44+0.5466\,\mathrm{Re}^{0.434}\ (\mathrm{Re}\le35),\ 2.3+37.3\,\mathrm{Re}^{-0.8686}",
    fitted={"wall_ratio": (0.0, 0.9), "reynolds": (2.0, 185.0)},
    typical={"wall_ratio": (0.05, 0.8)},
)
def wall_factor_kehlenbeck_di_felice(wall_ratio: WallRatio, reynolds: PositiveNumber = 20.0) -> Ratio:
    """Wall factor of a rigid sphere in the intermediate regime by Kehlenbeck and Di Felice, on the unbounded
    Reynolds number.

    >>> round(wall_factor_kehlenbeck_di_felice(wall_ratio=0.001, reynolds=20.0), 4)
    1.0
    """
    Re = reynolds
    w = 0.041 * Re**0.524
    centre = (0.283 + 1.2 * w) / (1.0 + w)
    p = jnp.where(Re <= 35.0, 1.44 + 0.5466 * Re**0.434, 2.3 + 37.3 * Re**-0.8686)
    x = jnp.maximum(wall_ratio, 1e-12)
    return (1.0 - x**p) / (1.0 + (x / centre) ** p)


@formula(
    source="difelice1996; clift1978, chapter 9",
    title="Terminal velocity between walls",
    equation=r"v = v_t\,k(\lambda, \mathrm{Re})",
    symbols={"=terminal_velocity": "v"},
)
def terminal_velocity_bounded(
    terminal_velocity: Velocity,
    wall_ratio: WallRatio,
    reynolds: PositiveNumber,
    wall_factor: Annotated[Any, Law("wall_factor")] = wall_factor_di_felice,
) -> Velocity:
    """Terminal velocity on the axis of a cylinder, by any wall factor.

    >>> round(terminal_velocity_bounded(terminal_velocity=0.01, wall_ratio=0.1, reynolds=0.01), 5)
    0.00789
    """
    return terminal_velocity * wall_factor(wall_ratio, reynolds)
