"""The sections on the nominal arm of a LaTeX document."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kinsym.emit.latex.sentences import Words, escape
from kinsym.emit.prose.nominal import (
    BESIDE,
    GUARANTEE,
    HEAD,
    NOMINAL,
    SINGULAR,
    TITLE,
    changes,
    difference,
    doubts,
    offsets,
)

if TYPE_CHECKING:
    from kinsym.derivation import Nominal


def about(nominal: Nominal, words: Words = escape) -> dict[str, Any]:
    """What ``nominal.tex.j2`` reads beside the nominal arm's own derivation; ``words`` escapes what is no formula."""
    found = nominal.stand_in
    return {
        "heading": TITLE,
        "inverse_title": NOMINAL,
        "singular_title": SINGULAR,
        "sentences": [words(text) for text in (BESIDE, doubts(found.band), GUARANTEE)],
        "difference": words(f"{difference(found.deviation)}"),
        "head": HEAD,
        "changes": [[words(cell) for cell in row] for row in changes(found.deviation)],
        "offsets": words(offsets(found.offsets)),
    }
