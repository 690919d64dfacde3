"""Streams as tables with labels: pandas, and xarray where size classes and times count too."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from granum.core.parameters import Parameter
from granum.streams.stream import Stream, median_size

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

PHASES = {"solid": "solids", "liquid": "liquids", "gas": "gases"}


def attributes(p: Parameter) -> dict[str, str]:
    """What a labelled array says of a figure."""
    return {"units": p.kind.unit if p.kind else "", "long_name": p.label}


def _flows(stream: Stream) -> dict[str, Any]:
    """Mass flow of every species, ``phase.name``, kg/s; leading axes are kept."""
    found = {"solid": _by_size(stream).sum(axis=-1), "liquid": stream.liquid, "gas": stream.gas}
    return {
        f"{phase}.{species.name}": np.asarray(found[phase])[..., i]
        for phase, plural in PHASES.items()
        for i, species in enumerate(getattr(stream.mixture, plural))
    }


def _by_size(stream: Stream) -> np.ndarray:
    """Solid by species and size class, summed over further axes; leading axes are kept."""
    m = stream.mixture
    return (
        np.asarray(stream.solid)
        .reshape(*np.shape(stream.temperature), len(m.solids), len(m.sizes), -1)
        .sum(axis=-1)
    )


def stream_frame(streams: Mapping[str, Stream]) -> pd.DataFrame:
    """One row a stream, SI."""
    import pandas as pd

    rows = {
        name: {word: float(getattr(s, word)) for word in ("temperature", "pressure")}
        | {species: float(flow) for species, flow in _flows(s).items()}
        | {"median_size": median_size(s)}
        for name, s in streams.items()
    }
    return pd.DataFrame.from_dict(rows, orient="index").rename_axis("stream")


def stream_dataset(streams: Mapping[str, Stream], times: Any = None) -> xr.Dataset:
    """Mass flow by species, solid by species and size class, temperature and pressure of every stream, SI;
    along ``time`` where times are given.
    """
    import xarray as xr

    lead = () if times is None else ("time",)
    mixture = next(iter(streams.values())).mixture
    flows = {
        name: np.stack([_flows(s)[name] for s in streams.values()])
        for name in _flows(next(iter(streams.values())))
    }
    states = {
        w: np.stack([np.asarray(getattr(s, w), dtype=float) for s in streams.values()])
        for w in ("temperature", "pressure")
    }
    made = xr.Dataset(
        {
            "mass_flow": (("species", "stream", *lead), np.stack(list(flows.values())), {"units": "kg/s"}),
            "solid_by_size": (
                ("stream", *lead, "solid", "size"),
                np.stack([_by_size(s) for s in streams.values()]),
                {"units": "kg/s"},
            ),
            "temperature": (("stream", *lead), states["temperature"], {"units": "K"}),
            "pressure": (("stream", *lead), states["pressure"], {"units": "Pa"}),
        },
        {
            "stream": list(streams),
            "species": list(flows),
            "solid": [species.name for species in mixture.solids],
            "size": (
                "size",
                np.asarray(mixture.sizes),
                {"units": "m", "long_name": "middle of the size class"},
            ),
        },
    )
    return made if times is None else made.assign_coords(time=("time", np.asarray(times), {"units": "s"}))
