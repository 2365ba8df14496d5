"""Mutants that no test can kill: why each of them computes the same, in ``reasons.toml``.

An entry has the module, the lines as they are and as the mutant has them, and the reason. It names no line numbers, so
that it holds as long as the lines do.
"""

from __future__ import annotations

import tomllib
from pathlib import Path

from tests.mutation.mutants import Mutant

FILE = Path(__file__).resolve().parent / "reasons.toml"

Reasons = dict[tuple[str, str, str], str]


def reasons(file: Path = FILE) -> Reasons:
    """The reasons by module, lines before and lines after."""
    entries = tomllib.loads(file.read_text(encoding="utf-8"))["equal"]
    return {(entry["module"], entry["before"], entry["after"]): entry["why"] for entry in entries}


def reason(mutant: Mutant, known: Reasons) -> str:
    """Why a mutant is equal to good code; empty if nobody has said so."""
    return known.get((mutant.module, mutant.before, mutant.after), "")
