"""Comma-separated text as the spreadsheet of a reader opens it by a double click: with semicolons and decimal
commas in French.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from granum.core.i18n import current_language


class CsvForm(NamedTuple):
    """The mark between cells, the decimal mark and the encoding of a file."""

    separator: str
    decimal: str
    encoding: str

    def cell(self, value: Any) -> Any:
        """A number with the decimal mark, anything else as it is."""
        if not isinstance(value, float):
            return value
        return repr(float(value)).removesuffix(".0").replace(".", self.decimal)


def csv_form() -> CsvForm:
    """The form of the current language.

    >>> from granum.core.i18n import language
    >>> with language("fr"):
    ...     csv_form().cell(0.5)
    '0,5'
    """
    if current_language() == "fr":
        return CsvForm(";", ",", "utf-8-sig")  # without the mark Excel takes UTF-8 for another encoding
    return CsvForm(",", ".", "utf-8")
