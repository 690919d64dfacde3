"""Solids against other tables, and materials of the user's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from granum import materials as m
from granum.core.errors import InputError
from granum.core.sources import bibliography, keys_of
from granum.materials.correlation import Correlation

# J/(kg K) near 25 °C from other tables than the library's: JANAF (quartz, corundum, hematite, magnetite,
# periclase, halite …)
HEAT_CAPACITY = {
    "quartz": 742,
    "calcite": 819,
    "alumina": 775,
    "hematite": 651,
    "magnetite": 650,
    "rutile": 690,
    "magnesia": 922,
    "lime": 764,
    "barite": 437,
    "pyrite": 519,
    "galena": 207,
    "sphalerite": 473,
    "sodium chloride": 858,
    "potassium chloride": 688,
    "silicon carbide": 670,
    "starch": 1550,
    "sucrose": 1244,
    "copper sulfate pentahydrate": 1126,
}
DENSITY = {
    "potassium nitrate": 2109,
    "sodium chloride": 2165,
    "potassium chloride": 1984,
    "copper sulfate pentahydrate": 2286,
    "potassium sulfate": 2660,
    "sodium sulfate": 2680,
    "sodium sulfate decahydrate": 1464,
    "magnesium sulfate heptahydrate": 1680,
    "potassium alum": 1757,
    "sucrose": 1588,
    "ammonium sulfate": 1769,
    "borax": 1730,
    "sodium nitrate": 2260,
}


@pytest.mark.parametrize("name", HEAT_CAPACITY)
def test_heat_capacity(name: str) -> None:
    assert m.solid(name).heat_capacity("25 degC") == pytest.approx(HEAT_CAPACITY[name], rel=0.035)


@pytest.mark.parametrize("name", [n for n in DENSITY if n != "sodium sulfate"])
def test_density_of_crystals_against_mullin(name: str) -> None:
    assert m.solid(name).density("20 degC") == pytest.approx(DENSITY[name], rel=0.025)


def test_every_solid_is_complete() -> None:
    assert len(m.names("solid")) >= 60
    for name in m.names("solid"):
        s = m.solid(name)
        assert isinstance(s.density, Correlation), name
        assert isinstance(s.heat_capacity, Correlation), name
        assert 700 < s.density(293.15) < 9000, name
        assert 150 < s.heat_capacity(298.15) < 2200, name
        for law in (s.density, s.heat_capacity, s.conductivity):
            if isinstance(law, Correlation):
                assert all(key in bibliography() for key in keys_of(law.source)), (name, law.source)
        assert s.french


OWN = """
[fluid.testol]
molar_mass = 0.1
liquid_density = { form = "polynomial_celsius", coefficients = [0.9, -0.001], range = [273.15, 373.15], unit = "g/cm^3", source = "own data" }

[solid.testite]
fr = "testite"
density = { value = 2.5, unit = "g/cm^3", source = "own data" }
heat_capacity = { value = 0.2, unit = "kcal/(kg*K)", source = "own data" }

[solute."testite in testol"]
molar_mass = 0.2
solvent = "testol"
[[solute."testite in testol".branches]]
crystal = "testite"
stable = [273.15, 353.15]
basis = "mole fraction anhydrous"
form = "vant_hoff"
coefficients = [2.0, -1000.0]
range = [273.15, 353.15]
source = "own data"
"""  # noqa: E501


def test_own_materials_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text(OWN, encoding="utf-8")
    assert m.load(path) == ["testite", "testite in testol", "testol"]
    assert m.fluid("testol").liquid_density("10 degC") == pytest.approx(890.0)
    assert m.solid("testite").heat_capacity(300.0) == pytest.approx(836.8)
    system = m.solute("testite in testol")
    x = 2.718281828**2 * 2.718281828 ** (-1000 / 300)
    assert float(system.solubility(300.0)) == pytest.approx(x * 0.2 / ((1 - x) * 0.1), rel=1e-8)
    assert m.load(path) == ["testite", "testite in testol", "testol"]  # the same file may serve a second case
    other = tmp_path / "other.toml"
    other.write_text(OWN + "# another file\n", encoding="utf-8")
    with pytest.raises(InputError, match="already"):
        m.load(other)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("[solid.a]\ndensity = { value = 2.0, unit = 's', source = 'x' }", "does not fit"),
        ("[solid.a]\ndensity = { value = 2.0 }", "source"),
        ("[solid.a]\ndensty = { value = 2.0, source = 'x' }", "densty"),
        ("[fluid.a]\nmolar_mass = -1", "molar_mass"),
        (
            (
                "[solid.a]\ndensity = { form = 'polynomal', coefficients = [1], range = [200, 300], "
                "source = 'x' }"
            ),
            "polynomial",
        ),
        ("[solid.a]\ndensity = { form = 'polynomial', range = [200, 300], source = 'x' }", "coefficients"),
        ("[solid.a]\ndensity = { form = 'polynomial', coefficients = [1], source = 'x' }", "range"),
        ("[solid.a\n", "TOML"),
    ],
)
def test_a_faulty_file_is_explained(tmp_path: Path, text: str, word: str) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=word):
        m.load(path)
    assert "a" not in m.names()
    with pytest.raises(InputError, match="cannot be read"):
        m.load(tmp_path / "missing.toml")
