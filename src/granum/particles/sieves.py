"""Standard test sieves by designation: ISO 565 / 3310-1 series, ASTM E11 numbers and Tyler meshes."""

from __future__ import annotations

from functools import cache
from typing import Annotated, Literal, NamedTuple

import numpy as np

from granum.core import procedure
from granum.core.datasets import dataset
from granum.core.errors import InputError, unknown_name
from granum.core.i18n import _
from granum.core.kinds import Length, Series

SeriesName = Literal["iso565_r20", "iso565_r20_3", "iso565_r40_3", "iso565_r10", "astm_e11", "tyler"]


@cache
def sieve_table() -> dict[str, dict[str, float]]:
    """Apertures in m by series and designation, coarse to fine."""
    table: dict[str, dict[str, float]] = {}
    for row in dataset("particles", "sieves_iso565"):
        table.setdefault(row["series"], {})[row["designation"]] = row["aperture"]
    return table


def _tidy(designation: str) -> str:
    word = (
        designation.lower()
        .replace("#", "")
        .replace('"', " in")
        .replace("½", " 1/2")
        .replace("mesh", "")
        .replace("no.", "")
        .strip()
    )
    word = (
        word.removesuffix("in.").removesuffix("in").strip() + " in" if word.endswith(("in", "in.")) else word
    )
    return " ".join(word.removesuffix("mm").split())


@procedure(source="iso565; iso3310-1; astm_e11; tyler_handbook53", title="Aperture of a standard sieve")
def aperture(sieve_designation: str, sieve_series: SeriesName = "astm_e11") -> Length:
    """Nominal aperture of a sieve by its designation: mm for ISO, number or inches for ASTM E11, mesh for
    Tyler.

    >>> aperture("No. 200")
    7.5e-05
    >>> round(aperture("200 mesh", sieve_series="tyler") * 1e6, 3)
    74.0
    """
    known = sieve_table()[sieve_series]
    word = _tidy(str(sieve_designation))
    found = known.get(word)
    if found is None:
        raise unknown_name(_("Sieve"), word, known, _("in {series}").format(series=sieve_series))
    return found


class SieveStack(NamedTuple):
    """Sieves of a stack, fine to coarse."""

    aperture: Annotated[Length, Series("sieves")]


@procedure(source="iso565; iso3310-1; astm_e11; tyler_handbook53", title="Sieves of a standard series")
def sieve_series_apertures(
    sieve_series: SeriesName = "iso565_r20_3", smallest_size: Length = 45e-6, largest_size: Length = 2e-3
) -> SieveStack:
    """All apertures of a series between two sizes, fine to coarse.

    >>> [
    ...     round(float(w) * 1e6, 3)
    ...     for w in sieve_series_apertures("iso565_r20_3", "125 um", "500 um").aperture
    ... ]
    [125.0, 180.0, 250.0, 355.0, 500.0]
    """
    sizes = np.sort(np.array(list(sieve_table()[sieve_series].values())))
    kept = sizes[(sizes >= smallest_size * (1 - 1e-9)) & (sizes <= largest_size * (1 + 1e-9))]
    if not kept.size:
        raise InputError(
            _("No sieve of {series} lies between {low} and {high} m.").format(
                series=sieve_series, low=f"{smallest_size:.4g}", high=f"{largest_size:.4g}"
            ),
            name="smallest_size",
        )
    return SieveStack(kept)
