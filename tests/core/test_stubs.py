"""What an editor and a type checker see of the domains."""

import json
import subprocess
import sys
from collections import defaultdict

import pytest

import granum
from granum.core.registry import DOMAINS, everything
from granum.core.stubs import PACKAGES, path_of, stub_of


@pytest.mark.parametrize("domain", PACKAGES)
def test_stub_lists_what_the_domain_offers(domain):
    assert path_of(domain).read_text(encoding="utf-8") == stub_of(domain), "run: python -m granum.core.stubs"


def test_stub_of_the_package_has_all_its_rooms():
    text = (path_of("drying").parents[1] / "__init__.pyi").read_text(encoding="utf-8")
    for name in dir(granum):
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
"""


def test_misspelt_words_are_type_errors(tmp_path):
    """Pyright finds the four wrong lines of the probe, and nothing in the right ones."""
    file = tmp_path / "probe.py"
    file.write_text(PROBE)
    done = subprocess.run(
        [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, str(file)], capture_output=True, text=True
    )
    rows = {row["range"]["start"]["line"] for row in json.loads(done.stdout)["generalDiagnostics"] if row["severity"] == "error"}
    assert rows == {6, 7, 8, 9}
