"""Class fractions that do not add up to one are told by every card that takes them; relative masses need
not.
"""

from __future__ import annotations

import pytest

import granum as gr
from granum.core.errors import ApplicabilityError

CARDS = {
    "cyclones.removal_efficiency_grades": ({"class_efficiencies": [0.4, 0.9]}, 0.65),
    "settling.removal_efficiency_classes": ({"class_velocities": [4e-4, 1e-3], "overflow_rate": 1e-3}, 0.7),
    "porous.specific_surface_mixture": ({"class_sizes": [1e-4, 2e-4]}, 45000.0),
    "crystallization.grown_seed": (
        {"class_sizes": [1e-4, 2e-4], "seed_mass": 1.0, "product_mass": 17.5},
        None,
    ),
}


@pytest.mark.parametrize("key", CARDS)
def test_shares_must_add_up(key):
    given, exact = CARDS[key]
    card = gr.core.registry.find(key)
    with pytest.raises(
        ApplicabilityError, match=r"fraction in each class = 80 % is outside .*must add up to 1"
    ):
        card(class_fractions=[0.5, 0.3], **given)
    rounded = card(class_fractions=[0.501, 0.501], **given)  # a rounded table is divided by its sum
    if exact is not None:
        assert rounded == pytest.approx(exact, rel=1e-12)


def test_relative_masses_are_masses():
    assert gr.particles.mean_diameter_mass(class_sizes=[1.0, 2.0], class_masses=[3.0, 1.0]) == pytest.approx(
        1.25
    )
