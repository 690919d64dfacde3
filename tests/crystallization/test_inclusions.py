"""Liquor that crystals shut in, against the boundary layer of a plate; impurity by both distributions."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from tests.crystallization.test_uptake import LIQUIDS, magma

from granum.crystallization.equipment.uptake import ImpurityUptake
from granum.crystallization.formulas.growth import PowerLawGrowth
from granum.crystallization.formulas.inclusions import (
    OnsetByGrowth,
    OnsetSize,
    growth_rate_clear_carlson,
    inclusion_onset_size_carlson,
)
from granum.crystallization.formulas.purity import impurity_share_crystallized
from granum.crystallization.formulas.solubility_laws import PolynomialSolubility
from granum.streams.from_materials import taken_up_name

ALL = tuple(map(taken_up_name, LIQUIDS))


def test_carlson_is_the_plate_that_uses_up_its_liquor_at_the_far_end() -> None:
    # Kays and Crawford, laminar plate of even flux: Sh_x = 0.453 Re^(1/2) Sc^(1/3); k_d dc = rho_c G/2 there
    size, u, dc, rho, D, nu = 8e-4, 0.05, 4.0, 2100.0, 1.2e-9, 1.4e-6
    film = 0.453 * (u * size / nu) ** 0.5 * (nu / D) ** (1 / 3) * D / size
    found = growth_rate_clear_carlson(size, u, dc, rho, D, nu)
    assert found == pytest.approx(2.0 * film * dc / rho, rel=0.03)
    assert inclusion_onset_size_carlson(found, u, dc, rho, D, nu) == pytest.approx(size, rel=1e-12)
    assert inclusion_onset_size_carlson(0.5 * found, u, dc, rho, D, nu) == pytest.approx(4 * size, rel=1e-12)


def test_layers_follow_rayleigh_and_even_crystals_the_batch_law_of_petrology() -> None:
    # Trace elements in a melt of which F is left: C_L/C_0 = 1/(F + D (1 - F)) and F^(D - 1); what is left
    # in the liquor is F times that
    D, F = np.array([0.05, 0.5, 2.33, 8.0]), np.array([0.9, 0.5, 0.2, 0.6])
    even, layers = impurity_share_crystallized(D, 1.0 - F)
    np.testing.assert_allclose(1.0 - even, F / (F + D * (1.0 - F)), rtol=1e-12)
    np.testing.assert_allclose(1.0 - layers, F * F ** (D - 1.0), rtol=1e-12)
    assert np.all((layers > even) == (D > 1.0))


def test_a_batch_of_layers_is_what_many_mixed_vessels_one_after_the_other_take_up() -> None:
    """A thousand vessels, each with the liquor of the one before and even crystals of its own."""
    feed = magma("sodium chloride in crystals")
    product = ImpurityUptake(0.2, distribution_law="logarithmic")(feed=feed).product
    left, dissolved = 0.5, 5.0
    for _vessel in range(1000):
        made = 2.0 / 1000
        left -= left * 0.2 * made / (dissolved - made + 0.2 * made)
        dissolved -= made
    assert float(product.liquid[2]) == pytest.approx(left, rel=1e-3)
    assert float(product.mass_flow) == pytest.approx(float(feed.mass_flow), rel=1e-12)


def test_only_crystals_beyond_the_onset_shut_liquor_in_and_only_with_what_grew_there() -> None:
    feed = magma(*ALL)
    sizes = feed.mixture.sizes
    onset = float(sizes[1])
    unit = ImpurityUptake(0.0, inclusion_fraction=0.02, inclusion_onset=OnsetSize(onset))
    found = unit.operate(feed=feed)
    share = 0.02 * (1.0 - np.minimum(onset / sizes, 1.0) ** 3)
    volume = np.asarray(feed.solid[0]) / feed.mixture.densities("solids", feed.temperature)[0]
    liquid = feed.liquid_volume_flow
    # nothing is salt but what is shut in: the liquor in volume times its salt
    assert float(jnp.sum(found.outlets.product.solid[1])) >= 0.0
    held = np.asarray(found.outlets.product.solid[1:]).sum(axis=0)
    rooms = share / (1.0 - share) * volume
    np.testing.assert_allclose(held, rooms / liquid * feed.liquid_flow, rtol=1e-9, atol=1e-15)
    assert held[0] == held[1] == 0.0 < held[2]
    assert float(found.figures.inclusion_onset_size) == pytest.approx(onset)
    larger = ImpurityUptake(0.0, inclusion_fraction=0.02, inclusion_onset=OnsetSize(1.0)).operate(feed=feed)
    assert float(larger.figures.impurity_inclusions) == 0.0


def test_slower_growth_by_a_square_law_shuts_in_less_and_liquor_run_down_is_refused() -> None:
    feed = magma(*ALL)
    per_water = float(feed.liquid[1] / feed.liquid[0])

    def operated(saturated: float) -> Any:
        onset = OnsetByGrowth(PowerLawGrowth(4e-4, 2.0), PolynomialSolubility((saturated,)), 0.05, 1e-9, 1e-6)
        return ImpurityUptake(0.0, inclusion_fraction=0.02, inclusion_onset=onset).operate(feed=feed)

    fast, slow = (float(operated(x * per_water).figures.impurity_inclusions) for x in (0.93, 0.97))
    assert fast > 1.5 * slow > 0.0
    told = [r.reason for r in operated(1.01 * per_water).records if np.any(r.mask)]
    assert any("onset_size" in reason for reason in told)
