"""``kinsym robots``: the gallery."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kinsym.command.screen import Screen

HELP = "list the robots of the gallery"


def add_options(command: argparse.ArgumentParser) -> None:
    """It takes none."""


def run(options: argparse.Namespace, screen: Screen) -> int:
    """Print name and title of every robot of the gallery."""
    from kinsym.robot import gallery_titles

    titles = gallery_titles()
    width = max(map(len, titles), default=0)
    for name, title in titles.items():
        screen.say(f"{name:<{width}}  {title}")
    return 0
