"""A drawing of a figure that needs no script: lines, points and axes, as a picture in the page."""

from __future__ import annotations

import math
import re
from html import escape, unescape
from typing import Any

from granum.core.units import format_number

WIDE, HIGH, LEFT, LOW, RIGHT = 640, 420, 70, 50, 12  # of the picture, and of the rooms for its axes


def _bare(text: str) -> str:
    return escape(unescape(re.sub(r"<[^>]+>", "", text or "")))


def picture(drawn: dict[str, Any]) -> str:
    """The figure at the start, as SVG."""
    layout = drawn["layout"]
    axes = [layout["xaxis"], layout["yaxis"]]
    logs = [axis.get("type") == "log" for axis in axes]

    def place(value: float | None, which: int) -> float | None:
        if value is None or (logs[which] and value <= 0):
            return None
        low, high = axes[which]["range"]
        share = ((math.log10(value) if logs[which] else value) - low) / (high - low)
        return round(
            LEFT + share * (WIDE - LEFT - RIGHT) if which == 0 else (HIGH - LOW) * (1 - share) + 8, 1
        )

    parts = []
    for trace in drawn["data"]:
        xy = [(place(x, 0), place(y, 1)) for x, y in zip(trace["x"], trace["y"], strict=True)]
        seen = [(x, y) for x, y in xy if x is not None and y is not None]
        if trace.get("mode") == "markers":
            color = trace["marker"]["line"]["color"]
            parts += [f'<circle cx="{x}" cy="{y}" r="3" fill="{color}"/>' for x, y in seen]
        else:
            points = " ".join(f"{x},{y}" for x, y in seen)
            color, width = trace["line"]["color"], trace["line"].get("width", 2)
            parts.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="{width}"/>')
    for which, axis in enumerate(axes):
        for tick in _ticks(*axis["range"], logs[which]):
            at, text = place(tick, which), escape(format_number(tick, 3))
            spot = (
                f'x="{at}" y="{HIGH - LOW + 26}" text-anchor="middle"'
                if which == 0
                else f'x="{LEFT - 6}" y="{at}" text-anchor="end"'
            )
            parts.append(f"<text {spot}>{text}</text>")
    titles = [_bare(axis["title"]["text"]) for axis in axes]
    middle = (HIGH - LOW) / 2
    return (
        f'<svg viewBox="0 0 {WIDE} {HIGH}" role="img" aria-label="{titles[1]}; {titles[0]}" font-size="12">'
        f'<svg x="{LEFT}" y="8" width="{WIDE - LEFT - RIGHT}" height="{HIGH - LOW}" '
        f'viewBox="{LEFT} 8 {WIDE - LEFT - RIGHT} {HIGH - LOW}">'
        f"{''.join(p for p in parts if p[1] != 't')}</svg>"
        f'<path d="M{LEFT} 8V{HIGH - LOW + 8}H{WIDE - RIGHT}" fill="none" stroke="#1c2430"/>'
        f"{''.join(p for p in parts if p[1] == 't')}"
        f'<text x="{(WIDE + LEFT) / 2}" y="{HIGH - 6}" text-anchor="middle">{titles[0]}</text>'
        f'<text transform="translate(14 {middle}) rotate(-90)" text-anchor="middle">{titles[1]}</text></svg>'
    )


def _ticks(low: float, high: float, log: bool) -> list[float]:
    """Decades, or round numbers, at most seven."""
    if log:
        first, last = math.ceil(low), math.floor(high)
        return [10.0**n for n in range(first, last + 1, max(1, math.ceil((last - first) / 6)))]
    step = 10.0 ** math.floor(math.log10((high - low) / 2))
    step *= next(m for m in (1, 2, 5, 10) if (high - low) / (m * step) <= 6)
    return [n * step for n in range(math.ceil(low / step), math.floor(high / step) + 1)]
