"""Where one more reading of a lab test tells most."""

from __future__ import annotations

import json

import numpy as np
import pytest
from tests.sharing.commands import granum
from tests.sharing.lab_data import data

import granum as gr
from granum.core import registry
from granum.core.errors import InputError

PLACE = {"area": "0.0439 m2", "pressure_drop": "338 kPa", "dynamic_viscosity": "0.8937 cP"}


def test_next_leaf_of_a_series_is_at_the_farther_end() -> None:
    """A straight line over ln p: the variance after one more reading at x is least where (x - mean)² is most,
    and the determinant of the information grows by 1 + 1/n + (x - mean)²/S.
    """
    p = np.array([0.5, 0.7, 1.0, 1.4, 4.0]) * 1e5
    rng = np.random.default_rng(3)
    alpha = 1e11 * (p / 1e5) ** 0.4 * np.exp(0.02 * rng.standard_normal(5))
    test = gr.filtration.Compressibility(pressure_drop=p, cake_resistance=alpha)
    told = test.next_measurement(test.fit())
    x = np.log(p)
    far = (x[-1] - x.mean()) ** 2
    assert told["at"]["pressure_drop"] == {"value": pytest.approx(4e5), "unit": "Pa"}
    assert told["shrinkage"] == pytest.approx(1 / np.sqrt(1 + 1 / 5 + far / np.sum((x - x.mean()) ** 2)))


def test_readings_that_scatter_by_their_size_are_taken_where_they_are_sure() -> None:
    """Velocity over concentration, of the same relative scatter: ln v is a straight line, and an end is best,
    whichever unit it is in.
    """
    c = np.linspace(2.0, 10.0, 9)
    v = 2e-3 * np.exp(-0.4 * c) * np.exp(0.03 * np.random.default_rng(1).standard_normal(9))
    test = gr.settling.CoeClevengerSeries(
        solids_concentration=c, settling_velocity=v, underflow_concentration=12.0
    )
    told = test.next_measurement(test.fit())
    assert told["at"]["solids_concentration"]["value"] in (2.0, 10.0)
    assert told["shrinkage"] == pytest.approx(1 / np.sqrt(1 + 1 / 9 + 16 / 60), rel=0.05)


def test_told_at_the_command_line(tmp_path) -> None:
    rows = [f"{t},{v}" for t, v in ((4, 0.5), (9.5, 1.0), (16.3, 1.5), (24.6, 2.0), (34.7, 2.5), (46.1, 3.0))]
    sheet = tmp_path / "leaf.csv"
    sheet.write_text("time [s],filtrate_volume [L]\n" + "\n".join(rows), encoding="utf-8")
    words = [f"{name}={value}" for name, value in PLACE.items()] + ["dry_cake_per_filtrate=23.5 g/L"]
    code, out, _err = granum("fit", "filtration.leaf_test", str(sheet), *words, "--next", "--json")
    assert code == 0
    assert 5e-4 <= json.loads(out)["next"]["at"]["filtrate_volume"]["value"] <= 3.0001e-3
    code, out, _err = granum("fit", "filtration.leaf_test", str(sheet), *words, "--next", "--lang", "fr")
    assert code == 0
    assert "Mesure suivante" in out or "mesure" in out


@pytest.mark.parametrize("key", ["particles.sieve_analysis", "drying.isotherm_temperatures"])
def test_a_test_of_several_columns_says_so(key: str) -> None:
    good = data(key)
    test = registry.find(key)(**good.columns, **good.conditions)
    with pytest.raises(InputError, match="over one column"):
        test.next_measurement(test.fit())
