"""What was checked and how it came out: the last file of every derivation.

NAME.report.json has a part that depends on the robot alone and is compared byte by byte in ``generated/``, and
one key, ``measured``, with what depends on the machine: worst errors, compiler, versions.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

PASSED, FAILED, NOT_RUN = "passed", "failed", "not run"
MEASURED = "measured"
SUFFIX = ".report.json"


@dataclass(frozen=True, kw_only=True)
class Check:
    """One law for one answerer: on how many cases it was tried, on how many it failed, and its limit."""

    law: str
    subject: str
    status: str
    tried: int = 0
    failed: int = 0
    limit: str = ""
    note: str = ""

    @property
    def name(self) -> str:
        """Who was held to what."""
        return f"{self.subject}: {self.law}" if self.subject else self.law

    def outcome(self) -> str:
        """The subject and its count, for a terminal."""
        if self.status == NOT_RUN:
            return f"{self.subject} not run"
        count = f"{self.failed} of {self.tried} FAILED" if self.failed else str(self.tried)
        return f"{self.subject} {count}".strip()


@dataclass(frozen=True, kw_only=True)
class Report:
    """The outcome of all checks on the files of one robot."""

    name: str
    title: str
    version: str
    digest: str
    task: str
    joints: tuple[str, ...]
    parameters: Mapping[str, str | None]
    maximum: int
    branches: tuple[str, ...]
    table: Sequence[str]
    singular: Mapping[str, Any] = field(default_factory=dict)
    operations: Mapping[str, Any] = field(default_factory=dict)
    checks: tuple[Check, ...] = ()
    figures: Mapping[str, Any] = field(default_factory=dict)
    files: Mapping[str, str] = field(default_factory=dict)
    measured: Mapping[str, Any] = field(default_factory=dict)
    deviation: Mapping[str, Any] | None = None
    nominal: Mapping[str, Any] | None = None
    real: str = "double"

    @property
    def verdict(self) -> str:
        """``passed``, ``failed``, or ``not run`` when there is no check at all."""
        if not self.checks:
            return NOT_RUN
        return FAILED if any(check.status == FAILED for check in self.checks) else PASSED

    @property
    def passed(self) -> bool:
        """Whether no check failed."""
        return self.verdict != FAILED

    def content(self) -> dict[str, Any]:
        """The report as it is written, in the order it is written."""
        return {
            "robot": self.name,
            "title": self.title,
            "kinsym": self.version,
            "digest": self.digest,
            "checked": self.verdict,
            "task": self.task,
            "joints": list(self.joints),
            "parameters": dict(self.parameters),
            "most_solutions": self.maximum,
            "branches": list(self.branches),
            "singular_poses": dict(self.singular),
            "figures": dict(self.figures),
            "checks": [_without_empty(check) for check in self.checks],
            "operations": dict(self.operations),
            "files": dict(self.files),
            "table": list(self.table),
            **({} if self.deviation is None else {"deviation": dict(self.deviation)}),
            **({} if self.nominal is None else {"nominal_arm": dict(self.nominal)}),
            **({} if self.real == "double" else {"real": self.real}),
            MEASURED: dict(self.measured),
        }

    def text(self) -> str:
        """The file NAME.report.json."""
        return json.dumps(self.content(), indent=2, ensure_ascii=False) + "\n"


def steady(text: str) -> str:
    """A report's text without what depends on the machine."""
    content = json.loads(text)
    content.pop(MEASURED, None)
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def at_most(value: float) -> str:
    """A bound of one digit, rounded upward.

    >>> at_most(3.2e-15), at_most(0.0), at_most(9.5e-3)
    ('<= 4e-15', '0', '<= 1e-02')
    """
    if value == 0:
        return "0"
    if not math.isfinite(value):
        return "not finite"
    exponent = math.floor(math.log10(value))
    digit = math.ceil(value / 10.0**exponent - 1e-9)
    return f"<= {digit * 10.0**exponent:.0e}"


def _without_empty(check: Check) -> dict[str, Any]:
    head = {"law": check.law, "subject": check.subject, "status": check.status}
    numbers = {"tried": check.tried, "failed": check.failed} if check.status != NOT_RUN else {}
    texts = {"limit": check.limit, "note": check.note}
    return {**head, **numbers, **{key: text for key, text in texts.items() if text}}
