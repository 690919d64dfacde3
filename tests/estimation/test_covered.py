"""How often intervals of lab tests hold the truth, as the documentation shows it."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from tests.sharing.lab_data import data, keys

from granum.core import registry
from granum.estimation import fit

ROOT = Path(__file__).parents[2]


@pytest.fixture
def covered(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    import covered  # pyright: ignore[reportMissingImports]

    yield covered
    sys.modules.pop("covered", None)


def test_every_lab_test_is_in_the_table_and_nearly_all_intervals_hold(covered) -> None:
    rows = covered.read()
    assert {row.lab_test for row in rows} == set(keys())
    assert all(row.sheets >= 200 for row in rows)
    shares = np.array([row.covered / row.sheets for row in rows])
    assert np.all(shares > 0.92)  # 95 % less three standard deviations of 400 sheets
    assert np.mean((shares >= 0.93) & (shares <= 0.97)) > 0.95
    for code, page in covered.PAGES.items():
        assert covered.table(rows, code) in page.read_text(encoding="utf-8")


@pytest.mark.parametrize("key", ["filtration.leaf_test", "filtration.compression_cell"])
def test_a_hundred_sheets_again(covered, key: str) -> None:
    """Of a hundred intervals that hold in 95 % of cases fewer than 88 hold once in two hundred times."""
    told = {row.estimate: row for row in covered.read() if row.lab_test == key}
    for row in covered.tried(key, sheets=100):
        assert row.points == told[row.estimate].points
        assert row.covered >= 88


def test_two_scatters_are_told_apart_as_welch_does() -> None:
    """Two means, each with a scatter of its own: the interval of their difference is Welch's, with
    Satterthwaite's degrees of freedom, by hand for means of 5 and 9 readings.
    """
    rng = np.random.default_rng(4)
    few, many = 10.0 + rng.normal(size=5), 7.0 + 0.1 * rng.normal(size=9)
    found = fit(
        lambda p, x: (p["few"] + 0.0 * x[0], p["many"] + 0.0 * x[1]),
        {"few": 9.0, "many": 8.0},
        (np.ones(5), np.ones(9)),
        (few, many),
        apart=True,
    )
    assert found["few"].standard_error == pytest.approx(few.std(ddof=1) / 5**0.5, rel=1e-3)
    assert found["many"].standard_error == pytest.approx(many.std(ddof=1) / 3.0, rel=1e-3)
    from scipy import stats

    welch = stats.ttest_ind(few, many, equal_var=False).confidence_interval(0.95)
    apart = found.derive(lambda p: {"difference": p["few"] - p["many"]})["difference"]
    assert apart.interval_95 == pytest.approx((welch.low, welch.high), rel=1e-3)


def test_jars_give_all_that_they_say_an_interval() -> None:
    good = data("filtration.slurry_jar")
    rng = np.random.default_rng(1)
    columns = {n: v * (1.0 + 0.01 * rng.normal(size=v.shape)) for n, v in good.columns.items()}
    found = registry.find("filtration.slurry_jar")(**columns).fit()
    for name in ("void_fraction", "wet_to_dry_mass_ratio", "dry_cake_per_filtrate"):
        low, high = found[name].interval_95
        assert low < found[name].value < high
        assert high - low < 0.1 * found[name].value
