"""How equations hang together: what varies, what is independent, what can be solved for and where that fails."""

from __future__ import annotations

from collections.abc import Mapping

from kinsym.algebra.field import PRIME, inverse
from kinsym.algebra.linear import kernel
from kinsym.lecture.case import Case
from kinsym.lecture.notation import parse_any
from kinsym.lecture.quantities import Turn, Value
from kinsym.lecture.reading import Reading, read
from kinsym.lecture.residue import Residue, Undefined

QUARTER = Turn(Residue(0), Residue(1))


def varying(case: Case) -> bool:
    """How many entries of some matrices are no constants."""
    first, second, _ = case.readings()
    for name, count in case.option("varying").items():
        pairs = zip(_entries(first, name), _entries(second, name), strict=True)
        if sum(before != after for before, after in pairs) != count:
            return False
    return True


def _entries(reading: Reading, formula: str) -> list[Residue]:
    value = reading.evaluate(parse_any(formula))
    cells = [cell for row in value for cell in row] if isinstance(value, tuple) else [value]
    return [cell for cell in cells if isinstance(cell, Residue)]


def rank(case: Case) -> bool:
    """How many directions a quantity can move in while others are held."""
    wanted = case.option("rank")
    for reading in case.readings():
        held = [row for formula in wanted["held"] for row in _derivative(reading, formula)]
        free = held + _derivative(reading, wanted["of"])
        if rank_of(free) - rank_of(held) != wanted["is"]:
            return False
    return True


def _derivative(reading: Reading, formula: str) -> list[list[int]]:
    """The Jacobian of a quantity's entries, one row each.

    Each entry is linear in the cosine and sine of one joint angle, so that half the difference between a quarter turn
    on and a quarter turn back is the derivative.
    """
    assert reading.system is not None
    columns = []
    for joint in reading.system.robot.moving:
        name = joint.variable or ""
        value = reading.values[name]
        turns = isinstance(value, Turn)
        places = (value.plus(QUARTER), value.plus(QUARTER.opposite())) if turns else (value + Residue(1), value)
        scale = inverse(2) if turns else 1
        after, before = (_entries(_with(reading, {name: place}), formula) for place in places)
        columns.append([(x - y).value * scale % PRIME for x, y in zip(after, before, strict=True)])
    return [list(row) for row in zip(*columns, strict=True)]


def _with(reading: Reading, changed: Mapping[str, Value]) -> Reading:
    return Reading(reading.chapter, reading.system, {**reading.values, **changed}, reading.given)


def rank_of(rows: list[list[int]]) -> int:
    """The rank of a matrix modulo the prime.

    >>> rank_of([[1, 2], [2, 4], [0, 1]])
    2
    """
    return len(rows[0]) - len(kernel(rows)) if rows else 0


def solves(case: Case) -> bool:
    """Some equations are linear in as many unknowns, and their determinant does not vanish."""
    wanted = case.option("solves")
    for reading in case.readings():
        matrix = []
        for name in wanted["equations"]:
            left, right = (case.chapter.entry(name).printed.members[k] for k in (0, -1))
            row = []
            for unknown in wanted["unknowns"]:
                sides = []
                for value in (1, 0):
                    there = Reading(case.chapter, reading.system, reading.values, {unknown: Residue(value)})
                    sides.append([there.evaluate.scalar(side) for side in (left, right)])
                (a1, b1), (a0, b0) = sides
                difference = (a1 - b1) - (a0 - b0)
                assert isinstance(difference, Residue)
                row.append(difference.value)
            matrix.append(row)
        if rank_of(matrix) != len(wanted["unknowns"]):
            return False
    return True


def divides(case: Case) -> bool:
    """Some formulas have a value at a random posture, and none of them where the sine of one joint angle is zero."""
    wanted = case.option("divides")
    formulas = [case.chapter.entry(name).printed.members[-1] for name in wanted["equations"]]
    for reading in case.readings():
        there = read(case.chapter, reading.system, case.generator("zero"), {wanted["by"]: "0"})
        for formula in formulas:
            reading.evaluate(formula)
            try:
                there.evaluate(formula)
            except Undefined:
                continue
            return False
    return True
