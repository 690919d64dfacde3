"""Bond's table of average work indices."""

from __future__ import annotations

from granum.comminution.kinds import WorkIndex
from granum.core import procedure
from granum.core.datasets import dataset
from granum.core.errors import unknown_name
from granum.core.i18n import _


def work_indices() -> dict[str, float]:
    """Average work indices by material, J/kg."""
    return {row["material"]: row["work index"] for row in dataset("comminution", "work_index_bond1961")}


@procedure(source="bond1961; perry2008", title="Average work index of a material")
def work_index(material: str) -> WorkIndex:
    """Bond's average for a material; single ores scatter by 30 % and more, so measure for a design.

    >>> round(work_index("limestone") / (3.6e6 / 907.18474), 2)
    11.61
    """
    known = work_indices()
    found = known.get(str(material).strip().lower())
    if found is None:
        raise unknown_name(_("Material"), str(material), known)
    return found
