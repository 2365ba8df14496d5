"""The sections on the nominal arm for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from kinsym.derivation import Nominal
from kinsym.emit.prose.nominal import BESIDE, GUARANTEE, HEAD, changes, difference, doubts, offsets
from kinsym.emit.text.page import Page


def nominal_arm(nominal: Nominal, page: Page) -> str:
    """What the nominal arm is for, and in what it differs."""
    found = nominal.stand_in
    parts = [
        page.prose(BESIDE),
        page.prose(doubts(found.band)),
        page.prose(GUARANTEE),
        "\n".join(
            [page.prose(difference(found.deviation)), "", page.columns([HEAD, *changes(found.deviation)], indent=4)]
        ),
        *_offsets(nominal, page),
    ]
    return "\n\n".join(parts)


def _offsets(nominal: Nominal, page: Page) -> Iterator[str]:
    text = offsets(nominal.stand_in.offsets)
    if text:
        yield page.prose(text)
