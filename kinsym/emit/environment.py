"""One Jinja2 environment for every language.

Undefined names are errors: a template that asks for what the code does not give must not print an empty string.
The templates lie beside the package in a source checkout and inside it in an installed wheel.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment


@dataclass(frozen=True, kw_only=True)
class Delimiters:
    """The marks of a template; LaTeX needs others than braces."""

    block: tuple[str, str] = ("{%", "%}")
    variable: tuple[str, str] = ("{{", "}}")
    comment: tuple[str, str] = ("{#", "#}")


def template_folder() -> Path:
    """The folder that holds the templates of all languages.

    >>> (template_folder() / "c").is_dir()
    True
    """
    package = Path(__file__).resolve().parents[1]
    inside = package / "templates"
    return inside if inside.is_dir() else package.parent / "templates"


@cache
def environment(delimiters: Delimiters = Delimiters()) -> Environment:
    """The environment for a set of delimiters, made once."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined  # slow to import, needed only to emit

    from kinsym.emit.template_cache import TemplateCache

    return Environment(
        loader=FileSystemLoader(template_folder()),
        bytecode_cache=TemplateCache(),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        block_start_string=delimiters.block[0],
        block_end_string=delimiters.block[1],
        variable_start_string=delimiters.variable[0],
        variable_end_string=delimiters.variable[1],
        comment_start_string=delimiters.comment[0],
        comment_end_string=delimiters.comment[1],
    )


def render(template: str, **names: object) -> str:
    """A template of code, filled in."""
    return environment().get_template(template).render(**names)
