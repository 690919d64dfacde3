"""Names of a flow diagram: none is cut, none runs into another or into a line, in either language, however
many units stand side by side.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from granum.cases.outline import Outline, outline
from granum.core.i18n import LANGUAGES, language
from granum.flowsheet.drawing import LETTER, Loose, draw
from granum.flowsheet.plan import Link, plan, returning

SVG = "{http://www.w3.org/2000/svg}"
EXAMPLES = [
    path
    for path in sorted((Path(__file__).parents[2] / "examples").rglob("*.toml"))
    if "[units." in path.read_text(encoding="utf-8")
]
BOLD = 7.0  # of a letter of a unit's name, as browsers print it
# a unit that takes back what it gives, two that pass on to each other, and open ends of very unequal names
SHORT = """
title = "x"
[feeds.brine]
to = "join.brine"
[units.join]
model = "streams.mixer"
[units.evaporative_crystallizer]
model = "crystallization.msmpr"
[units.divide]
model = "streams.splitter"
[units.dryer_of_the_cake]
model = "drying.well_mixed_dryer"
[streams]
suspension_of_the_line = ["evaporative_crystallizer.product", "divide.feed"]
what_goes_back = ["divide.product", "join.back"]
mixed = ["join.product", "evaporative_crystallizer.feed"]
"""


class Box:
    """Where a text stands: its letters, not the room above and below them."""

    def __init__(self, text: ET.Element, x: float, y: float, letter: float):
        self.says = text.text or ""
        wide, anchor = letter * len(self.says), text.get("text-anchor", "start")
        self.left = x - wide * {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor]
        self.right, self.top, self.bottom = self.left + wide, y - 8.0, y + 1.0

    def meets(self, left: float, right: float, top: float, bottom: float) -> bool:
        return self.left < right - 1 and left < self.right - 1 and self.top < bottom and top < self.bottom


def faults(found: Outline, across: int) -> list[tuple[str, str]]:
    """Names that are cut or that run into something else."""
    root = ET.fromstring(
        draw(found, None, across, [Loose(*port) for port in found.open_inlets], growing=True)
    )
    boxes, lines, signs = [], [], []
    for group in root.iter(f"{SVG}g"):
        moved = re.findall(r"[-\d.]+", group.get("transform", "")) or ("0", "0")
        x, y = map(float, moved)
        for text in group.findall(f"{SVG}text"):
            letter = BOLD if group.get("data-unit") else LETTER - 0.3
            boxes.append(Box(text, x + float(text.get("x", "")), y + float(text.get("y", "")), letter))
        if group.get("data-outlet"):
            signs.append((x - 7.5, x + 7.5, y - 7.5, y + 7.5))
        if group.get("data-stream"):
            path = group.findall(f"{SVG}path")[1].get("d", "")
            at = (0.0, 0.0)
            for move, first, second in re.findall(r"([MHV])([-\d.]+)(?: ([-\d.]+))?", path):
                to = {
                    "M": (float(first), float(second or 0)),
                    "H": (float(first), at[1]),
                    "V": (at[0], float(first)),
                }[move]
                if move != "M":
                    lines.append((*sorted((at[0], to[0])), *sorted((at[1], to[1]))))
                at = to
    width = float(root.get("data-width", ""))
    seen = [(box.says, "cut") for box in boxes if box.left < 0 or box.right > width]
    for i, box in enumerate(boxes):
        seen += [
            (box.says, other.says)
            for other in boxes[i + 1 :]
            if box.meets(other.left, other.right, other.top, other.bottom)
        ]
        seen += [(box.says, "line") for a, b, c, d in lines if box.meets(a - 1.5, b + 1.5, c, d)]
        seen += [(box.says, "sign") for sign in signs if box.meets(*sign)]
    return seen


@pytest.mark.parametrize("code", LANGUAGES)
@pytest.mark.parametrize("across", [2, 3, 5])
def test_no_name_of_a_diagram_is_cut_or_crossed(code: str, across: int) -> None:
    with language(code):
        for path in EXAMPLES:
            assert not faults(outline(path.read_text(encoding="utf-8")), across), path
        assert not faults(outline(SHORT), across)


def test_a_loop_is_drawn_from_where_it_is_entered() -> None:
    """A mixer put in by the page is the last unit of the file: the mill behind it had been drawn first."""
    units = ("crusher", "mill", "screen", "mixer")
    links = (
        Link("rock", "", "crusher.feed"),
        Link("crushed", "crusher.product", "mixer.crushed"),
        Link("ground", "mill.product", "screen.feed"),
        Link("mixed", "mixer.product", "mill.feed"),
        Link("oversize", "screen.oversize", "mixer.oversize"),
        Link("screen.undersize", "screen.undersize", ""),
    )
    blocks = plan(units, links)
    assert returning(blocks, links) == {"oversize"}
    # a loop that begins where it is entered comes back as it is torn
    around = (Link("in", "", "a.feed"), Link("on", "a.out", "b.feed"), Link("back", "b.out", "a.more"))
    assert returning(plan(("a", "b"), around), around) == {"back"}
