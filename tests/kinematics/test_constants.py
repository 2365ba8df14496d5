"""What the cells of a table become in the ring, against SymPy's own values, and their points modulo the prime."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from sympy import N, Rational, cos, pi, sin

from kinsym.algebra.field import PRIME
from kinsym.algebra.ring import Poly, Ring
from kinsym.kinematics.constants import Constants, split_angle
from kinsym.robot.expressions import parse, symbol

NUMBERS = {"a": Rational(3, 7), "b": Rational(-5, 11)}
VALUES = {symbol(name): value for name, value in NUMBERS.items()}
LENGTHS = (
    "0",
    "3/2",
    "a",
    "-a*b/3 + a**2",
    "2*a**2*b - sqrt(6)/3*a + 1/2",
    "1/sqrt(2)",
    "sqrt(12)*b",
    "sqrt(2 + sqrt(2))*a",
    "pi*a",
    "a*cos(pi/9)**2*sin(pi/9)",
    "sin(1)**3 - b*cos(1)",
    "b/cos(1)",
)
ANGLES = (
    "0",
    "pi/2",
    "-pi/2",
    "pi",
    "3*pi/2",
    "7*pi/2",
    "pi/7",
    "-pi/6",
    "a",
    "-a",
    "b - pi/2",
    "pi - b",
    "a - b",
    "1",
)


def value(constants: Constants, ring: Ring, poly: Poly) -> float:
    """A polynomial at the values of the parameters, the constants as their formulas say."""
    numbers = {name: float(number) for name, number in NUMBERS.items()}
    for name, formula in constants.formulas():
        numbers[name] = float(N(formula.doit().subs(VALUES)))
    total = 0.0
    for monomial, coefficient in poly.terms():
        term = float(Fraction(int(coefficient.numerator), int(coefficient.denominator)))
        for generator, exponent in zip(ring.generators, monomial, strict=True):
            term *= numbers[generator.name] ** exponent if exponent else 1.0
        total += term
    return total


@pytest.mark.parametrize("text", LENGTHS)
def test_a_length_keeps_its_value(text: str) -> None:
    cell = parse(text)
    constants = Constants(list(NUMBERS))
    constants.note_length(cell)
    ring = Ring(constants.generators())
    poly = constants.length(ring, cell)
    expected = float(N(cell.subs(VALUES)))
    assert value(constants, ring, poly) == pytest.approx(expected)
    assert float(N(constants.expression(ring, poly).subs(VALUES))) == pytest.approx(expected)


@pytest.mark.parametrize("text", ANGLES)
def test_an_angle_keeps_its_cosine_and_sine(text: str) -> None:
    cell = parse(text)
    constants = Constants(list(NUMBERS))
    constants.note_angle(cell, "alpha1")
    ring = Ring(constants.generators())
    expected = [float(N(function(cell.subs(VALUES)))) for function in (cos, sin)]
    assert [value(constants, ring, poly) for poly in constants.angle(ring, cell)] == pytest.approx(expected)
    held = Constants(list(NUMBERS))
    held.note_held(cell, "3")
    ring = Ring(held.generators())
    assert [value(held, ring, poly) for poly in held.held(ring, cell)] == pytest.approx(expected)


@pytest.mark.parametrize("text", ANGLES)
def test_quarter_turns_are_taken_out_of_an_angle_and_its_sign(text: str) -> None:
    cell = parse(text)
    generic, sign, quarters = split_angle(cell)
    assert (sign * generic + quarters * pi / 2 - cell) % (2 * pi) == 0
    assert 0 <= quarters < 4
    assert sign in (1, -1)
    assert split_angle(-cell)[0] == generic or generic.has(pi)
    assert generic == 0 or not generic.could_extract_minus_sign()


def test_an_angle_that_is_a_multiple_of_a_quarter_turn_needs_no_generator() -> None:
    constants = Constants([])
    for text in ("0", "pi/2", "-pi", "5*pi/2"):
        constants.note_angle(parse(text), "alpha1")
        constants.note_held(parse(text), "1")
    assert constants.generators() == []


def test_names_are_those_of_the_angles_and_each_is_taken_once() -> None:
    constants = Constants([])
    for cell, name in (("a", "alpha1"), ("-a", "alpha2"), ("a + pi/2", "alpha3"), ("pi/7", "a"), ("pi/9", "a")):
        constants.note_angle(parse(cell), name)
    assert list(constants.angles.values()) == ["a", "a_", "a__"]
    assert [generator.name for generator in constants.generators()] == ["ca", "sa", "ca_", "sa_", "ca__", "sa__"]


def test_constants_of_lengths_are_counted_and_equal_ones_shared() -> None:
    constants = Constants([])
    for text in ("sqrt(6)", "sqrt(2)", "2*sqrt(3) + pi", "cos(pi/9)", "sin(pi/9) + sin(1)"):
        constants.note_length(parse(text))
    assert {str(cell): name for cell, name in constants.derived.items()} == {
        "sqrt(2)": "const1",
        "sqrt(3)": "const2",
        "pi": "const3",
    }
    assert list(constants.angles.values()) == ["angle1", "angle2"]
    squares = {generator.name: generator.square for generator in constants.generators()}
    assert [squares[name] for name in ("const1", "const2", "const3")] == [2, 3, None]


def test_formulas_are_written_as_in_the_table() -> None:
    """SymPy would write the cosine of pi/5 with roots."""
    constants = Constants([])
    constants.note_angle(parse("pi/5"), "alpha1")
    constants.note_length(parse("sqrt(2)"))
    texts = [(name, str(formula)) for name, formula in constants.formulas()]
    assert texts == [("calpha1", "cos(pi/5)"), ("salpha1", "sin(pi/5)"), ("const1", "sqrt(2)")]


def test_what_is_no_polynomial_is_one_constant_with_its_name() -> None:
    constants = Constants(["b"])
    constants.note_length(3 * symbol("b") ** -2 + symbol("b"))
    assert constants.derived == {symbol("b") ** -2: "const1"}


def test_entries_of_a_frame_get_names_where_they_are_more_than_a_number_or_a_parameter() -> None:
    constants = Constants(list(NUMBERS))
    cells = {"one": "3/2", "zero": "0", "plain": "a", "root": "sqrt(2)", "sum": "a + b", "product": "a*sqrt(2)*b"}
    for cell in cells.values():
        constants.note_length(parse(cell))
    plain = Ring(constants.generators())
    for name, cell in cells.items():
        constants.note_entry(plain, constants.length(plain, parse(cell)), name)
    assert list(constants.entries) == ["root", "sum", "product"]
    ring = Ring(constants.generators())
    for name in constants.entries:
        assert value(constants, ring, ring[name]) == pytest.approx(float(N(parse(cells[name]).subs(VALUES))))
        assert constants.expression(ring, ring[name]) == parse(cells[name])
    drawn = constants.sample(random.Random(1), {"a": 3})
    assert (drawn["a"], drawn["sum"]) == (3, (3 + drawn["b"]) % PRIME)
    assert drawn["root"] ** 2 % PRIME == 2


def points(cell: str, *, seed: int = 1, angle: bool = True, **given: int) -> dict[str, int]:
    """What is drawn for an angle called alpha1 or a length, and for the parameters a and b."""
    constants = Constants(list(NUMBERS))
    if angle:
        constants.note_angle(parse(cell), "alpha1")
    else:
        constants.note_length(parse(cell))
    return constants.sample(random.Random(seed), given)


@pytest.mark.parametrize("cell", ["pi/3", "pi/7", "pi/11", "1", "a + b", "a + pi/3", "a - pi/11"])
def test_points_lie_on_the_circle_and_differ_where_the_angle_is_not_exact(cell: str) -> None:
    (c, s), other = ([*points(cell, seed=seed).values()][-2:] for seed in (1, 2))
    assert (c * c + s * s) % PRIME == 1
    assert ((c, s) == tuple(other)) == (cell in ("pi/3", "pi/7"))


def test_points_of_angles_that_the_field_holds_are_exact() -> None:
    assert points("pi/3")["calpha1"] * 2 % PRIME == 1
    assert points("pi/6")["salpha1"] * 2 % PRIME == 1
    root = points("pi/4")["calpha1"]
    assert root * root * 2 % PRIME == 1


@pytest.mark.parametrize("number", [2, 3, 5, 7, 11, 13, 17, 19, 23, 29])
def test_roots_are_exact_where_the_field_has_them_and_drawn_where_not(number: int) -> None:
    roots = {points(f"sqrt({number})", seed=seed, angle=False)["const1"] for seed in (1, 2)}
    exact = pow(number, (PRIME - 1) // 2, PRIME) == 1
    assert {root * root % PRIME == number for root in roots} == {exact}
    assert len(roots) == (1 if exact else 2)


def test_what_is_given_is_kept() -> None:
    drawn, kept = points("b"), points("b", a=5, cb=6)
    assert (kept["a"], kept["cb"], kept["sb"]) == (5, 6, drawn["sb"])
    assert drawn["a"] != 5
    assert all(0 < number < PRIME for number in drawn.values())
