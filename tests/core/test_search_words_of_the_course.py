"""Words of the French course notes lead to the card that is meant by them."""

from __future__ import annotations

import pytest

from granum.core.index import entries
from granum.core.search import _synonyms, search


@pytest.mark.parametrize(
    ("words", "key"),
    [
        ("vitesse de chute", "particles.terminal_velocity"),
        ("vitesse de sedimentation", "particles.terminal_velocity"),
        ("perte de charge", "porous.pressure_gradient_ergun"),
        ("vitesse limite", "particles.terminal_velocity"),
        ("loi de Stokes", "particles.terminal_velocity_stokes"),
        ("énergie de broyage", "comminution.specific_energy_bond"),
        ("courbe de sédimentation", "settling.batch_test"),
        ("point de rosée", "humid_gas.dew_point_temperature"),
        ("cyclone", "cyclones.gas_cyclone"),
        ("loi de Darcy", "porous.pressure_drop_darcy"),
        ("milieu poreux", "porous.pressure_drop_darcy"),
        ("milieux poreux", "porous.pressure_drop_darcy"),
        ("porous medium", "porous.pressure_drop_darcy"),
        ("porous media", "porous.pressure_drop_darcy"),
        ("filtre", "filtration.separator_choice"),
        ("filtres", "filtration.separator_choice"),
        ("pression de vapeur saturante", "materials.water_vapor_pressure"),
    ],
)
def test_a_word_of_the_course_finds_its_card_first(words: str, key: str) -> None:
    assert search(words)[0].key == key


def test_names_are_given_to_cards_that_exist() -> None:
    assert not set(_synonyms()[1]) - set(entries())
