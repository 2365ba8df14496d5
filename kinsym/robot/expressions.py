"""Cells of a table as exact expressions, read safely.

The text of a cell is hostile until proved harmless: it is parsed to a syntax tree by Python's ``ast`` and walked by
a whitelist, never evaluated. Numbers become rationals from their decimal text, so ``0.1`` is 1/10. What comes out
is a polynomial in the names with exact numbers as coefficients; that is what the arithmetic behind it needs, and
it is why functions of names and division by names are refused.

Bounds on length, depth, powers, terms and digits keep every cell cheap, whatever is written in it.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from math import comb

import sympy
from sympy import Expr, Rational, Symbol

from kinsym.errors import RobotError
from kinsym.robot.names import shown
from kinsym.robot.text import cell_text

LONGEST_TEXT = 1000
DEEPEST = 40
LARGEST_POWER = 8
MOST_TERMS = 100
MOST_TERMS_KEPT = 30
MOST_BITS = 400
MOST_BITS_OF_ANGLE = 60
MOST_HALVINGS = 6
LARGEST_DECIMAL_EXPONENT = 120
DIGITS = 30

_WHAT_IS_ALLOWED = "A cell is a number or an expression of names, + - * / **, pi, sqrt, sin, cos and deg."
_NUMBER = re.compile(r"(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,4})?")
_ALLOWED_TEXT = re.compile(r"[A-Za-z0-9_+\-*/(). \t,]*")


def symbol(name: str) -> Symbol:
    """The one symbol of a name, a real number.

    >>> symbol("a2") is symbol("a2")
    True
    """
    return Symbol(name, real=True)


def names(expression: Expr) -> tuple[str, ...]:
    """The names in an expression, sorted so that a2 comes before a10.

    >>> names(parse("a10 + a2*b"))
    ('a2', 'a10', 'b')
    """
    return tuple(sorted((str(item) for item in expression.free_symbols), key=_natural))


def _natural(name: str) -> list[tuple[int, int | str]]:
    return [(1, int(part)) if part.isdigit() else (0, part) for part in re.split(r"(\d+)", name) if part]


def parse(cell: object, *, where: str = "") -> Expr:
    """The exact, expanded expression of a cell.

    ``cell`` is text or a number as TOML gives it (int, float or Decimal). Angles are in radians unless written
    ``deg(...)``. Raises RobotError at ``where`` for anything but a polynomial in names with exact coefficients.

    >>> parse("theta2 - pi/2")
    theta2 - pi/2
    >>> parse("0.4318"), parse(0.1), parse("deg(30)")
    (2159/5000, 1/10, pi/6)
    """
    if isinstance(cell, str):
        return _Reader(cell.strip(), where).read()
    if isinstance(cell, bool) or not isinstance(cell, int | float | Decimal | Fraction):
        raise RobotError(
            f"a cell cannot be {_kind_of(cell)}", where=where, remedy='Write a number or text such as "pi/2".'
        )
    if isinstance(cell, Fraction):
        return Rational(cell.numerator, cell.denominator)
    if isinstance(cell, int):
        return _bounded(Rational(cell), where) if cell.bit_length() <= MOST_BITS else _too_large(where)
    return _decimal(Decimal(repr(cell)) if isinstance(cell, float) else cell, where)


def number(cell: object, *, where: str = "") -> Fraction:
    """The value of a cell that holds no names; one that is irrational is taken to 30 significant digits.

    >>> number("0.4318"), number("1/3"), float(number("deg(180)"))
    (Fraction(2159, 5000), Fraction(1, 3), 3.141592653589793)
    """
    value = parse(cell, where=where)
    if value.free_symbols:
        raise RobotError(
            f"the value {shown(str(cell))} depends on {names(value)[0]}", where=where, remedy="Write a number here."
        )
    if isinstance(value, Rational):
        return Fraction(int(value.p), int(value.q))
    return Fraction(str(sympy.N(value, DIGITS)))


def is_zero(expression: Expr) -> bool:
    """Whether a polynomial in names with exact coefficients is identically zero.

    A coefficient that does not vanish by expansion (cos(pi/9)**2 + sin(pi/9)**2 - 1) is decided at 60 digits.
    """
    expanded = sympy.expand(expression)
    symbols = sorted(expanded.free_symbols, key=str)
    coefficients = sympy.Poly(expanded, *symbols).coeffs() if symbols else [expanded]
    return all(value == 0 or abs(sympy.N(value, 60, maxn=300)) < sympy.Float("1e-50") for value in coefficients)


def writable(expression: Expr) -> bool:
    """Whether an expression, written out as text, is a cell that :func:`parse` reads back."""
    return len(sympy.Add.make_args(expression)) <= MOST_TERMS_KEPT and len(cell_text(expression)) <= LONGEST_TEXT


def _kind_of(value: object) -> str:
    kinds = {bool: "true or false", list: "a list", dict: "a table", type(None): "empty"}
    return kinds.get(type(value), f"a {type(value).__name__}")


def _too_large(where: str) -> Expr:
    raise RobotError("a number is too large or has too many digits", where=where, remedy="Use other units.")


def _bounded(value: Expr, where: str) -> Expr:
    for atom in value.atoms(Rational):
        if max(int(atom.p).bit_length(), int(atom.q).bit_length()) > MOST_BITS:
            return _too_large(where)
    return value


def _decimal(value: Decimal, where: str) -> Expr:
    if not value.is_finite():
        raise RobotError("NaN and infinity are not numbers of a robot", where=where, remedy="Write a finite number.")
    if value and abs(value.adjusted()) > LARGEST_DECIMAL_EXPONENT:
        return _too_large(where)
    fraction = Fraction(value)
    return _bounded(Rational(fraction.numerator, fraction.denominator), where)


@dataclass(frozen=True)
class _Part:
    """A subexpression, expanded, with bounds on its size.

    ``degree`` counts factors that are no rational numbers, ``terms`` the summands that expansion could make,
    those of a denominator included: SymPy expands a power of a quotient below the line as well.
    """

    value: Expr
    degree: int = 0
    terms: int = 1


class _Reader:
    """One walk over the syntax tree of one cell."""

    def __init__(self, text: str, where: str) -> None:
        self.text = text
        self.where = where

    def read(self) -> Expr:
        if not self.text:
            raise self.refusal("the cell is empty", 'Write "0" if that is meant.')
        if len(self.text) > LONGEST_TEXT:
            raise self.refusal(f"the text is longer than {LONGEST_TEXT} characters", "Name its parts as parameters.")
        if "^" in self.text:
            raise self.refusal("^ is not a power here", "Write a**2.")
        if not _ALLOWED_TEXT.fullmatch(self.text):
            odd = next(letter for letter in self.text if not _ALLOWED_TEXT.fullmatch(letter))
            raise self.refusal(f"{odd!a} does not belong into a cell", _WHAT_IS_ALLOWED)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                tree = ast.parse(self.text, mode="eval")
            value = sympy.expand(self.walk(tree.body, 0).value)
        except (SyntaxError, ValueError):
            raise self.refusal(f"{shown(self.text)} is not an expression", _WHAT_IS_ALLOWED) from None
        except (RecursionError, MemoryError):
            raise self.refusal("the expression is nested too deeply", "Name its parts as parameters.") from None
        if not writable(value):
            raise self.refusal("the expression is too large when it is multiplied out", "Name its parts as parameters.")
        return value

    def refusal(self, what: str, remedy: str) -> RobotError:
        return RobotError(what, where=self.where, remedy=remedy)

    def walk(self, node: ast.expr, depth: int) -> _Part:
        if depth > DEEPEST:
            raise self.refusal("the expression is nested too deeply", "Name its parts as parameters.")
        match node:
            case ast.Constant():
                return _Part(self.literal(node))
            case ast.Name(id="pi"):
                return _Part(sympy.pi, 1)
            case ast.Name(id=name):
                return self.name(name)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
                inner = self.walk(operand, depth + 1)
                return self.times(_MINUS_ONE, inner) if isinstance(node.op, ast.USub) else inner
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self.power(self.walk(left, depth + 1), self.walk(right, depth + 1))
            case ast.BinOp(left=left, op=op, right=right):
                return self.binary(op, self.walk(left, depth + 1), self.walk(right, depth + 1))
            case ast.Call(func=ast.Name(id=function), args=[argument], keywords=[]) if function in _FUNCTIONS:
                return self.call(function, self.walk(argument, depth + 1))
            case ast.Call():
                called = shown(ast.unparse(node.func))
                raise self.refusal(f"the call of {called} is not allowed", "Only sqrt, sin, cos and deg of one value.")
            case ast.Attribute():
                raise self.refusal(f"{shown(ast.unparse(node))} has a dot", "Names have no parts here.")
            case _:
                raise self.refusal(f"{shown(self.text)} is not an expression of a table", _WHAT_IS_ALLOWED)

    def literal(self, node: ast.Constant) -> Expr:
        text = self.text[node.col_offset : node.end_col_offset]
        if not _NUMBER.fullmatch(text):
            raise self.refusal(f"{shown(text)} is not a decimal number", _WHAT_IS_ALLOWED)
        return _decimal(Decimal(text), self.where)

    def name(self, name: str) -> _Part:
        if name in _FUNCTIONS:
            raise self.refusal(f"{name} needs an argument", f"Write {name}(...).")
        if name.lower() in {"nan", "inf", "infinity"}:
            raise self.refusal("NaN and infinity are not numbers of a robot", "Write a finite number.")
        return _Part(symbol(name), 1)

    def binary(self, op: ast.operator, left: _Part, right: _Part) -> _Part:
        match op:
            case ast.Add():
                return self.plus(left, right)
            case ast.Sub():
                return self.plus(left, self.times(_MINUS_ONE, right))
            case ast.Mult():
                return self.times(left, right)
            case ast.Div():
                return self.times(left, self.inverse(right))
        raise self.refusal(f"{shown(self.text)} has an operator that is not allowed", _WHAT_IS_ALLOWED)

    def checked(self, value: Expr, degree: int, terms: int) -> _Part:
        _bounded(value, self.where)
        return _Part(value) if value.is_Rational else _Part(value, max(degree, 1), terms)

    def check_size(self, degree: int, terms: int) -> None:
        if degree > LARGEST_POWER or terms > MOST_TERMS:
            raise self.refusal("the expression is too large", "Name its parts as parameters.")

    def plus(self, left: _Part, right: _Part) -> _Part:
        degree, terms = max(left.degree, right.degree), left.terms + right.terms
        self.check_size(degree, terms)
        return self.checked(left.value + right.value, degree, terms)

    def times(self, left: _Part, right: _Part) -> _Part:
        degree, terms = left.degree + right.degree, left.terms * right.terms
        self.check_size(degree, terms)
        return self.checked(sympy.expand_mul(left.value * right.value), degree, terms)

    def inverse(self, part: _Part) -> _Part:
        if part.value.free_symbols:
            raise self.refusal(
                f"the cell divides by {names(part.value)[0]}",
                "Divide by numbers only; make the quotient a parameter of its own.",
            )
        if is_zero(part.value):
            raise self.refusal("the cell divides by zero", "Mend the divisor.")
        return self.checked(sympy.Pow(part.value, -1), part.degree, part.terms)

    def power(self, base: _Part, exponent: _Part) -> _Part:
        if not exponent.value.is_Integer or abs(int(exponent.value)) > LARGEST_POWER:
            raise self.refusal(
                f"a power is not a whole number between -{LARGEST_POWER} and {LARGEST_POWER}", "Write a**2 or sqrt(2)."
            )
        n = int(exponent.value)
        if n < 0:
            base, n = self.inverse(base), -n
        degree, terms = base.degree * n, comb(base.terms + n - 1, n)
        self.check_size(degree, terms)
        return self.checked(sympy.expand_multinomial(base.value**n), degree, terms)

    def call(self, function: str, argument: _Part) -> _Part:
        if function == "deg":
            return self.times(argument, _DEGREE)
        if argument.value.free_symbols:
            raise self.refusal(
                f"{function} of {names(argument.value)[0]} is not a polynomial",
                f"Make the whole {function}(...) a parameter and give its value under [parameters].",
            )
        if function != "sqrt":
            self.check_angle(argument.value)
        elif is_zero(argument.value):
            return _Part(sympy.Integer(0))
        elif sympy.N(argument.value, DIGITS) < 0:
            raise self.refusal("the square root of a negative number is not real", "Mend its argument.")
        value = sympy.expand_mul(_FUNCTIONS[function](argument.value))
        return self.checked(value, argument.degree, max(argument.terms, len(sympy.Add.make_args(value))))

    def check_angle(self, angle: Expr) -> None:
        # SymPy halves cos(pi/2**k) into k nested roots; far finer angles than anyone writes stop here.
        for atom in angle.atoms(Rational):
            denominator = int(atom.q)
            halvings = (denominator & -denominator).bit_length() - 1
            if max(int(atom.p).bit_length(), denominator.bit_length()) > MOST_BITS_OF_ANGLE or (
                angle.has(sympy.pi) and halvings > MOST_HALVINGS
            ):
                raise self.refusal("the angle is too finely divided", "Write it with fewer digits.")


_FUNCTIONS: dict[str, Callable[[Expr], Expr]] = {
    "sqrt": sympy.sqrt,
    "sin": sympy.sin,
    "cos": sympy.cos,
    "deg": lambda value: value * sympy.pi / 180,
}
_MINUS_ONE = _Part(sympy.Integer(-1))
_DEGREE = _Part(sympy.pi / 180, 1)
