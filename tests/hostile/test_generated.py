"""What a user may write freely, title and source, changes words of the generated text and nothing of what it does.

Every file is reduced to what a machine reads in it: syntax tree without strings, C without comments, commands of
LaTeX, keys of TOML and JSON. That must be the same for a hostile title as for a plain one.
"""

from __future__ import annotations

import ast
import json
import re
import subprocess
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from kinsym.check.compiler import find_compiler
from kinsym.check.reporting import report_of
from kinsym.command.importing import robot_file
from kinsym.command.rendering import FILES, rendered
from kinsym.derivation import Derivation
from kinsym.deriving import derive
from kinsym.emit.program import build_schedule
from kinsym.emit.text import equations
from kinsym.errors import RobotError
from kinsym.robot import load
from kinsym.robot.binding import bind
from kinsym.robot.files import KEYS
from tests.hostile.attacks import ATTACKS, PLACES

PLAIN = "A title"


def accepted() -> Iterator[tuple[str, str]]:
    """The attacks that are allowed as a title, being one line of printable characters."""
    for name, text in ATTACKS.items():
        if text.strip() and text.isprintable() and len(text) <= 500:
            yield name, text


TITLES = dict(accepted())


@pytest.fixture(scope="module")
def arm() -> Derivation:
    """A small arm with numbers, so that every target takes it; nothing of the derivation reads title and source."""
    return derive(bind(load("planar_rr"), {"l1": Fraction(2, 5), "l2": Fraction(3, 10)}))


def files(arm: Derivation, title: str) -> dict[str, str]:
    """All files of all targets, and what the terminal shows."""
    derivation = replace(arm, robot=replace(arm.robot, title=title, source=title))
    schedule = build_schedule(derivation)
    texts = rendered(derivation, schedule, tuple(FILES))
    report = report_of(derivation.robot, schedule, texts, None).text()
    terminal = equations(derivation, width=96, ascii=False)
    return {**texts, "report.json": report, "robot.toml": robot_file(derivation.robot), "terminal": terminal}


def skeleton(name: str, text: str) -> Any:
    """What a machine reads in a file."""
    match Path(name).suffix:
        case ".py" | ".pyi":
            return python(text)
        case ".c" | ".h" | ".hpp" | ".cpp":
            return without_comments(text)
        case ".tex":
            return re.findall(r"\\[A-Za-z]+|(?<!\\)[{}$&#^_~%]", "\n".join(known(text)))
        case ".toml":
            return shape(tomllib.loads(text))
        case ".json":
            return shape({key: value for key, value in json.loads(text).items() if key != "files"})
        case ".md":
            heading, *rest = text.splitlines()
            return bool(re.search(r"(?<!\\)(\\\\)*[\[\]<>`*_&]", heading)), re.sub(r"digest \w+", "", "\n".join(rest))
    return len(text.splitlines())


def python(text: str) -> str:
    """The syntax tree without the contents of its strings."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
    return ast.dump(tree)


def without_comments(text: str) -> str:
    """What the compiler itself leaves of C where it knows trigraphs; the text of strings, too, is taken away."""
    compiler = find_compiler()
    assert compiler is not None
    command = [compiler, "-std=c99", "-fpreprocessed", "-dD", "-E", "-P", "-x", "c", "-"]
    left = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout
    return re.sub(r'"(\\.|[^"\\])*"', '""', left)


def known(text: str) -> list[str]:
    """The lines of a document without those that a title stands in."""
    return [line for line in text.splitlines() if not re.match(r"\{\\LARGE .*\\par\}$|^%", line)]


def shape(value: Any) -> Any:
    """Keys and types."""
    if isinstance(value, dict):
        return {key: shape(entry) for key, entry in value.items()}
    return [shape(entry) for entry in value] if isinstance(value, list) else type(value).__name__


@pytest.mark.parametrize("attack", TITLES)
def test_a_title_changes_words_only(attack: str, arm: Derivation) -> None:
    """Nothing that a machine reads differs, in any file of any target."""
    title = TITLES[attack]
    plain, hostile = plain_files(arm), files(arm, title)
    assert set(hostile) == set(plain)
    changed = [name for name in plain if plain[name] != hostile[name]]
    assert len(changed) >= 8
    for name in changed:
        assert skeleton(name, hostile[name]) == skeleton(name, plain[name]), name
        assert all(line.isprintable() for line in hostile[name].split("\n")), name
    check_title_line(hostile["planar_rr.tex"])
    assert tomllib.loads(hostile["robot.toml"])["title"] == title
    assert json.loads(hostile["report.json"])["title"] == title


_PLAIN: dict[str, str] = {}


def plain_files(arm: Derivation) -> dict[str, str]:
    """The files of the plain title, made once."""
    if not _PLAIN:
        _PLAIN.update(files(arm, PLAIN))
    return _PLAIN


def check_title_line(document: str) -> None:
    """The line with the title holds escapes of characters and no command that takes one's text, no open group."""
    (line,) = (line for line in document.splitlines() if line.startswith("{\\LARGE ") and line.endswith("\\par}"))
    inside = line.removeprefix("{\\LARGE ").removesuffix("\\par}")
    assert inside.isascii()
    commands = set(re.findall(r"\\([A-Za-z]+)", inside))
    assert not commands & {"input", "include", "end", "begin", "write", "catcode", "def", "csname", "immediate", "VAR"}
    bare = re.sub(r"\\[\\{}$&#^_~%\"'`=.]|\\[A-Za-z]+", "", inside)
    assert not re.search(r"[$&#^_~%\\]", bare)
    depth = 0
    for letter in bare:
        depth += (letter == "{") - (letter == "}")
        assert depth >= 0
    assert depth == 0


@pytest.mark.parametrize("place", ["URDF robot", "URDF link and joint"])
def test_names_of_a_urdf_file_stay_in_their_strings(place: str, tmp_path: Path) -> None:
    """A robot file made of it reads back as the same robot, whatever its links and joints are called."""
    read = 0
    for attack in ("end of a string", "preprocessor", "TOML", "bidi", "zero width", "carriage return", "emoji"):
        try:
            robot = PLACES[place](tmp_path, ATTACKS[attack])
        except RobotError:
            continue
        assert robot is not None
        text = robot_file(robot)
        draft = tomllib.loads(text)
        assert set(draft) <= set(KEYS), attack
        assert (draft["name"], draft.get("title", robot.name)) == (robot.name, robot.title), attack
        assert all(line.isprintable() for line in text.split("\n")), attack
        read += 1
    assert read >= 4
