"""Heat and mass transfer of a particle."""

from __future__ import annotations

import jax
import pytest

from granum.particles import nusselt_number_ranz_marshall


def test_limit_of_conduction_and_a_hand_value() -> None:
    """2 in still fluid (conduction to infinity); at Re = 100, Pr = 1: 2 + 0.6·10 = 8."""
    assert nusselt_number_ranz_marshall(reynolds=0.0, prandtl_number=0.7) == pytest.approx(2.0)
    assert nusselt_number_ranz_marshall(reynolds=100.0, prandtl_number=1.0) == pytest.approx(8.0)


def test_gradient_stays_finite_in_still_fluid() -> None:
    assert jax.grad(lambda Re: nusselt_number_ranz_marshall(Re, 0.7))(0.0) == pytest.approx(0.0)
