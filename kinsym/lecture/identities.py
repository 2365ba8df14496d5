"""Is an equation of the lecture identically true? Decided at random postures modulo the prime."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import replace

from kinsym.algebra.field import PRIME
from kinsym.lecture.case import POINTS, Case, find
from kinsym.lecture.evaluate import Evaluator, all_agree
from kinsym.lecture.notation import Node, parse, parse_any
from kinsym.lecture.posture import Posture, random_number, random_turn
from kinsym.lecture.quantities import Slope, Turn, Value, agree
from kinsym.lecture.reading import Reading, read
from kinsym.lecture.residue import Residue, Undefined
from kinsym.robot.model import Joint


def identity(case: Case) -> bool:
    """All members are equal, with every special value that the entry gives."""
    return all(all_agree([reading.evaluate(member) for member in case.form.members]) for reading in case.readings())


def means(case: Case) -> bool:
    """What a sentence claims, written in equations."""
    if case.option("rows_of"):
        return all(_states(case, reading) for reading in _rows(case))
    if case.option("home"):
        return all(_states(case, _at_home(reading)) for reading in case.readings())
    return all(_states(case, reading) for reading in case.readings())


def _states(case: Case, reading: Reading) -> bool:
    for left, sign, right in case.form.means:
        if agree(reading.evaluate(left), reading.evaluate(right)) != (sign == "="):
            return False
    return all_agree([reading.evaluate(member) for member in case.form.members]) if case.form.members else True


def _at_home(reading: Reading) -> Reading:
    """The same with every joint variable zero."""
    assert reading.system is not None
    zeros = {joint.variable or "": _zero(joint) for joint in reading.system.robot.moving}
    return Reading(reading.chapter, reading.system, {**reading.values, **zeros}, reading.given)


def _zero(joint: Joint) -> Value:
    return Turn(Residue(1), Residue(0)) if joint.kind == "R" else Residue(0)


def _rows(case: Case) -> Iterator[Reading]:
    """A reading for every row of some tables of screws: its axis is s_vec through s0_vec, its displacement A_i by d."""
    for name in case.option("rows_of"):
        generator = case.generator(name)
        found = find(name, generator)
        reading = read(replace(case.chapter, names={}), found, generator)
        if case.option("home"):
            reading = _at_home(reading)
        posture = Posture(found, reading.values)
        for number, joint in enumerate(found.robot.joints, start=1):
            if joint.s is None or joint.s0 is None:
                continue
            row: dict[str, Value] = {
                "s_vec": reading.column(joint.s),
                "s0_vec": reading.column(joint.s0),
                "d": reading.values[joint.variable or ""] if joint.kind == "P" else Residue(0),
                "A_i": posture.matrix(found.link(number)),
            }
            yield Reading(reading.chapter, found, reading.values, row)


def each(case: Case) -> bool:
    """Every factor of a printed product is the matrix it stands for."""
    names = case.option("each")
    return all(
        agree(reading.text(name), reading.evaluate(factor))
        for reading in case.readings()
        for name, factor in zip(names, case.form.factors, strict=True)
    )


def multiple_of(case: Case) -> bool:
    """The equation is a constant multiple of another one, whatever its names stand for."""
    other = case.chapter.entry(case.option("multiple_of")).printed
    ratios = set()
    for point in range(POINTS):
        evaluate = _anything(case.generator(("any", point)))
        own, others = (_difference(evaluate, form.members) for form in (case.form, other))
        ratios.add(own / others)
    return len(ratios) == 1


def _anything(generator: random.Random) -> Evaluator:
    """Every name stands for a random number."""
    values: dict[str, Value] = {}
    return Evaluator(lambda name: values.setdefault(name, random_number(generator)))


def _difference(evaluate: Evaluator, members: tuple[Node, ...]) -> Residue:
    left, right = (evaluate.scalar(member) for member in (members[0], members[-1]))
    difference = left - right
    assert isinstance(difference, Residue)
    return difference


def free_of(case: Case) -> bool:
    """A quantity does not change with some joints."""
    return all(_same_after(case, reading, case.option("free_of")) for reading in case.readings())


def moved_by(case: Case) -> bool:
    """A quantity changes with every one of some joints."""
    return not any(
        _same_after(case, reading, [name]) for reading in case.readings() for name in case.option("moved_by")
    )


def _same_after(case: Case, reading: Reading, names: list[str]) -> bool:
    generator = case.generator("after")
    moved: dict[str, Value] = {
        name: random_turn(generator) if isinstance(reading.values[name], Turn) else random_number(generator)
        for name in names
    }
    there = Reading(case.chapter, reading.system, {**reading.values, **moved}, reading.given)
    quantity = parse(case.option("quantity"))
    return agree(reading.evaluate(quantity), there.evaluate(quantity))


def degree(case: Case) -> bool:
    """With all else fixed the equation is a polynomial of this degree in the tangent of half an angle, no less."""
    wanted, name = case.option("degree")["is"], case.option("degree")["in"]
    return all(_degree(case, reading, name) == wanted for reading in case.readings())


def _degree(case: Case, reading: Reading, name: str) -> int:
    """The degree of (1 + t^2)^k times the difference of both sides, k as small as leaves a polynomial.

    The pose is fixed: what the left side holds of it are numbers.
    """
    fixed = {symbol: reading.value_of(symbol) for symbol in ("r", "z")}
    samples: dict[int, int] = {}
    for t in range(2, 14):
        turned = {**reading.values, name: Slope(Residue(t)).twice()}
        there = Reading(case.chapter, reading.system, turned, {**reading.given, **fixed})
        samples[t] = _difference(there.evaluate, case.form.members).value
    for k in range(4):
        found = _polynomial_degree({t: value * pow(1 + t * t, k, PRIME) % PRIME for t, value in samples.items()})
        if found < len(samples) - 2:
            return found
    raise Undefined("no polynomial of low degree")


def _polynomial_degree(samples: Mapping[int, int]) -> int:
    """The degree of the polynomial through some points, by divided differences; -1 for zero."""
    points, row = list(samples), list(samples.values())
    found = -1
    for order in range(len(points)):
        if row[0]:
            found = order
        row = [
            (row[i + 1] - row[i]) * pow(points[i + order + 1] - points[i], -1, PRIME) % PRIME
            for i in range(len(row) - 1)
        ]
    return found


def closes(case: Case) -> bool:
    """The last member solves an equation for an unknown."""
    unknown, equation = case.option("closes")["unknown"], case.option("closes")["equation"]
    left, right = (parse(part) for part in equation.split(" = "))
    for reading in case.readings():
        given = {unknown: reading.evaluate(case.form.members[-1])}
        there = Reading(case.chapter, reading.system, reading.values, given)
        if not agree(there.evaluate(left), there.evaluate(right)) or case.form.texts[0] != unknown:
            return False
    return True


def same_pose(case: Case) -> bool:
    """Other systems have the same pose of the end effector once their names are replaced."""
    for reading in case.readings():
        assert reading.system is not None
        pose = Posture(reading.system, reading.values).matrix(reading.system.pose)
        for name, renamed in case.option("same_pose").items():
            other = find(name, case.generator())
            names = (*other.robot.variables, *other.robot.parameters)
            values = {item: reading.values[renamed.get(item, item)] for item in names}
            if Posture(other, values).matrix(other.pose) != pose:
                return False
    return True


def special_value(case: Case) -> bool:
    """A definition of the lecture has the value of another quantity."""
    node = parse_any(case.option("equals"))
    return all(agree(reading.evaluate(case.form.members[-1]), reading.evaluate(node)) for reading in case.readings())
