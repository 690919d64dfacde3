"""Building a line step by step: every step keeps the text of the others, and gives a line or says what it
still needs.
"""

from __future__ import annotations

import json
import random
import tomllib
from math import log
from pathlib import Path
from typing import Any

import pytest

from granum.cases import building as b
from granum.cases import read_text
from granum.cases.alone import tables
from granum.cases.outline import identifier, outline
from granum.cases.reading import quantity
from granum.cases.scaling import POWERS, entering, scale_of, scaled, size_told
from granum.cases.sections import sections
from granum.core import registry
from granum.core.errors import CaseError, GranumError, InputError
from granum.core.i18n import _, language
from granum.core.index import entries
from granum.flowsheet.drawing import draw
from granum.flowsheet.symbols import word_of

EXAMPLES = sorted(Path("examples").glob("*/*.toml"))
EQUIPMENT = sorted(t.card.key for t in registry.everything().values() if t.card.sort == "equipment")
SALT = {"liquids": ["water", "potassium nitrate"], "solids": ["potassium nitrate"]}


def salt_line() -> str:
    """Crystallizer, filter and dryer, liquor going back."""
    text = b.add_feed(b.new_line("Salt", **SALT), "hot liquor")
    text = b.add_unit(text, "crystallization.msmpr", origin="hot_liquor")
    text = b.add_unit(text, "filtration.horizontal_belt_filter", origin="crystallizer.product")
    text = b.add_unit(text, "drying.well_mixed_dryer", origin="filter.cake")
    return b.connect(text, "filter.filtrate", "crystallizer.feed")


def species_out(run: Any, species: str) -> float:
    """What leaves the line of a dissolved or crystalline species, kg/s."""
    total = 0.0
    for name in run.sheet.products:
        s = run.streams[name]
        m = s.mixture
        for names, flows in ((m.liquids, s.liquid), (m.solids, s.solid_by_species), (m.gases, s.gas)):
            total += sum(float(x) for one, x in zip(names, flows, strict=True) if one.name == species)
    return total


def test_a_line_with_recycle_is_built_and_conserves() -> None:
    text = salt_line()
    assert outline(text).missing == ()
    run = read_text(text).solve()
    fed = float(run.streams["hot_liquor"].liquid[1])
    assert species_out(run, "potassium nitrate") == pytest.approx(fed, rel=1e-9)
    assert run.audit["mass_closure"] < 1e-9
    assert run.audit["energy_closure"] < 1e-9
    assert "purge" in run.units  # or water would go around for ever
    # at 25 °C water holds 0.383 kg/kg (CRC Handbook of Chemistry and Physics); the purge leaves saturated
    purged = run.streams["purge.side"]
    assert float(purged.liquid[1] / purged.liquid[0]) == pytest.approx(0.383, rel=0.05)


def test_each_step_says_what_is_missing() -> None:
    text = b.new_line("Salt", **SALT)
    assert outline(text).missing == (
        "The line has no equipment yet: add the first piece.",
        "The line has no feed yet: add one.",
    )
    text = b.add_unit(text, "filtration.nutsche")
    assert "Filter has no feed yet." in outline(text).missing
    text = b.add_feed(text, "slurry")
    assert set(outline(text).missing) == {"Filter has no feed yet.", "Slurry goes nowhere yet."}
    assert outline(b.connect(text, "slurry", "filter.feed")).missing == ()
    with language("fr"):
        assert "Filtre n’a pas encore d’alimentation." in outline(text).missing


def test_names_are_of_the_language_and_free() -> None:
    with language("fr"):
        text = b.add_unit(b.new_line("Sel", **SALT), "filtration.nutsche")
        text = b.add_unit(text, "filtration.chamber_press")
    assert outline(text).order == ("filtre", "filtre_2")
    assert identifier("Séchoir n° 2") == "séchoir_n_2"
    renamed = b.rename(text, "filtre_2", "Filtre à plateaux")
    assert outline(renamed).order == ("filtre", "filtre_à_plateaux")
    with pytest.raises(InputError, match="already"):
        b.rename(text, "filtre", "filtre 2")


