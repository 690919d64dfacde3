"""A web without a limit of its own is held below where wool and paper catch fire."""

from __future__ import annotations

from granum.cases.alone import alone


def checks(**given: str) -> dict[str, dict]:
    told = alone("drying.radiant_dryer", **given).solve().as_json()["units"]["radiant_dryer"]["checks"]
    return {c["name"]: c for c in told}


def test_a_scorched_web_fails_unless_it_has_a_limit_of_its_own() -> None:
    name = "highest temperature of a web without its own limit"
    assert checks()[name]["ok"]
    hot = checks(length="1.1 m")
    assert hot[name]["value"] > 200.0
    assert not hot[name]["ok"]
    own = checks(length="1.1 m", temperature_limit="400 degC")
    assert name not in own
    assert own["product temperature over its limit"]["ok"]
