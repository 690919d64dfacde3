"""The examples of filters and centrifuges run, close their balances and keep their limits."""

from __future__ import annotations

import runpy

import pytest
from tests.sharing.places import EXAMPLES

from granum.cases import read


@pytest.mark.parametrize(
    "path", ["leaf-filter/leaf_filter.py", "centrifuges/bowls.py", "worked-filters/worked_filters.py"]
)
def test_scripts_assert_the_books_numbers(path):
    runpy.run_path(str(EXAMPLES / path))


@pytest.mark.parametrize(
    ("path", "unit", "driest", "wettest"),
    [
        # saturated chalk cake; sucked dry on a drum; settled quartz at half solid; spun salt, of which
        # handbooks say 2 to 5 %
        ("filters/press.toml", "press", 0.35, 0.55),
        ("filters/drum.toml", "drum", 0.08, 0.30),
        ("filters/crystals.toml", "belt", 0.05, 0.15),
        ("centrifuges/decanter.toml", "decanter", 0.30, 0.45),
        ("centrifuges/basket.toml", "basket", 0.02, 0.05),
    ],
)
def test_cases_close_and_keep_their_limits(path, unit, driest, wettest):
    found = read(EXAMPLES / path).solve().as_json()
    assert found["audit"]["mass_closure"] < 1e-9
    assert found["audit"]["energy_closure"] < 1e-9
    machine = found["units"][unit]
    assert all(check["ok"] for check in machine["checks"]), machine["checks"]
    assert driest < machine["results"]["moisture_dry_basis"]["value"] < wettest


def test_wash_of_crystals_costs_what_the_solubility_says():
    # 150 kg/h of water at 316 g/kg; the mother liquor of 24 % by mass is within 0.1 % of saturation
    found = read(EXAMPLES / "filters/crystals.toml").solve()
    assert found.figure("belt.dissolved_share") == pytest.approx(150 * 0.316 / 900, rel=0.01)
    # heat of solution of potassium nitrate at saturation, 205 kJ/kg, against what cake and liquor hold
    cooled = 293.15 - float(found.streams["belt.cake"].temperature)
    assert 2.7 < cooled < 4.2
