"""Formulas of humid gas: humidity, enthalpy, wet bulb, processes."""
