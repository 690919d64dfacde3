"""Several salts in water: activities by Pitzer's equations for mixtures of ions."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

from granum.core import formula
from granum.core.kinds import PositiveNumber
from granum.materials.formulas.activity import DISTANCE, WATER, fading, usual_exponents


class Coefficients(NamedTuple):
    """Those of a mixture at a temperature.

    slope: of Debye and Hückel.
    beta_zero, beta_one, c_phi: of each cation (rows) with each anion; beta_two too, where there is any.
    exponents: with which beta one and two of each cation with each anion fade, the usual ones unless given.
    theta_cations, psi_cations: of two cations, and of both with each anion; zeros where there is one.
    theta_anions, psi_anions: of two anions, and of both with each cation.
    """

    slope: Any
    beta_zero: Any
    beta_one: Any
    c_phi: Any
    theta_cations: Any
    psi_cations: Any
    theta_anions: Any
    psi_anions: Any
    beta_two: Any = 0.0
    exponents: Any = None


@formula(
    source="pitzer1975, eq. 47",
    equation=r"J = \frac{x}{4 + 4.581\,x^{-0.7237}\exp\left(-0.0120\,x^{0.528}\right)}",
    typical={"electrostatic_mixing_argument": (0.1, 50.0)},
    title="Electrostatic function of unsymmetrical mixing (Pitzer)",
)
def electrostatic_mixing_function(electrostatic_mixing_argument: PositiveNumber) -> PositiveNumber:
    """What two like ions of unequal charge do to each other by their charges alone, from Pitzer's fit to the
    integral.

    >>> round(electrostatic_mixing_function(electrostatic_mixing_argument=1.0), 4)
    0.1173
    """
    x = electrostatic_mixing_argument
    return x / (4.0 + 4.581 * x**-0.7237 * jnp.exp(-0.0120 * x**0.528))


def _unlike(one: int, other: int, I: Any, slope: Any) -> Any:
    """What two like ions do to each other by their charges alone; nothing where these are the same."""
    if one == other:
        return 0.0
    x = 6.0 * slope * jnp.sqrt(I) * jnp.array([one * other, one**2, other**2])
    J = electrostatic_mixing_function.function(x)
    return one * other / (4.0 * I) * (J[0] - 0.5 * J[1] - 0.5 * J[2])


def excess(m: Any, charges: tuple[tuple[int, ...], tuple[int, ...]], given: Coefficients) -> Any:
    """Excess Gibbs energy over RT for a kilogram of water, at molalities of one or two cations and one or two
    anions, their charges without sign; its derivatives are the logarithms of the activity coefficients.
    """
    positive, negative = charges
    z = jnp.array([*positive, *negative], dtype=float)
    I, charge = 0.5 * jnp.sum(m * z**2), 0.5 * jnp.sum(m * z)
    root = jnp.sqrt(I)
    fades = given.exponents
    if fades is None:
        usual = [[usual_exponents(c, a) for a in negative] for c in positive]
        fades = np.moveaxis(np.array(usual), -1, 0)
    cations, anions = m[: len(positive)], m[len(positive) :]
    third = given.c_phi / (2.0 * np.sqrt(np.outer(positive, negative)))
    total = -given.slope * 4.0 * I / DISTANCE * jnp.log1p(DISTANCE * root)
    second = given.beta_zero + given.beta_one * fading(fades[0] * root)
    if not isinstance(given.beta_two, float):  # none at all is most often so
        second = second + given.beta_two * fading(fades[1] * root)
    total = total + 2.0 * cations @ (second + charge * third) @ anions
    if len(positive) == 2:
        mixing = 2.0 * (given.theta_cations + _unlike(*positive, I, given.slope))
        total = total + cations[0] * cations[1] * (mixing + anions @ given.psi_cations)
    if len(negative) == 2:
        mixing = 2.0 * (given.theta_anions + _unlike(*negative, I, given.slope))
        total = total + anions[0] * anions[1] * (mixing + cations @ given.psi_anions)
    return total


def log_activities(
    m: Any, charges: tuple[tuple[int, ...], tuple[int, ...]], given: Coefficients
) -> tuple[Any, Any]:
    """Logarithm of the activity coefficient of each ion and of the activity of water."""
    total, log_gamma = jax.value_and_grad(excess)(m, charges, given)
    return log_gamma, -WATER * (jnp.sum(m) + jnp.sum(m * log_gamma) - total)
