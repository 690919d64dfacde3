"""Washing against the transport equation and its limits; deliquoring against the correlation's own charted
ends.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erfc

from granum.filtration.formulas import deliquoring as dq
from granum.filtration.formulas import washing as wa


@pytest.mark.parametrize("Dn", [0.3, 5.0, 60.0])
def test_remaining_solute_is_what_has_not_left(Dn):
    for w in (0.3, 1.0, 2.5):
        left, _err = quad(
            lambda x: float(wa.wash_effluent_concentration(x, Dn)),
            0.0,
            w,
            epsabs=1e-12,
            epsrel=1e-11,
            limit=200,
        )
        assert wa.solute_remaining_dispersion(w, Dn) == pytest.approx(1.0 - left, abs=1e-8)


def test_effluent_satisfies_the_dispersion_equation():
    # phi = 1 - u, u(z, w) of Ogata and Banks solves u_w = u_zz / Dn - u_z with u(0) = 1; checked at z = 1 by
    # differences
    Dn, w, h = 8.0, 0.8, 1e-3

    def u(z, w):
        a, b = (z - w) * np.sqrt(Dn / w) / 2, (z + w) * np.sqrt(Dn / w) / 2
        return 0.5 * (erfc(a) + np.exp(Dn * z) * erfc(b))

    assert wa.wash_effluent_concentration(w, Dn) == pytest.approx(1 - u(1, w), rel=1e-12)
    time = (u(1, w + h) - u(1, w - h)) / (2 * h)
    space = (u(1 + h, w) - 2 * u(1, w) + u(1 - h, w)) / h**2 / Dn - (u(1 + h, w) - u(1 - h, w)) / (2 * h)
    assert time == pytest.approx(space, rel=1e-5)


def test_limits_of_washing():
    assert wa.wash_effluent_concentration(0.0, 5.0) == 1.0
    assert wa.solute_remaining_dispersion(0.0, 5.0) == 1.0
    assert wa.solute_remaining_dispersion(0.6, 900.0) == pytest.approx(0.4, abs=2e-3)  # plug displacement
    F = np.asarray(wa.solute_remaining_dispersion(np.linspace(0.01, 4, 200), 10.0))
    assert np.all(np.diff(F) < 0)
    assert np.all(1 - np.linspace(0.01, 4, 200) - 1e-12 <= F)
    # Choudhury and Dahlstrom as McCabe et al. print it: 70 % displacement leaves 0.3 after one, 0.09 after
    # two void volumes
    assert wa.solute_remaining_dahlstrom(2.0, 0.7) == pytest.approx(0.09)
    assert wa.solute_remaining_reslurry(3.0, 2) == pytest.approx(1 / 16)
    # a fast pore flow makes the dispersion number the cake's thickness in grains over 1.75
    DL = wa.axial_dispersion_cake(1e-2, 1e-4, 1e-10)
    assert wa.dispersion_number(1e-2, 0.02, DL) == pytest.approx(0.02 / 1.75e-4, rel=1e-3)


def test_deliquoring_correlation():
    # hand evaluation: N_cap = 0.45^3 (5e-5)^2 (1000·9.80665·0.02 + 5e4)/(0.55^2·0.02·0.07)
    N = dq.capillary_number_cake(5e-5, 0.45, 0.02, 5e4, 1000, 0.07)
    assert pytest.approx(0.091125 * 2.5e-9 * 50196.133 / (0.3025 * 0.02 * 0.07), rel=1e-9) == N
    assert dq.irreducible_saturation(N) == pytest.approx(0.155 * (1 + 0.031 * N**-0.49), rel=1e-12)
    assert dq.threshold_pressure_cake(5e-5, 0.45, 0.07) == pytest.approx(
        4.6 * 0.07 * 0.55 / (0.45 * 5e-5), rel=1e-12
    )
    # ends of Wakeman's charts: θp* = 0.096 leaves 88 %, 204 leaves 5 % of the reducible saturation
    scale = 1e-3 * 0.5 * 1.0 * 0.02**2 / (1e-13 * 1e5)
    first, last = (
        dq.saturation_after_deliquoring(x * scale, 1e5, 1e-13, 1e-3, 0.5, 0.02, 0.0) for x in (0.096, 204.0)
    )
    assert first == pytest.approx(1 / (1 + 1.08 * 0.096**0.88), rel=1e-9)
    assert first == pytest.approx(0.88, abs=0.005)
    assert last == pytest.approx(0.0506, abs=5e-4)
    t = np.geomspace(0.096, 204, 300) * scale
    assert np.all(
        np.diff(np.asarray(dq.saturation_after_deliquoring(t, 1e5, 1e-13, 1e-3, 0.5, 0.02, 0.2))) < 0
    )
    result = dq.saturation_after_deliquoring.evaluate(500 * scale, 1e5, 1e-13, 1e-3, 0.5, 0.02, 0.0)
    assert result.notices[0]["name"] == "dimensionless_time"


def test_gas_through_a_dry_cake_is_darcy_for_an_ideal_gas():
    assert dq.gas_velocity_deliquoring(1e-12, 0.01, 2e5, 1e5, 2e-5, 0.0) == pytest.approx(
        1e-12 / 2e-5 * (4e10 - 1e10) / (2 * 1e5 * 0.01)
    )
    assert dq.gas_velocity_deliquoring(1e-12, 0.01, 2e5, 1e5, 2e-5, 1.0) == 0.0
