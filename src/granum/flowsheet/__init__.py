"""Flowsheets: units and streams connected, loops solved, audited and drawn."""

from granum.flowsheet.plan import Link
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, closures, line_closure, solve, solve_compiled, unit_closures

__all__ = ["Flowsheet", "Link", "Solution", "closures", "line_closure", "solve", "solve_compiled", "unit_closures"]
