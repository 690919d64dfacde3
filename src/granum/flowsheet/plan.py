"""The order of calculation: which units form a loop, which streams are torn. Depends on the connections
only.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import rustworkx as rx


class Link(NamedTuple):
    """A named stream. ``origin`` is ``unit.port`` or empty for a feed; ``target`` is ``unit.port`` or empty
    for a product.
    """

    name: str
    origin: str
    target: str

    @property
    def source_unit(self) -> str:
        """Unit it leaves, empty for a feed."""
        return self.origin.partition(".")[0]

    @property
    def target_unit(self) -> str:
        """Unit it enters, empty for a product."""
        return self.target.partition(".")[0]


@dataclass(frozen=True)
class Block:
    """Units solved together: one unit, or a loop with its torn streams."""

    units: tuple[str, ...]
    tears: tuple[str, ...]


@lru_cache(maxsize=256)
def plan(units: tuple[str, ...], links: tuple[Link, ...]) -> tuple[Block, ...]:
    """Blocks in order of calculation.

    Inside a loop the order with the fewest torn streams is taken among the declared order and depth-first
    orders from each unit, the declared order winning ties so that the author of a case decides.
    """
    rank = {unit: i for i, unit in enumerate(units)}
    joined = [(k.source_unit, k.target_unit) for k in links if k.origin and k.target]
    graph = rx.PyDiGraph()
    graph.add_nodes_from(units)
    graph.add_edges_from_no_data([(rank[a], rank[b]) for a, b in joined])
    groups = rx.digraph_condensation(graph)

    def declared_first(members: list[str]) -> str:
        return f"{min(map(rank.__getitem__, members)):09}"

    blocks = []
    for group in rx.lexicographical_topological_sort(groups, declared_first):
        members = sorted(group, key=rank.__getitem__)
        inner = [
            k
            for k in links
            if k.source_unit in members and k.target_unit in members and k.origin and k.target
        ]
        orders = [members] + [_depth_first(inner, start) for start in members]
        order = min(orders, key=lambda o: len(_backward(o, inner)))
        blocks.append(Block(tuple(order), tuple(_backward(order, inner))))
    return tuple(blocks)


def returning(blocks: tuple[Block, ...], links: tuple[Link, ...]) -> set[str]:
    """Streams that come back in a drawing, which begins each loop where something enters it: those that are
    torn, unless the calculation begins the loop elsewhere.
    """
    back: set[str] = set()
    for block in blocks:
        inside = set(block.units)
        entered = [
            u for u in block.units if any(k.target_unit == u and k.source_unit not in inside for k in links)
        ]
        if not block.tears or not entered or block.units[0] in entered:
            back.update(block.tears)
            continue
        inner = [k for k in links if k.origin and k.target and {k.source_unit, k.target_unit} <= inside]
        orders = [_depth_first(inner, start) for start in entered]
        back.update(min((_backward(order, inner) for order in orders), key=len))
    return back


def _depth_first(links: list[Link], start: str) -> list[str]:
    """Units that can be reached, each before what is found beyond it only."""
    finished: list[str] = []
    seen: set[str] = set()

    def visit(unit: str) -> None:
        seen.add(unit)
        for k in links:
            if k.source_unit == unit and k.target_unit not in seen:
                visit(k.target_unit)
        finished.append(unit)

    visit(start)
    return finished[::-1]


def _backward(order: list[str], links: list[Link]) -> list[str]:
    place = {unit: i for i, unit in enumerate(order)}
    return [k.name for k in links if place[k.source_unit] >= place[k.target_unit]]
