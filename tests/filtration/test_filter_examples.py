"""The examples of filters and centrifuges run, close their balances and keep their limits."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

from granum.cases import read

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("path", ["leaf-filter/leaf_filter.py", "centrifuges/bowls.py"])
def test_scripts_assert_the_books_numbers(path):
    runpy.run_path(str(EXAMPLES / path))


@pytest.mark.parametrize(
    ("path", "unit", "driest", "wettest"),
    [
        # saturated chalk cake; sucked dry on a drum; settled quartz at half solid; spun salt, of which handbooks say 2 to 5 %
        ("filters/press.toml", "press", 0.35, 0.55),
        ("filters/drum.toml", "drum", 0.08, 0.30),
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
