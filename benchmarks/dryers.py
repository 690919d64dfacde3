"""Ten thousand dryers by balance: the card of a dryer, and the unit with its heater, recycle and outlets as a
flowsheet has it.

    python -m benchmarks.dryers

Budget, warm: 0.2 s for ten thousand. No peer computes these.
"""

from __future__ import annotations

import time

import jax
import jax.numpy as jnp
import numpy as np

import granum as gr
from benchmarks.rows import Row, tell
from granum.drying.equipment.convective import ConvectiveDryer
from granum.streams.from_materials import mixture_of
from granum.streams.stream import empty

COUNT = 10_000
MIXTURE = mixture_of(["water"], ["starch"], ["dry air", "water"], [1e-3, 1e-2])


def best(job, *given, repeats: int = 15) -> float:
    """Best of several warm runs, s."""
    jax.block_until_ready(job(*given))
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        jax.block_until_ready(job(*given))
        times.append(time.perf_counter() - start)
    return min(times)


def card(T, end):
    """The balance of the maize dryer with losses and half of the air recirculated, from the temperature or
    the humidity of the outlet.
    """
    known = {"relative_humidity_outlet": end} if HUMID else {"temperature_outlet": end}
    return gr.drying.dryer_balance(
        mass_flow_inlet=1.0,
        moisture_dry_basis_inlet=0.54,
        moisture_dry_basis_outlet=0.18,
        temperature_fresh=298.15,
        relative_humidity_fresh=0.5,
        temperature_inlet=T,
        recirculated_fraction=0.5,
        heat_loss=2e4,
        temperature_product_inlet=290.0,
        temperature_product_outlet=315.0,
        **known,
    )


def unit(T, moisture):
    """The unit: outlet streams and duties."""
    feed = empty(MIXTURE, 290.0).replace(solid=jnp.array([[0.65]]), liquid=jnp.array([0.35]))
    gas = empty(MIXTURE, 298.15).replace(gas=jnp.array([20.0, 0.2]))
    dryer = ConvectiveDryer(
        temperature_inlet=T, moisture_outlet=moisture, recirculated_fraction=0.5, heat_loss=2e4
    )
    return dryer(feed, gas)


if __name__ == "__main__":
    draw = np.random.default_rng(0)
    T, moisture = draw.uniform(340.0, 400.0, COUNT), draw.uniform(0.1, 0.3, COUNT)
    HUMID = False
    seconds = best(jax.jit(jax.vmap(card)), T, draw.uniform(315.0, 330.0, COUNT))
    tell(Row("10 000 dryers by balance, outlet temperature given", seconds, kind="alone"))
    HUMID = True
    seconds = best(jax.jit(jax.vmap(lambda T, phi: card(T, phi))), T, draw.uniform(0.3, 0.8, COUNT))
    tell(Row("10 000 dryers by balance, outlet humidity given", seconds, kind="alone"))
    seconds = best(jax.jit(jax.vmap(unit)), T, moisture)
    tell(Row("10 000 dryers as units, product moisture given", seconds, kind="alone"))
