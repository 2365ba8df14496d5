"""One reader under libFuzzer: ``python -m tests.fuzz.guided READER SECONDS FOLDER``.

``FOLDER`` holds ``corpus`` and ``words``; what makes the reader fail is written there as ``crash-...``.
"""

from __future__ import annotations

import sys

SLOWEST, LARGEST = 10, 2048


def main() -> None:
    """Fuzz until the time is up; libFuzzer ends the process."""
    import atheris

    with atheris.instrument_imports(include=["kinsym"]):
        from tests.fuzz.targets import run

    reader, seconds, folder = sys.argv[1:]
    options = [
        f"-max_total_time={seconds}",
        f"-timeout={SLOWEST}",
        f"-rss_limit_mb={LARGEST}",
        f"-dict={folder}/words",
        f"-artifact_prefix={folder}/",
        "-max_len=4096",
        "-print_final_stats=1",
    ]
    atheris.Setup([reader, *options, f"{folder}/corpus"], lambda data: run(reader, data) and None)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
