"""Differential centrifugation: spins in a row, each pellet taken off the supernatant of the one before."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np

from granum.centrifuges.formulas.laboratory import pelleted_fraction
from granum.core import procedure
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import (
    Fraction,
    Length,
    MassFraction,
    PositiveNumber,
    Ratio,
    RotationSpeed,
    Series,
    Time,
)


class Pellets(NamedTuple):
    """The pellets in the order of the spins, then the last supernatant: number of the kind of particle that
    is the most of it, its share (purity), how much of all of that kind is there (yield), and the share of all
    particles.
    """

    pellet_kind: Annotated[PositiveNumber, Series("pellets")]
    pellet_purity: Annotated[Fraction, Series("pellets")]
    pellet_yield: Annotated[Fraction, Series("pellets")]
    pellet_share: Annotated[Fraction, Series("pellets")]


@procedure(
    source="graham2001",
    title="Differential centrifugation",
    typical={
        "sedimentation_coefficient": (1e-12, 1e-9),
        "kind_share": (0.1, 0.9),
        "rotation_speed": (100.0, 5000.0),
        "time": (300.0, 7200.0),
    },
)
def differential_centrifugation(
    sedimentation_coefficient: Annotated[Time, Series("kinds")],
    kind_share: Annotated[MassFraction, Series("kinds")],
    rotation_speed: Annotated[RotationSpeed, Series("spins")],
    time: Annotated[Time, Series("spins")],
    radius_inner: Length,
    radius_outer: Length,
    washings: Ratio = 0.0,
) -> Pellets:
    """Purity and yield of each pellet of a sequence of spins of a suspension of several kinds of particle.

    Each spin takes of every kind the share that reaches the bottom; the next one starts with the supernatant,
    evenly filled. A pellet may be washed: taken up in fresh liquid and spun the same way again: purer, and
    less of it, for what a washing leaves behind is thrown away. The shares of the kinds may be masses:
    they are taken by their sum.

    >>> found = differential_centrifugation(
    ...     ["10000 svedberg", "100 svedberg"],
    ...     [0.2, 0.8],
    ...     ["10000 rpm", "40000 rpm"],
    ...     ["5 min", "2 hour"],
    ...     "5 cm",
    ...     "10 cm",
    ... )
    >>> [int(k) for k in found.pellet_kind]
    [1, 2, 2]
    """
    kinds = np.atleast_1d(np.asarray(sedimentation_coefficient, dtype=float))
    parts = np.atleast_1d(np.asarray(kind_share, dtype=float))
    speeds = np.atleast_1d(np.asarray(rotation_speed, dtype=float))
    times = np.atleast_1d(np.asarray(time, dtype=float))
    for one, other, names in (
        (kinds, parts, ("sedimentation_coefficient", "kind_share")),
        (speeds, times, ("rotation_speed", "time")),
    ):
        if one.size != other.size:
            raise InputError(
                _("'{one}' has {count} values and '{other}' {number}: give one for each.").format(
                    one=names[0], count=one.size, other=names[1], number=other.size
                )
            )
    if not parts.sum() > 0.0:
        raise InputError(_("The mass fractions are all zero: there is nothing to spin."))
    whole = parts / parts.sum()
    left, rows = whole.copy(), []
    for speed, duration in zip(speeds, times, strict=True):
        share = np.asarray(
            [float(pelleted_fraction(s, duration, speed, radius_inner, radius_outer)) for s in kinds]
        )
        rows.append(left * share ** (1.0 + float(washings)))
        left = left * (1.0 - share)
    rows.append(left)
    pellets = np.asarray(rows)
    masses = pellets.sum(axis=1)
    main = pellets.argmax(axis=1)
    most = pellets[np.arange(len(rows)), main]
    purity = np.divide(most, masses, out=np.zeros_like(most), where=masses > 0.0)
    yields = np.divide(most, whole[main], out=np.zeros_like(most), where=whole[main] > 0.0)
    return Pellets(main + 1.0, purity, yields, masses)
