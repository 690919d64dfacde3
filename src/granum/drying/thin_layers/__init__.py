"""Thin-layer drying models: moisture ratio over time."""
