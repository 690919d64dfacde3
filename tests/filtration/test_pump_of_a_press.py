"""A pump that cannot follow: filters at its flux until their pressure is reached, by sums over cakes."""

from __future__ import annotations

import numpy as np
import pytest
from tests.filtration.test_cake_filters import mixture, stream

from granum.core.errors import InputError
from granum.filtration.equipment.batch import CandleFilter, ChamberPress, MembranePress, PressureLeafFilter
from granum.streams.audit import closure

RIGID = {"area": 20.0, "pressure_drop": 4e5, "cake_resistance": 6e10, "void_fraction": 0.5}


def summed(filter_, s, resistance_of, steps: int = 40_000) -> tuple[float, float]:
    """Time to fill and time at the flux of the pump, slice by slice: the flux is what the pressure drives, or
    the pump gives.
    """
    whole = float(filter_.loading(s))
    w = (np.arange(steps) + 0.5) * whole / steps
    flux = np.minimum(resistance_of(w), filter_.filtrate_flux_largest)
    time = whole / steps / (float(s.dry_cake_per_filtrate) * flux)
    return float(np.sum(time)), float(np.sum(time[flux >= filter_.filtrate_flux_largest]))


@pytest.mark.parametrize("compressibility", [0.0, 0.6])
@pytest.mark.parametrize("flux", [1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize("medium", [0.0, 1e11])
def test_sum_over_the_cake_of_a_press(compressibility: float, flux: float, medium: float) -> None:
    m = mixture()
    feed = stream(m, 0.1, 1.0)
    fields = {
        **RIGID,
        "chamber_depth": 0.03,
        "medium_resistance": medium,
        "compressibility": compressibility,
    }
    press = ChamberPress(**fields, filtrate_flux_largest=flux)
    s = press.slurry(feed)

    def needed(w):
        """Pressure that the pump needs for its flux through a cake that yields to it, as far as it has it."""
        low, high = np.zeros_like(w), np.full_like(w, 4e5)
        for _ in range(60):
            middle = 0.5 * (low + high)
            alpha = 6e10 * np.maximum(middle / 1e5, 1e-12) ** compressibility
            needs = float(s.dynamic_viscosity) * flux * (alpha * w + medium)
            low, high = np.where(needs > middle, middle, low), np.where(needs > middle, high, middle)
        return 0.5 * (low + high)

    def driven(w):
        """Flux of the pump where its pressure is below that of the press, else that of the press."""
        pressure = needed(w)
        alpha = 6e10 * (pressure / 1e5) ** compressibility
        return np.where(
            pressure > 3.999999e5,
            4e5 / (float(s.dynamic_viscosity) * (alpha * w + medium)),
            flux * (1 + 1e-9),
        )

    time, rising = summed(press, s, driven)
    made = press.plan(s, feed)
    assert float(made.formation_time) == pytest.approx(time, rel=2e-4)
    assert float(made.pressure_rise_time) == pytest.approx(rising, rel=1e-3, abs=time * 1e-4)
    # the work of the pump: its pressure over the filtrate, which goes with the cake
    w = (np.arange(4000) + 0.5) / 4000 * float(press.loading(s))
    assert float(press.pump_pressure(s, press.loading(s))) == pytest.approx(needed(w).mean(), rel=1e-3)
    shaft = {"free": ChamberPress(**fields), "slow": press}
    drawn = {k: p.operate(feed=feed).uses["electric_power_pump"] for k, p in shaft.items()}
    share = needed(w).mean() / 4e5
    assert float(drawn["slow"]) == pytest.approx(share * float(drawn["free"]), rel=1e-3)


def test_sum_over_the_cake_of_a_candle() -> None:
    m = mixture()
    feed = stream(m, 0.1, 1.0)
    for flux in (3e-5, 1e-4, 3e-4):
        candle = CandleFilter(
            **RIGID,
            full_cake_thickness=0.02,
            candle_radius=0.03,
            medium_resistance=2e11,
            filtrate_flux_largest=flux,
        )
        s = candle.slurry(feed)
        packed = 0.5 * float(s.solid_density)

        def driven(w, packed=packed, viscosity=float(s.dynamic_viscosity)):
            r = np.sqrt(0.03**2 + 2 * 0.03 * w / packed)
            return 4e5 / (viscosity * (6e10 * packed * 0.03 * np.log(r / 0.03) + 2e11))

        w = (np.arange(4000) + 0.5) / 4000 * float(candle.loading(s))
        mean = np.minimum(4e5 * flux / driven(w), 4e5).mean()
        assert float(candle.pump_pressure(s, candle.loading(s))) == pytest.approx(mean, rel=1e-3)
        time, rising = summed(candle, s, driven)
        made = candle.plan(s, feed)
        assert float(made.formation_time) == pytest.approx(time, rel=2e-4)
        assert float(made.pressure_rise_time) == pytest.approx(rising, rel=1e-3)


def test_sum_over_the_cake_of_a_thinning_liquid() -> None:
    """Its flux goes with the pressure over the resistance to the power 1/n, from one that is known."""
    m = mixture()
    feed = stream(m, 0.1, 1.0)
    settings = {**RIGID, "full_cake_thickness": 0.02, "medium_resistance": 1e11}
    free = PressureLeafFilter(**settings, consistency=0.05, flow_index=0.6)
    s = free.slurry(feed)
    known = float(free.through(s, 1e-4))  # resistance that the pressure drives 0.1 mm/s through
    for flux in (2e-6, 1e-5, 1e-3):
        leaf = PressureLeafFilter(**settings, consistency=0.05, flow_index=0.6, filtrate_flux_largest=flux)
        time, rising = summed(leaf, s, lambda w: 1e-4 * (known / (6e10 * w + 1e11)) ** (1 / 0.6))
        w = (np.arange(4000) + 0.5) / 4000 * float(leaf.loading(s))
        mean = (4e5 * np.minimum((flux / 1e-4) ** 0.6 * (6e10 * w + 1e11) / known, 1.0)).mean()
        assert float(leaf.pump_pressure(s, leaf.loading(s))) == pytest.approx(mean, rel=1e-3)
        made = leaf.plan(leaf.slurry(feed), feed)
        assert float(made.formation_time) == pytest.approx(time, rel=3e-4)
        assert float(made.pressure_rise_time) == pytest.approx(rising, rel=1e-3, abs=time * 1e-4)


@pytest.mark.parametrize("seed", range(20))
def test_slower_pumps_take_longer_and_balances_close(seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = mixture()
    feed, wash = stream(m, rng.uniform(0.02, 0.3), 1.0, 0.05), stream(m, water=0.1)
    settings = {
        **RIGID,
        "pressure_drop": 10 ** rng.uniform(5, 6),
        "cake_resistance": 10 ** rng.uniform(9, 12),
        "chamber_depth": rng.uniform(0.015, 0.05),
        "medium_resistance": 10 ** rng.uniform(9, 12),
        "void_fraction_squeezed": 0.45,
    }
    before, free = 0.0, 0.0
    for flux in (None, *(10 ** np.sort(rng.uniform(-6, -3, 4)))[::-1]):
        press = MembranePress(**settings, filtrate_flux_largest=flux)
        made = press.inside(feed, wash)
        time = float(made.plan.formation_time)
        assert time >= before * (1 - 1e-9)
        assert float(closure([feed, wash], press.outlets(made, feed, wash)).mass) < 1e-12
        before, free = time, time if flux is None else free
    assert before > free


def test_a_pump_that_gives_nothing_is_refused() -> None:
    with pytest.raises(InputError, match="filtrate_flux_largest"):
        ChamberPress(**RIGID, chamber_depth=0.03, filtrate_flux_largest=0.0)
