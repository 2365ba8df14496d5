"""``kinsym check``: the checks once more, on files that are already there."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kinsym.command.options import add_quiet
from kinsym.errors import KinsymError, OutputError
from kinsym.ownership import LARGEST_FILE

if TYPE_CHECKING:
    from kinsym.command.screen import Screen
    from kinsym.robot.model import Robot


HELP = "repeat the checks on files already there"


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = "Repeat the checks on the files in DIR. This runs the Python and C code found there."
    command.add_argument("folder", metavar="DIR", help="a folder that kinsym derive has written")
    add_quiet(command)


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Check every robot whose report lies in the folder, and write its report anew."""
    from kinsym.check.report import SUFFIX
    from kinsym.robot.names import shown
    from kinsym.write import put_back

    folder = Path(options.folder)
    if not os.path.isdir(folder):  # False as well for what is no path at all
        raise OutputError(f"{shown(options.folder)[1:-1]} is no folder. Give one that kinsym derive has written.")
    if put_back(folder):
        screen.warn(f"a run that was interrupted in {folder} is undone: the files are those from before it.")
    reports = sorted(path for path in folder.glob("*" + SUFFIX) if path.is_file())
    if not reports:
        raise OutputError(f"{folder} holds no *{SUFFIX}. Give a folder that kinsym derive has written.")
    return max(_check_one(path, screen) for path in reports)


def _check_one(path: Path, screen: Screen) -> int:
    from kinsym.check.compare import compare
    from kinsym.check.report import FAILED
    from kinsym.check.reporting import report_of
    from kinsym.command.outcome import say_checks, verdict
    from kinsym.command.rendering import FILES, of_real, rendered
    from kinsym.deriving import derive
    from kinsym.emit.program import build_schedule
    from kinsym.write import write_set

    screen.stage(f"reading {path.name}")
    robot, recorded, real = _read(path)
    screen.stage(f"deriving {robot.name}")
    derivation = derive(robot)
    schedule = of_real(real, build_schedule(derivation))
    written = [target for target, paths in FILES.items() if any(path.format(robot.name) in recorded for path in paths)]
    today = rendered(derivation, schedule, written)
    sources: dict[str, str] = {}
    missing, foreign, edited = [], [], []
    for name, text in today.items():
        if name not in recorded:
            continue
        try:
            there = _text(path.parent / name)
        except FileNotFoundError:
            missing.append(name)
            continue
        except (OSError, UnicodeDecodeError) as error:
            raise OutputError(f"{path.parent / name} cannot be read: {error}. Derive the robot again.") from error
        sources[name] = there
        if there != text:
            foreign.append(name)
    findings = compare(derivation.robot, schedule, sources, screen.stage)
    report = report_of(derivation.robot, schedule, sources, findings)
    edited = [name for name, digest in report.files.items() if digest != recorded[name]]
    screen.say(f"{report.title}\n")
    say_checks(report, screen)
    for name in missing:
        screen.warn(f"{path.parent / name} is missing. Derive the robot again.")
    for name in foreign:
        since = "it was changed after kinsym wrote it" if name in edited else "another version of kinsym wrote it"
        screen.warn(f"{path.parent / name} is not what kinsym would write today: {since}.")
    try:
        write_set(path.parent, {path.name: report.text()})
    except OutputError as error:
        screen.warn(f"the report was not renewed: {error}")
    status = verdict(report, path.parent, screen)
    return 1 if missing or report.verdict == FAILED else status


def _read(path: Path) -> tuple[Robot, dict[str, str], str]:
    """The robot of a report, the digests of the files it speaks of, and the type of the numbers in the C."""
    import json
    from dataclasses import replace

    from kinsym.check.deviation import recalled
    from kinsym.command.rendering import REALS
    from kinsym.robot.files import from_draft, toml_draft
    from kinsym.robot.names import shown
    from kinsym.robot.snapping import EXACT

    remedy = "Derive the robot again."
    try:
        content: Any = json.loads(_text(path))
        table, files = "\n".join(content["table"]), content["files"]
        recorded = {str(name): str(digest) for name, digest in files.items()}
        deviation = recalled(content.get("deviation"))
        real = content.get("real", REALS[0])
        if real not in REALS:
            raise ValueError(f"there is no type {shown(str(real))} of numbers")
    except OSError as error:
        raise OutputError(f"{path} cannot be read: {error.strerror}. {remedy}") from error
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise OutputError(f"{path} is no report of kinsym: {error}. {remedy}") from error
    try:
        where = f"{path}, table"
        robot = from_draft(toml_draft(table, where), where=where, snapping=EXACT)
        return replace(robot, deviation=deviation), recorded, real
    except KinsymError as error:
        raise OutputError(f"{path} holds no usable table: {error} {remedy}") from error


def _text(path: Path) -> str:
    """The text of a plain file no larger than one of ours can be; a pipe would wait for ever."""
    if path.exists() and not path.is_file():
        raise OutputError(f"{path} is no plain file. Remove it and derive the robot again.")
    with path.open("rb") as file:
        data = file.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise OutputError(f"{path} is larger than {LARGEST_FILE >> 20} MiB. Derive the robot again.")
    return data.decode("utf-8")
