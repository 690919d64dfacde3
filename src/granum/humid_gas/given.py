"""The properties that may fix the state of a humid gas, and which two of them do."""

from __future__ import annotations

from typing import Any

from granum.core.errors import InputError
from granum.core.i18n import _, quoted

MOISTURE = ("humidity_ratio", "vapor_pressure", "dew_point_temperature")
WET = ("wet_bulb_temperature", "adiabatic_saturation_temperature")
NAMES = ("temperature", *MOISTURE, "relative_humidity", *WET, "enthalpy", "specific_volume")


def check_pair_of_inputs(given: dict[str, Any]) -> None:
    """One clear error when the state is not fixed by exactly two independent properties."""
    names = list(given)
    listed = ", ".join(quoted(name) for name in NAMES)
    if len(names) != 2:
        raise InputError(
            _("A humid-gas state needs exactly two of {allowed}; given: {names}.").format(
                allowed=listed, names=", ".join(quoted(name) for name in names) or _("none")
            ),
            given=names,
        )
    if all(name in MOISTURE for name in names):
        raise InputError(
            _(
                "'{first}' and '{second}' say the same thing at a given pressure; give one of them and "
                "another property."
            ).format(first=names[0], second=names[1]),
            given=names,
        )
    if all(name in WET for name in names):
        raise InputError(
            _(
                "'{first}' and '{second}' nearly coincide and do not fix the state; give one of them and "
                "another property."
            ).format(first=names[0], second=names[1]),
            given=names,
        )
