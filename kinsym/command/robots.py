"""``kinsym robots``: the gallery."""

from __future__ import annotations

from kinsym.command.screen import Screen


def robots(screen: Screen) -> int:
    """Print name and title of every robot of the gallery."""
    from kinsym.robot import gallery_titles

    titles = gallery_titles()
    width = max(map(len, titles), default=0)
    for name, title in titles.items():
        screen.say(f"{name:<{width}}  {title}")
    return 0
