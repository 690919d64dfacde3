"""When the search of a fit ends."""

from typing import NamedTuple


class Search(NamedTuple):
    """When a search ends: least relative change of the parameters and of the sum of squares, least slope,
    most evaluations.
    """

    xtol: float
    ftol: float
    gtol: float
    max_nfev: int


EXACT = Search(1e-14, 1e-14, 1e-14, 5000)
JUDGING = Search(1e-6, 1e-4, 1e-14, 50)
"""A twentieth of a standard error or less: for refits that judge a point, which start at the fit of all."""
