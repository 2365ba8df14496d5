"""Arms outside the gallery are solved the way they always were, formula by formula."""

from __future__ import annotations

import pytest

from tests.ways import ARMS, way, ways


@pytest.mark.parametrize("name", ARMS)
def test_way(name: str) -> None:
    """The same steps and formulas; if another way is meant: ``python -m tests.ways``."""
    assert way(name) == ways()[name]


def test_no_way_of_an_arm_that_is_gone() -> None:
    assert tuple(ways()) == ARMS
