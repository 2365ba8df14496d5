"""The parser of the command line: what it refuses is an error of kinsym, with the name that is nearest."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping, Sequence
from types import ModuleType
from typing import NoReturn

from kinsym.errors import UsageError
from kinsym.robot.names import nearest, shown

_CHOICE = re.compile(r"argument (?P<name>\S+): invalid choice: (?P<value>.+?) \(choose from (?P<known>.*)\)")


class Parser(argparse.ArgumentParser):
    """An argument parser that raises :class:`kinsym.errors.UsageError` where it would end the program."""

    def error(self, message: str) -> NoReturn:
        """Refuse, with the nearest choice where there is one."""
        if found := _CHOICE.fullmatch(message):
            known = [word.strip(" '\"") for word in found["known"].split(",")]
            hint = nearest(found["value"].strip("'\""), known)
            message = f"{found['name']}: {found['value']} is none of {', '.join(known)}"
            raise UsageError(f"{message}. {hint}See {self.prog} --help.")
        raise UsageError(f"{message}. See {self.prog} --help.")

    def options(self) -> tuple[str, ...]:
        """Every option that it knows, ``--help`` among them."""
        return tuple(word for action in self._actions for word in action.option_strings)

    @property
    def actions(self) -> tuple[argparse.Action, ...]:
        """What it takes, in order."""
        return tuple(self._actions)


def parsed(top: Parser, commands: Mapping[str, Parser], words: Sequence[str]) -> argparse.Namespace:
    """The options of a command line.

    Raises UsageError; a mistyped option gets the nearest one of its command.
    """
    options, extra = top.parse_known_args(words)
    if not extra:
        return options
    command = commands[options.command]
    word = next((word for word in extra if word.startswith("-")), extra[0])
    name = word.partition("=")[0]
    hint = nearest(name, command.options()) if name.startswith("-") else ""
    what = "an option" if name.startswith("-") else "expected"
    raise UsageError(f"{shown(word)} is not {what} of kinsym {options.command}. {hint}See {command.prog} --help.")


def parser_of(name: str, module: ModuleType) -> Parser:
    """The parser of one command by itself, for what has to know its options."""
    parser = Parser(prog=f"kinsym {name}", allow_abbrev=False)
    module.add_options(parser)
    return parser
