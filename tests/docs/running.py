"""The code of one page, run from top to bottom in one folder, as a reader does who follows it.

* A block with a name is a file, which is written.
* ``console``: every line behind a ``$`` is a command. What stands below it is all that it prints, where a line ``...``
  stands for any lines and ``...`` within a line for any text. Commands of kinsym run in this process; one that shows
  nothing is spared the checks of its files, which other tests make.
* ``python``: one session a page. A comment behind ``print(...)`` is what is printed, one that begins with a shape,
  ``(4, 4)`` or ``(m, 6)``, tells the shape of what is assigned in its line; letters stand for any number.
* ``text`` is no code. Every other language needs a name or the mark of :mod:`tests.docs.reading`.
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np

from kinsym.cli import main
from tests.docs.reading import ROOT, Block

_COMMAND = re.compile(r"^\$ (?P<command>(?:.*\\\n)*.*)\n(?P<shown>(?:(?!\$ ).*\n)*)", re.MULTILINE)
_COMMENT = re.compile(r"^(?P<code>.*\S)  # (?P<comment>.*)$")
_SHAPES = re.compile(r"\([\w ,]*\)(?:, \([\w ,]*\))*")


class _Stream(io.TextIOWrapper):
    """A stream of UTF-8 that keeps what is written; StringIO has no encoding, so that signs would be spelt out."""

    def __init__(self) -> None:
        super().__init__(io.BytesIO(), encoding="utf-8", newline="")

    def text(self) -> str:
        self.seek(0)
        return self.read()


class Session:
    """What a reader of a page has in a folder: files, and a Python that was started there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.names: dict[str, object] = {"__name__": "__main__"}

    def run(self, block: Block) -> None:
        """Run a block; AssertionError for what does not hold."""
        if block.reason or block.language == "text":
            return
        if block.name:
            path = self.folder / block.name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, encoding="utf-8")
        elif block.language == "console":
            self.console(block.text)
        elif block.language == "python":
            self.python(block.text)
        else:
            raise AssertionError(f"line {block.line}: {block.language} without the name of a file, and not marked")

    def console(self, text: str) -> None:
        """Run the commands of a block and compare what they print."""
        found = list(_COMMAND.finditer(text))
        assert sum(len(match[0]) for match in found) == len(text), f"commands begin with '$ ': {text}"
        for match in found:
            status, out, err = self.command(match["command"], bool(match["shown"]))
            refused = any(line.startswith("kinsym: ") for line in match["shown"].splitlines())
            assert (status != 0) == refused, f"{match['command']}: status {status}\n{out}{err}"
            printed = [text for text in (out, err, out + err) if matches(match["shown"], text)]
            assert printed or not match["shown"], f"{match['command']} prints\n{out}{err}\nand not\n{match['shown']}"

    def command(self, line: str, shown: bool) -> tuple[int, str, str]:
        """Status and both outputs of a command."""
        reader = shlex.shlex(line.replace("\\\n", " "), posix=True, punctuation_chars="|&<>")
        words = list(reader)
        if words[0] != "kinsym" or any(set(word) <= set("|&<>") for word in words if word):
            return self.shell(line)
        checks = ["--no-check"] if words[1] == "derive" and not shown else []
        with contextlib.redirect_stdout(_Stream()) as out, contextlib.redirect_stderr(_Stream()) as err:
            status = main([*words[1:], *checks])
        return status, out.text(), err.text()

    def shell(self, line: str) -> tuple[int, str, str]:
        """The same by a shell that finds this Python and this kinsym."""
        tools = self.folder / ".tools"
        tools.mkdir(exist_ok=True)
        for name, call in (("python", ""), ("kinsym", "-m kinsym ")):
            (tools / name).write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} {call}"$@"\n')
            (tools / name).chmod(0o755)
        environment = {**os.environ, "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": str(ROOT)}
        done = subprocess.run(
            ["bash", "-c", line], cwd=self.folder, capture_output=True, text=True, check=False, env=environment
        )
        return done.returncode, done.stdout, done.stderr

    def python(self, text: str) -> None:
        """Run the statements of a block one by one and hold each against its comment."""
        lines = text.splitlines()
        for statement in ast.parse(text).body:
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                exec(compile(ast.Module([statement], []), "page", "exec"), self.names)
            match = _COMMENT.match(lines[(statement.end_lineno or 0) - 1])
            if match and match["code"].startswith("print("):
                assert matches(match["comment"] + "\n", printed.getvalue()), f"{match[0]}\nprints {printed.getvalue()}"
            elif match and isinstance(statement, ast.Assign) and (shapes := _SHAPES.match(match["comment"])):
                self.shapes(statement, shapes[0])

    def shapes(self, statement: ast.Assign, comment: str) -> None:
        """Hold the shapes of what was assigned against those that are told."""
        (target,) = statement.targets
        names = target.elts if isinstance(target, ast.Tuple) else [target]
        wanted = re.findall(r"\((.*?)\)", comment)
        assert len(names) == len(wanted), ast.unparse(statement)
        for name, shape in zip(names, wanted, strict=True):
            value = eval(ast.unparse(name), self.names)
            sizes = [size.strip() for size in shape.split(",") if size.strip()]
            fits = len(sizes) == np.ndim(value) and all(
                not told.isdigit() or int(told) == size for told, size in zip(sizes, np.shape(value), strict=True)
            )
            assert fits, f"{ast.unparse(name)} is {np.shape(value)}, not ({shape})"


def matches(shown: str, printed: str) -> bool:
    """Whether text is what a page shows, of which ``...`` stands for what was left out.

    >>> matches("a\\n...\\nd ... f\\n", "a\\nb\\nc\\nd e f\\n")
    True
    >>> matches("a\\n", "a\\nb\\n")
    False
    """
    lines = [r"(?:.*\n)*?" if line == "..." else _pattern(line) for line in shown.splitlines()]
    return re.fullmatch("".join(lines), "".join(line.rstrip() + "\n" for line in printed.splitlines())) is not None


def _pattern(line: str) -> str:
    return ".*".join(re.escape(part) for part in line.rstrip().split("...")) + r"\n"
