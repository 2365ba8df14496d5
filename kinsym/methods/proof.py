"""Is an equation of a method true of the robot? Both sides are evaluated at random joint values modulo the prime.

The values come from the robot's own chain: cosines and sines of its joints and of their sums, parameters, and the pose
that these joints make. A formula with a root or a sign ± has several values, of which one must be that of the joint. An
angle is a direction (x, y) up to a factor, as a prime field knows no signs: ``atan2(y, x)`` is proved up to half a
turn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import product

from sympy.ntheory import sqrt_mod

from kinsym.algebra.field import PRIME, Point, angle_point, inverse, residue
from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree
from kinsym.methods.document import INVERSE, TRANSPOSE, Factor, Matrix, Product, Side

Rows = list[list[int]]


class ProofFailed(AssertionError):
    """A method has stated an equation that does not hold: a defect of kinsym, never of the robot."""


@dataclass
class Witness:
    """One random point: numbers, angles (cosine, sine) and matrices by name."""

    numbers: dict[str, int]
    angles: dict[str, Point]
    matrices: dict[str, Rows] = field(default_factory=dict)

    def holds(self, left: Side, right: Side) -> bool:
        """Whether both sides are equal here, for one of the signs that the right side leaves open."""
        if isinstance(left, (Matrix, Product)) or isinstance(right, (Matrix, Product)):
            return self.rows(left) == self.rows(right)
        if isinstance(left, Sym) and left.name in self.angles:
            x, y = self.angles[left.name]
            return any((x * b - y * a) % PRIME == 0 and (a or b) for a, b in self.directions(right))
        return bool(self.values(left) & self.values(right))

    def rows(self, side: Side) -> Rows:
        """A matrix, or a product of matrices, in numbers."""
        match side:
            case Matrix(rows):
                return [[self.value(cell) for cell in row] for row in rows]
            case Product(factors):
                parts = [self._factor(factor) for factor in factors]
                total = parts[-1]
                for part in reversed(parts[:-1]):
                    total = multiplied(part, total)
                return total
            case _:
                raise ProofFailed("a matrix is said to equal a number")

    def _factor(self, factor: Factor | Matrix) -> Rows:
        if isinstance(factor, Matrix):
            return self.rows(factor)
        rows = self.matrices[factor.name]
        if factor.mark == INVERSE:
            return _rigid_inverse(rows)
        return [list(column) for column in zip(*rows, strict=True)] if factor.mark == TRANSPOSE else rows

    def value(self, tree: Tree) -> int:
        """The value of a formula that has one."""
        found = self.values(tree)
        if len(found) != 1:
            raise ProofFailed(f"{tree} has {len(found)} values where one is expected")
        return next(iter(found))

    def values(self, tree: Tree) -> frozenset[int]:
        """All values that a formula can have here."""
        match tree:
            case Num(value):
                return frozenset([residue(value)])
            case Sym(name):
                if name not in self.numbers:
                    raise ProofFailed(f"{name} has no value")
                return frozenset([self.numbers[name]])
            case Sum(terms):
                return self._combined(terms, sum)
            case Prod(factors):
                return self._combined(factors, _product)
            case Pow(base, exponent):
                return frozenset(pow(value, exponent, PRIME) for value in self.values(base))
            case Quot(above, below):
                pairs = product(self.values(above), self.values(below))
                return frozenset(a * inverse(b) % PRIME for a, b in pairs if b)
            case PlusMinus(left, right):
                lefts = frozenset([0]) if left is None else self.values(left)
                pairs = product(lefts, self.values(right))
                return frozenset(value % PRIME for a, b in pairs for value in (a + b, a - b))
            case Call("sqrt" | "abs" as function, (inner,)):
                return _roots(self.values(inner)) if function == "sqrt" else _either(self.values(inner))
            case Call("cos" | "sin" as function, (angle,)):
                return frozenset(point[function == "sin"] for point in self.directions(angle))
            case Call("v", (angle,)):
                return frozenset((1 - c) % PRIME for c, _ in self.directions(angle))
            case Call("tan", (Quot(angle, Num(Fraction(numerator=2, denominator=1))),)):
                return frozenset(s * inverse(1 + c) % PRIME for c, s in self.directions(angle))
            case _:
                raise ProofFailed(f"{tree} is no number")

    def _combined(self, parts: Sequence[Tree], join: Callable[[Iterable[int]], int]) -> frozenset[int]:
        return frozenset(join(chosen) % PRIME for chosen in product(*map(self.values, parts)))

    def directions(self, tree: Tree) -> frozenset[Point]:
        """All directions that an angle can have here, each up to a factor; of joint angles they are unit vectors."""
        match tree:
            case Sym(name):
                return frozenset([self.angles[name]])
            case Num(value) if value == 0:
                return frozenset([(1, 0)])
            case Pi() | Prod((Num(), Pi())) | Quot(Pi(), Num()):
                return frozenset([_of_pi(tree)])
            case Sum(terms):
                return frozenset(_added(chosen) for chosen in product(*map(self.directions, terms)))
            case Prod((Num(value), inner)) if value.denominator == 1:
                return frozenset(_multiple(point, int(value)) for point in self.directions(inner))
            case PlusMinus(left, right):
                lefts = frozenset([(1, 0)]) if left is None else self.directions(left)
                turned = product(lefts, self.directions(right))
                return frozenset(_added((a, _multiple(b, sign))) for a, b in turned for sign in (1, -1))
            case Call("atan2", (y, x)):
                return frozenset(product(self.values(x), self.values(y)))
            case Call("atan", (slope,)):
                return frozenset((1, value) for value in self.values(slope))
            case Call("acos" | "asin" as function, (inner,)):
                cosine = function == "acos"
                pairs = [(k, root) for k in self.values(inner) for root in _roots([1 - k * k])]
                return frozenset(pair if cosine else pair[::-1] for pair in pairs)
            case _:
                raise ProofFailed(f"{tree} is no angle")


def _product(values: Iterable[int]) -> int:
    total = 1
    for value in values:
        total = total * value % PRIME
    return total


def _either(values: Iterable[int]) -> frozenset[int]:
    return frozenset(root for value in values for root in (value, -value % PRIME))


def _roots(values: Iterable[int]) -> frozenset[int]:
    """Both square roots of each number that has one in the field."""
    found = (sqrt_mod(value % PRIME, PRIME) for value in values)
    return _either(int(root) for root in found if root is not None)


def _of_pi(tree: Tree) -> Point:
    match tree:
        case Prod((Num(value), _)):
            turns = value
        case Quot(_, Num(value)):
            turns = 1 / value
        case _:
            turns = Fraction(1)
    point = angle_point(turns)
    if point is None:
        raise ProofFailed(f"{turns} pi has no exact cosine in the field")
    return point


def _added(points: Sequence[Point]) -> Point:
    """The direction of a sum of angles: the product of complex numbers."""
    x, y = 1, 0
    for a, b in points:
        x, y = (x * a - y * b) % PRIME, (x * b + y * a) % PRIME
    return x, y


def _multiple(point: Point, count: int) -> Point:
    x, y = point
    return _added([(x, y if count > 0 else -y)] * abs(count))


def multiplied(left: Rows, right: Rows) -> Rows:
    """The product of two matrices in numbers."""
    columns = list(zip(*right, strict=True))
    return [[sum(a * b for a, b in zip(row, column, strict=True)) % PRIME for column in columns] for row in left]


def _rigid_inverse(rows: Rows) -> Rows:
    """The inverse of a rigid transform of four rows."""
    turned = [[rows[j][i] for j in range(3)] for i in range(3)]
    moved = [-sum(a * row[3] for a, row in zip(line, rows, strict=False)) % PRIME for line in turned]
    return [*([*line, away] for line, away in zip(turned, moved, strict=True)), [0, 0, 0, 1]]