def test_every_piece_of_equipment_has_a_word_of_either_language() -> None:
    words = {word_of(k) for k, thing in registry.everything().items() if thing.card.sort == "equipment"}
    assert not any("_" in word for word in words)
    with language("fr"):
        same = {word for word in words if _(word) == word}
    assert same == {"cyclone", "hydrocyclone"}


def test_what_is_taken_is_divided_and_joined() -> None:
    text = salt_line()
    found = outline(text)
    assert {k.name: (k.origin, k.target) for k in found.links}["purge_product"] == (
        "purge.product",
        "mixer.purge_product",
    )
    again = b.connect(text, "filter.washings", "crystallizer.feed")  # a second stream into the same mixer
    assert [u for u in outline(again).order if u.startswith("mixer")] == ["mixer"]
    shared = b.connect(text, "crystallizer.product", "dryer.feed")
    assert "divider" in outline(shared).order
    assert outline(shared).missing == ()
    with pytest.raises(InputError, match="feed itself"):
        b.connect(text, "filter.washings", "filter.wash")


def test_removal_leads_through_what_only_passes_on_and_takes_its_specifications_along() -> None:
    text = salt_line()
    text = b.set_specification(
        text, "purge.side_fraction", "dryer.evaporation_rate", "25 kg/h", "5 %", "90 %"
    )
    without = b.remove(text, "purge")
    assert "specifications" not in tomllib.loads(without)
    link = next(k for k in outline(without).links if k.origin == "filter.filtrate")
    assert link.target == "mixer.purge_product"
    bare = b.remove(without, "filter")
    assert outline(bare).missing == ("Dryer has no feed yet.",)
    assert b.remove(bare, "hot_gas").count("hot_gas") == 0


def test_a_bypass_mixes_again() -> None:
    text = b.bypass(salt_line(), "dryer", share="25 %")
    assert outline(text).missing == ()
    run = read_text(text).solve()
    wet, cake = run.streams["bypass_side"], run.streams["filter_cake"]
    assert float(wet.mass_flow) == pytest.approx(0.25 * float(cake.mass_flow), rel=1e-9)


def test_a_stream_around_a_unit_is_called_in_the_language_of_whoever_builds() -> None:
    line = salt_line()
    with language("fr"):
        text = b.bypass(line, "dryer")
    (led,) = (k.name for k in outline(text).links if k.origin == "dérivation.side")
    assert led == "dérivation_soutirage"


def test_a_specification_is_met() -> None:
    text = b.set_specification(
        salt_line(), "purge.side_fraction", "purge.mass_flow", "1000 kg/h", "5 %", "90 %"
    )
    run = read_text(text).solve()
    assert run.figure("purge.mass_flow") == pytest.approx(1000 / 3600, rel=1e-6)
    again = b.set_specification(
        text, "purge.side_fraction", "purge.mass_flow_side", "200 kg/h", "5 %", "90 %", "purge_side_fraction"
    )
    assert tomllib.loads(again)["specifications"]["purge_side_fraction"]["equals"] == "200 kg/h"
    assert "specifications" not in tomllib.loads(b.remove_specification(again, "purge_side_fraction"))
    with pytest.raises(GranumError, match="purge"):
        b.set_specification(text, "purge.side_share", "purge.mass_flow_side", "1 kg/h", "1 %", "2 %")


