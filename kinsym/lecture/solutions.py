"""Solutions of an inverse kinematics: every branch that the lecture prints must lead to the pose.

At a pose that is made from random joint values the roots that the lecture takes are perfect squares on the way that
leads back, so that its formulas have values modulo the prime. Other ways may need a root that the field lacks, which
stands for a goal out of reach; then another pose is taken.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from kinsym.lecture.case import Case
from kinsym.lecture.chapter import Form
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import Node, names_of, parse, parse_relation
from kinsym.lecture.quantities import Slope, Turn, Value, agree
from kinsym.lecture.reading import Known, Reading
from kinsym.lecture.relation import holds
from kinsym.lecture.residue import Residue, Undefined

POSES = 200
"""Poses that are tried until every way has its roots in the field; of eight ways about one pose in eight does."""


def solution(case: Case) -> bool:
    """Every branch satisfies the equations it solves, no two are the same, and one is the joint value."""
    unknown = case.option("unknown")
    branches = [parse(text) for text in case.option("branches")]
    if len(branches) != case.option("count"):
        return False
    for reading in case.readings():
        true = reading.value_of(unknown)
        known = _without(case, reading, unknown)
        values = [_angle_or_length(known.evaluate(branch), true) for branch in branches]
        distinct = all(not agree(x, y) for i, x in enumerate(values) for y in values[:i])
        if not distinct or not any(agree(value, true) for value in values):
            return False
        if not all(_satisfies(case, known, unknown, value) for value in values):
            return False
        if not _printed_is_branch(case, known, values):
            return False
    return all(_condition(case, condition) for condition in case.option("conditions") or ())


def _without(case: Case, reading: Reading, unknown: str) -> Known:
    """What is known before a step: the pose, the parameters, the other joints, and what the step takes from before."""
    pose = {name: reading.value_of(name) for name in (*case.chapter.pose, *(case.option("held") or ()))}
    free = {name: reading.value_of(name) for name in case.chapter.names} if reading.system is None else {}
    values = {name: value for name, value in reading.values.items() if name != unknown}
    given = {**{name: value for name, value in free.items() if name != unknown}, **pose}
    using = _using(case, case.option("using") or {}, reading, values, given)
    return Known(case.chapter, None, values, {**given, **using})


def _using(
    case: Case, using: Mapping[str, str], reading: Reading, values: Mapping[str, Value], given: Mapping[str, Value]
) -> dict[str, Value]:
    """Names whose values other entries supply."""
    found: dict[str, Value] = {}
    for name, entry in using.items():
        form = _true_form(case, entry)
        known = Known(case.chapter, None, values, given)
        found[name] = known.evaluate(form.members[-1])
    return found


def _true_form(case: Case, name: str) -> Form:
    """The mended form of an entry where there is one."""
    entry = case.chapter.entry(name)
    return entry.mended or entry.printed


def _angle_or_length(value: Value, like: Value) -> Value:
    if isinstance(like, Turn) and isinstance(value, Slope):
        raise Undefined("a branch that is known up to half a turn")
    return value


def _satisfies(case: Case, known: Known, unknown: str, value: Value) -> bool:
    there = Known(case.chapter, None, {**known.values, unknown: value}, _solved(known, unknown))
    for name in case.option("satisfies"):
        members = _true_form(case, name).members
        if not agree(there.evaluate(members[0]), there.evaluate(members[-1])):
            return False
    return True


def _solved(known: Known, unknown: str) -> dict[str, Value]:
    """What was given less the cosine and sine of the unknown, which now has a value."""
    digits = unknown.removeprefix(known.chapter.shorthand)
    return {name: value for name, value in known.given.items() if name not in (f"c{digits}", f"s{digits}", unknown)}


def _printed_is_branch(case: Case, known: Known, values: list[Value]) -> bool:
    """With either sign the printed formula gives one of the branches, up to the half turn an inverse tangent leaves."""
    left, right = case.form.members[0], case.form.members[-1]
    signs = (Residue(1), -Residue(1)) if "pm" in names_of(right) else (Residue(1),)
    for sign in signs:
        there = Known(case.chapter, None, known.values, {**known.given, "pm": sign})
        value = there.evaluate(right)
        if not any(agree(_scaled(left, case.option("unknown"), branch), value) for branch in values):
            return False
    return True


def _scaled(left: Node, unknown: str, branch: Value) -> Value:
    """The left side of a solution where the unknown has a value: ``theta3`` or ``theta3/2``."""
    return Evaluator({unknown: branch}.__getitem__)(left)


def _condition(case: Case, condition: Mapping[str, object]) -> bool:
    """How many real solutions there are, at numbers that meet a condition."""
    examples = condition["at"]
    assert isinstance(examples, list)
    for example in examples:
        numbers = {name: Fraction(text) for name, text in example.items()}
        evaluate = Evaluator(numbers.__getitem__, exact=True)
        if not holds(parse_relation(str(condition["when"])), evaluate):
            return False
        found: list[Value] = []
        for text in case.option("branches"):
            try:
                value = evaluate(parse(text))
            except Undefined:
                continue
            if value not in found:
                found.append(value)
        if len(found) != condition["solutions"]:
            return False
    return bool(examples)


def ways(case: Case) -> bool:
    """A whole way from the pose to the joint values has as many solutions as a sentence says."""
    return all(
        total == way["total"] and way_holds(case, way)
        for name, total in case.option("ways").items()
        for way in case.chapter.ways
        if way["id"] == name
    )


def way_holds(case: Case, way: Mapping[str, object]) -> bool:
    """Every solution of a way leads to the pose, and at some pose there are as many as the lecture says.

    Of a length that may be positive or negative the lecture keeps the positive; the solutions come in two halves.
    """
    most = 0
    for reading in case.readings(range(POSES)):
        found = _walk(case, way, reading)
        if found is None:
            continue
        if len(found) > int(str(way["total"])):
            return False
        most = max(most, len(found))
        if most == way["total"]:
            halves = {q[str(way["positive"])] for q in found} if "positive" in way else set()
            kept = [sum(q[str(way["positive"])] == half for q in found) for half in halves]
            return all(count == way["kept"] for count in kept)
    return False


def _walk(case: Case, way: Mapping[str, object], reading: Reading) -> list[dict[str, Value]] | None:
    """All solutions at one pose; None where a root is not in the field. Raises Undefined where one misses the pose."""
    assert reading.system is not None
    joints = reading.system.robot.variables
    pose = {name: reading.value_of(name) for name in case.chapter.pose}
    constants = {name: value for name, value in reading.values.items() if name not in joints}
    found: list[dict[str, Value]] = [{}]
    steps = way["steps"]
    assert isinstance(steps, list)
    for name in steps:
        step = Case(case.chapter, case.chapter.entry(name), case.chapter.entry(name).printed)
        unknown = step.option("unknown")
        longer = []
        for q in found:
            using = _using(step, step.option("using") or {}, reading, {**constants, **q}, pose)
            known = Known(case.chapter, None, {**constants, **q}, {**pose, **using})
            try:
                longer += [{**q, unknown: known.evaluate(parse(text))} for text in step.option("branches")]
            except Undefined as reason:
                if "root" in str(reason):
                    return None
                raise
        found = longer
    return _reaching(way, reading, found)


def _reaching(way: Mapping[str, object], reading: Reading, found: list[dict[str, Value]]) -> list[dict[str, Value]]:
    """The different solutions, all of which must reach the pose, the one it was made from among them."""
    assert reading.system is not None
    goal = parse(
        str(way.get("reaches", "T_0_E" if reading.system.screws else f"T_0_{len(reading.system.robot.joints)}"))
    )
    wanted = reading.evaluate(goal)
    joints = reading.system.robot.variables
    different: list[dict[str, Value]] = []
    for q in found:
        solved = {name: value for name, value in q.items() if name in joints}
        there = Reading(reading.chapter, reading.system, {**reading.values, **solved})
        if there.evaluate(goal) != wanted:
            raise Undefined("a solution misses the pose")
        if solved not in different:
            different.append(solved)
    if not any(all(agree(value, reading.values[name]) for name, value in q.items()) for q in different):
        raise Undefined("the joint values of the pose are not among the solutions")
    return different
