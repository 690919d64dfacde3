"""Darcy, Kozeny and their inverses."""

import numpy as np
import pytest

from granum.core.constants import DARCY
from granum.core.errors import ApplicabilityError, InputError
from granum.core.kinds import KINDS
from granum.core.units import from_si, read_quantity
from granum.porous.formulas import darcy, gas, kozeny, porosity


def test_darcy_unit():
    # course II-2-1: 0.987e-8 cm²
    assert pytest.approx(0.9869e-12, rel=1e-4) == DARCY
    assert read_quantity("1 darcy", KINDS["Permeability"], "permeability") == pytest.approx(DARCY, rel=1e-6)
    assert read_quantity("1 millidarcy", KINDS["Permeability"], "permeability") == pytest.approx(
        DARCY / 1000, rel=1e-6
    )
    assert from_si(DARCY, "um^2", KINDS["Permeability"]) == pytest.approx(0.9869, rel=1e-4)
    assert darcy.permeability_darcy(0.01, 101325.0, 1e-3, 0.01) == pytest.approx(0.987e-12, rel=1e-3)


def test_darcy_in_every_direction():
    drop = darcy.pressure_drop_darcy(1e-3, 1e-11, 1e-3, 0.2)
    assert drop == pytest.approx(20_000)
    assert darcy.superficial_velocity_darcy(drop, 1e-11, 1e-3, 0.2) == pytest.approx(1e-3)
    assert darcy.permeability_darcy(-1e-3, -drop, 1e-3, 0.2) == pytest.approx(1e-11)
    with pytest.raises(ApplicabilityError, match="opposite signs"):
        darcy.permeability_darcy(1e-3, -drop, 1e-3, 0.2)
    K = darcy.hydraulic_conductivity(1e-11, 1000.0, 1e-3)
    assert darcy.permeability_from_conductivity(K, 1000.0, 1e-3) == pytest.approx(1e-11)


def test_forchheimer_both_ways():
    for U in (-0.3, 1e-6, 0.1, 3.0):
        drop = darcy.pressure_drop_forchheimer(U, 1e-9, 2e4, 1000.0, 1e-3, 0.1)
        assert darcy.superficial_velocity_forchheimer(drop, 1e-9, 2e4, 1000.0, 1e-3, 0.1) == pytest.approx(
            U, rel=1e-10
        )


def test_poiseuille_and_noncircular_sections():
    # White, Viscous Fluid Flow, table 3-1: f Re = 64 circle, 56.91 square, 96 slit (Darcy), 53.33 equilateral
    # triangle
    assert darcy.noncircularity_rectangle(1.0) == pytest.approx(56.91 / 64, abs=1e-3)
    assert darcy.noncircularity_rectangle(0.0) == pytest.approx(96 / 64)
    assert darcy.noncircularity_rectangle(0.5) == pytest.approx(62.19 / 64, abs=1e-3)
    assert darcy.pressure_drop_poiseuille(1.0, 1e-3, 1e-3, 1.0, 53.33 / 64) == pytest.approx(
        0.833 * 32e3, rel=1e-3
    )


def test_kozeny_bundle_is_consistent():
    e, a, U, D, T = 0.4, 6e4, 1e-3, 0.05, 1.5
    found = kozeny.kozeny_bundle(e, a, D, U, T)
    # same porosity, same surface, same flow as the bed
    section = np.pi * D**2 / 4
    assert found.pore_number * np.pi * found.pore_diameter**2 / 4 * T == pytest.approx(e * section)
    assert found.pore_number * np.pi * found.pore_diameter * T == pytest.approx(a * (1 - e) * section)
    assert found.pore_number * np.pi * found.pore_diameter**2 / 4 * found.pore_velocity == pytest.approx(
        U * section
    )
    # Poiseuille in the pores is Kozeny–Carman with h_K = 2 γ T²
    drop = darcy.pressure_drop_poiseuille(found.pore_velocity, found.pore_diameter, 1e-3, T * 0.1)
    B = kozeny.permeability_kozeny_carman(e, a, found.kozeny_coefficient)
    assert drop == pytest.approx(darcy.pressure_drop_darcy(U, B, 1e-3, 0.1))


