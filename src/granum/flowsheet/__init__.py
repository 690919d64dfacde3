"""Flowsheets: units and streams connected, loops solved, audited and drawn."""

from granum.flowsheet.axes import Gathered, gather_axes
from granum.flowsheet.dynamics import Course, Profile, march
from granum.flowsheet.plan import Link
from granum.flowsheet.run import Line, Movement, Run
from granum.flowsheet.schedule import Schedule, schedule
from granum.flowsheet.sheet import Flowsheet
from granum.flowsheet.solving import Solution, closures, line_closure, solve, solve_compiled, unit_closures

__all__ = [
    "Course",
    "Gathered",
    "gather_axes",
    "Line",
    "Movement",
    "Profile",
    "Run",
    "Schedule",
    "march",
    "schedule",
    "Flowsheet",
    "Link",
    "Solution",
    "closures",
    "line_closure",
    "solve",
    "solve_compiled",
    "unit_closures",
]
