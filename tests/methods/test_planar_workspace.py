"""The workspace of two links, by what is known of their lengths."""

from __future__ import annotations

import pytest

from kinsym.errors import DoesNotApply
from kinsym.methods import METHODS
from kinsym.methods.document import Sentence
from kinsym.robot import from_inline


@pytest.mark.parametrize(
    ("lengths", "said"),
    [
        (("l1", "l2"), "If `l1 = l2`, the ring is a disc"),
        (("l", "l"), "The links have one length: the ring is a disc"),
        (("0.4", "0.4"), "The links have one length: the ring is a disc"),
        (("0.4", "0.3"), "The links have different lengths: a point has at most two solutions"),
    ],
)
def test_a_ring_or_a_disc(lengths: tuple[str, str], said: str) -> None:
    """A disc where the lengths are equal, a ring where they differ, both where that is open."""
    table = "; ".join(f"0 {length} 0 theta{number}" for number, length in enumerate(lengths, 1))
    derivation = METHODS["workspace"](from_inline(table, convention="paul", name="arm"))
    texts = [passage.text for passage in derivation.passages if isinstance(passage, Sentence)]
    assert any(text.startswith(said) for text in texts)
    assert ("origin" in texts[-1]) == ("disc" in said)


@pytest.mark.parametrize(
    ("table", "reason"),
    [
        ("0 -0.4 0 theta1; 0 0.3 0 theta2", "link 1 has the length -2/5, which is not positive"),
        ("0 0.4 0 theta1; 0 0 0 theta2", "link 2 has the length 0, which is not positive"),
        ("0 0.4 0 theta1; 0 0.3 d2 0", "its joints are R P"),
        ("0 0.4 0 theta1; 0 0.3 0 theta2+pi/2", "its links are not straight"),
    ],
)
def test_no_ring_at_all(table: str, reason: str) -> None:
    with pytest.raises(DoesNotApply, match=f"does not apply to arm: .*{reason}"):
        METHODS["workspace"](from_inline(table, convention="paul", name="arm"))


def test_an_equation_that_is_not_there_is_told_with_those_that_are() -> None:
    derivation = METHODS["workspace"](from_inline("0 l1 0 theta1; 0 l2 0 theta2", convention="paul", name="arm"))
    first = derivation.equations[0]
    assert derivation.equation(first.name) is first
    with pytest.raises(KeyError, match=f"'radius_of_nothing' is none of {first.name}, "):
        derivation.equation("radius_of_nothing")
