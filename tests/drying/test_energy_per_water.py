"""What dryers take per kilogram of water, beside the orders of magnitude of the notes."""

from __future__ import annotations

import pytest

import granum as gr


@pytest.mark.parametrize(
    ("dryer", "least", "most"),
    [
        # table III.2 of the notes on thermal drying: by entrainment without recovery, kJ/kg
        ("flash_dryer", 3300.0, 6500.0),
        ("fluidized_bed_dryer", 3300.0, 6500.0),
        ("rotary_dryer", 3300.0, 6500.0),
        ("spray_dryer", 3300.0, 6500.0),
        ("tunnel_dryer", 3300.0, 6500.0),
        ("vibrated_bed_dryer", 3300.0, 6500.0),
        ("impingement_dryer", 3300.0, 6500.0),
        # air that leaves nearly saturated has the least of them all, 2.5 MJ to evaporate and its own warmth
        ("silo_dryer", 2500.0, 3300.0),
        # by boiling
        ("drum_dryer", 2400.0, 3300.0),
        ("paddle_dryer", 2400.0, 3300.0),
        ("paper_machine", 2400.0, 3300.0),
        ("vacuum_shelf_dryer", 2400.0, 3300.0),
    ],
)
def test_energy_per_water_of_the_notes(dryer: str, least: float, most: float) -> None:
    """Heat and electricity of the whole, as bought, for each machine with its own feed."""
    taken = gr.alone(f"drying.{dryer}").solve().utilities.energy_per_water
    assert least <= taken / 1e3 <= most
