"""The units that random searches try, each from a row of numbers from 0 to 1: its feeds, then itself."""

# ruff: noqa: E731

from __future__ import annotations

from typing import Any

import jax.numpy as jnp
import numpy as np
from tests.contracts.unit_search import Case, shares

from granum.centrifuges.equipment.decanters import ScrollDecanter
from granum.centrifuges.equipment.filtering import Peeler, Pusher
from granum.centrifuges.equipment.screens import (
    ScrollScreen,
    SlidingCakeScreen,
    TumblingScreen,
    VibratingScreen,
)
from granum.centrifuges.equipment.settling import DiscStack, SolidBasket, TubularBowl
from granum.comminution.breakage import AustinBreakage, AustinSelection, BroadbentCallcottBreakage
from granum.comminution.equipment.mills import BallMill, BondMill, ConeCrusher
from granum.comminution.equipment.screens import DoubleDeckScreen, Screen, TripleDeckScreen
from granum.comminution.equipment.vibrating_screen import VibratingScreen as SizedScreen
from granum.comminution.population import LargeAndTwoSmall, PlugFlow, TanksInSeries
from granum.crystallization.formulas.agglomeration import ConstantKernel, SumKernel
from granum.filtration.equipment.batch import (
    CandleFilter,
    ChamberPress,
    MembranePress,
    Nutsche,
    PlateAndFramePress,
    PressureLeafFilter,
)
from granum.filtration.equipment.cartridge import CartridgeFilter
from granum.filtration.equipment.continuous import (
    HorizontalBeltFilter,
    PrecoatDrum,
    RotaryDiscFilter,
    RotaryVacuumDrum,
)
from granum.filtration.equipment.deep_bed import DeepBedFilter
from granum.filtration.equipment.gravity import GravityFilter
from granum.filtration.equipment.high_presses import TowerPress, TubePress
from granum.filtration.equipment.thickening import ThickeningFilter
from granum.particles.partition import (
    BypassedPartition,
    IdealPartition,
    LogisticPartition,
    MolerusHoffmannPartition,
    RosinRammlerPartition,
    WhitenPartition,
)
from granum.settling.compression import PowerStress
from granum.settling.equipment.clarifier_thickener import ClarifierThickener
from granum.settling.equipment.decantation import CountercurrentDecantation
from granum.settling.equipment.secondary_settler import SecondarySettler
from granum.settling.velocities import Takacs, Vesilind
from granum.streams.equipment.agglomerator import Agglomerator
from granum.streams.equipment.basics import Heater, Mixer, Splitter, StirredTank
from granum.streams.mixture import Mixture, Species
from granum.streams.stream import Stream, empty


def slurries(classes: int, smallest: float, largest: float) -> Mixture:
    """Two solids in water, ethanol or both, and air."""
    return Mixture(
        solids=(
            Species("sand", (("sand", 1.0),), (2650.0,), (800.0,)),
            Species("coal", (("coal", 1.0),), (1400.0,), (1200.0,)),
        ),
        liquids=(
            Species("water", (("water", 1.0),), (1000.0,), (4180.0,)),
            Species("ethanol", (("ethanol", 1.0),), (806.0, -0.85), (2300.0, 8.0)),
        ),
        gases=(
            Species("air", (("air", 1.0),), (1.2,), (1005.0,), molar_mass=0.02896),
            Species("argon", (("argon", 1.0),), (1.7,), (520.0,), molar_mass=0.03995),
        ),
        size_edges=tuple(np.geomspace(smallest, largest, classes + 1)),
        liquid_viscosity=lambda w, T: (
            1e-3 * jnp.exp(-0.02 * (T - 293.15)) * (1.0 + 1.5 * w[1] * w[0] + 0.2 * w[1])
        ),
        gas_viscosity=lambda _w, T: 1.8e-5 * (T / 293.15) ** 0.7,
    )


