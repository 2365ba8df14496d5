"""An oracle of its own: tables multiplied out as matrices of rational numbers, from the cells alone.

Joint angles are points of the circle c = (1-t^2)/(1+t^2), s = 2t/(1+t^2); only twists of quarter turns occur.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from fractions import Fraction

from sympy import Expr, Integer, Rational, Symbol, pi

from kinsym.algebra.tree import Num, Pow, Prod, Sum, Sym, Tree
from kinsym.kinematics.chain import Chain
from kinsym.robot.model import Convention, Joint, Robot

Rows = list[list[Fraction]]
Circle = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Values:
    """Joint angles as points of the circle, lengths and parameters as numbers."""

    circle: dict[str, Circle]
    number: dict[str, Fraction]


def sample(robot: Robot, seed: int) -> Values:
    """Random values of the joint variables and parameters."""
    generator = random.Random(seed)

    def rational() -> Fraction:
        return Fraction(generator.randrange(1, 40), generator.randrange(1, 40))

    circle, number = {}, {name: rational() for name in robot.parameters}
    for joint in robot.moving:
        t = rational()
        if joint.kind == "R":
            circle[joint.variable or ""] = ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))
        else:
            number[joint.variable or ""] = t
    return Values(circle, number)


def product(robot: Robot, values: Values) -> Rows:
    """T from the cells of the table."""
    if robot.convention is Convention.SCREW:
        return _screws(robot, values)
    total = identity()
    for joint in robot.joints:
        c, s = _angle(joint.alpha or Integer(0), joint, values)
        along_x = [[1, 0, 0, _length(joint.a, values)], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]]
        c, s = _angle(joint.theta or Integer(0), joint, values)
        along_z = [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, _length(joint.d, values)], [0, 0, 0, 1]]
        pair = (along_x, along_z) if robot.convention is Convention.CRAIG else (along_z, along_x)
        total = times(times(total, pair[0]), pair[1])
    return total


def _screws(robot: Robot, values: Values) -> Rows:
    """Successive screws: A_i about s through s0 by Rodrigues' formula, then the home pose."""
    total = identity()
    for joint in robot.joints:
        s = [_length(cell, values) for cell in joint.s or ()]
        s0 = [_length(cell, values) for cell in joint.s0 or ()]
        if joint.kind == "P":
            shift = values.number[joint.variable or ""]
            turned = [[Fraction(int(i == j)) for j in range(3)] for i in range(3)]
            moved = [shift * component for component in s]
        else:
            cosine, sine = values.circle[joint.variable or ""]
            cross = [[Fraction(0), -s[2], s[1]], [s[2], Fraction(0), -s[0]], [-s[1], s[0], Fraction(0)]]
            turned = [
                [cosine * int(i == j) + (1 - cosine) * s[i] * s[j] + sine * cross[i][j] for j in range(3)]
                for i in range(3)
            ]
            moved = [s0[i] - sum(turned[i][j] * s0[j] for j in range(3)) for i in range(3)]
        total = times(total, [[*turned[i], moved[i]] for i in range(3)] + [[0, 0, 0, 1]])
    return times(total, home(robot, values))


def home(robot: Robot, values: Values) -> Rows:
    """The home pose [u0 v0 w0 q0] of a table of screws."""
    pose = robot.home
    assert pose is not None
    columns = [[_length(cell, values) for cell in part] for part in (pose.u0, pose.v0, pose.w0, pose.q0)]
    return [[column[i] for column in columns] for i in range(3)] + [[0, 0, 0, 1]]


def identity() -> Rows:
    """The unit matrix."""
    return [[Fraction(int(i == j)) for j in range(4)] for i in range(4)]


def times(left: Rows, right: Rows) -> Rows:
    """The product of two 4x4 matrices."""
    return [[sum((left[i][k] * right[k][j] for k in range(4)), Fraction(0)) for j in range(4)] for i in range(4)]


def _length(cell: Expr | None, values: Values) -> Fraction:
    result = (cell or Integer(0)).subs(
        {Symbol(name, real=True): Rational(v.numerator, v.denominator) for name, v in values.number.items()}
    )
    return Fraction(int(result.p), int(result.q))


def _angle(cell: Expr, joint: Joint, values: Values) -> Circle:
    point = (Fraction(1), Fraction(0))
    rest = cell
    if joint.kind == "R" and joint.variable:
        symbol = Symbol(joint.variable, real=True)
        sign = int(cell.coeff(symbol))
        if sign:
            c, s = values.circle[joint.variable]
            point, rest = (c, s * sign), cell - sign * symbol
    quarters = int(rest / (pi / 2)) % 4
    for _ in range(quarters):
        point = (-point[1], point[0])
    return point


def of_chain(chain: Chain, values: Values, poly: object) -> Fraction:
    """A polynomial of the ring at the same values."""
    numbers = _numbers(chain, values)
    total = Fraction(0)
    for monomial, coefficient in poly.terms():  # type: ignore[attr-defined]
        term = Fraction(int(coefficient.numerator), int(coefficient.denominator))
        for generator, exponent in zip(chain.ring.generators, monomial, strict=True):
            if exponent:
                term *= numbers[generator.name] ** exponent
        total += term
    return total


def of_tree(chain: Chain, values: Values, tree: Tree) -> Fraction:
    """An expression as it is printed, at the same values."""
    numbers = _numbers(chain, values)

    def value(part: Tree) -> Fraction:
        match part:
            case Num(number):
                return number
            case Sym(name):
                return numbers[name]
            case Sum(terms):
                return sum(map(value, terms), Fraction(0))
            case Prod(factors):
                return math.prod(map(value, factors), start=Fraction(1))
            case Pow(base, exponent):
                return value(base) ** exponent
            case _:
                raise TypeError(f"{part} does not occur in a link transform")

    return value(tree)


def _numbers(chain: Chain, values: Values) -> dict[str, Fraction]:
    """Every generator of the ring by name; sums of angles follow from their parts."""
    numbers = dict(values.number)
    for angle in chain.angles.values():
        c, s = Fraction(1), Fraction(0)
        for variable, sign in angle.terms:
            c2, s2 = values.circle[variable]
            c, s = c * c2 - s * s2 * sign, s * c2 + c * s2 * sign
        numbers[angle.cosine], numbers[angle.sine] = c, s
    return numbers
