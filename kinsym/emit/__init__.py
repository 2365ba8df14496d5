"""A schedule as source files, one small module a language.

A target is a function from the schedule to texts by file name. To add a language: a printer and a target function
in a module of this package, a folder of templates, and one entry here.
"""

from __future__ import annotations

from collections.abc import Callable

from kinsym.emit.schedule import Schedule
from kinsym.emit.source.c_source import c_source
from kinsym.emit.source.cpp import cpp_source
from kinsym.emit.source.extension import extension_source
from kinsym.emit.source.ikfast import ikfast_source
from kinsym.emit.source.numpy_source import numpy_source

Target = Callable[[Schedule], dict[str, str]]

TARGETS: dict[str, Target] = {
    "numpy": numpy_source,
    "c": c_source,
    "extension": extension_source,
    "cpp": cpp_source,
    "ikfast": ikfast_source,
}

__all__ = ["TARGETS", "Target"]
