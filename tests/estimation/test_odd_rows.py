"""No rows, one row, an empty column, text, zeros: one sentence, or a fit that says what is wrong with it;
never a traceback.
"""

from __future__ import annotations

import io

import numpy as np
import pytest
from tests.sharing.lab_data import data, keys

from granum.core import registry
from granum.core.errors import ConvergenceError, InputError
from granum.estimation.lines import polynomial, straight_line
from granum.filtration.lab_tests.starts import bad_start

DEAR = {
    "crystallization.batch_kinetics",
    "settling.compression_test",
    "comminution.grinding_kinetics",
    "drying.thin_layer_test",
    "drying.isotherm",
    "drying.isotherm_temperatures",
}


def written(key: str, measured: list[str]) -> str:
    """The data of a lab test as CSV in SI units, its measured column replaced by other cells."""
    made, units = data(key), {p.name: p.kind.unit for p in registry.find(key).card.parameters if p.series}
    lines = [",".join(f"{name} [{units[name]}]" for name in made.columns)]
    for i, cell in enumerate(measured):
        lines.append(
            ",".join(
                cell if name == made.measured else f"{values[i]:.9g}" for name, values in made.columns.items()
            )
        )
    return "\n".join(lines)


@pytest.mark.parametrize("key", keys())
def test_rows_that_cannot_be_fitted_are_one_sentence(key):
    made, test = data(key), registry.find(key)
    for count in (0, 1):
        with pytest.raises(InputError):
            test(**{n: v[:count] for n, v in made.columns.items()}, **made.conditions).fit()
    values = made.columns[made.measured].copy()
    values[2] = np.nan
    with pytest.raises(InputError):
        test(**{**made.columns, made.measured: values}, **made.conditions)
    with pytest.raises(InputError):
        test.read(io.StringIO(written(key, [""] * values.size)), **made.conditions)
    with pytest.raises(InputError, match=f"Line 3, column '{made.measured}': 'abc' is not a number"):
        test.read(io.StringIO(written(key, ["0.5", "abc"] + ["0.5"] * (values.size - 2))), **made.conditions)


@pytest.mark.parametrize("key", [k for k in keys() if k not in DEAR])
def test_zeros_are_told(key):
    made, test = data(key), registry.find(key)
    for names in (tuple(made.columns), (made.measured,)):
        try:
            found = test(
                **{**made.columns, **{n: np.zeros_like(made.columns[n]) for n in names}}, **made.conditions
            ).fit()
        except (InputError, ConvergenceError):
            continue
        assert found.flags


def test_lines_need_different_places():
    with pytest.raises(InputError, match="one place"):
        straight_line([3.0, 3.0, 3.0], [1.0, 2.0, 3.0])
    with pytest.raises(InputError, match="finite"):
        straight_line([1.0, 2.0], [-np.inf, 2.0])
    with pytest.raises(InputError, match="at least 3"):
        polynomial([1.0, 2.0, 2.0], [1.0, 2.0, 3.0], 2)


def test_bad_start_is_found_among_ten_thousand_points():
    x = np.linspace(1.0, 2.0, 10_000)
    y = 3.0 * x + 1.0 + 1e-3 * np.random.default_rng(0).standard_normal(x.size)
    assert bad_start(x, y) == 0
    y[:40] *= 0.7
    assert bad_start(x, y) == 40
