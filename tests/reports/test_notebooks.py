"""Results in notebooks and as labelled tables."""

import numpy as np
import pytest
from tests.sharing.places import EXAMPLES

import granum as gr


@pytest.fixture(scope="module")
def run():
    return gr.read(EXAMPLES / "fluidized-bed" / "bed.toml").solve()


def test_a_result_shows_itself_with_its_source_and_its_flags():
    found = gr.particles.drag_coefficient_stokes.evaluate(reynolds=10.0)
    html = found._repr_html_()
    assert html.startswith("<pre")
    assert all(part in html for part in ("2.4", "Stokes", "!"))
    frame = found.to_pandas()
    assert frame.loc["drag_coefficient", "value"] == pytest.approx(2.4)
    assert frame.loc["reynolds", "role"] == "input"


def test_a_card_shows_what_show_prints():
    html = gr.particles.drag_coefficient_stokes._repr_html_()
    assert "reynolds" in html
    assert "Stokes" in html
    assert "recording" not in html


def test_a_fit_is_a_table_of_estimates():
    time = np.array([0.0, 600.0, 1200.0, 1800.0, 2400.0, 3000.0])
    fit = gr.drying.ThinLayerTest(
        time=time,
        moisture_ratio=np.exp(-1e-3 * time) * (1 + 1e-3 * np.array([0, 1, -1, 1, -1, 1])),
        model="lewis",
    ).fit()
    frame = fit.to_pandas()
    row = frame.loc[next(iter(fit.parameters))]
    assert row["value"] == pytest.approx(1e-3, rel=0.01)
    assert row["low"] < row["value"] < row["high"]
    assert "95 %" in fit._repr_html_()


def test_a_run_is_streams_and_figures_with_units(run):
    frame, data = run.to_pandas(), run.to_xarray()
    assert list(frame.index) == list(run.streams)
    flows = [c for c in frame.columns if c.startswith(("solid.", "liquid.", "gas."))]
    for name, stream in run.streams.items():
        assert frame.loc[name, flows].sum() == pytest.approx(float(stream.mass_flow), rel=1e-12)
        assert float(data.mass_flow.sel(stream=name).sum()) == pytest.approx(
            float(stream.mass_flow), rel=1e-12
        )
        assert float(data.solid_by_size.sel(stream=name).sum()) == pytest.approx(
            float(stream.solid_flow), rel=1e-12, abs=1e-300
        )
    unit = next(iter(run.units))
    p, value = next((p, v) for p, v in run.units[unit].figures() if p.kind is not None)
    assert float(data[f"{unit}.{p.name}"]) == pytest.approx(float(value))
    assert data[f"{unit}.{p.name}"].attrs["units"] == p.kind.unit
    assert "audit" in run._repr_html_()


def test_a_line_in_time_has_a_time_axis():
    course = gr.read(EXAMPLES / "start-up" / "circuit.toml").solve().course
    data = course.to_xarray()
    assert data.mass_flow.dims == ("species", "stream", "time")
    for name, stream in course.streams.items():
        whole = np.asarray(stream.liquid).sum(axis=-1) + np.asarray(stream.gas).sum(axis=-1)
        whole = whole + np.asarray(stream.solid).reshape(len(course.times), -1).sum(axis=1)
        np.testing.assert_allclose(data.mass_flow.sel(stream=name).sum("species"), whole, rtol=1e-12)
