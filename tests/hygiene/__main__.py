"""The C of the whole gallery: ``python -m tests.hygiene [NAME ...] [--valgrind] [--real float]``.

For each robot: every compiler at hand with all warnings, symbols that can be written, hostile numbers under the
sanitizers, and under valgrind if asked, poses with floating-point traps on, many threads under the thread sanitizer.
Ends with status 1 if one fails.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from kinsym.command.rendering import REALS, of_real
from kinsym.emit.schedule import Schedule
from kinsym.errors import KinsymError
from kinsym.robot import gallery
from tests.hygiene.arms import KINDS, MORE, schedule
from tests.hygiene.building import GLIBC, Failed, hostile, quiet, threads, traps, writable, write


def examine(arm: Schedule, *, valgrind: bool) -> str:
    """What is to be said of a robot whose C behaves; raises :class:`Failed` where it does not."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write(arm, folder)
        compiled = quiet(arm, folder)
        if shared := writable(arm, folder):
            raise Failed(f"symbols that can be written: {', '.join(shared)}")
        said = [f"{compiled} compilations without a warning", hostile(arm, folder).strip()]
        if GLIBC:
            said.append(traps(arm, folder).strip())
        if valgrind:
            said.append(f"under valgrind {hostile(arm, folder, valgrind=True).strip()}")
        return "; ".join([*said, threads(arm, folder, "-fsanitize=thread", rounds=3).strip()])


def main() -> int:
    """Every robot that is named, by default the gallery and the arms of the tests."""
    parser = argparse.ArgumentParser(prog="python -m tests.hygiene", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--valgrind", action="store_true", help="hostile numbers under valgrind as well")
    parser.add_argument("--real", choices=REALS, default=REALS[0], help="the type of the numbers in the C")
    options = parser.parse_args()
    failed = 0
    for name in options.names or [*gallery(), *(name for name in (*KINDS, *MORE) if name not in gallery())]:
        try:
            said = examine(of_real(options.real, schedule(name)), valgrind=options.valgrind)
        except (Failed, KinsymError) as error:
            failed += 1
            said = f"FAILED: {error}"
        print(f"{name:20} {said}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
