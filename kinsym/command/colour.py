"""Colour for a terminal: headings, the verdicts of checks, errors; nothing else, and nothing where it is not wanted.

Text is laid out without colour and painted last, line by line, so that no width has to know of it and no printer of
equations. NO_COLOR (no-color.org) comes before FORCE_COLOR (force-color.org), as in Python's own tracebacks.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import TextIO

BOLD, DIM, RED, GREEN, YELLOW = "1", "2", "31", "32", "33"

#: A line with a rule of the same length under it.
_HEADING = re.compile(r"^(?P<text>\S.*)\n(?P<rule>([-=])\3{2,})$", re.MULTILINE)
#: The number and the unknown of a step, and the words that begin the parts of an explanation.
_STEP = re.compile(
    r"^  (\d+\. [^:\n]+:(?= )|(?:Known|Rule|Branches|Way):|(?:Equations?|Solution|Special cases)$)", re.MULTILINE
)
#: The word at the left edge of the line of a check.
_VERDICT = re.compile(r"^  (ok|FAILED|not run|note)(?=  )", re.MULTILINE)
_COLOURS = {"ok": GREEN, "FAILED": f"{BOLD};{RED}", "not run": YELLOW, "note": YELLOW}


def understands(stream: TextIO, environment: Mapping[str, str] = os.environ) -> bool:
    """Whether escape sequences can be sent to a stream: a terminal, and not one that says it is dumb."""
    if os.name == "nt" and "WT_SESSION" not in environment:
        return False
    return environment.get("TERM") != "dumb" and stream.isatty()


def wanted(stream: TextIO, environment: Mapping[str, str] = os.environ) -> bool:
    """Whether what goes to a stream is painted.

    >>> import io
    >>> wanted(io.StringIO(), {}), wanted(io.StringIO(), {"FORCE_COLOR": "1"})
    (False, True)
    >>> wanted(io.StringIO(), {"FORCE_COLOR": "1", "NO_COLOR": "1"})
    False
    """
    if environment.get("NO_COLOR"):
        return False
    return bool(environment.get("FORCE_COLOR")) or understands(stream, environment)


def painted(text: str) -> str:
    """A text with its headings, its steps and its verdicts in colour.

    >>> painted("  ok      no solution twice")
    '  \\x1b[32mok\\x1b[0m      no solution twice'
    """
    text = _HEADING.sub(_heading, text)
    text = _STEP.sub(lambda found: f"  {styled(found[1], BOLD)}", text)
    return _VERDICT.sub(lambda found: f"  {styled(found[1], _COLOURS[found[1]])}", text)


def styled(text: str, style: str) -> str:
    """A text between the sequences that set and end a style."""
    return f"\x1b[{style}m{text}\x1b[0m"


def _heading(found: re.Match[str]) -> str:
    if len(found["text"]) != len(found["rule"]):
        return found[0]
    return f"{styled(found['text'], BOLD)}\n{styled(found['rule'], DIM)}"
