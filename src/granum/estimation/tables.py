"""Data files: CSV, TSV, semicolons with decimal commas, or XLSX, whose header names columns with units in any
order.
"""

from __future__ import annotations

import csv
import io
import re
import unicodedata
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import IO, Any

import numpy as np

from granum.core.errors import InputError, nearest, reason_of
from granum.core.given import shown
from granum.core.i18n import _
from granum.core.parameters import Parameter
from granum.core.unit_names import fits, is_unit
from granum.core.units import to_si
from granum.core.written import read_number

_HEADER = re.compile(r"^\s*(.*?)\s*(?:[\[(]\s*(.*?)\s*[\])]|\s/\s*(.+?))?\s*$")
_IN_THREES = {",": re.compile(r"[+-]?[1-9]\d{0,2},\d{3}"), ".": re.compile(r"[+-]?[1-9]\d{0,2}\.\d{3}")}
_DECIMAL = {
    ",": re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?"),
    ".": re.compile(r"[+-]?\d*\.\d+(?:[eE][+-]?\d+)?"),
}
_WHOLE = re.compile(r"[+-]?[1-9]\d{0,2}")
_RESTS = ("pan", "bottom", "rest", "fond", "fond_de_tamis")  # of a stack of sieves, below the finest
# in a first cell: no comment, but no number
_SHEET_ERRORS = ("#N/A", "#DIV/0!", "#REF!", "#VALUE!", "#NUM!", "#NAME?", "#NULL!")
MOST_ROWS = 20_000  # of a workbook, which is read cell by cell
LARGEST_UNPACKED = 30_000_000  # bytes
Row = tuple[int, list[Any]]
Source = str | Path | IO[Any]


def read_table(
    source: Source, columns: Iterable[Parameter], rest: tuple[str, str, str] | None = None
) -> dict[str, Any]:
    """The columns of a data file as SI arrays by name; other columns of the file are ignored.

    The header names each column and its unit: ``time [min]``, ``filtrate_volume (L)`` or ``time / s``, or the
    units stand in a line of their own below. Lines that start with ``#`` are comments, and lines of one cell
    above the header are titles. Missing optional columns are left out. ``rest`` tells of a last row for what
    has no value in a column (below the finest sieve): that column, the one that says how much, in % if need
    be, and the name under which it is given.
    """
    where = _(" in {file}").format(file=getattr(source, "name", source))
    rows = list(_rows(source, where))
    if not rows:
        raise InputError(_("There is no header line{where}.").format(where=where))
    (_line, header), body = rows[0], rows[1:]
    if not body:
        raise InputError(_("There is no row of values under the header{where}.").format(where=where))
    units: dict[str, str | None] = {}
    places: dict[str, int] = {}
    for place, cell in enumerate(header):
        name, unit = _heading(str(cell or ""))
        if not name:
            continue
        if name in places:
            raise InputError(
                _("Column '{name}' stands twice{where}.").format(name=name, where=where), name=name
            )
        places[name], units[name] = place, unit
    named = 1 + max((place for place, cell in enumerate(header) if cell not in (None, "")), default=-1)
    for line, row in body:
        if any(cell not in (None, "") for cell in row[named:]):
            raise InputError(
                _(
                    "Line {line} has {count} cells, the header {expected}{where}: decimal commas need "
                    "semicolons or tabs between the cells."
                ).format(line=line, count=len(row), expected=named, where=where),
                line=line,
            )
    if below := _units_below(body[0][1], places, units):
        units |= below
        body = body[1:]
    found: dict[str, Any] = {}
    columns = list(columns)
    for alias, (name, unit) in _named_otherwise(columns, places, units).items():
        places[name], units[name] = places.pop(alias), unit
        units.pop(alias, None) if alias != name else None
    if rest and rest[0] in places and rest[1] in places and body[1:]:
        if units[rest[1]] in ("%", "percent", "wt%", "wt.%"):
            units[rest[1]] = next(p.units[0] for p in columns if p.name == rest[1])
        line, last = body[-1]
        cell = last[places[rest[0]]] if places[rest[0]] < len(last) else None
        if (isinstance(cell, str) and _bare(cell.strip()) in _RESTS) or _number(cell) == 0.0:
            amount = next(p for p in columns if p.name == rest[1])
            kept = [(line, last[places[rest[1]]] if places[rest[1]] < len(last) else None)]
            found[rest[2]] = float(_column(amount, units[rest[1]], kept, where)[0])
            body = body[:-1]
    asked = [places[p.name] for p in columns if p.name in places]
    texts = [row[k] for _line, row in body for k in asked if k < len(row) and isinstance(row[k], str)]
    marks = {mark for mark in ",." if any(_DECIMAL[mark].fullmatch(text) for text in texts)}
    sure = {
        mark
        for mark in marks
        if any(_DECIMAL[mark].fullmatch(text) and not _IN_THREES[mark].fullmatch(text) for text in texts)
    }
    others = [name for name in places if name not in {p.name for p in columns}]
    for p in columns:
        if p.name not in places:
            meant = [n for n in others if not units.get(n) or (p.kind and fits(units[n] or "", p.kind.unit))]
            close = nearest(p.name, meant)
            if p.required or (
                close
                and nearest(close, [p.name])
                and close.replace("_", "")[:6] == p.name.replace("_", "")[:6]
            ):
                raise _no_column(p, places, close, where)
            continue
        place = places[p.name]
        cells = [(line, row[place] if place < len(row) else None) for line, row in body]
        _no_thousands(p, cells, marks, sure, where)
        found[p.name] = _column(p, units[p.name], cells, where)
    return found


