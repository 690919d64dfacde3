"""What every input of every card must hold: odd values are taken or refused in one sentence, counts have
bounds.
"""

from __future__ import annotations

import typing
from decimal import Decimal
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest
from annotated_types import Ge, Le

from granum.cases import schema
from granum.core import registry, units
from granum.core.conversion import convert
from granum.core.errors import GranumError, InputError
from granum.core.glossary import endings, parsed_ending, quantity_in
from granum.core.i18n import catalog
from granum.core.parameters import Parameter

CARDS = {key: thing.card for key, thing in registry.everything().items()}


class Hostile:
    """An object of another program whose conversions fail."""

    def __float__(self) -> float:
        raise RuntimeError("no")

    def __array__(self, *args: Any, **kwargs: Any) -> Any:
        raise RuntimeError("no")

    def __repr__(self) -> str:
        raise RuntimeError("no")


class Opaque:
    """An object of another program whose attributes fail."""

    def __getattr__(self, name: str) -> Any:
        raise RuntimeError("no")


def nested(depth: int) -> list[Any]:
    found: Any = 1.0
    for _ in range(depth):
        found = [found]
    return found


# what no quantity can be
ODD: dict[str, Any] = {
    "empty list": [],
    "empty array": np.array([]),
    "rows without values": np.ones((3, 0)),
    "empty text": "",
    "word": "abc",
    "table": {"a": 1},
    "object": object(),
    "bytes": b"12",
    "complex": 1j,
    "true": True,
    "truth of NumPy": np.bool_(True),
    "ragged": [1, [2, 3]],
    "words": ["a", "b"],
    "nan": float("nan"),
    "nan of NumPy": np.float64("nan"),
    "nan as array": np.array(np.nan),
    "inf": float("inf"),
    "-inf": -np.inf,
    "digits": 10**5000,
    "text of digits": "9" * 5000,
    "set": {1, 2},
    "hostile": Hostile(),
    "opaque": Opaque(),
    "array of words": np.array(["a"]),
    "array of None": np.array([None]),
    "dates": np.array(["1970-01-01"], dtype="datetime64[s]"),
    "complex array": np.array([1j]),
    "truths": np.array([True, False]),
    "list of None": [None],
    "nan in a list": [1.0, float("nan")],
    "class": int,
    "generator": iter(()),
    "signaling": Decimal("sNaN"),
    "truths of JAX": jnp.array([True]),
    "complex of JAX": jnp.array([1j]),
    "brackets": "[" * 3000,
    "braces": "{" * 3000,
    "deep": nested(80),
    "records": np.zeros(2, dtype=[("a", float)]),
    "module": np,
}


def shapes() -> dict[str, tuple[Parameter, bool]]:
    """One parameter of every sort of declaration there is, and whether several values may stand there."""
    found: dict[Any, tuple[str, Parameter, bool]] = {}
    for key, card in CARDS.items():
        for p in card.parameters:
            several = card.sort == "formula"
            sort = (
                p.kind,
                p.series is None,
                p.law,
                p.choices,
                p.sort,
                p.within,
                p.optional,
                p.default is None,
                several,
            )
            found.setdefault(sort, (f"{key} {p.name}", p, several))
    return {name: (p, several) for name, p, several in found.values()}


def test_odd_values_are_refused_in_one_sentence() -> None:
    taken, raw = [], []
    for place, (p, several) in shapes().items():
        for name, value in ODD.items():
            if (p.sort is str and isinstance(value, str)) or (
                p.sort is bool and name in ("true", "truth of NumPy")
            ):
                continue
            try:
                convert(value, p, " for it", several)
                taken.append((place, name))
            except InputError as problem:
                if not 0 < len(problem.message) < 700:
                    raw.append((place, name, "length", len(problem.message)))
            except Exception as problem:  # the test is about which errors come out
                raw.append((place, name, type(problem).__name__, str(problem)[:80]))
    assert not raw, raw[:10]
    assert not [t for t in taken if "digits" not in t[1]], taken[:10]
    assert not taken, taken[:10]


@pytest.mark.parametrize("value", [np.ones((2, 2)), [1.0, 2.0], np.array([0.5])])
def test_a_card_that_is_no_formula_takes_single_values(value: Any) -> None:
    for place, (p, several) in shapes().items():
        if p.kind is not None and not p.series and not several:
            with pytest.raises(InputError, match=r"takes one value|is not possible|below any operation"):
                convert(value, p, f" for {place}")


