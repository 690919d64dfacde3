"""The two charts of humid gas: psychrometric (Carrier) and Mollier–Ramzin, for any pair and pressure, with
the path of a process.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from granum.core import chart
from granum.core.constants import STANDARD_ATMOSPHERE, ZERO_CELSIUS
from granum.core.errors import InputError
from granum.core.i18n import _
from granum.core.kinds import KINDS, HumidityRatio, Pressure, Series, Temperature
from granum.core.units import format_number, show
from granum.humid_gas.formulas.state import GasVaporPair
from granum.humid_gas.isolines import Isolines, nice_steps
from granum.humid_gas.pairs import AIR_WATER, AbstractPair

if TYPE_CHECKING:
    import plotly.graph_objects as go

WIDTH, HEIGHT = 1120, 790
MARGIN = {"l": 70, "r": 80, "t": 70, "b": 62}
# shares of a line by which its label may evade
NEARBY = np.array([0.0, -0.04, 0.04, -0.08, 0.08, -0.12, 0.12, -0.18, 0.18, -0.24, 0.24, -0.3, 0.3])
States = Annotated[Temperature, Series("states")] | None
Humidities = Annotated[HumidityRatio, Series("states")] | None
Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]


def default_humidity(T_high: float, pair: AbstractPair = AIR_WATER) -> float:
    """A humidity ratio that suits a highest temperature: that of air and water, times what a more volatile
    vapor makes of it.
    """
    t = T_high - ZERO_CELSIUS
    w = 0.03 if t <= 60.0 else 0.03 + 8e-4 * (t - 55.0)
    if pair.vapor_molar_mass == AIR_WATER.vapor_molar_mass:
        return w
    fractions = [float(p.saturated_fraction(300.0, STANDARD_ATMOSPHERE, False)) for p in (pair, AIR_WATER)]
    times = pair.humidity_ratio(min(fractions[0], 0.5)) / AIR_WATER.humidity_ratio(fractions[1])
    return float(f"{w * times:.1g}")


def _window(
    low: float | None, high: float | None, usual: float, w_high: float | None, states: Any, pair: AbstractPair
) -> tuple[float, float, float]:
    """Coldest and hottest temperature and largest humidity: those given, or the usual ones widened so that
    every state is inside.
    """
    T, w = ([], []) if states is None else ([float(t) for t in states[0]], [float(x) for x in states[1]])
    cold = (
        min([263.15] + [5.0 * float(np.floor((t - 1.0) / 5.0)) + 3.15 for t in T])
        if low is None
        else float(low)
    )
    hot = (
        max([usual] + [5.0 * float(np.ceil((t + 1.85) / 5.0)) + 3.15 for t in T])
        if high is None
        else float(high)
    )
    return cold, hot, float(w_high) if w_high else max([default_humidity(hot, pair)] + [1.1 * x for x in w])


class _Sheet:
    """Draws isolines, labels and states on one of the two charts; ``place`` turns temperature and humidity
    into coordinates.
    """

    def __init__(
        self,
        figure: go.Figure,
        lines: Isolines,
        place: Place,
        x: tuple[float, float],
        y: tuple[float, float],
        height: float,
    ):
        self.figure, self.lines, self.place = figure, lines, place
        self.x, self.y = x, y
        self.scale = ((WIDTH - MARGIN["l"] - MARGIN["r"]) / (x[1] - x[0]), height / (y[1] - y[0]))
        self.taken: list[tuple[float, float, float]] = []  # circles of pixels that labels and states cover

    def _free(self, circles: list[tuple[float, float, float]]) -> bool:
        """Whether pixels are inside the frame and not covered yet."""
        left, right = (x * self.scale[0] for x in self.x)
        low, high = (y * self.scale[1] for y in self.y)
        inside = all(left + r < x < right - r and low + r < y < high - r for x, y, r in circles)
        return inside and all(
            np.hypot(x - a, y - b) >= r + c for x, y, r in circles for a, b, c in self.taken
        )

    def reserve(self, T: np.ndarray, w: np.ndarray) -> None:
        """Keep labels off the marks of states."""
        x, y = self.place(T, w)
        self.taken += [
            (float(a * self.scale[0]), float(b * self.scale[1]), 13.0) for a, b in zip(x, y, strict=True)
        ]

    def curve(
        self,
        T: np.ndarray,
        w: np.ndarray,
        name: str,
        color: str,
        width: float,
        dash: str = "solid",
        legend: bool = False,
    ) -> None:
        import plotly.graph_objects as go

        if len(T) < 2:
            return
        x, y = self.place(T, w)
        self.figure.add_trace(
            go.Scatter(
                x=x,
                y=y,
                mode="lines",
                line={"color": color, "width": width, "dash": dash, "simplify": False},
                name=name,
                legendgroup=name,
                showlegend=legend,
                hoverinfo="skip",
            )
        )

    def label(
        self,
        T: np.ndarray,
        w: np.ndarray,
        text: str,
        color: str,
        at: float,
        size: int = 10,
        beyond: float = 0.0,
    ) -> None:
        """Text along a curve, near a share of its drawn length where nothing is in the way; ``beyond`` shifts
        it past the end, in pixels.
        """
        if len(T) < 2:
            return
        x, y = self.place(T, w)
        px, py = x * self.scale[0], y * self.scale[1]
        s = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(px), np.diff(py)))])
        if s[-1] < 45.0 and not beyond:
            return
        for share in (at,) if beyond else at + NEARBY[(at + NEARBY > 0.03) & (at + NEARBY < 0.97)]:
            where = share * s[-1]
            cx, cy = np.interp(where, s, px), np.interp(where, s, py)
            low, high = max(where - 12.0, 0.0), min(where + 12.0, s[-1])
            dx, dy = (np.interp(high, s, p) - np.interp(low, s, p) for p in (px, py))
            length = np.hypot(dx, dy) or 1.0
            dx, dy = dx / length, dy / length
            sign = 1.0 if at > 0.5 else -1.0
            cx, cy = cx + sign * beyond * dx, cy + sign * beyond * dy
            half = 0.28 * size * len(text)
            circles = [
                (float(cx + k * half * dx), float(cy + k * half * dy), 0.6 * size) for k in (-0.7, 0.0, 0.7)
            ]
            if self._free(circles):
                self.taken += circles
                angle = -np.degrees(np.arctan2(dy, dx))
                angle = angle - 180.0 if angle > 90.0 else angle + 180.0 if angle < -90.0 else angle
                self.figure.add_annotation(
                    x=cx / self.scale[0],
                    y=cy / self.scale[1],
                    text=text,
                    textangle=float(angle),
                    showarrow=False,
                    font={"size": size, "color": color},
                    bgcolor="rgba(255,255,255,0.85)" if not beyond else None,
                    borderpad=0,
                )
                return

    def family(
        self,
        kind: str,
        values: np.ndarray,
        name: str,
        color: str,
        width: float,
        dash: str,
        text: Callable[[float], str],
        at: float,
        beyond: float = 0.0,
        every: int = 1,
    ) -> None:
        """All lines of one quantity, every so many of them labeled."""
        first = True
        for i, value in enumerate(values):
            T, w = self.lines.line(kind, float(value))
            if len(T) < 2:
                continue
            self.curve(T, w, name, color, width, dash, legend=first)
            first = False
            if i % every == 0:
                self.label(T, w, text(float(value)), color, at, beyond=beyond)

    def hover(self) -> None:
        """Invisible points that show the full state under the pointer."""
        import plotly.graph_objects as go

        T, w, data = self.lines.grid
        x, y = self.place(T, w)
        template = (
            "<b>%{customdata[0]:.1f} °C</b><br>w %{customdata[1]:.2f} g/kg<br>φ %{customdata[2]:.1f} %<br>"
            + (
                "T<sub>h</sub> %{customdata[3]:.1f} °C<br>T<sub>r</sub> %{customdata[4]:.1f} °C<br>h "
                "%{customdata[5]:.1f} kJ/kg<br>"
            )
            + "v %{customdata[6]:.3f} m³/kg<extra></extra>"
        )
        self.figure.add_trace(
            go.Scatter(
                x=x,
                y=y,
                mode="markers",
                marker={"size": 9, "opacity": 0.0},
                customdata=data,
                hovertemplate=template,
                showlegend=False,
            )
        )

    def path(self, T: np.ndarray, w: np.ndarray) -> None:
        """The process: thick line through numbered states."""
        import plotly.graph_objects as go

        from granum.core.charts import ACCENT

        x, y = self.place(T, w)
        self.figure.add_trace(
            go.Scatter(
                x=x,
                y=y,
                mode="lines",
                line={"color": ACCENT, "width": 4},
                name=_("process"),
                hoverinfo="skip",
            )
        )
        self.figure.add_trace(
            go.Scatter(
                x=x,
                y=y,
                mode="markers+text",
                text=[f"<b>{i + 1}</b>" for i in range(len(T))],
                textfont={"color": "white", "size": 12},
                marker={"size": 21, "color": ACCENT, "line": {"color": "white", "width": 2}},
                showlegend=False,
                hoverinfo="skip",
            )
        )


def _table(figure: go.Figure, states: np.ndarray, share: float) -> None:
    """The states in rows under the chart; the columns are those of ``Isolines.states``."""
    import plotly.graph_objects as go

    heads = (
        "",
        "T / °C",
        "w / (g/kg)",
        "φ / %",
        "T<sub>h</sub> / °C",
        "T<sub>r</sub> / °C",
        "h / (kJ/kg)",
        "v / (m³/kg)",
    )
    digits = (3, 3, 3, 3, 3, 4, 4)
    columns = [[str(i + 1) for i in range(len(states))]]
    columns += [[format_number(float(v), n) for v in states[:, k]] for k, n in enumerate(digits)]
    figure.add_trace(
        go.Table(
            header={
                "values": [f"<b>{n}</b>" for n in heads],
                "fill_color": "#eef2f2",
                "line_color": "#d9dde3",
                "font": {"size": 12},
                "height": 26,
            },
            cells={
                "values": columns,
                "fill_color": "white",
                "line_color": "#d9dde3",
                "font": {"size": 12},
                "height": 24,
            },
            domain={"x": [0.0, 1.0], "y": [0.0, share]},
        )
    )


def _checked(temperature: Any, humidity_ratio: Any) -> tuple[np.ndarray, np.ndarray] | None:
    if temperature is None and humidity_ratio is None:
        return None
    if temperature is None or humidity_ratio is None or len(temperature) != len(humidity_ratio):
        raise InputError(_("The states of a process need as many temperatures as humidity ratios."))
    return np.asarray(temperature, dtype=float), np.asarray(humidity_ratio, dtype=float)


def _frame(title: str, states: Any, pair: AbstractPair, P: float) -> tuple[go.Figure, float, float]:
    """Empty figure, height of the plot in pixels, and share of the height that the table takes."""
    from granum.core.charts import figure

    rows = 0 if states is None else len(states[0])
    extra = 0 if states is None else 60 + 25 * rows
    height = HEIGHT + extra
    drawing = figure("", "", title=(f"{title} · {type(pair).card.title} · {show(P, KINDS['Pressure'])}"))  # type: ignore[attr-defined]
    share = 0.0 if states is None else (40 + 25 * rows) / (height - MARGIN["t"] - MARGIN["b"])
    drawing.update_layout(
        width=WIDTH,
        height=height,
        margin=MARGIN,
        legend={"orientation": "h", "x": 0.0, "y": 1.0, "yanchor": "bottom", "font": {"size": 11}},
        hovermode="closest",
        hoverdistance=15,
    )
    start = 0.0 if states is None else share + 70.0 / (height - MARGIN["t"] - MARGIN["b"])
    drawing.update_yaxes(domain=[start, 1.0])
    return drawing, (1.0 - start) * (height - MARGIN["t"] - MARGIN["b"]), share


def _families(sheet: _Sheet, wet_at: float, volume_at: float) -> None:
    from granum.core.charts import HEAT, INK, LIQUID, OK

    lines = sheet.lines
    humid = [p for p in (0.01, 0.02, 0.05) if lines.T_high > 353.0] + [
        0.1,
        0.2,
        0.3,
        0.4,
        0.5,
        0.6,
        0.7,
        0.8,
        0.9,
    ]
    sheet.family(
        "enthalpy",
        nice_steps(*lines.range_of("enthalpy"), 16),
        _("enthalpy kJ/kg"),
        HEAT,
        0.7,
        "solid",
        lambda h: format_number(h / 1e3, 4),
        0.0,
        beyond=16.0,
    )
    T, w = lines.line("relative_humidity", 1.0)
    sheet.label(T, w, "100 %", INK, 0.75, size=11)
    sheet.family(
        "relative_humidity",
        np.array(humid),
        _("relative humidity"),
        LIQUID,
        1.0,
        "solid",
        lambda f: f"{format_number(100 * f, 2)} %",
        0.72,
    )
    sheet.family(
        "wet_bulb_temperature",
        nice_steps(lines.T_low - ZERO_CELSIUS, lines.range_of("wet_bulb")[1] - ZERO_CELSIUS, 12)
        + ZERO_CELSIUS,
        _("wet bulb °C"),
        "#6b46c1",
        0.7,
        "dash",
        lambda T: f"{format_number(T - ZERO_CELSIUS, 3)}°",
        wet_at,
    )
    sheet.family(
        "specific_volume",
        nice_steps(*lines.range_of("specific_volume"), 10),
        _("volume m³/kg"),
        OK,
        0.8,
        "dashdot",
        lambda v: f"{format_number(v, 4)}",
        volume_at,
    )
    sheet.curve(T, w, _("saturation"), INK, 3.0, legend=True)


@chart(source="ashrae2017, ch. 1", title="Psychrometric chart")
def psychrometric_chart(
    temperature_low: Temperature | None = None,
    temperature_high: Temperature | None = None,
    humidity_ratio_high: HumidityRatio | None = None,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
    temperature: States = None,
    humidity_ratio: Humidities = None,
) -> go.Figure:
    """Psychrometric chart of Carrier's type: humidity ratio over dry-bulb temperature, with the states of a
    process if given.

    Lines of relative humidity, wet bulb, enthalpy and volume; the pointer shows the full state. Without
    limits the chart runs from −10 to 50 °C, or as far as the states need.

    >>> psychrometric_chart(
    ...     temperature=["20 degC", "60 degC", "35 degC"], humidity_ratio=[0.008, 0.008, 0.018]
    ... ).layout.xaxis.range
    (-10.0, 65.0)
    """
    from granum.core.charts import axis_title

    states = _checked(temperature, humidity_ratio)
    temperature_low, temperature_high, top = _window(
        temperature_low, temperature_high, 323.15, humidity_ratio_high, states, pair
    )
    lines = Isolines(pair, pressure, temperature_low, temperature_high, top, states)
    drawing, height, share = _frame(_("Psychrometric chart"), states, pair, pressure)
    x, y = (temperature_low - ZERO_CELSIUS, temperature_high - ZERO_CELSIUS), (0.0, 1e3 * top)
    sheet = _Sheet(drawing, lines, lambda T, w: (T - ZERO_CELSIUS, 1e3 * w), x, y, height)
    drawing.update_xaxes(range=list(x), title=axis_title("temperature", "degC"), nticks=14, showgrid=True)
    drawing.update_yaxes(range=list(y), title=axis_title("humidity_ratio", "g/kg"), side="right", nticks=13)
    if states is not None:
        sheet.reserve(*states)
    _families(sheet, 0.8, 0.9)
    sheet.hover()
    if states is not None:
        sheet.path(*states)
        _table(drawing, lines.states, share)
    return drawing


@chart(source="mollier1923; ramzin1927", title="Mollier–Ramzin chart")
def mollier_chart(
    temperature_low: Temperature | None = None,
    temperature_high: Temperature | None = None,
    humidity_ratio_high: HumidityRatio | None = None,
    pressure: Pressure = STANDARD_ATMOSPHERE,
    pair: GasVaporPair = AIR_WATER,
    temperature: States = None,
    humidity_ratio: Humidities = None,
) -> go.Figure:
    """Oblique enthalpy chart of Mollier and Ramzin: the isotherm of 0 °C is level, lines of constant enthalpy
    fall to the right.

    The ordinate is enthalpy less the heat of vaporization at 0 °C times humidity, so heating is a vertical
    and mixing a straight line.

    >>> mollier_chart().layout.xaxis.range
    (0.0, 30.0)
    """
    from granum.core.charts import INK, axis_title

    states = _checked(temperature, humidity_ratio)
    temperature_low, temperature_high, top = _window(
        temperature_low, temperature_high, 333.15, humidity_ratio_high, states, pair
    )
    lines = Isolines(pair, pressure, temperature_low, temperature_high, top, states)
    zero = (
        float(
            lines.enthalpy(np.array([ZERO_CELSIUS]), np.array([1e-3]))[0]
            - lines.enthalpy(np.array([ZERO_CELSIUS]), np.array([0.0]))[0]
        )
        * 1e3
    )

    def place(T: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return 1e3 * np.asarray(w), (
            lines.enthalpy(np.asarray(T), np.asarray(w)) - zero * np.asarray(w)
        ) / 1e3

    drawing, height, share = _frame(_("Mollier–Ramzin chart"), states, pair, pressure)
    low, high = (
        float(place(np.array([T]), np.array([0.0]))[1][0]) for T in (temperature_low, temperature_high)
    )
    x, y = (0.0, 1e3 * top), (low, high)
    sheet = _Sheet(drawing, lines, place, x, y, height)
    ticks = nice_steps(temperature_low - ZERO_CELSIUS, temperature_high - ZERO_CELSIUS, 14)
    at = [float(place(np.array([t + ZERO_CELSIUS]), np.array([0.0]))[1][0]) for t in ticks]
    drawing.update_xaxes(range=list(x), title=axis_title("humidity_ratio", "g/kg"), nticks=16)
    drawing.update_yaxes(
        range=list(y),
        title=axis_title("temperature", "degC"),
        tickvals=at,
        ticktext=[format_number(t, 3) for t in ticks],
        showgrid=False,
    )
    if states is not None:
        sheet.reserve(*states)
    fine = nice_steps(temperature_low - ZERO_CELSIUS, temperature_high - ZERO_CELSIUS, 28)
    first = True
    for t in fine:
        T, w = lines.line("temperature", t + ZERO_CELSIUS)
        sheet.curve(
            T, w, _("temperature °C"), "#8a94a3", 0.9 if np.isclose(t, ticks).any() else 0.4, legend=first
        )
        first = False
        if np.isclose(t, ticks).any():
            sheet.label(T, w, f"{format_number(t, 3)}°", INK, 0.35)
    _families(sheet, 0.55, 0.25)
    sheet.hover()
    if states is not None:
        sheet.path(*states)
        _table(drawing, lines.states, share)
    return drawing