def test_a_feed_is_the_same_stream_in_either_form_and_its_shares_add_up() -> None:
    text = b.add_feed(b.new_line("Slurry", ["water"], ["quartz"]), "slurry")
    text = b.add_unit(text, "streams.heater", origin="slurry")
    totals = b.form_of_feed(text, "slurry", "totals")
    table = tomllib.loads(totals)["feeds"]["slurry"]
    assert (table["mass_flow"], table["solids_mass_fraction"]) == ("1200 kg/h", "16.66666667 %")
    back = tomllib.loads(b.form_of_feed(totals, "slurry", "phases"))["feeds"]["slurry"]
    assert back["liquid_flow"] == "1000 kg/h"
    moist = totals.replace('solids_mass_fraction = "16.66666667 %"', "moisture_dry_basis = 5.0")
    assert moist != totals
    by_phase = b.form_of_feed(moist, "slurry", "phases")
    assert tomllib.loads(by_phase)["feeds"]["slurry"]["liquid_flow"] == "1000 kg/h"
    assert "moisture" not in by_phase
    mixed = b.add_feed(b.new_line("Salt", **SALT), "liquor")
    shares = tomllib.loads(b.share_of_feed(mixed, "liquor", "liquid", "potassium nitrate", "55,5 %"))[
        "feeds"
    ]["liquor"]["liquid"]
    assert shares == {"water": "44.5 %", "potassium nitrate": "55,5 %"}
    with pytest.raises(InputError, match="100 %"):
        b.share_of_feed(mixed, "liquor", "liquid", "potassium nitrate", "120 %")


def test_substances_are_changed_and_feeds_follow() -> None:
    text = b.add_feed(b.new_line("Salt", **SALT), "liquor")
    text = b.choose_substances(text, ["water", "sucrose"], ["sucrose"])
    assert tomllib.loads(text)["feeds"]["liquor"]["liquid"] == {"water": "100 %"}
    with pytest.raises(GranumError):
        b.choose_substances(text, ["watr"], [])
    with pytest.raises(GranumError):
        b.new_line("Nothing")


def test_a_fit_with_its_data_goes_into_the_case() -> None:
    text = Path("examples/lab-to-plant/line.toml").read_text(encoding="utf-8")
    data = Path("examples/lab-to-plant/leaf_test.csv").read_text(encoding="utf-8")
    conditions = tomllib.loads(text)["fits"]["leaf_test"]["conditions"]
    used = b.use_fit(
        text,
        "press",
        "filtration.leaf_test",
        data,
        conditions,
        ["cake_resistance", "medium_resistance", "nothing"],
    )
    table = tomllib.loads(used)["fits"]["leaf_test"]
    assert table["data"] == data
    assert set(table["gives"]) == {"press.cake_resistance", "press.medium_resistance"}
    line = read_text(used)  # no file beside it
    beside = read_text(text, folder=Path("examples/lab-to-plant"))
    assert float(line.sheet.value("press.cake_resistance")) == pytest.approx(
        float(beside.sheet.value("press.cake_resistance"))
    )
    with pytest.raises(InputError, match="none of what"):
        b.use_fit(text, "press", "filtration.leaf_test", data, conditions, ["nothing"])


@pytest.mark.parametrize("model", EQUIPMENT)
def test_every_piece_of_equipment_has_values_to_start_from(model: str) -> None:
    text = b.new_line(
        "Any", ["water", "potassium nitrate"], ["potassium nitrate", "quartz"], ["dry air", "water"]
    )
    text = b.add_unit(text, model)
    values = tomllib.loads(text)["units"]
    ((name, table),) = values.items()
    registry.find(model)(**{k: v for k, v in table.items() if k != "model"})
    assert not [m for m in outline(text).missing if "missing" in m]
    assert f'data-unit="{name}"' in draw(outline(text), growing=True)


def comments(text: str) -> set[str]:
    """Comments of a text by what they say."""
    return {
        line.partition("#")[2].strip()
        for line in text.split("\n")
        if "#" in line and not line.strip().startswith('"')
    }


