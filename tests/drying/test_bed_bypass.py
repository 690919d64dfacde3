"""Gas that passes by the grains of a fluidized-bed dryer in bubbles."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from scipy.integrate import solve_ivp

from granum.drying.formulas.beds import bypass_fraction_groenewold_tsotsas


def test_bubbles_that_exchange_one_transfer_unit_in_five_centimeters() -> None:
    """Bubbles with 0.6 of the gas against a dense phase of one humidity, marched up 8 cm of bed."""
    up = solve_ivp(lambda _z, y: -y / (0.6 * 0.05), (0.0, 0.08), [1.0], rtol=1e-10, atol=1e-12)
    found = bypass_fraction_groenewold_tsotsas(1.0, 0.4, 0.08)
    np.testing.assert_allclose(found, 0.6 * up.y[0, -1], rtol=1e-6)


def test_a_shallow_bed_lets_its_bubbles_pass_and_a_deep_one_does_not() -> None:
    heights = jnp.asarray([1e-6, 0.02, 0.05, 0.1, 0.3])
    found = bypass_fraction_groenewold_tsotsas(1.0, 0.2, heights)
    np.testing.assert_allclose(found[0], 0.8, rtol=1e-4)
    assert np.all(np.diff(np.asarray(found)) < 0)
    assert found[-1] < 1e-3
    faster = bypass_fraction_groenewold_tsotsas(jnp.asarray([0.1, 0.2, 0.5, 1.0, 3.0]), 0.2, 0.1)
    assert np.all(np.diff(np.asarray(faster)) >= 0)
    assert faster[0] == 0.0  # no bubbles below minimum fluidization
