"""What the user writes: robots, the files they are read from, and the gallery.

The gallery's names and titles are at hand without SymPy; reading a table loads it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from kinsym.robot.catalogue import gallery, gallery_heads, gallery_index, gallery_path, gallery_titles
from kinsym.robot.model import Convention, Home, Joint, Robot, Task

if TYPE_CHECKING:
    from kinsym.robot.binding import bind
    from kinsym.robot.expressions import number, parse, symbol
    from kinsym.robot.files import from_inline
    from kinsym.robot.loading import load
    from kinsym.robot.locking import lock
    from kinsym.robot.nearby import nominal
    from kinsym.robot.summary import digest, table_lines, to_toml

__all__ = [
    "Convention",
    "Home",
    "Joint",
    "Robot",
    "Task",
    "bind",
    "digest",
    "from_inline",
    "gallery",
    "gallery_heads",
    "gallery_index",
    "gallery_path",
    "gallery_titles",
    "load",
    "lock",
    "nominal",
    "number",
    "parse",
    "symbol",
    "table_lines",
    "to_toml",
]

_LAZY = {
    "bind": "kinsym.robot.binding",
    "digest": "kinsym.robot.summary",
    "from_inline": "kinsym.robot.files",
    "load": "kinsym.robot.loading",
    "lock": "kinsym.robot.locking",
    "nominal": "kinsym.robot.nearby",
    "number": "kinsym.robot.expressions",
    "parse": "kinsym.robot.expressions",
    "symbol": "kinsym.robot.expressions",
    "table_lines": "kinsym.robot.summary",
    "to_toml": "kinsym.robot.summary",
}


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_LAZY[name]), name)
