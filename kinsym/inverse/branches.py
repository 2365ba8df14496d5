"""Names of the branches: which shoulder, which elbow, which wrist the roots of the plan's steps stand for.

The two roots of ``a c + b s = e`` differ in the sign of the left side's derivative by the angle, those of a triangle in
the side of its first link on which the second one bends. A name is given only where that sign is the sign of a
geometric feature at every pose: both are computed at random postures modulo the prime, and their ratio must be one
small rational number. A triangle has the length of its first link as a factor; its sign is that of the table's value,
and a parameter without a value counts as positive. Where no feature fits, a branch is named by the unknown.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.residues import residue_of
from kinsym.algebra.tree import Num, Pow, Prod, Quot, Sum, Sym, Tree, symbols
from kinsym.inverse.families import values_at
from kinsym.inverse.features import ELBOW, SHOULDER, Features
from kinsym.inverse.plan import Plan, Step
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.singular.zeros import somewhere

#: At so many random postures two signs are compared.
_POSTURES = 4
#: A ratio counts as one small rational number up to this numerator and denominator.
_LARGEST = 64
_ORDINALS = ("first", "second", "third", "fourth")


@dataclass(frozen=True, kw_only=True)
class Branches:
    """The names of the branches in their fixed order, and what the words in them mean, one sentence each."""

    names: tuple[str, ...]
    meanings: tuple[str, ...]


@dataclass(frozen=True)
class _Fork:
    """A step that branches, with a word for each root and what the words mean."""

    words: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class _Sign:
    """What the two roots of a step differ in by sign: its values at the postures, its sign at the first root."""

    values: list[int]
    first: int


def branches(chain: Chain, plan: Plan) -> Branches:
    """The branches of a plan; ``chain`` holds the joints that are solved for."""
    forks = _Naming(chain, plan).forks()
    names = []
    for words in product(*(fork.words for fork in forks)):
        names.append(", ".join(_turned(words)) or "the only one")
    return Branches(names=tuple(names), meanings=tuple(dict.fromkeys(fork.meaning for fork in forks)))


def _turned(words: tuple[str, ...]) -> tuple[str, ...]:
    """The words with the elbow's exchanged where the shoulder is left.

    >>> _turned(("shoulder left", "elbow up")), _turned(("shoulder right", "elbow up"))
    (('shoulder left', 'elbow down'), ('shoulder right', 'elbow up'))
    """
    if SHOULDER[1] not in words:
        return words
    return tuple(ELBOW[1 - ELBOW.index(word)] if word in ELBOW else word for word in words)


class _Naming:
    """The words for the steps of one plan."""

    def __init__(self, chain: Chain, plan: Plan) -> None:
        self._plan, self._parameters = plan, chain.robot.parameters
        self._postures = somewhere(chain, _POSTURES)
        self._features = Features(chain, self._postures)

    def forks(self) -> list[_Fork]:
        """A fork for each step that branches."""
        found: list[_Fork] = []
        for step in self._plan.steps:
            if step.branches > 1:
                sided = any(set(fork.words) == set(SHOULDER) for fork in found)
                found.append(self._by_feature(step, sided) or _by_unknown(step))
        return found

    def _by_feature(self, step: Step, sided: bool) -> _Fork | None:
        sign = self._sign(step)
        if sign is None:
            return None
        for feature in self._features.of(tuple(name for name, _ in step.reference), sided=sided):
            same = sign.first * _common_sign(sign.values, [feature.value(posture) for posture in self._postures])
            if same:
                return _Fork(feature.words if same > 0 else feature.words[::-1], feature.meaning)
        return None

    def _sign(self, step: Step) -> _Sign | None:
        if step.rule in ("homogeneous", "linear"):
            rows = self._values(step, (step.inputs["a"], step.inputs["b"], *map(Sym, step.outputs)))
            return _Sign([b * c - a * s for a, b, c, s in rows], 1 if step.rule == "homogeneous" else -1)
        if step.rule != "triangle":
            return None
        across = step.outputs[1]
        direction = next(o for o in self._plan.steps if o.rule == "direction" and across in symbols(o.inputs["across"]))
        trees = (direction.inputs["x"], direction.inputs["y"], *map(Sym, direction.outputs), step.inputs["l1"])
        rows = self._values(direction, trees)
        positive = residue_of(direction.inputs["across"], {across: 1}) == 1
        length = sign_of_length(step.inputs["l1"], self._parameters)
        return _Sign([(y * c - x * s) * l1 for x, y, c, s, l1 in rows], length if positive else -length)

    def _values(self, step: Step, trees: tuple[Tree, ...]) -> list[list[int]]:
        """Trees that a step reads, at every posture; empty where one of them is no polynomial."""
        rows = []
        for posture in self._postures:
            known = values_at(self._plan, step, posture)
            row = [residue_of(tree, known) for tree in trees]
            rows.append([value for value in row if value is not None])
        return rows if all(len(row) == len(trees) for row in rows) else []


def _by_unknown(step: Step) -> _Fork:
    if step.branches == 2:
        signs = (f"{step.unknown} +", f"{step.unknown} -")
        return _Fork(signs, f"{step.unknown} + and -: the upper sign or the first value of its formula, and the other")
    ordinals = _ORDINALS[: step.branches]
    words = tuple(f"{step.unknown} {word}" for word in ordinals)
    return _Fork(words, f"{step.unknown} {ordinals[0]} to {ordinals[-1]}: its values in increasing order")


def sign_of_length(tree: Tree, parameters: dict[str, Fraction | None]) -> int:
    """The sign of a length at the table's values, 1 for a parameter without one; 0 where it cannot be read off.

    >>> sign_of_length(Prod((Num(Fraction(2)), Sym("a2"))), {"a2": Fraction(-1, 2)})
    -1
    """
    match tree:
        case Num(value):
            return (value > 0) - (value < 0)
        case Sym(name):
            given = parameters.get(name, Fraction(0))
            return 1 if given is None else (given > 0) - (given < 0)
        case Prod((first, *others)):
            return sign_of_length(first, parameters) * (
                sign_of_length(Prod(tuple(others)), parameters) if others else 1
            )
        case Quot(above, below):
            return sign_of_length(above, parameters) * sign_of_length(below, parameters)
        case Pow(base, exponent):
            sign = sign_of_length(base, parameters)
            return sign if exponent % 2 else abs(sign)
        case Sum(terms):
            signs = {sign_of_length(term, parameters) for term in terms}
            return signs.pop() if len(signs) == 1 else 0
        case _:
            return 0


def _common_sign(left: list[int], right: list[int]) -> int:
    """The sign of left / right if that is one small rational number everywhere, else 0."""
    pairs = [(a % PRIME, b % PRIME) for a, b in zip(left, right, strict=False)]
    if not pairs or not all(a and b for a, b in pairs):
        return 0
    ratio, *others = {a * inverse(b) % PRIME for a, b in pairs}
    for denominator in range(1, 1 if others else _LARGEST + 1):
        numerator = ratio * denominator % PRIME
        if min(numerator, PRIME - numerator) <= _LARGEST:
            return 1 if numerator <= _LARGEST else -1
    return 0