def heading_names(p: Parameter) -> tuple[str, ...]:
    """What a column may be called: its name, and its labels of the glossary in both languages."""
    words = (p.name, *((p.term.en, p.term.fr) if p.term else ()))
    return tuple(dict.fromkeys(_bare(word) for word in words))


def _bare(text: str) -> str:
    """Without accents, apostrophes and case, words joined as in a name."""
    parts = unicodedata.normalize("NFD", text.lower())
    plain = "".join(c for c in parts if not unicodedata.combining(c))
    return re.sub(r"[\s\-'’]+", "_", plain)


def _named_otherwise(
    columns: list[Parameter], places: Iterable[str], units: dict[str, str | None]
) -> dict[str, tuple[str, str | None]]:
    """Headings that mean a column by another name, with it and its unit: labels of the glossary, a unit
    without brackets, the symbol, or a part of the label whose unit fits no other column.
    """
    headings, known = list(places), {p.name for p in columns}
    found: dict[str, tuple[str, str | None]] = {}
    free = [h for h in headings if h not in known]
    for means in (_by_label, _by_symbol, _by_part):
        taken = {*headings, *(name for name, _unit in found.values())}
        rest = [p for p in columns if p.name not in taken]
        meant = {
            h: means(h, units[h], rest) or means(*_unit_behind(h, units[h]), rest)
            for h in free
            if h not in found
        }
        names = [name for those in meant.values() for name, _unit in those]
        for heading, those in meant.items():
            if len(those) == 1 and names.count(those[0][0]) == 1:
                found[heading] = those[0]
    return found


Meant = list[tuple[str, str | None]]


def _by_label(heading: str, unit: str | None, columns: list[Parameter]) -> Meant:
    return [(p.name, unit) for p in columns if _bare(heading) in heading_names(p)]


def _unit_behind(heading: str, unit: str | None) -> tuple[str, str | None]:
    """``height cm``."""
    name, _mark, last = heading.rpartition("_")
    return (name, last) if unit is None and name and is_unit(last) else (heading, unit)


def _by_symbol(heading: str, unit: str | None, columns: list[Parameter]) -> Meant:
    """``t (s)``."""
    return [
        (p.name, unit)
        for p in columns
        if p.term and unit and _fits(unit, p) and heading == re.sub(r"[\\{}^\s]", "", p.term.symbol).lower()
    ]


def _by_part(heading: str, unit: str | None, columns: list[Parameter]) -> Meant:
    """``volume (L)`` of a filtrate volume."""
    words = set(_bare(heading).split("_"))
    return [
        (p.name, unit)
        for p in columns
        if unit and _fits(unit, p) and any(words < set(name.split("_")) for name in heading_names(p))
    ]


def _fits(unit: str, p: Parameter) -> bool:
    return p.kind is not None and fits(unit, p.kind.unit)


def _units_below(cells: list[Any], places: dict[str, int], units: dict[str, str | None]) -> dict[str, str]:
    """Units in a line of their own below a header that has none."""
    if any(units.values()):
        return {}
    said = {name: str(cells[k]).strip(" []()") for name, k in places.items() if k < len(cells) and cells[k]}
    written = [text for text in said.values() if text]
    if not written or any(not np.isnan(_number(text)) or not is_unit(text) for text in written):
        return {}
    return {name: text for name, text in said.items() if text}


def _no_thousands(
    p: Parameter, cells: list[tuple[int, Any]], marks: set[str], sure: set[str], where: str
) -> None:
    """Refuse a mark that may set thousands apart: other cells have the other mark, or whole numbers below a
    thousand stand beside.

    ``marks`` are those of the table, ``sure`` those that are decimal marks somewhere in it and so everywhere.
    """
    written = [(line, cell) for line, cell in cells if isinstance(cell, str)]
    for mark, other in ((",", "."), (".", ",")):
        doubtful = [(line, cell) for line, cell in written if _IN_THREES[mark].fullmatch(cell)]
        if not doubtful or mark in sure:
            continue
        if other in marks or any(_WHOLE.fullmatch(cell) for _line, cell in written):
            line, cell = doubtful[0]
            raise InputError(
                _(
                    "Line {line}, column '{name}': '{text}' may be thousands or decimals{where}: write "
                    "the thousands without a mark."
                ).format(line=line, name=p.name, text=cell, where=where),
                name=p.name,
                line=line,
            )


