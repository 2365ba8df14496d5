"""What ``kinsym derive --json`` prints: one object, its keys described in ``docs/terminal.md`` and never renamed."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from kinsym.check.report import Report
from kinsym.derivation import Derivation
from kinsym.facts import facts
from kinsym.robot.summary import to_toml

#: Keys of the report that stand in the object as they are.
_REPORTED = ("figures", "operations", "singular_poses", "deviation", "nominal_arm", "real")


def derived(derivation: Derivation, report: Report, paths: Sequence[Path], status: int) -> dict[str, Any]:
    """The result of a derivation as plain data; ``paths`` are the files that were written."""
    content = report.content()
    table = tomllib.loads(to_toml(derivation.robot))
    found = facts(derivation)
    return {
        "status": status,
        "kinsym": report.version,
        "robot": report.name,
        "title": report.title,
        "class": found["class"],
        "joints": found["joints"],
        "convention": table["convention"],
        "task": report.task,
        "table": {
            "joints": table["joints"],
            **{key: table[key] for key in ("home", "base", "tool", "locks") if key in table},
            "parameters": content["parameters"],
        },
        "closed_form": found["closed_form"],
        "solutions": found["solutions"],
        "branches": content["branches"],
        **{key: content[key] for key in _REPORTED if key in content},
        "checked": report.verdict,
        "checks": content["checks"],
        "files": [str(path) for path in paths],
    }
