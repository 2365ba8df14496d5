"""What ``tests/test_generated.py`` compares, without the checks: the text of the gallery's arms, derived again.

No part of the suite, which has that test; for a mutant it is the same answer in a tenth of the time.
"""

from __future__ import annotations

import pytest

from kinsym.command.rendering import rendered
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.facts import facts
from kinsym.robot import gallery_index, load
from tests.arms import KINDS
from tests.regenerate import GENERATED

#: Those that most changes break come first; the last one has no closed form.
FIRST = ("puma560", "planar_rr", "stanford_screw", "scorbot_5r", "scara", "raven_2")
ARMS = (*FIRST, *(name for name in KINDS if name not in FIRST), "fanuc_crx10ial")


@pytest.mark.parametrize("name", ARMS)
def test_text(name: str) -> None:
    """The files of an arm and its line in the gallery's index are those that are committed."""
    derivation = derive(load(name))
    for key, text in rendered(derivation, build_schedule(derivation)).items():
        assert text == (GENERATED / name / key).read_text(encoding="utf-8"), key
    assert facts(derivation) == gallery_index()[name]
