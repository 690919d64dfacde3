"""Figures made from figures."""

from __future__ import annotations

import pytest

from granum.core.errors import GranumError
from granum.studies.expressions import Expression, quantity

KNOWN = {"a": 2.0, "unit.b": 3.0, "unit.profile[1]": 5.0, "purge.liquid.potassium nitrate": 7.0}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a + unit.b * 2", 8.0),
        ("-a ** 2 / 4", -1.0),
        ("sqrt(a * 8) + max(a, unit.b) - min(a, unit.b)", 5.0),
        ("unit.profile[1] + 'purge.liquid.potassium nitrate'", 12.0),
        ("'3.6 MJ' / '1 kWh'", 1.0),
        ("'5 %' * a", 0.1),
    ],
)
def test_values(text: str, value: float) -> None:
    assert float(Expression.read(text).value(KNOWN.__getitem__)) == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "a +",
        "__import__('os')",
        "a.b()",
        "[1]",
        "a if a else a",
        "lambda: 1",
        "a == 1",
        "f'{a}'",
        "x" * 3000,
        "exec(a)",
    ],
)
def test_nothing_but_arithmetic(text: str) -> None:
    with pytest.raises(GranumError):
        Expression.read(text).value(KNOWN.__getitem__)


def test_a_formula_as_a_quantity() -> None:
    """100 m² of floating-head exchanger, printed as 25 000 USD, at twice the index."""
    cost = quantity(
        "cost", {"card": "costs.purchased_cost_exchanger", "inputs": {"area": "10 * a", "cost_index": 794.0}}
    )
    assert float(cost.value({"a": 10.0}.__getitem__)) == pytest.approx(50000.0, rel=0.02)
    assert cost.names() == ("a",)
    assert cost.parameter.kind is not None
    assert cost.parameter.kind.unit == "USD"


@pytest.mark.parametrize(
    ("declared", "message"),
    [
        ({"card": "costs.purchased_cost_exchangr"}, "Did you mean"),
        ({"card": "costs.purchased_cost_exchanger", "inputs": {"aera": 1.0}}, "Did you mean 'area'?"),
        ({"card": "costs.purchased_cost_exchanger"}, "needs area"),
        ({"card": "costs.purchased_cost_exchanger", "inputs": {"area": "3 kg"}}, "unit 'kg' does not fit"),
        ({"expression": "a", "kind": "Lenght"}, "Did you mean 'Length'?"),
        ({"expresion": "a"}, "Did you mean 'expression'?"),
        ([1], "give an expression"),
    ],
)
def test_bad_quantities(declared: object, message: str) -> None:
    with pytest.raises(GranumError, match=message.replace("?", r"\?")):
        quantity("q", declared)
