"""Denavit-Hartenberg tables as plain rows: a CSV file, or one line of text."""

from __future__ import annotations

import csv
import io

from kinsym.errors import RobotError
from kinsym.robot.rows import COLUMNS, check_keys

CSV_COLUMNS = (*COLUMNS, "type", "variable")


def rows_from_csv(text: str, *, where: str) -> list[dict[str, object]]:
    """The rows of a CSV table with the header ``alpha,a,d,theta[,type][,variable]``, columns in any order.

    Blank lines and lines that begin with ``#`` are skipped; an empty type or variable counts as left out.

    >>> rows_from_csv("alpha,a,d,theta\\n0,a1,0,theta1\\n", where="arm.csv")
    [{'alpha': '0', 'a': 'a1', 'd': '0', 'theta': 'theta1'}]
    """
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    try:
        table = [[cell.strip() for cell in row] for row in csv.reader(io.StringIO("\n".join(lines)), strict=True)]
    except csv.Error as error:
        raise RobotError(f"this is not CSV: {error}", where=where, remedy="Part cells by commas.") from None
    if not table:
        raise RobotError("the table is empty", where=where, remedy="Begin with the header alpha,a,d,theta.")
    header, *rows = table
    check_keys(dict.fromkeys(header), CSV_COLUMNS, where=f"{where}, header")
    for column in header:
        if header.count(column) > 1:
            raise RobotError(f"the column {column} occurs twice", where=f"{where}, header", remedy="Remove one.")
    for column in COLUMNS:
        if column not in header:
            raise RobotError(
                f"the column {column} is missing", where=f"{where}, header", remedy="The header is alpha,a,d,theta."
            )
    return [_row(header, row, f"{where}, joints row {i}") for i, row in enumerate(rows, start=1)]


def _row(header: list[str], row: list[str], where: str) -> dict[str, object]:
    if len(row) > len(header):
        raise RobotError(f"the row has {len(row)} cells for {len(header)} columns", where=where, remedy="Mend the row.")
    cells = dict(zip(header, row, strict=False))
    return {key: cell for key, cell in cells.items() if cell or key in COLUMNS}


def rows_from_inline(text: str, *, where: str) -> list[dict[str, object]]:
    """The rows of ``"alpha a d theta; alpha a d theta; ..."``; a cell holds no blanks.

    >>> rows_from_inline("pi/2 a1 0 theta1", where="--dh")
    [{'alpha': 'pi/2', 'a': 'a1', 'd': '0', 'theta': 'theta1'}]
    """
    rows: list[dict[str, object]] = []
    for i, line in enumerate(text.strip().removesuffix(";").split(";"), start=1):
        cells = line.split()
        if not cells and not text.strip():
            break
        if len(cells) != len(COLUMNS):
            raise RobotError(
                f"the row has {len(cells)} cells instead of 4 (alpha a d theta)",
                where=f"{where}, joints row {i}",
                remedy='Part cells by blanks and rows by ";", and write cells without blanks: theta2-pi/2.',
            )
        rows.append(dict(zip(COLUMNS, cells, strict=True)))
    return rows
