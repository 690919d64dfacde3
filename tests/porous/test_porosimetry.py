"""Mercury porosimetry: Washburn's pore, known parameters come back."""

import numpy as np
import pytest
from scipy.stats import norm

from granum.core.errors import InputError
from granum.porous import MercuryPorosimetry, pore_diameter_washburn


def test_pressure_times_diameter():
    # 1470 kPa µm for 480 mN/m and 140° (encyclopedia article on porosimetry, opened); an apparatus to
    # 60 000 psi reads pores down to 0.003 µm with the angle of 130° and 485 mN/m of its maker (opened)
    assert pore_diameter_washburn("1 kPa") == pytest.approx(1470e-6, rel=1e-3)
    least = pore_diameter_washburn("60000 psi", surface_tension="485 dyn/cm", wetting_angle="130 degree")
    assert least == pytest.approx(0.003e-6, rel=0.01)
    with pytest.raises(InputError, match="wetting_angle"):
        pore_diameter_washburn("1 bar", wetting_angle="60 degree")


def test_pores_come_back_and_porosity_follows():
    p = np.geomspace(1e6, 1e8, 10)
    diameter = np.asarray(pore_diameter_washburn(p))
    v = 4e-4 * norm.cdf(np.log(150e-9 / diameter) / np.log(1.6))
    found = MercuryPorosimetry(intrusion_pressure=p, intruded_volume=v, solid_density="2.5 g/cm3").fit()
    assert found["pore_volume"].value == pytest.approx(4e-4, rel=1e-6)
    assert found["pore_diameter"].value == pytest.approx(150e-9, rel=1e-6)
    assert found["geometric_standard_deviation"].value == pytest.approx(1.6, rel=1e-6)
    assert found["void_fraction"].value == pytest.approx(0.5, rel=1e-6)
    with pytest.raises(InputError, match="nothing to fit"):
        MercuryPorosimetry(intrusion_pressure=p, intruded_volume=0.0 * p).fit()
