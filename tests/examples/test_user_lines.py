"""Lines as users write them (``benchmarks/lines``): each is solved, closes, and meets what it specifies."""

from pathlib import Path

import pytest

import granum as gr

LINES = sorted((Path(__file__).parents[2] / "benchmarks" / "lines").glob("*.toml"))


@pytest.mark.long
@pytest.mark.parametrize("path", LINES, ids=lambda path: path.stem)
def test_line_is_solved_closes_and_meets_its_specifications(path: Path) -> None:
    line = gr.read(path)
    run = line.solve()
    assert run.audit["mass_closure"] <= 1e-9
    assert run.audit["energy_closure"] <= 1e-9
    assert set(run.found) == {target.vary for target in line.targets}
    for target in line.targets:
        assert run.figure(target.so_that) == pytest.approx(target.equals, rel=1e-8)
        assert target.lower <= run.found[target.vary] <= target.upper
