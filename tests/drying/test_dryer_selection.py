"""The choice of a dryer against the course notes' own examples of use (tables IV.1 to IV.22)."""

from __future__ import annotations

import numpy as np
import pytest

from granum.core.errors import InputError
from granum.drying.selection import choose, water_removal_choice

# what the notes' sheets dry in each dryer: form, wet moisture in and out, t/h, limit °C, time s
NOTES = [
    ("spray dryer", ("liquid", 0.52, 0.03, 10.0, 90, 20.0)),  # milk
    ("spray dryer", ("liquid", 0.45, 0.001, 20.0, 200, 20.0)),  # titanium oxide
    ("drum dryer", ("web", 0.60, 0.05, 20.0, 130, 10.0)),  # paper and board
    ("rotary drum dryer", ("powder", 0.065, 0.001, 60.0, 300, 1800.0)),  # sand
    ("silo dryer", ("powder", 0.35, 0.15, 30.0, 60, 4 * 3600.0)),  # maize
    ("silo dryer", ("powder", 0.195, 0.145, 40.0, 55, 5 * 3600.0)),  # wheat
    ("belt dryer", ("fibrous", 0.40, 0.15, 1.0, 90, 600.0)),  # wool
    ("flash dryer", ("powder", 0.42, 0.09, 20.0, 65, 2.0)),  # starch
    ("fluidized-bed dryer", ("powder", 0.02, 0.0003, 20.0, 150, 600.0)),  # sea salt
    ("tray oven", ("pieces", 0.45, 0.05, 0.2, 60, 20 * 3600.0)),  # plaster tiles
    ("freeze dryer", ("pieces", 0.90, 0.11, 0.05, 20, 40 * 3600.0)),  # strawberry pieces
    ("paddle or screw dryer", ("paste", 0.70, 0.03, 1.0, 130, 2 * 3600.0)),  # paint sludge
    ("tunnel dryer", ("pieces", 0.20, 0.03, 5.0, 200, 20 * 3600.0)),  # bricks and tiles
]


@pytest.mark.parametrize(("dryer", "case"), NOTES)
def test_dryers_of_the_notes_are_among_the_best(dryer, case):
    form, x1, x2, tonnes, limit, time = case
    found = choose(form, tonnes / 3.6, x1 / (1 - x1), x2 / (1 - x2), 273.15 + limit, time)
    assert dryer in found.dryer[:3]
    assert np.all(np.diff(found.suitability) <= 0)


def test_reasons_and_hazards():
    dusty = choose("powder", 1.0, 0.3, 0.02, hazard="dust")
    assert "explode" in dusty.speaks_against[dusty.dryer.index("flash dryer")]
    solvent = choose("paste", 0.1, 0.8, 0.02, 333.0, hazard="solvent")
    assert solvent.dryer[0] == "vacuum paddle or screw dryer"
    cold = choose("liquid", 0.01, 9.0, 0.02, temperature_limit="5 degC")
    assert cold.dryer[0] == "freeze dryer"
    assert "does not take" in choose("web", 1.0, 1.0, 0.05).speaks_against[-1]
    with pytest.raises(InputError, match="not drier"):
        choose("web", 1.0, 0.1, 0.5)


def test_pressing_comes_first_and_desiccants_cost_their_regeneration():
    ways = water_removal_choice(1000.0, 4.0, 0.1)
    assert ways.mass_water[0] + ways.mass_water[1] == pytest.approx(ways.mass_water[2])
    # 2 to 35 kWh/t of the notes
    assert 2 * 3.6e3 < ways.energy_per_water[0] < 35 * 3.6e3
    assert ways.energy_per_water[3] >= ways.energy_per_water[2]
    assert "4004 kg" in ways.speaks_against[3]  # CaCl2·6H2O holds 108.09 g of water on 110.98 g: 3900/0.974
    assert water_removal_choice(1.0, 1.0, 0.1).mass_water[0] == 0.0
