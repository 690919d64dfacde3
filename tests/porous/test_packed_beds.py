"""Packed beds: printed examples, another library, limits, inverses."""

import fluids.packed_bed as peer
import numpy as np
import pytest

from granum.core.errors import ApplicabilityError, InputError
from granum.core.registry import everything
from granum.porous.formulas import inverse, packed_beds
from granum.porous.formulas.gas import mass_flux_gas_bed, pressure_outlet_gas_bed
from granum.porous.formulas.packed_beds_modern import EisfeldSchnitzlein

LAWS = {
    f.card.name.removeprefix("pressure_gradient_"): f
    for f in everything(("porous",)).values()
    if f.card.family == "pressure_gradient" and f.card.sort == "formula"
}
PEERS = {
    "ergun": "Ergun",
    "tallmadge": "Tallmadge",
    "erdim": "Erdim_Akgiray_Demir",
    "kta": "KTA",
    "brauer": "Brauer",
}
BED = {"particle_diameter": 2e-3, "void_fraction": 0.4, "fluid_density": 1000.0, "dynamic_viscosity": 1e-3}


@pytest.mark.parametrize("name", PEERS)
def test_same_equation_as_the_peer_library(name):
    for U in (1e-4, 1e-2, 0.3):
        expected = getattr(peer, PEERS[name])(dp=2e-3, voidage=0.4, vs=U, rho=1000.0, mu=1e-3)
        assert LAWS[name](U, **BED) == pytest.approx(expected, rel=1e-12)


def test_geankoplis_example_3_1_4():
    # Geankoplis, Transport Processes: 0.358 kg/s of air at 311 K, 1.10 atm, bed of 12.7 mm spheres 0.61 m
    # wide, 2.44 m deep, ε = 0.38:
    # 0.0497e5 Pa
    flux = 0.358 / (np.pi / 4 * 0.61**2)
    p1 = 1.10 * 101325
    p2 = pressure_outlet_gas_bed(flux, p1, 311.0, 0.02897, 1.90e-5, 2.44, 0.0127, 0.38)
    assert p1 - p2 == pytest.approx(0.0497e5, rel=0.01)
    assert mass_flux_gas_bed(p1, p2, 311.0, 0.02897, 1.90e-5, 2.44, 0.0127, 0.38) == pytest.approx(flux)


def test_forms_of_the_course():
    a, e, U, eta, rho = 6 / 2e-3, 0.4, 0.05, 1e-3, 1000.0
    # f' = 5/Re' + 0.4/Re'^0.1
    Re = rho * U / (a * (1 - e) * eta)
    f = 5 / Re + 0.4 * Re**-0.1
    assert packed_beds.pressure_gradient_carman(U, **BED) == pytest.approx(
        f * a * (1 - e) * rho * U**2 / e**3
    )
    # Kozeny–Carman h_K η U a²(1−ε)²/ε³; Burke–Plummer h_B a (1−ε) ρU²/ε³ with h_B = 0.29
    assert packed_beds.pressure_gradient_kozeny_carman(U, **BED) == pytest.approx(
        5 * eta * U * a**2 * (1 - e) ** 2 / e**3
    )
    assert packed_beds.pressure_gradient_burke_plummer(U, **BED) == pytest.approx(
        0.29 * a * (1 - e) * rho * U**2 / e**3, rel=0.01
    )
    numbers = packed_beds.packed_bed_numbers(U, **BED)
    assert numbers.reynolds_carman == pytest.approx(Re)
    # obstacles: 18 η U (1−ε)/d², the sum of Stokes' forces 3π η U d on 6(1−ε)/(π d³) grains
    thin = {**BED, "void_fraction": 0.999}
    forces = 3 * np.pi * eta * U * 2e-3 * 6 * 0.001 / (np.pi * 2e-3**3)
    assert packed_beds.pressure_gradient_obstacles(U, **thin) == pytest.approx(forces)
    # Ergun is the sum of its two limits
    parts = packed_beds.pressure_gradient_blake_kozeny(
        U, **BED
    ) + packed_beds.pressure_gradient_burke_plummer(U, **BED)
    assert packed_beds.pressure_gradient_ergun(U, **BED) == pytest.approx(parts)


