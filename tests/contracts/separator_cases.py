"""Settlers, fluidized beds, cyclones and separators of two liquids, each from a random stream and three
numbers.
"""

from __future__ import annotations

import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case

from granum.centrifuges.equipment.decanters import ScrollDecanter, ThreePhaseDecanter
from granum.centrifuges.equipment.liquids import DiscSeparator, NozzleSeparator, TubularSeparator
from granum.centrifuges.equipment.purifiers import DiscPurifier
from granum.conveying.equipment.hopper import Hopper
from granum.conveying.equipment.pneumatic import PneumaticConveyor
from granum.conveying.equipment.slurry import SlurryPipeline
from granum.conveying.equipment.thick_slurry import ThickSlurryPipeline
from granum.cyclones.equipment.gas import GasCyclone
from granum.cyclones.equipment.liquid import Hydrocyclone
from granum.dust.equipment.air_filter import AirFilter
from granum.dust.equipment.bag_filter import BagFilter
from granum.dust.equipment.hood import ExtractionHood
from granum.dust.equipment.mesh_pad import MeshPad
from granum.dust.equipment.precipitator import ElectrostaticPrecipitator
from granum.dust.equipment.settling_chamber import SettlingChamber
from granum.fluidization.equipment.bed import FluidizedBed
from granum.fluidization.equipment.liquid import LiquidFluidizedBed
from granum.settling.equipment.api_separator import ApiSeparator
from granum.settling.equipment.clarifiers import (
    CircularClarifier,
    Clarifier,
    GritChamber,
    Lamella,
    RectangularClarifier,
)
from granum.settling.equipment.flocculator import Flocculator
from granum.settling.equipment.thickener import Thickener
from granum.settling.velocities import Vesilind
from granum.streams.equipment.movers import Fan, Pump
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty

CLASSES = 12
SAND = Species("sand", (("sand", 1.0),), (2650.0,), (800.0,))
SLURRY = Mixture(
    solids=(SAND, Species("oil", (("oil", 1.0),), (880.0,), (2000.0,))),
    liquids=(Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),),
    gases=(),
    size_edges=tuple(np.geomspace(2e-6, 5e-4, CLASSES + 1)),
    liquid_viscosity=lambda w, T: 1e-3,
)
MILK = Mixture(  # fine, the light species first
    solids=SLURRY.solids[::-1],
    liquids=SLURRY.liquids,
    gases=(),
    size_edges=tuple(np.geomspace(2e-7, 1e-4, CLASSES + 1)),
    liquid_viscosity=lambda w, T: 1e-3,
)
DUST = Mixture(
    solids=(SAND,),
    liquids=(),
    gases=(Species("air", (("air", 1.0),), (1.2,), (1005.0,), molar_mass=0.02896),),
    size_edges=tuple(np.geomspace(5e-7, 1e-3, CLASSES + 1)),
    gas_viscosity=lambda _w, T: 1.8e-5,
)


def slurry(x, mean, spread) -> Stream:
    """1 to 1000 kg/s of water with 0.01 to 300 g/kg of sand of any width, and a little oil."""
    water, sand = 10.0 ** (3.0 * x[0]), 10.0 ** (-5.0 + 4.5 * x[1])
    parts = jnp.exp(-0.5 * ((jnp.linspace(0.0, 1.0, CLASSES) - mean) / (0.02 + spread)) ** 2) + 1e-12
    parts = parts / jnp.sum(parts)
    return empty(SLURRY, 280.0 + 40.0 * x[2]).replace(
        solid=water * jnp.stack([sand * parts, 1e-3 * x[3] * parts]), liquid=jnp.stack([water])
    )


def emulsion(x, mean, spread) -> Stream:
    """1 kg/h to 100 t/h of water with 1 mg/kg to 1 kg/kg of drops and of sand, fine or wide."""
    water, oil = 10.0 ** (-3.5 + 5.0 * x[0]), 10.0 ** (-6.0 + 6.0 * x[1])
    parts = jnp.exp(-0.5 * ((jnp.linspace(0.0, 1.0, CLASSES) - mean) / (0.02 + spread)) ** 2) + 1e-12
    parts = parts / jnp.sum(parts)
    sand = 10.0 ** (-6.0 + 5.5 * x[3])
    return empty(MILK, 280.0 + 60.0 * x[2]).replace(
        solid=water * jnp.stack([oil * parts, sand * parts[::-1]]), liquid=jnp.stack([water])
    )


