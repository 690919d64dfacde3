"""Figures of streams by name, and feeds with other figures: ``stream.temperature``,
``unit.outlet.moisture_dry_basis``, ``stream.liquid.NAME`` (mass fraction within its phase).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import KINDS
from granum.core.parameters import Parameter
from granum.flowsheet.plan import Link
from granum.flowsheet.sheet import Flowsheet
from granum.streams.mixture import Mixture
from granum.streams.stream import Stream, median_of

PHASES = {"liquid": "liquids", "solid": "solids", "gas": "gases"}
FLOWS = ("mass_flow", "liquid_flow", "solid_flow", "gas_flow")
FIGURES = {
    **dict.fromkeys(FLOWS, "MassFlow"),
    "temperature": "Temperature",
    "pressure": "Pressure",
    "moisture_dry_basis": "MoistureDryBasis",
    "solids_mass_fraction": "MassFraction",
    "solids_volume_fraction": "VolumeFraction",
    "slurry_volume_flow": "VolumeFlow",
    "gas_volume_flow": "VolumeFlow",
    "enthalpy_flow": "Power",
    "median_size": "Length",
}


def species_words(mixture: Mixture) -> list[str]:
    """The shares that a stream has: ``liquid.NAME`` and so on."""
    return [f"{phase}.{s.name}" for phase, own in PHASES.items() for s in getattr(mixture, own)]


def told_of(links: tuple[Link, ...], path: str) -> tuple[Link, str] | None:
    """The stream that a path names, by its own name or by the outlet it leaves, and the word after it."""
    ends = {k.origin: k for k in links if k.origin} | {k.name: k for k in links}
    for cut in (path.rpartition("."), _before_species(path)):
        if cut[0] in ends:
            return ends[cut[0]], cut[2]
    return None


def _before_species(path: str) -> tuple[str, str, str]:
    """``"purged.liquid.potassium nitrate"`` → stream, dot and ``"liquid.potassium nitrate"``."""
    for phase in PHASES:
        stream, dot, species = path.partition(f".{phase}.")
        if dot:
            return stream, ".", f"{phase}.{species}"
    return "", "", path


def stream_parameter(mixture: Mixture, stream: str, word: str) -> Parameter:
    """What a figure of a stream is, or a refusal that names those there are."""
    species = species_words(mixture)
    if word in species:
        return Parameter(word.partition(".")[2], KINDS["MassFraction"])
    if word not in FIGURES:
        raise unknown_name(
            _("Figure"), word, (*FIGURES, *species), _("of stream '{stream}'").format(stream=stream)
        )
    return Parameter(word, KINDS[FIGURES[word]])


def species_flows(stream: Stream, phase: str) -> Any:
    """Mass flows of the species of a phase, kg/s."""
    return stream.solid_by_species if phase == "solid" else getattr(stream, phase)


def stream_figure(stream: Stream, word: str) -> Any:
    """One figure of a stream; shares are mass fractions within the phase."""
    phase, dot, species = word.partition(".")
    if dot:
        flows = species_flows(stream, phase)
        total = jnp.sum(flows)
        return flows[stream.mixture.index(PHASES[phase], species)] / jnp.where(total > 0, total, 1.0)
    if word == "median_size":
        return median_of(stream.size_fractions, stream.mixture.edges)
    return getattr(stream, word)


def feed_parameter(feed: Stream, name: str, word: str) -> Parameter:
    """What a figure of a feed is that can be given: temperature, pressure, flows, shares."""
    fields = ["temperature", "pressure", *FLOWS, *species_words(feed.mixture)]
    if word not in fields:
        raise unknown_name(_("Input"), word, fields, _("of feed '{feed}'").format(feed=name))
    phase, dot, species = word.removesuffix("_flow").partition(".")
    if phase in PHASES and float(getattr(feed, f"{phase}_flow")) <= 0:
        raise InputError(
            _("Feed '{feed}' carries no {phase}: its flow cannot be varied.").format(
                feed=name, phase=_(phase)
            )
        )
    if dot:
        return Parameter(species, KINDS["MassFraction"])
    kind = KINDS[FIGURES[word]]
    return Parameter(word, replace(kind, per_volume=_density(feed, word)) if word in FLOWS else kind)


def _density(feed: Stream, flow: str) -> float | None:
    """Of what a flow of a feed is made of, kg/m³."""
    volume = {
        "solid_flow": feed.solid_volume_flow,
        "liquid_flow": feed.liquid_volume_flow,
        "gas_flow": feed.gas_volume_flow,
        "mass_flow": feed.slurry_volume_flow + feed.gas_volume_flow,
    }.get(flow)
    return float(getattr(feed, flow) / volume) if volume is not None and float(volume) > 0.0 else None


def given_value(sheet: Flowsheet, path: str) -> Any:
    """The value of ``unit.parameter`` or of a figure of a feed."""
    head, _dot, word = path.partition(".")
    return stream_figure(sheet.feeds[head], word) if head in sheet.feeds else sheet.value(path)


def changed(sheet: Flowsheet, values: Mapping[str, Any]) -> Flowsheet:
    """The line with other values of ``unit.parameter`` and of figures of its feeds."""
    feeds: dict[str, dict[str, Any]] = {}
    for path, value in values.items():
        head, _dot, word = path.partition(".")
        if head in sheet.feeds:
            feeds.setdefault(head, {})[word] = value
    sheet = sheet.with_values({p: v for p, v in values.items() if p.partition(".")[0] not in sheet.feeds})
    if not feeds:
        return sheet
    new = {n: refed(s, feeds[n]) if n in feeds else s for n, s in sheet.feeds.items()}
    return eqx.tree_at(lambda s: s.feeds, sheet, new)


def refed(stream: Stream, values: Mapping[str, Any]) -> Stream:
    """A feed with other shares, flows, temperature or pressure."""
    for phase, own in PHASES.items():
        shares = {word.partition(".")[2]: v for word, v in values.items() if word.startswith(phase + ".")}
        if shares:
            stream = _with_shares(stream, phase, own, shares)
    for word in FLOWS:
        if word in values:
            now = getattr(stream, word)
            factor = values[word] / jnp.where(now > 0, now, 1.0)
            phases = PHASES if word == "mass_flow" else (word.removesuffix("_flow"),)
            stream = stream.replace(**{p: getattr(stream, p) * factor for p in phases})
    return stream.replace(**{w: jnp.asarray(values[w]) for w in ("temperature", "pressure") if w in values})


def _with_shares(stream: Stream, phase: str, own: str, shares: Mapping[str, Any]) -> Stream:
    """A feed with other shares of some species of a phase, the others keeping their proportions."""
    flows = species_flows(stream, phase)
    total = jnp.sum(flows)
    place = np.array([stream.mixture.index(own, n) for n in shares])
    named = jnp.zeros(flows.shape, bool).at[place].set(True)
    rest = jnp.where(named, 0.0, flows)
    others = jnp.sum(rest)
    left = 1.0 - sum(shares.values())
    new = jnp.where(others > 0, rest / jnp.where(others > 0, others, 1.0), 0.0) * left * total
    new = new.at[place].set(jnp.stack([jnp.asarray(v) for v in shares.values()]) * total)
    if phase != "solid":
        return stream.replace(**{phase: new})
    ratio = jnp.where(flows > 0, new / jnp.where(flows > 0, flows, 1.0), 0.0)
    return stream.replace(solid=stream.solid * ratio.reshape((-1,) + (1,) * (stream.solid.ndim - 1)))


def worth_telling(species: Mapping[str, Sequence[str]]) -> Iterator[str]:
    """Figures that streams are asked for first: flows, temperature, moisture, size, shares. ``species`` by
    phase, in the plural.
    """
    liquids, solids, gases = (species.get(own, ()) for own in PHASES.values())
    yield from ("mass_flow", "temperature")
    if solids and liquids:
        yield from ("moisture_dry_basis", "solids_mass_fraction")
    if solids:
        yield from ("solid_flow", "median_size")
    if liquids:
        yield "liquid_flow"
    if gases:
        yield "gas_flow"
    for phase, own in PHASES.items():
        names = species.get(own, ())
        if len(names) > 1:
            yield from (f"{phase}.{name}" for name in names)