@pytest.mark.parametrize(
    "path",
    [p for p in EXAMPLES if "[units." in p.read_text(encoding="utf-8")],
    ids=lambda p: f"{p.parent.name}-{p.stem}",
)
def test_an_operation_on_an_example_leaves_everything_else_as_it_was(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    found = outline(text)
    assert found.missing == ()
    assert draw(found).count("data-unit") == len(found.order)
    for unit in found.order:
        renamed = b.rename(text, unit, f"{unit}_x")
        assert comments(renamed) == comments(text)
        assert len(renamed.split("\n")) == len(text.split("\n"))
        there, back = tomllib.loads(renamed), tomllib.loads(b.rename(renamed, f"{unit}_x", unit))
        assert back == tomllib.loads(text), unit
        assert (
            f'"{unit}.'
            not in json.dumps({k: v for k, v in there.items() if k not in ("title", "description", "units")})
            or unit in found.feeds
        )
        out = b.remove(text, unit)
        gone = set(tomllib.loads(text)["units"]) - set(tomllib.loads(out).get("units", {}))
        assert gone == {unit}
        own = next(s for s in sections(text) if s.path == ("units", unit))
        inside = comments("\n".join(text.split("\n")[own.first : own.last]))
        streams = comments("\n".join(line for line in text.split("\n") if unit in line))
        assert comments(text) - comments(out) <= inside | streams
    for model in ("streams.heater", "filtration.nutsche"):
        added = b.add_unit(text, model)
        assert [line for line in text.split("\n") if line not in added.split("\n")] == []


OPERATIONS = (
    "add_unit",
    "add_feed",
    "connect",
    "disconnect",
    "remove",
    "rename",
    "bypass",
    "share",
    "form",
    "spec",
    "odd",
)


@pytest.mark.parametrize("seed", range(12))
def test_random_operations_never_leave_a_text_that_cannot_be_read(seed: int) -> None:
    rng = random.Random(seed)
    text = "# mine: keep\n" + b.new_line(
        "Random", ["water", "sucrose"], ["sucrose", "quartz"], ["dry air", "water"][: 2 * (seed % 2)]
    )
    for _step in range(40):
        found = outline(text)
        ends = [k.origin or k.name for k in found.links] or ["nothing"]
        inlets = [f"{u}.{p}" for u in found.order for p in (found.units[u].inlet_names() or ("feed",))] or [
            "none.feed"
        ]
        anything = [*found.order, *found.feeds, "nothing"]
        operation = rng.choice(OPERATIONS)
        try:
            if operation == "add_unit":
                after = b.add_unit(text, rng.choice(EQUIPMENT), origin=rng.choice(["", *ends]))
            elif operation == "add_feed":
                after = b.add_feed(
                    text, rng.choice(["", "Eau chaude", "feed", "x.y"]), rng.choice(["", *inlets])
                )
            elif operation == "connect":
                after = b.connect(text, rng.choice(ends), rng.choice(inlets))
            elif operation == "disconnect":
                after = b.disconnect(text, rng.choice([*ends, *inlets]))
            elif operation == "remove":
                after = b.remove(text, rng.choice(anything)) if rng.random() < 0.5 else text
            elif operation == "rename":
                after = b.rename(
                    text,
                    rng.choice(anything),
                    rng.choice(["Bac à eau", "a.b", "", "mixer", "n°", 'quote"s', "# x"]),
                )
            elif operation == "bypass":
                after = b.bypass(text, rng.choice(anything))
            elif operation == "share":
                after = b.share_of_feed(
                    text,
                    rng.choice(anything),
                    "liquid",
                    rng.choice(["water", "sucrose"]),
                    rng.choice(["30 %", "2", "x", ""]),
                )
            elif operation == "form":
                after = b.form_of_feed(text, rng.choice(anything), rng.choice(["totals", "phases", "?"]))
            elif operation == "spec":
                after = b.set_specification(
                    text,
                    f"{rng.choice(anything)}.temperature",
                    f"{rng.choice(anything)}.mass_flow",
                    "1 kg/h",
                    "1",
                    "2",
                )
            else:
                after = b.choose_substances(
                    text, ["water", rng.choice(["sucrose", "ethanol", "water"])], ["sucrose", "quartz"]
                )
        except GranumError:  # refused in words; anything else is a fault
            continue
        raw = tomllib.loads(after)
        assert after.startswith("# mine: keep\n")
        now = outline(after)
        drawn = draw(now, growing=True, loose=now.open_inlets)
        assert all(f'data-unit="{u}"' in drawn for u in now.order)
        assert len(set(now.order)) == len(raw.get("units", {}))
        targets = [k.target for k in now.links if k.target]
        assert len(targets) == len(set(targets)), "two streams into one inlet"
        origins = [k.origin for k in now.links if k.origin]
        assert len(origins) == len(set(origins))
        text = after


def test_text_that_is_no_case_is_refused_in_words() -> None:
    for text in ("title = ", "[units.x", "\x00"):
        with pytest.raises(CaseError, match="TOML"):
            b.add_feed(text)


@pytest.mark.parametrize(
    ("enters", "models"),
    [
        ("solution", ["crystallization.msmpr", "crystallization.vacuum_crystallizer", "streams.heater"]),
        (
            "solution",
            ["evaporation.evaporator", "evaporation.recompression_evaporator", "drying.closed_dryer"],
        ),
        ("suspension", ["settling.thickener", "filtration.chamber_press", "cyclones.hydrocyclone"]),
        ("moist_solid", ["drying.well_mixed_dryer", "drying.convective_dryer", "drying.rotary_dryer"]),
        (
            "broken_solid",
            ["comminution.cone_crusher", "comminution.ball_mill", "comminution.vibrating_screen"],
        ),
        ("dusty_gas", ["cyclones.gas_cyclone"]),
    ],
)
def test_a_line_is_solved_as_soon_as_its_first_piece_stands(enters: str, models: list[str]) -> None:
    begun = b.begin("First", enters)
    for model in models:
        run = read_text(b.add_unit(begun, model, origin=enters)).solve()
        assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9


def test_what_a_line_of_dry_solids_cannot_have_is_refused_in_words() -> None:
    """Every machine on a line without liquid or gas: solved and closed, or a message that says why not."""
    begun, solved = b.begin("Quarry", "broken_solid", solid="granite"), []
    for model in (key for key, entry in entries().items() if entry.sort == "equipment"):
        try:
            run = read_text(b.add_unit(begun, model, origin="broken_solid")).solve()
        except GranumError:
            continue
        assert max(run.audit["mass_closure"], run.audit["energy_closure"]) < 1e-9
        solved.append(model)
    assert {"comminution.cone_crusher", "comminution.triple_deck_screen", "conveying.hopper"} <= set(solved)
    assert not any(model.startswith(("settling.", "drying.")) for model in solved)


def test_a_line_of_another_size_gets_machines_of_that_size() -> None:
    begun = (
        b.begin("Large", "suspension")
        .replace('"1000 kg/h"', '"10000 kg/h"')
        .replace('"200 kg/h"', '"2000 kg/h"')
    )
    small = tomllib.loads(b.add_unit(b.begin("Small", "suspension"), "filtration.chamber_press"))["units"][
        "filter"
    ]
    large = tomllib.loads(b.add_unit(begun, "filtration.chamber_press"))["units"]["filter"]
    assert (small["area"], large["area"]) == ("10 m2", "100 m2")
    assert small["chamber_depth"] == large["chamber_depth"]


def test_substances_that_the_case_describes_may_be_chosen() -> None:
    text = b.new_line("Dryer", ["water"], ["quartz"], ["dry air", "water"])
    text += '[solid.PVC]\ndensity = "1.4 g/cm3"\nheat_capacity = "0.9 kJ/(kg K)"\n'
    after = b.choose_substances(text, ["water"], ["PVC"], ["dry air", "water"])
    assert 'solids = ["PVC"]' in after
    with pytest.raises(InputError, match="'PVG' is not known"):
        b.choose_substances(text, ["water"], ["PVG"], ["dry air", "water"])


def test_a_solid_with_the_name_of_what_is_dissolved_is_told_its_crystals() -> None:
    text = b.new_line("Salt", ["water"], ["quartz"], ["water"])
    with pytest.raises(InputError, match="'sodium sulfate decahydrate', 'sodium sulfate anhydrous'"):
        b.choose_substances(text, ["water", "sodium sulfate"], ["sodium sulfate"], ["water"])


def test_what_is_put_on_a_stream_is_sized_for_it() -> None:
    """The example of a thickener is its measure: ten times as much need ten times its area, within the
    two digits that are written.
    """
    text = b.begin("Mud", "suspension")
    alone = tables("settling.thickener")
    own = sum(quantity(alone["feeds"]["feed"][w], "MassFlow", w, "") for w in ("solid_flow", "liquid_flow"))
    area = quantity(alone["units"]["thickener"]["area"], "Area", "area", "")
    brings = {"mass_flow": f"{10 * own} kg/s"}
    text = b.add_unit(text, "settling.thickener", origin="suspension", brings=brings)
    made = tomllib.loads(text)["units"]["thickener"]["area"]
    assert quantity(made, "Area", "area", "") == pytest.approx(10 * area, rel=0.05)
    scale = scale_of("settling.thickener", outline(text), "suspension", brings)
    assert size_told("settling.thickener", {"area": f"{area} m^2"}, scale).startswith("Sized for ")
    assert size_told("settling.thickener", {"area": f"{area} m^2"}, scale._replace(times=1.0)) == ""
    cyclones = {"diameter": "0.3 m", "parallel_number": 1}
    assert scaled("cyclones.hydrocyclone", cyclones, scale._replace(times=2.3)) == {"parallel_number": 3}


@pytest.mark.parametrize("name", sorted(POWERS))
def test_every_size_that_grows_is_one_of_some_equipment(name: str) -> None:
    assert any(name in {p.name for p in registry.find(key).card.parameters} for key in EQUIPMENT)


def test_a_dryer_on_a_stream_has_gas_section_and_shape_of_its_example() -> None:
    """Four times as much enters: four times the gas through four times the section, a drum twice as long and
    at the same speed of its shell.
    """
    alone = tables("drying.rotary_dryer")
    own = entering({"feeds": alone["feeds"]}, ["feed"], gas=True)
    text = b.begin("Sand", "moist_solid", solid="sand")
    text = b.add_unit(
        text, "drying.rotary_dryer", origin="moist_solid", brings={"mass_flow": f"{4 * own} kg/s"}
    )
    made, small = tomllib.loads(text)["units"]["dryer"], alone["units"]["rotary_dryer"]
    for name, kind, times in (
        ("diameter", "Length", 2.0),
        ("length", "Length", 2.0),
        ("rotation_speed", "RotationSpeed", 0.5),
    ):
        sizes = [quantity(unit[name], kind, name, "") for unit in (made, small)]
        assert sizes[0] == pytest.approx(times * sizes[1], rel=0.05), name
    gas = 4 * quantity(alone["feeds"]["gas"]["gas_flow"], "MassFlow", "gas_flow", "")
    feeds = tomllib.loads(text)["feeds"]
    assert quantity(feeds["hot_gas"]["gas_flow"], "MassFlow", "gas_flow", "") == pytest.approx(gas, rel=0.05)
    assert feeds["moist_solid"]["solid"] == {"quartz": "100 %"}, "sand is what the library calls quartz"


def test_a_screen_opens_around_the_sizes_that_enter_it() -> None:
    """Half of what enters is finer than the median: a screen of the example's 8 mm would pass all of it."""
    text = b.begin("Sand", "suspension", solid="quartz")
    feed = tomllib.loads(text)["feeds"]["suspension"]["sizes"]
    median = 150.0 * log(2.0) ** (1.0 / feed["distribution_exponent"])  # Rosin and Rammler's, µm
    made = tomllib.loads(b.add_unit(text, "comminution.screen", origin="suspension"))["units"]
    (screen,) = made.values()
    assert float(screen["separation"]["cut_size"].removesuffix(" um")) == pytest.approx(median, rel=0.05)
    brought = {"mass_flow": "1 kg/s", "median_size": "20 mm"}
    made = tomllib.loads(
        b.add_unit(text, "comminution.double_deck_screen", origin="suspension", brings=brought)
    )
    (decks,) = made["units"].values()
    upper, lower = (float(decks[name]["cut_size"].split()[0]) for name in ("upper_deck", "lower_deck"))
    assert (upper * lower) ** 0.5 == pytest.approx(20.0, rel=0.05)
    assert upper / lower == pytest.approx(12.0 / 4.0, rel=0.05)  # of the example
    # karra1979: no capacity is left below 0.6 mm
    made = tomllib.loads(b.add_unit(text, "comminution.vibrating_screen", origin="suspension"))["units"]
    assert made[next(iter(made))]["aperture"] == "800 um"