def oily(x, mean, spread) -> Stream:
    """The same with far more oil than water."""
    made = emulsion(x, mean, spread)
    return made.replace(liquid=0.02 * (0.1 + x[1]) * made.liquid)


def dusty(x, mean, spread) -> Stream:
    """0.1 to 30 kg/s of gas with 1 g/kg to 3 kg/kg of dust."""
    gas, dust = 10.0 ** (-1.0 + 2.5 * x[0]), 10.0 ** (-3.0 + 3.5 * x[1])
    parts = jnp.exp(-0.5 * ((jnp.linspace(0.0, 1.0, CLASSES) - mean) / (0.02 + spread)) ** 2) + 1e-12
    return empty(DUST, 280.0 + 300.0 * x[2]).replace(
        solid=gas * dust * (parts / jnp.sum(parts))[None, :],
        gas=jnp.stack([gas]),
        pressure=jnp.asarray(1.0e5) + 2e5 * x[3],
    )


def blown(x, mean, spread) -> dict[str, Stream]:
    """Gas at 1 to 3 bar, and one to ten times its mass of solid at the atmosphere."""
    made = dusty(x, mean, spread)
    gas = made.part(0.0, 0.0, 1.0)
    solid = made.part(1.0, 0.0, 0.0)
    share = gas.gas_flow / solid.solid_flow
    return {
        "feed": solid.part((0.2 + 5.0 * x[1]) * share).replace(pressure=jnp.asarray(1.01325e5)),
        "gas": gas.replace(pressure=1.2e5 + 2e5 * x[3], temperature=300.0 + 40.0 * x[2]),
    }


def hooded(x, mean, spread) -> dict[str, Stream]:
    """Solid under a hood, and the air drawn off."""
    made = dusty(x, mean, spread)
    return {"feed": made.part(1.0, 0.0, 0.0), "air": made.part(0.0, 0.0, 1.0)}


def bowl(a, b) -> tuple:
    """Inner and outer radius and speed of a bowl."""
    radius = 0.05 + 0.3 * a
    return (0.3 + 0.4 * b) * radius, radius, jnp.sqrt(10.0 ** (3.0 + 1.2 * b) * 9.81 / radius)


def dams(a, b, c) -> dict:
    """Weirs, the heavy one from too far in to too far out."""
    inner = bowl(a, b)[0]
    return {"radius_light": 0.95 * inner, "radius_heavy": inner * (0.85 + 0.35 * c)}


