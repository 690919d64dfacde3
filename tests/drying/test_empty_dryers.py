"""A dryer that gets no solid is a duct that loses heat."""

from __future__ import annotations

from typing import Any

import pytest
from tests.dust.test_fines import KINETICS, air, solid

from granum.drying.equipment.atomizers import GivenDrops
from granum.drying.equipment.flash import FlashDryer
from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.spray import SprayDryer
from granum.drying.equipment.tunnel import TunnelDryer

LOSS = 5e3
EMPTY: dict[str, Any] = {
    "rotary, counter-current": RotaryDryer(6.0, 1.5, KINETICS, heat_loss=LOSS, cells=8),
    "rotary, co-current": RotaryDryer(
        6.0, 1.5, KINETICS, heat_loss=LOSS, cells=8, gas_direction="co-current"
    ),
    "tunnel": TunnelDryer(3600.0, 0.5, 1.0, 10.0, KINETICS, heat_loss=LOSS, cells=8),
    "flash": FlashDryer(20.0, 0.5, KINETICS, heat_loss=LOSS, cells=8),
    "spray": SprayDryer(6.0, 3.0, GivenDrops(1e-4), KINETICS, heat_loss=LOSS, cells=8),
    "fluidized bed": FluidBedDryer(1.0, 100.0, KINETICS, heat_loss=LOSS),
}


@pytest.mark.parametrize("name", EMPTY)
def test_the_gas_loses_what_the_dryer_loses(name: str) -> None:
    """By hand: 5 kW off 2 kg/s of dry air with 0.01 of vapor, 1.008 and 1.87 kJ/(kg K): 2.43 K."""
    feed, gas = solid(flow=0.0), air(2.0)
    made = EMPTY[name].operate(feed=feed, gas=gas)
    lost = float(gas.enthalpy_flow) - float(made.outlets.exhaust.enthalpy_flow)
    assert lost == pytest.approx(LOSS, rel=1e-9)
    assert float(made.outlets.heat_duty) == pytest.approx(-LOSS, rel=1e-9)
    assert 350.0 - float(made.outlets.exhaust.temperature) == pytest.approx(2.43, abs=0.01)
    assert float(made.outlets.product.mass_flow) == 0.0
