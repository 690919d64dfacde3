"""The choice of a separator follows the sources' plain advice; charts draw what the formulas say."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.datasets import dataset
from granum.core.i18n import catalog, language
from granum.filtration.charts import cake_profile_chart, filtration_cycle_chart, washing_chart
from granum.filtration.selection import separator_choice


def ranked(*case, **more):
    found = separator_choice(*case, **more)
    return dict(zip(found.separator, found.suitability, strict=True)), found


def test_plain_advice():
    coarse, found = ranked("300 um", 1100, 0.35, "20 m^3/hour", liquid_left_wanted=0.15, washing=True)
    assert found.separator[0] == "pusher centrifuge"
    assert coarse["cross-flow membrane"] < 0.05
    fine, found = ranked("0.5 um", 50, 0.001, "1 m^3/hour")
    assert fine["gravity thickener"] < 0.2
    assert {"tubular bowl centrifuge", "cross-flow membrane"} == set(found.separator[:2])
    dilute, found = ranked("8 um", 1500, 0.0003, "500 m^3/hour")
    assert {"lamella settler", "deep bed of sand"} == set(found.separator[:2])
    assert dilute["pusher centrifuge"] < 0.05
    # nothing that settles when there is no density difference
    same, found = ranked("20 um", 0.0, 0.05, "5 m^3/hour")
    assert max(
        same[m["name"]] for m in dataset("filtration", "separators_svarovsky2001") if m["settles"]
    ) < min(same["membrane press"], same["rotary vacuum drum"])
    assert "settles too slowly" in found.speaks_against[found.separator.index("scroll decanter")]


def test_no_two_machines_tie_at_the_top_and_each_rank_has_its_reason():
    found = separator_choice("20 um", 1000, 0.1, "10 m^3/hour")
    assert np.all(np.diff(found.suitability[:10]) < 0)
    assert found.suitability[0] < 1.0
    # 6 mm of cake on a drum at 0.6 bar by Kozeny and Carman, by hand: 180·0.55²/(0.45³·d²) = 1.494e12 1/m²
    per_filtrate = 0.1 / (1 - 0.45 - 0.1)
    seconds = 1e-3 * 1.4938e12 * 0.006**2 / (2 * per_filtrate * 0.6e5)
    assert (
        f"6 mm of cake form in {seconds:.2g} s"
        in found.speaks_for[found.separator.index("rotary vacuum drum")]
    )
    # ten times finer, a hundred times slower: the drum falls behind the press
    slow, found = ranked("2 um", 1000, 0.1, "10 m^3/hour")
    assert slow["rotary vacuum drum"] < slow["membrane press"]
    assert "take" in found.speaks_against[found.separator.index("rotary vacuum drum")]


def test_cartridges_polish_and_pulsed_candles_thicken():
    """Nobody throws cartridges at a slurry, nor builds a sand bed for a cubic meter per hour."""
    clear, found = ranked("3 um", 1600, 1e-5, "1 m^3/hour")
    assert clear["cartridge filter"] > max(clear["deep bed of sand"], clear["candle filter"])
    slurry, _found = ranked("3 um", 1600, 0.02, "20 m^3/hour", liquid_left_wanted=0.85)
    assert slurry["cartridge filter"] < 0.1
    assert slurry["thickening filter"] > max(0.5, slurry["deep bed of sand"])
    dry, found = ranked("3 um", 1600, 0.02, "20 m^3/hour", liquid_left_wanted=0.4)
    assert dry["thickening filter"] < dry["membrane press"]
    assert "leaves more liquid" in found.speaks_against[found.separator.index("thickening filter")]


def test_presses_for_sludge_and_a_filter_under_its_own_head():
    """Primary sludge in flocs: presses that run all the time before those for batches; sand needs none."""
    sludge, found = ranked("30 um", 60, 0.03, "20 m^3/hour", liquid_left_wanted=0.75)
    assert min(sludge["belt press"], sludge["screw press"]) > sludge["plate-and-frame or chamber press"]
    assert "needs flocs" in found.speaks_against[found.separator.index("belt press")]
    sand, found = ranked("500 um", 1650, 0.1, "2 m^3/hour")
    assert sand["gravity filter (batch)"] > max(sand["belt press"], sand["screw press"])
    # 20 mm of cake under half a meter of water, by hand
    fine, found = ranked("5 um", 1650, 0.1, "2 m^3/hour")
    resistance = 180.0 * 0.55**2 / (0.45**3 * 5e-6**2)
    minutes = 1e-3 * resistance * 0.02**2 / (2.0 * 0.1 / (1 - 0.45 - 0.1) * 5e3) / 60.0
    assert (
        f"20 mm of cake take {minutes:.2g} min"
        in found.speaks_against[found.separator.index("gravity filter (batch)")]
    )
    assert fine["gravity filter (batch)"] < fine["membrane press"]


def test_drops_that_float_go_to_machines_with_an_outlet_for_them():
    _cream, found = ranked("5 um", -120, 0.04, "10 m^3/hour", drops=True)
    assert set(found.separator[:3]) <= {"disc stack centrifuge", "scroll decanter", "cross-flow membrane"}
    assert (
        "has no outlet for what floats"
        in found.speaks_against[found.separator.index("solid-basket centrifuge")]
    )
    assert "cannot hold drops" in found.speaks_against[found.separator.index("membrane press")]
    coarse, _found = ranked("200 um", -120, 0.001, "50 m^3/hour", drops=True)
    assert coarse["lamella settler"] > coarse["disc stack centrifuge"]
    assert coarse["gravity thickener"] < 0.2


def test_the_size_is_the_number_of_machines_and_the_area_on_which_the_flow_settles():
    """36 m³/h of grains that fall at (20 µm)²·1500·g/(18·1 mPa s) = 0.327 mm/s need 30.6 m²."""
    found = separator_choice("20 um", 1500, 0.005, "36 m^3/hour")
    sizes = dict(zip(found.separator, found.separator_size, strict=True))
    assert sizes["gravity thickener"] == "1 machine, settling area 31 m²"
    assert sizes["tubular bowl centrifuge"] == "8 machines, like 31 m² of settling area"
    assert sizes["candle filter"] == "1 machine"


def test_every_machine_has_a_french_name_and_a_sound_range():
    for m in dataset("filtration", "separators_svarovsky2001"):
        assert m["name"] in catalog("fr")
        assert m["size_low"] < m["size_high"]
        assert m["solids_low"] < m["solids_high"] <= 0.65
        assert m["flow_low"] < m["flow_high"]
    with language("fr"):
        assert (
            separator_choice("300 um", 1100, 0.35, "20 m^3/hour", 0.15, washing=True).separator[0]
            == "essoreuse à poussoir"
        )


def test_charts():
    drawing = filtration_cycle_chart(10, "3 bar", "1 cP", 1e11, 20, "20 min")
    filtrate, tangent, best = drawing.data
    assert best.x[0] == pytest.approx(40.0)  # dead and filtering time, 20 min each without medium
    at = np.interp(best.x[0], filtrate.x, filtrate.y)
    assert at == pytest.approx(best.y[0], rel=1e-3)
    below = np.interp(filtrate.x, tangent.x, tangent.y) - filtrate.y
    assert below[np.asarray(filtrate.x) <= tangent.x[-1]].min() > -1e-3
    profile = cake_profile_chart("4 bar", 1e10, 0.7, 0.5, 0.06, "0.1 bar")
    assert profile.data[0].y[-1] == pytest.approx(4.0)
    assert washing_chart(10).data[1].y[0] == 1.0


def test_air_filter_classes_of_en_1822():
    from granum.filtration.selection import air_filter_class

    assert [air_filter_class(x) for x in (0.9995, 0.99995, 0.96, 0.999995)] == ["H13", "H14", "E11", "U15"]
    assert air_filter_class(0.6).startswith("below")
