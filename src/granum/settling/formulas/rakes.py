"""Torque of the rakes of round settlers."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import Length
from granum.settling.kinds import LineLoad, Torque


@formula(
    source="boyle2012",
    equation=r"M = K\,D^2",
    typical={"diameter": (5.0, 60.0), "torque_factor": (15.0, 400.0)},
    title="Torque of a rake",
)
def rake_torque(diameter: Length, torque_factor: LineLoad) -> Torque:
    """Torque of two rake arms under an even load along their length; the factor is a quarter of that load.

    Boyle writes T = L R² in ft·lbf with the load L in lb/ft. Light sludges load an arm with some 90 N/m,
    heavy slurries with ten times that.

    By hand: 6 lb/ft (87.6 N/m) on arms of 12.2 m are 87.6 · 12.2² N m.

    >>> round(rake_torque(24.4, 87.6 / 4.0))
    13038
    """
    return torque_factor * diameter**2
