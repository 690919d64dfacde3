"""A default that decides the answer is shown as such, in the JSON and on the terminal."""

from __future__ import annotations

import granum as gr
from granum.reports.terminal import print_result


def test_inputs_that_were_not_given_are_marked(capsys):
    found = gr.humid_gas.enthalpy.evaluate("30 degC", humidity_ratio=0.01)
    rows = found.as_json()["inputs"]
    assert rows["pair"]["default"] is True
    assert rows["pressure"]["default"] is True
    assert "default" not in rows["temperature"]
    assert "default" not in rows["humidity_ratio"]
    given = gr.humid_gas.enthalpy.evaluate(
        "30 degC", humidity_ratio=0.01, pair="air_water", pressure="1 atm"
    ).as_json()["inputs"]
    assert "default" not in given["pair"]
    assert "default" not in given["pressure"]
    print_result(found)
    lines = capsys.readouterr().out.splitlines()
    assert any("gas–vapor pair (default)" in line for line in lines)
    assert not any("humidity ratio (default)" in line for line in lines)


def test_procedures_mark_them_too():
    found = gr.particles.size_summary.evaluate("2, 4, 8 um", "50, 50 %")
    assert {"basis", "in_class", "sphericity"} <= found.defaults
