"""A class of students at one server: many users who calculate at the same time, on the loopback address.

    python -m benchmarks.app_load --users 200 --seconds 20

Each user changes a value, waits for the answer, thinks for a second, and starts again. Hands over
the 95th percentile, and how many answers came and were lost.
"""

from __future__ import annotations

import argparse
import asyncio
import random
import subprocess
import sys
import time

import httpx

from benchmarks.rows import Row, spelled, tell

SPHERE = {"particle_density": "2630 kg/m3", "fluid_density": "1020 kg/m3", "dynamic_viscosity": "1.2 cP"}
CARDS = {
    "particles.terminal_velocity": SPHERE,
    "particles.terminal_velocity_stokes": SPHERE,
    "filtration.cake_resistance_kozeny_carman": {"void_fraction": "0.38", "solid_density": "2630 kg/m3"},
    "porous.pressure_gradient_ergun": {
        "superficial_velocity": "1 mm/s",
        "void_fraction": "0.4",
        "fluid_density": "998 kg/m3",
        "dynamic_viscosity": "1 cP",
    },
    "porous.permeability_carman": {"void_fraction": "0.4"},
    "fluidization.minimum_fluidization_velocity_wen_yu": SPHERE,
}
"""Cards whose particle diameter the users change."""


async def user(
    client: httpx.AsyncClient, number: int, until: float, times: list[float], lost: list[str]
) -> None:
    """One user until the end: a value, an answer, a second of thought."""
    draw = random.Random(number)
    await asyncio.sleep(draw.random())
    while time.monotonic() < until:
        card, inputs = draw.choice(list(CARDS.items()))
        if draw.random() < 0.1:  # now and then another card is opened
            await client.get(f"/api/cards/{card}")
        start = time.perf_counter()
        try:
            answer = await client.post(
                f"/api/calc/{card}", json=inputs | {"particle_diameter": f"{draw.uniform(20, 200):.3g} um"}
            )
            if answer.status_code == 200:
                times.append(time.perf_counter() - start)
            else:
                lost.append(f"{answer.status_code} {answer.text[:120]}")
        except httpx.HTTPError as problem:
            lost.append(repr(problem))
        await asyncio.sleep(draw.uniform(0.5, 1.5))


async def crowd(address: str, users: int, seconds: float) -> int:
    """All users at once; gives the exit status."""
    limits = httpx.Limits(max_connections=users, max_keepalive_connections=users)
    times: list[float] = []
    lost: list[str] = []
    async with httpx.AsyncClient(base_url=address, limits=limits, timeout=60.0) as client:
        for card, inputs in CARDS.items():  # the first call of each card compiles
            (
                await client.post(f"/api/calc/{card}", json=inputs | {"particle_diameter": "85 um"})
            ).raise_for_status()
        until = time.monotonic() + seconds
        await asyncio.gather(*(user(client, number, until, times, lost) for number in range(users)))
    times.sort()
    median, p95 = times[len(times) // 2], times[int(len(times) * 0.95)]
    tell(
        Row(
            f"an answer to {users} users, 95th percentile",
            p95,
            kind="server",
            figures={"median": spelled(median), "answers": str(len(times)), "lost": str(len(lost))},
        )
    )
    for reason in sorted(set(lost))[:5]:
        print("  lost:", reason)
    if not lost and p95 <= 1.0:
        return 0
    print(f"{len(lost)} answers lost, 95th percentile {spelled(p95)}: none and 1 s allowed", file=sys.stderr)
    return 1


def main() -> int:
    """Start a server, send the crowd, stop the server."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--users", type=int, default=200)
    words.add_argument("--seconds", type=float, default=20.0)
    options = words.parse_args()
    command = [sys.executable, "-m", "granum.cli", "app", "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            address = next(word for word in server.stdout.readline().split() if word.startswith("http"))
            return asyncio.run(crowd(address, min(options.users, 1000), min(options.seconds, 120.0)))
        finally:
            server.terminate()


if __name__ == "__main__":
    raise SystemExit(main())
