"""Equations as MathML, so that reports and pages need no script to show them. A contract test converts every
card's equation.
"""

from __future__ import annotations

from functools import lru_cache


@lru_cache(maxsize=4096)
def mathml(latex: str, display: bool = False) -> str:
    """MathML of a LaTeX formula."""
    if not latex:
        return ""
    from latex2mathml.converter import convert

    return convert(latex, display="block" if display else "inline")
