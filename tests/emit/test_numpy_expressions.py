"""Trees as expressions: precedence, signs and numbers; and lines that fit."""

from __future__ import annotations

import ast
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Prod, Quot, Sum, Sym, Tree, add, mul, sub
from kinsym.emit.printer import decimal
from kinsym.emit.source.c_source import CPrinter
from kinsym.emit.source.c_source import code as c_code
from kinsym.emit.source.numpy_source import NumpyPrinter
from kinsym.emit.source.numpy_source import code as numpy_code
from kinsym.emit.source.wrapping import WIDTH
from kinsym.errors import KinsymError
from tests.emit.sample import tree

C = CPrinter()
MINUS = Num(Fraction(-1))
a, b, c = Sym("a"), Sym("b"), Sym("c")


@pytest.mark.parametrize(
    "text",
    [
        "a - b",
        "-a - b",
        "a - b - c",
        "a * b - c * (a + b)",
        "-a * b + c",
        "-(a + b) * c",
        "a - (b + c) * b",
        "a / b / c",
        "a / (b * c)",
        "a * b / c",
        "-a / b",
        "a - b / c",
        "(a + b) / (a - b)",
        "2.0 * a - 0.5",
        "sin(a - b) * cos(-a)",
        "hypot(a, -b)",
    ],
)
def test_prints_as_it_is_written(text: str) -> None:
    assert C(tree(text)) == text


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (Sum((a, Prod((MINUS, b)))), "a - b"),
        (Sum((a, Prod((MINUS, Sum((b, c)))))), "a - (b + c)"),
        (Sum((a, Quot(Prod((MINUS, b)), c))), "a - b / c"),
        (Sum((a, Sum((Prod((MINUS, b)), c)))), "a - b + c"),
        (Sum((a, Num(Fraction(-1, 2)))), "a - 0.5"),
        (Prod((a, Prod((MINUS, b)))), "-a * b"),
        (Prod((MINUS, a, Num(Fraction(-2)))), "a * 2.0"),
        (Prod((MINUS, Sum((a, b)))), "-(a + b)"),
        (Prod((c, Quot(a, b))), "c * a / b"),
        (Quot(a, Prod((MINUS, b))), "-a / b"),
        (Quot(a, Quot(b, c)), "a / (b / c)"),
        (Pow(a, 3), "a * a * a"),
        (Quot(b, Pow(a, 2)), "b / (a * a)"),
        (Pow(Sum((a, b)), 2), "(a + b) * (a + b)"),
        (Pow(Prod((MINUS, a)), 3), "-a * a * a"),
        (Sum((b, Prod((MINUS, Pow(a, 2))))), "b - a * a"),
        (Call("abs", (Prod((MINUS, a)),)), "fabs(-a)"),
        (Sum((Pi(), Prod((MINUS, a)))), "3.141592653589793 - a"),
    ],
)
def test_signs_and_parentheses(expression: Tree, text: str) -> None:
    assert C(expression) == text


def test_two_signs_are_for_readers_only() -> None:
    with pytest.raises(TypeError):
        C(PlusMinus(a, b))


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (Fraction(2), "2.0"),
        (Fraction(-1, 3), "-0.3333333333333333"),
        (Fraction("0.4318"), "0.4318"),
        (Fraction(1, 10**5), "1e-05"),
        (Fraction(10**22), "1e+22"),
        (Fraction(1, 2**46), "1.4210854715202004e-14"),
    ],
)
def test_numbers(value: Fraction, text: str) -> None:
    assert decimal(value) == text


@pytest.mark.parametrize("value", [Fraction(10**400), Fraction(1, 10**400)])
def test_numbers_beyond_double_precision_are_refused(value: Fraction) -> None:
    with pytest.raises(KinsymError, match="double precision"):
        decimal(value)


@given(st.fractions(max_denominator=10**20))
def test_a_number_reads_back_as_the_nearest_double(value: Fraction) -> None:
    assert float(decimal(value)) == value.numerator / value.denominator


leaves = st.one_of(st.sampled_from([a, b, c]), st.integers(-3, 3).filter(bool).map(lambda n: Num(Fraction(n))))
trees = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=3).map(lambda terms: Sum(tuple(terms))),
        st.lists(inner, min_size=2, max_size=3).map(lambda factors: Prod(tuple(factors))),
        st.tuples(inner, inner).map(lambda pair: add(*pair)),
        st.tuples(inner, inner).map(lambda pair: sub(*pair)),
        st.tuples(inner, inner).map(lambda pair: mul(*pair)),
        st.tuples(inner, leaves).map(lambda pair: Quot(*pair)),
        st.tuples(inner, st.integers(2, 3)).map(lambda pair: Pow(*pair)),
    ),
    max_leaves=12,
)
VALUES = {"a": Fraction(2, 3), "b": Fraction(-5, 7), "c": Fraction(11, 13)}


def _exact(expression: Tree) -> Fraction:
    match expression:
        case Num(value):
            return value
        case Sym(name):
            return VALUES[name]
        case Sum(terms):
            return sum(map(_exact, terms), Fraction(0))
        case Prod(factors):
            product = Fraction(1)
            for factor in factors:
                product *= _exact(factor)
            return product
        case Quot(numerator, denominator):
            return _exact(numerator) / _exact(denominator)
        case Pow(base, exponent):
            return _exact(base) ** exponent
    raise TypeError(expression)


@given(trees)
def test_what_is_printed_has_the_tree_s_value(expression: Tree) -> None:
    text = C(expression)
    exact = {name: Fraction(value) for name, value in VALUES.items()}
    assert eval(_as_fractions(text), {"Fraction": Fraction, **exact}) == _exact(expression)
    assert "+ -" not in text
    assert "- -" not in text
    assert "--" not in text


def _as_fractions(text: str) -> str:
    numbers = ast.parse(text, mode="eval")
    for node in ast.walk(numbers):
        if isinstance(node, ast.Constant):
            node.value = Fraction(node.value)
    return ast.unparse(numbers)


@given(trees, st.integers(0, 4))
def test_long_lines_are_cut_and_keep_their_meaning(expression: Tree, depth: int) -> None:
    text = C(expression)
    wide = " + ".join([text] * 5)
    for line in (c_code(f"const double x = {wide};", depth), numpy_code("x", wide, depth)):
        assert max(map(len, line.splitlines())) <= WIDTH
    assert "".join(c_code(f"x = {wide};", depth).split()) == "".join(f"x = {wide};".split())
    python = ast.parse("\n".join(part[4 * depth :] for part in numpy_code("x", wide, depth).splitlines()))
    assert ast.unparse(python) == ast.unparse(ast.parse(f"x = {wide}"))


def test_a_long_call_keeps_its_brackets() -> None:
    call = f"_linear({', '.join(['argument'] * 20)})"
    assert numpy_code("c1, s1", call).splitlines()[0] == "    c1, s1 = _linear("
    assert numpy_code("x", f"f({'a + ' * 40}a) * g(b)").splitlines()[0] == "    x = ("


def test_numpy_names() -> None:
    assert NumpyPrinter()(tree("sqrt(a) * abs(b) + atan2(a, b) - wrap(pi)")) == (
        "np.sqrt(a) * np.abs(b) + _angle(a, b) - _wrap(np.pi)"
    )
