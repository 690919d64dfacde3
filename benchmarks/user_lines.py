"""Lines as users write them, one case file each: what the first and the second ``granum run`` cost.

    python -m benchmarks.user_lines [--samples 100]

With ``--samples`` a study of as many cases follows, in which one feed temperature of the line varies.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import tomllib
from pathlib import Path

from benchmarks.commands import GRANUM, ROOT, Cost, cost, empty_cache
from benchmarks.rows import Row, tell

LINES = ROOT / "benchmarks" / "lines"


def handed(question: str, found: Cost) -> None:
    """The row of one run."""
    tell(Row(question, found.processor, kind="line", figures=found.figures))


def study(case: Path) -> str:
    """A study file in which the temperature of the first feed is uncertain by a kelvin: all that leaves."""
    told = tomllib.loads(case.read_text(encoding="utf-8"))
    feed, given = next(iter(told["feeds"].items()))
    products = [f"{name}.mass_flow" for name, ends in told["streams"].items() if len(ends) == 1]
    value, unit = given["temperature"].split()
    span = f'lower = "{value} {unit}", upper = "{float(value) + 1.0} {unit}"'
    return f'''
case = "{case.as_posix()}"

[uncertain]
"{feed}.temperature" = {{ distribution = "uniform", {span} }}

[study.spread]
kind = "monte_carlo"
outputs = {json.dumps(products)}
'''


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    options.add_argument(
        "--samples", type=int, default=0, help="cases of a study that follows; none by default"
    )
    samples = options.parse_args().samples
    for case in sorted(LINES.glob("*.toml")):
        with empty_cache() as environment, tempfile.TemporaryDirectory() as folder:
            for turn in ("first", "second"):
                handed(f"{case.stem}, {turn} run", cost([*GRANUM, "run", str(case)], environment))
            if samples:
                file = Path(folder) / "study.toml"
                file.write_text(study(case), encoding="utf-8")
                words = ["study", str(file), "--samples", str(samples)]
                handed(f"{case.stem}, {samples} cases", cost([*GRANUM, *words], environment))


if __name__ == "__main__":
    main()
