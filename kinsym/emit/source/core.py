"""How the C of a robot is laid into a file: as NAME.h and NAME.c, or as a part of one file of C++.

The text is the same. In C++ it stands in a namespace of its own, every function is ``inline``, so that any number of
files may hold it, and nothing is exported. The macros that it leaves behind are taken back by :func:`macros`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Core:
    """What differs.

    embedded          whether it is a part of another file: no includes, no guard, nothing exported.
    whole             whether the calls for controllers and those for many poses are in it.
    public, local, inlined
                      what stands before a function that is declared, one that is not, and one that is for inlining.
    data              what stands before a table that is declared.
    """

    embedded: bool
    whole: bool
    public: str
    local: str
    inlined: str
    data: str


FILES = Core(
    embedded=False,
    whole=True,
    public="KINSYM_FN",
    local="KINSYM_FN static",
    inlined="KINSYM_FN static inline",
    data="KINSYM_DATA",
)


def embedded(*, whole: bool) -> Core:
    """The core inside a file of C++."""
    word = "KINSYM_FN inline"
    return Core(embedded=True, whole=whole, public=word, local=word, inlined=word, data="static KINSYM_DATA")


def macros(text: str, name: str) -> list[str]:
    r"""The macros that a source defines, in order, but for those with the robot's name, which nothing else can mean.

    >>> macros("#define UR5_JOINTS 6\n#define TURN 6.28\n#define restrict __restrict\n", "ur5")
    ['TURN', 'restrict']
    """
    found = dict.fromkeys(re.findall(r"^#define (\w+)", text, re.MULTILINE))
    return [macro for macro in found if not macro.startswith(f"{name.upper()}_")]
