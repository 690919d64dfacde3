"""Case files for a page: read safely, shown as forms made from the declarations, edited without losing a
comment.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from granum.app.closed_lists import choose_within
from granum.app.forms import bounds_text, card_form, laws_of, offered_unit, options, typed
from granum.app.own_substances import form_row, own_substances
from granum.cases.building import MOST_CLASSES, completed, share_of_feed
from granum.cases.outline import Outline, outline, table_of
from granum.cases.reading import knowing_own, parsed, read_text
from granum.cases.resizing import CAPACITY, FULL
from granum.cases.sizing import duty
from granum.cases.starting import listed
from granum.core import registry
from granum.core.documents import table_in
from granum.core.errors import CaseError, GranumError, InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS, Within
from granum.core.parameters import Parameter
from granum.core.units import format_number, pretty_unit
from granum.core.utilities import carrier
from granum.core.written import read_number
from granum.flowsheet.drawing import ACROSS, Loose, draw
from granum.flowsheet.stream_figures import FIGURES, PHASES, worth_telling
from granum.flowsheet.utilities import price_parameter
from granum.materials.library import session
from granum.reports.quantities import value_text
from granum.reports.utilities import carrier_label
from granum.streams.feeding import HUMIDITIES
from granum.streams.names import port_label, pretty, share_label

PARTS = ("liquids", "solids", "gases")
FEED_KINDS = {
    "mass_flow": "MassFlow",
    "solids_mass_fraction": "MassFraction",
    "solid_flow": "MassFlow",
    "liquid_flow": "MassFlow",
    "moisture_dry_basis": "MoistureDryBasis",
    "moisture_wet_basis": "MoistureWetBasis",
    "gas_flow": "MassFlow",
    **HUMIDITIES,
    "temperature": "Temperature",
    "pressure": "Pressure",
}


def read_line(payload: Mapping[str, Any]) -> Any:
    """The line of ``{"case", "folder", "root"}``; files it names must lie inside the root."""
    text = str(payload.get("case", ""))
    outside = _outside(parsed(text, "case"), payload)
    if outside is not None:
        raise CaseError(
            _("The case names the file '{path}', which is not in the workspace.").format(path=outside)
        )
    folder = payload.get("folder")
    return read_text(text, folder=Path(str(folder)) if folder else None)


def _outside(raw: Mapping[str, Any], place: Mapping[str, Any]) -> str | None:
    """The first file that a case names and that does not lie inside the ``root`` of its ``folder``."""
    folder, root = place.get("folder"), place.get("root")
    for named in _files_in(raw):
        try:
            inside = bool(root) and (Path(str(folder)) / named).resolve().is_relative_to(
                Path(str(root)).resolve()
            )
        except (OSError, ValueError):
            inside = False
        if not inside:
            return named
    return None


def _files_in(raw: Mapping[str, Any]) -> list[str]:
    """Files that a case names."""
    mixture, fits = raw.get("mixture"), raw.get("fits")
    named = mixture.get("materials", []) if isinstance(mixture, dict) else []
    tables = fits.values() if isinstance(fits, dict) else []
    data = [
        table.get("data")
        for table in tables
        if isinstance(table, dict) and "\n" not in str(table.get("data"))
    ]
    return [
        str(name) for name in (*(named if isinstance(named, list) else [named]), *data) if name is not None
    ]


def line_form(case: str, across: int = ACROSS, place: Mapping[str, str] | None = None) -> dict[str, Any]:
    """A case as forms: feeds, units and what connects them, substances, specifications, what is missing, and
    the diagram of the line as far as it stands; ``place`` holds the ``folder`` of the files that it names and
    the ``root`` that they must lie inside.
    """
    found = outline(case)
    folder = str((place or {}).get("folder", ""))
    within = bool(folder) and _outside(found.raw, place or {}) is None
    with knowing_own(found.raw, Path(folder) if within else None):
        return _form_of(found, across)


def _form_of(found: Outline, across: int) -> dict[str, Any]:
    raw = found.raw
    units, feeds, specs = (table_of(raw, name) for name in ("units", "feeds", "specifications"))
    mixture = table_of(raw, "mixture")
    return {
        "title": _(found.title) if found.title else "",
        "units": {
            name: _unit(table, mixture) | _ports(found, name)
            for name, table in units.items()
            if isinstance(table, dict)
        },
        "feeds": {
            name: _feed(table, mixture) | {"to": _target(found, name)}
            for name, table in feeds.items()
            if isinstance(table, dict)
        },
        "substances": {phase: listed(mixture, phase) for phase in PARTS},
        "classes": _size_classes(mixture),
        "own": own_substances(raw),
        "labels": {name: session().label(name) for phase in PARTS for name in listed(mixture, phase)},
        "specifications": {
            name: _specification(table) for name, table in specs.items() if isinstance(table, dict)
        },
        "stream_figures": _stream_figures(mixture),
        "prices": _prices(found),
        "ends": _ends(found),
        "names": {
            name: pretty(name) for name in (*found.order, *found.feeds, *(k.name for k in found.links))
        },
        "missing": list(found.missing),
        "diagram": draw(found, None, across, [Loose(*port) for port in found.open_inlets], growing=True),
    }


def _size_classes(mixture: Mapping[str, Any]) -> dict[str, Any] | None:
    """The size classes of a line as a form; None where it has no solid."""
    if not listed(mixture, "solids"):
        return None
    sizes = table_of(mixture, "sizes") or {"smallest": "1 um", "largest": "10 mm"}
    labels = {"smallest": _("smallest size"), "largest": _("largest size")}
    rows = [form_row(Parameter(key, KINDS["Length"])) | {"label": labels[key]} for key in labels]
    count = Parameter("classes", sort=int, within=Within(1, MOST_CLASSES))
    rows.append(
        form_row(count) | {"label": _("number of size classes"), "allowed": bounds_text(count), "sort": "int"}
    )
    own = "boundaries" in sizes
    values = {key: case_value(sizes[key]) for key in labels if key in sizes}
    return {
        "rows": rows,
        "own": own,
        "values": {} if own else values | {"classes": f"{sizes.get('classes', 40)}"},
    }


def _specification(table: Mapping[str, Any]) -> dict[str, Any]:
    """A design specification as it is written, and its amounts as people read them."""
    amounts = {word: case_value(table.get(word, "")) for word in ("equals", "lower", "upper")}
    shown = {word: _as_read(text) for word, text in amounts.items()}
    return {word: str(table.get(word, "")) for word in ("vary", "so_that")} | amounts | {"shown": shown}


def _as_read(text: str) -> str:
    number = read_number(text)
    return f"{format_number(number[0], 9)} {pretty_unit(number[1])}".strip() if number else text


def _stream_figures(mixture: Mapping[str, Any]) -> list[dict[str, Any]]:
    """What can be asked of a stream of the line."""
    species = {own: listed(mixture, own) for own in PHASES.values()}
    rows = []
    for word in worth_telling(species):
        phase, dot, name = word.partition(".")
        p = Parameter(word, KINDS["MassFraction" if dot else FIGURES[word]])
        rows.append(_figure(p) | ({"label": share_label(phase, name)} if dot else {}))
    return rows


def _prices(found: Outline) -> list[dict[str, Any]]:
    """What the units of the line may take, each with the price that it has in the case."""
    written = table_of(found.raw, "prices")
    utilities = [name for model in found.units.values() if model is not None for name in model.utilities]
    rows = []
    for name in dict.fromkeys(carrier(n) for n in utilities):
        if name != "area":
            row = _figure(price_parameter(name))
            price = case_value(written.get(name, ""))
            rows.append(row | {"name": name, "label": carrier_label(name), "value": price})
    return rows


def _ends(found: Outline) -> dict[str, list[dict[str, Any]]]:
    """Where a stream may come from and go to, each with what is there already."""
    origins = [
        {
            "value": k.origin or k.name,
            "label": pretty(k.origin or k.name),
            "taken": k.target,
            "stream": k.name,
        }
        for k in found.links
    ]
    targets = []
    for unit, model in found.units.items():
        for port in () if model is None else (model.inlet_names() or ("",)):
            end = f"{unit}.{port}" if port else unit
            taken = next((k.origin or k.name for k in found.links if port and k.target == end), "")
            targets.append({"value": end, "label": pretty(end), "taken": taken})
    return {"origins": origins, "targets": targets}


def _target(found: Outline, feed: str) -> str:
    return next((k.target for k in found.links if k.name == feed and not k.origin), "")


def _ports(found: Outline, name: str) -> dict[str, Any]:
    """Inlets and outlets of a unit, with what enters and where it goes."""
    model = found.units.get(name)
    entering = {k.target.partition(".")[2]: k for k in found.links if k.target and k.target_unit == name}
    names = None if model is None else model.inlet_names()
    optional = () if model is None else model.optional_inlets()
    inlets = [
        {
            "port": port,
            "label": pretty(port) if names is None else port_label(port),
            "from": (k.origin or k.name) if (k := entering.get(port)) else "",
            "needed": port not in optional,
        }
        for port in (names if names is not None else entering)
    ]
    outlets = [
        {
            "port": k.origin.partition(".")[2],
            "label": port_label(k.origin.partition(".")[2]),
            "to": k.target,
            "stream": k.name,
        }
        for k in found.links
        if k.origin and k.source_unit == name
    ]
    any_number = model is not None and names is None
    return {"name": pretty(name), "inlets": inlets, "outlets": outlets, "joins": any_number}


def _unit(table: Mapping[str, Any], mixture: Mapping[str, Any]) -> dict[str, Any]:
    try:
        card = registry.find(str(table.get("model", ""))).card
    except GranumError as fault:
        return {
            "model": str(table.get("model", "")),
            "title": "",
            "summary": fault.message,
            "parameters": [],
            "limits": [],
            "values": {},
            "figures": [],
        }
    form = card_form(card.key)
    choose_within(form["parameters"], {phase: listed(mixture, phase) for phase in PARTS})
    return {
        "model": card.key,
        "title": form["title"],
        "summary": form["summary"],
        "parameters": form["parameters"],
        "limits": form["limits_shown"],
        "values": {
            p.name: offered_unit(case_value(table[p.name]), p) for p in card.parameters if p.name in table
        },
        "figures": [_figure(p) for p in card.outputs if p.kind is not None and not p.series],
        "duty": _duty(card),
    }


def _duty(card: Any) -> dict[str, str] | None:
    """The labels of the setting by which it is sized and of the figure that decides; None without a size."""
    try:
        own = duty(card.key)
    except GranumError:
        return None
    figure = next(p for p in card.outputs if p.name == own.figure)
    full = value_text(FULL, figure) if figure.name == CAPACITY else ""
    return {"setting": card.parameter(own.setting).label, "figure": figure.label, "usual": full}


def _figure(p: Parameter) -> dict[str, Any]:
    """A result as a form asks for its value."""
    row = p.as_json()
    return {
        **row,
        "required": True,
        "options": [],
        "allowed": "",
        "source_range": "",
        "symbol_shown": "",
        "example": None,
        "default_shown": None,
    }


def _feed(table: Mapping[str, Any], mixture: Mapping[str, Any]) -> dict[str, Any]:
    """The form of a feed: flows of the phases that the line has, temperature and pressure, shares of all but
    the first species of each phase, and the sizes of the solid.
    """
    totals = "mass_flow" in table
    offered = {"temperature", "pressure", *(name for name in FEED_KINDS if name in table)}
    if totals:
        offered |= {"mass_flow", "solids_mass_fraction"}
    else:
        offered |= {f"{phase}_flow" for phase in ("solid", "liquid") if listed(mixture, f"{phase}s")}
    if listed(mixture, "gases"):
        offered |= {"gas_flow", *HUMIDITIES}
    rows, values = [], {name: case_value(table[name]) for name in FEED_KINDS if name in table}
    for name, kind in FEED_KINDS.items():
        if name in offered:
            default = {"temperature": 298.15, "pressure": 101325.0}.get(name)
            row = form_row(Parameter(name, KINDS[kind], default=default))
            rows.append(row | by_volume(name, row["units"]))
    rests = []
    for phase, species in (("liquid", "liquids"), ("solid", "solids"), ("gas", "gases")):
        names, shares = listed(mixture, species), table.get(phase)
        flows = phase in table or f"{phase}_flow" in table or (totals and phase != "gas")
        if len(names) < 2 or not flows or (phase == "gas" and any(h in table for h in HUMIDITIES)):
            continue
        for one in names[1:]:
            row = form_row(Parameter(f"{phase}.{one}", KINDS["MassFraction"], default=None))
            rows.append(row | {"label": share_label(phase, one)})
            if isinstance(shares, dict) and one in shares:
                values[f"{phase}.{one}"] = case_value(shares[one])
        rest = shares.get(names[0], "") if isinstance(shares, dict) else ""
        rests.append(
            _("the rest of the {phase} is {species}").format(
                species=session().label(names[0]), phase=_(phase)
            )
            + (f" ({rest})" if rest else "")
        )
    if listed(mixture, "solids") and ("solid_flow" in table or totals or "sizes" in table):
        sizes = Parameter("sizes", law="size_distribution")
        row = form_row(sizes) | {
            "label": _("particle sizes"),
            "options": options(sizes),
            **laws_of(sizes),
        }
        rows.append(row)
        if "sizes" in table:
            values["sizes"] = case_value(table["sizes"])
    return {"parameters": rows, "values": values, "form": "totals" if totals else "phases", "rests": rests}


def by_volume(name: str, units: list[dict[str, str]]) -> dict[str, Any]:
    """What the field of a flow has more, where the flow may be said as a volume."""
    if name not in ("mass_flow", "liquid_flow", "gas_flow"):
        return {}
    names = [*KINDS["VolumeFlow"].units, *(["Nm3/h"] if name == "gas_flow" else [])]
    by_mass = [unit | {"sort": _("by mass")} for unit in units]
    volumes = [{"unit": u, "label": pretty_unit(u), "sort": _("by volume")} for u in names]
    return {"or_kind": "VolumeFlow", "units": [*by_mass, *volumes]}


def case_value(value: Any) -> str:
    """A value of a case file as a form holds it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return typed(value, 15)
    if isinstance(value, dict):
        return json.dumps(value, ensure_ascii=False, default=str)
    if isinstance(value, list):
        return (
            "; ".join(map(case_value, value))
            if any(isinstance(x, str) for x in value)
            else " ".join(map(str, value))
        )
    return str(value)


