"""Equipment symbols in the manner of ISO 10628, drawn once in a 60 × 60 box and used in diagrams, lists and
reports.
"""

from __future__ import annotations

_BOX = '<rect x="4" y="10" width="52" height="40" rx="2"/>'
_VESSEL = '<path d="M12 12 h36 v32 a18 8 0 0 1 -36 0 z"/>'

SYMBOLS: dict[str, str] = {
    "mixer": '<path d="M8 10 L48 30 L8 50 z"/>',
    "splitter": '<path d="M52 10 L12 30 L52 50 z"/>',
    "heater": '<circle cx="30" cy="30" r="20"/><path d="M8 30 h14 l6 -10 l6 20 l6 -10 h12" fill="none"/>',
    "crystallizer": _VESSEL + '<path d="M30 4 v28 M20 32 l10 -5 l10 5 M20 32 l10 5 l10 -5" fill="none"/>',
    "thickener": '<path d="M4 16 h52 v12 l-20 16 h-12 l-20 -16 z"/><path d="M30 10 v28 M14 30 l16 8 l16 -8" fill="none"/>',  # noqa: E501
    "hydrocyclone": '<path d="M16 10 h28 v14 l-11 28 h-6 l-11 -28 z"/><path d="M30 4 v14 M4 14 h12" fill="none"/>',  # noqa: E501
    "cyclone": '<path d="M16 10 h28 v16 l-10 26 h-8 l-10 -26 z"/><path d="M30 4 v14 M4 14 h12" fill="none"/>',
    "filter": _BOX + '<path d="M4 50 L56 10" fill="none" stroke-dasharray="4 3"/>',
    "drum_filter": '<circle cx="30" cy="28" r="22"/><circle cx="30" cy="28" r="17" fill="none" stroke-dasharray="4 3"/>'  # noqa: E501
    '<path d="M4 44 a28 16 0 0 0 52 0" fill="none"/>',
    "centrifuge": '<path d="M10 12 h40 v36 h-40 z"/><path d="M18 20 v20 h24 v-20" fill="none" stroke-dasharray="4 3"/><path d="M30 40 v14" fill="none"/>',  # noqa: E501
    "dryer": '<rect x="2" y="16" width="56" height="28" rx="3"/><path d="M14 36 q4 -5 0 -10 M30 36 q4 -5 0 -10 M46 36 q4 -5 0 -10" fill="none"/>',  # noqa: E501
    "screen": _BOX + '<path d="M4 18 L56 42" fill="none" stroke-dasharray="5 3"/>',
    "mill": '<circle cx="30" cy="30" r="21"/><circle cx="22" cy="38" r="4"/><circle cx="31" cy="42" r="4"/><circle cx="39" cy="37" r="4"/>',  # noqa: E501
    "crusher": '<path d="M6 10 h48 l-14 40 h-20 z"/><path d="M24 12 l6 34 l6 -34" fill="none"/>',
    "settler": '<path d="M4 16 h52 v22 l-10 10 h-42 z"/><path d="M4 22 h52" fill="none" stroke-dasharray="3 3"/>',  # noqa: E501
    "fluidized_bed": '<path d="M14 8 h32 v44 h-32 z"/><path d="M14 40 h32" fill="none" stroke-dasharray="3 2"/>'  # noqa: E501
    '<circle cx="24" cy="30" r="2"/><circle cx="33" cy="24" r="2"/><circle cx="37" cy="33" r="2"/>',
    "vessel": _VESSEL + '<path d="M30 4 v30 M20 34 h20" fill="none"/>',
    "burner": _BOX
    + '<path d="M30 44 q-12 -8 -2 -18 q2 6 5 4 q2 -6 -1 -10 q14 8 8 18 q-2 5 -10 6 z" fill="none"/>',
    "humidifier": '<path d="M14 10 h32 v40 h-32 z"/><path d="M20 18 l4 8 M30 18 v8 M40 18 l-4 8 M20 32 l4 8 M30 32 v8 M40 32 l-4 8" fill="none"/>',  # noqa: E501
    "pipe": '<path d="M2 24 h56 v12 h-56 z"/><circle cx="14" cy="30" r="2"/><circle cx="28" cy="28" r="2"/><path d="M38 30 h12 M46 26 l5 4 l-5 4" fill="none"/>',  # noqa: E501
    "pump": '<circle cx="30" cy="30" r="20"/><path d="M20 13 L50 30 L20 47" fill="none"/>',
    "evaporator": '<path d="M18 6 h24 v34 q0 14 -12 14 q-12 0 -12 -14 z"/><path d="M18 32 l6 -5 l6 5 l6 -5 l6 5 M26 20 q3 -4 0 -8 M34 20 q3 -4 0 -8" fill="none"/>',  # noqa: E501
    "scrubber": '<path d="M16 6 h28 v48 h-28 z"/><path d="M30 6 v18 M30 14 l-8 8 M30 14 l8 8" fill="none"/><path d="M16 44 h28" fill="none" stroke-dasharray="3 3"/>',  # noqa: E501
    "dust_filter": '<path d="M10 6 h40 v30 l-20 18 l-20 -18 z"/><path d="M18 12 v22 M26 12 v24 M34 12 v24 M42 12 v22" fill="none"/>',  # noqa: E501
    "fan": '<circle cx="30" cy="30" r="20"/><path d="M16 16 L48 24 M16 44 L48 36" fill="none"/>',
}

# which words of a model key lead to which symbol; the first that fits wins
_WORDS = (
    ("centrifuges.", "centrifuge"),
    ("hydrocyclone", "hydrocyclone"),
    ("gas_cyclone", "cyclone"),
    ("crystallization.", "crystallizer"),
    ("drying.burner", "burner"),
    ("drying.", "dryer"),
    ("drum", "drum_filter"),
    ("filtration.", "filter"),
    ("thickener", "thickener"),
    ("clarifier", "thickener"),
    ("settling.", "settler"),
    ("screen", "screen"),
    ("crusher", "crusher"),
    ("mill", "mill"),
    ("fluidization.", "fluidized_bed"),
    ("conveying.", "pipe"),
    ("evaporation.", "evaporator"),
    ("scrubber", "scrubber"),
    ("spray_tower", "scrubber"),
    ("bag_filter", "dust_filter"),
    ("electrostatic", "dust_filter"),
    ("pump", "pump"),
    ("humidifier", "humidifier"),
    ("heater", "heater"),
    ("cooler", "heater"),
    ("coil", "heater"),
    ("fan", "fan"),
    ("mixer", "mixer"),
    ("splitter", "splitter"),
    ("tank", "vessel"),
    ("agglomerator", "vessel"),
)


def _named(model: str) -> str:
    return next((symbol for word, symbol in _WORDS if word in model), "")


def symbol_of(model: str) -> str:
    """The inner SVG of the symbol for a model key such as ``filtration.drum_filter``; a plain box when none
    fits.
    """
    return SYMBOLS.get(_named(model), _BOX)


def word_of(model: str) -> str:
    """One word for a piece of equipment, which names it in a line.

    >>> word_of("filtration.horizontal_belt_filter"), word_of("streams.stirred_tank")
    ('filter', 'vessel')
    """
    symbol, own = _named(model), model.rpartition(".")[2]
    if any(word in own for word in ("cooler", "coil")):
        return "cooler"
    return (own if symbol in _SHARED else _SHORT.get(symbol, symbol)).replace("_", " ")


_SHORT = {"drum_filter": "filter"}
_SHARED = frozenset(("", "scrubber", "dust_filter"))  # what stands for several that are called otherwise
