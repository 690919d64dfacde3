"""What the app holds in memory after every card was opened, and after thousands of requests more.

    python -m benchmarks.app_memory --requests 5000 [--cards 60]

Opens each formula, procedure and chart with the values its page begins with, and solves and draws each piece
of equipment. The server must stay below 600 MB and each of its worker processes below 400 MB once it has
rested; of the further requests, the second half must not add more than a twentieth.
"""

from __future__ import annotations

import argparse
import random
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import httpx

from benchmarks.rows import Row, tell
from granum.app.jobs import REST
from granum.app.wear import resident

SERVER, WORKER = 600e6, 400e6  # bytes
GROWTH = 0.05
OPENED = ("formula", "procedure", "chart", "equipment")


def children(process: int) -> list[int]:
    """Processes that a process started."""
    threads = Path(f"/proc/{process}/task").glob("*/children")
    return sorted({int(word) for place in threads for word in place.read_text().split()})


def first_values(card: dict[str, Any]) -> dict[str, str] | None:
    """What a page fills in; None where it would ask first."""
    values = {
        p["name"]: f"{p['example']['number']} {p['example']['unit']}".strip()
        for p in card["parameters"]
        if p["example"]
    }
    return None if any(p["required"] and p["name"] not in values for p in card["parameters"]) else values


def visit(
    client: httpx.Client, key: str, opened: dict[str, tuple[str, dict[str, str]]], equipment: bool
) -> None:
    """Open a card as its page does; equipment as after an edit, since its page opens with an answer that was
    kept.
    """
    if equipment:
        case = client.post(f"/api/alone/{key}", json={}).json()["case"] + "\n"
        for task in ("run", "inside"):
            client.post(f"/api/{task}", json={"case": case})
        return
    card = client.get(f"/api/cards/{key}").json()
    values = first_values(card)
    if values is not None:
        kind = "chart" if card["sort"] == "chart" else "calc"
        if client.post(f"/api/{kind}/{key}", json=values).status_code == 200 and kind == "calc":
            opened[key] = kind, values


def figures(process: int) -> dict[str, str]:
    """Memory of the server and its workers, in words."""
    workers = [f"{resident(child) / 1e6:.0f} MB" for child in children(process)]
    return {"server": f"{resident(process) / 1e6:.0f} MB", "workers": ", ".join(workers)}


def soak(client: httpx.Client, process: int, cards: int, requests: int) -> int:
    """The whole visit; gives the exit status."""
    listed = client.get("/api/cards").json()["cards"]
    keys = [c["card"] for c in listed if c["sort"] in OPENED]
    equipment = {c["card"] for c in listed if c["sort"] == "equipment"}
    opened: dict[str, tuple[str, dict[str, str]]] = {}
    random.Random(2).shuffle(keys)  # as people come by, not domain after domain
    most, worked, start = 0.0, [0.0], time.perf_counter()
    for count, key in enumerate(keys[: cards or None], 1):
        visit(client, key, opened, key in equipment)
        most = max(most, resident(process))
        if key in equipment:
            worked.append(max((resident(child) for child in children(process)), default=0.0))
        if count % 100 == 0:
            print(f"  {count} cards, {time.perf_counter() - start:.0f} s: {figures(process)}", flush=True)
    tell(
        Row(
            "every card opened once",
            time.perf_counter() - start,
            kind="server",
            figures={
                "cards": str(count),
                "most": f"{most / 1e6:.0f} MB",
                "of a worker after work, median and most": f"{sorted(worked)[len(worked) // 2] / 1e6:.0f}, "
                f"{max(worked) / 1e6:.0f} MB",
            }
            | figures(process),
        )
    )
    draw, sizes = random.Random(1), []
    start = time.perf_counter()
    for number in range(requests):
        key = draw.choice(list(opened))
        kind, values = opened[key]
        client.post(f"/api/{kind}/{key}", json=values)
        if number % max(requests // 10, 1) == 0:
            sizes.append(resident(process))
            print(f"  {number} requests: {sizes[-1] / 1e6:.0f} MB", flush=True)
    sizes.append(resident(process))
    half = max(sizes[: len(sizes) // 2 + 1])
    growth = max(sizes[len(sizes) // 2 :]) / half - 1.0
    time.sleep(REST + 5.0)
    held = [resident(child) for child in children(process)]
    tell(
        Row(
            f"{requests} requests more",
            time.perf_counter() - start,
            kind="server",
            figures={"growth of the second half": f"{100 * growth:.1f} %"} | figures(process),
        )
    )
    good = resident(process) < SERVER and max(held, default=0.0) < WORKER and growth < GROWTH
    if not good:
        print("more memory than allowed", file=sys.stderr)
    return 0 if good else 1


def main() -> int:
    """Start a server, open everything, stop the server."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--requests", type=int, default=5000)
    words.add_argument("--cards", type=int, default=0, help="only so many; all when not given")
    options = words.parse_args()
    command = [sys.executable, "-m", "granum.cli", "app", "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            address = next(word for word in server.stdout.readline().split() if word.startswith("http"))
            with httpx.Client(base_url=address, timeout=300.0) as client:
                return soak(client, server.pid, options.cards, options.requests)
        finally:
            server.terminate()


if __name__ == "__main__":
    raise SystemExit(main())
