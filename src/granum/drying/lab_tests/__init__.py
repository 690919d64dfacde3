"""Lab tests of drying: sorption isotherm, drying curve."""
