"""The generated NumPy module, run in memory instead of from a file."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.emit.schedule import Schedule


def live_module(schedule: Schedule) -> ModuleType:
    """The module of a schedule, ready to be called.

    Nothing of the user's words is in it but names that :mod:`kinsym.robot.names` has let through.
    """
    from kinsym.emit.source.numpy_source import numpy_source

    (text,) = numpy_source(replace(schedule, name="live", title="", table=())).values()
    module = ModuleType("live")
    exec(compile(text, "live", "exec"), module.__dict__)
    return module
