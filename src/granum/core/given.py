"""What users and other programs pass for a number: told from what is none, whatever its type, in one
sentence.
"""

from __future__ import annotations

import math
import numbers
import reprlib
from typing import Any

import numpy as np

from granum.core.errors import InputError
from granum.core.i18n import _

_LONGEST = 60
_short = reprlib.Repr()
_short.maxstring = _short.maxother = _short.maxlong = _LONGEST


def shown(value: Any) -> str:
    """A value as a message quotes it: short, also where its own text is long, endless or fails."""
    if isinstance(value, str):
        return value if len(value) <= _LONGEST else value[: _LONGEST - 1] + "…"
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) >= 10**_LONGEST:
        return _("a whole number of {count} digits").format(
            count=int(value.bit_length() * math.log10(2.0)) + 1
        )
    return _short.repr(value)


def is_quantity(value: Any) -> bool:
    """Whether a value is a Pint quantity (of any registry)."""
    try:
        return hasattr(value, "magnitude") and hasattr(value, "units")
    except Exception:  # an object of another program whose attributes raise is no quantity
        return False


def depth(values: Any) -> int:
    """How deep lists stand in lists, counted along the first items, to four at most."""
    count = 0
    while isinstance(values, (list, tuple)) and values and count < 4:
        values, count = values[0], count + 1
    return count


def is_array(value: Any) -> bool:
    """Whether a value has elements: an array of NumPy, JAX, pandas or xarray with one axis at least."""
    return hasattr(value, "__array__") and np.ndim(value) > 0


def holds_objects(value: Any) -> bool:
    """Whether an array has texts or Python objects for elements, to be read one by one as those of a list
    are.
    """
    return isinstance(value, np.ndarray) and value.dtype.kind in "OU" and value.ndim > 0


def number_or_array(value: Any, name: str, where: str, example: str) -> Any:
    """A single value as float, an array of real numbers as it is (of JAX) or as NumPy floats; one clear error
    for all else.
    """
    try:
        found = _number_or_array(value)
    except OverflowError:
        raise InputError(
            _("'{name}' is too large for a number{where}.").format(name=name, where=where), name=name
        ) from None
    except InputError:
        raise
    except Exception:  # conversions that objects of other programs bring along raise whatever they like
        found = None
    if found is None:
        raise InputError(
            _("'{name}' = {value} is not a number{where}; write it as '{example}'.").format(
                name=name, value=shown(value), where=where, example=example
            ),
            name=name,
        )
    if isinstance(found, float):
        if math.isnan(found):
            raise not_a_number(name, where)
    elif found.size == 0:
        raise InputError(
            _("'{name}' is empty{where}: give at least one value.").format(name=name, where=where), name=name
        )
    return found


def not_a_number(name: str, where: str) -> InputError:
    """The error for a NaN where one value is due."""
    return InputError(
        _("'{name}' is not a number{where}: give its value.").format(name=name, where=where), name=name
    )


def _number_or_array(value: Any) -> Any:
    """Float or array; None for what is neither. A mask becomes NaN."""
    if isinstance(value, (bool, np.bool_, complex, bytes)):
        return None
    if hasattr(value, "at") and hasattr(value, "aval"):  # of JAX; it stays where it is
        return value if np.dtype(value.dtype).kind in "iuf" else None
    if not hasattr(value, "__array__"):
        return float(value) if hasattr(value, "__float__") else None
    array = np.asarray(
        value.filled(np.nan) if isinstance(value, np.ma.MaskedArray) and value.dtype.kind == "f" else value
    )
    if array.dtype.kind not in "iuf":
        return None
    return float(array) if array.ndim == 0 else array.astype(float, copy=False)


def whole_number(value: Any) -> int | None:
    """A whole number, also one written as text or as 12.0; None for what is none."""
    if isinstance(value, (bool, np.bool_)):
        return None
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, str):
        try:
            return int(value) if len(value) <= _LONGEST else None
        except ValueError:
            return None
    if not isinstance(value, (numbers.Real, np.ndarray)) and not hasattr(type(value), "aval"):
        return None
    number = None if is_array(value) else _number_or_array(value)
    return int(number) if number is not None and float(number).is_integer() else None


def truth(value: Any) -> bool | None:
    """Yes or no, also as a word; None for what is neither."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, int) and value in (0, 1):
        return bool(value)
    if isinstance(value, str):
        return {
            "true": True,
            "yes": True,
            "oui": True,
            "1": True,
            "false": False,
            "no": False,
            "non": False,
            "0": False,
        }.get(value.strip().lower())
    return None
