"""Case files: schema, reading, running, atomic writing."""

from granum.cases.reading import read, read_text
from granum.cases.studying import read_studies, studies_of_line, studies_of_text
from granum.flowsheet.run import Line, Run

__all__ = ["Line", "Run", "read", "read_studies", "read_text", "studies_of_line", "studies_of_text"]
