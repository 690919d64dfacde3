"""Property formulas: water, gases, correlation forms, solutions, diffusivities."""
