"""Lines as users write them (``benchmarks/lines``): each is solved, closes, and meets what it specifies."""

from pathlib import Path

import pytest

import granum as gr

LINES = sorted((Path(__file__).parents[2] / "benchmarks" / "lines").glob("*.toml"))


@pytest.mark.long
@pytest.mark.parametrize("path", LINES, ids=lambda path: path.stem)
def test_line_is_solved_closes_and_meets_its_specifications(path: Path, left_to_jax: list[str]) -> None:
    line = gr.read(path)
    run = line.solve()
    assert left_to_jax == []
    assert run.audit["mass_closure"] <= 1e-9
    assert run.audit["energy_closure"] <= 1e-9
    assert set(run.found) == {target.vary for target in line.targets}
    for target in line.targets:
        assert run.figure(target.so_that) == pytest.approx(target.equals, rel=1e-8)
        assert target.lower <= run.found[target.vary] <= target.upper


@pytest.mark.long
def test_wanted_moisture_that_a_dryer_cannot_leave_is_out_of_reach() -> None:
    """A belt four times as large dries below 1 % with the coolest gas; on the way there it has no answer."""
    line = gr.read(LINES[0].with_name("china-clay.toml")).with_values(**{"dryer.area": 60.0})
    with pytest.raises(gr.core.errors.ConvergenceError, match=r"out of reach: it is 0\.2.* % at air_heater"):
        line.solve()
