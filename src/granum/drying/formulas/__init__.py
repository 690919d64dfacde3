"""Formulas of moist solids and drying kinetics."""
