"""A schedule as one header of C++: the C of the target ``c`` in a namespace, and functions of arrays around it."""

from __future__ import annotations

from kinsym.emit.environment import render
from kinsym.emit.schedule import Schedule
from kinsym.emit.source.banner import banner, c_comment
from kinsym.emit.source.c_source import c_names
from kinsym.emit.source.core import embedded, macros


def cpp_source(schedule: Schedule) -> dict[str, str]:
    """The file NAME.hpp."""
    names = c_names(schedule, embedded(whole=True))
    text = render("c/header.h.jinja", **names) + "\n" + render("c/source.c.jinja", **names)
    complete = names["complete"]
    header = render(
        "cpp/solver.hpp.jinja",
        **{
            **names,
            "banner": [c_comment(line) for line in banner(schedule, shared=True)],
            "core_text": text,
            "macros": macros(text, schedule.name),
            "asked": [*(item.name for item in schedule.parameters if item.value is None), *schedule.inputs],
            "example": [f"{0.1 * (number + 1):.1f}" for number in range(len(schedule.joints))],
            "default": " = parameters()" if complete else "",
            "default_input": " = parameters()" if complete and not schedule.inputs else "",
        },
    )
    return {f"{schedule.name}.hpp": header}


def shim(schedule: Schedule) -> str:
    """C++ that gives the functions of NAME.hpp the names and arguments of the C, for the checks."""
    return render("cpp/shim.cpp.jinja", name=schedule.name, inputs=schedule.inputs, branches=schedule.branches)
