"""Numerical methods shared by all domains: roots, fixed points, transport, ODEs, tables. Knows no
engineering.
"""

from __future__ import annotations

from typing import Any

_HOME = {
    "find_root": "roots",
    "Root": "roots",
    "fixed_point": "fixed_points",
    "settle": "settled",
    "Settled": "settled",
    "within_rounding": "fixed_points",
    "Seeking": "seeking",
    "Continuation": "continuation",
    "Chords": "chords",
    "solve_system": "fixed_points",
    "Solution": "fixed_points",
    "AbstractMethod": "fixed_points",
    "Anderson": "fixed_points",
    "Newton": "fixed_points",
    "advance": "finite_volumes",
    "transport_rate": "finite_volumes",
    "ssp_rk3": "finite_volumes",
    "steps_for": "finite_volumes",
    "stationary_points": "finite_volumes",
    "Evolution": "finite_volumes",
    "Upwind": "finite_volumes",
    "Godunov": "finite_volumes",
    "uniform_edges": "finite_volumes",
    "geometric_edges": "finite_volumes",
    "AbstractBoundary": "boundaries",
    "Outflow": "boundaries",
    "Inflow": "boundaries",
    "FixedFlux": "boundaries",
    "Wall": "boundaries",
    "Periodic": "boundaries",
    "van_leer": "limiters",
    "koren": "limiters",
    "minmod": "limiters",
    "superbee": "limiters",
    "first_order": "limiters",
    "integrate": "odes",
    "Trajectory": "odes",
    "gauss_legendre": "quadrature",
    "moments": "quadrature",
    "cumulative_trapezoid": "quadrature",
    "cumulative_simpson": "quadrature",
    "falling": "interpolation",
    "interpolate_linear": "interpolation",
    "MonotoneCubic": "interpolation",
    "slopes_pchip": "interpolation",
    "slopes_steffen": "interpolation",
    "crossing_pair": "pairs",
    "Pair": "pairs",
    "solve_chain": "chains",
    "advance_chain": "chains",
    "ChainSolution": "chains",
    "Cells": "chains",
    "Rates": "chains",
    "History": "chains",
    "safe_where": "smooth",
    "safe_divide": "smooth",
    "safe_log": "smooth",
    "safe_sqrt": "smooth",
    "safe_power": "smooth",
    "positive_part": "smooth",
    "blend": "smooth",
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _HOME:
        return getattr(import_module(f"granum.numerics.{_HOME[name]}"), name)
    raise AttributeError(f"granum.numerics has no '{name}'")


def __dir__() -> list[str]:
    return sorted(_HOME)
