"""The thickest cake without cracks, alone and as a check of filters; heel and height of a peeler's cake."""

from __future__ import annotations

from typing import Any

import pytest

import granum as gr
from granum.filtration.formulas.cracking import cake_thickness_crack_free_singh as thickest


def checks(key: str, **words: Any) -> dict[str, Any]:
    return {c.name: c for c in gr.alone(key, **words).solve().units[key.split(".")[1]].checks}


def test_a_crack_frees_less_than_its_two_surfaces_cost() -> None:
    """A layer whose contacts carry K ε² stores p ε = p^(3/2)/K^(1/2) per volume; a crack costs twice the
    surface tension per area. Their ratio is the thickness but for the number of the source.
    """
    tension, modulus, void, contacts = 0.05, 2e10, 0.4, 6.0
    for suction in (3e3, 2e4, 9e4):
        strain = (suction / (modulus * contacts * (1.0 - void))) ** 0.5
        balance = 2.0 * tension / (suction * strain)
        assert thickest(suction, tension, modulus, void) == pytest.approx(0.64 * balance, rel=1e-12)


def test_finer_grains_crack_thinner_cakes() -> None:
    """Suction at the threshold grows as the inverse of the grain: the thickness as its power 3/2."""
    suction = [float(gr.filtration.threshold_pressure_cake(d, 0.45, 0.07)) for d in (5e-6, 20e-6)]
    thin, thick = (float(thickest(p, 0.07, 3e10, 0.45)) for p in suction)
    assert thick / thin == pytest.approx(8.0)
    assert thin < 2e-3 < thick  # of fine grains millimeters, as of filters that crack


def test_a_filter_checks_its_drained_cake() -> None:
    what = "thickness of a cake drained but not squeezed over the thickest that does not crack"
    assert what not in checks("filtration.rotary_vacuum_drum")
    found = checks("filtration.rotary_vacuum_drum", shear_modulus="30 GPa")[what]
    softer = checks("filtration.rotary_vacuum_drum", shear_modulus="1.2 GPa")[what]
    assert float(softer.value) == pytest.approx(5.0 * float(found.value), rel=1e-6)
    squeezed = checks("filtration.membrane_press", shear_modulus="1.2 GPa")[what]
    assert float(squeezed.value) == 0.0


def test_a_peeler_is_not_filled_to_its_rim_and_keeps_a_thin_heel() -> None:
    """Andritz, read: cake to 75 to 80 % of the height of the rim; Grim, read: about a twentieth of the basket
    stays in the machine.
    """
    ordinary = checks("centrifuges.peeler", heel_thickness="5 mm")
    fuller = checks("centrifuges.peeler", cake_radius="48 cm", heel_thickness="2 cm")
    rim, heel = "cake height over that of the rim", "volume of the heel over that of the basket"
    assert float(ordinary[rim].value) == pytest.approx(10.0 / 13.0)
    assert ordinary[rim].ok
    assert not fuller[rim].ok
    assert float(ordinary[heel].value) == pytest.approx((60**2 - 59.5**2) / (60**2 - 47**2))
    assert ordinary[heel].ok
    assert not fuller[heel].ok