def slurry(mixture: Mixture, x: Any, solids: tuple[float, float] = (-3.0, 0.3)) -> Stream:
    """1 g/s to 100 kg/s of liquid with solids over liquid between powers of ten, a tenth of them or none of
    the second kind, and some gas.
    """
    liquid = 10.0 ** (-3.0 + 5.0 * x[0])
    solid = liquid * 10.0 ** (solids[0] + (solids[1] - solids[0]) * x[1])
    classes = len(mixture.sizes)
    second, ethanol = 0.3 * x[3], jnp.where(x[6] > 0.5, 2.0 * x[6] - 1.0, 0.0)
    return empty(mixture, 280.0 + 60.0 * x[2]).replace(
        solid=solid
        * jnp.stack([(1.0 - second) * shares(x[4], x[5], classes), second * shares(x[5], x[4], classes)]),
        liquid=liquid * jnp.stack([1.0 - ethanol, ethanol]),
        gas=1e-3 * liquid * jnp.stack([x[7], 1.0 - x[7]]),
    )


def with_wash(mixture: Mixture, x: Any) -> dict[str, Stream]:
    """A slurry, and liquid to wash its cake: up to some five void volumes."""
    feed = slurry(mixture, x)
    wash = feed.solid_flow * 10.0 ** (-2.0 + 2.5 * x[7])
    return {
        "feed": feed,
        "wash": empty(mixture, 290.0 + 40.0 * x[6]).replace(liquid=wash * jnp.stack([0.9, 0.1])),
    }


def alone(mixture: Mixture, x: Any) -> dict[str, Stream]:
    return {"feed": slurry(mixture, x)}


def thin(mixture: Mixture, x: Any) -> dict[str, Stream]:
    return {"feed": slurry(mixture, x, (-6.0, -1.0))}


def two(mixture: Mixture, x: Any) -> dict[str, Stream]:
    return {"feed": slurry(mixture, x), "other": slurry(mixture, x[::-1]).replace(pressure=2e5)}


def mills(classes: int) -> dict[str, Case]:
    rocks = slurries(classes, 1e-5, 4e-3)
    wide = slurries(classes, 1e-4, 0.2)
    selection = lambda u: AustinSelection(10.0 ** (-4.0 + 3.0 * u[1]), 0.5 + u[2], 1e-3 + 3e-3 * u[3], 3.0)
    breakage = lambda u: AustinBreakage(0.2 + 0.6 * u[4], 0.5 + u[5], 3.0 + 2.0 * u[1])
    holdup = lambda f, u: f["feed"].solid_flow * 10.0 ** (1.0 + 3.0 * u[0])
    decks = {
        "logistic": lambda d, u: LogisticPartition(d, 1.0 + 9.0 * u[1]),
        "rosin-rammler": lambda d, u: RosinRammlerPartition(d, 1.0 + 9.0 * u[1]),
        "whiten": lambda d, u: WhitenPartition(d, 0.5 + 9.0 * u[1], u[2], 0.3 * u[3]),
        "molerus": lambda d, u: MolerusHoffmannPartition(d, 0.5 + 9.0 * u[1]),
        "ideal": lambda d, u: IdealPartition(d),
        "bypassed": lambda d, u: BypassedPartition(LogisticPartition(d, 1.0 + 9.0 * u[1]), 0.5 * u[2]),
    }
    cut = lambda u: 10.0 ** (-5.5 + 3.5 * u[0])
    return {
        **{
            f"mill {name}": Case(
                rocks,
                alone,
                lambda f, u, law=law, way=way: BallMill(
                    selection(u), breakage(u), holdup(f, u), law, 1e5 * u[0] * f["feed"].mass_flow, way
                ),
            )
            for name, law, way in (
                ("mixed", TanksInSeries(1), "continuous"),
                ("tanks", TanksInSeries(3), "continuous"),
                ("plug", PlugFlow(), "continuous"),
                ("shell", LargeAndTwoSmall(0.7), "continuous"),
            )
        },
        "bond": Case(
            wide,
            alone,
            lambda f, u: BondMill(
                f["feed"].solid_flow * 10.0 ** (2.0 + 3.5 * u[0]), 3e4 + 5e4 * u[1], 0.9 + u[2]
            ),
        ),
        "cone": Case(
            wide,
            alone,
            lambda f, u: ConeCrusher(
                2e-3 + 0.02 * u[0],
                0.025 + 0.1 * u[1],
                BroadbentCallcottBreakage(),
                1.0 + 3.0 * u[2],
                1e4 * u[3] * f["feed"].mass_flow,
            ),
        ),
        **{
            f"screen {n}": Case(rocks, alone, lambda f, u, deck=deck: Screen(deck(cut(u), u), 0.3 * u[4]))
            for n, deck in decks.items()
        },
        "two decks": Case(
            rocks,
            alone,
            lambda f, u: DoubleDeckScreen(
                decks["whiten"](cut(u), u), decks["logistic"](0.3 * cut(u), u), 0.3 * u[4]
            ),
        ),
        "three decks": Case(
            rocks,
            alone,
            lambda f, u: TripleDeckScreen(
                decks["whiten"](cut(u), u),
                decks["logistic"](0.3 * cut(u), u),
                decks["ideal"](0.1 * cut(u), u),
                0.3 * u[4],
            ),
        ),
        **{
            f"sized screen {deck} {wet}": Case(
                rocks,
                alone,
                lambda f, u, deck=deck, wet=wet: SizedScreen(
                    3e-4 * 10.0 ** (2.0 * u[0]),
                    f["feed"].solid_flow * 10.0 ** (-2.0 + 3.0 * u[1]),
                    1e-4 * 10.0 ** (2.0 * u[0]) * u[2],
                    0.4 * u[3],
                    deck,
                    wet,
                    1000.0 + 1200.0 * u[4],
                    liquid_split_oversize=0.2 * u[5],
                ),
            )
            for deck, wet in ((1, "dry"), (3, "wet"))
        },
    }


