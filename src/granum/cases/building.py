"""Building a line step by step: each operation takes the text of a case file and gives the text after it,
with every comment and every other line as they were. The text between two steps may be of an unfinished line;
``outline`` says what it still needs.

    text = new_line("Salt", liquids=["water", "potassium nitrate"], solids=["potassium nitrate"])
    text = add_feed(text, "hot_liquor")
    text = add_unit(text, "crystallization.msmpr", origin="hot_liquor")
    text = add_unit(text, "filtration.horizontal_belt_filter", origin="crystallizer.product")
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from typing import Any, Concatenate, ParamSpec

import tomlkit

from granum.cases.alone import library_names
from granum.cases.flows import (
    BY_PHASE,
    BY_TOTAL,
    MOISTURES,
    WATER,
    flow_of,
    in_phases,
    in_totals,
    percent,
)
from granum.cases.outline import Outline, free_name, identifier, numbered, outline, table_of
from granum.cases.reading import knowing_own, own_materials, parsed, quantity
from granum.cases.scaling import entering, gas_of, median_size_of, meshed, scale_of, scaled
from granum.cases.sections import checked, with_table, with_value, without_table, without_value, written
from granum.cases.starting import (
    GAS_PER_FEED,
    GAS_PER_MOISTURE,
    PAIR,
    SIZES,
    crystallizing,
    crystals_of,
    drying_gas,
    first_feed,
    listed,
    starting_feed,
    starting_values,
    wash_liquor,
)
from granum.cases.wiring import bypass, connect, disconnect, lead, remove, rename, replace
from granum.core import registry
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.flowsheet.stream_figures import FIGURES, PHASES, told_of
from granum.flowsheet.symbols import word_of
from granum.materials.library import session
from granum.streams.feeding import HUMIDITIES
from granum.streams.names import pretty

__all__ = [
    "add_feed",
    "add_unit",
    "add_wash",
    "begin",
    "bypass",
    "choose_substances",
    "connect",
    "disconnect",
    "form_of_feed",
    "lead",
    "new_line",
    "remove",
    "remove_specification",
    "rename",
    "replace",
    "retitle",
    "set_price",
    "set_size_classes",
    "set_specification",
    "share_of_feed",
    "use_fit",
]


Rest = ParamSpec("Rest")
MOST_CLASSES = 400  # that a person asks for; a line of more takes minutes


def _with_own_known(step: Callable[Concatenate[str, Rest], str]) -> Callable[Concatenate[str, Rest], str]:
    """A step that finds the substances that the case describes itself by name."""

    @wraps(step)
    def wrapped(case: str, *words: Rest.args, **further: Rest.kwargs) -> str:
        with knowing_own(parsed(case, "case")):
            return step(case, *words, **further)

    return wrapped


def new_line(
    title: str,
    liquids: Sequence[str] = (),
    solids: Sequence[str] = (),
    gases: Sequence[str] = (),
    smallest: str = "1 um",
    largest: str = "10 mm",
    classes: int = 40,
    own: str = "",
) -> str:
    """An empty line of some substances; ``own`` are tables of those that it describes itself.

    >>> print(new_line("Salt", ["water"], ["quartz"]), end="")
    title = "Salt"
    <BLANKLINE>
    [mixture]
    liquids = ["water"]
    solids = ["quartz"]
    sizes = { smallest = "1 um", largest = "10 mm", classes = 40 }
    """
    if not title.strip():
        raise InputError(_("The line needs a title."), name="title")
    species = {"liquids": list(liquids), "solids": list(solids), "gases": list(gases)}
    _require_mixture(species, parsed(own, "case"))
    values = {name: names for name, names in species.items() if names}
    sizes = {"smallest": smallest, "largest": largest, "classes": classes}
    text = with_table(f"title = {written(title.strip())}\n", ("mixture",), values | {"sizes": sizes})
    return f"{text}\n{own.strip()}\n" if own.strip() else text


BEGINNINGS = {
    "solution": ("liquid", "solute"),
    "suspension": ("liquid", "solid"),
    "moist_solid": ("solid", "liquid", "gas"),
    "broken_solid": ("solid",),
    "dusty_gas": ("gas", "solid"),
}
"""What may enter a line first, and the substances that it is made of."""


def begin(
    title: str,
    enters: str = "solution",
    liquid: str = "water",
    solute: str = "potassium nitrate",
    solid: str = "quartz",
    gas: str = "dry air",
    own: str = "",
) -> str:
    """A line with its first feed: a ``solution`` to crystallize from, a ``suspension``, a ``moist_solid`` to
    dry, a ``broken_solid`` to crush and screen, or a ``dusty_gas``. What is not needed of the substances is
    left out; ``own`` are tables of those that the line describes itself.
    """
    with knowing_own(parsed(own, "case")):
        solute = (session().called(solute, "solute") or solute).partition(" in ")[0]
        liquid, gas = library_names("liquids", [liquid])[0], library_names("gases", [gas])[0]
        text = _begun(title, enters, liquid, solute, library_names("solids", [solid])[0], gas, own)
        return add_feed(text, _(enters), values=first_feed(table_of(parsed(text, "case"), "mixture"), enters))


def _begun(title: str, enters: str, liquid: str, solute: str, solid: str, gas: str, own: str) -> str:
    """The line of what enters, without its feed."""
    if enters == "solution":
        crystals = crystals_of(solute, liquid)
        if not crystals:
            raise InputError(
                _("'{solute}' has no solubility in '{solvent}' in the library.").format(
                    solute=solute, solvent=liquid
                ),
                name="solute",
            )
        return new_line(title, [liquid, solute], crystals, own=own)
    if enters == "suspension":
        return new_line(title, [liquid], [solid], own=own)
    if enters == "moist_solid":
        return new_line(title, [liquid], [solid], [gas, liquid], own=own)
    if enters == "broken_solid":
        return new_line(title, [], [solid], [], "100 um", "409.6 mm", 24, own=own)  # √2
    if enters == "dusty_gas":
        return new_line(title, [], [solid], [gas], "0.1 um", "1 mm", own=own)
    raise unknown_name(_("Beginning"), enters, BEGINNINGS)


def _require_mixture(species: Mapping[str, Sequence[str]], own: Mapping[str, Any] | None = None) -> None:
    """Refuses substances that are neither in the library nor described by the case, or none at all."""
    from granum.streams.from_materials import mixture_of

    if not any(species.values()):
        raise InputError(_("Choose at least one substance."), name="liquids")
    for names in species.values():
        twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
        if twice is not None:
            raise InputError(_("'{name}' is chosen twice.").format(name=twice), name="liquids")
    described = filter(None, [own_materials(own or {})])
    mixture_of(species["liquids"], species["solids"], species["gases"], (1e-6, 1e-3), own=described)


def set_size_classes(case: str, smallest: str, largest: str, classes: str) -> str:
    """Other size classes, of one ratio between two sizes; boundaries that the case lists go.

    >>> text = new_line("Salt", ["water"], ["quartz"])
    >>> [line for line in set_size_classes(text, "5 um", "2 mm", "30").splitlines() if "smallest" in line]
    ['sizes = { smallest = "5 um", largest = "2 mm", classes = 30 }']
    """
    ends = {"smallest": smallest, "largest": largest}
    low, high = (quantity(text, "Length", name, _("in [mixture.sizes]")) for name, text in ends.items())
    if low >= high:
        raise InputError(_("[mixture.sizes] 'smallest' must be below 'largest'."), name="smallest")
    count = int(classes) if classes.strip().isdecimal() and len(classes) < 5 else 0
    if not 1 <= count <= MOST_CLASSES:
        raise InputError(
            _("[mixture.sizes] 'classes' = {count}: a whole number from 1 to {most} is needed.").format(
                count=classes.strip()[:20] or "''", most=MOST_CLASSES
            ),
            name="classes",
        )
    return with_value(case, ("mixture",), "sizes", ends | {"classes": count})


@_with_own_known
def choose_substances(
    case: str, liquids: Sequence[str] = (), solids: Sequence[str] = (), gases: Sequence[str] = ()
) -> str:
    """Other substances. Shares of feeds that named one which is gone are given to the first of its phase."""
    raw = parsed(case, "case")
    liquids, solids, gases = (
        library_names("liquids", liquids),
        library_names("solids", solids),
        library_names("gases", gases),
    )
    species = {"liquids": liquids, "solids": solids, "gases": gases}
    _require_mixture(
        species
        if not table_of(raw, "mixture").get("materials")
        else {"liquids": ["water"], "solids": [], "gases": []},
        raw,
    )
    for name, names in species.items():
        if names != listed(table_of(raw, "mixture"), name):
            case = with_value(case, ("mixture",), name, names)
    for feed, table in table_of(raw, "feeds").items():
        for phase, allowed in (("liquid", liquids), ("solid", solids), ("gas", gases)):
            shares = table.get(phase) if isinstance(table, dict) else None
            if not isinstance(shares, dict):
                continue
            if not allowed:
                for word in (phase, f"{phase}_flow"):
                    case = without_value(case, ("feeds", feed), word)
            elif set(shares) - set(allowed):
                kept = {name: x for name, x in shares.items() if name in allowed}
                rest = 1.0 - sum(share_of(x, name) for name, x in kept.items() if name != allowed[0])
                case = with_value(
                    case,
                    ("feeds", feed),
                    phase,
                    {allowed[0]: percent(rest)} | {n: x for n, x in kept.items() if n != allowed[0]},
                )
        case = completed(case, feed)
    return checked(case)


@_with_own_known
def add_feed(case: str, name: str = "", to: str = "", values: Mapping[str, Any] | None = None) -> str:
    """A feed of what the line is made of, to an inlet or to nowhere yet."""
    found = outline(case)
    name = free_name(found, name or _("feed"))
    made = dict(values) if values is not None else starting_feed(table_of(found.raw, "mixture"))
    case = with_table(case, ("feeds", name), {"to": ""} | made)
    return connect(case, name, to) if to else checked(case)


def share_of_feed(case: str, feed: str, phase: str, species: str, value: str) -> str:
    """A share of one phase of a feed set; the first species of the phase takes the rest."""
    raw = parsed(case, "case")
    table = table_of(table_of(raw, "feeds"), feed)
    names = listed(table_of(raw, "mixture"), f"{phase}s" if phase != "gas" else "gases")
    if species not in names:
        raise unknown_name(_("Species"), species, names)
    shares = dict(table_of(table, phase)) or {names[0]: 1.0}
    first = names[0] if species != names[0] else (names[1] if len(names) == 2 else "")
    shares[species] = value
    if first:
        rest = 1.0 - sum(share_of(x, name) for name, x in shares.items() if name != first)
        if not -1e-9 <= rest <= 1.0 + 1e-9:
            raise InputError(
                _("The shares of the {phase} in {feed} add up to more than 100 %.").format(
                    phase=_(phase), feed=pretty(feed)
                ),
                name=f"{phase}.{species}",
            )
        shares[first] = percent(max(rest, 0.0))
    return checked(with_value(case, ("feeds", feed), phase, {n: shares[n] for n in names if n in shares}))


@_with_own_known
def completed(case: str, feed: str) -> str:
    """A feed that was given a flow of a phase it did not have so far, with shares and sizes to begin with."""
    raw = parsed(case, "case")
    mixture, table = table_of(raw, "mixture"), table_of(table_of(raw, "feeds"), feed)
    totals = "mass_flow" in table
    flows = {phase: f"{phase}_flow" in table for phase in ("solid", "liquid", "gas")}
    moist = any(name in table for name in MOISTURES)
    flows["liquid"] |= totals or moist
    flows["solid"] |= "solids_mass_fraction" in table or moist
    crystal = crystallizing(mixture)[2]
    for phase, species in (("solid", "solids"), ("liquid", "liquids"), ("gas", "gases")):
        names = listed(mixture, species)
        if not flows[phase] or len(names) < 2 or phase in table:
            continue
        if phase == "gas" and any(word in table for word in HUMIDITIES):
            continue
        first = next((n for n in names if n != crystal), names[0]) if phase == "solid" else names[0]
        shares = {name: "100 %" if name == first else "0 %" for name in names}
        case = with_value(case, ("feeds", feed), phase, shares)
    if flows["solid"] and "sizes" not in table:
        case = with_value(case, ("feeds", feed), "sizes", dict(SIZES))
    return checked(case)


def share_of(value: Any, name: str) -> float:
    return quantity(value, "MassFraction", name, "")


def form_of_feed(case: str, feed: str, form: str) -> str:
    """A feed of solid and liquid written as ``totals`` (mass flow and share of solids) or as flows of its
    ``phases``; the stream is the same.
    """
    table = table_of(table_of(parsed(case, "case"), "feeds"), feed)
    place = ("feeds", feed)
    if form == "totals" and "mass_flow" not in table:
        gone, told = (*BY_PHASE, *MOISTURES), in_totals(table)
    elif form == "phases" and "mass_flow" in table:
        gone, told = (*BY_TOTAL, *MOISTURES), in_phases(table)
    elif form in ("totals", "phases"):
        gone, told = (), {}
    else:
        raise InputError(_("A feed is given as 'phases' or 'totals'."), name="form")
    for name in gone:
        case = without_value(case, place, name)
    for name, value in told.items():
        case = with_value(case, place, name, value)
    return checked(case)


@_with_own_known
def add_unit(
    case: str,
    model: str,
    name: str = "",
    origin: str = "",
    values: Mapping[str, Any] | None = None,
    brings: Mapping[str, Any] | None = None,
) -> str:
    """A piece of equipment with ordinary values; what ``origin`` names (a feed, or ``unit.outlet``) enters
    its first inlet. Its size follows from what that ``brings`` in a solved line, its ``mass_flow`` and of
    this the ``solvent``, and the openings of a screen from its ``median_size``; else from the feeds.

    A dryer or the like that needs gas gets a feed of hot gas of its own.
    """
    thing = registry.find(model)
    if thing.card.sort != "equipment":
        raise InputError(
            _("'{model}' is a {sort}, not equipment.").format(model=model, sort=_(thing.card.sort))
        )
    found = outline(case)
    name = free_name(found, name or _(word_of(model)))
    mixture = table_of(found.raw, "mixture")
    made = dict(values) if values is not None else starting_values(thing.card.key, mixture)
    if values is None:
        made |= scaled(thing.card.key, made, scale_of(thing.card.key, found, origin, brings))
        made |= meshed(thing.card.key, made, median_size_of(found, origin, brings))
    case = with_table(case, ("units", name), {"model": thing.card.key} | made)
    ports = thing.inlet_names()
    if origin:
        case = connect(case, origin, f"{name}.{_first_inlet(ports, origin)}")
    if values is None:
        for port in ports or ():
            if port == "gas" and "feed" in ports:
                case = _with_gas(case, name, found, origin, brings)
        case = _with_vapor(case) if _asks_for_vapor(thing.card.key) else case
    return checked(case)


def _first_inlet(ports: tuple[str, ...] | None, origin: str) -> str:
    return ports[0] if ports else origin.replace(".", "_")


def _whole(raw: Mapping[str, Any]) -> float:
    """Solid and liquid that all feeds of a line bring, kg/s."""
    return entering(raw, list(table_of(raw, "feeds")))


def _with_gas(
    case: str, unit: str, found: Outline, origin: str, brings: Mapping[str, Any] | None = None
) -> str:
    """The case with a feed of hot gas to a dryer, of ambient gas to one that heats it itself; air and the
    vapor of the first liquid are added to substances that have none.
    """
    case = _with_vapor(case)
    if brings and "mass_flow" in brings:
        flow = gas_of(table_of(table_of(outline(case).raw, "units"), unit)["model"], brings)
    else:
        flow = GAS_PER_FEED * (_whole(found.raw) or 1000.0 / 3600.0)
    moist = table_of(table_of(found.raw, "feeds"), origin)
    if moist:
        flow = max(flow, GAS_PER_MOISTURE * flow_of(moist, "liquid_flow", WATER))
    now = outline(case)
    heats = "temperature_inlet" in table_of(table_of(now.raw, "units"), unit)
    gas = drying_gas(table_of(now.raw, "mixture"), flow, heats)
    return add_feed(case, free_name(now, _("air") if heats else _("hot_gas")), f"{unit}.gas", gas)


def _with_vapor(case: str) -> str:
    """Air and the vapor of the first liquid, where the line has no gas yet."""
    mixture = table_of(parsed(case, "case"), "mixture")
    if listed(mixture, "gases"):
        return case
    return with_value(case, ("mixture",), "gases", [PAIR[0], *(listed(mixture, "liquids")[:1] or PAIR[1:])])


def _asks_for_vapor(model: str) -> bool:
    """Whether a piece of equipment evaporates or condenses the solvent."""
    return model.startswith(("drying.", "evaporation.")) or any(
        word in model for word in ("vacuum_crystallizer", "vacuum_batch", "humid", "condenser")
    )


def add_wash(case: str, unit: str) -> str:
    """A feed of pure solvent to the wash inlet of a filter."""
    found = outline(case)
    name = free_name(found, _("wash_liquor"))
    return add_feed(
        case,
        name,
        f"{unit}.wash",
        wash_liquor(table_of(found.raw, "mixture"), 0.1 * (_whole(found.raw) or 0.3)),
    )


def set_specification(
    case: str, vary: str, so_that: str, equals: str, lower: str, upper: str, name: str = ""
) -> str:
    """A design specification: the value of an input of a unit or a feed is sought for which a result of a
    unit, or a figure of a stream, takes a value.
    """
    found = outline(case)
    for path, inputs in ((vary, True), (so_that, False)):
        unit, _dot, word = path.partition(".")
        if inputs and unit in found.feeds:
            continue  # told of when the line is read: what a feed carries depends on its values
        model = found.units.get(unit)
        stream = None if inputs else told_of(found.links, path)
        if stream is not None and stream[0].origin:
            mixture = table_of(found.raw, "mixture")
            shares = [f"{p}.{name}" for p, own in PHASES.items() for name in listed(mixture, own)]
            if stream[1] not in (*FIGURES, *shares):
                raise unknown_name(_("Figure"), stream[1], (*FIGURES, *shares))
            continue
        if model is None:
            raise unknown_name(_("Unit"), unit, found.order)
        known = [p.name for p in (model.card.parameters if inputs else model.card.outputs)]
        if word not in known:
            raise unknown_name(
                _("Parameter") if inputs else _("Result"), word, known, _("of '{owner}'").format(owner=unit)
            )
    for word, value in (("equals", equals), ("lower", lower), ("upper", upper)):
        if not str(value).strip():
            raise InputError(
                _("A specification needs the value to reach and the range to search."), name=word
            )
    specs = table_of(found.raw, "specifications")
    values = {"vary": vary, "so_that": so_that, "equals": equals, "lower": lower, "upper": upper}
    if name in specs:
        for word, value in values.items():
            case = with_value(case, ("specifications", name), word, value)
        return checked(case)
    return checked(
        with_table(
            case,
            ("specifications", numbered(identifier(name or vary.replace(".", "_")), set(specs))),
            values,
        )
    )


def remove_specification(case: str, name: str) -> str:
    """A design specification taken out; the input keeps the value that is written."""
    specs = table_of(parsed(case, "case"), "specifications")
    if name not in specs:
        raise unknown_name(_("Specification"), name, specs)
    return checked(without_table(case, ("specifications", name)))


def set_price(case: str, carrier: str, price: str) -> str:
    """The price of what the line takes of a carrier or a material; empty text takes it out."""
    if not price.strip():
        known = carrier in table_of(parsed(case, "case"), "prices")
        return checked(without_value(case, ("prices",), carrier)) if known else case
    return checked(with_value(case, ("prices",), carrier, price.strip()))


def use_fit(
    case: str, unit: str, test: str, data: str, conditions: Mapping[str, Any], estimates: Sequence[str]
) -> str:
    """A lab test with its data made the source of inputs of a unit, with their uncertainty; in place of one
    that gave the same inputs.
    """
    found = outline(case)
    model = found.units.get(unit)
    if model is None:
        raise unknown_name(_("Unit"), unit, found.order)
    own = {p.name for p in model.card.parameters}
    gives = {f"{unit}.{name}": name for name in estimates if name in own}
    if not gives:
        raise InputError(
            _("{unit} takes none of what this test gives: {names}.").format(
                unit=pretty(unit), names=", ".join(estimates)
            )
        )
    fits = table_of(found.raw, "fits")
    for name, table in fits.items():
        if set(table_of(table, "gives")) & set(gives):
            case = without_table(case, ("fits", name))
    taken = set(table_of(parsed(case, "case"), "fits"))
    name = numbered(test.partition(".")[2] or "fit", taken)
    for estimate in gives.values():
        if estimate not in table_of(table_of(found.raw, "units"), unit):
            p = model.card.parameter(estimate)
            if p.required:
                raise InputError(_("{unit}: {label} is missing.").format(unit=pretty(unit), label=p.label))
    return checked(
        with_table(
            case, ("fits", name), {"test": test, "data": data, "conditions": dict(conditions), "gives": gives}
        )
    )


def retitle(case: str, title: str) -> str:
    """The line under another title."""
    if not title.strip():
        raise InputError(_("The line needs a title."), name="title")
    parsed(case, "case")
    document = tomlkit.parse(case)
    document["title"] = title.strip()
    return checked(tomlkit.dumps(document))
