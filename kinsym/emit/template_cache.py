"""Compiled templates, kept as Python keeps compiled modules: in ``__pycache__``, beside those of this package.

To compile the templates takes longer than to derive a planar arm. A file holds what it was compiled from (the text's
checksum, the versions of Jinja and of Python), so that a changed template is compiled anew; it is replaced in one
step, and without permission to write nothing is kept. What is read is code from the folder that Python reads this
module's code from.
"""

from __future__ import annotations

import contextlib
import marshal
import os
import sys
import tempfile
from importlib.util import cache_from_source
from pathlib import Path

import jinja2
from jinja2.bccache import Bucket, BytecodeCache


class TemplateCache(BytecodeCache):
    """Jinja's hook for compiled templates."""

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = Path(cache_from_source(__file__)).parent if folder is None else folder

    def load_bytecode(self, bucket: Bucket) -> None:
        """Take the code from the cache if it is of this text."""
        with contextlib.suppress(OSError, ValueError, EOFError, TypeError):
            head, _, code = self._path(bucket).read_bytes().partition(b"\n")
            if head == _origin(bucket):
                bucket.code = marshal.loads(code)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code, unless Python was told to keep none or the folder takes none."""
        if sys.dont_write_bytecode:
            return
        with contextlib.suppress(OSError):
            self._folder.mkdir(exist_ok=True)
            with tempfile.NamedTemporaryFile(dir=self._folder, delete=False) as file:
                try:
                    file.write(_origin(bucket) + b"\n" + marshal.dumps(bucket.code))
                    file.close()
                    os.replace(file.name, self._path(bucket))
                except BaseException:
                    os.unlink(file.name)
                    raise

    def _path(self, bucket: Bucket) -> Path:
        return self._folder / f"template-{bucket.key}.{sys.implementation.cache_tag}"


def _origin(bucket: Bucket) -> bytes:
    return f"{bucket.checksum} jinja {jinja2.__version__} python {sys.hexversion:x}".encode()
