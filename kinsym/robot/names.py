"""Which names a table may use.

Every name of a table becomes a name of the generated Python and C, beside names that kinsym makes itself: ``c23``,
``theta234``, ``p16_x``, ``kappa1``. A name that would clash is refused here, once, with a reason, so that no
printer has to rename anything and the user's words survive into the source.
"""

from __future__ import annotations

import builtins
import difflib
import keyword
import re
import sys
from collections.abc import Iterable

from kinsym.errors import RobotError

LONGEST_NAME = 40
# A hint takes time by the number of names and the square of their length; files of others can hold thousands.
LONGEST_COMPARED, MOST_COMPARED = 60, 1000

_C_KEYWORDS = frozenset(
    """auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    _Bool _Complex _Imaginary NULL NAN INFINITY HUGE_VAL EOF errno main assert bool true false complex imaginary
    offsetof size_t ptrdiff_t""".split()
)
# The generated header may be included from C++.
_CPP_KEYWORDS = frozenset(
    """alignas alignof and asm catch class compl concept consteval constexpr constinit const_cast decltype delete
    dynamic_cast explicit export friend module mutable namespace new noexcept not nullptr operator or override
    private protected public reinterpret_cast requires static_assert static_cast template this thread_local throw
    try typeid typename using virtual wchar_t xor""".split()
)
_FUNCTIONS = frozenset(
    """acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh deg erf exp exp2 expm1 fabs fdim floor fma
    fmax fmin fmod frexp hypot ldexp log log10 log2 modf nan pi pow remainder rint round sign sin sinh sqrt tan tanh
    tgamma trunc wrap""".split()
)
# Names of the generated functions, of what they call, and of what is local where the user's names are in scope.
_GENERATED = frozenset(
    """T q p R J G M N S I i j k m n np numpy math tau size delta defect reference zeros parameters valid real out pose
    count fk ik ik_batch ik_near ik_sweep jacobian self all_finite angle_of sign_of read_pose reaches usable isfinite
    isnan NEAR mark marks alike settle polish distance tidied special slopes step solutions given free border apart
    branch constant_motions direction homogeneous homogeneous2 linear links quadratic quartic quotient quotient_length
    rigid_motion triangle whole linux unix found solve within nearest weights limits status Solutions NamedTuple TURN
    SLACK LANES block path opposite half_turn unwound larger NAME TITLE JOINTS JOINT_TYPES PARAMETERS
    MAX_SOLUTIONS TASK LOCKED BRANCHES LIMITS""".split()
)
_PATTERNS = (
    (re.compile(r"theta\d+"), "such names are joint angles and their sums (theta23 is theta2 + theta3)"),
    (re.compile(r"[cs]\d+(m\d+)*"), "such names are cosines and sines (c23 is cos(theta2 + theta3))"),
    (re.compile(r"[cs](alpha|theta)\w*"), "such names are cosines and sines of angles"),
    (re.compile(r"[uvwpzo]\d*_[xyz]|oE_[xyz]"), "such names are entries of poses and axes"),
    (re.compile(r"(kappa|lambda|mu|nu|gamma)\d+|const\d+"), "such names are coefficients of the derivation"),
    (re.compile(r"[in]\d+|(real|mark)\d+|\w+_(roots|other)"), "such names count branches"),
    (re.compile(r"lane_\w+|\w+_lanes"), "such names are functions and arrays of the generated source"),
    (re.compile(r"[hkw]_\d+(m\d+)*"), "such names are quantities of the derivation"),
    (re.compile(r"A\d+|T_\d+_\d+"), "such names are link transforms and poses"),
    (re.compile(r"(base|end)_[uvwp][xyz]"), "such names are entries of the base and of the last link with the tool"),
    (re.compile(r"solve_\w+"), "such names are functions of the generated source"),
    (re.compile(r"(M|DBL|FLT|FP|INT|UINT|SIZE|IS)_\w+"), "such names are constants of C"),
)
_WINDOWS_DEVICES = frozenset(
    ["con", "prn", "aux", "nul", *(f"com{n}" for n in range(10)), *(f"lpt{n}" for n in range(10))]
)
_C_HEADERS = frozenset("complex ctype errno float limits locale math setjmp signal stdint stdio stdlib string".split())


