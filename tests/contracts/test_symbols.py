"""The form of a card and the equation beside it speak of the same quantities by the same symbols."""

from __future__ import annotations

import re

import pytest
from tests.contracts.atoms import atom, atoms, left_sides
from tests.sharing.samples import EVERYTHING

from granum.core.i18n import catalog, language
from granum.core.parameters import Parameter
from granum.reports.mathml import mathml, words_of

WRITTEN = {key: thing.card for key, thing in EVERYTHING.items() if thing.card.equation}
FORMULAS = {key: card for key, card in WRITTEN.items() if card.sort == "formula"}
LAWS = {key: card for key, card in WRITTEN.items() if card.sort == "law"}


def stands(p: Parameter, among: set[str]) -> bool:
    """Whether the symbol of a quantity is among those of an equation; a series may stand there with another
    index.
    """
    wanted = atom(re.sub(r"\(.*\)$", "", p.symbol))
    return bool(wanted) and all(
        a in among
        or (
            p.series is not None
            and any(re.fullmatch(re.escape(re.sub(r"_i$", "", a)) + "_.+", other) for other in among)
        )
        for a in wanted
    )


@pytest.mark.parametrize("key", FORMULAS)
def test_what_is_asked_for_stands_in_the_equation_and_what_is_found_on_its_left(key: str) -> None:
    card = FORMULAS[key]
    asked = [p for p in card.parameters if p.required and p.kind]
    there = atoms(card.equation)
    missing = {p.name: p.symbol for p in asked if not stands(p, there)}
    assert not missing, f"not in {card.equation}"
    left = left_sides(card.equation)
    assert any(stands(p, left) for p in card.outputs), (
        f"{card.outputs} are not on the left of {card.equation}"
    )


@pytest.mark.parametrize("key", LAWS)
def test_what_a_law_asks_for_stands_in_its_equation(key: str) -> None:
    card = LAWS[key]
    there = atoms(card.equation)
    missing = {p.name: p.symbol for p in card.parameters if p.required and p.kind and not stands(p, there)}
    assert not missing, f"not in {card.equation}"


@pytest.mark.parametrize("key", FORMULAS | LAWS)
def test_no_two_quantities_of_a_card_share_a_symbol(key: str) -> None:
    card = WRITTEN[key]
    rows = [p for p in (*card.parameters, *card.arguments) if p.required and p.kind]
    rows += card.outputs if len(card.outputs) == 1 else ()
    symbols = [p.symbol for p in rows]
    assert len(set(symbols)) == len(symbols), {p.name: p.symbol for p in rows}


@pytest.mark.parametrize("key", WRITTEN)
def test_an_equation_is_drawn_wholly_and_in_both_languages(key: str) -> None:
    equation = WRITTEN[key].equation
    assert "\\" not in mathml(equation), "an unknown command"
    foreign = {word for word in words_of(equation) if word not in catalog("fr")}
    assert not foreign
    with language("fr"):
        assert not re.search(r"\d\.\d+</mn>", mathml(equation)), "a decimal point"


def test_a_clash_of_symbols_would_be_seen() -> None:
    equation = r"V = \Omega\,Z"
    assert "A" not in atoms(equation)
    assert left_sides(r"x = y + 1,\quad y = \frac{a}{b}") == {"x", "y"}
    assert atom(r"H/H_0") == {"H", "H_0"}
