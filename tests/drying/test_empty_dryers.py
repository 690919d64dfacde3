"""A dryer that gets no solid is a duct that loses heat; what it is given by coils is not free."""

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import pytest
from tests.dust.test_fines import KINETICS, air, solid

from granum.core.errors import InputError
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
    "spray against the gas": SprayDryer(
        6.0, 3.0, GivenDrops(1e-4), KINETICS, heat_loss=LOSS, cells=8, gas_direction="counter-current"
    ),
    "fluidized bed": FluidBedDryer(1.0, 100.0, KINETICS, heat_loss=LOSS),
}


OFTEN = ("tunnel", "flash")  # a chain of cells and one that is conveyed; the others once a night


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in OFTEN else pytest.mark.long) for name in EMPTY]
)
def test_the_gas_loses_what_the_dryer_loses(name: str) -> None:
    """By hand: 5 kW off 2 kg/s of dry air with 0.01 of vapor, 1.008 and 1.87 kJ/(kg K): 2.43 K."""
    feed, gas = solid(flow=0.0), air(2.0)
    made = EMPTY[name].operate(feed=feed, gas=gas)
    lost = float(gas.enthalpy_flow) - float(made.outlets.exhaust.enthalpy_flow)
    assert lost == pytest.approx(LOSS, rel=1e-9)
    assert float(made.outlets.heat_duty) == pytest.approx(-LOSS, rel=1e-9)
    assert 350.0 - float(made.outlets.exhaust.temperature) == pytest.approx(2.43, abs=0.01)
    assert float(made.outlets.product.mass_flow) == 0.0


def test_a_drum_without_solid_is_passed_as_without_gas() -> None:
    """Friedman and Marshall by hand: 0.23 · 6/(0.04 · 3.82^0.9 · 1.5) minutes; gas had held nothing back for
    1e12 s.
    """
    rpm = 0.4 * 60.0 / (2.0 * jnp.pi)
    minutes = 0.23 * 6.0 / (0.04 * rpm**0.9 * 1.5)
    found = EMPTY["rotary, counter-current"].passage(solid(flow=0.0), air(2.0))
    assert float(found) == pytest.approx(60.0 * float(minutes), rel=1e-9)


@pytest.mark.parametrize("cells", [pytest.param(1, marks=pytest.mark.long), 6])
def test_coils_in_a_bed_are_heat_that_somebody_pays(cells: int) -> None:
    """As a loss of their size with the other sign, and in the bill; they evaporate no more than they can."""
    feed, gas = solid(), air(2.0)

    def operated(given: float, lost: float) -> Any:
        heat = {"coil_duty": jnp.asarray(given), "heat_loss": jnp.asarray(lost)}
        return FluidBedDryer(1.0, 100.0, KINETICS, cells=cells, **heat).operate(feed=feed, gas=gas)

    bare, coiled, both = operated(0.0, 0.0), operated(LOSS, 0.0), operated(LOSS, LOSS)
    given = sum(float(x) for name, x in coiled.uses.items() if name.startswith("heat_input_"))
    assert given - float(bare.uses["heat_input_hot_gas"]) == pytest.approx(LOSS, rel=1e-9)
    assert float(coiled.outlets.heat_duty) == pytest.approx(LOSS, rel=1e-9)
    more = coiled.figures.evaporation_rate - bare.figures.evaporation_rate
    assert 0.0 < float(more) * 2.3e6 < LOSS
    for one, other in zip(both.outlets.product.components, bare.outlets.product.components, strict=True):
        assert jnp.allclose(one, other, rtol=1e-9)


@pytest.mark.parametrize("name", EMPTY)
def test_a_loss_by_which_heat_comes_in_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="heat_loss"):
        type(EMPTY[name])(**(vars(EMPTY[name]) | {"heat_loss": -LOSS}))
