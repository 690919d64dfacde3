"""Well-mixed beds: the closed forms of the spread of residence times, deep beds, figures of the youngest."""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
import pytest

from granum.drying.contact.dryer import ready
from granum.drying.contact.kinetics import AbstractKinetics, Meeting
from granum.drying.contact.matter import Matter
from granum.drying.contact.mixed import Bed, Gas, Solid, steady_bed
from granum.streams.from_materials import mixture_of

MIXTURE = mixture_of(["water"], ["calcite"], ["dry air", "water"], [0.9e-3, 1.1e-3])
MATTER = Matter(MIXTURE, 1, jnp.ones((1, 1)), jnp.array([1.0, 0.0]), 101325.0)
WET = 0.1


class Given(AbstractKinetics):
    """A rate whatever the gas: of first order, or constant down to (almost) nothing."""

    first: float
    constant: float

    def equilibrium(self, at: Meeting):
        return 0.0 * at.moisture

    def rate(self, at: Meeting):
        return self.first * at.moisture + self.constant * jnp.clip(at.moisture / (1e-6 * WET), 0.0, 1.0)


@ready
def left(first, constant):
    """Moisture of the product over that of the feed, the wettest that leaves, for a residence time of 100 s."""
    bed = Bed(MATTER, Given(first, constant), jnp.array([500.0]), jnp.array([1.0]), 100.0, 20.0)
    found = steady_bed(bed, Solid(jnp.array([WET]), jnp.array([313.15])), Gas(0.001, jnp.asarray(393.15)))
    return found.water[0] / WET, found.wettest / WET, found.converged


def test_residence_times_of_a_mixed_bed_are_exponential() -> None:
    """Kinetics of first order leave 1/(1 + kτ); a constant rate leaves 1 − (1 − e^(−x))/x of particles dry after xτ (Kunii and Levenspiel)."""
    for k in np.geomspace(0.1, 50.0, 9):
        share, wettest, found = left(jnp.asarray(k / 100.0), jnp.asarray(0.0))
        assert found
        assert float(share) == pytest.approx(1.0 / (1.0 + k), rel=1e-3)
        assert float(wettest) == pytest.approx(1.0)  # some leave as they came
    for x in np.geomspace(0.05, 10.0, 9):
        share, _wettest, found = left(jnp.asarray(0.0), jnp.asarray(WET / (100.0 * x)))
        assert found
        assert float(share) == pytest.approx(1.0 + np.expm1(-x) / x, rel=5e-3)
