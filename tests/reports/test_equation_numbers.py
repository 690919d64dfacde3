"""Equations are read back as they are printed: every kind of writing, and nothing that is only guessed."""

from __future__ import annotations

import math
import re

import pytest

from granum.app.forms import docstring_values
from granum.core import registry
from granum.core.i18n import language
from granum.reports.equations import Reader, UnreadError, cut, statements
from granum.reports.mathml import equation_lines, equation_wrapped
from granum.reports.numbers import numbered

VALUES = {"a": 2.0, "b": 3.0, "r_o": 4.0, "R": 8.0, "T": 5.0, r"\alpha": 0.5, r"C_D": 0.44}


def read(side: str) -> float:
    return Reader(cut(side, VALUES), VALUES).whole()


@pytest.mark.parametrize(
    ("side", "value"),
    [
        (r"\min\left(1,\;\frac{a}{b}\right)", 2 / 3),
        (r"\max(a,\,b)^2", 9.0),
        (r"\tfrac34 r_o^2 + \frac1b", 12 + 1 / 3),
        (r"\sqrt[3]{a\,r_o}", 2.0),
        (r"\exp\left\{-a\left[b - 1\right]\right\}", math.exp(-4)),
        (r"\ln[2 r_o/(a + b)]", math.log(8 / 5)),
        (r"\lg b + \log_{10} a", math.log10(6)),
        (r"e^{-a/RT}", math.exp(-2 / 40)),
        (r"a/R\,T", 1.25),  # apart: the stroke ends before the space
        (r"\sin 2\alpha", math.sin(1.0)),
        (r"\tan\alpha\tan\alpha", math.tan(0.5) ** 2),
        (r"\operatorname{arcosh}(1 + a)", math.acosh(3)),
        (r"16\,400 + C_D", 16400.44),
    ],
)
def test_a_side_is_worked_out_as_it_is_printed(side: str, value: float) -> None:
    assert read(side) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    "side",
    [
        r"\sum_i a",
        r"\int_0^a b",
        r"a\ (b < 3)",
        r"c\,a",
        r"a\text{ in mm}",
        r"a_2",
        r"v(a)",
        r"a \pm b",
        r"(a)^+",
    ],
)
def test_what_is_not_known_is_not_guessed(side: str) -> None:
    with pytest.raises(UnreadError):
        read(side)


def test_an_equation_falls_into_what_it_says() -> None:
    assert statements(r"p = q\,v,\quad v = \frac{4Q}{\pi D^2} \le 2;\ \mathrm{SI}") == [
        ["p", r"q\,v"],
        ["v", r"\frac{4Q}{\pi D^2}"],
    ]
    assert statements(r"f = \frac{a}{b} = \min(1,\ c)") == [["f", r"\frac{a}{b}", r"\min(1,\ c)"]]


def example(key: str, **other: object) -> str:
    thing = registry.find(key)
    with language("en"):
        return numbered(thing.evaluate(**docstring_values(thing.card) | other))


def test_a_definition_follows_with_its_own_numbers_and_unit() -> None:
    # v = 4 Q/(π D²), worked out by hand
    text = example("cyclones.pressure_drop_similar", volume_flow=math.pi, diameter=1.0)
    main, definition = text.split(r",\quad ")
    assert r"\left(\text{4 m/s}\right)^2" in main
    assert definition.startswith("v = ")
    assert definition.endswith(r"= \text{4 m/s}")
    assert equation_lines(text).count("<math") == 2


def test_constants_of_nature_stand_in_with_their_units() -> None:
    assert r"\text{9.807 m/s²}" in example("centrifuges.surface_height_rotating")
    assert r"\text{8.314 J/(mol·K)}" in example("drying.diffusivity_arrhenius")
    assert r"\text{1.381 × 10⁻²³ J/K}" in example("particles.brownian_diffusivity")


def test_a_power_on_the_left_is_solved_for_the_result() -> None:
    text = example("particles.terminal_velocity_allen")
    assert text.startswith("v_t^{1.4} = ")
    assert text.endswith(r"\;\Rightarrow\; v_t = \text{70.23 mm/s}")
    assert r"\Rightarrow\; \varepsilon = " in example("porous.void_fraction_kozeny_carman")
    assert r"\Rightarrow\; \alpha = " in example("comminution.nip_angle_rolls")


@pytest.mark.parametrize(
    "key",
    [
        "comminution.product_size_bond",  # in µm
        "comminution.work_index_operating",
        "particles.terminal_velocity_mendelson",  # the other sign
        "particles.drag_coefficient_clift_grace_weber",  # over ten ranges
        "humid_gas.heating_by_duty",  # by enthalpies that it does not write
        "porous.void_fraction_dixon",  # one of several
    ],
)
def test_an_equation_that_does_not_give_the_result_stays_without_numbers(key: str) -> None:
    assert example(key) == ""


def test_most_formulas_show_their_numbers() -> None:
    shown = tried = 0
    for key in sorted(registry.everything())[::5]:
        card = registry.find(key).card
        given = docstring_values(card)
        if (
            card.sort == "formula"
            and card.equation
            and all(p.name in given for p in card.parameters if p.required)
        ):
            tried += 1
            shown += bool(example(key))
    assert shown > 0.55 * tried


def test_a_line_may_end_before_a_sum_but_in_no_bracket() -> None:
    text = example("porous.pressure_gradient_ergun")
    pieces = equation_wrapped(text).split("<math")[1:]
    assert len(pieces) >= 4  # gradient, first term, second term, result
    assert all(p.count("<mfrac>") == p.count("</mfrac>") for p in pieces)
    one, whole = (
        "".join(re.findall(r"<m[nio][^>]*>([^<]*)", f(text))) for f in (equation_wrapped, equation_lines)
    )
    assert one == whole
    assert equation_wrapped(r"x = \left(a + b\right)").count("<math") == 2
    assert equation_wrapped("x = -3").count("<math") == 2
