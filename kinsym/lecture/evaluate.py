"""The value of a formula of the lecture where its names have values."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from kinsym.lecture.notation import Apply, Binary, Grid, Name, Negative, Node, Number, Part, Power
from kinsym.lecture.quantities import (
    Matrix,
    Pi,
    Slope,
    Turn,
    Value,
    agree,
    column,
    cross,
    determinant,
    direction,
    dot,
    entrywise,
    is_scalar,
    matmul,
    rigid_inverse,
    transpose,
)
from kinsym.lecture.residue import Scalar, Undefined, residue_of_fraction, root

ValueOf = Callable[[str], Value]


class Evaluator:
    """Formulas evaluated with the names that ``value_of`` knows, modulo the prime or, with ``exact``, in Fractions.

    ``elsewhere`` evaluates what stands in ``moved(...)``. Raises Undefined where a formula has no value: a zero
    denominator, a root that is not there, sizes that differ.

    >>> from kinsym.lecture.notation import parse
    >>> Evaluator({"a": Fraction(3)}.__getitem__, exact=True)(parse("sqrt(a**2 + 16)/2"))
    Fraction(5, 2)
    """

    def __init__(self, value_of: ValueOf, *, exact: bool = False, elsewhere: Evaluator | None = None) -> None:
        self.value_of = value_of
        self.exact = exact
        self.elsewhere = elsewhere

    def number(self, value: Fraction | int) -> Scalar:
        """A rational number in the arithmetic of this evaluator."""
        return Fraction(value) if self.exact else residue_of_fraction(Fraction(value))

    def __call__(self, node: Node) -> Value:
        match node:
            case Number(value):
                return self.number(value)
            case Name("pi"):
                return Pi(Fraction(1))
            case Name(name):
                return self.value_of(name)
            case Negative(body):
                return self._negative(self(body))
            case Binary("*", left, right):
                return self._times(self(left), self(right))
            case Binary("/", left, right):
                return self._over(self(left), right)
            case Binary(sign, left, right):
                return self._sum(self(left), self(right), 1 if sign == "+" else -1)
            case Power(base, exponent):
                factor = self.scalar(base)
                total = factor
                for _ in range(exponent - 1):
                    total = total * factor
                return total
            case Part(base, row, place):
                return self._part(self.matrix(base), row, place)
            case Grid(rows):
                return tuple(tuple(self.scalar(cell) for cell in row) for row in rows)
            case Apply(function, arguments):
                return self._apply(function, arguments)

    def scalar(self, node: Node) -> Scalar:
        """The value of a formula that is a number."""
        value = self(node)
        if not is_scalar(value):
            raise Undefined("a number is wanted where an angle or a matrix stands")
        return value

    def matrix(self, node: Node) -> Matrix:
        """The value of a formula that is a matrix."""
        value = self(node)
        if not isinstance(value, tuple):
            raise Undefined("a matrix is wanted where a number or an angle stands")
        return value

    def angle(self, node: Node) -> Turn:
        """The value of a formula that is an angle; 0 is one."""
        return self._turn(self(node))

    def _turn(self, value: Value) -> Turn:
        if isinstance(value, Pi):
            value = self._quarters(value) if self.exact else value.turn()
        if is_scalar(value) and not value:
            value = Turn(self.number(1), self.number(0))
        if not isinstance(value, Turn):
            raise Undefined("an angle is wanted where a number or a matrix stands")
        return value

    def _quarters(self, value: Pi) -> Turn:
        points = ((1, 0), (0, 1), (-1, 0), (0, -1))
        if (2 * value.multiple).denominator != 1:
            raise Undefined(f"{value.multiple}*pi has no rational cosine and sine")
        c, s = points[int(2 * value.multiple) % 4]
        return Turn(Fraction(c), Fraction(s))

    def _negative(self, value: Value) -> Value:
        match value:
            case Turn():
                return value.opposite()
            case Slope(tangent):
                return Slope(-tangent)
            case Pi(multiple):
                return Pi(-multiple)
            case tuple():
                return tuple(tuple(-cell for cell in row) for row in value)
            case _:
                return -value

    def _sum(self, left: Value, right: Value, sign: int) -> Value:
        if isinstance(left, tuple) and isinstance(right, tuple):
            return entrywise(left, right, sign)
        if is_scalar(left) and is_scalar(right):
            return left + right if sign > 0 else left - right
        first, second = self._turn(left), self._turn(right)
        return first.plus(second if sign > 0 else second.opposite())

    def _times(self, left: Value, right: Value) -> Value:
        if isinstance(left, tuple) and isinstance(right, tuple):
            return matmul(left, right)
        if isinstance(left, tuple) or isinstance(right, tuple):
            factor, matrix = (right, left) if isinstance(left, tuple) else (left, right)
            if not is_scalar(factor) or not isinstance(matrix, tuple):
                raise Undefined("a matrix is multiplied by what is no number")
            return tuple(tuple(cell * factor for cell in row) for row in matrix)
        if is_scalar(left) and is_scalar(right):
            return left * right
        count, angle = (left, right) if is_scalar(left) else (right, left)
        return self._multiple(count, angle)

    def _multiple(self, count: Value, angle: Value) -> Value:
        """A small whole multiple of an angle."""
        whole = next((k for k in range(-4, 5) if self.number(k) == count), None)
        if whole is None or not isinstance(angle, Turn | Slope | Pi):
            raise Undefined("a product of angles")
        if isinstance(angle, Pi):
            return Pi(angle.multiple * whole)
        if isinstance(angle, Slope):
            if whole % 2:
                raise Undefined("an angle that is known up to half a turn only")
            return angle.twice().times(whole // 2)
        return angle.times(whole)

    def _over(self, left: Value, below: Node) -> Value:
        if isinstance(left, Pi) and isinstance(below, Number):
            return Pi(left.multiple / below.value)
        if isinstance(left, Turn) and below == Number(Fraction(2)):
            return left.half()
        divisor = self.scalar(below)
        if not divisor:
            raise Undefined("division by zero")
        if not is_scalar(left):
            raise Undefined("an angle or a matrix is divided")
        return left / divisor

    def _part(self, matrix: Matrix, row: int | str, place: int) -> Value:
        if place >= len(matrix[0]) or (isinstance(row, int) and row >= len(matrix)):
            raise Undefined("a matrix has no such entry")
        if isinstance(row, int):
            return matrix[row][place]
        rows = matrix if row == ":" else matrix[:3]
        return tuple((line[place],) for line in rows)

    def _apply(self, function: str, arguments: tuple[Node, ...]) -> Value:
        one, zero = self.number(1), self.number(0)
        first = arguments[0]
        match function:
            case "sin":
                return self.angle(first).sine
            case "cos":
                return self.angle(first).cosine
            case "v":
                return one - self.angle(first).cosine
            case "tan":
                value = self(first)
                turn = value if isinstance(value, Slope) else None
                return turn.tangent if turn else self.angle(first).sine / self.angle(first).cosine
            case "sqrt":
                return root(self.scalar(first))
            case "acos":
                c = self.scalar(first)
                return Turn(c, root(one - c * c))
            case "asin":
                s = self.scalar(first)
                return Turn(root(one - s * s), s)
            case "atan":
                return Slope(self.scalar(first))
            case "atan2":
                return direction(self.scalar(arguments[1]), self.scalar(first))
            case "deg":
                if not isinstance(first, Number):
                    raise Undefined("deg takes a number")
                return Pi(first.value / 180)
            case "moved":
                if self.elsewhere is None:
                    raise Undefined("nothing is moved here")
                return self.elsewhere(first)
            case "abs":
                size = self.scalar(first)
                if not isinstance(size, Fraction):
                    raise Undefined("a residue has no sign")
                return abs(size)
            case "unit":
                rows = range(int(first.value)) if isinstance(first, Number) else range(0)
                return tuple(tuple(one if i == k else zero for k in rows) for i in rows)
            case _:
                return self._matrix_function(function, arguments)

    def _matrix_function(self, function: str, arguments: tuple[Node, ...]) -> Value:
        one, zero = self.number(1), self.number(0)
        if function in ("R_X", "R_Y", "R_Z"):
            return self._turned(function[-1], self.angle(arguments[0]))
        if function in ("D_X", "D_Z"):
            return self._moved(function[-1], self.scalar(arguments[0]))
        if function in ("Screw_X", "Screw_Z"):
            axis = function[-1]
            moved = self._moved(axis, self.scalar(arguments[0]))
            return matmul(self._turned(axis, self.angle(arguments[1])), moved)
        if function == "vec":
            return tuple((self.scalar(cell),) for cell in arguments)
        first = self.matrix(arguments[0])
        match function:
            case "inv":
                return rigid_inverse(first)
            case "transpose":
                return transpose(first)
            case "det":
                return determinant(first)
            case "rot":
                return tuple(row[:3] for row in first[:3])
            case "hom":
                return (*first, (one,))
            case "x_angle":
                return Turn(first[0][0], first[1][0])
            case "dot":
                return dot(column(first), column(self.matrix(arguments[1])))
            case "block":
                below = self.matrix(arguments[1])
                rows = tuple((*row, entry[0]) for row, entry in zip(first, below, strict=True))
                return (*rows, (zero, zero, zero, one))
            case _:
                start, end, about = (column(self.matrix(node)) for node in arguments)
                return Turn(dot(start, end), dot(cross(start, end), about))

    def _turned(self, axis: str, angle: Turn) -> Matrix:
        c, s, one, zero = angle.cosine, angle.sine, self.number(1), self.number(0)
        rotations = {
            "X": ((one, zero, zero), (zero, c, -s), (zero, s, c)),
            "Y": ((c, zero, s), (zero, one, zero), (-s, zero, c)),
            "Z": ((c, -s, zero), (s, c, zero), (zero, zero, one)),
        }
        return (*((*row, zero) for row in rotations[axis]), (zero, zero, zero, one))

    def _moved(self, axis: str, length: Scalar) -> Matrix:
        one, zero = self.number(1), self.number(0)
        place = "XYZ".index(axis)
        rows = [[one if i == k else zero for k in range(4)] for i in range(4)]
        rows[place][3] = length
        return tuple(map(tuple, rows))


def all_agree(values: list[Value]) -> bool:
    """Whether all members of an equation have the same value."""
    return all(agree(values[0], value) for value in values[1:])
