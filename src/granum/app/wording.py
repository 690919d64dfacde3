"""Messages for people in front of a page: labels instead of Python names, units as they are printed."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import Any

from granum.core import registry
from granum.core.errors import InputError
from granum.core.glossary import quantity_in
from granum.core.i18n import _
from granum.core.index import entries
from granum.core.parameters import Parameter
from granum.core.units import format_number, pretty_unit
from granum.streams.names import pretty

_QUOTED = r"(?:'|«\s)([a-z][a-z0-9_]*)(?:'|\s»)"
_BESIDE = re.compile(rf" \({_QUOTED}\)")  # label ('name')
_SHARE = re.compile(r" \((?:'|«\s)(?:liquid|solid|gas)\.[^'»]+?(?:'|\s»)\)")  # label ('liquid.water')
_WITH_LABEL = re.compile(rf"{_QUOTED} \((.+?)\)(?=[.,;:]|\s|$)")  # 'name' (label, unit)
_ALONE = re.compile(_QUOTED)
# what is quoted after the word for a stream or a unit, of which the ends do in both languages
_OF_LINE = re.compile(r"((?:[Ss]tream|[Uu]nit|ourant|areil|unité) (?:'|«\s))([\w.]+)(?='|\s»)")
_CODE = re.compile(r"``([a-z][a-z0-9_]*)``")
_PLACE = re.compile(r"\[(?:units|feeds)\.([^\]]+)\](:? ?)")
_DOUBLE = re.compile(rf"\w+ \({_QUOTED}\)")  # name ('name')
_CLASSES = re.compile(r"\[mixture\.sizes\]:? ?")
_STUDY = re.compile(r"\[study\.[^\]]+\] ?")
_KEY = re.compile(rf"(?<!['\w.])(?<!«\s)(?:{'|'.join(registry.DOMAINS)})\.[a-z0-9_]+\b")
_BEGINNING = re.compile(r"^.|(?<=[^\W\d]{2}[.?!] )[^\W\d_](?=[^\W\d_.]+[ ,])")
_GIVEN = re.compile(r"(?<== )((?:'|«\s)[^'»]+? )(\S*?[A-Za-z]\S*?)(?='|\s»)")
_EXAMPLE = re.compile(r"(?:(?<=')|(?<=«\s))1\.5(?: (\S+?))?(?='|\s»)")


def page_words(message: str, allowed: object = None, kept: Collection[object] = ()) -> str:
    """A message as a page says it: what has a label in the glossary, or a title among the cards, is called by
    it; a stream or a unit as in the drawing; a quoted key is meant as such, and so are names that are to be ``kept``.

    >>> page_words(
    ...     "sphericity ('sphericity') = 1.2 is not possible for particles.terminal_velocity: it must be between 0 and 1."
    ... )
    'Sphericity = 1.2 is not possible for Terminal velocity: it must be between 0 and 1.'
    """  # noqa: E501
    if _CLASSES.search(message):
        message = _of_classes(message)
    text = _STUDY.sub("", _PLACE.sub(lambda found: _placed(found, message), message))
    text = _OF_LINE.sub(lambda found: found[0] if found[2] in kept else found[1] + pretty(found[2]), text)
    text = _SHARE.sub("", _BESIDE.sub(lambda found: "" if quantity_in(found[1]) else found[0], text))
    text = _WITH_LABEL.sub(_labelled, text)
    text = _ALONE.sub(
        lambda found: (
            Parameter(found[1]).label if quantity_in(found[1]) and found[1] not in kept else found[0]
        ),
        text,
    )
    text = _KEY.sub(lambda found: _title(found[0]), text)
    text = _GIVEN.sub(lambda found: f"{found[1]}{pretty_unit(found[2])}", text)
    text = _EXAMPLE.sub(lambda found: f"{format_number(1.5)} {pretty_unit(found[1] or '')}".strip(), text)
    if isinstance(allowed, list) and allowed:
        units = [pretty_unit(str(unit)) or "1" for unit in allowed]
        text = text.replace(", ".join(map(str, allowed)), ", ".join(units))
    return _BEGINNING.sub(lambda found: found[0].upper(), text)


def summary_words(summary: str) -> str:
    """What a card is about as a page says it: a parameter by its label, another card by its title.

    >>> summary_words("Pulses of filtrate every ``filtration_time``.")
    'Pulses of filtrate every ‘filtration time’.'
    """
    return _CODE.sub(lambda found: _("‘{label}’").format(label=_called(found[1])), summary)


def _called(name: str) -> str:
    card = next((c for key, c in entries().items() if key.partition(".")[2] == name), None)
    return card.title if card and not quantity_in(name) else Parameter(name).label


def _placed(found: re.Match[str], message: str) -> str:
    """The unit or feed that a message is about, where it does not name the machine of that name anyway."""
    name = found[1]
    if found.start() > 0:
        return f"{pretty(name)}{found[2]}"
    if any(key[0].rpartition(".")[2] == name for key in _KEY.finditer(message)):
        return ""
    return _("{unit}: {message}").format(unit=pretty(name), message="")


def told(error: Mapping[str, Any]) -> dict[str, Any]:
    """An error as JSON with the message of a page, and those of further fields ``beside`` it."""
    error = dict(error)
    if beside := error.get("beside"):
        error["beside"] = {name: told(one)["message"] for name, one in beside.items()}
    kept = (error.get("name"), error.get("did_you_mean")) if error.pop("as_it_is", False) else ()
    return {**error, "message": page_words(str(error["message"]), error.get("allowed"), kept)}


def noticed(flags: list[Any]) -> list[Any]:
    """Flags with the messages of a page."""
    return [
        {**flag, "message": page_words(flag["message"])}
        if isinstance(flag, Mapping) and "message" in flag
        else flag
        for flag in flags
    ]


def _of_classes(message: str) -> str:
    """A message about the size classes of a line, with the words of their form."""
    beginning = _("{unit}: {message}").format(unit=_("size classes of the line"), message="")
    text = _CLASSES.sub(
        lambda found: (
            beginning if found.start() == 0 else _("the size classes of the line (under Substances)")
        ),
        message,
    )
    words = {
        "smallest": _("smallest size"),
        "largest": _("largest size"),
        "classes": _("number of size classes"),
        "boundaries": _("boundaries"),
    }
    text = _DOUBLE.sub(lambda found: words.get(found[1], found[1]), text)
    return _ALONE.sub(lambda found: _("‘{label}’").format(label=words.get(found[1], found[1])), text)


def _labelled(found: re.Match[str]) -> str:
    label = Parameter(found[1]).label if quantity_in(found[1]) else ""
    unit = found[2].removeprefix(label).removeprefix(", ")
    if not label or found[2] not in (label, f"{label}, {unit}"):
        return found[0]
    return f"{label} ({pretty_unit(unit)})" if unit else label


def _title(key: str) -> str:
    try:
        return registry.find(key).card.title
    except InputError:
        return key
