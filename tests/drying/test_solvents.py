"""Every dryer dries with every pair of gas and vapor, whatever the order in which the gases stand."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
import pytest
from tests.sharing.places import EXAMPLES
from tests.sharing.samples import SAMPLES

import granum as gr
from granum.core.errors import ApplicabilityError
from granum.drying.equipment.atomizers import GivenDrops
from granum.drying.equipment.belt import BeltDryer
from granum.drying.equipment.closed import ClosedDryer, CondenserCircuit, HeatPumpCircuit, SteamCircuit
from granum.drying.equipment.convective import ConvectiveDryer
from granum.drying.equipment.drum import DrumDryer
from granum.drying.equipment.flash import FlashDryer
from granum.drying.equipment.fluid_bed import FluidBedDryer
from granum.drying.equipment.freeze import FreezeDryer
from granum.drying.equipment.paddle import PaddleDryer
from granum.drying.equipment.rotary import RotaryDryer
from granum.drying.equipment.silo import SiloDryer
from granum.drying.equipment.spray import SprayDryer
from granum.drying.equipment.tray import TrayDryer
from granum.drying.equipment.tunnel import TunnelDryer
from granum.drying.equipment.well_mixed import WellMixedDryer
from granum.drying.gas_solid.dryer import PLAIN
from granum.drying.gas_solid.kinetics import SurfaceKinetics
from granum.humid_gas import state
from granum.streams.atmosphere import flammable
from granum.streams.equilibrium import HumidMixture
from granum.streams.from_materials import mixture_of
from granum.streams.stream import Stream, empty

WET = SurfaceKinetics(0.05)
DRYERS = {
    "bed": FluidBedDryer(0.5, 60.0, WET, cells=2),
    "tunnel": TunnelDryer(7200.0, 0.5, 0.5, 5.0, WET, cells=4),
    "balance": ConvectiveDryer(temperature_inlet=353.15, moisture_outlet=0.05, effectiveness=0.5),
    "mixed": WellMixedDryer(600.0, 0.5),
    "tray": TrayDryer(353.15, 1.5, 10.0, 0.02, 0.1),
    "drum": DrumDryer(1.0, 2.0, 0.5, 4e5),
    "paddle": PaddleDryer(393.0, 0.01, 2e4, 3e-4, 1.0, 0.6),
    "heat pump": ClosedDryer(HeatPumpCircuit(0.6, 265.0), 333.0, 0.01),
    "condenser": ClosedDryer(CondenserCircuit(0.6, 265.0), 333.0, 0.01),
    "vapor": ClosedDryer(SteamCircuit(393.0), 423.0, 0.01),
}
LONG = {  # each compiles for a quarter of a minute
    "rotary": RotaryDryer(6.0, 0.8, WET, 0.04, cells=8),
    "belt": BeltDryer(1.0, 0.05, 500.0, WET, zone_count=1, layers=6, steps=30),
    "silo": SiloDryer(1.0, 0.3, 650.0, WET, cooling_share=0.2, layers=6, steps=20),
    "flash": FlashDryer(10.0, 0.2, WET, feed_velocity=1.0, cells=20),
    "spray": SprayDryer(4.0, 2.0, GivenDrops(8e-5, 20.0), WET, dry_density=1200.0, cells=20),
}
DRYERS |= LONG if SAMPLES else {}
BOTH = ("bed", "balance", "tray", "drum", "condenser")  # tried in both orders, which compiles them twice


def duty(gases: list[str], solvent: str, **dry: float) -> dict[str, Stream]:
    """Calcite with a quarter of its mass of solvent, and warm gas."""
    m = mixture_of([solvent], ["calcite"], gases, [1e-4, 2e-4, 4e-4])
    nothing = empty(m, 293.15)
    carried = jnp.array([dry.get(name, 0.0) for name in gases])
    return {
        "feed": nothing.replace(solid=jnp.array([[0.05, 0.05]]), liquid=jnp.array([0.025])),
        "gas": nothing.replace(gas=carried, temperature=jnp.asarray(353.15)),
        "cooling": nothing.replace(gas=0.3 * carried),
    }


_operated = eqx.filter_jit(lambda unit, inlets: unit.operate(**inlets), compiler_options=PLAIN)


def taken_by(unit, inlets):
    """Of a duty, the streams that this dryer has inlets for."""
    return {name: inlets[name] for name in type(unit).inlet_names()}


def operated(unit, inlets):
    return _operated(unit, taken_by(unit, inlets))


def closures(made, inlets) -> tuple[float, float]:
    """What is missing of mass and energy, relative."""
    into = [inlets[name] for name in inlets]
    out = [x for x in made.outlets if isinstance(x, Stream)]
    added = sum(float(getattr(made.outlets, name, 0.0)) for name in ("heat_duty", "shaft_power"))
    mass = sum(float(s.mass_flow) for s in out) - sum(float(s.mass_flow) for s in into)
    heats = [float(s.enthalpy_flow) for s in out] + [-float(s.enthalpy_flow) for s in into] + [-added]
    return mass / sum(float(s.mass_flow) for s in into), sum(heats) / sum(abs(h) for h in heats)


@pytest.mark.parametrize("name", DRYERS)
def test_ethanol_in_nitrogen_in_either_order(name):
    """Mass and energy close, no figure depends on the order of the gases, and a dryer heated by its walls
    boils at 78.3 °C at 1 atm (CRC Handbook).
    """
    unit, found = DRYERS[name], []
    orders = (["ethanol", "nitrogen"], ["nitrogen", "ethanol"])
    for gases in orders if name in BOTH else orders[:1]:
        inlets = taken_by(unit, duty(gases, "ethanol", nitrogen=0.4))
        made = operated(unit, inlets)
        assert closures(made, inlets) == pytest.approx((0.0, 0.0), abs=1e-9)
        found.append({k: float(v) for k, v in made.figures._asdict().items() if v is not None})
        assert all(np.isfinite(v) for v in found[-1].values())
        assert made.outlets.product.moisture_dry_basis < 0.25
    assert found[0] == pytest.approx(found[-1], rel=1e-9, abs=1e-12)
    if name == "drum":
        assert found[0]["boiling_temperature"] == pytest.approx(273.15 + 78.3, abs=0.3)


def test_water_before_air():
    """A mixture that names the vapor first dried nothing, and said so with a closed balance."""
    figures = [
        operated(DRYERS["balance"], duty(g, "water", **{"dry air": 1.5})).figures
        for g in (["dry air", "water"], ["water", "dry air"])
    ]
    assert float(figures[0].humidity_ratio_outlet) == pytest.approx(0.02 / 1.5, rel=1e-9)
    assert [float(v) for v in figures[0]] == pytest.approx([float(v) for v in figures[1]], rel=1e-9)


def test_exhaust_of_ethanol_is_saturated_by_ethanol():
    """Ethanol has 7.87 kPa at 25 °C (CRC Handbook, vapor pressure); water's 3.17 kPa would say 2.5 times as
    much.
    """
    unit = ConvectiveDryer(temperature_inlet=353.15, temperature_outlet=298.15)
    made = operated(unit, duty(["nitrogen", "ethanol"], "ethanol", nitrogen=0.4))
    gas = made.outlets.exhaust.gas
    fraction = float(gas[1] / 46.07 / (gas[1] / 46.07 + gas[0] / 28.01))
    assert float(made.figures.relative_humidity_outlet) == pytest.approx(
        fraction * 101325.0 / 7870.0, rel=0.01
    )


def test_surface_is_at_the_wet_bulb_of_its_pair():
    """What the trays of solvent come to is the wet bulb of the psychrometric relations, which are written on
    the pair alone; only the drop of the heat capacity with composition parts them.
    """
    made = operated(DRYERS["tray"], duty(["nitrogen", "ethanol"], "ethanol", nitrogen=4.0))
    film = state(
        temperature=353.15, humidity_ratio=float(made.figures.humidity_ratio), pair="nitrogen_ethanol"
    ).wet_bulb_temperature
    assert float(made.figures.surface_temperature) == pytest.approx(float(film), abs=1.5)


def test_vapor_in_air_and_oxygen_in_nitrogen():
    """3.3 % of ethanol in air burns (NFPA 325), 10.5 % of oxygen under nitrogen does not (NFPA 69): checks
    are a quarter and 60 % of these.
    """
    inlets = duty(["dry air", "ethanol"], "ethanol", **{"dry air": 2.9})
    moles = 2.9 / 0.0289655 / (1.0 / 0.033 - 1.0)
    gas = inlets["gas"].replace(gas=jnp.array([2.9, moles * 0.04606844]))
    assert float(flammable(gas)["lean"]) == pytest.approx(1.0, rel=1e-3)
    guarded = duty(["nitrogen", "ethanol", "dry air"], "ethanol", nitrogen=1.0, **{"dry air": 1.0})["gas"]
    half = 0.2095 * (1.0 / 28.96) / (1.0 / 28.96 + 1.0 / 28.0134)
    assert float(flammable(guarded)["inert"]) == pytest.approx(half / 0.105, rel=1e-3)
    assert flammable(duty(["dry air", "water"], "water", **{"dry air": 1.0})["gas"]) == {}


def test_what_no_pair_can_do_is_refused():
    steam = duty(["water"], "water", water=0.4)
    with pytest.raises(ApplicabilityError, match="carries the vapor of water"):
        DRYERS["mixed"].operate(**taken_by(DRYERS["mixed"], steam))
    ethanol = duty(["nitrogen", "ethanol"], "ethanol", nitrogen=0.4)["feed"]
    with pytest.raises(ApplicabilityError, match="sublimes ice only"):
        FreezeDryer(10.0, 273.0, 3.8e-4, 3.1e-4, 3e-6, 10.0, 0.5, 5e4, 1e7, 200.0).operate(feed=ethanol)
    with pytest.raises(ApplicabilityError, match="known for water only"):
        ClosedDryer(SteamCircuit(393.0, 2e5), 423.0, 0.01).operate(feed=ethanol)


def test_steam_alone_condenses_at_its_boiling_point():
    """A vapor without carrier: steam and as much water, both of 87 °C, come to the boiling point; the vapor
    that warms them there is 1.5 % of them, by heat capacities of 1.9 and 4.2 kJ/(kg K) over 13.1 K and 2
    257 kJ/kg.
    """
    m = mixture_of(["water"], [], ["water"], [1e-4, 2e-4])
    both = empty(m, 360.0).replace(gas=jnp.array([0.5]), liquid=jnp.array([0.5]))
    found = HumidMixture(m, alone=True).at_own_enthalpy(both)
    assert float(found.temperature) == pytest.approx(373.12, abs=0.05)
    assert float(found.liquid[0]) == pytest.approx(0.5 + 0.5 * (1.9 + 4.2) * 13.1 / 2257.0, abs=1e-3)
    assert float(found.enthalpy_flow) == pytest.approx(float(both.enthalpy_flow), rel=1e-9)


def test_solvent_example_closes_its_loop():
    """All ethanol leaves with the granules, the condensate and the vent; the purge holds the air of the loop
    at that of what comes in, by mass and without ethanol.
    """
    run = gr.read(EXAMPLES / "dryers" / "solvent.toml").solve()
    s = run.streams
    assert float(s["ethanol"].liquid[0] + s["dry_granules"].liquid[0] + s["vent"].gas[1]) == pytest.approx(
        40.0 / 3600.0, rel=1e-9
    )
    assert float(s["exhaust"].gas[2] / s["exhaust"].gas[0]) == pytest.approx(1.0 / 9.0, rel=1e-6)
    names = [check.name for check in run.units["dryer"].checks]
    assert any("limiting oxygen" in name for name in names)
    assert any("explosive limit" in name for name in names)
