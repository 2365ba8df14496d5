"""What a condition means is said of axes and points alone, here of lines drawn at random with one thing in common."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from kinsym.algebra.field import PRIME
from kinsym.algebra.linear import Numbers, cross
from kinsym.kinematics.singular.meaning import Meaning, crossing, meaning
from kinsym.kinematics.singular.posture import Posture
from kinsym.robot.model import Task

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


class Lines:
    """Random axes and points, but for those that are given by their number from 1."""

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def number(self) -> int:
        return self._random.randrange(2, 10**6)

    def vector(self) -> Numbers:
        return self.number(), self.number(), self.number()

    def between(self, *vectors: Numbers) -> Numbers:
        """A random sum of multiples."""
        factors = [self.number() for _ in vectors]
        x, y, z = (sum(k * v[i] for k, v in zip(factors, vectors, strict=True)) for i in range(3))
        return x, y, z

    def posture(
        self,
        kinds: str,
        axes: dict[int, Numbers],
        points: dict[int, Numbers],
        end: Numbers | None = None,
        numbers: tuple[int, ...] | None = None,
    ) -> Posture:
        places = range(1, len(kinds) + 1)
        return Posture(
            values={},
            kinds=tuple(kinds),
            axes=tuple(axes.get(i) or self.vector() for i in places),
            points=tuple(points.get(i) or self.vector() for i in places),
            end=end or self.vector(),
            turned=(X, Y, Z),
            numbers=numbers or tuple(places),
        )


def plus(left: Numbers, right: Numbers) -> Numbers:
    x, y, z = (a + b for a, b in zip(left, right, strict=True))
    return x, y, z


def wrist(
    lines: Lines, axes: dict[int, Numbers], points: dict[int, Numbers] | None = None, centre: Numbers = X
) -> Posture:
    """Six turns of which the last three meet, each axis given by another of its points."""
    axes = {i: axes.get(i) or lines.vector() for i in range(1, 7)}
    met = {i: plus(centre, lines.between(axes[i])) for i in (4, 5, 6)}
    return lines.posture("RRRRRR", axes, {**met, **(points or {})})


def shoulder(lines: Lines, axes: dict[int, Numbers], kinds: str = "RRRR") -> Posture:
    """Turns of which the first three meet."""
    axes = {i: axes.get(i) or lines.vector() for i in (1, 2, 3)}
    return lines.posture(kinds, axes, {i: plus(Y, lines.between(axes[i])) for i in axes})


def middle(lines: Lines, axes: dict[int, Numbers]) -> Posture:
    """Turns of which the second to the fourth meet."""
    axes = {i: axes.get(i) or lines.vector() for i in (2, 3, 4)}
    return lines.posture("RRRRR", axes, {i: plus(Y, lines.between(axes[i])) for i in axes})


def parallel(lines: Lines, joints: tuple[int, ...], points: dict[int, Numbers], kinds: str, **more: Numbers) -> Posture:
    """Turns of which some are parallel to z."""
    return lines.posture(kinds, dict.fromkeys(joints, Z), points, **more)


def two_meet(lines: Lines, centre: Numbers, on: Callable[[Posture], Posture] = lambda p: p) -> Posture:
    """Six turns of which the last two meet."""
    axes = {5: lines.vector(), 6: lines.vector()}
    return on(lines.posture("RRRRRR", axes, {i: plus(centre, lines.between(axes[i])) for i in axes}))


def in_a_plane(lines: Lines, special: bool, first: int, *, meet: bool) -> Posture:
    """A wrist whose centre lies in the plane through one axis along the next one."""
    one, two = lines.vector(), lines.vector()
    at = lines.vector()
    points = {first: at}
    if meet:
        points[first + 1] = plus(at, lines.between(one, two))
    centre = plus(at, lines.between(one, two)) if special else lines.vector()
    return wrist(lines, {first: one, first + 1: two}, points, centre)


def on_the_axis(lines: Lines, special: bool, joint: int) -> Posture:
    """A wrist whose centre lies on an axis."""
    axis, at = lines.vector(), lines.vector()
    return wrist(lines, {joint: axis}, {joint: at}, plus(at, lines.between(axis)) if special else lines.vector())


def end_on_the_axis(lines: Lines, special: bool) -> Posture:
    """Two more axes are one line."""
    axis, at = lines.vector(), lines.vector()
    end = plus(at, lines.between(axis)) if special else None
    return lines.posture("RRR", {1: axis, 2: Z, 3: Z}, {1: at, 2: X, 3: X}, end)


def crossing_on_the_axis(lines: Lines, special: bool) -> Posture:
    axis, at = lines.vector(), lines.vector()
    last = {5: lines.vector(), 6: lines.vector()}
    centre = plus(at, lines.between(axis)) if special else lines.vector()
    met = {i: plus(centre, lines.between(last[i])) for i in last}
    return lines.posture("RRRRRR", {1: axis, **last}, {1: at, **met})


def three_in_a_plane(lines: Lines, special: bool) -> Posture:
    along = lines.between(X, Y)
    points = {2: lines.vector(), 4: lines.vector()}
    points[3] = plus(points[2], lines.between(along, Z))
    if special:
        points[4] = plus(points[2], lines.between(along, Z))
    return parallel(lines, (2, 3, 4), points, "RRRRR")


def two_and_the_end_in_a_plane(lines: Lines, special: bool) -> Posture:
    along, at = lines.between(X, Y), lines.vector()
    end = plus(at, lines.between(along, Z)) if special else lines.vector()
    return parallel(lines, (1, 2), {1: at, 2: plus(at, lines.between(along, Z))}, "RR", end=end)


def one_becomes_parallel_to_three(lines: Lines, special: bool) -> Posture:
    return lines.posture("RRRRRR", dict.fromkeys((2, 3, 4), Z) | ({6: lines.between(Z)} if special else {}), {})


def two_become_parallel_to_one(lines: Lines, special: bool) -> Posture:
    two = lines.vector()
    return lines.posture("RRRRR", {2: lines.between(two) if special else lines.vector(), 4: two, 5: two}, {})


def two_become_parallel(lines: Lines, special: bool) -> Posture:
    return lines.posture("RRRR", {2: Z, **({3: lines.between(Z)} if special else {})}, {})


def a_point_is_carried_slowly(lines: Lines, special: bool) -> Posture:
    """A slide among the three that carry the wrist: its direction is a sum of the velocities of the others."""
    axes, points = {1: lines.vector(), 2: lines.vector()}, {1: lines.vector(), 2: lines.vector()}
    speeds = [cross(axes[i], points[i]) for i in (1, 2)]
    axes[3] = lines.between(*speeds) if special else lines.vector()
    last = {i: lines.vector() for i in (4, 5, 6)}
    return lines.posture("RRPRRR", {**axes, **last}, {**points, **{i: lines.between(last[i]) for i in last}})


def two_meet_by_chance(lines: Lines, special: bool) -> Posture:
    one, two, at = lines.vector(), lines.vector(), lines.vector()
    points = {1: plus(at, lines.between(one)), **({4: plus(at, lines.between(two))} if special else {})}
    return lines.posture("RPRR", {1: one, 4: two}, points)


def three_are_flat(lines: Lines, special: bool) -> Posture:
    one, two = lines.vector(), lines.vector()
    return lines.posture("RRPR", {1: one, 2: two, **({4: lines.between(one, two)} if special else {})}, {})


def first_crossing_on_an_axis(lines: Lines, special: bool) -> Posture:
    """The first two axes of five meet."""
    axes, at = {i: lines.vector() for i in (1, 2, 4)}, lines.vector()
    points = {i: plus(at, lines.between(axes[i])) for i in ((1, 2, 4) if special else (1, 2))}
    return lines.posture("RRRRR", axes, points)


def two_pairs_become_parallel(lines: Lines, special: bool) -> Posture:
    axes = {1: X, 2: lines.between(X)}
    other = X if special else lines.vector()
    return lines.posture("RRRRR", {**axes, 3: other, 4: lines.between(other)}, {})


def a_few_turns_become_parallel(lines: Lines, special: bool, count: int) -> Posture:
    return lines.posture("R" * count, {1: Z, **({count: lines.between(Z)} if special else {})}, {})


def in_two_planes(lines: Lines, special: bool) -> Posture:
    """The point where axes 5 and 6 meet lies in the planes along axis 4 through axis 2 and through axis 3."""
    axes, at = {i: lines.vector() for i in range(1, 7)}, lines.vector()
    points = {i: plus(at, lines.between(axes[i])) for i in (5, 6)}
    if special:
        points |= {i: plus(at, lines.between(axes[i], axes[4])) for i in (2, 3)}
    return lines.posture("RRRRRR", axes, points)


Drawn = Callable[[Lines, bool], Posture]
CASES: dict[str, tuple[Drawn, str, str]] = {
    "wrist in line": (
        lambda lines, special: wrist(lines, {4: Z, **({6: lines.between(Z)} if special else {})}),
        "wrist",
        "axes 4 and 6 coincide",
    ),
    "wrist in a plane": (
        lambda lines, special: wrist(lines, {4: Z, 5: X, **({6: lines.between(X, Z)} if special else {})}),
        "wrist",
        "axes 4, 5 and 6 lie in one plane",
    ),
    "shoulder in line": (
        lambda lines, special: shoulder(lines, {1: Z, **({3: lines.between(Z)} if special else {})}),
        "shoulder",
        "axes 1 and 3 coincide",
    ),
    "shoulder before a slide": (
        lambda lines, special: shoulder(lines, {1: Z, **({3: lines.between(Z)} if special else {})}, "RRRP"),
        "wrist",
        "axes 1 and 3 coincide",
    ),
    "between": (
        lambda lines, special: middle(lines, {2: Z, **({4: lines.between(Z)} if special else {})}),
        "",
        "axes 2 and 4 coincide",
    ),
    "centre on axis 1": (
        lambda lines, special: on_the_axis(lines, special, 1),
        "shoulder",
        "the wrist centre lies on axis 1",
    ),
    "centre on axis 2": (lambda lines, special: on_the_axis(lines, special, 2), "", "the wrist centre lies on axis 2"),
    "crossing on axis 1": (crossing_on_the_axis, "shoulder", "the point where axes 5 and 6 meet lies on axis 1"),
    "crossing of 1 and 2": (first_crossing_on_an_axis, "", "the point where axes 1 and 2 meet lies on axis 4"),
    "two pairs": (two_pairs_become_parallel, "", "axes 3 and 4 are parallel to axes 1 and 2"),
    "two turns": (lambda lines, one: a_few_turns_become_parallel(lines, one, 2), "", "axes 1 and 2 are parallel"),
    "three turns": (lambda lines, one: a_few_turns_become_parallel(lines, one, 3), "", "axes 1 and 3 are parallel"),
    "four turns": (lambda lines, one: a_few_turns_become_parallel(lines, one, 4), "wrist", "axes 1 and 4 are parallel"),
    "nearest plane": (
        in_two_planes,
        "",
        "the point where axes 5 and 6 meet lies in the plane through axis 3 parallel to axis 4",
    ),
    "three in a plane": (
        three_in_a_plane,
        "elbow",
        "axes 2, 3 and 4 lie in one plane: the arm is stretched or folded",
    ),
    "centre in the plane of 1 and 2": (
        lambda lines, special: in_a_plane(lines, special, 1, meet=True),
        "shoulder",
        "the wrist centre lies in the plane of axes 1 and 2",
    ),
    "centre in the plane through 1": (
        lambda lines, special: in_a_plane(lines, special, 1, meet=False),
        "shoulder",
        "the wrist centre lies in the plane through axis 1 parallel to axis 2",
    ),
    "centre in the plane of 2 and 3": (
        lambda lines, special: in_a_plane(lines, special, 2, meet=True),
        "",
        "the wrist centre lies in the plane of axes 2 and 3",
    ),
    "6 parallel to 2, 3, 4": (one_becomes_parallel_to_three, "wrist", "axis 6 is parallel to axes 2, 3 and 4"),
    "2 parallel to 4, 5": (two_become_parallel_to_one, "", "axis 2 is parallel to axes 4 and 5"),
    "2 parallel to 3": (two_become_parallel, "", "axes 2 and 3 are parallel"),
    "slow": (a_point_is_carried_slowly, "", "joints 1, 2 and 3 move the wrist centre in fewer than 3 ways"),
    "1 meets 4": (two_meet_by_chance, "", "axes 1 and 4 meet"),
    "flat": (three_are_flat, "", "axes 1, 2 and 4 are parallel to one plane"),
}
ENDS: dict[str, tuple[Drawn, str, str]] = {
    "end on axis 1": (end_on_the_axis, "shoulder", "the end point lies on axis 1"),
    "end in a plane": (
        two_and_the_end_in_a_plane,
        "elbow",
        "axes 1 and 2 and the end point lie in one plane: the arm is stretched or folded",
    ),
}


def said(draw: Drawn, task: Task) -> Meaning:
    """What is said of two postures with a property, the ordinary ones being two without."""
    special, ordinary = ([draw(Lines(seed), one) for seed in seeds] for one, seeds in ((True, (1, 2)), (False, (3, 4))))
    return meaning(task, special, ordinary)


@pytest.mark.parametrize("case", CASES)
def test_every_property_is_told_by_the_first_words_that_fit(case: str) -> None:
    draw, name, reason = CASES[case]
    assert said(draw, Task.POSE) == Meaning(name, reason)


@pytest.mark.parametrize("case", ENDS)
def test_the_end_point_matters_where_its_position_is_asked_for(case: str) -> None:
    draw, name, reason = ENDS[case]
    for task in (Task.POSITION, Task.POSITION_AXIS):
        assert said(draw, task) == Meaning(name, reason)


def test_the_end_point_does_not_matter_where_the_whole_pose_is_asked_for() -> None:
    assert said(end_on_the_axis, Task.POSE).reason == "joints 2 and 3 move the end effector in fewer than 2 ways"


def test_what_holds_of_the_arm_or_of_one_posture_alone_is_not_told() -> None:
    draw = CASES["wrist in line"][0]
    special, other, ordinary = draw(Lines(1), True), draw(Lines(2), False), draw(Lines(3), False)
    assert meaning(Task.POSE, [special], [ordinary]).name == "wrist"
    assert meaning(Task.POSE, [special], [ordinary, special]).name == ""
    assert meaning(Task.POSE, [special, other], [ordinary]).name == ""


def still(*joints: int, kinds: str, task: Task) -> Meaning:
    """Meaning of a posture in which some joints do the same, and any six others do not."""
    lines = Lines(5)
    axes, points = dict.fromkeys(joints, Z), dict.fromkeys(joints, X)
    here = lines.posture(kinds, axes, points, numbers=tuple(range(2, len(kinds) + 2)))
    return meaning(task, [here], [here])


def test_where_no_words_fit_the_joints_are_counted() -> None:
    """The axes of the joints that are named are the same line."""
    assert (
        still(1, 3, kinds="RRR", task=Task.POSE).reason == "joints 2 and 4 move the end effector in fewer than 2 ways"
    )
    assert (
        still(1, 3, kinds="RRR", task=Task.POSITION).reason == "joints 2 and 4 move the end point in fewer than 2 ways"
    )
    assert still(1, 2, kinds="RR", task=Task.POSE).reason == ""
    assert still(1, kinds="PRR", task=Task.ORIENTATION).reason == "joint 2 does not move the orientation"


def test_axes_cross_where_they_meet() -> None:
    lines = Lines(6)
    for _ in range(10):
        one, two, at = lines.vector(), lines.vector(), lines.vector()
        points = {1: plus(at, lines.between(one)), 2: plus(at, lines.between(two))}
        here = lines.posture("RRR", {1: one, 2: two}, points)
        assert crossing(here, 0, 1) == crossing(here, 1, 0) == tuple(value % PRIME for value in at)
        assert crossing(here, 0, 2) is None
    for one, two in ((X, Y), (Y, Z), (Z, X)):
        here = lines.posture("RR", {1: one, 2: two}, {1: plus((5, 6, 7), one), 2: (5, 6, 7)})
        assert crossing(here, 0, 1) == (5, 6, 7)
    assert crossing(lines.posture("RR", {1: X, 2: (7, 0, 0)}, {}), 0, 1) is None
