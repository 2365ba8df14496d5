"""A schedule as one file of C++ with the interface of ikfast, which MoveIt and OpenRAVE load.

The C of the target ``c`` stands in a namespace of its own; around it are the functions that ikfast.h declares. The
interface is that of ikfast 0x1000004a: create_ikfast_moveit_plugin.py looks for the first line that begins with
``/// ikfast version`` and takes what stands before `` generated`` for a number that has to be at least 56.
"""

from __future__ import annotations

from kinsym import __version__
from kinsym.emit.environment import render
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.banner import banner, c_comment
from kinsym.emit.source.c_source import c_names
from kinsym.emit.source.core import embedded, macros
from kinsym.emit.source.wrapping import WIDTH, fill
from kinsym.errors import RobotError
from kinsym.robot.model import Task

VERSION = "0x1000004a"
TYPES = {
    Task.POSE: ("Transform6D", "0x67000001"),
    Task.SCARA: ("Transform6D", "0x67000001"),
    Task.PLANAR: ("Transform6D", "0x67000001"),
    Task.ORIENTATION: ("Rotation3D", "0x34000002"),
    Task.POSITION: ("Translation3D", "0x33000003"),
    Task.POSITION_AXIS: ("TranslationDirection5D", "0x56000007"),
}
"""What ikfast calls a task, and its number (IkParameterizationType in MoveIt's plugin). SCARA and planar arms take a
whole pose, of which they refuse what they do not reach."""

_ROTATION = [f"rot[{k}]" for k in range(9)]
_POSITION = [f"trans[{k}]" for k in range(3)]
_NUMBERS = {
    "Transform6D": [item for row in range(3) for item in (*_ROTATION[3 * row : 3 * row + 3], _POSITION[row])],
    "Rotation3D": _ROTATION,
    "Translation3D": _POSITION,
    "TranslationDirection5D": [*_POSITION, *_ROTATION[:3]],
}
"""What the program reads from its command line, in order; of a whole pose the rows of [R p], as ikfast has it."""
_WORDS = {
    "Transform6D": "r00 r01 r02 t0 r10 r11 r12 t1 r20 r21 r22 t2",
    "Rotation3D": "r00 r01 r02 r10 r11 r12 r20 r21 r22",
    "Translation3D": "t0 t1 t2",
    "TranslationDirection5D": "t0 t1 t2 d0 d1 d2",
}


def ikfast_source(schedule: Schedule) -> dict[str, str]:
    """The file NAME_ikfast.cpp.

    Raises :class:`RobotError` with the parameters that have no value: ikfast's functions take none.
    """
    lacking = [parameter.name for parameter in schedule.parameters if parameter.value is None]
    if lacking:
        one = len(lacking) == 1
        raise RobotError(
            f"an ikfast solver takes no parameters, and {', '.join(lacking)} {'has' if one else 'have'} no value",
            where=schedule.name,
            remedy=f"Fold numbers in, for example with --bind {lacking[0]}=0.4.",
        )
    names = c_names(schedule, embedded(whole=False))
    text = render("c/header.h.jinja", **names) + "\n" + render("c/source.c.jinja", **names)
    kind, number = TYPES[schedule.task]
    joints = [joint.name for joint in schedule.joints]
    values = f"&{schedule.name}_core::{schedule.name}_defaults"
    source = render(
        "ikfast/solver.cpp.jinja",
        version=VERSION,
        kinsym=__version__,
        banner=[c_comment(line) for line in banner(schedule, shared=True)],
        name=schedule.name,
        digest=schedule.digest,
        kind=kind,
        id=number,
        core_text=text,
        macros=macros(text, schedule.name),
        joints=joints,
        types=["0x01" if joint.kind == "R" else "0x11" for joint in schedule.joints],
        inputs=schedule.inputs,
        free=[joints.index(name) for name in schedule.inputs],
        free_lines=[line for sentence in _free(schedule) for line in fill(c_comment(sentence), WIDTH - 3)],
        most=schedule.maximum,
        values=values,
        numbers=_NUMBERS[kind],
        usage=" ".join([_WORDS[kind], *schedule.inputs]),
    )
    return {f"{schedule.name}_ikfast.cpp": source}


def companions(schedule: Schedule) -> dict[str, str]:
    """An ikfast.h of our own, and shim.cpp, which includes the solver as MoveIt's plugin does, for the checks."""
    kind, _ = TYPES[schedule.task]
    return {
        "ikfast.h": render("ikfast/ikfast.h.jinja"),
        "shim.cpp": render("ikfast/shim.cpp.jinja", name=schedule.name, kind=kind),
    }


def _free(schedule: Schedule) -> list[str]:
    """What becomes of joints that the caller or the pose leaves open."""
    given = ", ".join(schedule.inputs)
    first = [f"Free parameters, in the order of pfree: {given}."] if given else []
    return [
        *first,
        "A joint that a singular pose leaves open is 0 in its solution, and the list of free joints of a solution "
        "(GetFree) is empty: each solution is one joint vector. Its index (GetSolutionIndices) is the number of its "
        "branch.",
    ]
