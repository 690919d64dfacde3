"""A material that the library lacks gets no unrelated neighbor."""

from __future__ import annotations

import pytest

from granum.core.errors import InputError
from granum.streams.from_materials import mixture_of

SIZES = [1e-5, 1e-4]


@pytest.mark.parametrize("name", ["phenol", "p-xylene", "aniline"])
def test_a_liquid_of_ones_own_is_told_how_to_be_stated(name: str) -> None:
    with pytest.raises(InputError) as refused:
        mixture_of(["water", name], [], [], SIZES)
    assert "Did you mean" not in str(refused.value)
    assert f'[fluid."{name}"]' in str(refused.value)


@pytest.mark.parametrize(("typed", "meant"), [("etanol", "ethanol"), ("toluen", "toluene")])
def test_a_misspelt_one_is_still_found(typed: str, meant: str) -> None:
    with pytest.raises(InputError, match=f"Did you mean '{meant}'"):
        mixture_of(["water", typed], [], [], SIZES)
