"""Sorption isotherms: moisture against water activity, both ways, with temperature."""
