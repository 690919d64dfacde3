"""Surface by gas adsorption."""

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.particles import GasAdsorption, adsorbed_volume_bet, specific_surface_mass_bet

# nitrogen on 1 g of rutile at 75 K, where the vapor pressure is 76.0 kPa (Atkins, Physical Chemistry, example
# on the BET isotherm, recalled): 811 mm³ in the monolayer by a line through all seven points
RUTILE = {
    "relative_pressure": np.array([0.160, 1.87, 6.11, 11.67, 17.02, 21.92, 27.29]) / 76.0,
    "adsorbed_volume": np.array([601, 720, 822, 935, 1046, 1146, 1254]) * 1e-6,
}


def test_rutile_by_the_book():
    found = GasAdsorption(**RUTILE).fit()
    assert found["monolayer_volume"].value == pytest.approx(811e-6, rel=0.035)
    assert found.problem.x.size == 4  # relative pressures of 0.05 to 0.30
    # 0.811 cm³ over 22414 cm³/mol, times Avogadro's number and 0.162 nm²
    assert specific_surface_mass_bet("0.811 cm^3/g") == pytest.approx(3530.0, rel=1e-3)


def test_the_monolayer_is_full_where_theory_says():
    C = 100.0
    assert adsorbed_volume_bet(1.0 / (1.0 + np.sqrt(C)), 2e-3, C) == pytest.approx(2e-3)


def test_points_outside_the_range_are_not_counted():
    with pytest.raises(InputError, match="every_point"):
        GasAdsorption(relative_pressure=[0.4, 0.5, 0.6], adsorbed_volume=[1e-3, 1.2e-3, 1.5e-3]).fit()
