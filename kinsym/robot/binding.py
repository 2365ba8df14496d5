"""Parameters of a table: finding them, giving them values, folding values in.

A folded value is part of the geometry: a2 = 0 makes two axes meet, and a derivation that kept the symbol would
divide by it. Values that are exactly zero are therefore always folded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

import sympy
from sympy import Expr, Rational

from kinsym.errors import RobotError
from kinsym.robot.expressions import names, symbol
from kinsym.robot.model import Home, Joint, Matrix, Robot, Vector
from kinsym.robot.names import check_parameter, nearest, shown
from kinsym.robot.rows import cells_of


def used_parameters(robot: Robot, *, where: str) -> tuple[str, ...]:
    """Every name of the table that is no joint variable, in order of first use; RobotError if one is unusable."""
    found: dict[str, None] = {}
    variables = set(robot.variables)
    for place, cell in _cells(robot):
        for name in names(cell):
            if name in variables and place.startswith("["):
                raise RobotError(
                    f"the joint variable {name} stands in a fixed transform",
                    where=f"{where}, {place}",
                    remedy="Base, tool and home do not move.",
                )
            if name not in variables and name not in found:
                found[check_parameter(name, where=f"{where}, {place}")] = None
    return tuple(found)


def bind(robot: Robot, values: Mapping[str, Fraction]) -> Robot:
    """The robot with numbers in place of parameters.

    ``values`` maps names of parameters to exact numbers. Raises RobotError for a name that is no parameter.

    >>> from kinsym.robot import load
    >>> from fractions import Fraction
    >>> bound = bind(load("planar_rr"), {"l1": Fraction(1, 2)})
    >>> bound.joints[0].a, list(bound.parameters)
    (1/2, ['l2'])
    """
    for name in values:
        if name in robot.variables:
            raise RobotError(
                f"{name} is a joint variable",
                where=f"bind {shown(name)[1:-1]}",
                remedy="Bind parameters only; a joint is held at a value by a lock (--lock).",
            )
        if name not in robot.parameters:
            has = ", ".join(robot.parameters) or "none"
            raise RobotError(
                f"{robot.name} has no parameter {shown(name)[1:-1]}",
                where=f"bind {shown(name)[1:-1]}",
                remedy=f"{nearest(name, robot.parameters)}Its parameters: {has}.",
            )
    numbers = {symbol(name): Rational(value.numerator, value.denominator) for name, value in values.items()}

    def fold(cell: Expr) -> Expr:
        return sympy.expand(cell.xreplace(numbers))

    return replace(
        robot,
        joints=tuple(_fold_joint(joint, fold) for joint in robot.joints),
        home=_fold_home(robot.home, fold),
        base=_fold_matrix(robot.base, fold),
        tool=_fold_matrix(robot.tool, fold),
        parameters={name: value for name, value in robot.parameters.items() if name not in values},
    )


def fold_zeros(robot: Robot) -> Robot:
    """The robot with every parameter whose value is exactly zero folded in, and a note about each."""
    zeros = [name for name, value in robot.parameters.items() if value == 0]
    notes = tuple(f"{name} = 0 in the table, so it is left out of the equations." for name in zeros)
    bound = bind(robot, dict.fromkeys(zeros, Fraction(0)))
    return replace(bound, notes=(*robot.notes, *notes))


def _cells(robot: Robot) -> Iterator[tuple[str, Expr]]:
    for i, joint in enumerate(robot.joints, start=1):
        for column, cell in cells_of(joint):
            yield f"joints row {i}, {column}", cell
    if robot.home:
        for key in ("u0", "v0", "w0", "q0"):
            for cell in getattr(robot.home, key):
                yield f"[home] {key}", cell
    for key, matrix in (("[base]", robot.base), ("[tool]", robot.tool)):
        for row in matrix or ():
            for cell in row:
                yield key, cell


_Fold = Callable[[Expr], Expr]


def _fold_vector(vector: Vector, fold: _Fold) -> Vector:
    return fold(vector[0]), fold(vector[1]), fold(vector[2])


def _fold_joint(joint: Joint, fold: _Fold) -> Joint:
    def link(cell: Expr | None) -> Expr | None:
        return None if cell is None else fold(cell)

    s0 = None if joint.s0 is None else _fold_vector(joint.s0, fold)
    return replace(joint, alpha=link(joint.alpha), a=link(joint.a), d=link(joint.d), theta=link(joint.theta), s0=s0)


def _fold_home(home: Home | None, fold: _Fold) -> Home | None:
    return home and replace(home, q0=_fold_vector(home.q0, fold))


def _fold_matrix(matrix: Matrix | None, fold: _Fold) -> Matrix | None:
    return matrix and tuple(tuple(fold(cell) for cell in row) for row in matrix)
