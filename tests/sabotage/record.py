"""Outcomes in a file, a line for each mutant, so that a long run can be broken off and go on.

What was tried is not tried again; so a file is good for one state of kinsym. Two runs may write to the same file.
"""

from __future__ import annotations

import json
from pathlib import Path

from tests.sabotage.mutant import Mutant
from tests.sabotage.run import Outcome


class Record:
    """The outcomes of a file, or none where there is no file."""

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._known: dict[str, tuple[str, str]] = {}
        if path is not None and path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                key, outcome, reason = json.loads(line)
                self._known[key] = outcome, reason

    def find(self, robot: str, mutant: Mutant) -> Outcome | None:
        """The outcome of a mutant, if it is known."""
        known = self._known.get(_key(robot, mutant))
        return None if known is None else Outcome(robot=robot, mutant=mutant, outcome=known[0], reason=known[1])

    def keep(self, outcome: Outcome) -> Outcome:
        """Put an outcome behind the others; returns it."""
        key = _key(outcome.robot, outcome.mutant)
        self._known[key] = outcome.outcome, outcome.reason
        if self._path is not None:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps([key, outcome.outcome, outcome.reason]) + "\n")
        return outcome


def _key(robot: str, mutant: Mutant) -> str:
    return f"{robot}: {mutant}"
