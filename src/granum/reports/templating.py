"""Templates of the reports, filled: whole pages that need nothing but themselves."""

from __future__ import annotations

import base64
from functools import cache
from importlib.resources import files
from typing import Any

from granum.core.i18n import _, current_language
from granum.streams.names import pretty


def page(template: str, **content: Any) -> str:
    """The HTML of a report."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("granum.reports"), autoescape=True, undefined=StrictUndefined, trim_blocks=True
    )
    environment.filters["pretty"] = pretty
    return environment.get_template(template).render(
        _=_, lang=current_language(), letters=_letters, **content
    )


@cache
def _letters() -> str:
    """A font for mathematics, as the app has it: without one a root stands over a numerator alone."""
    place = files("granum") / "app" / "static" / "vendor" / "stix-two-math.woff2"
    return f"data:font/woff2;base64,{base64.b64encode(place.read_bytes()).decode()}"
