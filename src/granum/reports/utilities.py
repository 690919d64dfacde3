"""What a line takes from outside, as texts."""

from __future__ import annotations

from typing import Any, NamedTuple

from granum.core.cards import Card
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.core.sources import cite
from granum.core.units import show
from granum.core.utilities import AREA, carrier, sort_of
from granum.reports.quantities import value_text

ELECTRICITY_CARRIER = "electricity"  # whose sum is told as electric power
LEAST = 1e-9  # of the largest of its sort in the line, below which nothing is taken


class UtilityRow(NamedTuple):
    """One utility of one unit: whether the line counts it, where its relation stands, and what it costs;
    nothing where it has no price.
    """

    unit: str
    label: str
    text: str
    counted: bool
    source: str
    cost: str


class UtilityTable(NamedTuple):
    """What the units take, what the line takes by carrier, and in all: labels and texts; ``headline`` is the
    one that tells most.
    """

    rows: list[UtilityRow]
    carriers: list[tuple[str, str]]
    totals: list[tuple[str, str]]
    headline: tuple[str, str]
    product: str
    taken: list[str]
    priced: bool


def carrier_label(name: str) -> str:
    """A carrier or material in the current language."""
    return _(name.replace("_", " "))


def utility_rows(card: Card) -> list[tuple[str, str]]:
    """The utilities of a piece of equipment before anything is calculated: what, and after whom."""
    return [(use.parameter.label, cite(use.utility.source)) for use in card.utilities]


def utility_table(run: Any) -> UtilityTable:
    """The utilities of a solved line; what is not taken has no row."""
    found = [
        (unit, p, float(value), p.name in report.counted, report.model.utilities[p.name].source)
        for unit, report in run.units.items()
        for p, value in report.utilities()
    ]
    largest: dict[str, float] = {}
    for _unit, p, value, _counted, _source in found:
        largest[sort_of(p.name)] = max(largest.get(sort_of(p.name), 0.0), value)
    rows = [
        UtilityRow(unit, p.label, value_text(value, p), told, cite(source), _cost(run, p.name, value, told))
        for unit, p, value, told, source in found
        if value > LEAST * largest[sort_of(p.name)]
    ]
    kinds = {carrier(p.name): p for _u, p, _v, _c, _s in found if sort_of(p.name) != AREA}
    carriers = [
        (carrier_label(name), value_text(value, kinds[name]))
        for name, value in run.carriers.items()
        if name != ELECTRICITY_CARRIER and value > LEAST * largest[sort_of(kinds[name].name)]
    ]
    taken = {p.name: (p.label, _twofold(value, p)) for p, value in run.totals() if value != 0.0}
    told = (taken[name] for name in ("energy_per_water", "energy_per_product") if name in taken)
    bought = [n for n, value in run.carriers.items() if value > LEAST * largest[sort_of(kinds[n].name)]]
    totals = [*taken.values(), *_costs(run, bought)]
    headline = next(told, ("", ""))
    return UtilityTable(rows, carriers, totals, headline, run.product, bought, any(r.cost for r in rows))


def _twofold(value: Any, p: Parameter) -> str:
    """A total as a text; energy per mass as dryers are told, in kJ/kg, and as electricity is, in kWh/t."""
    if p.kind is None or p.kind is not KINDS["SpecificEnergy"]:
        return value_text(value, p)
    return " = ".join(show(float(value), p.kind, unit) for unit in ("kJ/kg", "kWh/tonne"))


def _cost(run: Any, name: str, value: float, counted: bool) -> str:
    """What a unit pays for one utility."""
    of = carrier(name)
    if not counted or of not in run.line.prices:
        return ""
    return show(run.paid(of, value), KINDS["CostRate"], "USD/hour")


def _costs(run: Any, bought: list[str]) -> list[tuple[str, str]]:
    """What the utilities cost in all and per product, and which of them have no price; nothing without
    prices.
    """
    if not run.costs:
        return []
    rate = sum(run.costs.values())
    rows = [(_("cost of utilities"), show(rate, KINDS["CostRate"], "USD/hour"))]
    if (made := float(run.streams[run.product].mass_flow)) > 0.0:
        rows.append((_("cost of utilities per product"), show(rate / made, KINDS["MassPrice"], "USD/tonne")))
    if unpriced := [carrier_label(name) for name in bought if name not in run.costs]:
        rows.append((_("without a price"), ", ".join(unpriced)))
    return rows
