"""``kinsym completion``: a script that completes commands, options, their values, robots and files in a shell.

The script is made from the parsers of the commands, so that a new command or option needs nothing here; what a place
takes is told by its metavar. It holds the names of the gallery, and calls nothing when a key is pressed.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import TYPE_CHECKING

from kinsym.command.parsing import Parser, parser_of

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

SHELLS = ("bash", "zsh", "fish")

HELP = "print a completion script for a shell"
_HOW = """\
to use it:
  bash   add to ~/.bashrc:  source <(kinsym completion bash)
  zsh    add to ~/.zshrc, behind compinit:  source <(kinsym completion zsh)
  fish   kinsym completion fish > ~/.config/fish/completions/kinsym.fish
"""

#: What a place takes whose metavar is one of these; other places take what only the user knows.
_KINDS = {"TABLE": "table", "ROBOT": "table", "FILE": "file", "DIR": "folder", "WORD": "robot"}
#: Names that most robots use, where one of the robot's own is asked for.
_UNKNOWNS = tuple(f"theta{number}" for number in range(1, 8))


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where a word stands: ``flags`` of an option, none of a positional; what it takes, empty for an option without.

    ``kind`` is ``words``, ``table`` (robots and their files), ``robot``, ``file``, ``folder`` or ``any``.
    """

    flags: tuple[str, ...]
    help: str
    kind: str
    words: tuple[str, ...] = ()
    repeated: bool = False


@dataclass(frozen=True, kw_only=True)
class Command:
    """A command with its options and its positionals."""

    name: str
    help: str
    options: tuple[Place, ...]
    places: tuple[Place, ...]


def add_options(command: argparse.ArgumentParser) -> None:
    """What the command takes."""
    command.description = "Print a script that completes commands, options, robots and files."
    command.epilog = _HOW
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.add_argument("shell", metavar="SHELL", choices=SHELLS, help=", ".join(SHELLS))


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Print the script."""
    screen.say(script(options.shell).rstrip("\n"), plain=True)
    return 0


def script(shell: str) -> str:
    """The script for one of :data:`SHELLS`."""
    from kinsym.emit.environment import render
    from kinsym.robot import gallery

    return render(f"completion/{shell}.jinja", commands=_commands(), robots=gallery(), quoted=_QUOTED[shell])


def _in_zsh(text: str) -> str:
    """A text inside single quotes in a specification of _arguments or _describe, where brackets and colons count.

    >>> _in_zsh("default: [x]")
    'default\\\\: \\\\[x\\\\]'
    """
    for sign in "\\[]:":
        text = text.replace(sign, f"\\{sign}")
    return text.replace("'", "'\\''")


def _in_fish(text: str) -> str:
    """A text inside single quotes."""
    return text.replace("\\", "\\\\").replace("'", "\\'")


_QUOTED = {"bash": str, "zsh": _in_zsh, "fish": _in_fish}


def _commands() -> list[Command]:
    from kinsym.cli import COMMANDS

    return [_command(name, module.HELP, parser_of(name, module)) for name, module in COMMANDS.items()]


def _command(name: str, text: str, parser: Parser) -> Command:
    places = [_place(action) for action in parser.actions]
    return Command(
        name=name,
        help=text,
        options=tuple(place for place in places if place.flags),
        places=tuple(place for place in places if not place.flags),
    )


def _place(action: argparse.Action) -> Place:
    kind = "any"
    words: tuple[str, ...] = ()
    if action.option_strings and action.nargs == 0:
        kind = ""
    elif action.choices is not None:
        kind, words = "words", tuple(map(str, action.choices))
    elif action.metavar == "UNKNOWN":
        kind, words = "words", _UNKNOWNS
    elif action.metavar == "SYSTEM":
        from kinsym.lecture.report import systems

        kind, words = "words", systems()
    else:
        kind = _KINDS.get(str(action.metavar), kind)
    return Place(
        flags=tuple(action.option_strings),
        help=(action.help or "").replace("%%", "%"),
        kind=kind,
        words=words,
        repeated=action.nargs in ("*", "+"),
    )
