"""Names of the branches: which shoulder, which elbow, which wrist the two roots of a step stand for.

The roots of ``a c + b s = e`` differ in the sign of the left side's derivative by the angle, those of a triangle in
the side of its first link on which the elbow lies. A name is given only where that sign is the sign of a geometric
quantity for every pose: both are computed at random postures modulo the prime, and their ratio must be one rational
number. A triangle's ratio has the length of its first link as a factor as well; its sign is that of the table's
values, and a parameter without a value counts as positive. Where nothing fits a branch is named by the unknown.

Shoulder and elbow are those of C. S. G. Lee and M. Ziegler, A geometric approach in solving the inverse kinematics of
PUMA robots, IEEE Transactions on Aerospace and Electronic Systems 20(6), 1984.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.linear import Numbers, cross, difference, dot
from kinsym.algebra.residues import residue_of
from kinsym.algebra.tree import Num, Pow, Prod, Quot, Sum, Sym, Tree, symbols
from kinsym.inverse.families import values_at
from kinsym.inverse.plan import Plan, Step
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.landmarks import crossing
from kinsym.kinematics.posture import Posture
from kinsym.kinematics.zeros import somewhere

#: At so many random postures two signs are compared.
_POSTURES = 4
#: Ratios are recognised up to this numerator and this denominator.
_LARGEST = 64
_ORDINALS = ("first", "second", "third", "fourth")


@dataclass(frozen=True, kw_only=True)
class Branches:
    """The names of the branches in their fixed order, and what the words in them mean, one sentence each."""

    names: tuple[str, ...]
    meanings: tuple[str, ...]


@dataclass(frozen=True)
class _Fork:
    """A step that branches: a word for each root; ``swaps`` tells that the words change places on the left shoulder."""

    words: tuple[str, ...]
    meaning: str
    swaps: bool = False


@dataclass(frozen=True)
class _Feature:
    """Words for the two signs of a geometric quantity, positive first."""

    words: tuple[str, str]
    meaning: str
    value: Callable[[Posture], int]


_Point = Callable[[Posture], Numbers]


def branches(chain: Chain, plan: Plan) -> Branches:
    """The branches of a plan; ``chain`` holds the joints that are solved for."""
    forks = _Naming(chain, plan).forks()
    left = [k for k, fork in enumerate(forks) if fork.words == _SHOULDER[::-1] or fork.words == _SHOULDER]
    names = []
    for choice in product(*(range(len(fork.words)) for fork in forks)):
        swapped = any(forks[k].words[choice[k]] == "shoulder left" for k in left)
        words = [
            fork.words[::-1][root] if fork.swaps and swapped else fork.words[root]
            for fork, root in zip(forks, choice, strict=True)
        ]
        names.append(", ".join(words) or "the only one")
    return Branches(names=tuple(names), meanings=tuple(dict.fromkeys(fork.meaning for fork in forks)))


_SHOULDER = ("shoulder right", "shoulder left")
_UP_MEANS = (
    "elbow up: seen with axis {first} upward and the side of axis {first} that the arm reaches to on the right, "
    "{elbow} lies to the left of the way from {base} to {tip}: above it wherever it leads to the right"
)
_LEFT_MEANS = "elbow left: seen against axis {elbow}, it lies to the left of the way from {base} to {tip}"


class _Naming:
    """The words for the steps of one plan."""

    def __init__(self, chain: Chain, plan: Plan) -> None:
        self._chain, self._plan = chain, plan
        self._postures = somewhere(chain, _POSTURES)
        kinds = self._postures[0].kinds
        self._turning = [joint for joint, kind in enumerate(kinds) if kind == "R"]
        self._numbers = chain.numbers
        self._shoulder = False

    def forks(self) -> list[_Fork]:
        """A fork for each step that branches."""
        return [self._fork(step) for step in self._plan.steps if step.branches > 1]

    def _fork(self, step: Step) -> _Fork:
        first = self._sign_of_first(step)
        if first is not None:
            own, sign = first
            for feature in self._features(step):
                found = _common_sign(own, [feature.value(posture) for posture in self._postures])
                if found:
                    positive = found * sign > 0
                    self._shoulder |= feature.words == _SHOULDER
                    words = feature.words if positive else feature.words[::-1]
                    return _Fork(words, feature.meaning, feature.words[0] == "elbow up")
        if step.branches == 2:
            words = (f"{step.unknown} +", f"{step.unknown} -")
            return _Fork(words, f"{step.unknown} + and -: the upper sign or the first value of its formula, and the other")
        return _Fork(
            tuple(f"{step.unknown} {word}" for word in _ORDINALS[: step.branches]),
            f"{step.unknown} first to {_ORDINALS[step.branches - 1]}: its values in increasing order",
        )

    def _sign_of_first(self, step: Step) -> tuple[list[int], int] | None:
        """What the roots of a step differ in by sign, at the postures, and its sign at the first root."""
        if step.rule in ("homogeneous", "linear"):
            c, s = (Sym(name) for name in step.outputs)
            rows = [self._evaluated(step, posture, (step.inputs["a"], step.inputs["b"], c, s)) for posture in self._postures]
            return None if None in rows else ([(b * c - a * s) % PRIME for a, b, c, s in rows], 1 if step.rule == "homogeneous" else -1)
        if step.rule != "triangle":
            return None
        (direction,) = (
            other for other in self._plan.steps if other.rule == "direction" and set(step.outputs) & _names(other)
        )
        across = residue_of(direction.inputs["across"], {step.outputs[1]: 1})
        length = self._sign(step.inputs["l1"])
        c, s = (Sym(name) for name in direction.outputs)
        trees = (direction.inputs["x"], direction.inputs["y"], c, s, step.inputs["l1"])
        rows = [self._evaluated(direction, posture, trees) for posture in self._postures]
        if None in rows or not length or across is None:
            return None
        return [(y * c - x * s) * l1 % PRIME for x, y, c, s, l1 in rows], length * (1 if across == 1 else -1)

    def _evaluated(self, step: Step, posture: Posture, trees: tuple[Tree, ...]) -> tuple[int, ...] | None:
        values = values_at(self._plan, step, posture)
        found = [residue_of(tree, values) for tree in trees]
        known = tuple(value for value in found if value is not None)
        return known if len(known) == len(found) else None

    def _sign(self, tree: Tree) -> int | None:
        """The sign of a length at the table's values; None where it cannot be read off."""
        match tree:
            case Num(value):
                return (value > 0) - (value < 0)
            case Sym(name):
                value = self._chain.robot.parameters.get(name, Fraction(0))
                return 1 if value is None else (value > 0) - (value < 0)
            case Prod(factors):
                return self._product([self._sign(factor) for factor in factors])
            case Quot(above, below):
                return self._product([self._sign(above), self._sign(below)])
            case Pow(base, exponent):
                return self._product([self._sign(base)] * exponent)
            case Sum(terms):
                signs = {self._sign(term) for term in terms}
                return signs.pop() if len(signs) == 1 else None
            case _:
                return None

    @staticmethod
    def _product(signs: list[int | None]) -> int | None:
        total = 1
        for sign in signs:
            if not sign:
                return None
            total *= sign
        return total

    def _features(self, step: Step) -> Iterator[_Feature]:
        own = [self._place(variable) for variable, _ in step.reference]
        if own == self._turning[:1]:
            yield from self._shoulders(own[0])
        if len(own) == 1:
            yield from self._elbows(own[0])
        yield from self._flips()
        for place, joint in enumerate(self._chain.joints):
            if joint.kind == "P":
                yield _Feature(
                    (f"{joint.variable} > 0", f"{joint.variable} < 0"),
                    f"{joint.variable} > 0 and {joint.variable} < 0 are the signs of its value",
                    lambda posture, name=joint.variable: posture.values[name],
                )

    def _shoulders(self, first: int) -> Iterator[_Feature]:
        """On which side of the first axis the arm reaches."""
        second = next((k for k in self._turning if any(cross(self._at.axes[first], self._at.axes[k]))), None)
        if second is None:
            return
        for words, point in self._points():
            yield _Feature(
                _SHOULDER,
                f"shoulder right: looking from axis {self._numbers[first]} to {words} with axis {self._numbers[first]} "
                f"upward, axis {self._numbers[second]} points to the right",
                lambda p, point=point: dot(
                    cross(p.axes[first], p.axes[second]), difference(point(p), p.points[first])
                ),
            )

    def _elbows(self, joint: int) -> Iterator[_Feature]:
        """On which side of the way from the base to the tip of two links the joint between them lies."""
        if self._at.kinds[joint] != "R":
            return
        second = next((k for k in self._turning if any(cross(self._at.axes[0], self._at.axes[k]))), None)
        for (base, start), (tip, end) in product(self._points(joint, -1), self._points(joint, 1)):
            names = {"first": self._numbers[self._turning[0]], "base": base, "tip": tip}

            def side(p: Posture, start: _Point = start, end: _Point = end) -> int:
                origin = start(p)
                return dot(cross(difference(end(p), origin), difference(p.points[joint], origin)), p.axes[joint])

            if self._shoulder and second is not None and not any(cross(self._at.axes[joint], self._at.axes[second])):
                yield _Feature(
                    ("elbow up", "elbow down"),
                    _UP_MEANS.format(**names, elbow=f"axis {self._numbers[joint]}"),
                    lambda p, side=side, second=second: side(p) * dot(p.axes[joint], p.axes[second]) % PRIME,
                )
            else:
                yield _Feature(
                    ("elbow left", "elbow right"), _LEFT_MEANS.format(**names, elbow=self._numbers[joint]), side
                )

    def _flips(self) -> Iterator[_Feature]:
        """Whether the middle one of three axes turns the third out of the first by a positive angle."""
        triples = [("wrist", self._turning[-3:]), ("shoulder", self._turning[:3])]
        for name, (i, j, k) in (pair for pair in triples if len(pair[1]) == 3):
            numbers = [self._numbers[joint] for joint in (i, j, k)]
            yield _Feature(
                (f"{name} not flipped", f"{name} flipped"),
                "{} not flipped: about axis {}, axis {} is less than half a turn ahead of axis {}".format(
                    name, numbers[1], numbers[2], numbers[0]
                ),
                lambda p, i=i, j=j, k=k: dot(cross(p.axes[i], p.axes[k]), p.axes[j]),
            )

    def _points(self, joint: int | None = None, way: int = 0) -> Iterator[tuple[str, _Point]]:
        """Points of the arm with their names; with a joint, those before it (way -1) or behind it (way 1)."""
        kept = [k for k in self._turning if joint is None or (k - joint) * way > 0]
        if joint is not None:
            beside = [k for k in kept if abs(k - joint) == 1 and not any(cross(self._at.axes[k], self._at.axes[joint]))]
            for k in beside:
                yield f"axis {self._numbers[k]}", lambda p, k=k: p.points[k]
        for i, j in reversed([pair for pair in combinations(kept, 2) if pair[1] == pair[0] + 1]):
            if all(crossing(posture, i, j) for posture in self._postures):
                words = f"the point where axes {self._numbers[i]} and {self._numbers[j]} meet"
                yield words, lambda p, i=i, j=j: crossing(p, i, j) or p.points[i]
        if way >= 0:
            yield "the end point", lambda p: p.end

    @property
    def _at(self) -> Posture:
        return self._postures[0]

    def _place(self, variable: str) -> int:
        return next(place for place, joint in enumerate(self._chain.joints) if joint.variable == variable)


def _names(step: Step) -> set[str]:
    return {name for tree in step.inputs.values() for name in symbols(tree)}


def _common_sign(left: list[int], right: list[int]) -> int:
    """The sign of left / right if that is one small rational number everywhere, else 0."""
    if not all(left) or not all(right):
        return 0
    ratios = {a * inverse(b) % PRIME for a, b in zip(left, right, strict=True)}
    if len(ratios) > 1:
        return 0
    (ratio,) = ratios
    for denominator in range(1, _LARGEST + 1):
        numerator = ratio * denominator % PRIME
        if min(numerator, PRIME - numerator) <= _LARGEST:
            return 1 if numerator <= _LARGEST else -1
    return 0
