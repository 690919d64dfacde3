"""Every lab test is tried with example data, in the page and from the command line, and fits them."""

from __future__ import annotations

import json
import shlex

import httpx
import pytest
from tests.app.browsing import Page
from tests.sharing.lab_data import keys
from tests.sharing.places import EXAMPLES
from typer.testing import CliRunner

from granum.cli import app

# A result that is told, not a doubt: the best of several models, what a sludge is like, the grid.
TOLD = ("Best by AICc", "fits best", "settles", "Fitted on")
# Its three constants cannot be told apart over any range in which people measure; the curve is good.
ALIKE = {"crystallization.solubility_apelblat"}
# Records of the other folders, most of them measured, whose fits rightly tell what the record is like.
RECORDS = {
    "crystallization.batch_kinetics",
    "filtration.compressibility",
    "filtration.leaf_test",
    "fluidization.pressure_curve",
    "settling.batch_test",
}


@pytest.fixture(scope="module")
def trials(address: str) -> dict[str, dict]:
    with httpx.Client(base_url=address, timeout=240, headers={"x-language": "en"}) as client:
        return {key: client.get(f"/api/cards/{key}").json()["trial"] for key in keys()}


def doubts(key: str, flags: list) -> list[str]:
    texts = [flag if isinstance(flag, str) else flag["message"] for flag in flags]
    return [
        text
        for text in texts
        if not any(word in text for word in TOLD)
        and not (key in ALIKE and "can hardly be told apart" in text)
    ]


@pytest.mark.parametrize("key", keys())
def test_a_lab_test_opens_with_its_example_unflagged(key: str, trials: dict, address: str) -> None:
    trial = trials[key]
    assert trial, "no line 'granum fit' in a README of the examples"
    with httpx.Client(base_url=address, timeout=240, headers={"x-language": "en"}) as client:
        found = client.post(
            f"/api/fit/{key}",
            files={"file": ("data.csv", trial["table"], "text/csv")},
            data={"conditions": json.dumps(trial["values"])},
        )
    assert found.status_code == 200, found.text
    told = found.json()
    if key not in RECORDS:
        assert not doubts(key, told["flags"])
    assert told["shown"]
    assert all(row["together"] for row in told["shown"])


COMMANDS = {
    words[2]: (place.parent, words)
    for place in sorted(EXAMPLES.glob("*/README.md"), reverse=True)
    for line in place.read_text(encoding="utf-8").splitlines()
    if line.startswith("granum fit ")
    for words in (shlex.split(line),)
}


@pytest.mark.parametrize(
    "key", ["filtration.pump_curve", "drying.thin_layer_test", "settling.sludge_index_test"]
)
def test_the_command_of_an_example_fits_the_same(key: str) -> None:
    folder, words = COMMANDS[key]
    table = folder / words[3].rsplit("/", 1)[-1]
    found = CliRunner().invoke(app, ["--json", "fit", key, str(table), *words[4:]])
    if found.exit_code == 2:
        found = CliRunner().invoke(app, ["fit", key, str(table), *words[4:], "--json"])
    assert found.exit_code == 0, found.output
    assert not doubts(key, json.loads(found.stdout)["flags"])


def test_made_data_say_so() -> None:
    for table in EXAMPLES.glob("lab-tests/*.csv"):
        head = table.read_text(encoding="utf-8").splitlines()[0]
        assert head.startswith(("# Made: ", "# Computed by ")), table.name


@pytest.mark.parametrize("language", ["en", "fr"])
def test_an_example_is_tried_in_the_page(page: Page, language: str) -> None:
    page.open("lab/filtration.pump_curve", language)
    page.button("Try with example data" if language == "en" else "Essayer avec des données d’exemple").click()
    page.one("[data-parameter=pressure_shutoff]")
    page.settle()
    page.says("[data-trial]", "pump_curve_made.csv")
    page.check()
