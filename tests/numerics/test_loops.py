"""Loops whose steps are told."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np

from granum.core import flags
from granum.numerics.loops import told_scan
from granum.particles.formulas.drag_modern import drag_coefficient_schiller_naumann as drag


def test_what_a_step_flags_is_heard_outside() -> None:
    """Reynolds numbers 400, 1600, 6400: the fitted range of the law ends at 800."""

    def step(reynolds: object, _row: None) -> tuple[object, object]:
        return 4.0 * reynolds, drag(4.0 * reynolds)

    with flags.collect() as records:
        last, found = told_scan(step, jnp.asarray(100.0), length=3)
    assert float(last) == 6400.0
    assert found.shape == (3,)
    beyond = [r for r in records if r.bit == flags.EXTRAPOLATED and r.name == "reynolds"]
    assert np.array_equal(np.any([r.mask for r in beyond], axis=0), [False, True, True])
    assert told_scan(step, jnp.asarray(100.0), length=3)[0] == last
