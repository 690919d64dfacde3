"""One of two solutes crystallizes: a liquid keeps the other dissolved, or an agent takes it."""

import jax
import numpy as np
import pytest

from granum import crystallization as c


def test_a_pair_by_hand() -> None:
    """Half of the solvent is added: 2·√(0.4·0.01) = 0.12649 and 2·√(0.2·0.5) = 0.63246 kg stay dissolved."""
    found = c.extractive_crystallization(0.5, 0.7, 0.5, 0.4, 0.01, 0.2, 0.5)
    wanted, other = 0.5 - 0.126491, 0.7 - 0.632456
    assert float(found.yield_fraction) == pytest.approx(wanted / 0.5, rel=1e-5)
    assert float(found.other_crystals_per_solvent) == pytest.approx(other, rel=1e-4)
    assert float(found.purity) == pytest.approx(wanted / (wanted + other), rel=1e-5)
    # a liquid that dissolves as much as the solvent only dilutes: 0.3 kg need 1.5 kg at 0.2 kg/kg
    same = c.extractive_crystallization(0.5, 0.3, 0.5, 0.4, 0.01, 0.2, 0.2)
    assert float(same.added_fraction_least) == pytest.approx(1.0 / 3.0, rel=1e-9)


def test_from_the_least_share_on_the_other_solute_stays_dissolved() -> None:
    rng = np.random.default_rng(4)
    given = np.exp(rng.uniform(np.log(0.01), np.log(2.0), (6, 300)))
    shares, (wanted, other, s_wanted, t_wanted, s_other, t_other) = rng.uniform(0.0, 0.95, 300), given
    settings = wanted, other, shares, s_wanted, t_wanted, s_other, t_other
    found = c.extractive_crystallization(*settings)
    made = np.asarray(found.other_crystals_per_solvent)
    least = np.asarray(found.added_fraction_least)
    assert all(np.isfinite(np.asarray(x)).all() for x in found)
    assert not made[shares > least + 1e-9].any()
    # the two solutes do not know of each other
    swapped = c.extractive_crystallization(other, wanted, shares, s_other, t_other, s_wanted, t_wanted)
    np.testing.assert_allclose(np.asarray(swapped.yield_fraction) * other, made, atol=1e-12)


def test_an_adduct_forms_as_an_ideal_melt_freezes() -> None:
    """Without an agent in it the law is Schröder and van Laar's, whose card is checked on its own."""
    freezing = c.freezing_temperature_ideal(0.5, 286.4, 161e3, 0.106165)
    found = c.adductive_crystallization(0.9, freezing, 286.4, 161e3 * 0.106165, 1.0)
    assert float(found.mole_fraction_left) == pytest.approx(0.5, rel=1e-9)
    # of 0.9 mol beside 0.1 mol of another, 0.1 mol stay: half of the liquid
    assert float(found.yield_fraction) == pytest.approx(8.0 / 9.0, rel=1e-9)


def test_adducts_form_in_the_cold_with_enough_agent() -> None:
    T = np.linspace(270.0, 372.0, 40)
    strong = c.adductive_crystallization(0.4, T, 373.0, 5e4, 12.0)
    weak = c.adductive_crystallization(0.4, T, 373.0, 5e4, 12.0, agent_activity=0.95)
    for found in (strong, weak):
        part = np.asarray(found.yield_fraction)
        assert (np.diff(part) <= 0.0).all()
        assert part[0] > 0.9
        assert part[-1] == 0.0
        left = np.asarray(found.mole_fraction_left)
        np.testing.assert_allclose(0.4 - 0.4 * part, left * (1.0 - 0.4 * part), atol=1e-12)  # moles left
    assert (np.asarray(weak.yield_fraction) <= np.asarray(strong.yield_fraction)).all()
    slope = jax.grad(lambda T: c.adductive_crystallization(0.4, T, 373.0, 5e4, 12.0).yield_fraction)(330.0)
    assert float(slope) < 0.0


@pytest.mark.parametrize("carbon_atoms", [7, 16, 32])
def test_urea_per_carbon_atom_is_what_was_weighed(carbon_atoms: int) -> None:
    """Zimmerschied and others (Ind. Eng. Chem. 42, 1300, 1950; the abstract was opened): 0.8 ± 0.1 for chains
    of 7 to 32 carbon atoms. The channel holds six molecules on 11.01 Å.
    """
    n = float(c.agent_ratio_urea(carbon_atoms))
    assert n / carbon_atoms == pytest.approx(0.8, abs=0.1)
    assert n == pytest.approx(6.0 / 11.01 * (1.256 * (carbon_atoms - 1) + 4.0), rel=2e-3)