def _cake(f: dict[str, Stream], u: Any) -> tuple:
    return (
        f["feed"].solid_flow * 10.0 ** (0.5 + 3.0 * u[0]),
        1e4 * 10.0 ** (1.7 * u[1]),
        10.0 ** (8.0 + 4.0 * u[2]),
        0.35 + 0.25 * u[3],
    )


def _more(u: Any) -> dict[str, Any]:
    return {
        "medium_resistance": 10.0 ** (9.0 + 2.0 * u[4]),
        "compressibility": 0.9 * u[5],
        "solids_recovery": 0.9 + 0.1 * u[4],
        "surface_tension": 0.02 + 0.05 * u[5],
    }


def filters(classes: int) -> dict[str, Case]:
    fine = slurries(classes, 2e-6, 1e-3)
    batch = lambda u: {"deliquoring_time": 1800.0 * u[5], **_more(u)}
    bed = slurries(classes, 5e-7, 1e-4)
    return {
        "drum": Case(
            fine,
            with_wash,
            lambda f, u: RotaryVacuumDrum(*_cake(f, u), rotation_speed=0.02 + 0.18 * u[4], **_more(u)),
        ),
        "disc": Case(
            fine,
            with_wash,
            lambda f, u: RotaryDiscFilter(
                *_cake(f, u), rotation_speed=0.02 + 0.18 * u[4], wash_share=0.2 * u[5], **_more(u)
            ),
        ),
        "belt": Case(
            fine,
            with_wash,
            lambda f, u: HorizontalBeltFilter(
                *_cake(f, u), belt_length=3.0 + 27.0 * u[4], belt_speed=0.02 + 0.48 * u[5], **_more(u)
            ),
        ),
        "precoat": Case(
            fine,
            alone,  # it has no zone for a wash
            lambda f, u: PrecoatDrum(
                *_cake(f, u),
                rotation_speed=0.02 + 0.18 * u[4],
                precoat_thickness=0.05 + 0.07 * u[5],
                precoat_permeability=10.0 ** (-14.0 + 2.0 * u[2]),
                knife_advance=10.0 ** (-5.0 + 1.3 * u[3]),
                **_more(u),
            ),
        ),
        "frame": Case(
            fine,
            with_wash,
            lambda f, u: PlateAndFramePress(*_cake(f, u), chamber_depth=0.02 + 0.03 * u[4], **batch(u)),
        ),
        "chamber": Case(
            fine,
            with_wash,
            lambda f, u: ChamberPress(*_cake(f, u), chamber_depth=0.02 + 0.03 * u[4], **batch(u)),
        ),
        "membrane": Case(
            fine,
            with_wash,
            lambda f, u: MembranePress(
                *_cake(f, u),
                chamber_depth=0.02 + 0.03 * u[4],
                void_fraction_squeezed=0.25 + 0.3 * u[1],
                squeezing_pressure=10.0 ** (4.5 + 2.0 * u[3]),
                compaction_exponent=0.5 * u[2],
                squeezing_time=1500.0 * u[4],
                consolidation_coefficient=10.0 ** (-9.0 + 3.0 * u[5]),
                **batch(u),
            ),
        ),
        "tower": Case(
            fine,
            with_wash,
            lambda f, u: TowerPress(
                *_cake(f, u),
                full_cake_thickness=0.015 + 0.04 * u[4],
                squeezing_pressure=2e5 + 1.4e6 * u[3],
                compaction_exponent=0.2 * u[5],
                squeezing_time=30.0 + 300.0 * u[4],
                consolidation_coefficient=10.0 ** (-9.0 + 3.0 * u[5]),
                **batch(u),
            ),
        ),
        "tube": Case(
            fine,
            with_wash,
            lambda f, u: TubePress(
                *_cake(f, u),
                full_cake_thickness=0.004 + 0.016 * u[4],
                candle_radius=0.05 + 0.1 * u[5],
                squeezing_pressure=4e6 + 1e7 * u[3],
                compaction_exponent=0.2 * u[5],
                **batch(u),
            ),
        ),
        "nutsche": Case(
            fine,
            with_wash,
            lambda f, u: Nutsche(*_cake(f, u), full_cake_thickness=0.01 + 0.29 * u[4], **batch(u)),
        ),
        "leaf": Case(
            fine,
            with_wash,
            lambda f, u: PressureLeafFilter(*_cake(f, u), full_cake_thickness=0.01 + 0.03 * u[4], **batch(u)),
        ),
        "thinning": Case(
            fine,
            with_wash,
            lambda f, u: ChamberPress(
                *_cake(f, u),
                chamber_depth=0.02 + 0.03 * u[4],
                consistency=10.0 ** (-3.0 + 3.0 * u[3]),
                flow_index=0.3 + 0.9 * u[5],
                **batch(u),
            ),
        ),
        "candle": Case(
            fine,
            with_wash,
            lambda f, u: CandleFilter(
                *_cake(f, u),
                full_cake_thickness=0.01 + 0.03 * u[4],
                candle_radius=0.01 + 0.04 * u[5],
                **batch(u),
            ),
        ),
        "gravity": Case(
            fine,
            alone,
            lambda f, u: GravityFilter(
                f["feed"].slurry_volume_flow * 10.0 ** (2.0 + 3.0 * u[0]),
                0.1 + 1.9 * u[1],
                10.0 ** (8.0 + 4.0 * u[2]),
                0.35 + 0.25 * u[3],
                medium_resistance=10.0 ** (9.0 + 2.0 * u[4]),
                deliquoring_time=1800.0 * u[5],
                solids_recovery=0.9 + 0.1 * u[4],
            ),
        ),
        "thickening": Case(
            fine,
            alone,
            lambda f, u: ThickeningFilter(
                *_cake(f, u),
                (0.1 + 0.85 * u[5]) * (1.0 - _cake(f, u)[-1]),
                medium_resistance=10.0 ** (9.0 + 2.0 * u[4]),
                compressibility=0.9 * u[5],
                solids_recovery=0.9 + 0.1 * u[4],
                filtration_time=10.0 ** (1.5 + 2.5 * u[1]),
                backwash_volume_per_area=5e-3 * u[2],
                mass_transfer_coefficient=10.0 ** (-7.0 + 3.0 * u[3]) if classes % 2 == 0 else None,
                vessel_contents="thickened" if classes % 4 == 0 else "feed",
            ),
        ),
        "cartridge": Case(
            bed,
            thin,
            lambda f, u: CartridgeFilter(
                f["feed"].slurry_volume_flow / HOUR_RATE * 10.0 ** (1.5 * u[0]),
                10.0 ** (-6.5 + 2.5 * u[1]),
                0.01 + 0.2 * u[2],
                removal_rated=0.5 + 0.4999 * u[3],
                pressure_drop_change=5e4 + 2.5e5 * u[4],
                pressure_drop_rated=10.0 ** (3.0 + 1.5 * u[5]),
                liquid_per_length=10.0 ** (-5.0 + 3.0 * u[1]),
            ),
        ),
        "deep bed": Case(
            bed,
            thin,
            lambda f, u: DeepBedFilter(
                f["feed"].slurry_volume_flow / (HOUR_RATE * 10.0 ** (1.5 * u[0])),
                0.3 + 1.7 * u[1],
                3e-4 + 1.7e-3 * u[2],
                void_fraction=0.35 + 0.15 * u[3],
                attachment_efficiency=u[4],
                bed_expansion=0.1 + 0.4 * u[5],
            ),
        ),
    }


