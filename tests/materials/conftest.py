"""Tests of the library begin with what is shipped: materials that another test read from a file are out of
sight.
"""

import pytest

from granum.materials import library


@pytest.fixture(autouse=True)
def _shipped_materials_only(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(library, "_session", [library.SHIPPED])
