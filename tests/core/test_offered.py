"""What is offered: units that a number can have, cards of the domain that was asked."""

from __future__ import annotations

import pytest

from granum.core import registry
from granum.core.errors import InputError


@pytest.mark.parametrize(
    ("key", "name", "percent"),
    [
        ("conveying.pneumatic_conveyor", "bends", False),
        ("particles.hindered_velocity", "reynolds", False),
        ("drying.drying_time", "critical_moisture", True),
        ("filtration.cake_resistance_power_law", "compressibility", True),
    ],
)
def test_no_number_that_is_no_share_is_offered_percent(key: str, name: str, percent: bool) -> None:
    (p,) = [p for p in registry.find(key).card.parameters if p.name == name]
    assert ("percent" in p.units) is percent


def test_a_card_that_its_domain_lacks_suggests_one_of_its_domain() -> None:
    with pytest.raises(InputError) as problem:
        registry.find("evaporation.single_effect")
    assert problem.value.message.endswith("Did you mean 'evaporation.multiple_effect_evaporator'?")
