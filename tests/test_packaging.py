"""kinsym is built, installed beside nothing but what it asks for, and works there."""

from __future__ import annotations

import re
import subprocess
import sys
import tarfile
import venv
import zipfile
from importlib.metadata import distribution
from pathlib import Path

from kinsym import __version__

ROOT = Path(__file__).resolve().parent.parent


def run(*command: str | Path, cwd: Path) -> str:
    done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def build(root: Path, kind: str, folder: Path) -> Path:
    """A wheel or an sdist, without a network: hatchling is among what the tests need."""
    run(sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", folder, cwd=root)
    (path,) = folder.iterdir()
    return path


def wheel_in(folder: Path) -> Path:
    """The wheel that is made of the sdist alone, as an installer makes it."""
    sdist = build(ROOT, "sdist", folder / "sdist")
    assert sdist.name == f"kinsym-{__version__}.tar.gz"
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
        archive.extractall(folder, filter="data")
    assert {"CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "LICENSE", "docs/tutorial.md"} <= names
    assert not [name for name in names if name.startswith((".venv", "out/")) or name.endswith((".pyc", ".so"))]
    return build(folder / f"kinsym-{__version__}", "wheel", folder / "wheel")


def asked_for(wheel: Path) -> list[str]:
    """The packages that a wheel needs without any extra."""
    with zipfile.ZipFile(wheel) as archive:
        metadata = archive.read(f"kinsym-{__version__}.dist-info/METADATA").decode()
    lines = re.findall(r"^Requires-Dist: (.*)$", metadata, re.MULTILINE)
    return [re.split(r"[^\w-]", line, maxsplit=1)[0] for line in lines if "extra ==" not in line]


def empty_environment(home: Path, packages: list[str]) -> Path:
    """The Python of a new environment with these packages; they are linked, so that nothing is fetched."""
    venv.create(home, with_pip=False)
    (site,) = home.glob("[Ll]ib/**/site-packages")
    for found in map(distribution, packages):
        for top in sorted({file.parts[0] for file in found.files or ()} - {"..", "__pycache__"}):
            (site / top).symlink_to(str(found.locate_file(top)))
    return next(path for path in (home / "bin" / "python", home / "Scripts" / "python.exe") if path.exists())


def test_a_wheel_works_in_an_empty_environment(tmp_path: Path) -> None:
    """It holds the package with its templates and its gallery, typed, and needs what it asks for and no more."""
    wheel = wheel_in(tmp_path)
    assert wheel.name == f"kinsym-{__version__}-py3-none-any.whl"
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    assert {name.partition("/")[0] for name in names} == {"kinsym", f"kinsym-{__version__}.dist-info"}
    kept = {"kinsym/py.typed", "kinsym/robot/gallery/planar_rr.toml", "kinsym/robot/gallery/index.json"}
    templates = {f"kinsym/{path.relative_to(ROOT).as_posix()}" for path in (ROOT / "templates").rglob("*.jinja")}
    assert templates | kept <= names

    python = empty_environment(tmp_path / "environment", asked_for(wheel))
    pip = [sys.executable, "-m", "pip", "--python", python, "install", "--no-index", "--quiet", "--no-compile"]
    run(*pip, "--disable-pip-version-check", wheel, cwd=tmp_path)
    kinsym = python.with_name("kinsym")
    assert run(kinsym, "--version", cwd=tmp_path) == f"kinsym {__version__}\n"
    assert "ok      FK(IK(T)) = T" in run(kinsym, "derive", "planar_rr", cwd=tmp_path)
    assert (tmp_path / "planar_rr" / "planar_rr.c").is_file()


def test_one_version_everywhere() -> None:
    """The package, the change log and the citation tell the same version and the same day."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    versions = re.findall(r"^## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)$", text, re.MULTILINE)
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert versions[0][0] == __version__
    assert f"\nversion: {__version__}\ndate-released: {versions[0][1]}\n" in citation
    assert versions == sorted(versions, key=lambda entry: [int(part) for part in entry[0].split(".")], reverse=True)
