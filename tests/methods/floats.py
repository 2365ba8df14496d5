"""A method's derivation followed with floats: what the prime field cannot tell, half turns of Atan2 and real roots.

At a random posture every definition is worked out in the order of the page, every equation is compared, and the values
of every solution are listed with all their signs: the joint must be one of them.
"""

from __future__ import annotations

import cmath
import math
import random
from itertools import product

import sympy

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree, symbols
from kinsym.kinematics.chain import Chain
from kinsym.kinematics.forward import pose_columns
from kinsym.methods.document import Equation, Matrix, MethodDerivation

CLOSE = 1e-7


class Posture:
    """A random posture of a chain in floats."""

    def __init__(self, chain: Chain, seed: int) -> None:
        rng = random.Random(seed)
        ring = chain.ring
        self.angles: dict[str, float] = {}
        cells = {name: rng.uniform(0.4, 1.0) for name in chain.robot.parameters}
        self.numbers = dict(cells)
        for name, expression in chain.constants.formulas():
            values = {sympy.Symbol(key, real=True): value for key, value in self.numbers.items()}
            self.numbers[name] = float(expression.subs(values).evalf())
        joints = {j.variable: rng.uniform(-3.0, 3.0) if j.kind == "R" else rng.uniform(0.3, 1.0) for j in chain.joints}
        for joint in chain.joints:
            if joint.kind == "P":
                self.numbers[joint.variable] = joints[joint.variable]
        for angle in chain.angles.values():
            value = sum(sign * joints[name] for name, sign in angle.terms)
            self.angles[angle.name] = value
            self.numbers[angle.cosine], self.numbers[angle.sine] = math.cos(value), math.sin(value)
        for letter, column in zip("uvwp", pose_columns(chain), strict=True):
            for row, entry in zip("xyz", column, strict=True):
                self.numbers[f"{letter}_{row}"] = self._poly(ring, entry)

    def _poly(self, ring: object, poly: object) -> float:
        total = 0.0
        for monomial, coefficient in poly.terms():
            term = float(coefficient)
            for generator, exponent in zip(ring.generators, monomial, strict=True):
                term *= self.numbers[generator.name] ** exponent if exponent else 1.0
            total += term
        return total

    def values(self, tree: Tree) -> list[complex]:
        """All values of a formula; angles are radians."""
        match tree:
            case Num(value):
                return [float(value)]
            case Pi():
                return [math.pi]
            case Sym(name):
                return [self.angles[name] if name in self.angles else self.numbers[name]]
            case Sum(terms):
                return [sum(chosen) for chosen in product(*map(self.values, terms))]
            case Prod(factors):
                return [math.prod(chosen) for chosen in product(*map(self.values, factors))]
            case Pow(base, exponent):
                return [value**exponent for value in self.values(base)]
            case Quot(above, below):
                return [a / b for a, b in product(self.values(above), self.values(below)) if b]
            case PlusMinus(left, right):
                lefts = [0.0] if left is None else self.values(left)
                return [v for a, b in product(lefts, self.values(right)) for v in (a + b, a - b)]
            case Call("atan2", (y, x)):
                return [math.atan2(_real(b), _real(a)) for b, a in product(self.values(y), self.values(x))]
            case Call(function, (inner,)):
                return [_FUNCTIONS[function](value) for value in self.values(inner)]
        raise AssertionError(tree)

    def knows(self, tree: Tree) -> bool:
        """Whether every name of a formula has a value."""
        return all(name in self.numbers or name in self.angles for name in symbols(tree))


def _real(value: complex) -> float:
    return value.real if isinstance(value, complex) else value


_FUNCTIONS = {
    "sqrt": lambda value: _principal(cmath.sqrt(value)),
    "acos": lambda value: _principal(cmath.acos(value)),
    "asin": lambda value: _principal(cmath.asin(value)),
    "atan": lambda value: math.atan(_real(value)),
    "abs": abs,
    "cos": lambda value: math.cos(_real(value)),
    "sin": lambda value: math.sin(_real(value)),
    "tan": lambda value: math.tan(_real(value)),
    "v": lambda value: 1.0 - math.cos(_real(value)),
}


def _principal(value: complex) -> float:
    """The real value of a root that rounding has made a little complex; NaN of one that is."""
    return value.real if abs(value.imag) < 1e-6 else math.nan


def follow(derivation: MethodDerivation, posture: Posture) -> list[str]:
    """Work a derivation out; the names of equations that are wrong and of unknowns that are not found."""
    wrong: list[str] = []
    solved = {equation.name for solution in derivation.solutions for equation in solution.equations}
    for equation in derivation.equations:
        if equation.sign == "=" and equation.name not in solved:
            wrong += _follow_one(equation, posture)
    for solution in derivation.solutions:
        found = [_real(v) for e in solution.equations for v in posture.values(e.right)]
        turns = solution.unknown in posture.angles
        truth = posture.angles[solution.unknown] if turns else posture.numbers[solution.unknown]
        if not any(_same(truth, value, turns) for value in found):
            wrong.append(solution.unknown)
        if len({(round(math.cos(v), 6), round(math.sin(v), 6)) for v in found}) > solution.branches:
            wrong.append(f"{solution.unknown} has more values than it says")
    return wrong


def _follow_one(equation: Equation, posture: Posture) -> list[str]:
    left, right = equation.left, equation.right
    if isinstance(left, Matrix) and isinstance(right, Matrix):
        pairs = [pair for rows in zip(left.rows, right.rows, strict=True) for pair in zip(*rows, strict=True)]
    elif isinstance(left, TREES) and isinstance(right, TREES):
        pairs = [(left, right)]
    else:
        return []
    return [equation.name for pair in pairs if not _holds(*pair, equation.name, posture)]


def _holds(left: Tree, right: Tree, name: str, posture: Posture) -> bool:
    """Whether an entry of an equation holds; one with a new name on the left gives it its value."""
    if any(symbol in ("q_x", "q_y", "q_z") for symbol in symbols(right)):
        return True  # the end effector, of which the posture knows the wrist point alone
    if isinstance(left, Sym) and (not posture.knows(left) or name.endswith(".from_E")):
        angle = _is_angle(right, posture)
        (posture.angles if angle else posture.numbers)[left.name] = _real(posture.values(right)[0])
        return True
    turns = isinstance(left, Sym) and left.name in posture.angles
    return any(_same(a, b, turns) for a in posture.values(left) for b in posture.values(right))


TREES = (Num, Sym, Sum, Prod, Pow, Quot, Call, PlusMinus, Pi)


def _is_angle(tree: Tree, posture: Posture) -> bool:
    if isinstance(tree, Call):
        return tree.function in ("atan2", "atan", "acos", "asin")
    return any(name in posture.angles for name in symbols(tree))


def _same(a: complex, b: complex, turns: bool) -> bool:
    difference = a - b
    if turns:
        difference = math.remainder(_real(difference), 2.0 * math.pi)
    return abs(difference) < CLOSE * max(1.0, abs(a))