HOUR_RATE = 1.0 / 3600.0


def centrifuges(classes: int) -> dict[str, Case]:
    fine = slurries(classes, 5e-7, 1e-3)
    bowl = lambda u: (0.15 + 0.45 * u[0], 10.0 ** (1.5 + 1.5 * u[1]))
    settling = lambda u: ((0.2 + 0.7 * u[2]) * bowl(u)[0], *bowl(u))
    basket = lambda u: (*bowl(u), 10.0 ** (8.0 + 3.0 * u[2]), 0.35 + 0.25 * u[3])
    more = lambda u: {"medium_resistance": 10.0 ** (9.0 + 2.0 * u[4]), "solids_recovery": 0.9 + 0.1 * u[5]}
    return {
        "tubular": Case(
            fine,
            alone,
            lambda f, u: TubularBowl(
                *settling(u), bowl_length=0.2 + 1.8 * u[3], sediment_solids_fraction=0.2 + 0.4 * u[4]
            ),
        ),
        "disc stack": Case(
            fine,
            alone,
            lambda f, u: DiscStack(
                *settling(u),
                disc_number=20.0 + 180.0 * u[3],
                disc_angle=0.6 + 0.3 * u[5],
                sediment_solids_fraction=0.2 + 0.4 * u[4],
            ),
        ),
        "decanter": Case(
            fine,
            alone,
            lambda f, u: ScrollDecanter(
                *settling(u),
                bowl_length=0.5 + 1.5 * u[3],
                beach_length=0.4 * u[5],
                sediment_solids_fraction=0.2 + 0.4 * u[4],
            ),
        ),
        "solid basket": Case(
            fine,
            alone,
            lambda f, u: SolidBasket(
                *settling(u),
                bowl_length=0.2 + 0.8 * u[3],
                working_share=0.5 + 0.45 * u[5],
                sediment_solids_fraction=0.2 + 0.4 * u[4],
            ),
        ),
        "peeler": Case(
            fine,
            with_wash,
            lambda f, u: Peeler(
                *basket(u),
                cake_radius=0.85 * bowl(u)[0],
                basket_height=0.2 + 0.8 * u[4],
                radius_inner=0.8 * bowl(u)[0],
                drainage_time=10.0 + 590.0 * u[5],
                **more(u),
            ),
        ),
        "pusher": Case(
            fine,
            with_wash,
            lambda f, u: Pusher(
                *basket(u),
                cake_radius=0.9 * bowl(u)[0],
                basket_length=0.2 + 0.8 * u[4],
                feed_share=0.15 + 0.25 * u[5],
                **more(u),
            ),
        ),
        "scroll screen": Case(
            fine,
            with_wash,
            lambda f, u: ScrollScreen(
                *basket(u),
                basket_length=0.2 + 0.8 * u[4],
                scroll_pitch=0.05 + 0.1 * u[5],
                differential_speed=1.0 + 9.0 * u[3],
                **more(u),
            ),
        ),
        "sliding screen": Case(
            fine,
            with_wash,
            lambda f, u: SlidingCakeScreen(
                *basket(u),
                basket_length=0.2 + 0.8 * u[4],
                cone_angle=0.2 + 0.4 * u[5],
                friction_angle=0.3 + 0.4 * u[3],
                stay_time=1.0 + 19.0 * u[2],
                **more(u),
            ),
        ),
        "shaken screen": Case(
            fine,
            with_wash,
            lambda f, u: VibratingScreen(
                *basket(u),
                basket_length=0.2 + 0.8 * u[4],
                cone_angle=0.2 + 0.4 * u[5],
                friction_angle=0.3 + 0.4 * u[3],
                vibration_acceleration=20.0 + 180.0 * u[2],
                stay_time=1.0 + 19.0 * u[2],
                **more(u),
            ),
        ),
        "tumbling screen": Case(
            fine,
            with_wash,
            lambda f, u: TumblingScreen(
                *basket(u),
                basket_length=0.2 + 0.8 * u[4],
                cone_angle=0.2 + 0.4 * u[5],
                friction_angle=0.3 + 0.4 * u[3],
                tumbling_angle=0.03 + 0.17 * u[2],
                stay_time=1.0 + 19.0 * u[2],
                **more(u),
            ),
        ),
    }