# each from a random stream and three numbers from 0 to 1; the section follows the flow over two or three
# decades of loading
UNITS = {
    "clarifier": (
        slurry,
        lambda f, a, b, c: Clarifier(f.slurry_volume_flow / 10.0 ** (-4.5 + 2.5 * a), 20.0 + 300.0 * b),
    ),
    "circular": (
        slurry,
        lambda f, a, b, c: CircularClarifier(
            jnp.sqrt(f.slurry_volume_flow / 10.0 ** (-4.5 + 2.5 * a)), 2.0 + 3.0 * c, 20.0 + 300.0 * b
        ),
    ),
    "rectangular": (
        slurry,
        lambda f, a, b, c: RectangularClarifier(
            jnp.sqrt(5.0 * f.slurry_volume_flow / 10.0 ** (-4.5 + 2.5 * a)),
            jnp.sqrt(0.2 * f.slurry_volume_flow / 10.0 ** (-4.5 + 2.5 * a)),
            2.0 + 3.0 * c,
            20.0 + 300.0 * b,
        ),
    ),
    **{
        f"lamella {way}": (
            slurry,
            lambda f, a, b, c, way=way: Lamella(
                f.slurry_volume_flow / 10.0 ** (-4.0 + 2.0 * a),
                1.0 + 2.0 * b,
                1.25,
                0.03 + 0.07 * c,
                20.0 + 300.0 * b,
                0.8 + 0.5 * c,
                flow_direction=way,
            ),
        )
        for way in ("countercurrent", "cocurrent", "crosscurrent")
    },
    "flocculator": (
        slurry,
        lambda f, a, b, c: Flocculator(
            f.slurry_volume_flow * 10.0 ** (2.0 + 2.0 * a),
            100.0 * b,
            tank_number=1.0 + 5.0 * c,
            aggregation_constant=10.0 ** (-5.0 + 2.0 * c),
        ),
    ),
    "grit": (
        slurry,
        lambda f, a, b, c: GritChamber(
            5.0 + 20.0 * a, 0.5 + 2.0 * b, f.slurry_volume_flow / (0.05 + 0.5 * c), 200.0 + 500.0 * a
        ),
    ),
    "thickener": (
        slurry,
        lambda f, a, b, c: Thickener(
            f.slurry_volume_flow / 10.0 ** (-4.5 + 2.5 * a), 20.0 + 300.0 * b, Vesilind(1e-3, 0.01 + 0.1 * c)
        ),
    ),
    "api": (
        slurry,
        lambda f, a, b, c: ApiSeparator(
            10.0 + 30.0 * a, 2.0 + 4.0 * b, f.slurry_volume_flow / 10.0 ** (-2.5 + c)
        ),
    ),
    "hydrocyclone": (
        slurry,
        lambda f, a, b, c: Hydrocyclone(
            0.05 + 0.4 * a,
            (0.05 + 0.4 * a) * (0.06 + 0.24 * b),
            jnp.maximum(f.slurry_volume_flow / (0.05 + 0.4 * a) ** 2 / (1.0 + 2.0 * c), 1.0),
        ),
    ),
    "disc separator": (
        emulsion,
        lambda f, a, b, c: DiscSeparator(
            *bowl(a, b), disc_number=20.0 + 150.0 * c, light_solids_fraction=0.2 + 0.75 * b, **dams(a, b, c)
        ),
    ),
    "nozzle separator": (
        emulsion,
        lambda f, a, b, c: NozzleSeparator(
            *bowl(a, b),
            disc_number=50.0,
            nozzle_number=4.0 + 20.0 * a,
            nozzle_diameter=5e-4 + 2e-3 * b,
            **dams(a, b, c),
        ),
    ),
    "tubular separator": (
        emulsion,
        lambda f, a, b, c: TubularSeparator(*bowl(a, b), bowl_length=0.3 + c, **dams(a, b, c)),
    ),
    "purifier": (
        oily,
        lambda f, a, b, c: DiscPurifier(
            *bowl(a, b),
            disc_number=20.0 + 150.0 * c,
            light_viscosity=10.0 ** (-3.0 + 2.0 * a),
            droplet_diameter=10.0 ** (-6.0 + 2.0 * b),
            **dams(a, b, c),
        ),
    ),
    "scroll decanter": (
        emulsion,
        lambda f, a, b, c: ScrollDecanter(
            *bowl(a, b),
            bowl_length=0.5 + c,
            beach_length=0.3 * a,
            dry_beach_length=0.3 * c,
            beach_angle=0.4 * b,
            differential_speed=0.2 + 5.0 * c,
        ),
    ),
    "three-phase decanter": (
        emulsion,
        lambda f, a, b, c: ThreePhaseDecanter(
            *bowl(a, b),
            bowl_length=0.5 + c,
            beach_length=0.3 * a,
            dry_beach_length=0.3 * c,
            beach_angle=0.4 * b,
            differential_speed=0.2 + 5.0 * c,
            radius_heavy=bowl(a, b)[0] * (0.9 + 0.2 * c),
        ),
    ),
    "gas cyclone": (dusty, lambda f, a, b, c: GasCyclone(jnp.sqrt(f.gas_volume_flow / (0.5 + 2.0 * a)))),
    "air filter": (
        dusty,
        lambda f, a, b, c: AirFilter(
            f.gas_volume_flow / (0.01 + 0.4 * a), 10.0 ** (-6.5 + 1.5 * b), 0.01 + 0.1 * c, 5e-4 + 5e-3 * a
        ),
    ),
    "bag filter": (
        dusty,
        lambda f, a, b, c: BagFilter(
            f.gas_volume_flow / (0.005 + 0.06 * a), 60.0 + 1800.0 * b, 10.0 ** (4.0 + c)
        ),
    ),
    "precipitator": (
        dusty,
        lambda f, a, b, c: ElectrostaticPrecipitator(
            f.gas_volume_flow * (5.0 + 150.0 * a),
            f.gas_volume_flow / (0.5 + 2.0 * b),
            1e5 + 4e5 * c,
        ),
    ),
    "settling chamber": (
        dusty,
        lambda f, a, b, c: SettlingChamber(
            2.0 + 10.0 * a, 1.0 + 3.0 * b, f.gas_volume_flow / (0.2 + 2.0 * c)
        ),
    ),
    "mesh pad": (
        dusty,
        lambda f, a, b, c: MeshPad(
            f.gas_volume_flow / (0.5 + 4.0 * a), 10.0 ** (-6.0 + 2.0 * b), 0.05 + 0.25 * c
        ),
    ),
    "extraction hood": (
        hooded,
        lambda f, a, b, c: ExtractionHood(
            f["air"].gas_volume_flow / (0.5 + 2.0 * a), 10.0 ** (-4.0 + 2.0 * b)
        ),
    ),
    "pneumatic conveyor": (
        blown,
        lambda f, a, b, c: PneumaticConveyor(
            jnp.sqrt(f["gas"].gas_volume_flow / (0.785 * (12.0 + 15.0 * a))), 40.0 * b, 10.0 * c, 4.0 * c
        ),
    ),
    "hopper": (
        dusty,
        lambda f, a, b, c: Hopper(
            1.0 + 4.0 * a,
            8.0 * b,
            0.3 + 0.5 * a,
            0.15 + 0.9 * c,
            400.0 + 400.0 * b,
            0.75,
            0.35,
            900.0 * c,
            0.3 * a,
        ),
    ),
    "thick slurry pipeline": (
        slurry,
        lambda f, a, b, c: ThickSlurryPipeline(
            jnp.sqrt(f.slurry_volume_flow / (0.785 * (0.2 + 4.0 * a))),
            500.0 * b,
            10.0 ** (-2.0 + 2.0 * c),
            yield_stress=50.0 * a * b,
        ),
    ),
    "slurry pipeline": (
        slurry,
        lambda f, a, b, c: SlurryPipeline(
            jnp.sqrt(f.slurry_volume_flow / (0.785 * (1.0 + 4.0 * a))), 500.0 * b, 20.0 * c
        ),
    ),
    "fan": (dusty, lambda f, a, b, c: Fan(10.0 ** (2.0 + 2.0 * a), 0.4 + 0.4 * b, 0.8 + 0.15 * c)),
    "pump": (slurry, lambda f, a, b, c: Pump(10.0 ** (4.0 + 2.0 * a), 0.4 + 0.4 * b, 0.8 + 0.15 * c)),
    "fluidized bed": (
        dusty,
        lambda f, a, b, c: FluidizedBed(
            f.gas_volume_flow / 10.0 ** (-3.0 + 3.5 * a), 10.0 ** (1.0 + 3.0 * b), 0.4 + 0.15 * c
        ),
    ),
    "liquid bed": (
        slurry,
        lambda f, a, b, c: LiquidFluidizedBed(
            f.slurry_volume_flow / 10.0 ** (-4.0 + 3.0 * a),
            10.0 ** (4.0 * b),
            10.0 ** (-4.0 + 1.5 * c),
            2500.0,
        ),
    ),
}


def named(made) -> dict[str, Stream]:
    """Inlets by name."""
    return made if isinstance(made, dict) else {"feed": made}


def case_of(name: str) -> Case:
    """One of them as a case for ``unit_search``."""
    stream_of, build = UNITS[name]
    return Case(
        {dusty: DUST, blown: DUST, slurry: SLURRY}.get(stream_of, MILK),
        lambda mixture, x: named(stream_of(x[:4], x[4], x[5])),
        lambda feeds, u: build(feeds["feed"] if len(feeds) == 1 else feeds, u[0], u[1], u[2]),
    )
