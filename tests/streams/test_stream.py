"""Streams: bookkeeping, mixing, enthalpy. Expected values are hand calculations on constant properties."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.sharing.streams import WATER

from granum.core.errors import InputError
from granum.streams.audit import closure
from granum.streams.equipment.basics import Heater, Mixer, Splitter
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty

VAPOR = Species("water", (("water", 1.0),), (), (2000.0,), 2.5e6, 0.018)
AIR = Species("air", (("air", 1.0),), (), (1000.0,), 0.0, 0.029)
SALT = Species("salt", (("salt", 1.0),), (2000.0,), (800.0,), -1e5, 0.1)
HYDRATE = Species("hydrate", (("salt", 0.6), ("water", 0.4)), (1800.0,), (1200.0,), -2e5, 0.15)
BRINE = Species("salt", (("salt", 1.0),), (2500.0,), (1000.0,), 0.0, 0.1)
MIXTURE = Mixture(
    (SALT, HYDRATE), (WATER, BRINE), (AIR, VAPOR), (0.0, 1e-4, 2e-4, 4e-4), (("porosity", (0.0, 0.5, 1.0)),)
)


def stream(temperature: float = 300.0, water: float = 1.0, salt: float = 0.5, solid: float = 0.1) -> Stream:
    return empty(MIXTURE, temperature).replace(
        liquid=jnp.array([water, salt]), solid=jnp.full(MIXTURE.solid_shape, solid)
    )


def test_hydrate_counts_as_its_components() -> None:
    s = empty(MIXTURE).replace(solid=jnp.zeros(MIXTURE.solid_shape).at[1, 0, 0].set(10.0))
    assert dict(zip(MIXTURE.components, np.asarray(s.components), strict=True)) == pytest.approx(
        {"water": 4.0, "salt": 6.0, "air": 0.0}
    )


def test_mixing_two_liquids_weighs_their_heats() -> None:
    hot, cold = (
        empty(MIXTURE, T).replace(liquid=jnp.array([m, 0.0])) for T, m in ((350.0, 1.0), (290.0, 2.0))
    )
    assert float((hot + cold).temperature) == pytest.approx((350.0 + 2 * 290.0) / 3, abs=1e-9)


def test_vapor_into_air_brings_its_heat_of_vaporization() -> None:
    steam = empty(MIXTURE, 373.15).replace(gas=jnp.array([0.0, 1.0]))
    assert float(steam.enthalpy_flow) == pytest.approx(2.5e6 + 2000.0 * 100.0)


def test_volumes_and_fractions() -> None:
    s = empty(MIXTURE).replace(
        liquid=jnp.array([3.0, 0.0]), solid=jnp.zeros(MIXTURE.solid_shape).at[0, 1, 0].set(2.0)
    )
    assert float(s.slurry_volume_flow) == pytest.approx(2 / 2000 + 3 / 1000)
    assert float(s.solids_volume_fraction) == pytest.approx(0.25)
    assert float(s.solids_mass_fraction) == pytest.approx(0.4)
    assert float(s.moisture_dry_basis) == pytest.approx(1.5)
    np.testing.assert_allclose(s.size_fractions, [0.0, 1.0, 0.0])


def test_regrading_moves_sizes_and_leaves_other_axes() -> None:
    s = stream()
    operator = jnp.array([[1.0, 0.5, 0.0], [0.0, 0.5, 1.0], [0.0, 0.0, 0.0]])
    moved = s.regraded(operator)
    np.testing.assert_allclose(moved.solid[0, :, 0], [0.15, 0.15, 0.0])
    np.testing.assert_allclose(jnp.sum(moved.solid, axis=1), jnp.sum(s.solid, axis=1), rtol=1e-14)


@given(st.floats(250.0, 500.0), st.floats(250.0, 500.0), st.floats(1e-6, 1e3), st.floats(1e-6, 1e3))
def test_mixing_conserves_components_and_energy(
    first: float, second: float, water: float, solid: float
) -> None:
    a, b = stream(first, water=water), stream(second, solid=solid)
    found = closure([a, b], [a + b])
    assert float(found.mass) < 1e-14
    assert float(found.energy) < 1e-12


def test_heating_and_its_duty_close() -> None:
    s = stream()
    out = Heater(temperature="80 degC")(s)
    assert float(out.product.temperature) == pytest.approx(353.15)
    assert float(closure([s], [out.product], out.heat_duty).energy) < 1e-15
    assert float(s.heated(out.heat_duty).temperature) == pytest.approx(353.15, abs=1e-8)


def test_splitter_keeps_state() -> None:
    product, side = Splitter(side_fraction="25 %")(stream())
    assert float(side.mass_flow / (side.mass_flow + product.mass_flow)) == pytest.approx(0.25)
    assert float(Mixer()(a=product, b=side).product.temperature) == pytest.approx(300.0, abs=1e-9)


def test_gradient_of_a_mixing_temperature() -> None:
    def mixed(temperature: float) -> jax.Array:
        return (stream(temperature) + stream(320.0)).temperature

    assert float(jax.grad(mixed)(300.0)) == pytest.approx(0.5, abs=1e-9)


def test_empty_streams_stay_finite() -> None:
    nothing = empty(MIXTURE) + empty(MIXTURE)
    assert float(nothing.mass_flow) == 0.0
    assert np.isfinite(float(nothing.temperature))


def test_different_mixtures_do_not_mix() -> None:
    other = Mixture((SALT,), (WATER,), (), (1e-6, 1e-3))
    with pytest.raises(InputError, match="different mixtures"):
        stream() + empty(other)


def test_sizes_must_increase() -> None:
    with pytest.raises(InputError, match="increasing"):
        Mixture((SALT,), (WATER,), (), (1e-3, 1e-4))
