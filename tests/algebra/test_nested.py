"""Polynomials as they are written."""

from __future__ import annotations

import pytest

from kinsym.algebra.nested import nested
from kinsym.algebra.ring import Generator, Kind, Poly, Ring
from kinsym.emit.text.formula import TextPrinter

RING = Ring(
    [
        Generator("c1", Kind.COSINE),
        Generator("s1", Kind.SINE, "c1"),
        Generator("a", Kind.PARAMETER),
        Generator("b", Kind.PARAMETER),
    ]
)
C, S, A, B = (RING[name] for name in ("c1", "s1", "a", "b"))


@pytest.mark.parametrize(
    ("poly", "text"),
    [
        (A - A * C, "a*(1 - c1)"),
        (A * C - A, "-a*(1 - c1)"),
        ((A + B) * (1 - C), "(a + b)*(1 - c1)"),
        (A - A * S, "a*(1 - s1)"),
        (1 - C, "1 - c1"),
        (A - B * C, "a - b*c1"),
        (A + A * C, "a*c1 + a"),
        (A - A * C + B * S, "b*s1 - a*c1 + a"),
    ],
)
def test_a_length_less_its_turned_self_is_a_versine(poly: Poly, text: str) -> None:
    """``a (1 - c)``, as the lecture writes screw displacements; only where nothing else is in the sum."""
    assert TextPrinter()(nested(RING, RING.reduce(poly))) == text