def basics(classes: int) -> dict[str, Case]:
    fine = slurries(classes, 2e-6, 1e-3)
    return {
        "mixer": Case(fine, two, lambda f, u: Mixer()),
        "splitter": Case(fine, alone, lambda f, u: Splitter(u[0])),
        "heater": Case(fine, alone, lambda f, u: Heater(275.0 + 90.0 * u[0])),
        "tank": Case(fine, alone, lambda f, u: StirredTank(10.0 ** (-1.0 + 3.0 * u[0]))),
        **{
            f"agglomerator {name}": Case(
                fine,
                alone,
                lambda f, u, law=law: Agglomerator(
                    law(u), f["feed"].solid_flow * 10.0 ** (1.0 + 2.5 * u[1]), 10.0 ** (-3.0 + 4.0 * u[2])
                ),
            )
            for name, law in (
                ("constant", lambda u: ConstantKernel(10.0 ** (-19.0 + 6.0 * u[0]))),
                ("sum", lambda u: SumKernel(10.0 ** (-9.0 + 6.0 * u[0]))),
            )
        },
        "clarifier-thickener": Case(
            fine,
            lambda m, x: {"feed": slurry(m, x, (-4.0, -1.5))},
            lambda f, u: ClarifierThickener(
                f["feed"].slurry_volume_flow / 10.0 ** (-5.0 + 2.0 * u[0]),
                2.0 + 3.0 * u[1],
                f["feed"].slurry_volume_flow * (0.02 + 0.6 * u[2]),
                Vesilind(10.0 ** (-4.0 + 1.5 * u[3]), 0.005 + 0.05 * u[4]),
                PowerStress(30.0 + 70.0 * u[5], 5.0, 3.0),
                concentration_maximum=600.0,
                cells=20,
            ),
        ),
        "decantation": Case(
            fine,
            with_wash,
            lambda f, u: CountercurrentDecantation(
                1.0 + 9.0 * u[0],
                f["feed"].solid_flow * 10.0 ** (1.0 + 3.0 * u[1]),
                0.1 + 0.6 * u[2],
                Vesilind(10.0 ** (-4.0 + 1.5 * u[3]), 0.001 + 0.01 * u[4]),
                mixing_efficiency=0.8 + 0.2 * u[5],
            ),
        ),
        "secondary-settler": Case(
            fine,
            lambda m, x: {"feed": slurry(m, x, (-4.0, -1.5))},
            lambda f, u: SecondarySettler(
                f["feed"].slurry_volume_flow / 10.0 ** (-5.0 + 2.0 * u[0]),
                2.0 + 3.0 * u[1],
                f["feed"].slurry_volume_flow * (0.02 + 0.6 * u[2]),
                Takacs(10.0 ** (-4.0 + 1.5 * u[3]), 10.0 ** (-4.0 + 1.5 * u[3]), 0.005 + 0.5 * u[4], 3.0),
                0.003 * u[5],
            ),
        ),
    }
