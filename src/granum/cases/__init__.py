"""Case files: schema, reading, running, atomic writing."""

from typing import TYPE_CHECKING, Any

from granum.cases.alone import alone, case_text
from granum.cases.reading import read, read_text
from granum.flowsheet.run import Line, Run

if TYPE_CHECKING:
    from granum.cases.sizing import size
    from granum.cases.studying import read_studies, studies_of_line, studies_of_text

__all__ = [
    "Line",
    "Run",
    "alone",
    "case_text",
    "read",
    "read_studies",
    "read_text",
    "size",
    "studies_of_line",
    "studies_of_text",
]


def __getattr__(name: str) -> Any:
    if name in ("read_studies", "studies_of_line", "studies_of_text"):  # a run needs no statistics
        from granum.cases import studying

        return getattr(studying, name)
    if name == "size":  # a run seeks none
        from granum.cases.sizing import size

        return size
    raise AttributeError(f"granum.cases has no '{name}'")
