"""C in double precision made C in single precision: a pass over its tokens.

The templates are one text. What a number has to be for a type stands in :mod:`kinsym.emit.real`; what is left is
mechanical: the keyword, the suffix of floating literals, the names of the functions of math.h. Comments, strings and
the lines of the preprocessor's includes stay as they are.
"""

from __future__ import annotations

import re
import struct
from dataclasses import replace

from kinsym.emit.real import SINGLE
from kinsym.emit.schedule import Schedule
from kinsym.errors import DoesNotApply, KinsymError, RobotError

#: Functions of math.h that have a sibling for float, those that a user's name cannot be (``kinsym.robot.names``).
FUNCTIONS = frozenset("atan2 ceil copysign cos fabs floor fmax fmin hypot pow sin sqrt".split())
_WORDS = {"double": "float", "HUGE_VAL": "HUGE_VALF"} | {name: f"{name}f" for name in FUNCTIONS}
_TOKEN = re.compile(
    r"""
    (?P<kept>/\*.*?\*/ | "(?:\\.|[^"\\])*" | '(?:\\.|[^'\\])*' | ^[ ]*\#[ ]*include[^\n]*)
    | (?P<word>[A-Za-z_]\w*)
    | (?P<number>\.?[0-9](?:[eE][+-]|[\w.])*)
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
_FLOATING = re.compile(r"(?:[0-9]+\.[0-9]*|\.[0-9]+|[0-9]+(?=[eE]))(?:[eE][+-]?[0-9]+)?")
#: So many significant digits always survive in single precision.
_SHORT = 6
_LEAST = 2.0**-126


def single(text: str) -> str:
    """A piece of C, of whole tokens and comments, in single precision.

    Raises KinsymError where a number is outside the range of float.

    >>> single("const double pi = 3.141592653589793, y = sqrt(x) + 1e-9; /* in double precision: 0.5 */")
    'const float pi = 3.1415927f, y = sqrtf(x) + 1e-9f; /* in double precision: 0.5 */'
    """
    return _TOKEN.sub(_token, text)


def literal(number: str) -> str:
    """A floating literal of C as the nearest float, in the fewest digits that read back as it.

    >>> literal("0.1"), literal("6755399441055744.0"), literal("0.41421356237309503")
    ('0.1f', '6755399400000000.0f', '0.41421357f')
    """
    value = float(number)
    try:
        nearest = _rounded(value)
    except OverflowError:
        nearest = float("inf")
    if value != 0 and not _LEAST <= abs(nearest) < float("inf"):
        raise KinsymError(f"{number} is outside the range of single precision. Use another unit of length")
    digits = re.sub(r"[eE].*", "", number).replace(".", "").strip("0")
    if len(digits) <= _SHORT:
        return f"{number}f"
    shortest = next(
        text for text in (f"{nearest:.{n}g}" for n in range(_SHORT, 10)) if _rounded(float(text)) == nearest
    )
    return f"{float(shortest)!r}f"


def _rounded(value: float) -> float:
    """The nearest float; OverflowError where there is none."""
    nearest: float = struct.unpack("<f", struct.pack("<f", value))[0]
    return nearest


def _token(found: re.Match[str]) -> str:
    text = found.group()
    if found["word"]:
        return _WORDS.get(text, text)
    if found["number"] and _FLOATING.fullmatch(text):
        return literal(text)
    return text


def in_single(schedule: Schedule) -> Schedule:
    """A schedule whose C has single precision.

    Raises DoesNotApply where an arm has no closed form: the roots of its polynomial of degree 16 need more digits than
    float has (``docs/solvers.md``). Raises RobotError for a name that float's functions have.
    """
    if schedule.general:
        raise DoesNotApply(
            f"{schedule.name} is solved through the roots of a polynomial, and that needs double precision: in single "
            "precision it loses solutions at one pose in ten. Leave --real float out, or lock or change what keeps the "
            "arm from a closed form (kinsym explain says what that is)."
        )
    names = [*(joint.name for joint in schedule.joints), *(parameter.name for parameter in schedule.parameters)]
    for name in names:
        if name in _WORDS.values():
            raise RobotError(
                f"the name {name} is a word of C in single precision",
                where=schedule.name,
                remedy="Choose another name, for example l2.",
            )
    return replace(schedule, real=SINGLE)