class Held(io.BytesIO):
    """A data file held in memory under its name, so that it can be read twice."""

    def __init__(self, content: bytes, name: str):
        super().__init__(content)
        self.name = name


def held(source: Source) -> tuple[Held, tuple[str, ...]]:
    """A data file in memory and the names of its columns."""
    name = str(getattr(source, "name", source))
    raw = _bytes(source, _(" in {file}").format(file=name))
    first = next(iter(_rows(Held(raw, name), _(" in {file}").format(file=name))), (0, []))[1]
    return Held(raw, name), tuple(_heading(str(cell or ""))[0] for cell in first)


def sheets_of(content: bytes) -> list[str]:
    """The names of the sheets of a workbook; none of any other file."""
    if content[:2] != b"PK":
        return []
    with _opened(content, "") as workbook:
        return [sheet.title for sheet in workbook.worksheets]


def as_csv(source: Source, sheet: str = "") -> str:
    """A data file as comma-separated text with decimal points, whatever it was; as it is written where a mark
    may set thousands apart. Of a workbook the first sheet, or the one that is named.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    rows = [
        cells
        for _line, cells in _rows(source, _(" in {file}").format(file=getattr(source, "name", source)), sheet)
    ]
    doubtful = any(
        isinstance(cell, str) and any(of.fullmatch(cell) for of in _IN_THREES.values())
        for cells in rows
        for cell in cells
    )
    for cells in rows:
        writer.writerow(["" if cell is None else cell if doubtful else _with_point(cell) for cell in cells])
    return text.getvalue()


def _with_point(cell: Any) -> Any:
    return cell.replace(",", ".") if isinstance(cell, str) and _DECIMAL[","].fullmatch(cell) else cell


def _heading(cell: str) -> tuple[str, str | None]:
    match = _HEADER.match(cell)
    assert match is not None
    name = match.group(1).strip().lower().replace(" ", "_").replace("-", "_")
    return name, match.group(2) or match.group(3) or None


def _no_column(p: Parameter, places: Iterable[str], close: str | None, where: str) -> InputError:
    example = f"{p.name} [{p.units[0]}]" if p.units else p.name
    message = _("There is no column '{example}' ({label}){where}.").format(
        example=example, label=p.label, where=where
    )
    if close:
        message += " " + _("Column '{close}' looks like it: rename it to '{name}'.").format(
            close=close, name=p.name
        )
    else:
        message += " " + _("Columns found: {names}.").format(names=", ".join(n for n in places if n) or "—")
    return InputError(message, name=p.name, did_you_mean=close)


def _column(p: Parameter, unit: str | None, cells: list[tuple[int, Any]], where: str) -> np.ndarray:
    assert p.kind is not None
    if unit is None and p.kind.unit not in ("dimensionless", "kg/kg"):
        raise InputError(
            _("Column '{name}' has no unit{where}. Write its header as '{example}'.").format(
                name=p.name, where=where, example=f"{p.name} [{p.units[0]}]"
            ),
            name=p.name,
            allowed=list(p.units),
        )
    if all(cell is None or cell == "" for _line, cell in cells):
        raise InputError(_("Column '{name}' is empty{where}.").format(name=p.name, where=where), name=p.name)
    values = []
    for line, cell in cells:
        value = _number(cell)
        if not np.isfinite(value):
            raise InputError(
                _("Line {line}, column '{name}': '{text}' is not a number{where}.").format(
                    line=line, name=p.name, text="" if cell is None else shown(cell), where=where
                ),
                name=p.name,
                line=line,
            )
        values.append(value)
    array = np.asarray(to_si(np.asarray(values), unit or p.kind.unit, p.kind, p.name), dtype=float)
    bad = ~np.asarray(p.kind.contains(array))
    if bad.any():
        line, cell = cells[int(np.argmax(bad))]
        raise InputError(
            _("Line {line}, column '{name}': {text} {unit} is not possible for a {kind}{where}.").format(
                line=line, name=p.name, text=cell, unit=unit or "", kind=_(p.kind.name), where=where
            ),
            name=p.name,
            line=line,
        )
    return array


def _number(cell: Any) -> float:
    """The number of a cell; NaN for what is none."""
    if isinstance(cell, str):
        try:
            return float(cell)
        except ValueError:
            found = read_number(cell)
            return found[0] if found and not found[1] else np.nan
    return float(cell) if isinstance(cell, (int, float)) and not isinstance(cell, bool) else np.nan


def _rows(source: Source, where: str, sheet: str = "") -> Iterable[Row]:
    """Line number and cells of every line that is neither empty nor a comment nor a title above the
    header.
    """
    rows = list(_lines(source, where, sheet))
    below = next((i for i, (_line, cells) in enumerate(rows) if not _may_be_title(cells)), 0)
    yield from rows[below if rows and _names_columns(rows[below][1]) else 0 :]


def _may_be_title(cells: list[Any]) -> bool:
    """Whether a line has one cell, which is neither a number nor a column with its unit."""
    filled = [cell for cell in cells if cell not in (None, "")]
    return len(filled) == 1 and np.isnan(_number(filled[0])) and _heading(str(filled[0]))[1] is None


def _names_columns(cells: list[Any]) -> bool:
    """Whether a line has several cells, or one with a unit."""
    filled = [cell for cell in cells if cell not in (None, "")]
    return len(filled) > 1 or any(_heading(str(cell))[1] is not None for cell in filled)


def _lines(source: Source, where: str, sheet: str) -> Iterable[Row]:
    """Line number and cells of every line that is neither empty nor a comment."""
    raw = _bytes(source, where)
    if raw[:2] == b"PK":
        yield from _sheet(raw, where, sheet)
        return
    try:
        text = raw.decode("utf-16" if raw[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("cp1252", errors="replace")
    lines = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip() and not _comment(line)]
    if not lines:
        return
    header = next((line for _i, line in lines if "[" in line), lines[0][1])  # a title may hold commas
    separator = max("\t;,", key=lambda mark: (header.count(mark), mark == ","))
    for i, line in lines:
        try:
            cells = [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
        except csv.Error as problem:  # a cell longer than a page, a lone quote
            raise InputError(
                _("The data file cannot be read{where}: {reason}.").format(where=where, reason=problem)
            ) from None
        if any(cells):
            yield i, cells


def _comment(line: str) -> bool:
    start = line.lstrip().lstrip('"')
    return start.startswith("#") and not start.upper().startswith(_SHEET_ERRORS)


def _bytes(source: Source, where: str) -> bytes:
    if not isinstance(source, (str, Path)):
        content = source.read()
        return content.encode("utf-8") if isinstance(content, str) else content
    path = Path(source)
    try:
        return path.read_bytes()
    except FileNotFoundError:
        close = nearest(path.name, [p.name for p in path.parent.iterdir()]) if path.parent.is_dir() else None
        message = _("There is no data file '{file}'.").format(file=source)
        if close:
            message += " " + _("Did you mean '{close}'?").format(close=path.parent / close)
        raise InputError(message, name=str(source), did_you_mean=close) from None
    except OSError as problem:
        raise InputError(
            _("The data file cannot be read{where}: {reason}.").format(where=where, reason=reason_of(problem))
        ) from None


def _not_swollen(raw: bytes, where: str) -> None:
    """A workbook is packed: one that unpacks to very much is refused before it is read."""
    from zipfile import ZipFile

    with ZipFile(io.BytesIO(raw)) as packed:
        if sum(part.file_size for part in packed.infolist()) > LARGEST_UNPACKED:
            raise InputError(
                _(
                    "The workbook is larger than {count} MB when unpacked{where}: save the columns it "
                    "needs as CSV."
                ).format(count=LARGEST_UNPACKED // 1_000_000, where=where)
            )


@contextmanager
def _opened(raw: bytes, where: str) -> Iterator[Any]:
    """A workbook while it is read; what cannot be read is told in one sentence."""
    import zlib
    from zipfile import BadZipFile

    import openpyxl

    try:
        _not_swollen(raw, where)
        yield openpyxl.load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
    except (
        BadZipFile,
        zlib.error,
        EOFError,
        OSError,
        KeyError,
        IndexError,
        ValueError,
        TypeError,
        AttributeError,
        SyntaxError,
    ) as problem:
        # what openpyxl raises on files that are no workbooks; broken XML is a SyntaxError
        raise InputError(
            _("The data file cannot be read{where}: {reason}.").format(where=where, reason=problem)
        ) from None


def _sheet(raw: bytes, where: str, name: str) -> Iterable[Row]:
    with _opened(raw, where) as workbook:
        sheet = workbook[name] if name in workbook.sheetnames else workbook.worksheets[0]
        rows = list(islice(sheet.iter_rows(values_only=True), MOST_ROWS + 1))
    if len(rows) > MOST_ROWS:
        raise InputError(
            _(
                "The workbook has more than {count} rows{where}: save it as CSV, or keep what the test needs."
            ).format(count=MOST_ROWS, where=where)
        )
    for i, cells in enumerate(rows, 1):
        if any(cell is not None for cell in cells) and not _comment(str(cells[0])):
            yield i, list(cells)
