"""Figures that a unit has only with certain settings: left out of a study where it has none, refused in words
where they are asked for.
"""

from __future__ import annotations

import pytest

import granum as gr
from granum import studies
from granum.cases import read_text
from granum.core.errors import InputError
from granum.studies.lines import LineSubject

NUTSCHE = "filtration.nutsche"
RISE = "nutsche.pressure_rise_time"


def test_a_study_shows_what_there_is() -> None:
    assert RISE not in LineSubject.of(gr.alone(NUTSCHE)).outputs()
    line = gr.alone(NUTSCHE, filtrate_flux_largest="0.2 mm/s")
    assert RISE in LineSubject.of(line).outputs()
    found = studies.sweep(line, {"nutsche.area": ["1 m2", "2 m2"]})
    assert found.counts()["failed"] == 0


def test_what_there_is_not_is_refused_by_name() -> None:
    line = gr.alone(NUTSCHE)
    with pytest.raises(InputError, match=f"'{RISE}' has no value"):
        studies.sweep(line, {"nutsche.area": ["1 m2", "2 m2"]}, outputs=[RISE])
    with pytest.raises(InputError, match=f"'{RISE}' has no value"):
        line.solve().figure(RISE)
    wanted = f'vary = "nutsche.area"\nso_that = "{RISE}"\nequals = "10 min"\nlower = 0.1\nupper = 10\n'
    with pytest.raises(InputError, match=f"'{RISE}' has no value"):
        gr.size(NUTSCHE, pressure_rise_time="10 min")
    with pytest.raises(InputError, match=f"'{RISE}' has no value"):
        read_text(f"{line.text}\n[specifications.rise]\n{wanted}").solve()
