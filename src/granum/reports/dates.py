"""Dates as they stand on a sheet, in the language of the sheet."""

from __future__ import annotations

import datetime

from granum.core.i18n import current_language

_MONTHS = {
    "en": "January February March April May June July August September October November December",
    "fr": "janvier février mars avril mai juin juillet août septembre octobre novembre décembre",
}


def date_text(day: datetime.date | None = None) -> str:
    """A day in words; today where none is given.

    >>> date_text(datetime.date(2026, 3, 1))
    'March\xa01, 2026'
    """
    day = day or datetime.date.today()
    month = _MONTHS[current_language()].split()[day.month - 1]
    if current_language() == "fr":
        return f"{'1er' if day.day == 1 else day.day}\u00a0{month} {day.year}"
    return f"{month}\u00a0{day.day}, {day.year}"
