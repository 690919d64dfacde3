"""A piece of equipment of a solved line, sized for what enters it there."""

from __future__ import annotations

from dataclasses import replace
from math import ceil
from typing import Any, NamedTuple

from granum.cases.alone import case_text
from granum.cases.reading import read_text
from granum.cases.sizing import bracket, doubts, duty, is_whole
from granum.core.conversion import convert
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.packing import of_jax
from granum.core.parameters import Parameter
from granum.core.units import from_si
from granum.flowsheet.run import Line, Run
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.specifications import Target
from granum.reports.quantities import value_text

DIGITS = 4
CAPACITY, FULL = "capacity_use", 0.9  # a tenth in reserve, our own habit
FLOW = "kg/s"  # the unit of a figure that is larger where more enters


class Resized(NamedTuple):
    """The size found, SI, with the setting, the figure and its value that decided.

    Parameters
    ----------
    against: what stands against the size found, in words.
    """

    setting: Parameter
    before: float
    value: float
    figure: Parameter
    wanted: float
    against: str

    def text(self, unit: str = "") -> str:
        """The setting as it is written in a case file, in a unit or in one that suits it."""
        unit = unit or self.setting.display_unit(self.value)
        assert self.setting.kind is not None
        number = float(from_si(self.value, unit, self.setting.kind))
        short = f"{float(f'{number:.{DIGITS}g}'):.10g}"
        return short if unit == "dimensionless" else f"{short} {unit}"

    def told(self) -> str:
        """What was changed and why, in words."""
        values = [value_text(x, self.setting) for x in (self.before, self.value)]
        found = _("{setting}: {before} → {after}, so that {figure} = {wanted}.").format(
            setting=self.setting.label,
            before=values[0],
            after=values[1],
            figure=self.figure.label,
            wanted=value_text(self.wanted, self.figure),
        )
        return " ".join(filter(None, (found[:1].upper() + found[1:], self.against)))


def resized(run: Run, name: str, wanted: str = "") -> Resized:
    """The size of unit ``name`` for the streams that enter it: the setting of ``duty`` for which its figure
    is ``wanted``, or what it is in the example of the machine alone, where a flow is in proportion to the
    liquid that enters; where the figure is a share of its capacity, nine tenths.
    """
    unit = run.sheet.units[name]
    card = type(unit).card
    own = duty(card.key)
    setting, figure = card.parameter(own.setting), next(p for p in card.outputs if p.name == own.figure)
    alone = _alone(run, name, unit)
    goal = float(convert(wanted, figure)) if wanted.strip() else usual(card.key, figure, alone)
    low, high = bracket(alone, name, setting, figure, goal)
    target = Target(f"{name}.{setting.name}", f"{name}.{figure.name}", goal, low, high)
    found = replace(alone, targets=(target,)).solve()
    value = found.found[target.vary]
    if is_whole(card.key):
        value = float(ceil(value - 1e-9))
    return Resized(setting, float(getattr(unit, setting.name)), value, figure, goal, doubts(found))


def usual(key: str, figure: Parameter, here: Line) -> float:
    """The figure of a machine as it opens alone; of one that is used by a share of its capacity ``FULL``."""
    if figure.name == CAPACITY:
        return FULL
    example = read_text(case_text(key, {}), name=key).solve()
    (report,) = example.units.values()
    value = float(next(value for p, value in report.figures() if p.name == figure.name))
    if figure.kind is None or figure.kind.unit != FLOW:
        return value
    liquids = [sum(float(s.liquid_flow) for s in line.sheet.feeds.values()) for line in (here, example.line)]
    return value * liquids[0] / liquids[1] if min(liquids) > 0.0 else value


def _alone(run: Run, name: str, unit: Any) -> Line:
    """The unit as a line of its own, fed with what enters it."""
    entering = {
        link.target.partition(".")[2]: run.streams[link.name]
        for link in run.sheet.links
        if link.target.partition(".")[0] == name
    }
    if not any(float(stream.mass_flow) > 0.0 for stream in entering.values()):
        raise InputError(_("Nothing enters '{unit}': it cannot be sized.").format(unit=name), unit=name)
    feeds = {port: of_jax(stream) for port, stream in entering.items()}
    links = {port: ("", f"{name}.{port}") for port in feeds}
    return Line(run.line.title, Flowsheet({name: unit}, feeds, links))
