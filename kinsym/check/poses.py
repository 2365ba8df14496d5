"""Where the checks look: joint vectors chosen on purpose, not only at random.

A solver fails next to singular poses and at the border of the workspace, so most samples lie there: joints at 0,
±pi/2 and pi and next to them, and joints placed where the volume of the task's Jacobian vanishes,
exactly and at distances 10^-3 .. 10^-16. The generator is seeded by the robot's digest: same robot, same poses.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from kinsym.check.singular import Volume, zeros
from kinsym.emit.schedule import JointName, Parameter

Floats = NDArray[np.float64]

UNIFORM = "uniform"
QUARTER = "quarter turns"
SINGULAR = "singular"
PAIR = "two at once"
KINDS = (UNIFORM, QUARTER, SINGULAR, PAIR)

DISTANCES = (0.0, *(10.0**-k for k in range(3, 17)))


@dataclass(frozen=True, kw_only=True)
class Samples:
    """Joint vectors of shape (m, n) and, for each, the index of its kind in :data:`KINDS`."""

    q: Floats
    kind: NDArray[np.intp]

    def of(self, *kinds: str) -> NDArray[np.bool_]:
        """A mask of the samples of some kinds."""
        return np.isin(self.kind, [KINDS.index(kind) for kind in kinds])


@dataclass(frozen=True, kw_only=True)
class Counts:
    """How many samples of each kind one choice of parameters gets."""

    uniform: int
    quarter: int
    singular: int
    pair: int


def generator(digest: str, draw: int) -> np.random.Generator:
    """The random numbers of one choice of parameters."""
    return np.random.Generator(np.random.PCG64([int(digest[:16], 16), draw]))


def draws(parameters: tuple[Parameter, ...], digest: str, count: int) -> list[dict[str, Fraction]]:
    """Choices of the parameters: the table's values first, then values near them or, where none is given, 0.1 .. 1.

    A parameter keeps the sign of its value in the table; zero stays zero.
    """
    chosen = []
    for draw in range(count if parameters else 1):
        rng = generator(digest, 1000 + draw)
        values = {}
        for parameter in parameters:
            factor = Fraction(int(rng.integers(500, 1501)), 1000)
            free = Fraction(int(rng.integers(100, 1001)), 1000)
            given = parameter.value
            values[parameter.name] = free if given is None else given * (factor if draw else 1)
        chosen.append(values)
    return chosen


def samples(
    joints: tuple[JointName, ...], volume: Volume, size: float, counts: Counts, rng: np.random.Generator
) -> Samples:
    """Joint vectors of every kind; ``volume`` maps (m, n) joint vectors to the task's :func:`volume_of` (m,)."""
    revolute = np.array([joint.kind == "R" for joint in joints])
    reach = size if size > 0 else 1.0
    parts = [
        uniform(revolute, reach, counts.uniform, rng),
        _quarter_turns(revolute, reach, counts.quarter, rng),
        _singular(revolute, reach, volume, counts.singular, rng),
        _pairs(revolute, reach, volume, counts.pair, rng),
    ]
    kind = np.concatenate([np.full(len(part), index) for index, part in enumerate(parts)])
    return Samples(q=wrapped(np.concatenate(parts), revolute), kind=kind)


def uniform(revolute: NDArray[np.bool_], reach: float, count: int, rng: np.random.Generator) -> Floats:
    """Angles in (-pi, pi], lengths in (-reach, reach)."""
    return rng.uniform(-1.0, 1.0, (count, len(revolute))) * np.where(revolute, np.pi, reach)


def wrapped(q: Floats, revolute: NDArray[np.bool_]) -> Floats:
    """Angles brought into (-pi, pi], lengths as they are; shape (..., n)."""
    turned = q - 2 * np.pi * np.ceil((q - np.pi) / (2 * np.pi))
    return np.where(revolute, turned, q)


def _quarter_turns(revolute: NDArray[np.bool_], reach: float, count: int, rng: np.random.Generator) -> Floats:
    """One joint at 0, ±pi/2 or pi (a length at 0) or next to it, the others anywhere."""
    q = uniform(revolute, reach, count, rng)
    for row in range(count):
        joint = row % len(revolute)
        turn = row // len(revolute)
        q[row, joint] = _turn(bool(revolute[joint]), turn) + _distance(turn // 4, rng)
    return q


def _singular(
    revolute: NDArray[np.bool_], reach: float, volume: Volume, count: int, rng: np.random.Generator
) -> Floats:
    """Joint vectors at and next to zeros of ``volume``."""
    found, moved, _ = zeros(uniform(revolute, reach, max(4, count // 12), rng), revolute, reach, volume)
    if not len(found):
        return found
    order = rng.permutation(len(found))
    pick = order[np.arange(count) % len(found)]
    q = found[pick].copy()
    for row, joint in enumerate(moved[pick]):
        q[row, joint] += _distance(row, rng) * (1.0 if revolute[joint] else reach)
    return q


def _pairs(revolute: NDArray[np.bool_], reach: float, volume: Volume, count: int, rng: np.random.Generator) -> Floats:
    """Zeros of ``volume`` while another joint is at, or next to, a quarter turn.

    The search runs at 10^-4 from the quarter turn: on it the volume may be zero whatever the others do.
    """
    base = uniform(revolute, reach, max(4, count // 4), rng)
    held = rng.integers(0, len(revolute), len(base))
    exact = np.array([_turn(bool(revolute[joint]), int(rng.integers(4))) for joint in held])
    base[np.arange(len(base)), held] = exact + 1e-4
    found, moved, start = zeros(base, revolute, reach, volume)
    if not len(found):
        return found
    pick = rng.integers(0, len(found), count)
    q = found[pick].copy()
    for row, source in enumerate(pick):
        line = start[source]
        if held[line] != moved[source]:
            q[row, held[line]] = exact[line] + _distance(int(rng.integers(len(DISTANCES))), rng)
        if rng.integers(2):
            q[row, moved[source]] += _distance(int(rng.integers(len(DISTANCES))), rng)
    return q


def _turn(revolute: bool, quarter: int) -> float:
    return (0.0, np.pi / 2, np.pi, -np.pi / 2)[quarter % 4] if revolute else 0.0


def _distance(step: int, rng: np.random.Generator) -> float:
    distance = DISTANCES[step % len(DISTANCES)]
    return distance * float(rng.uniform(1.0, 3.0)) * float(rng.choice((-1.0, 1.0)))
