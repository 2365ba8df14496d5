"""How objects of kinsym show themselves in a notebook.

Markdown with mathematics is what every notebook typesets; front ends differ in whether they look for formulas in HTML.
"""

from __future__ import annotations


class Displayed:
    """An object that is a page of equations or a table in a notebook, and the same in plain text elsewhere.

    What a robot or a method looks like is said by the emitters, which stand below them; they are looked for when a
    page is asked for. What stands below the emitters has methods of its own.
    """

    def text(self) -> str:
        """The page for a terminal."""
        from kinsym.emit.text.displayed import text_of

        return text_of(self)

    def markdown(self) -> str:
        """The page as Markdown with LaTeX mathematics."""
        from kinsym.emit.markdown import markdown_of

        return markdown_of(self)

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        """Both pages by their media types, of which the front end takes what it can show best."""
        return {"text/plain": self.text(), "text/markdown": self.markdown()}
