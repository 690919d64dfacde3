"""A figure of a machine alone over one of its settings, beside its results."""

from __future__ import annotations

from base64 import b64decode

import httpx
import numpy as np
import pytest
from tests.app.browsing import Page

from granum.app import machine_curves
from granum.app.beside import described_curve
from granum.app.machine_curves import Machine
from granum.core import registry
from granum.core.errors import InputError

CYCLONE = "cyclones.gas_cyclone"


def drawn(key: str, **asked: object) -> dict:
    return described_curve(registry.find(key), {"inputs": {}, **asked})


def test_a_wider_cyclone_catches_less_and_the_present_one_is_on_the_curve() -> None:
    machine = Machine(CYCLONE, {"diameter": "1 m"})
    found = machine.curve(*machine.chosen("", ""))
    assert found is not None
    assert (found.against.name, found.output.name) == ("diameter", "removal_efficiency")
    assert np.all(np.diff(found.y[np.isfinite(found.y)]) < 1e-12)
    assert found.at == 1.0
    assert found.point == pytest.approx(machine.run.units["gas_cyclone"].values.removal_efficiency, rel=1e-12)
    assert not found.steep  # a share has a linear axis however small it gets


def test_a_figure_without_a_value_is_not_among_those_to_draw() -> None:
    """A nutsche declares no washing capacity, and its pump has no largest flow unless one is given."""
    assert drawn("filtration.nutsche")["output"] == "capacity_use"
    assert {"wash_use", "pressure_rise_time"}.isdisjoint(Machine("filtration.nutsche", {}).figures)
    pumped = Machine("filtration.nutsche", {"filtrate_flux_largest": "0.2 mm/s"})
    assert "pressure_rise_time" in pumped.figures


def test_what_enters_can_run_too_and_is_told_by_its_inlet() -> None:
    machine = Machine("streams.heater", {})
    found = machine.curve(*machine.chosen("feed.temperature", "heat_duty"))
    assert found is not None
    assert machine.settings["feed.temperature"].label.endswith("(feed)")
    slope = np.diff(found.y) / np.diff(found.x)
    np.testing.assert_allclose(slope, slope[0], rtol=0.05)  # heat of a liquid: nearly as its degrees
    assert slope[0] < 0.0


def test_a_figure_alone_is_drawn_over_a_setting_that_moves_it() -> None:
    found = drawn("comminution.screen", output="mass_flow_oversize")
    assert found["output"] == "mass_flow_oversize"
    assert len({round(y, 9) for y in found["figure"]["data"][0]["y"] if y is not None}) > 1


def test_where_there_is_no_time_there_is_no_chart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(machine_curves, "LONGEST", 0.0)
    found = drawn("streams.pump")
    assert found["figure"] is None
    assert "study" in found["note"]
    assert len(found["inputs"]) > 1  # another choice may be quicker


def test_with_little_time_the_curve_has_fewer_points_over_the_same_range(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    machine = Machine("streams.pump", {})
    choice = machine.chosen("", "")
    whole = machine.curve(*choice)
    monkeypatch.setattr(machine_curves, "PATIENCE", 0.0)
    quick = machine.curve(*choice)
    assert whole is not None
    assert quick is not None
    assert (quick.x[0], quick.x[-1], quick.at) == (whole.x[0], whole.x[-1], whole.at)
    assert quick.at in quick.x
    assert quick.x.size == machine_curves.FEWEST < whole.x.size
    np.testing.assert_array_equal(quick.y, whole.y[np.isin(whole.x, quick.x)])


@pytest.mark.parametrize("asked", [{"against": "color"}, {"output": "color"}])
def test_what_is_not_there_is_refused(asked: dict[str, str]) -> None:
    with pytest.raises(InputError, match="color"):
        drawn("streams.pump", **asked)


def test_the_page_draws_it_and_another_on_demand(page: Page) -> None:
    page.open("calculate/streams.pump", "fr")
    assert page.one("[data-sensitivity]").get_attribute("data-sensitivity") == "pressure_rise"
    menu = page.one("[data-sensitivity] select[data-menu=against]")
    menu.find_element("css selector", "option[value='feed.mass_flow']").click()
    page.until(lambda: page.one("[data-sensitivity='feed.mass_flow'] .spoken").text is not None)
    page.says("[data-sensitivity]", "débit massique (alimentation)")
    page.check()


def test_what_is_inside_a_machine_is_drawn_and_its_sizes_are_called_after_its_ports(address: str) -> None:
    with httpx.Client(base_url=address, timeout=240, headers={"x-language": "fr"}) as client:

        def values(found: object) -> np.ndarray:
            """Numbers as Plotly sends them: packed, or as a list."""
            if isinstance(found, dict):
                return np.frombuffer(b64decode(found["bdata"]), dtype=found["dtype"])
            return np.asarray(found, dtype=float)

        def charts(key: str) -> dict:
            case = client.post(f"/api/alone/{key}", json={}).json()["case"]
            found = client.post("/api/inside", json={"case": case, "place": ""}).json()["charts"]
            return {chart["heading"]: chart["figure"] for chart in found}

        screened = charts("comminution.screen")["Granulométrie"]
        assert [line["name"] for line in screened["data"]] == ["alimentation", "refus", "passant"]
        for line in screened["data"]:
            share = values(line["y"])
            assert np.all(np.diff(share) >= 0.0)
            assert share[0] < 0.1
            assert share[-1] > 99.9
        settled = charts("settling.secondary_settler")
        assert "Couches d’un décanteur secondaire" in settled
        (thickened,) = charts("settling.thickener").values()
        curve, most, load = ({k: values(line[k]) for k in "xy"} for line in thickened["data"][:3])
        # Yoshioka: the line of the greatest load lies on or under the curve from the feed on, and touches it
        fed = values(thickened["data"][4]["x"])[0]
        beyond = (curve["x"] >= fed) & (curve["x"] < most["x"][1])
        line = np.interp(curve["x"], most["x"], most["y"])
        assert np.all((curve["y"] - line)[beyond] >= -1e-6 * line[0])
        assert np.min((curve["y"] - line)[beyond]) < 0.01 * line[0]
        assert 0.0 < load["y"][0] < most["y"][0]
        assert [
            line["name"] for line in charts("filtration.nutsche")["Un gâteau au fil de son cycle"]["data"]
        ] == [
            "épaisseur",
            "saturation",
        ]
        assert charts("streams.pump") == {}


def test_the_page_shows_the_sizes_of_a_machine_alone(page: Page) -> None:
    page.open("calculate/comminution.screen", "fr")
    page.one("[data-inside] .js-plotly-plot")
    assert page.one("[data-inside] h2").text == "Granulométrie"
    page.check()
