"""``Limit``: a practical limit of a piece of equipment, declared on its class, so that it is known before
anything is calculated.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from granum.core.i18n import _


class Limit(NamedTuple):
    """What is measured must lie between ``low`` and ``high``. ``name`` is an English phrase that has a French
    translation.

    ``Limit("diameter", 0.0, 60.0, "m", "degremont2007")`` holds for every size and setting. An end may be the
    name of one of the unit's own parameters: ``Limit("cake thickness", "discharge_thickness", math.inf, "m",
    "perry2008")``. A ``quiet`` one is not told where zero is measured: what it warns of is not there.
    """

    name: str
    low: float | str
    high: float | str
    unit: str
    source: str
    quiet: bool = False

    def as_json(self) -> dict[str, Any]:
        """Stable plain data: an open end is None, an end given by a parameter its name."""
        low, high = (
            end if isinstance(end, str) else float(end) if math.isfinite(end) else None
            for end in (self.low, self.high)
        )
        return {"name": _(self.name), "low": low, "high": high, "unit": self.unit, "source": self.source}