def edited(case: str, table: str, name: str, key: str, text: str) -> str:
    """The case with one value changed; empty text removes it. Everything else, comments included, stays as it
    was written.
    """
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    phase, dot, species = key.partition(".")
    if table == "feeds" and dot:
        return share_of_feed(case, name, phase, species, text if text.strip() else "0 %")
    if table not in ("units", "feeds"):
        raise InputError(_("'{name}' cannot be edited here.").format(name=table))
    try:
        document = tomlkit.parse(case)
        place: Any = document[table]
        place = place[name]
        if text.strip():
            place[key] = _typed(text, place.get(key))
        elif key in place:
            del place[key]
        made = tomlkit.dumps(document)
    except (TOMLKitError, KeyError, TypeError, AttributeError):
        raise CaseError(_("There is no '{name}' in the case.").format(name=f"{table}.{name}")) from None
    return completed(made, name) if table == "feeds" and text.strip() else made


def _typed(text: str, before: Any) -> Any:
    """Text of a form in the form it has in the file: a table, a number, yes or no, or text with its unit."""
    import tomlkit

    if text.lstrip().startswith("{"):
        made = tomlkit.inline_table()
        made.update(table_in(text, "law"))
        return made
    if isinstance(before, bool) and text in ("yes", "no"):
        return text == "yes"
    for read in (int, float):
        try:
            return read(text)
        except ValueError:
            continue
    return text
