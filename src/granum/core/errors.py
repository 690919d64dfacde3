"""The error tree. Every message says what, the value, what is allowed, where, and what to do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches

from granum.core.i18n import _

_MOST_TOLD = 6  # problems told at once
_MOST_NAMES = 40  # names listed where none is like the one given
_FEW_NAMES = 12  # of more than that
_LONGEST_NAME = 100  # characters; what is longer is no misspelt name
_TELLING = 4  # letters from which a word of a name stands for the name


class GranumError(Exception):
    """Base of every error that Granum raises on purpose."""

    exit_code = 2

    def __init__(self, message: str, **details: object):
        super().__init__(message)
        self.message = message
        self.details = {key: value for key, value in details.items() if value is not None}

    def as_json(self) -> dict[str, object]:
        """The shape printed under ``error`` by every ``--json`` command and by the web API."""
        return {"type": type(self).__name__, "message": self.message, **self.details}


class InputError(GranumError):
    """A value, name or combination of values that cannot be used."""


class UnitError(InputError):
    """A unit that is unknown or of the wrong dimension."""


class ApplicabilityError(GranumError):
    """A model asked to do what it was not made for."""


class CaseError(InputError):
    """A case file that cannot be read, or a line that is not fully specified."""


class ConvergenceError(GranumError):
    """An iteration that did not converge; ``last`` keeps the last iterate."""

    exit_code = 3

    def __init__(self, message: str, last: object = None, **details: object):
        super().__init__(message, **details)
        self.last = last


def together(problems: Sequence[CaseError]) -> CaseError:
    """One error that tells what is wrong in several places, each on a line; its details are of the first."""
    told = list(dict.fromkeys(problem.message for problem in problems))
    if len(told) > _MOST_TOLD:
        more = len(told) - _MOST_TOLD
        told[_MOST_TOLD:] = [_("… and {count} more.").format(count=more)]
    return CaseError("\n".join(told), **problems[0].details)


def nearest(word: str, known: Iterable[str], *, strict: bool = False) -> str | None:
    """The known name closest to a misspelt one, if any is close; with ``strict`` only if letters and length
    are nearly the same.

    >>> nearest("particle_diametre", ["particle_density", "particle_diameter"])
    'particle_diameter'

    A name with a word more comes before another of the same shape.

    >>> nearest("lactose", ["sucrose", "lactose monohydrate"])
    'lactose monohydrate'

    A name that is all but a word of it is better than none.

    >>> nearest("potato starch", ["pea", "starch"])
    'starch'
    """
    if len(word) > _LONGEST_NAME:
        return None
    known = list(known)
    whole = [name for name in known if len(word) >= _TELLING and _within(word, name)]
    for cutoff in (0.8,) if strict else (0.8, 0.55):
        found = get_close_matches(word, known, n=1, cutoff=cutoff)
        if found or (whole and cutoff == 0.8):
            return found[0] if found else min(whole, key=len)
        said = [name for name in known if len(name) >= _TELLING and _within(name, word)]
        if said:
            return max(said, key=len)
    return None


def _within(word: str, name: str) -> bool:
    """Whether a name of several words says this one, or more of them in this order."""
    return f" {word.casefold()} " in f" {name.casefold()} "


def unknown_name(
    what: str,
    name: str,
    known: Iterable[str],
    where: str = "",
    *,
    quantities: bool = True,
    meant: str | None = None,
    further: Iterable[str] = (),
    strict: bool = False,
    otherwise: str = "",
) -> InputError:
    """The one error for a name that does not exist: it lists or suggests those that do. Names that are not
    ``quantities`` are told as they are, on a page too, though the glossary may have a word of the same name.
    ``meant`` is the known one where that is certain, ``further`` are others that it may be; ``strict`` as for
    ``nearest``; ``otherwise`` says what to do where none was meant.
    """
    known = sorted(known)
    close = meant or nearest(name, known, strict=strict)
    name = name if len(name) <= _LONGEST_NAME else name[:_LONGEST_NAME] + "…"
    place = f" {where.strip()}" if where else ""
    message = _("{what} '{name}' is not known{place}.").format(what=what, name=name, place=place)
    if close:
        message += " " + _("Did you mean '{close}'?").format(close=close)
        if others := ", ".join(further):
            message += " " + _("Or {names}?").format(names=others)
    elif known:
        told = known if len(known) <= _MOST_NAMES else known[:_FEW_NAMES]
        shown = ", ".join(told)
        if len(known) > len(told):
            shown += " " + _("… and {count} more").format(count=len(known) - len(told))
        message += " " + _("Known names: {names}.").format(names=shown)
    if otherwise and not close:
        message += f" {otherwise}"
    return InputError(message, name=name, did_you_mean=close, as_it_is=None if quantities else True)


def without_value(path: str) -> InputError:
    """The one error for a result that a unit has only with other settings."""
    return InputError(_("'{path}' has no value in this line.").format(path=path), path=path)


def reason_of(problem: OSError) -> str:
    """Why the system refuses, in the current language."""
    return _(problem.strerror) if problem.strerror else str(problem)
