"""Where the checks look: joint vectors chosen on purpose, not only at random.

A solver fails next to singular poses and at the border of the workspace, so most samples lie there: joints at 0,
±pi/2 and pi and next to them, and joints placed where the volume of the task's Jacobian vanishes,
exactly and at distances 10^-3 .. 10^-16. The generator is seeded by the robot's digest: same robot, same poses.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from kinsym.check.evaluate import compiled, floating
from kinsym.check.singular import Volume, zeros
from kinsym.emit.schedule import JointName, Parameter, Schedule
from kinsym.robot.model import Robot

Floats = NDArray[np.float64]

UNIFORM = "uniform"
QUARTER = "quarter turns"
SINGULAR = "singular"
PAIR = "two at once"
NOMINAL = "singular for the nominal arm"
_Aimed = tuple[Floats, Floats]
_TURNS = np.array((0.0, np.pi / 2, np.pi, -np.pi / 2))

KINDS = (UNIFORM, QUARTER, SINGULAR, PAIR, NOMINAL)

#: Where the sequence of random numbers for parameters begins; poses of choice k use sequence k.
PARAMETERS = 1000
DISTANCES = (0.0, *(10.0**-k for k in range(3, 17)))


@dataclass(frozen=True, kw_only=True)
class Samples:
    """Joint vectors of shape (m, n), for each the index of its kind in :data:`KINDS` and how far it is from the
    special value that was aimed at (radians, lengths in units of the robot; infinite for uniform ones)."""

    q: Floats
    kind: NDArray[np.intp]
    offset: Floats

    def of(self, *kinds: str) -> NDArray[np.bool_]:
        """A mask of the samples of some kinds."""
        return np.isin(self.kind, [KINDS.index(kind) for kind in kinds])


@dataclass(frozen=True, kw_only=True)
class Counts:
    """How many samples of each kind one choice of parameters gets, and how many of them the exact walk sees."""

    uniform: int
    quarter: int
    singular: int
    pair: int
    exact: int = 66


def generator(digest: str, draw: int) -> np.random.Generator:
    """The random numbers of one choice of parameters."""
    return np.random.Generator(np.random.PCG64([int(digest[:16], 16), draw]))


def draws(
    parameters: tuple[Parameter, ...], lengths: frozenset[str], digest: str, count: int
) -> list[dict[str, Fraction]]:
    """Choices of the parameters: the table's values first, then values near them or, where none is given, 0.1 .. 1.

    A parameter keeps the sign of its value in the table; zero stays zero. In the last choice ``lengths`` are 1000
    times as long: the unit must not matter.
    """
    chosen = []
    for draw in range(count if parameters else 1):
        rng = generator(digest, PARAMETERS + draw)
        values = {}
        for parameter in parameters:
            factor = Fraction(int(rng.integers(500, 1501)), 1000)
            value = Fraction(int(rng.integers(100, 1001)), 1000)
            if parameter.value is not None:
                value = parameter.value * (factor if draw else 1)
            unit = 1000 if draw == count - 1 and parameter.name in lengths else 1
            values[parameter.name] = value * unit
        chosen.append(values)
    return chosen


def lengths_of(robot: Robot) -> frozenset[str]:
    """The names that stand in cells for lengths and in none for angles."""
    long: set[str] = set()
    angular: set[str] = set()
    for joint in robot.joints:
        for cell in (joint.a, joint.d, *(joint.s0 or ())):
            long |= set() if cell is None else {symbol.name for symbol in cell.free_symbols}
        for cell in (joint.alpha, joint.theta):
            angular |= set() if cell is None else {symbol.name for symbol in cell.free_symbols}
    for cell in robot.home.q0 if robot.home else ():
        long |= {symbol.name for symbol in cell.free_symbols}
    return frozenset(long - angular)


def held_samples(schedule: Schedule, volume: Volume, size: float, counts: Counts, rng: np.random.Generator) -> Samples:
    """:func:`samples` of a robot, each joint that is locked at a value standing there; inputs take any value."""
    values = {item.name: compiled(item.value, floating()) for item in schedule.held}
    still = [values[joint.name]({}) if joint.name in values else np.nan for joint in schedule.joints]
    moved = np.isnan(still)

    def whole(q: Floats) -> Floats:
        full = np.empty((*q.shape[:-1], len(still)))
        full[...] = still
        full[..., moved] = q
        return full

    joints = tuple(joint for joint in schedule.joints if joint.name not in values)
    drawn = samples(joints, lambda q: volume(whole(q)), size, counts, rng)
    return replace(drawn, q=whole(drawn.q))


def samples(
    joints: tuple[JointName, ...], volume: Volume, size: float, counts: Counts, rng: np.random.Generator
) -> Samples:
    """Joint vectors of every kind; ``volume`` maps (m, n) joint vectors to the task's :func:`volume_of` (m,)."""
    revolute = np.array([joint.kind == "R" for joint in joints])
    reach = size if size > 0 else 1.0
    parts = [
        (uniform(revolute, reach, counts.uniform, rng), np.full(counts.uniform, np.inf)),
        _quarter_turns(revolute, reach, counts.quarter, rng),
        _singular(revolute, reach, volume, counts.singular, rng),
        _pairs(revolute, reach, volume, counts.pair, rng),
    ]
    return Samples(
        q=wrapped(np.concatenate([q for q, _ in parts]), revolute),
        kind=np.concatenate([np.full(len(q), index) for index, (q, _) in enumerate(parts)]),
        offset=np.concatenate([offset for _, offset in parts]),
    )