def test_kozeny_carman_inverses():
    for e in (0.05, 0.4, 0.9, 0.99):
        B = kozeny.permeability_kozeny_carman(e, 3e4, 4.5)
        assert kozeny.specific_surface_kozeny_carman(B, e, 4.5) == pytest.approx(3e4)
        assert kozeny.void_fraction_kozeny_carman(B, 3e4, 4.5) == pytest.approx(e, rel=1e-9)
        assert kozeny.particle_diameter_kozeny_carman(B, e, 0.8, 4.5) == pytest.approx(6 / 3e4 / 0.8)
        assert kozeny.permeability_carman(6 / 3e4 / 0.8, e, 0.8, 4.5) == pytest.approx(B)
    assert kozeny.permeability_blake_kozeny(1e-4, 0.4) / kozeny.permeability_carman(
        1e-4, 0.4
    ) == pytest.approx(180 / 150)


def test_other_structures():
    # Happel and Brenner 1973, table 8-4.2: Kozeny constants of the sphere cell by porosity
    for e, h in ((0.5, 4.74), (0.6, 5.11), (0.7, 5.79), (0.9, 11.34)):
        assert kozeny.permeability_kozeny_carman(e, 6 / 1e-4, h) == pytest.approx(
            kozeny.permeability_happel(1e-4, e), rel=0.01
        )
    assert kozeny.permeability_happel(1e-4, 1 - 1e-9) == pytest.approx(
        kozeny.permeability_obstacles(1e-4, 1 - 1e-9), rel=2e-3
    )
    # Rumpf and Gupte meet Carman near ε = 0.4
    assert kozeny.permeability_rumpf_gupte(1e-4, 0.4) == pytest.approx(
        kozeny.permeability_carman(1e-4, 0.4), rel=0.2
    )
    # Davies at ε = 0.99: d²/(64 · 0.01^1.5)
    assert kozeny.permeability_davies(1e-5, 0.99) == pytest.approx(1e-10 / (64 * 1e-3 * (1 + 56e-6)))
    assert kozeny.specific_surface_mixture([1e-4, 3e-4], [0.5, 0.5]) == pytest.approx(
        6 * (0.5 / 1e-4 + 0.5 / 3e-4)
    )


def test_porosity():
    assert porosity.void_fraction_from_mass(1.59, 2650.0, 0.01, 0.1) == pytest.approx(0.4)
    with pytest.raises(ApplicabilityError, match="mass = 5 kg is outside"):
        porosity.void_fraction_from_mass(mass=5.0, solid_density=2650, area=0.01, length=0.1)
    # spheres in wide columns: 0.39 to 0.40
    assert porosity.void_fraction_dixon(0.0) == pytest.approx(0.40)
    assert porosity.void_fraction_benyahia_oneill(1e-6) == pytest.approx(0.39)
    # fluids.packed_bed, Benyahia and O'Neill (2005) for spheres, tube 10 d
    assert porosity.void_fraction_benyahia_oneill(0.1) == pytest.approx(0.390 + 1.740 / 11.14**2)
    # Dixon's pieces meet
    assert porosity.void_fraction_dixon(0.5) == pytest.approx(
        porosity.void_fraction_dixon(0.500001), abs=1e-3
    )
    with pytest.raises(InputError, match="void_fraction"):
        kozeny.permeability_kozeny_carman(1.2, 6e4)


def test_gas_permeability():
    # linear limit: B = η L U/Δp
    B = gas.permeability_gas(0.01, 1.001e5, 1e5, 1.8e-5, 0.05)
    assert pytest.approx(1.8e-5 * 0.05 * 0.01 / 100.0, rel=1e-3) == B
    with pytest.raises(ApplicabilityError, match="outlet pressure"):
        gas.permeability_gas(0.01, 1e5, 2e5, 1.8e-5, 0.05)
    assert darcy.permeability_klinkenberg(1e-15, 1e5, 5e4) == pytest.approx(1.5e-15)
