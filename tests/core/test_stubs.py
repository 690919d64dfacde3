"""What an editor and a type checker see of the domains."""

import importlib.util
import inspect
import json
import subprocess
import sys
from collections import defaultdict

import pytest
from tests.sharing.places import ROOT

import granum as gr
from granum.core.registry import everything
from granum.core.stubs import PACKAGES, index, path_of, path_of_index, stub_of


@pytest.mark.parametrize("domain", PACKAGES)
def test_stub_lists_what_the_domain_offers(domain):
    assert path_of(domain).read_text(encoding="utf-8") == stub_of(domain), "run: python -m granum.core.stubs"


def test_the_index_lists_every_card():
    assert path_of_index().read_text(encoding="utf-8") == index(), "run: python -m granum.core.stubs"


def test_a_class_made_for_many_cards_is_no_name_of_the_domain():
    """Isotherms of products are made by one function, each a class of the same name."""
    with pytest.raises(AttributeError, match="has no 'Product'"):
        gr.drying.Product  # noqa: B018


def test_stub_of_the_package_has_all_its_rooms():
    text = (path_of("drying").parents[1] / "__init__.pyi").read_text(encoding="utf-8")
    for name in dir(gr):
        assert f"{name} as {name}" in text or f"{name}: " in text


def test_no_name_is_both_a_card_and_a_helper():
    cards = {(key.split(".")[0], thing.__name__) for key, thing in everything().items()}
    places = defaultdict(set)
    for name, module in list(sys.modules.items()):
        if module is not None and name.startswith("granum."):
            for own, thing in vars(module).items():
                if callable(thing) and not own.startswith("_") and getattr(thing, "__module__", None) == name:
                    places[name.split(".")[1], own].add(name)
    assert {name: modules for name, modules in places.items() if name in cards and len(modules) > 1} == {}


PROBE = """
import granum as gr
from granum.drying import TrayDryer
from granum.particles import terminal_velocity

good = terminal_velocity(particle_diameter="85 um", particle_density=2630.0, fluid_density=998.0, dynamic_viscosity=1e-3)
terminal_velocity(particle_diametre="85 um", particle_density=2630.0, fluid_density=998.0, dynamic_viscosity=1e-3)
gr.particles.terminal_velocity("85 um")
TrayDryer(temperature_inlet="80 degC", gas_velocity=1.0, dry_mass_per_area=10.0, moisture_outlet=0.1, critical_moistur=0.2)
gr.particles.terminal_velocty(1.0)
"""  # noqa: E501


def test_misspelt_words_are_type_errors(tmp_path):
    """Pyright finds the four wrong lines of the probe, and nothing in the right ones."""
    file = tmp_path / "probe.py"
    file.write_text(PROBE)
    (tmp_path / "pyrightconfig.json").write_text(
        json.dumps({"extraPaths": [str(path_of("drying").parents[2])]})
    )
    done = subprocess.run(
        [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    rows = {
        row["range"]["start"]["line"]
        for row in json.loads(done.stdout)["generalDiagnostics"]
        if row["severity"] == "error"
    }
    assert rows == {6, 7, 8, 9}


def test_help_tells_what_is_declared():
    """Unit, bounds, default, result, equation, source: of a formula, and of a class with its practical
    limits.
    """
    formula = gr.particles.terminal_velocity.__doc__
    for words in (
        "particle_diameter: particle diameter d_p, m, above 0",
        "terminal_velocity: terminal velocity v_t, m/s",
        "Equation: v_t",
        "Brown, P. P.",
    ):
        assert words in formula
    oven = gr.drying.TrayDryer.__doc__
    for words in (
        "tray_gap: ",
        "by default 50 mm",
        "Practical limit: air speed over the trays, 0.5 … 8 m/s (treybal1980, ch. 12)",
        "drying_time: drying time",
    ):
        assert words in oven
    assert "critical_moisture" in inspect.signature(gr.drying.TrayDryer).parameters


def test_the_tree_of_the_documentation_is_that_of_the_package():
    place = ROOT / "docs"
    script = importlib.util.spec_from_file_location("house", place / "house.py")
    house = importlib.util.module_from_spec(script)
    script.loader.exec_module(house)
    page = house.PAGE.read_text(encoding="utf-8")
    assert page == house.written(page), "run: python docs/house.py"
