"""The lecture's notation: what it reads, what it refuses, and what a formula is worth."""

from __future__ import annotations

from fractions import Fraction

import pytest

from kinsym.algebra.field import PRIME
from kinsym.lecture.evaluate import Evaluator
from kinsym.lecture.notation import NotationError, names_of, parse, parse_any, parse_relation
from kinsym.lecture.quantities import Slope, Turn, agree, direction
from kinsym.lecture.relation import holds
from kinsym.lecture.residue import Residue, Undefined, root


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "a.b",
        "a if b else c",
        "[a for a in b]",
        "lambda: 0",
        "a**99",
        "a**b",
        "open(1)",
        "sin(a, b)",
        "T[0]",
        "T[0, 1, 2]",
        "T[0:2, 1]",
        "a; b",
        "a +",
        "-" * 60 + "a",
        "a" * 1000,
        "a = b",
        "1.5",
        "'a'",
        "a\u0435",
        "",
        "True",
    ],
)
def test_hostile_text_is_refused(text: str) -> None:
    """Whatever is no formula of the lecture raises an error that says so."""
    with pytest.raises(NotationError):
        parse(text)


@pytest.mark.parametrize("cells", [[], [[]], [["a"], ["a", "b"]], 3, None, ["a", ["b"]]])
def test_ragged_matrices_are_refused(cells: object) -> None:
    """A matrix has rows of equal length."""
    with pytest.raises(NotationError):
        parse_any(cells)


def test_names_in_order() -> None:
    """Names are found in every kind of formula."""
    assert names_of(parse("a*(b - c**2)/sin(d) + T[0, 3] - -e")) == ("a", "b", "c", "d", "T", "e")


def exact(text: str, **values: object) -> object:
    """The value of a formula in Fractions."""
    return Evaluator(values.__getitem__, exact=True)(parse(text))


def test_angles_are_points_of_the_circle() -> None:
    """Sums, multiples and halves of the angle with cosine 3/5."""
    theta = Turn(Fraction(3, 5), Fraction(4, 5))
    assert exact("cos(2*theta)", theta=theta) == Fraction(-7, 25)
    assert exact("sin(theta - theta)", theta=theta) == 0
    assert exact("tan(theta/2)", theta=theta) == Fraction(1, 2)
    assert exact("2*atan(1)", theta=theta) == Turn(Fraction(0), Fraction(1))
    assert exact("cos(deg(180) - theta)", theta=theta) == Fraction(-3, 5)
    assert exact("acos(3/5)", theta=theta) == theta
    assert exact("atan2(4/5, 3/5)") == theta


def test_an_inverse_tangent_is_known_up_to_half_a_turn() -> None:
    """atan agrees with both angles, atan2 with one."""
    theta = Turn(Fraction(3, 5), Fraction(4, 5))
    other = Turn(Fraction(-3, 5), Fraction(-4, 5))
    assert agree(Slope(Fraction(4, 3)), theta)
    assert agree(other, Slope(Fraction(4, 3)))
    assert direction(Fraction(6), Fraction(8)) == theta


@pytest.mark.parametrize(
    "text", ["1/0", "sqrt(2)", "sqrt(0 - 1)", "acos(2)", "theta*theta", "theta/3", "1/theta", "det(1)"]
)
def test_what_has_no_value_is_undefined(text: str) -> None:
    """A formula without a value says so instead of having one."""
    with pytest.raises(Undefined):
        exact(text, theta=Turn(Fraction(3, 5), Fraction(4, 5)))


def test_matrices_of_the_wrong_size_are_undefined() -> None:
    """A product or sum of matrices that do not fit has no value."""
    for text in ("unit(3)*unit(4)", "unit(3) + unit(4)", "unit(3)[3, 0]", "dot(unit(3), unit(3))"):
        with pytest.raises(Undefined):
            exact(text)


def test_rigid_inverse() -> None:
    """inv of a transform undoes it."""
    theta = Turn(Fraction(3, 5), Fraction(4, 5))
    assert exact("inv(Screw_X(2, theta)*Screw_Z(3, theta))*Screw_X(2, theta)*Screw_Z(3, theta)", theta=theta) == exact(
        "unit(4)"
    )


def test_roots_modulo_the_prime() -> None:
    """A square has a root; one more than a square need not."""
    square = Residue(7) * Residue(7)
    found = root(square)
    assert found in (Residue(7), Residue(PRIME - 7))
    lacking = next(value for value in range(2, 60) if pow(value, (PRIME - 1) // 2, PRIME) != 1)
    with pytest.raises(Undefined):
        root(Residue(lacking))


def test_relations() -> None:
    """A chain of comparisons holds if every link does."""
    numbers = Evaluator({"r": Fraction(1)}.__getitem__, exact=True)
    assert holds(parse_relation("0 <= r < 2"), numbers)
    assert not holds(parse_relation("0 < r < 1"), numbers)
    for text in ("r", "r in r", "r + 1"):
        with pytest.raises(NotationError):
            parse_relation(text)
