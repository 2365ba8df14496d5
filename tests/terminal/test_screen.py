"""Progress, colour and widths, on streams that say they are terminals and on streams that do not."""

from __future__ import annotations

import io
import json
import re
import time

import pytest

from kinsym.command.colour import painted, wanted
from kinsym.command.progress import Progress
from kinsym.command.screen import Screen


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        """It is none, but nobody can tell."""
        return True


@pytest.fixture(autouse=True)
def environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """A usual terminal of 80 columns."""
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    for name in ("NO_COLOR", "FORCE_COLOR"):
        monkeypatch.delenv(name, raising=False)


def seen(raw: str) -> list[str]:
    """What a terminal shows of a text: the lines, each as it was after the last carriage return and erasure."""
    return [line.rpartition("\r\x1b[K")[2] for line in raw.split("\n")]


def timeless(lines: list[str]) -> list[str]:
    """Lines with every number of seconds as 0.0, so that a machine may take its time."""
    return [re.sub(r"\d+\.\d s", "0.0 s", line) for line in lines]


def test_one_line_is_rewritten_and_gone_at_the_end() -> None:
    """A stage replaces the one before it; output stands where the line was; the end leaves the time alone."""
    stream = Terminal()
    screen = Screen(out=stream, err=stream)
    screen.stage("reading")
    screen.stage("deriving")
    assert timeless(seen(stream.getvalue())) == ["[  0.0 s] deriving ..."]
    screen.say("theta1")
    assert seen(stream.getvalue()) == ["theta1", ""]
    screen.stage("checking")
    screen.end()
    screen.end()
    assert timeless(seen(stream.getvalue())) == ["theta1", "took 0.0 s", ""]


def test_the_line_moves_by_itself() -> None:
    """A thread draws it again, so that a long stage is seen to go on."""
    stream = Terminal()
    progress = Progress(stream, time.monotonic())
    progress.stage("deriving")
    deadline = time.monotonic() + 10
    while len(set(re.findall(r"\[ +[\d.]+ s\] deriving", stream.getvalue()))) < 3 and time.monotonic() < deadline:
        time.sleep(0.02)
    assert progress.end()
    assert time.monotonic() < deadline
    length = len(stream.getvalue())
    time.sleep(0.25)
    assert len(stream.getvalue()) == length
    assert seen(stream.getvalue()) == [""]


def test_who_is_interrupted_while_writing_can_still_end() -> None:
    """The thread never waits for the lock, so that it can be joined with the lock held."""
    stream = Terminal()
    progress = Progress(stream, time.monotonic())
    progress.stage("deriving")
    progress.__enter__()
    assert progress.end()
    assert seen(stream.getvalue()) == [""]


def test_a_long_stage_does_not_wrap(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line that wrapped could not be erased."""
    monkeypatch.setenv("COLUMNS", "30")
    stream = Terminal()
    screen = Screen(out=stream, err=stream)
    screen.stage("x" * 100)
    assert len(seen(stream.getvalue())[-1]) == 29
    screen.end()


def test_a_log_has_plain_lines_without_times() -> None:
    """No escape sequence, no clock: two logs of equal runs are equal."""
    out, err = io.StringIO(), io.StringIO()
    screen = Screen(out=out, err=err)
    screen.stage("deriving")
    screen.heading("Checks")
    screen.item("ok", "no solution twice")
    screen.warn("x")
    screen.end()
    assert err.getvalue() == "deriving ...\nkinsym: x\n"
    assert out.getvalue() == "Checks\n------\n  ok      no solution twice\n"


class Closed(io.StringIO):
    """A pipe whose reader has gone: ``head -1`` after its line."""

    def write(self, text: str) -> int:
        """What the system says."""
        raise BrokenPipeError

    def flush(self) -> None:
        """The same of what was buffered."""
        raise BrokenPipeError


def test_a_reader_that_has_gone_ends_nothing() -> None:
    """What is said to it is lost, what stands on standard error is not."""
    err = io.StringIO()
    screen = Screen(out=Closed(), err=err)
    for _ in range(2):
        screen.say("theta1")
    screen.flush()
    screen.warn("x")
    screen.end()
    assert err.getvalue() == "kinsym: x\n"


@pytest.mark.parametrize(
    ("encoding", "plain"), [("utf-8", False), ("ascii", True), ("cp437", False), ("klingon", True)]
)
def test_signs_that_an_output_cannot_show_are_spelt_out(encoding: str, plain: bool) -> None:
    """An encoding that nobody knows is taken for the least of all."""
    out = type("Encoded", (io.StringIO,), {"encoding": encoding})()
    assert Screen(out=out, err=io.StringIO()).ascii is plain


@pytest.mark.parametrize(
    ("given", "terminal", "colour"),
    [
        ({}, True, True),
        ({}, False, False),
        ({"NO_COLOR": "1"}, True, False),
        ({"NO_COLOR": ""}, True, True),
        ({"FORCE_COLOR": "1"}, False, True),
        ({"FORCE_COLOR": ""}, False, False),
        ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, True, False),
        ({"TERM": "dumb"}, True, False),
        ({"TERM": "dumb", "FORCE_COLOR": "1"}, False, True),
    ],
)
def test_where_there_is_colour(given: dict[str, str], terminal: bool, colour: bool) -> None:
    """On a terminal, unless somebody says otherwise."""
    assert wanted(Terminal() if terminal else io.StringIO(), given) is colour


def test_what_is_painted() -> None:
    """Headings, steps and verdicts; a rule of another length is no heading, a word elsewhere no verdict."""
    text = "Checks\n------\n  1. theta1: linear\n  ok      fine\n  FAILED  bad\n\na\n----\n  all ok  here\n"
    assert painted(text) == (
        "\x1b[1mChecks\x1b[0m\n\x1b[2m------\x1b[0m\n  \x1b[1m1. theta1:\x1b[0m linear\n"
        "  \x1b[32mok\x1b[0m      fine\n  \x1b[1;31mFAILED\x1b[0m  bad\n\na\n----\n  all ok  here\n"
    )


def test_plain_text_is_never_painted(monkeypatch: pytest.MonkeyPatch) -> None:
    """A script or a page is read by another program."""
    monkeypatch.setenv("FORCE_COLOR", "1")
    out = io.StringIO()
    screen = Screen(out=out, err=io.StringIO())
    screen.say("Title\n=====", plain=True)
    assert out.getvalue() == "Title\n=====\n"


def test_long_lines_fit() -> None:
    """Items everywhere; messages on a terminal, where a log keeps them in one line to be searched."""
    out, err, log = Terminal(), Terminal(), io.StringIO()
    screen = Screen(out=out, err=err)
    screen.item("ok", "word " * 40)
    screen.warn("word " * 40)
    Screen(out=out, err=log).warn("word " * 40)
    assert max(map(len, (out.getvalue() + err.getvalue()).replace("\x1b", "").splitlines())) <= 80 + len("[32m[0m")
    assert log.getvalue().count("\n") == 1


def test_json_is_all_that_is_said() -> None:
    """One object, also with --quiet; what cannot be encoded is escaped."""
    out = io.StringIO()
    screen = Screen(out=out, err=io.StringIO(), quiet=True, as_json=True)
    screen.say("not this")
    screen.give({"title": "Gödel"})
    assert json.loads(out.getvalue()) == {"title": "Gödel"}
    assert out.getvalue().isascii()
