"""kinsym: closed-form kinematics of serial robots, as formulas and as source code.

>>> import kinsym as ks
>>> solution = ks.derive(ks.load("fanuc_s900w"))
>>> [step.unknown for step in solution.ik]
['theta1', 'theta3', 'theta2', 'theta4', 'theta5', 'theta6']

Importing the package is quick on purpose: SymPy and NumPy are loaded by the parts that calculate, when they are used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

__version__ = "0.1.0"

if TYPE_CHECKING:
    from kinsym import frames, workspace
    from kinsym.errors import CheckFailed, DeadlineExceeded, DoesNotApply, KinsymError, NoClosedForm, RobotError
    from kinsym.interface.solution import Solution, compile, derive
    from kinsym.live import LiveArm, Solutions
    from kinsym.methods import METHODS
    from kinsym.robot.binding import bind
    from kinsym.robot.catalogue import gallery
    from kinsym.robot.files import from_inline
    from kinsym.robot.loading import load
    from kinsym.robot.locking import lock
    from kinsym.robot.model import Convention, Robot, Task

__all__ = [
    "METHODS",
    "CheckFailed",
    "Convention",
    "DeadlineExceeded",
    "DoesNotApply",
    "KinsymError",
    "LiveArm",
    "NoClosedForm",
    "Robot",
    "RobotError",
    "Solution",
    "Solutions",
    "Task",
    "__version__",
    "bind",
    "compile",
    "derive",
    "frames",
    "from_inline",
    "gallery",
    "load",
    "lock",
    "workspace",
]

_MODULES = {
    "kinsym": ("frames", "workspace"),
    "kinsym.errors": (
        "CheckFailed",
        "DeadlineExceeded",
        "DoesNotApply",
        "KinsymError",
        "NoClosedForm",
        "RobotError",
    ),
    "kinsym.interface.solution": ("Solution", "compile", "derive"),
    "kinsym.live": ("LiveArm", "Solutions"),
    "kinsym.methods": ("METHODS",),
    "kinsym.robot.binding": ("bind",),
    "kinsym.robot.catalogue": ("gallery",),
    "kinsym.robot.files": ("from_inline",),
    "kinsym.robot.loading": ("load",),
    "kinsym.robot.locking": ("lock",),
    "kinsym.robot.model": ("Convention", "Robot", "Task"),
}
_PLACES = {name: module for module, names in _MODULES.items() for name in names}

if not TYPE_CHECKING:  # so that a type checker knows the names above and refuses others

    def __getattr__(name: str) -> object:
        """What :data:`__all__` offers, loaded when it is first asked for."""
        from importlib import import_module

        if name not in _PLACES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        place = _PLACES[name]
        found = import_module(f"{__name__}.{name}") if place == __name__ else getattr(import_module(place), name)
        globals()[name] = found
        return found

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
