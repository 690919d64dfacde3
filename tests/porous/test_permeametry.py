"""Permeametry: known parameters come back, their intervals hold them, bad data are refused."""

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.porous.formulas import kozeny, packed_beds
from granum.porous.lab_tests.permeametry import Permeametry

CONDITIONS = {"length": 0.2, "dynamic_viscosity": 1e-3, "fluid_density": 1000.0}


def test_exact_data_give_ergun_back():
    U = np.geomspace(1e-4, 0.1, 8)
    drop = 0.2 * np.asarray(packed_beds.pressure_gradient_ergun(U, 1e-3, 0.4, 1000.0, 1e-3))
    found = Permeametry(
        superficial_velocity=U,
        pressure_drop=drop,
        **CONDITIONS,
        void_fraction=0.4,
        kozeny_coefficient=150 / 36,
    ).fit()
    assert found["permeability"].value == pytest.approx(1e-6 * 0.064 / (150 * 0.36), rel=1e-8)
    assert found["inertial_coefficient"].value == pytest.approx(1.75 * 0.6 / (0.064 * 1e-3), rel=1e-8)
    assert found["particle_diameter"].value == pytest.approx(1e-3, rel=1e-8)
    assert found["specific_surface"].value == pytest.approx(6000, rel=1e-8)


def test_intervals_cover_the_truth():
    rng = np.random.default_rng(5)
    B, beta = 2e-10, 3e4
    U = np.geomspace(1e-3, 0.1, 12)
    inside = 0
    for _ in range(20):
        drop = 0.2 * (1e-3 / B * U + beta * 1000 * U**2) * (1 + 0.02 * rng.standard_normal(12))
        found = Permeametry(superficial_velocity=U, pressure_drop=drop, **CONDITIONS).fit()["permeability"]
        inside += found.interval_95[0] <= B <= found.interval_95[1]
    assert 16 <= inside <= 20


def test_creeping_and_bad_data():
    U = np.array([1e-4, 2e-4, 3e-4])
    found = Permeametry(
        superficial_velocity=U, pressure_drop=0.2 * 1e-3 / 1e-11 * U, **CONDITIONS, creeping=True
    ).fit()
    assert found["permeability"].value == pytest.approx(1e-11)
    surface = kozeny.specific_surface_kozeny_carman(found["permeability"].value, 0.45)
    assert surface == pytest.approx(np.sqrt(0.45**3 / (5 * 1e-11)) / 0.55)
    with pytest.raises(InputError, match="superficial_velocity"):
        Permeametry(superficial_velocity=[0.0, 0.1, 0.2], pressure_drop=[1.0, 2.0, 3.0], **CONDITIONS).fit()
    with pytest.raises(InputError, match="at least"):
        Permeametry(superficial_velocity=[0.1, 0.2], pressure_drop=[1.0, 2.0], **CONDITIONS)