def nearest(name: str, candidates: Iterable[str]) -> str:
    """A hint, "Did you mean X? ", or nothing when no candidate is close.

    >>> nearest("alhpa", ["alpha", "a", "d", "theta"])
    'Did you mean alpha? '
    """
    if len(name) > LONGEST_COMPARED:
        return ""
    near = sorted({other for other in candidates if len(other) <= LONGEST_COMPARED})[:MOST_COMPARED]
    found = difflib.get_close_matches(name, near, n=1, cutoff=0.5)
    return f"Did you mean {found[0]}? " if found else ""


def shown(text: str, longest: int = 60) -> str:
    """Text of the user as it is quoted in a message: escaped, and cut when it is long."""
    return ascii(text) if len(text) <= longest else ascii(text[:longest])[:-1] + "...'"


def _general_fault(name: str) -> str | None:
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
        return "is not a plain name: letters, digits and _, beginning with a letter"
    if len(name) > LONGEST_NAME:
        return f"is longer than {LONGEST_NAME} letters"
    if name.startswith("_") or "__" in name:
        return "begins with _ or holds __, which is kept for generated code"
    if keyword.iskeyword(name) or keyword.issoftkeyword(name):
        return "is a keyword of Python"
    if name in _C_KEYWORDS:
        return "is a keyword or a fixed word of C"
    if name in _CPP_KEYWORDS:
        return "is a keyword of C++"
    return None


def _cell_fault(name: str) -> str | None:
    general = _general_fault(name)
    if general:
        return general
    if name in _FUNCTIONS:
        return "is the name of a function or constant"
    if name in _GENERATED:
        return "is used by the generated code itself"
    if hasattr(builtins, name):
        return "is a built-in name of Python"
    return None


def check_parameter(name: str, *, where: str) -> str:
    """``name`` itself if it can be a parameter; RobotError otherwise.

    >>> check_parameter("a2", where="[parameters]")
    'a2'
    """
    fault = _cell_fault(name)
    if not fault:
        fault = next((f"cannot be a parameter: {why}" for shape, why in _PATTERNS if shape.fullmatch(name)), None)
    if fault:
        raise RobotError(f"the name {shown(name)} {fault}", where=where, remedy="Choose another name, for example l2.")
    return name


def check_variable(name: str, *, where: str) -> str:
    """``name`` itself if it can be a joint variable (``theta1``, ``d3``, ``q2``); RobotError otherwise."""
    fault = _cell_fault(name)
    if not fault and not re.fullmatch(r"theta\d", name):
        fault = next((f"cannot be a joint variable: {why}" for shape, why in _PATTERNS if shape.fullmatch(name)), None)
    if fault:
        raise RobotError(
            f"the name {shown(name)} {fault}", where=where, remedy="Choose another name, for example theta1, d3 or q2."
        )
    return name


def check_robot_name(name: str, *, where: str) -> str:
    """``name`` itself if it can name a robot, its files, a Python module and C functions; RobotError otherwise."""
    fault = _general_fault(name)
    if not fault and (name in sys.stdlib_module_names or name in {"numpy", "kinsym", "setuptools", "pip"}):
        fault = "is a module that the generated Python may need"
    if not fault and name.lower() in _C_HEADERS:
        fault = "is a header of C"
    if not fault and name == "std":
        fault = "is the namespace of C++'s library"
    if not fault and name.lower() in _WINDOWS_DEVICES:
        fault = "is not a file name on every system"
    if fault:
        raise RobotError(
            f"the name {shown(name)} {fault}",
            where=where,
            remedy="Choose a plain name such as my_robot, here or with --name; it names the files and the functions.",
        )
    return name
