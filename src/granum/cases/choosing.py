"""Which other machine suits what enters one whose checks fail: the ranked card of its sort, opened with the
numbers of the stream.

Dryers are held against ``drying.choose``, what parts solid from liquid against
``filtration.separator_choice``, crystallizers against ``crystallization.choose``; the checks of mills are of
size classes, and say nothing against the mill (``comminution.mill_choice`` ranks these). What such a card
asks and no stream tells, such as what the product bears, stays as the card has it. Whether a feed is a
liquid, a paste or a powder follows from its size and its share of liquid: our own estimate, which the card
shows and everybody can change there.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from granum.cases.starting import crystals_of
from granum.core import registry
from granum.core.compiling import once
from granum.core.datasets import dataset
from granum.core.errors import GranumError
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.units import from_si
from granum.flowsheet.run import Run, UnitReport
from granum.materials.library import session
from granum.settling.equipment.gravity import floating_share
from granum.streams.stream import Stream, median_size

SETTLED = 0.75  # of the best: from here on a machine fits well, and its settings are to be looked at
FITS = 0.4  # below, a machine hardly suits and is not proposed
MOST = 3  # proposals
REASONS = 2  # of each
FLOWING, STANDING = 0.4, 0.6  # volume of solid in solid and liquid: below it flows, above it crumbles
DRY = 1e-6  # liquid per solid: below it is none
FLOATS = 0.01  # of the solid, from which the checks of bowls speak of it
FINE, COARSE = 100e-6, 5e-3  # m: grains below stick to a paste, those above are pieces
DRYERS, SEPARATORS = ("drying", "dryers_houdon2017"), ("filtration", "separators_svarovsky2001")
WAYS = {
    ("cooling through a wall", "continuous"): ("msmpr", "classified_crystallizer", "needle_crystallizer"),
    ("cooling through a wall", "seeded batch"): (
        "jacketed_batch_crystallizer",
        "batch_crystallizer",
        "controlled_batch_crystallizer",
        "nucleation_controlled_crystallizer",
    ),
    ("cooling through a wall", "fluidized bed (Oslo), classified product"): ("oslo_crystallizer",),
    ("vacuum (adiabatic) cooling", "continuous"): ("vacuum_crystallizer",),
    ("vacuum (adiabatic) cooling", "seeded batch"): ("vacuum_batch_crystallizer",),
    ("antisolvent", "continuous"): ("antisolvent_crystallizer",),
    ("antisolvent", "seeded batch"): ("antisolvent_batch_crystallizer",),
}
"""By way to crystallize, as ``crystallization.choose`` calls it, the units that model it; what boils is not
among them, as a crystallizer is advised about only where it cools.
"""
WEBS = ("drying.paper_machine", "drying.impingement_dryer", "drying.radiant_dryer")
SKIMMING = {
    "centrifuges.disc_stack": "centrifuges.disc_separator",
    "centrifuges.tubular_bowl": "centrifuges.tubular_separator",
    "centrifuges.scroll_decanter": "centrifuges.three_phase_decanter",
    "centrifuges.solid_basket": "centrifuges.tubular_separator",
}
"""By bowl with one outlet for liquid, the one of its kind with an outlet for what is lighter."""


class Other(NamedTuple):
    """A machine or a way that suits: its name, what speaks for it, the unit that models it, if any does."""

    name: str
    reasons: str
    model: str


class Advice(NamedTuple):
    """What the ranked card says of the stream that enters a machine.

    Parameters
    ----------
    card: its key. inputs: what it was asked, as in a form or a command. others: what suits better, the best
        first; none where the machine is of a sort that suits. told: in words.
    """

    card: str
    inputs: Mapping[str, str]
    others: tuple[Other, ...]
    told: str

    @property
    def command(self) -> str:
        """The same at the command line."""
        return shlex.join(["granum", "calc", self.card, *(f"{k}={v}" for k, v in self.inputs.items())])

    def as_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            **self._asdict(),
            "others": [other._asdict() for other in self.others],
            "command": self.command,
        }


class _Choice(NamedTuple):
    """A ranked card: the units that model each of its machines, the first of the reasons that it tells, and
    what it is asked about a unit.
    """

    card: str
    models: Callable[[], dict[str, list[str]]]
    first: Callable[[str], str]
    asked: Callable[[UnitReport, Mapping[str, Stream], Mapping[str, Stream]], dict[str, str] | None]


def advice(run: Run) -> dict[str, Advice]:
    """By unit, for those that fail a check and are of a sort that has a ranked card."""
    found = {name: _advised(run, name, report) for name, report in run.units.items()}
    return {name: one for name, one in found.items() if one is not None}


def _advised(run: Run, name: str, report: UnitReport) -> Advice | None:
    key = report.model.card.key
    choice = _choice(key)
    if choice is None or all(check.ok for check in report.checks):
        return None
    entering = _ends(run, name, "target")
    leaving = _ends(run, name, "origin")
    if "feed" not in entering:
        return None
    if key in SKIMMING and float(once(floating_share, entering["feed"])) > FLOATS:
        return _skimmed(key, choice, report, entering, leaving)
    try:
        asked = choice.asked(report, entering, leaving)
        ranked = registry.find(choice.card)(**asked) if asked is not None else None
    except GranumError:  # the stream lies where the card has nothing to say
        return None
    return None if ranked is None or asked is None else _told(key, choice, asked, ranked)


def _skimmed(
    key: str,
    choice: _Choice,
    report: UnitReport,
    entering: Mapping[str, Stream],
    leaving: Mapping[str, Stream],
) -> Advice | None:
    """Of a bowl that has no outlet for what floats."""
    asked, other = choice.asked(report, entering, leaving), registry.find(SKIMMING[key]).card
    if asked is None:
        return None
    why = _("lets out what floats")
    told = _("{machine}: what floats has no outlet here. Machines that suit it better: {others}.").format(
        machine=registry.find(key).card.title, others=f"{other.title} ({why})"
    )
    return Advice(choice.card, asked | {"drops": "true"}, (Other(other.title, why, other.key),), told)


def _choice(key: str) -> _Choice | None:
    domain = key.partition(".")[0]
    if domain == "drying":
        return _Choice("drying.choose", partial(_table, DRYERS), _first, _of_dryer)
    if any(key in row["models"].split() for row in dataset(*SEPARATORS)):
        return _Choice("filtration.separator_choice", partial(_table, SEPARATORS), _first, _of_separator)
    if domain == "crystallization" and any(key.partition(".")[2] in models for models in WAYS.values()):
        return _Choice("crystallization.choose", _ways, _sentence, _of_crystallizer)
    return None


def _table(place: tuple[str, str]) -> dict[str, list[str]]:
    return {_(row["name"]): row["models"].split() for row in dataset(*place)}


def _ways() -> dict[str, list[str]]:
    return {
        f"{_(mode)}, {_(how)}": [f"crystallization.{name}" for name in WAYS.get((mode, how), ())]
        for mode in ("cooling through a wall", "vacuum (adiabatic) cooling", "evaporation", "antisolvent")
        for how in ("continuous", "seeded batch", "fluidized bed (Oslo), classified product")
    }


def _ends(run: Run, name: str, side: str) -> dict[str, Stream]:
    """Streams at the ports of a unit."""
    ends = {link: getattr(link, side).partition(".") for link in run.sheet.links}
    return {port: run.streams[link.name] for link, (unit, _dot, port) in ends.items() if unit == name}


def _told(key: str, choice: _Choice, asked: dict[str, str], ranked: Any) -> Advice | None:
    models = choice.models()
    names, marks = list(ranked[0]), np.asarray(ranked.suitability)
    own = [i for i, name in enumerate(names) if key in models[name]]
    mark = max((float(marks[i]) for i in own), default=0.0)
    title = registry.find(key).card.title
    if mark >= SETTLED * float(np.max(marks)):
        told = _(
            "{machine}: no other sort of machine suits what enters it much better. Look at its size, its "
            "settings and what comes before it."
        )
        return Advice(choice.card, asked, (), told.format(machine=title))
    better = [i for i in range(len(names)) if marks[i] >= max(FITS, mark) and i not in own][:MOST]
    why = next((choice.first(ranked.speaks_against[i]) for i in own), "") if mark < FITS else ""
    reasons = {i: choice.first(ranked.speaks_for[i]) for i in better}
    others = tuple(
        Other(names[i], "" if reasons[i] == why else reasons[i], next(iter(models[names[i]]), ""))
        for i in better
    )
    if not why and not others:
        return None
    return Advice(choice.card, asked, others, _sentences(title, bool(own), why, others))


def _first(reasons: str) -> str:
    """The first of several reasons."""
    return ", ".join(reasons.split("; ")[:REASONS])


def _sentence(reasons: str) -> str:
    """The first of several reasons that are sentences."""
    return reasons.partition(". ")[0].rstrip(".")


def _sentences(title: str, ranked: bool, why: str, others: tuple[Other, ...]) -> str:
    rows = ", ".join(f"{o.name} ({o.reasons})" if o.reasons else o.name for o in others)
    if not ranked:
        return _("{machine}: machines that suit what enters it are {others}.").format(
            machine=title, others=rows
        )
    if not why:
        told = _(
            "{machine}: first look at its size and its settings. Would suit what enters even better: "
            "{others}."
        )
        return told.format(machine=title, others=rows)
    told = (
        _("Machines that suit it better: {others}.").format(others=rows)
        if others
        else _("No other machine that is ranked suits it well either.")
    )
    hardly = _("{machine} hardly suits what enters it: {why}.").format(machine=title, why=why)
    return f"{hardly} {told}"


def _written(value: Any, unit: str, digits: int = 4) -> str:
    """A number as it is typed, in a unit."""
    number = f"{float(f'{float(value):.{digits}g}'):.10g}"
    return f"{number} {unit}".strip()


class _Slurry(NamedTuple):
    """What the cards ask of a stream of solid and liquid, SI."""

    solid: Any  # by volume
    flow: Any  # volume
    difference: Any  # of the densities


def _slurry(s: Stream) -> _Slurry:
    return _Slurry(s.solids_volume_fraction, s.slurry_volume_flow, s.solid_density - s.liquid_density)


def _viscosity(s: Stream) -> Any:
    return s.liquid_viscosity


def _of_dryer(
    report: UnitReport, entering: Mapping[str, Stream], leaving: Mapping[str, Stream]
) -> dict[str, str] | None:
    feed, product = entering["feed"], leaving.get("product")
    if product is None or not float(product.solid_flow) > 0.0:
        return None
    # what is dissolved in the feed leaves as solid
    back = sum(float(s.solid_flow) for port, s in entering.items() if port != "feed")
    dry = sum(float(s.solid_flow) for s in leaving.values()) - back
    wet = float(feed.solid_flow + feed.liquid_flow) / dry - 1.0 if dry > 0.0 else 0.0
    left = float(product.liquid_flow) / float(product.solid_flow)
    left = left if left > DRY else 0.0
    if not wet > left:
        return None
    asked = {
        "product_form": _form(report.model.card.key, feed),
        "mass_flow": _written(3600.0 * float(feed.solid_flow + feed.liquid_flow), "kg/h"),
        "moisture_dry_basis_inlet": _written(wet, ""),
        "moisture_dry_basis_outlet": _written(left, ""),
    }
    limit = getattr(report.model, "temperature_limit", None)
    if limit is not None:
        kind = report.model.card.parameter("temperature_limit").kind
        asked["temperature_limit"] = _written(from_si(float(limit), "degC", kind), "degC")
    return asked


def _form(key: str, feed: Stream) -> str:
    """What a dryer is fed with, in the words of its card."""
    size, solid = median_size(feed), float(once(_slurry, feed).solid)
    if key in WEBS:
        return "web"
    if size is not None and size >= COARSE:
        return "pieces"
    if size is None or solid < FLOWING:
        return "liquid"
    return "paste" if solid < STANDING and size < FINE else "powder"


def _of_crystallizer(
    report: UnitReport, entering: Mapping[str, Stream], leaving: Mapping[str, Stream]
) -> dict[str, str] | None:
    feed, product = entering["feed"], leaving.get("product")
    solvent, *others = [s.name for s in feed.mixture.liquids] or [""]
    solute = next((name for name in others if crystals_of(name, solvent)), None)
    if product is None or solute is None or not float(product.temperature) < float(feed.temperature):
        return None
    grown = float(product.solid_flow) - sum(float(s.solid_flow) for s in entering.values())
    if not grown > 0.0:  # none form: as many as could, of all that is dissolved
        grown = float(feed.liquid[feed.mixture.index("liquids", solute)])
    known = solute if solute in session().names("solute") else f"{solute} in {solvent}"
    kind = KINDS["Temperature"]
    hot, cold = (float(from_si(float(s.temperature), "degC", kind)) for s in (feed, product))
    asked = {
        "solubility": json.dumps({"law": "library_solubility", "solute": known}, ensure_ascii=False),
        "temperature_hot": _written(hot, "degC"),
        "temperature_cold": _written(cold, "degC"),
        "crystal_flow": _written(3600.0 * grown, "kg/h"),
    }
    added = any(report.model.card.name.startswith(word) for word in ("antisolvent", "extractive"))
    return asked | ({"antisolvent_available": "yes"} if added else {})


def _of_separator(
    report: UnitReport, entering: Mapping[str, Stream], leaving: Mapping[str, Stream]
) -> dict[str, str] | None:
    feed = entering["feed"]
    size = median_size(feed)
    if size is None or not float(feed.liquid_flow) > 0.0:
        return None
    richest = max(leaving.values(), key=lambda s: float(s.solid_flow))
    here = once(_slurry, feed)
    key, rows = report.model.card.key, dataset(*SEPARATORS)
    # as dry as here, but no drier than such machines are said to leave it
    usual = max((row["liquid_left"] for row in rows if key in row["models"].split()), default=0.0)
    left = max(1.0 - float(once(_slurry, richest).solid), usual)
    asked = {
        "particle_diameter": _written(1e6 * size, "um"),
        "density_difference": _written(here.difference, "kg/m^3"),
        "solids_volume_fraction": _written(here.solid, ""),
        "volume_flow": _written(3600.0 * float(here.flow), "m^3/h"),
        "liquid_left_wanted": _written(left, ""),
    }
    if feed.mixture.liquid_viscosity is not None:
        asked["dynamic_viscosity"] = _written(1e3 * float(once(_viscosity, feed)), "mPa*s")
    return asked | ({"washing": "true"} if "wash" in entering else {})
