"""``python -m tests.watched ARGUMENTS``: one kinsym command under an audit hook that forbids the network.

CPython tells the hook what is opened, started, connected and unpickled. The last line printed is a JSON object: the
exit status, the programs started, the files written, the folders made with their modes, and what was tried though it
is forbidden.
"""

from __future__ import annotations

import json
import os
import sys
from typing import Any

FORBIDDEN = (
    "socket.",
    "os.system",
    "os.exec",
    "os.posix_spawn",
    "os.spawn",
    "pty.",
    "pickle.",
    "marshal.load",
    "urllib.",
)
#: The caches of compiled modules and templates are read with marshal; ``tests/test_supply.py`` knows where.
CACHES = ("marshal.loads",)


class Watch:
    """What happened."""

    def __init__(self) -> None:
        self.programs: list[list[str]] = []
        self.written: list[str] = []
        self.made: list[tuple[str, int]] = []
        self.forbidden: list[str] = []

    def __call__(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Called by the interpreter."""
        match event:
            case "subprocess.Popen":
                executable, command, *_ = arguments
                self.programs.append([os.fsdecode(executable), *map(os.fsdecode, command)])
            case "open":
                path, _, flags = arguments
                if isinstance(path, str | bytes | os.PathLike) and flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT):
                    self.written.append(os.path.abspath(os.fsdecode(path)))
            case "os.mkdir":
                self.made.append((os.path.abspath(os.fsdecode(arguments[0])), arguments[1]))
            case _ if event.startswith(FORBIDDEN) and event not in CACHES:
                self.forbidden.append(event)
                if event.startswith("socket."):
                    raise PermissionError("no network here")


def main() -> None:
    """Run the command and say what was seen."""
    watch = Watch()
    sys.addaudithook(watch)
    from kinsym.cli import main as kinsym

    status = kinsym(sys.argv[1:])
    print()
    print(json.dumps({"status": status, **vars(watch)}))


if __name__ == "__main__":
    main()
