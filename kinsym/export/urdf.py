"""A robot as the skeleton of a URDF file: links without shape or mass, joints with origin, axis and limits.

The axes at home are those of the exact table in numbers of 40 digits; every joint's frame has its z axis along the
joint's axis, and the last link is the end effector's frame.
"""

from __future__ import annotations

from xml.sax.saxutils import quoteattr

from kinsym import __version__
from kinsym.emit.environment import render
from kinsym.emit.source.banner import printable
from kinsym.export.numbers import decimal, require_numbers
from kinsym.robot.geometry.arm import arm_of
from kinsym.robot.geometry.frames import CONTEXT, UNIT, Frame, Vector
from kinsym.robot.model import Robot

TIP = "tool0"
BASE = "base_link"
#: Nearer than this to straight up or down, roll and yaw turn about one axis, and roll is taken as 0.
UPRIGHT = CONTEXT.mpf("1e-18")


def urdf(robot: Robot) -> str:
    """The text of a URDF file.

    Its links are ``base_link``, one behind each joint, and ``tool0``; its joints have the names of the table. Raises
    :class:`RobotError` with the parameters that have no value.

    >>> from kinsym.robot import load
    >>> [line.strip() for line in urdf(load("ur5")).splitlines() if "<axis" in line][:1]
    ['<axis xyz="0 0 1"/>']
    """
    require_numbers(robot)
    arm = arm_of(robot)
    here, parent, joints = UNIT, BASE, []
    for axis in arm.axes:
        child = f"link_{axis.name}"
        joints.append(
            {
                "name": quoteattr(axis.name),
                "type": "prismatic" if axis.kind == "P" else "revolute" if axis.limits else "continuous",
                "parent": quoteattr(parent),
                "child": quoteattr(child),
                "limits": [decimal(float(limit)) for limit in axis.limits or (0, 0)],
                "bounded": axis.limits is not None,
                **_origin(here.inverse().then(axis.frame)),
            }
        )
        here, parent = axis.frame, child
    return render(
        "export/robot.urdf.jinja",
        name=quoteattr(robot.name),
        title=_comment(robot.title or robot.name),
        version=__version__,
        base=quoteattr(BASE),
        joints=joints,
        last=quoteattr(parent),
        tip=quoteattr(TIP),
        tool=_origin(here.inverse().then(arm.tip)),
    )


def _origin(frame: Frame) -> dict[str, str]:
    return {"xyz": " ".join(map(decimal, frame.origin)), "rpy": " ".join(map(decimal, rpy(frame)))}


def rpy(frame: Frame) -> Vector:
    """Roll, pitch and yaw of Rz(yaw) Ry(pitch) Rx(roll), pitch in [-pi/2, pi/2].

    >>> from kinsym.robot.geometry.frames import turn
    >>> [round(float(angle), 12) for angle in rpy(turn("z", 0.3).then(turn("y", 0.2)).then(turn("x", 0.1)))]
    [0.1, 0.2, 0.3]
    """
    across = CONTEXT.hypot(frame.x[0], frame.x[1])
    pitch = CONTEXT.atan2(-frame.x[2], across)
    if across < UPRIGHT:
        return CONTEXT.mpf(0), pitch, CONTEXT.atan2(-frame.y[0], frame.y[1])
    return CONTEXT.atan2(frame.y[2], frame.z[2]), pitch, CONTEXT.atan2(frame.x[1], frame.x[0])


def _comment(text: str) -> str:
    """Text that cannot end a comment of XML, which must not hold two hyphens in a row.

    >>> _comment("a --> b ---")
    'a - -> b - - -'
    """
    text = printable(text)
    while "--" in text:
        text = text.replace("--", "- -")
    return text
