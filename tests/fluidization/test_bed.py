"""The fluidized bed in streams: balances close, fines leave, the steady balance of the bed holds."""

from __future__ import annotations

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.fluidization.equipment.bed import FluidizedBed
from granum.streams.audit import closure
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import empty

EDGES = tuple(np.geomspace(2e-5, 1e-3, 11))
MIXTURE = Mixture(
    solids=(Species("sand", (("sand", 1.0),), (2600.0,), (800.0,)),),
    liquids=(),
    gases=(Species("air", (("air", 1.0),), (1.2,), (1005.0,), molar_mass=0.02896),),
    size_edges=EDGES,
    gas_viscosity=lambda _w, T: 1.8e-5,
)


def test_balance_and_entrainment() -> None:
    feed = empty(MIXTURE).replace(
        solid=jnp.full((1, 10), 0.05), gas=jnp.array([1.2]), pressure=jnp.asarray(1.1e5)
    )
    bed = FluidizedBed(area=1.5, mass=800.0)
    out = eqx.filter_jit(bed)(feed)
    assert float(closure([feed], list(out)).mass) < 1e-12
    assert float(jnp.max(jnp.abs(out.gas.solid + out.product.solid - feed.solid))) < 1e-15
    share = np.asarray(out.gas.solid / feed.solid)[0]
    assert np.all(np.diff(share) <= 0)
    assert share[0] > 0.5
    assert share[-1] == 0.0
    # what is entrained of a class is K* A times its fraction in the bed, which is that of the product
    fraction = np.asarray(out.product.solid / jnp.sum(out.product.solid))[0]
    np.testing.assert_allclose(
        np.asarray(out.gas.solid)[0], np.asarray(bed.rates(feed, bed.inside(feed)))[0] * fraction, rtol=1e-6
    )
    figures = bed.operate(feed=feed).figures
    assert all(np.isfinite(float(x)) for x in figures)
    assert figures.minimum_fluidization_velocity < figures.superficial_velocity
    # weight on the grid by hand, 30 % more for the plate
    assert abs(float(figures.pressure_drop) / (800 * 9.80665 / 1.5 * 1.3) - 1.0) < 1e-3
    assert len(bed.operate(feed=feed).checks) == 3


def test_sizing() -> None:
    bed = FluidizedBed.size(
        gas_volume_flow=1.0, superficial_velocity=0.5, residence_time=600.0, solid_mass_flow=0.5
    )
    assert (bed.area, bed.mass) == (2.0, 300.0)


def test_empty_streams_give_numbers() -> None:
    bed = FluidizedBed(area=1.5, mass=800.0)
    for solid, gas in ((0.0, 1.2), (0.05, 0.0), (0.0, 0.0)):
        feed = empty(MIXTURE).replace(solid=jnp.full((1, 10), solid), gas=jnp.array([gas]))
        out = bed(feed)
        assert all(np.isfinite(float(x)) for x in bed.operate(feed=feed).figures)
        assert np.all(np.isfinite(np.asarray(out.product.solid)))
        assert gas > 0 or not all(check.ok for check in bed.operate(feed=feed).checks)
