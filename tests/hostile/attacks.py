"""What somebody who means harm would write, and every place of a robot that takes text: the table is their product.

``ATTACKS`` are texts. ``PLACES`` are functions that put a text into one place and read the robot; each raises what the
reader raises. Texts that a file format cannot hold at a place are escaped as that format would.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import quoteattr

from kinsym.cli import main
from kinsym.command.table import bindings_of, locks_of
from kinsym.robot import Robot, from_inline, load
from kinsym.robot.locking import lock
from kinsym.robot.snapping import snapping_of
from kinsym.write import check_place

#: Each of the first group would leave a file ``executed`` in the current folder if anything ran it.
ATTACKS = {
    "call in Python": "__import__('os').system('touch executed')",
    "call through eval": "eval(\"open('executed','w')\")",
    "lambda": "(lambda: open('executed', 'w'))()",
    "comprehension": "[open('executed', 'w') for _ in (1,)]",
    "walrus": "(x := open('executed', 'w'))",
    "f-string": "f\"{open('executed', 'w')}\"",
    "dunder attributes": "().__class__.__bases__[0].__subclasses__()",
    "sympy's way out": "Symbol('x').__class__.__init__.__globals__",
    "dunder name": "__builtins__",
    "shell": "$(touch executed) `touch executed`; touch executed | touch executed & touch executed",
    "pickle": "cos\nsystem\n(S'touch executed'\ntR.",
    "tower of powers": "9**9**9",
    "tower of squares": "((((((9**8)**8)**8)**8)**8)**8)**8",
    "factorial": "9" * 50 + "!",
    "100 000 brackets": "(" * 100_000 + ")" * 100_000,
    "100 000 minus signs": "-" * 100_000 + "1",
    "100 000 terms": "+".join("a" * 100_000),
    "100 000 dots": "a." * 100_000 + "a",
    "100 000 digits": "9" * 100_000,
    "exponent of a million": "1e1000000",
    "not a number": "nan",
    "infinity": "-inf",
    "path upward": "../../etc/passwd",
    "absolute path": "/etc/passwd",
    "backslash path": "..\\..\\executed",
    "zero byte": "arm\0.py",
    "device": "/dev/zero",
    "Jinja expression": "{{ cycler.__init__.__globals__.os.system('touch executed') }}",
    "Jinja block": "{% for x in [].__class__.__base__.__subclasses__() %}{{ x }}{% endfor %}",
    "LaTeX's Jinja": "\\VAR{1} \\BLOCK{include 'c/source.c.jinja'} ((* 1 *)) ((( 1 )))",
    "format": "{0.__class__} %s %n ${HOME}",
    "end of a C comment": '*/ int main(void) { return system("touch executed"); } /*',
    "trigraphs": "?\x3f/\n#include <stdlib.h> *??/\n/",
    "C line continued": "end of line \\",
    "preprocessor": '\n#include "/etc/passwd"\n#error',
    "end of a docstring": '"""\nopen("executed", "w")\n"""',
    "end of a string": "\"); open('executed', 'w'); (\"",
    "comment in Python": "title\nopen('executed', 'w')",
    "LaTeX input": "\\input{/etc/passwd} \\end{document} \\write18{touch executed}",
    "LaTeX by carets": "^^5cinput{/etc/passwd} ^^M \\catcode`\\%=12 %",
    "LaTeX mathematics": "$ & # _ ~ ^ { } % $$",
    "Markdown and HTML": "](javascript:alert(1)) <script>alert(1)</script> ```",
    "TOML": '"\n[project]\nname = "other',
    "JSON": '", "files": {"x": "',
    "CSV": '0,0,0,theta9"\n0,0,0,theta8',
    "XML entity": "&lol; &#10; &#0; ]]> <!ENTITY a SYSTEM 'file:///etc/passwd'>",
    "carriage return": "one\rtwo\x85three\u2028four",
    "terminal": "\x1b]0;title\x07\x1b[2J\x9b31m",
    "bidi": "abc\u202e\u2066 /* \u2069 cba",
    "zero width": "the\u200bta1\ufeff",
    "look-alike letters": "thеtа1 + раth",  # Cyrillic
    "compatibility letters": "ｔｈｅｔａ１ ﬁ ｏｓ．ｓｙｓｔｅｍ",
    "other digits": "١٢٣ + ²",
    "lone surrogate": "\udcff",
    "keyword": "import",
    "keyword of C": "int",
    "standard module": "os",
    "emoji": "🤖" * 30,
    "empty": "",
    "blanks": "   ",
}


def _toml(folder: Path, **changes: str) -> Robot:
    """A TOML file with one of its texts replaced."""
    texts = {"name": "arm", "title": "An arm", "source": "here", "a": "l1", "parameter": "l1", "value": "0.5"}
    texts |= {"variable": "theta1", "type": "R", "convention": "paul", "limit": "2", "key": "task", "lock": "0"}
    text = {key: json.dumps(changes.get(key, value), ensure_ascii=False) for key, value in texts.items()}
    path = folder / "arm.toml"
    content = (
        f"name = {text['name']}\ntitle = {text['title']}\nsource = {text['source']}\n"
        f"convention = {text['convention']}\n{text['key']} = 'position'\n"
        f"[[joints]]\ntype = {text['type']}\nvariable = {text['variable']}\nalpha = '0'\na = {text['a']}\nd = '0'\n"
        f"theta = 'theta1'\nlimits = ['-1', {text['limit']}]\n"
        "[[joints]]\nalpha = '0'\na = '0.3'\nd = '0'\ntheta = 'theta2'\n"
        f"[parameters]\n{text['parameter']} = {text['value']}\n"
    )
    if "lock" in changes:
        content += f"[locks]\ntheta1 = {text['lock']}\n"
    if "joint" in changes:
        content += f"[locks]\n{json.dumps(changes['joint'], ensure_ascii=False)} = '0'\n"
    path.write_bytes(content.encode("utf-8", "surrogatepass"))
    return load(str(path))


def _raw(folder: Path, name: str, text: str) -> Robot:
    path = folder / name
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    return load(str(path), convention=None if name.endswith((".toml", ".urdf")) else "paul")


def _csv(folder: Path, cell: str) -> Robot:
    quoted = '"' + cell.replace('"', '""') + '"'
    return _raw(folder, "arm.csv", f"alpha,a,d,theta\n0,{quoted},0,theta1\n")


def _urdf(folder: Path, **changes: str) -> Robot:
    """A URDF file with one of its texts replaced."""
    texts = {"robot": "arm", "link": "b", "joint": "j1", "xyz": "0.4 0 0", "type": "revolute", "axis": "0 0 1"}
    text = {key: quoteattr(changes.get(key, value), {"\n": "&#10;"}) for key, value in texts.items()}
    content = (
        f"<robot name={text['robot']}><link name='a'/><link name={text['link']}/>"
        f"<joint name={text['joint']} type={text['type']}><parent link='a'/><child link={text['link']}/>"
        f"<axis xyz={text['axis']}/><origin xyz={text['xyz']}/><limit lower='-1' upper='1'/></joint></robot>"
    )
    return _raw(folder, "arm.urdf", content)


def _command(*arguments: str) -> None:
    """The command line itself, whose refusals are printed."""
    if main(arguments) not in (0, 1, 2):
        raise AssertionError(arguments)


def _arm() -> Robot:
    return load("planar_rr")


Place = Callable[[Path, str], Robot | None]
PLACES: dict[str, Place] = {
    "TOML name": lambda folder, text: _toml(folder, name=text),
    "TOML title": lambda folder, text: _toml(folder, title=text),
    "TOML source": lambda folder, text: _toml(folder, source=text),
    "TOML convention": lambda folder, text: _toml(folder, convention=text),
    "TOML key": lambda folder, text: _toml(folder, key=text),
    "TOML cell": lambda folder, text: _toml(folder, a=text),
    "TOML type": lambda folder, text: _toml(folder, type=text),
    "TOML variable": lambda folder, text: _toml(folder, variable=text),
    "TOML limit": lambda folder, text: _toml(folder, limit=text),
    "TOML parameter": lambda folder, text: _toml(folder, parameter=text),
    "TOML value": lambda folder, text: _toml(folder, value=text),
    "TOML locked joint": lambda folder, text: _toml(folder, joint=text),
    "TOML lock": lambda folder, text: _toml(folder, lock=text),
    "TOML file": lambda folder, text: _raw(folder, "arm.toml", text),
    "CSV cell": _csv,
    "CSV file": lambda folder, text: _raw(folder, "arm.csv", text),
    "inline cell": lambda _, text: from_inline(f"0 {text} 0 theta1", convention="paul"),
    "inline table": lambda _, text: from_inline(text, convention="paul"),
    "URDF robot": lambda folder, text: _urdf(folder, robot=text),
    "URDF link and joint": lambda folder, text: _urdf(folder, link=text, joint=text),
    "URDF number": lambda folder, text: _urdf(folder, xyz=f"{text} 0 0"),
    "URDF axis": lambda folder, text: _urdf(folder, axis=text),
    "URDF type": lambda folder, text: _urdf(folder, type=text),
    "URDF file": lambda folder, text: _raw(folder, "arm.urdf", text),
    "TABLE": lambda _, text: load(text),
    "--name": lambda _, text: from_inline("0 l1 0 theta1", convention="paul", name=text),
    "--convention": lambda _, text: from_inline("0 l1 0 theta1", convention=text),
    "--bind value": lambda _, text: load("planar_rr", bindings=bindings_of([f"l1={text}"])),
    "--bind name": lambda _, text: load("planar_rr", bindings=bindings_of([f"{text}=1"])),
    "--lock value": lambda _, text: lock(_arm(), locks_of([f"theta1={text}"]), where="--lock"),
    "--lock joint": lambda _, text: lock(_arm(), locks_of([text]), where="--lock"),
    "--snap": lambda _, text: load("planar_rr", snapping=snapping_of(text)),
    "--tip-link": lambda _, text: load("planar_rr", tip_link=text),
    "--output": lambda _, text: check_place(Path(text), ["arm.py"]),
    "command": lambda _, text: _command(text),
    "DIR of check": lambda _, text: _command("check", text),
    "--method": lambda _, text: _command("show", "planar_rr", "--method", text),
    "--deadline": lambda _, text: _command("show", "planar_rr", "--deadline", text),
    "--task": lambda _, text: _command("show", "planar_rr", "--task", text),
}
