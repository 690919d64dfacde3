"""``AbstractIsotherm``: what every sorption isotherm can do."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp

from granum.core import flags
from granum.core.constants import GAS_CONSTANT
from granum.numerics import find_root

WATER_MOLAR_MASS = 0.018015268
ROOM = 298.15
# water activities between which an inverse without closed form is sought
SMALLEST, LARGEST = 1e-9, 1.0 - 1e-9

BEND = 1e-3  # kg/kg over which an equation that ends at some water activity runs out to dry


class AbstractIsotherm(eqx.Module):
    """Equilibrium moisture, dry basis, as a function of water activity and temperature.

    ``curve`` names the family of curves at one temperature: models of one name draw the same curves and
    differ in their letters only.
    """

    curve: eqx.AbstractClassVar[str]

    @abstractmethod
    def moisture(self, a: Any, T: Any) -> Any:
        """Equilibrium moisture, kg/kg dry."""

    @abstractmethod
    def activity(self, X: Any, T: Any) -> Any:
        """Water activity in equilibrium with a moisture."""

    def told_activity(self, X: Any, T: Any) -> Any:
        """The same, told where it lies outside the ranges of the law."""
        a = self.activity(X, T)
        self.tell(a, T)
        return a

    def tell(self, a: Any, T: Any) -> None:
        """Where water activity or temperature lie outside the ranges of the law."""
        found = {"water_activity": a, "temperature": T}
        card = getattr(self, "card", None)  # a module written for a purpose has none
        if card is not None:
            flags.ranged(card, {name: found[name] for name in card.fitted if name in found})

    def net_isosteric_heat(self, X: Any, T: Any) -> Any:
        """Heat of sorption beyond vaporization, J/kg of water: −(R/M_w) [∂ ln a/∂(1/T)]_X
        (Clausius–Clapeyron).
        """
        X, T = jnp.broadcast_arrays(jnp.asarray(X, dtype=float), jnp.asarray(T, dtype=float))
        slope = jax.jvp(lambda T: jnp.log(self.activity(X, T)), (T,), (jnp.ones_like(T),))[1]
        return GAS_CONSTANT / WATER_MOLAR_MASS * T**2 * slope


def activity_by_search(isotherm: AbstractIsotherm, X: Any, T: Any, highest: float = LARGEST) -> Any:
    """Water activity of a moisture by a bracketed root; 0 below and 1 above what the isotherm reaches."""
    X, T = jnp.broadcast_arrays(jnp.asarray(X, dtype=float), jnp.asarray(T, dtype=float))
    low, high = (isotherm.moisture(jnp.full_like(X, a), T) for a in (SMALLEST, highest))
    inside = jnp.clip(X, low, high)
    root = find_root(
        lambda a, X, T: isotherm.moisture(a, T) - X, SMALLEST, highest, inside, T, start=0.5
    ).value
    return jnp.where(low >= X, SMALLEST, jnp.where(high <= X, highest, root))


def run_out(X: Any) -> Any:
    """Moisture of an equation that falls below nothing: bent to nothing. A sharp end, below which gas takes
    or gives no water, leaves a dryer whose solid is nearly dry without a state to settle in.
    """
    return BEND * jnp.logaddexp(X / BEND, 0.0)


def before_bend(X: Any) -> Any:
    """What the equation gave before `run_out`."""
    X = jnp.maximum(X, 1e-30)
    return X + BEND * jnp.log(-jnp.expm1(-X / BEND))


def bounded(a: Any) -> Any:
    """A water activity kept strictly inside 0 … 1, where every isotherm has a value."""
    return jnp.clip(a, SMALLEST, LARGEST)
