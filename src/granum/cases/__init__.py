"""Case files: schema, reading, running, atomic writing."""

from granum.cases.line import Line, Run
from granum.cases.reading import read, read_text

__all__ = ["Line", "Run", "read", "read_text"]
