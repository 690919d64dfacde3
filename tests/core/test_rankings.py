"""Choices are tables: rows in the terminal, objects in JSON."""

import json

import granum as gr
from granum.reports.terminal import print_result

GIVEN = {
    "product_form": "powder",
    "mass_flow": "20 t/h",
    "moisture_dry_basis_inlet": 0.54,
    "moisture_dry_basis_outlet": 0.18,
    "temperature_limit": "60 degC",
    "residence_time": "8 hour",
}


def test_rows_of_a_choice(capsys, monkeypatch):
    """Maize wants a silo (the notes' table of dryers); every row names its dryer, mark, size, energy, what
    speaks for it and what against.
    """
    monkeypatch.setenv("COLUMNS", "160")
    result = gr.drying.choose.evaluate(**GIVEN)
    data = json.loads(json.dumps(result.as_json()))
    assert data["rows"][0]["dryer"] == {"value": "silo dryer", "unit": ""}
    assert [row["dryer"]["value"] for row in data["rows"]] == data["outputs"]["dryer"]["value"]
    assert {"suitability", "dryer_size", "energy_per_water", "speaks_for", "speaks_against"} < set(
        data["rows"][0]
    )
    marks = [row["suitability"]["value"] for row in data["rows"]]
    assert marks == sorted(marks, reverse=True)
    print_result(result)
    lines = capsys.readouterr().out.splitlines()
    row = next(line for line in lines if line.strip().startswith("silo dryer"))
    assert "kJ/kg" in row
    assert "%" in row
    best, last = data["rows"][0], data["rows"][-1]
    assert "time enough to dry" in best["speaks_for"]["value"]
    assert not best["speaks_against"]["value"]
    assert "does not take this form" in last["speaks_against"]["value"]


def test_a_plain_result_has_no_rows():
    assert "rows" not in gr.particles.reynolds_number.evaluate(1e-3, 0.1, 1000.0, 1e-3).as_json()
