"""The workspace of the planar RR arm, from the conditions of kinsym's own inverse kinematics.

Its elbow is real where ``k^2 <= l2^2``, with two solutions inside and one on the border, and its first joint is free
where the goal is the origin. All of it is decided with rational numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from kinsym.algebra.tree import Tree
from kinsym.check.evaluate import Arithmetic, compiled
from kinsym.deriving import derive
from kinsym.inverse.plan import Step
from kinsym.lecture.case import Case
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import parse, parse_relation
from kinsym.lecture.relation import holds
from kinsym.lecture.residue import Residue
from kinsym.robot import load

ARM = "planar_rr"
RATIONAL = Arithmetic("rational", lambda value: value, None, {})
ANY = "any"


@dataclass(frozen=True)
class Reach:
    """What kinsym's plan says of a goal: its root is real where ``slack`` is not negative."""

    elbow: Step
    first: Step

    def slack(self, numbers: Mapping[str, Fraction]) -> Fraction:
        """The right side of the condition less its left side."""
        assert self.elbow.condition is not None
        left, _, right = self.elbow.condition
        name, value = self.elbow.solution[0]
        known = {**numbers, name: _value(value, numbers)}
        return _value(right, known) - _value(left, known)

    def solutions(self, numbers: Mapping[str, Fraction]) -> int | str:
        """How many solutions a goal has, ``"any"`` where the first joint is free."""
        slack = self.slack(numbers)
        if slack < 0:
            return 0
        assert self.first.degenerate is not None
        return ANY if not _value(self.first.degenerate[0], numbers) else 2 if slack else 1


def _value(tree: Tree, numbers: Mapping[str, Fraction]) -> Fraction:
    value = compiled(tree, RATIONAL)(numbers)
    assert isinstance(value, Fraction)
    return value


@lru_cache(maxsize=1)
def reach_of_arm() -> Reach:
    """The conditions of the planar RR arm."""
    plan = derive(load(ARM)).plan
    assert plan is not None
    elbow, first = plan.steps
    return Reach(elbow, first)


def reach(case: Case) -> bool:
    """How many solutions some goals have."""
    return all(
        reach_of_arm().solutions({name: Fraction(text) for name, text in goal["at"].items()}) == goal["solutions"]
        for goal in case.option("reach")
    )


def reachable(case: Case) -> bool:
    """The goals that are reached lie between two radii: slack = (r^2 - inner^2)(outer^2 - r^2)/(4 l1^2) identically."""
    inner, outer = (parse(text) for text in case.option("reachable"))
    for reading in case.readings():
        numbers = {name: value for name, value in reading.values.items() if isinstance(value, Residue)}
        generator = case.generator("goal")
        x, y = (Fraction(generator.randrange(1, 10**9), generator.randrange(1, 10**9)) for _ in range(2))
        lengths = {name: Fraction(value.value) for name, value in numbers.items()}
        if case.option("given"):
            lengths["l2"] = lengths["l1"]
        evaluate = Evaluator(lengths.__getitem__, exact=True)
        low, high = evaluate.scalar(inner), evaluate.scalar(outer)
        assert isinstance(low, Fraction)
        assert isinstance(high, Fraction)
        squared = x * x + y * y
        product = (squared - low * low) * (high * high - squared) / (4 * lengths["l1"] ** 2)
        if reach_of_arm().slack({**lengths, "p_x": x, "p_y": y}) != product:
            return False
    return True


def dexterous(case: Case) -> bool:
    """Of an arm with these lengths the origin is reached with every orientation and no other goal is."""
    return _every_orientation(case.option("dexterous")) == [Fraction(0)]


def dexterous_none(case: Case) -> bool:
    """Of an arm with these lengths no goal is reached with every orientation."""
    return _every_orientation(case.option("dexterous_none")) == []


def _every_orientation(lengths: list[str]) -> list[Fraction]:
    """The radii, of many, at which there are more than two solutions."""
    l1, l2 = (Fraction(text) for text in lengths)
    radii = [Fraction(k, 20) for k in range(60)]
    goals = ({"l1": l1, "l2": l2, "p_x": radius, "p_y": Fraction(0)} for radius in radii)
    return [goal["p_x"] for goal in goals if reach_of_arm().solutions(goal) == ANY]


def exists(case: Case) -> bool:
    """A condition is true of exactly the goals that are reached; radii are rational on this grid of goals."""
    relation = parse_relation(case.option("exists"))
    for l1, l2 in ((Fraction(1), Fraction(7, 10)), (Fraction(7, 10), Fraction(1)), (Fraction(1), Fraction(1))):
        for k in range(1, 45):
            numbers = {"l1": l1, "l2": l2, "p_x": Fraction(3 * k, 100), "p_y": Fraction(4 * k, 100)}
            evaluate = Evaluator(numbers.__getitem__, exact=True)
            if holds(relation, evaluate) != (reach_of_arm().solutions(numbers) != 0):
                return False
    return True
