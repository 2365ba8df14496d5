"""The terminal's equations: what a reader sees is exact, in the lecture's form, and fits the terminal."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kinsym.emit.prose.breaking import TEXT, broken
from kinsym.emit.text import equations
from kinsym.emit.text.formula import TextPrinter
from tests.emit.sample import fanuc, planar_2r, tree

SAMPLES = {"planar_2r": planar_2r, "fanuc": fanuc}


@pytest.fixture(params=SAMPLES)
def derivation(request: pytest.FixtureRequest) -> Any:
    return SAMPLES[request.param]()


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        # lecture, Stanford arm, r11 (section 3.2): products nested by joint
        (
            "c1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6) - s1*(s4*c5*c6 + c4*s6)",
            "c1*(c2*(c4*c5*c6 - s4*s6) - s2*s5*c6) - s1*(s4*c5*c6 + c4*s6)",
        ),
        # lecture 2.84 and 2.88: theta1 and a coefficient
        ("atan2(p_y, p_x) @ atan2(sqrt(a**2 - e**2), e)", "Atan2(p_y, p_x) ± Atan2(sqrt(a^2 - e^2), e)"),
        ("0 @ atan2(s5, c5)", "±Atan2(s5, c5)"),
        ("-a*(b + c)", "-a*(b + c)"),
        ("a - (b - c)", "a - b + c"),
        ("(a + b)**2", "(a + b)^2"),
        ("kappa1/(2*l1*l2)", "kappa1/(2*l1*l2)"),
        ("(a + b)/(c - d)", "(a + b)/(c - d)"),
        ("a*(b/c)", "a*(b/c)"),
        ("0.5*pi", "pi/2"),
        ("-1.5*a*b", "-3*a*b/2"),
        ("0.4318*c2 + 0.25", "0.4318*c2 + 1/4"),
        ("hypot(a, b + c)", "sqrt(a^2 + (b + c)^2)"),
    ],
)
def test_formulas(source: str, expected: str) -> None:
    assert TextPrinter()(tree(source)) == expected


def test_the_pieces_of_the_fanuc_arm_are_there() -> None:
    text = equations(fanuc(), width=100)
    for line in (
        "u_x = c1*(c23*(c4*c5*c6 - s4*s6) - s23*s5*c6) + s1*(s4*c5*c6 + c4*s6)",
        "kappa2*c3 + kappa1*s3 = kappa3",
        "real if kappa3^2 <= kappa1^2 + kappa2^2",
        "theta1 = Atan2(p06_y, p06_x)",
        "theta5 = ±Atan2(sqrt(1 - w36_z^2), w36_z)",
        "T_3_6 = A3^-1 A2^-1 T_1_6",
        "d6  no value: a required argument of the generated code",
        "d4  = 1.6",
    ):
        assert f"{line}\n" in text
    assert re.findall(r"^  (\d)\. (theta\d):", text, re.MULTILINE) == [
        ("1", "theta1"),
        ("2", "theta3"),
        ("3", "theta2"),
        ("4", "theta5"),
        ("5", "theta4"),
        ("6", "theta6"),
    ]


def test_solutions_are_listed_outermost_branch_first() -> None:
    table = equations(fanuc()).split("Solutions\n")[1]
    rows = [line.split() for line in table.splitlines() if re.match(r"  \d ", line)]
    assert rows[0][:4] == ["1", "+", "+", "+"]
    assert rows[1] == ["2", "+", "+", "-"]
    assert rows[4] == ["5", "-", "+", "+"]
    assert len(rows) == 8


@pytest.mark.parametrize("width", [60, 80, 100])
def test_lines_fit(derivation: Any, width: int) -> None:
    text = equations(derivation, width=width, full=True)
    assert max(map(len, text.splitlines())) <= width


def test_ascii_is_ascii(derivation: Any) -> None:
    text = equations(derivation, ascii=True, full=True)
    assert text.isascii()
    assert "+-" in text


def test_a_title_cannot_forge_lines() -> None:
    text = equations(planar_2r("two\nlines\t\x1b[31m and an escape"))
    assert text.startswith("two lines ")
    assert "\x1b" not in text


_formulas = st.recursive(
    st.sampled_from(["c1", "s23", "a2", "kappa1", "p16_x", "offset_of_the_shoulder"]),
    lambda inner: st.lists(inner, min_size=2, max_size=5).flatmap(
        lambda parts: st.sampled_from([" + ".join(parts), "c4*(" + " - ".join(parts) + ")"])
    ),
    max_leaves=40,
)


@given(_formulas, st.integers(20, 100))
def test_breaking_loses_nothing(formula: str, width: int) -> None:
    lines = broken(formula, width, syntax=TEXT)
    assert " ".join(line.text for line in lines) == formula
    for line in lines:
        longest_term = max(map(len, re.split(r" (?=[-+])", line.text)))
        assert len(line.text) <= max(width - 2 * line.depth, longest_term)