def test_limits():
    slow, fast = 1e-7, 5.0
    creeping = {
        "kozeny_carman": 180,
        "carman": 180,
        "macdonald": 180,
        "erdim": 160,
        "brauer": 160,
        "kta": 160,
        "tallmadge": 150,
        "leva": 200,
        "ergun": 150,
        "blake_kozeny": 150,
        "eisfeld_schnitzlein_spheres": 154,
        "nemec_levec": 150,
    }
    unit = 1e-3 * slow * 0.36 / (0.064 * 4e-6)
    for name, constant in creeping.items():
        assert LAWS[name](slow, **BED) / unit == pytest.approx(constant, rel=5e-3), name
    inertial = 1000 * fast**2 * 0.6 / (0.064 * 2e-3)
    for name, constant in {
        "ergun": 1.75,
        "macdonald": 1.8,
        "burke_plummer": 1.75,
        "eisfeld_schnitzlein_spheres": 1 / 0.87**2,
    }.items():
        assert LAWS[name](fast, **BED) / inertial == pytest.approx(constant, rel=0.02), name
    # Leva's turbulent form as printed: 3.5 G^1.9 η^0.1 (1−ε)/(d^1.1 ρ ε³)
    G = 1000 * fast
    printed = 3.5 * G**1.9 * 1e-3**0.1 * 0.6 / (2e-3**1.1 * 1000 * 0.064)
    assert packed_beds.pressure_gradient_leva(fast, **BED) == pytest.approx(printed)
    # Gibilaro: one lonely sphere has the drag of Dalla Valle's kind, 18 ηU(1−ε)/d² within 4 % in creeping
    # flow
    lonely = {**BED, "void_fraction": 1 - 1e-6}
    assert LAWS["gibilaro"](slow, **lonely) / LAWS["obstacles"](slow, **lonely) == pytest.approx(
        17.3 / 18, rel=1e-3
    )
    # all laws for spheres agree within 35 % in a bed at Re₁ = 100
    U = 100 * 0.6 * 1e-3 / (1000 * 2e-3)
    values = [
        float(LAWS[n](U, **BED))
        for n in ("ergun", "carman", "macdonald", "erdim", "brauer", "kta", "tallmadge", "gibilaro")
    ]
    assert max(values) / min(values) < 1.35


def test_wall_and_shape():
    narrow = [float(LAWS["eisfeld_schnitzlein_spheres"](1e-5, **BED, wall_ratio=r)) for r in (0.0, 0.1, 0.3)]
    assert narrow == sorted(narrow)  # creeping flow: the wall adds friction
    turbulent = [float(LAWS["eisfeld_schnitzlein_spheres"](5.0, **BED, wall_ratio=r)) for r in (0.0, 0.3)]
    assert turbulent[1] < turbulent[0] * 1.4  # and opens the packing
    law = EisfeldSchnitzlein(diameter=0.02)
    assert float(law(0.1, *BED.values())) == pytest.approx(
        float(LAWS["eisfeld_schnitzlein_spheres"](0.1, **BED, wall_ratio=0.1))
    )
    for name in ("ergun", "nemec_levec", "carman"):
        assert LAWS[name](0.01, **BED, sphericity=0.7) > LAWS[name](0.01, **BED)
    assert LAWS["ergun"](1e-7, **BED, sphericity=0.5) / LAWS["ergun"](1e-7, **BED) == pytest.approx(
        4.0, rel=1e-3
    )


@pytest.mark.parametrize("name", [n for n in LAWS if n != "obstacles"])
def test_inverses_return_the_case(name):
    law = LAWS[name]
    for U in (1e-5, 0.03, 2.0):
        drop = inverse.pressure_drop_packed_bed(U, 0.5, **BED, sphericity=0.9, pressure_gradient=law)
        rest = {
            "fluid_density": 1000.0,
            "dynamic_viscosity": 1e-3,
            "sphericity": 0.9,
            "pressure_gradient": law,
        }
        assert inverse.superficial_velocity_packed_bed(
            drop, 0.5, **BED, sphericity=0.9, pressure_gradient=law
        ) == pytest.approx(U)
        assert inverse.particle_diameter_packed_bed(U, drop, 0.5, 0.4, **rest) == pytest.approx(2e-3)
        found = inverse.void_fraction_packed_bed(U, drop, 0.5, 2e-3, **rest)
        assert found == pytest.approx(0.4)


def test_gas_chokes_without_a_value():
    with pytest.raises(ApplicabilityError, match="chokes"):
        pressure_outlet_gas_bed(
            mass_flux=50.0,
            pressure_inlet=2e5,
            temperature=300,
            molar_mass=0.029,
            dynamic_viscosity=1.8e-5,
            length=1.0,
            particle_diameter=1e-3,
            void_fraction=0.4,
        )
    # a small drop is that of an incompressible fluid
    p2 = pressure_outlet_gas_bed(0.01, 1e5, 300.0, 0.029, 1.8e-5, 0.1, 2e-3, 0.4)
    density = 1e5 * 0.029 / (8.314462618 * 300)
    drop = 0.1 * packed_beds.pressure_gradient_ergun(0.01 / density, 2e-3, 0.4, density, 1.8e-5)
    assert 1e5 - p2 == pytest.approx(drop, rel=1e-3)


def test_bad_porosity_is_refused():
    with pytest.raises(InputError, match="void_fraction"):
        packed_beds.pressure_gradient_ergun(0.1, 2e-3, 1.4, 1000.0, 1e-3)
    notices = packed_beds.pressure_gradient_kozeny_carman.evaluate(superficial_velocity=1.0, **BED).notices
    assert [n["flag"] for n in notices] == ["extrapolated"]
