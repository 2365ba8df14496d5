"""How each arm outside the gallery is solved: ``tests/ways.txt``, a line an arm, with a checksum of all its formulas.

``generated/`` holds every byte of the gallery; these arms need what no robot of the gallery needs (polynomials of
degree four, slides between turns, locked joints). After a change that is meant: ``python -m tests.ways``, then read
the difference.
"""

from __future__ import annotations

import zlib
from pathlib import Path

from tests.arms import FRAMED, LOCKED, SHAPES, derivation

FILE = Path(__file__).resolve().parent / "ways.txt"
ARMS = (*SHAPES, *LOCKED, FRAMED)


def way(name: str) -> str:
    """The steps of an arm in order and the checksum of its plan."""
    plan = derivation(name).plan
    steps = ", ".join(f"{step.unknown} {step.rule}" for step in plan.steps)
    return f"{name} {zlib.crc32(repr(plan).encode()):08x}: {plan.task.value}, {plan.maximum} solutions: {steps}"


def ways() -> dict[str, str]:
    """The lines of the file by arm."""
    return {line.partition(" ")[0]: line for line in FILE.read_text(encoding="utf-8").splitlines()}


if __name__ == "__main__":
    FILE.write_text("".join(f"{way(name)}\n" for name in ARMS), encoding="utf-8", newline="\n")
