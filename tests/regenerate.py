"""Write ``generated/`` anew: ``python -m tests.regenerate [NAME ...]``.

One folder for each robot of the gallery, exactly what ``kinsym derive NAME`` writes. A test derives all of it again
and compares byte by byte.
"""

from __future__ import annotations

import sys
from pathlib import Path

from kinsym.check.compare import Findings, compare
from kinsym.check.report import SUFFIX, steady
from kinsym.check.reporting import report_of
from kinsym.command.rendering import rendered
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.robot import gallery, load
from kinsym.write import write_set

GENERATED = Path(__file__).resolve().parent.parent / "generated"


def files_of(name: str) -> tuple[dict[str, str], Findings]:
    """The files of one robot of the gallery by name, the report among them, and what its checks found."""
    derivation = derive(load(name))
    schedule = build_schedule(derivation)
    sources = rendered(derivation, schedule)
    findings = compare(derivation.robot, schedule, sources)
    report = report_of(derivation.robot, schedule, sources, findings)
    return {**sources, name + SUFFIX: report.text()}, findings


def comparable(name: str, text: str) -> str:
    """A file without what depends on the machine."""
    return steady(text) if name.endswith(SUFFIX) else text


def update(name: str) -> bool:
    """Write the folder of one robot where it is not up to date; whether anything was written."""
    folder = GENERATED / name
    files, _ = files_of(name)
    for stale in {path.name for path in folder.glob("*") if path.is_file()} - set(files):
        (folder / stale).unlink()
    there = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*") if path.is_file()}
    if {key: comparable(key, text) for key, text in there.items()} == {
        key: comparable(key, text) for key, text in files.items()
    }:
        return False
    write_set(folder, files)
    return True


def main() -> None:
    """Update the robots named, or all."""
    for name in sys.argv[1:] or gallery():
        print(f"{name}: {'written' if update(name) else 'up to date'}", flush=True)


if __name__ == "__main__":
    main()
