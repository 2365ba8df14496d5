"""Formulas as MathML: what the eye would read, and where a line may end."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest

from kinsym.algebra.tree import Call, Num, Pi, PlusMinus, Pow, Quot, Sum, Sym, Tree, add, mul, negated, sub
from kinsym.emit.html.formula import MathPrinter
from kinsym.emit.html.mathml import math
from kinsym.emit.html.tex import mathml
from kinsym.emit.latex.names import Names
from tests.page.pages import Outline

A, B, C, X = (Sym(name) for name in "abcx")


def read(tree: Tree) -> str:
    """The letters and signs of a formula in their order."""
    return Outline(str(math(MathPrinter(Names([]))(tree)))).plain()


@pytest.mark.parametrize(
    ("tree", "seen"),
    [
        (sub(A, B), "a−b"),
        (negated(add(A, B)), "−a−b"),
        (mul(A, sub(B, C)), "a(b−c)"),
        (mul(A, add(B, mul(C, add(A, X)))), "a[b+c(a+x)]"),
        (mul(A, add(B, mul(C, add(A, mul(B, add(C, X)))))), "a{b+c[a+b(c+x)]}"),
        (mul(Num(Fraction(2)), mul(A, B)), "2ab"),
        (Pow(add(A, B), 2), "(a+b)2"),
        (Pow(Call("sqrt", (A,)), 2), "(a)2"),
        (Quot(A, add(B, C)), "ab+c"),
        (PlusMinus(None, A), "±a"),
        (PlusMinus(A, B), "a±b"),
        (Sum((A, PlusMinus(None, B))), "a±b"),
        (Call("atan2", (A, negated(B))), "Atan2(a,−b)"),
        (Call("cos", (Pi(),)), "cosπ"),
        (Call("cos", (add(A, B),)), "cos(a+b)"),
        (Call("hypot", (A, B)), "a2+b2"),
        (Call("abs", (sub(A, B),)), "|a−b|"),
        (Sym("theta23"), "θ23"),
        (Sym("c12m4"), "c12−4"),
        (Sym("p16_x"), "1p6,x"),
    ],
)
def test_a_formula_reads_as_it_is_written(tree: Tree, seen: str) -> None:
    assert read(tree) == seen


def test_a_negative_factor_is_bracketed() -> None:
    assert read(sub(A, Quot(negated(B), C))) == "a+bc"
    assert read(mul(A, Call("sqrt", (B,)), negated(C))) == "−abc"


def test_a_long_sum_can_be_broken_inside_its_brackets() -> None:
    terms = [Sym(f"a{k}") for k in range(1, 21)]
    pieces = str(math(MathPrinter(Names([]))(mul(X, add(*terms))))).split("<wbr>")
    assert len(pieces) == len(terms)
    assert all(Outline(piece).tags[0][0] == "math" for piece in pieces)


def test_a_long_fraction_and_root_are_written_on_the_line() -> None:
    many = add(*(Sym(f"a{k}") for k in range(1, 31)))
    assert "<mfrac>" not in "".join(MathPrinter(Names([]))(Quot(many, A)))
    assert "<msqrt>" not in "".join(MathPrinter(Names([]))(Call("sqrt", (many,))))
    assert "<msqrt>" in "".join(MathPrinter(Names([]))(Call("sqrt", (A,))))


@pytest.mark.parametrize(
    ("tex", "seen"),
    [
        (r"\det \begin{bmatrix} M & b \\ c & 0 \end{bmatrix} = 0", "det[Mbc0]=0"),
        (r"\sum_{k=1}^{8} \bigl( a_{k} \cos k \theta_{5} \bigr)", "∑k=18(akcoskθ5)"),
        (r"{}^{1}T_{6}^{-1}", "1T6−1"),
        (r"\mathrm{a\_1}", "a_1"),
        ("q' = q + 2 t", "q′=q+2t"),
    ],
)
def test_the_tex_of_names_and_of_the_general_solver(tex: str, seen: str) -> None:
    assert Outline(str(math(mathml(tex)))).plain() == seen


def test_a_line_can_end_after_a_wide_space() -> None:
    assert len(mathml(r"a , \quad b = 2")) == 2


def test_tex_that_kinsym_does_not_write_is_refused() -> None:
    with pytest.raises(ValueError, match="href"):
        mathml(r"\href{a}{b}")


def test_a_name_cannot_hold_markup() -> None:
    assert "<b>" not in re.sub(r"</?m\w+[^>]*>", "", "".join(mathml(Names(["a<b>"])["a<b>"])))