def uniform(revolute: NDArray[np.bool_], reach: float, count: int, rng: np.random.Generator) -> Floats:
    """Angles in (-pi, pi], lengths in (-reach, reach)."""
    return rng.uniform(-1.0, 1.0, (count, len(revolute))) * np.where(revolute, np.pi, reach)


def wrapped(q: Floats, revolute: NDArray[np.bool_]) -> Floats:
    """Angles brought into (-pi, pi], lengths as they are; shape (..., n)."""
    turned = q - 2 * np.pi * np.ceil((q - np.pi) / (2 * np.pi))
    return np.where(revolute, turned, q)


def _quarter_turns(revolute: NDArray[np.bool_], reach: float, count: int, rng: np.random.Generator) -> _Aimed:
    """One joint at 0, ±pi/2 or pi (a length at 0) or next to it, the others anywhere."""
    q, rows = uniform(revolute, reach, count, rng), np.arange(count)
    joint, turn = rows % len(revolute), rows // len(revolute)
    offset = _offsets(turn // 4, rng)
    q[rows, joint] = np.where(revolute[joint], _TURNS[turn % 4] + offset, offset * reach)
    return q, np.abs(offset)


def _singular(
    revolute: NDArray[np.bool_], reach: float, volume: Volume, count: int, rng: np.random.Generator
) -> _Aimed:
    """Joint vectors at and next to zeros of ``volume``."""
    found, moved, _ = zeros(uniform(revolute, reach, max(4, count // 12), rng), revolute, reach, volume)
    if not len(found):
        return found, np.empty(0)
    rows = np.arange(count)
    pick = rng.permutation(len(found))[rows % len(found)]
    q, offset = found[pick].copy(), _offsets(rows, rng)
    q[rows, moved[pick]] += offset * np.where(revolute[moved[pick]], 1.0, reach)
    return q, np.abs(offset)


def _pairs(revolute: NDArray[np.bool_], reach: float, volume: Volume, count: int, rng: np.random.Generator) -> _Aimed:
    """Zeros of ``volume`` at which another joint is put at, or next to, a quarter turn.

    The search runs at 10^-4 from the quarter turn: on it the volume may be zero whatever the others do.
    """
    base, rows = uniform(revolute, reach, max(4, count // 4), rng), np.arange(count)
    held = rng.integers(0, len(revolute), len(base))
    turn = np.where(revolute[held], _TURNS[rng.integers(0, 4, len(base))], 0.0)
    base[np.arange(len(base)), held] = turn + 1e-4
    found, moved, start = zeros(base, revolute, reach, volume)
    kept = held[start] != moved
    found, start = found[kept], start[kept]
    if not len(found):
        return found, np.empty(0)
    pick = rng.integers(0, len(found), count)
    q, offset = found[pick].copy(), _offsets(rng.integers(0, len(DISTANCES), count), rng)
    q[rows, held[start[pick]]] = turn[start[pick]] + offset
    return q, np.abs(offset)


def _offsets(step: NDArray[np.intp], rng: np.random.Generator) -> Floats:
    """Distances of :data:`DISTANCES` by index, up to three times as long, either way."""
    size = len(step)
    distance = np.array(DISTANCES)[step % len(DISTANCES)]
    return np.asarray(distance * rng.uniform(1.0, 3.0, size) * rng.choice((-1.0, 1.0), size))
