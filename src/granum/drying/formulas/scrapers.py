"""The knife that lies on a turning cylinder."""

from __future__ import annotations

from granum.core import formula
from granum.core.kinds import Length, Power, Ratio, TurningSpeed
from granum.settling.kinds import LineLoad


@formula(
    source="sunhong, a maker's page",
    equation=r"P = \mu\,q\,l\,\frac{\omega D}{2}",
    typical={
        "diameter": (0.5, 2.0),
        "width": (0.5, 5.0),
        "rotation_speed": (0.05, 1.5),
        "blade_load": (90.0, 5000.0),
        "friction_coefficient": (0.1, 0.3),
    },
    title="Shaft power that a scraper takes from its cylinder",
)
def shaft_power_scraper(
    diameter: Length,
    width: Length,
    rotation_speed: TurningSpeed,
    blade_load: LineLoad = 2000.0,
    friction_coefficient: Ratio = 0.2,
) -> Power:
    """Coulomb's friction of a knife pressed along the whole width of a cylinder, over the way of its surface.

    A maker of doctors states 0.15 to 0.30 and, where they only clean, 90 to 220 N/m (read); knives that lift
    a sheet are pressed with 2 to 5 kN/m (from memory, of tissue machines). What it takes to break the film
    is not in it.

    By hand: 0.2 · 200 N/m · 2 m at 0.5 m/s are 40 W.

    >>> round(shaft_power_scraper(1.0, 2.0, "1 rad/s", 200.0), 1)
    40.0
    """
    return friction_coefficient * blade_load * width * 0.5 * rotation_speed * diameter
