"""A small static site of the README and the pages in ``docs/``: ``python docs/site/build.py FOLDER``.

markdown-it-py reads the Markdown and Pygments colours the code (``pip install 'kinsym[docs]'``). The build is strict: a
link to a file or a heading that is not there, a page that no menu has, or raw HTML ends it with status 1 and a line
for each. Files that pages link to are copied; nothing else is fetched or written.
"""

from __future__ import annotations

import argparse
import re
import shutil
import sys
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from posixpath import normpath
from urllib.parse import unquote, urlsplit

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name

HERE = Path(__file__).resolve().parent
MENU = {
    "Start": {"README.md": "kinsym", "docs/tutorial.md": "Tutorial", "docs/faq.md": "Questions"},
    "Use": {
        "docs/robot_file.md": "Robot files",
        "docs/terminal.md": "Terminal",
        "docs/python.md": "Python",
        "docs/pictures.md": "Pictures",
        "docs/solvers.md": "Solvers",
        "docs/urdf.md": "URDF",
        "docs/moveit.md": "MoveIt, C++, CUDA",
    },
    "Understand": {
        "docs/how_it_works.md": "How it works",
        "docs/lecture.md": "The lecture",
        "docs/reliability.md": "Reliability",
        "docs/coverage.md": "Coverage",
        "docs/performance.md": "Performance",
    },
    "Take part": {
        "CONTRIBUTING.md": "Contributing",
        "docs/architecture.md": "Architecture",
        "CHANGELOG.md": "Changes",
    },
}


@dataclass(kw_only=True)
class Page:
    """A page: where its source is, what it links to, and what becomes of it."""

    source: str
    tokens: list[Token]
    anchors: dict[str, str] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """Its first heading."""
        return next(self.tokens[i + 1].content for i, token in enumerate(self.tokens) if token.tag == "h1")

    @property
    def target(self) -> str:
        """Its file in the site."""
        return "index.html" if self.source == "README.md" else PurePosixPath(self.source).stem.lower() + ".html"


class Site:
    """All pages, the files they show, and what is wrong with them."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.markdown = MarkdownIt("commonmark").enable("table")
        self.markdown.add_render_rule("fence", _code)
        self.markdown.add_render_rule("code_block", _code)
        self.markdown.add_render_rule("table_open", lambda *_: '<div class="wide"><table>\n')
        self.markdown.add_render_rule("table_close", lambda *_: "</table></div>\n")
        self.faults: list[str] = []
        self.files: set[str] = set()
        self.listings: dict[str, Page] = {}
        self.pages = {source: self._read(source) for part in MENU.values() for source in part if self._has(source)}
        for found in sorted(path.relative_to(root).as_posix() for path in (root / "docs").glob("*.md")):
            if found not in self.pages:
                self.faults.append(f"{found}: no menu has this page")
        for page in self.pages.values():
            self._link(page)

    def _has(self, source: str) -> bool:
        there = (self.root / source).is_file()
        if not there:
            self.faults.append(f"{source}: the page is missing")
        return there

    def _read(self, source: str) -> Page:
        """The page with an anchor for every heading, as GitHub names it, and without comments."""
        page = Page(source=source, tokens=[])
        tokens = self.markdown.parse((self.root / source).read_text(encoding="utf-8"))
        for i, token in enumerate(tokens):
            if token.type in {"html_block", "html_inline"}:
                if not re.fullmatch(r"\s*<!--.*?-->\s*", token.content, re.DOTALL):
                    self.faults.append(f"{source}: raw HTML: {token.content.strip()}")
                continue
            if token.type == "heading_open":
                title = re.sub(r"[`*]", "", tokens[i + 1].content)
                anchor = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
                token.attrSet("id", anchor)
                if token.tag == "h2":
                    page.anchors[anchor] = title
                else:
                    page.anchors.setdefault(anchor, "")
            page.tokens.append(token)
        return page

    def _link(self, page: Page) -> None:
        """Lead every link of a page to its place in the site."""
        for token in (child for parent in page.tokens for child in parent.children or ()):
            key = {"link_open": "href", "image": "src"}.get(token.type)
            if key:
                token.attrSet(key, self._place(page, str(token.attrGet(key))))

    def _place(self, page: Page, link: str) -> str:
        parts = urlsplit(link)
        if parts.scheme:
            return link
        path = unquote(parts.path)
        source = normpath(PurePosixPath(page.source).parent / path) if path else page.source
        anchor = f"#{parts.fragment}" if parts.fragment else ""
        if source in self.pages:
            if parts.fragment and parts.fragment not in self.pages[source].anchors:
                self.faults.append(f"{page.source}: {source} has no heading for {link}")
            return (self.pages[source].target if path else "") + anchor
        if not (self.root / source).exists() or source.startswith(".."):
            self.faults.append(f"{page.source}: nothing is there for {link}")
        elif (self.root / source).is_dir():
            return self._listing(source)
        else:
            self.files.add(source)
        return source + anchor

    def _listing(self, folder: str) -> str:
        """The page of a folder, which lists its files."""
        files = sorted(path.name for path in (self.root / folder).iterdir() if path.is_file())
        lines = (f"- [{name}]({folder}/{name})" for name in files)
        page = Page(source=folder, tokens=self.markdown.parse(f"# {folder}\n\n" + "\n".join(lines)))
        self.files |= {f"{folder}/{name}" for name in files}
        self.listings[folder] = page
        return page.target

    def write(self, folder: Path) -> None:
        """Write pages, style and files."""
        environment = Environment(loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined)
        template = environment.get_template("page.html")
        folder.mkdir(parents=True, exist_ok=True)
        for page in (*self.pages.values(), *self.listings.values()):
            body = Markup(self.markdown.renderer.render(page.tokens, self.markdown.options, {}))
            text = template.render(page=page, body=body, menu=MENU, pages=self.pages)
            (folder / page.target).write_text(text, encoding="utf-8")
        light, dark = (HtmlFormatter(style=style).get_style_defs(".code") for style in ("friendly", "github-dark"))
        style = (HERE / "style.css").read_text(encoding="utf-8")
        colours = f"{light}\n@media (prefers-color-scheme: dark) {{\n{dark}\n}}\n"
        (folder / "style.css").write_text(colours + style, encoding="utf-8")
        for file in sorted(self.files):
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.root / file, folder / file)


def _code(_: object, tokens: list[Token], i: int, *__: object) -> str:
    """A block of code, with the name of its file above it."""
    language, _space, name = tokens[i].info.partition(" ")
    lexer = get_lexer_by_name("text" if language == "csv" else language or "text", stripnl=False)
    caption = f'<div class="file">{escape(name)}</div>' if name else ""
    return caption + highlight(tokens[i].content, lexer, HtmlFormatter(cssclass="code"))


def main() -> int:
    """Build the site; 1 if something in it leads nowhere."""
    parser = argparse.ArgumentParser(description="Build the documentation as a static site.")
    parser.add_argument("folder", type=Path, help="where to write it")
    parser.add_argument("--root", type=Path, default=HERE.parent.parent, help="the repository (default: this one)")
    options = parser.parse_args()
    site = Site(options.root)
    for fault in site.faults:
        print(fault, file=sys.stderr)
    if site.faults:
        return 1
    site.write(options.folder)
    print(f"{len(site.pages)} pages in {options.folder}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