def test_every_count_of_a_card_has_bounds() -> None:
    counts = [(key, p) for key, card in CARDS.items() for p in card.parameters if p.sort is int]
    assert len(counts) > 30
    for key, p in counts:
        assert p.within is not None, f"'{p.name}' of {key} has no bounds"
        assert np.isfinite([p.within.lower, p.within.upper]).all(), f"'{p.name}' of {key} has no bounds"
        assert p.default is None or p.required or p.within.lower <= p.default <= p.within.upper
        row = p.as_json()
        assert (row["lower"], row["upper"]) == (p.within.lower, p.within.upper)
        for bad in (-1, 10**12, p.within.lower - 1, p.within.upper + 1, 1.5, "3,5", True, 10**5000):
            with pytest.raises(InputError, match=f"'{p.name}'"):
                convert(bad, p, f" for {key}")
        assert convert(str(int(p.within.upper)), p) == convert(float(p.within.upper), p) == p.within.upper


def test_a_word_that_has_a_unit_is_declared_in_it() -> None:
    wrong = [
        (key, p.name, p.term.unit, p.kind.unit)
        for key, card in CARDS.items()
        for p in (*card.parameters, *card.outputs)
        if p.term and p.term.unit and p.kind and not units.same_dimension(p.term.unit, p.kind.unit)
    ]
    assert not wrong


def test_a_temperature_difference_takes_kelvins() -> None:
    """Conduction through the dry layer alone: λ ρ ε L²/(2 k ΔT), with a film that does not resist."""
    front: Any = registry.find("drying.drying_time_receding_front")
    inputs = {
        "thickness": "4 cm",
        "void_fraction": 0.36,
        "heat_transfer_coefficient": 1e12,
        "thermal_conductivity": 0.2,
    }
    time = front(**inputs, temperature_difference="44 K", liquid_density=998.0, heat_of_vaporization=2.4e6)
    assert time == pytest.approx(2.4e6 * 998.0 * 0.36 * 0.04**2 / (2 * 0.2 * 44.0), rel=1e-9)


def test_every_count_of_a_case_file_has_bounds() -> None:
    tables = [t for t in vars(schema).values() if isinstance(t, type) and issubclass(t, schema.BaseModel)]
    for table in tables:
        for name, found in table.model_fields.items():
            if found.annotation is int or (
                int in typing.get_args(found.annotation) and str not in typing.get_args(found.annotation)
            ):
                limits = {type(m) for m in found.metadata}
                assert {Ge, Le} <= limits, f"'{name}' of {table.__name__} has no bounds"


def test_defaults_hold_for_their_own_declaration() -> None:
    for key, card in CARDS.items():
        for p in card.parameters:
            if not p.required and isinstance(p.default, (int, float)) and not p.law:
                convert(p.default, p, f" for {key}")


def test_what_is_refused_by_a_card_is_refused_when_it_is_called() -> None:
    reynolds: Any = registry.find("particles.reynolds_number")
    good = {"particle_diameter": 1e-3, "velocity": 0.1, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}
    for value in ODD.values():
        with pytest.raises(GranumError):
            reynolds(**{**good, "particle_diameter": value})
        with pytest.raises(GranumError):
            reynolds.evaluate(**{**good, "particle_diameter": value})
    with pytest.raises(InputError, match=r"'particle_diameter' \(2\), 'velocity' \(3\)"):
        reynolds(**{**good, "particle_diameter": [1e-3, 2e-3], "velocity": np.ones(3)})
    backwash: Any = registry.find("filtration.backwash_velocity")
    with pytest.raises(InputError, match="beside its series"):
        backwash(
            bed_expansion=np.full(7, 0.3),
            class_sizes=[1e-3, 8e-4, 6e-4],
            class_fractions=[0.3, 0.4, 0.3],
            particle_density=2650.0,
            fluid_density=1000.0,
            dynamic_viscosity=1e-3,
            void_fraction_settled=0.42,
        )


def test_titles_name_no_author_who_does_not_exist() -> None:
    """Every word of a derived title's ending is a known author or a qualifier with both languages."""
    known = set(endings()["authors"].values())
    unknown = []
    for key, card in CARDS.items():
        word = quantity_in(card.name)
        rest = card.name[len(word or "") :].strip("_")
        french = catalog("fr").get(rest.replace("_", " "), "")
        if card.given_title or not word or not rest or french[:1].islower() or french.isupper():
            continue
        authors, qualifiers = parsed_ending(rest)
        unknown += [(key, name) for name in authors if name not in known]
        assert all(found["en"] and found["fr"] for found in qualifiers)
    assert not unknown
    assert CARDS["particles.wall_factor_di_felice"].title.endswith("(Di Felice)")
    assert not any(
        "Retained" in card.title or "–Power" in card.title or "Mean–" in card.title for card in CARDS.values()
    )
