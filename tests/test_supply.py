"""What kinsym takes from elsewhere and what it starts: declared libraries, a C compiler, and nothing from a network."""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from kinsym.check.compiler import find_compiler
from tests.urdf.trees import J, urdf, write

ROOT = Path(__file__).resolve().parent.parent
MODULES = sorted((ROOT / "kinsym").rglob("*.py"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

#: Calls and modules that make text into code or start something, and what is read as code: never in this package ...
FORBIDDEN_CALLS = frozenset(
    """eval exec compile __import__ execfile breakpoint input os.system os.popen os.fork os.execv os.execvp os.spawnl
    os.posix_spawn subprocess.run subprocess.call subprocess.check_call subprocess.check_output subprocess.getoutput
    subprocess.getstatusoutput subprocess.Popen tempfile.mktemp sympify sympy.sympify sympy.S parse_expr
    sympy.parse_expr lambdify sympy.lambdify np.load numpy.load importlib.import_module runpy.run_path""".split()
)
FORBIDDEN_MODULES = frozenset(
    """pickle cPickle marshal shelve dill joblib cloudpickle socket ssl http urllib ftplib smtplib xmlrpc requests httpx
    aiohttp multiprocessing pty code codeop yaml""".split()
)
#: ... except here.
ALLOWED = {
    ("kinsym/workspace/partial.py", "np.load"): "what a sweep has kept, arrays alone: allow_pickle is False",
    ("kinsym/workspace/runners.py", "multiprocessing"): "the processes of a sweep, which the user asks for",
    ("kinsym/emit/live.py", "exec"): "the module that kinsym has just generated, of names that were let through",
    ("kinsym/emit/live.py", "compile"): "the same",
    ("kinsym/cli.py", "exec"): "an empty text, after an interrupt",
    ("kinsym/check/compiler.py", "subprocess.Popen"): "the C compiler, with a list of arguments",
    (
        "kinsym/emit/template_cache.py",
        "marshal",
    ): "compiled templates, in the folder of the package's own compiled code",
}


def calls(tree: ast.AST) -> Iterator[tuple[str, ast.Call]]:
    """Every call by the dotted name that is called."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name | ast.Attribute):
            yield ast.unparse(node.func), node


def imports(tree: ast.AST) -> Iterator[str]:
    """The first part of every imported module, wherever the import stands."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module.partition(".")[0]


def test_nothing_makes_text_into_code() -> None:
    """No pickle, eval, shell or network in the package, apart from what is allowed by name; none of that is idle."""
    met = set()
    for path in MODULES:
        tree, name = ast.parse(path.read_text(encoding="utf-8")), path.relative_to(ROOT).as_posix()
        for module in set(imports(tree)) & FORBIDDEN_MODULES:
            assert (name, module) in ALLOWED, f"{name} imports {module}"
            met.add((name, module))
        for called, call in calls(tree):
            keywords = {keyword.arg for keyword in call.keywords}
            assert "shell" not in keywords, name
            assert called not in ("np.load", "numpy.load") or "allow_pickle=False" in ast.unparse(call), name
            if called in FORBIDDEN_CALLS:
                assert (name, called) in ALLOWED, f"{name}:{call.lineno} calls {called}"
                met.add((name, called))
    assert met == set(ALLOWED)


def test_templates_start_nothing() -> None:
    """Generated code computes: no file, program, allocation or evaluation in it."""
    words = re.compile(r"\b(eval|exec|system|popen|fopen|malloc|calloc|realloc|alloca|gets|strcpy|__import__)\(")
    for path in sorted((ROOT / "templates").rglob("*")):
        if path.is_file() and path.parent.name != "extension":
            found = words.search(path.read_text(encoding="utf-8"))
            assert found is None, f"{path}: {found and found[0]}"


def test_imports_are_declared() -> None:
    """Every library that the package imports is a dependency or extra with a lower bound and a reason in the docs."""
    lines = [
        *PROJECT["dependencies"],
        *(line for name, extra in PROJECT["optional-dependencies"].items() if name != "dev" for line in extra),
    ]
    declared = {re.split(r"[<>=; ]", line)[0].lower(): line for line in lines}
    modules = {"python-flint": ("flint",), "matplotlib": ("matplotlib", "mpl_toolkits")}
    known = (
        {module for name in declared for module in modules.get(name, (name,))}
        | set(sys.stdlib_module_names)
        | {"kinsym", "__future__"}
    )
    for path in MODULES:
        foreign = set(imports(ast.parse(path.read_text(encoding="utf-8")))) - known
        assert not foreign, f"{path}: {foreign}"
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    for name, line in declared.items():
        assert re.search(r">=\d", line), line
        assert f"| `{line}` |" in page, f"docs/architecture.md has no reason for {name}"


def watched(*arguments: str, folder: Path) -> dict[str, Any]:
    """What one command does, in a folder of its own and with a temporary folder of its own."""
    (folder / "tmp").mkdir(exist_ok=True)
    finished = subprocess.run(
        [sys.executable, "-B", "-m", "tests.watched", *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(folder / "tmp")},
        check=True,
        capture_output=True,
        text=True,
    )
    seen: dict[str, Any] = json.loads(finished.stdout.splitlines()[-1])
    return seen


@pytest.mark.parametrize("command", ["derive and check", "show", "lecture", "import"])
def test_no_network_no_other_program_no_other_place(command: str, tmp_path: Path) -> None:
    """Only the compiler is started, with a list; only the folder asked for and a private one are written to."""
    targets = [f"--target={name}" for name in ("numpy", "c", "latex", "extension")]
    runs = {
        "derive and check": [("derive", "planar_rr", *targets, "-o", "out", "--quiet"), ("check", "out", "--quiet")],
        "show": [("show", "planar_rr", "--method", "geometric")],
        "lecture": [("lecture", "planar_rr")],
        "import": [("import", str(write(tmp_path, urdf(J("j1", "revolute", "a", "b")))), "-o", "out/arm.toml")],
    }[command]
    compiler = find_compiler()
    for arguments in runs:
        seen = watched(*arguments, folder=tmp_path)
        assert seen["status"] == 0
        assert seen["forbidden"] == []
        assert {program[0] for program in seen["programs"]} <= {compiler}
        private = [path for path, mode in seen["made"] if mode == 0o700]
        allowed = (*(path + "/" for path in private), f"{tmp_path}/out/.kinsym-", f"{tmp_path}/tmp/", os.devnull)
        assert [path for path in seen["written"] if not path.startswith(allowed)] == []
        assert all(re.search(r"kinsym-[a-z0-9_]{8}$", path) for path in private)
        if arguments[0] in ("derive", "check"):
            assert len(seen["programs"]) >= 2
            assert any(Path(path).parent == tmp_path / "tmp" for path in private)
    assert os.listdir(tmp_path / "tmp") == []


def test_the_watch_sees_what_it_looks_for(tmp_path: Path) -> None:
    """A command that connects, starts and unpickles is told on; without this the test above could not fail."""
    code = (
        "import sys, tests.watched as watched; sys.argv = ['x']; import kinsym.cli as cli\n"
        "def main(arguments):\n"
        "    import os, pickle, socket\n"
        "    os.system('true')\n"
        "    pickle.loads(pickle.dumps(os.getcwd))\n"
        "    try:\n"
        "        socket.create_connection(('127.0.0.1', 9))\n"
        "    except PermissionError:\n"
        "        open('elsewhere', 'w').close()\n"
        "        return 3\n"
        "cli.main = main; watched.main()"
    )
    told = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    seen = json.loads(told.splitlines()[-1])
    assert seen["status"] == 3
    assert {"os.system", "pickle.find_class"} < set(seen["forbidden"])
    assert any(event.startswith("socket.") for event in seen["forbidden"])
    assert str(tmp_path / "elsewhere") in seen["written"]
