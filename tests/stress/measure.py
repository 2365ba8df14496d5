"""One robot under stress: the C is asked for every pose, and every answer is held to what must be true of it.

*lost*: the joint vector that made the pose is not among the solutions, and no way on which the pose stays leads from
one of them to it; where two singularities meet, and outside a border by less than a pose is known, that there is no
solution at all. *wrong*: a solution whose forward kinematics miss the pose by more than 1e-9. *copies*: two solutions
within 1e-7. *broken*: a value that is no number, an angle outside (-pi, pi], or a pose that is refused. *batch*: poses
at which ``ik_batch``, which is asked every fourth, answers otherwise than ``ik_near``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations

import numpy as np

from kinsym.check.answers import CLOSE_PATH, MERGED
from kinsym.check.borders import borders, moved
from kinsym.check.laws import CLOSURE, PATH, SAME, Judge
from kinsym.check.poses import draws, generator, lengths_of, wrapped
from kinsym.check.solvers import Floats
from kinsym.check.task import sifted, units
from kinsym.check.tracing import Tracer
from kinsym.check.tree_kinematics import TreeKinematics
from kinsym.derivation import Derivation
from kinsym.emit.program import build_schedule
from kinsym.emit.text.formula import TextPrinter
from tests.stress.library import Library
from tests.stress.sets import Postures

RANDOM, PAIR, INSIDE, OUTSIDE = "random", "two at once", "inside a border", "outside a border"
FAULTS = ("lost", "wrong", "copies", "broken", "batch")

#: The random numbers of a robot's run; the checks use small numbers.
SEQUENCE = 7_000_000
#: Of all poses, those next to each singular set, at two of them at once, and on either side of borders.
SHARE, PAIR_SHARE = 10, 40
#: At least this share of the poses is anywhere.
ANYWHERE = 4
BLOCK = 50_000
#: One pose in so many is asked of the batch as well.
BATCH = 4
JUDGED = 2_000
#: Steps along ways that wind, as they do where another singular pose is not far, the shorter ones where the longer
#: miss a bend, and how far such ways lead.
SHORT, FAR = (0.01, 0.001), 10.0
#: So many of one block are looked at so closely; where more are missed, something is wrong with the solver.
WINDING = 40
#: A pose outside by less than this is not known to be outside.
UNKNOWN = 2e-15


@dataclass(kw_only=True)
class Kind:
    """What came out for the poses of one kind; ``examples`` are joint vectors or poses of the first faults."""

    name: str
    poses: int = 0
    solutions: int = 0
    worst: float = 0.0
    faults: dict[str, int] = field(default_factory=lambda: dict.fromkeys(FAULTS, 0))
    examples: dict[str, list[list[float]]] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Poses:
    """Some poses (m, 4, 4) of one kind and the joint vectors (m, n) that made them, or that they lie next to; how far
    each is from what was aimed at; ``known`` tells that these joint vectors must be found."""

    name: str
    q: Floats
    T: Floats
    distance: Floats
    known: bool = True


class Stress:
    """One robot with one choice of its parameters, the first of the checks if None is given.

    ``sources`` are the files of its C, if they are not those that are generated.
    """

    def __init__(
        self,
        derivation: Derivation,
        sources: Mapping[str, str] | None = None,
        parameters: Mapping[str, Fraction] | None = None,
    ) -> None:
        self.schedule = schedule = build_schedule(derivation)
        if parameters is None:
            parameters = draws(schedule.parameters, lengths_of(derivation.robot), schedule.digest, 1)[0]
        self.kinematics = TreeKinematics(schedule, parameters)
        self._sources, self._parameters = sources, parameters
        self.postures = Postures(schedule, parameters, self.kinematics.size, generator(schedule.digest, SEQUENCE))
        self.judge = Judge(
            self.kinematics,
            schedule.task,
            self.postures.revolute,
            float(schedule.tau),
            CLOSURE if sifted(schedule) else PATH,
        )

    @cached_property
    def library(self) -> Library:
        """The compiled C."""
        return Library(self.schedule, self._parameters, self._sources)

    def run(self, count: int) -> list[Kind]:
        """Ask for about ``count`` poses."""
        kinds: dict[str, Kind] = {}
        for poses in self.poses(count):
            kind = kinds.setdefault(poses.name, Kind(name=poses.name))
            for start in range(0, len(poses.q), BLOCK):
                self._hold(poses, slice(start, start + BLOCK), kind)
        return list(kinds.values())

    def poses(self, count: int) -> Iterator[Poses]:
        """Every kind of pose that the robot has."""
        postures, printer = self.postures, TextPrinter()
        conditions = self.schedule.singular.set.listed if self.schedule.singular else ()
        special, on_border = 0, []
        for condition in conditions:
            name = ", ".join(f"{printer(value)} = 0" for value in condition.values)
            zeros = postures.zeros(condition.values, count // SHARE)
            if not len(zeros.q):
                continue
            q, distance = postures.beside(zeros, count // SHARE)
            yield self._at(name, q, distance)
            special += len(q)
            on_border.append(zeros.q)
        for first, second in combinations(conditions, 2):
            zeros = postures.zeros((*first.values, *second.values), count // PAIR_SHARE)
            if len(zeros.q):
                q, distance = postures.beside(zeros, count // PAIR_SHARE)
                yield self._at(PAIR, q, distance)
                special += len(q)
        for poses in self._borders(on_border, count // SHARE):
            special += len(poses.q)
            yield poses
        q = postures.random(max(count // ANYWHERE, count - special))
        yield self._at(RANDOM, q, np.full(len(q), np.inf))

    def _at(self, name: str, q: Floats, distance: Floats) -> Poses:
        return Poses(name=name, q=q, T=self.kinematics.forward(q), distance=distance)

    def _borders(self, zeros: list[Floats], count: int) -> Iterator[Poses]:
        """Poses inside and outside of borders, a tenth of all poses each."""
        if not zeros:
            return
        edge = borders(self.kinematics, self.schedule.task, np.concatenate(zeros), self.postures.revolute)
        if edge is None or not len(edge.q):
            return
        rows = np.resize(self.postures.rng.permutation(len(edge.q)), count)
        depth = self.postures.distances(count)
        inside = wrapped(edge.inside(rows, depth), self.postures.revolute)
        yield replace(self._at(INSIDE, inside, depth), distance=np.sqrt(depth))
        depth = self.postures.distances(count)
        T = moved(self.kinematics.forward(edge.q[rows]), edge.outward[rows] * depth[:, None], self.kinematics.size)
        yield Poses(name=OUTSIDE, q=edge.q[rows], T=T, distance=depth, known=False)

    def _hold(self, poses: Poses, part: slice, kind: Kind) -> None:
        q, T, distance = poses.q[part], poses.T[part], poses.distance[part]
        found, counts = self.library.inverse(T, q)
        valid = np.arange(found.shape[1]) < counts[:, None]
        closures = self.judge.closures(found, T)
        closures = np.where(valid, np.where(np.isnan(closures), np.inf, closures), 0.0).max(axis=1, initial=0.0)
        angles = found[..., self.postures.revolute & self.kinematics.free]
        with np.errstate(invalid="ignore"):
            inside = ((angles > -np.pi) & (angles <= np.pi)).all(axis=-1)
        faults = {
            "lost": self._lost(poses, part, found, counts),
            "wrong": (closures > CLOSURE) & np.isfinite(closures),
            "copies": self._copies(found),
            "broken": (counts < 0) | ~np.isfinite(closures) | (valid & ~inside).any(axis=1),
            "batch": self._differ(T, q, np.arange(len(q)) % BATCH == 0),
        }
        kind.poses += len(q)
        kind.solutions += int(counts.clip(0).sum())
        kind.worst = max(kind.worst, float(closures[np.isfinite(closures)].max(initial=0.0)))
        for fault, rows in faults.items():
            kind.faults[fault] += int(rows.sum())
            some = kind.examples.setdefault(fault, [])
            for row in np.flatnonzero(rows)[: 3 - len(some)]:
                some.append(
                    [float(distance[row]), *q[row].tolist(), *([] if poses.known else T[row, :3].ravel().tolist())]
                )

    def _lost(self, poses: Poses, part: slice, found: Floats, counts: np.ndarray) -> np.ndarray:
        q, T, distance = poses.q[part], poses.T[part], poses.distance[part]
        if not poses.known:
            return np.asarray((distance < UNKNOWN) & (counts < 1))
        if poses.name == PAIR:
            return np.asarray(counts < 1)
        unit = np.where(self.postures.revolute, 1.0, self.postures.reach)
        with np.errstate(invalid="ignore"):
            gaps = np.abs(wrapped(found - q[:, None], self.postures.revolute)) / unit
            missed = ~(gaps <= SAME).all(axis=-1).any(axis=1)
        for path in (self.judge.path, max(CLOSE_PATH, self.judge.path)):
            judge = replace(self.judge, path=path)
            rows = np.flatnonzero(missed & (distance <= (MERGED if path == CLOSE_PATH else np.inf)))
            for start in range(0, len(rows), JUDGED):
                some = rows[start : start + JUDGED]
                missed[some] = ~judge.found(found[some], q[some], T[some])
        for row in np.flatnonzero(missed)[:WINDING]:
            path = self.judge.path if distance[row] > MERGED else max(CLOSE_PATH, self.judge.path)
            missed[row] = not self._joined(found[row, : counts[row]], q[row], T[row], path)
        return missed

    def _joined(self, found: Floats, q: Floats, T: Floats, path: float) -> bool:
        """Whether a winding way leads from solutions (k, n) to a joint vector (n,): the checks' way in short steps."""
        if not len(found):
            return False
        limit = path + 4 * self.judge.tau
        revolute, poses = self.postures.revolute, np.repeat(T[None], len(found), axis=0)
        unit = units(revolute, self.kinematics.size)
        start, way = found / unit, wrapped(q - found, revolute) / unit
        for step in SHORT:
            tracer = Tracer(self.kinematics, self.schedule.task, limit, revolute, step=step, steps=round(FAR / step))
            if tracer.joined(start, way, poses).any() or tracer.joined(start + way, -way, poses).any():
                return True
        return False

    def _copies(self, found: Floats) -> np.ndarray:
        copied = np.zeros(len(found), dtype=bool)
        for one, other in combinations(range(found.shape[1]), 2):
            rows = np.flatnonzero(~np.isnan(found[:, other, 0]))
            if rows.size:
                pair = found[rows][:, [one, other]]
                for row in np.flatnonzero(
                    (np.abs(wrapped(pair[:, 1] - pair[:, 0], self.postures.revolute)) < 1e-7).all(axis=-1)
                ):
                    copied[rows[row]] = True
        return copied

    def _differ(self, T: Floats, q: Floats, asked: np.ndarray) -> np.ndarray:
        """Where the batch, its free joints at 0, has other numbers of solutions or other solutions; some are asked."""
        different, (T, q) = asked.copy(), (T[asked], q[asked])
        reference = np.where(self.kinematics.free, 0.0, q)
        one, count = self.library.inverse(T, reference)
        many, counts, _ = self.library.inverse_batch(T, reference)
        with np.errstate(invalid="ignore"):
            apart = np.abs(wrapped(many - one, self.postures.revolute)).max(axis=-1)
        there = np.arange(one.shape[1]) < count[:, None]
        different[asked] = (count != counts) | (there & ~(apart <= SAME)).any(axis=1)
        return different
