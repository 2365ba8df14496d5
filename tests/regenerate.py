"""Write ``generated/`` anew: ``python -m tests.regenerate [NAME ...]``, and the gallery's index with it.

One folder for each robot of the gallery, exactly what ``kinsym derive NAME`` writes. A test derives all of it again
and compares byte by byte. ``python -m tests.regenerate --index`` writes the index alone, in a minute.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from kinsym.check.compare import Findings, compare
from kinsym.check.report import SUFFIX, steady
from kinsym.check.reporting import report_of
from kinsym.command.rendering import rendered
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.facts import facts
from kinsym.robot import gallery, gallery_index, load
from kinsym.robot.catalogue import index_path
from kinsym.write import write_set

GENERATED = Path(__file__).resolve().parent.parent / "generated"


def files_of(name: str) -> tuple[dict[str, str], Findings, dict[str, Any]]:
    """The files of one robot of the gallery, the report among them, what its checks found, its entry in the index."""
    derivation = derive(load(name))
    schedule = build_schedule(derivation)
    sources = rendered(derivation, schedule)
    findings = compare(derivation.robot, schedule, sources)
    report = report_of(derivation.robot, schedule, sources, findings)
    return {**sources, name + SUFFIX: report.text()}, findings, facts(derivation)


def comparable(name: str, text: str) -> str:
    """A file without what depends on the machine."""
    return steady(text) if name.endswith(SUFFIX) else text


def update(name: str) -> bool:
    """Write the folder of one robot where it is not up to date; whether anything was written."""
    folder = GENERATED / name
    files, _, entry = files_of(name)
    write_index({name: entry})
    for stale in {path.name for path in folder.glob("*") if path.is_file()} - set(files):
        (folder / stale).unlink()
    there = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*") if path.is_file()}
    if {key: comparable(key, text) for key, text in there.items()} == {
        key: comparable(key, text) for key, text in files.items()
    }:
        return False
    write_set(folder, files)
    return True


def write_index(entries: dict[str, dict[str, Any]]) -> None:
    """Put entries into the gallery's index, one line each, and take out those without a robot."""
    there = gallery_index() if index_path().exists() else {}
    merged = {name: entries.get(name) or there[name] for name in gallery() if name in entries or name in there}
    lines = (f"  {json.dumps(name)}: {json.dumps(entry)}" for name, entry in merged.items())
    index_path().write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def main() -> None:
    """Update the robots named, or all."""
    if sys.argv[1:] == ["--index"]:
        write_index({name: facts(derive(load(name))) for name in gallery()})
        return
    for name in sys.argv[1:] or gallery():
        print(f"{name}: {'written' if update(name) else 'up to date'}", flush=True)


if __name__ == "__main__":
    main()
