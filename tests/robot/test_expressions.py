"""Cells: what is read exactly, what is refused, and that no text is ever executed or slow."""

from __future__ import annotations

import ast
import builtins
import time
from decimal import Decimal
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from kinsym.errors import RobotError
from kinsym.robot.expressions import names, number, parse, symbol
from kinsym.robot.text import cell_text

a1, b, theta2 = symbol("a1"), symbol("b"), symbol("theta2")


@pytest.mark.parametrize(
    ("cell", "value"),
    [
        ("pi/2", sympy.pi / 2),
        ("-pi/2", -sympy.pi / 2),
        ("a1 + b", a1 + b),
        ("theta2 - pi/2", theta2 - sympy.pi / 2),
        ("deg(30)", sympy.pi / 6),
        ("0.1", sympy.Rational(1, 10)),
        (".5", sympy.Rational(1, 2)),
        ("1e-3", sympy.Rational(1, 1000)),
        ("sqrt(2)/2", sympy.sqrt(2) / 2),
        ("2**-3", sympy.Rational(1, 8)),
        ("(a1 + b)**2", a1**2 + 2 * a1 * b + b**2),
        ("2*(theta2 + a1)/2", theta2 + a1),
        ("+a1", a1),
        (0, sympy.Integer(0)),
        (0.1, sympy.Rational(1, 10)),
        (Decimal("0.30000000000000000004"), sympy.Rational(30000000000000000004, 10**20)),
        (Fraction(1, 3), sympy.Rational(1, 3)),
    ],
)
def test_exact_value(cell: object, value: sympy.Expr) -> None:
    assert parse(cell) == value


@pytest.mark.parametrize(
    "text",
    [
        "().__class__",
        "a[0]",
        "lambda: 0",
        "a if b else c",
        "a and b",
        "a == b",
        "[1]",
        "{1}",
        "f(x)",
        "sin",
        "sin(1, 2)",
        "sin(x=1)",
        "sin(*a)",
        "sin(a1)",
        "sqrt(a1**2)",
        "sqrt(-1)",
        "1/a1",
        "1/0",
        "1/(sqrt(2)*sqrt(3) - sqrt(6))",
        "0**-1",
        "a1**9",
        "a1**0.5",
        "a1**b",
        "2**1000",
        "((((9**8)**8)**8)**8)**8",
        "((a1**8)**8)**8",
        "(a + b + c + d + e + f)**8",
        "9" * 200,
        "1e99999",
        "1e-99999",
        "0x10",
        "1_000",
        "1j",
        "007",
        "True",
        "None",
        "nan",
        "inf",
        "'text'",
        "a := 1",
        "a @ b",
        "a // b",
        "a % b",
        "a << 2",
        "~a",
        "not a",
        "a^2",
        "θ1",
        "a\n+b",
        "a\0",
        "a;b",
        "2 a",
        "a1 +",
        "(" * 250 + ")" * 250,
        "-" * 400 + "1",
        "+".join("a" * 249),
        "(a + b + c + d)**4",
        "((((pi-1e5)-cos(sqrt(3))))**7)**-5",
        "((2+((((cos(pi/16)+sqrt(3))+cos(sqrt(3)))*sqrt(3)))**-4))**8",
        "a" * 1001,
        "cos(pi/2**40)",
        "sin(1e30)",
        "deg",
        "",
    ],
)
def test_refused(text: str) -> None:
    start = time.process_time()
    with pytest.raises(RobotError) as caught:
        parse(text, where="cell")
    assert time.process_time() - start < 3
    assert caught.value.where == "cell"
    assert caught.value.remedy
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("value", [float("nan"), float("inf"), Decimal("nan"), Decimal("-inf"), Decimal("1e400")])
def test_numbers_that_are_none(value: object) -> None:
    with pytest.raises(RobotError):
        parse(value)


def test_a_huge_exponent_is_never_written_out() -> None:
    start = time.process_time()
    with pytest.raises(RobotError, match="too large"):
        parse(Decimal("1e30000000"))
    assert time.process_time() - start < 3


PIECES = ["a", "theta1", "pi", "1", "0", "0.1", "8", "+", "-", "*", "/", "**", "(", ")", "sqrt", "sin(", "deg(", " "]
PIECES += ["__import__", "eval(", ".", ",", "open('x')", "lambda", "for", "[", "]", "'"]
HOSTILE = st.one_of(st.text(max_size=40), st.lists(st.sampled_from(PIECES), max_size=25).map("".join))


@settings(max_examples=300, deadline=None)
@given(HOSTILE)
def test_random_text_is_an_expression_or_refused(text: str) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(builtins, "eval", None)
        patch.setattr(builtins, "exec", None)
        patch.setattr(builtins, "open", None)
        try:
            value = parse(text)
        except RobotError:
            return
    assert isinstance(value, sympy.Expr)
    assert value.is_finite is not False


def _cells() -> st.SearchStrategy[str]:
    atoms = st.sampled_from(["a", "b2", "theta1", "pi", "0", "1", "7", "0.25", "1e-3", "sqrt(2)", "cos(deg(20))"])
    return st.recursive(
        atoms,
        lambda inner: st.one_of(
            st.tuples(inner, st.sampled_from("+-*"), inner).map(lambda t: f"({t[0]}{t[1]}{t[2]})"),
            inner.map(lambda text: f"-{text}"),
            inner.map(lambda text: f"({text})/3"),
            inner.map(lambda text: f"({text})**2"),
        ),
        max_leaves=5,
    )


@settings(max_examples=150, deadline=None)
@given(_cells())
def test_a_cell_means_what_python_arithmetic_means(text: str) -> None:
    point = {"a": 0.37, "b2": -1.21, "theta1": 0.83}
    value = parse(text)
    got = complex(value.xreplace({symbol(name): sympy.Float(x, 30) for name, x in point.items()}).evalf(30))
    assert got == pytest.approx(_float(ast.parse(text, mode="eval").body, point), rel=1e-9, abs=1e-9)
    assert parse(cell_text(value)) == value


def _float(node: ast.expr, point: dict[str, float]) -> float:
    """A second reading of a cell, in floating point."""
    import math

    match node:
        case ast.Constant(value=int() | float() as value):
            return float(value)
        case ast.Name(id=name):
            return math.pi if name == "pi" else point[name]
        case ast.UnaryOp(operand=operand):
            return -_float(operand, point)
        case ast.Call(func=ast.Name(id=name), args=[argument]):
            functions = {"sqrt": math.sqrt, "cos": math.cos, "deg": math.radians}
            return functions[name](_float(argument, point))
        case ast.BinOp(left=left, op=op, right=right):
            x, y = _float(left, point), _float(right, point)
            results = {ast.Add: x + y, ast.Sub: x - y, ast.Mult: x * y}
            if type(op) in results:
                return results[type(op)]
            return x / y if isinstance(op, ast.Div) else x**y
    raise ValueError(ast.dump(node))


@pytest.mark.parametrize(
    "text", ["sqrt(sqrt(3))", "sqrt(3)**-1", "sqrt(pi)**3", "1/sqrt(sqrt(pi))**3", "1/(sqrt(2) + 3)"]
)
def test_roots_are_written_as_roots(text: str) -> None:
    value = parse(text)
    assert parse(cell_text(value)) == value


def test_values_of_parameters() -> None:
    assert number("0.4318") == Fraction(4318, 10000)
    assert number("deg(180)") == Fraction("3.14159265358979323846264338328")
    assert number(-0.425) == Fraction(-425, 1000)


def test_names_are_sorted_as_people_sort() -> None:
    assert names(parse("a10 + b + a2")) == ("a2", "a10", "b")
