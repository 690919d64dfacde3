"""Kinds of crystallization."""

from __future__ import annotations

from granum.core.kinds import TemperatureRate

CoolingRate = TemperatureRate
