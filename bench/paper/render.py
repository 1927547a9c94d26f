# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""A table as CSV (numbers as they are) and as Markdown (numbers to be read)."""

import csv
import dataclasses
import io


def count(value):
    return f"{value:,.0f}"


def percent(value):
    return f"{value:.3g} %"


def fixed(digits):
    return lambda value: f"{value:.{digits}f}"


def short(value):
    """Two digits, with an exponent when small."""
    return f"{value:.2g}"


def change(value):
    return f"{value:+d}" if value else "0"


@dataclasses.dataclass(frozen=True)
class Column:
    name: str
    text: object = str  # of a value that is not None


@dataclasses.dataclass
class Table:
    name: str  # of its files
    title: str
    columns: list
    rows: list  # of dicts by column name; what is missing or None is not known
    notes: list = dataclasses.field(default_factory=list)


def to_csv(table):
    out = io.StringIO()
    names = [column.name for column in table.columns]
    writer = csv.DictWriter(
        out, names, restval="", extrasaction="ignore", lineterminator="\n"
    )
    writer.writeheader()
    writer.writerows(table.rows)
    return out.getvalue()


def to_markdown(table):
    lines = [
        _line(column.name for column in table.columns),
        _line("---" for _ in table.columns),
    ]
    lines += [_line(_cell(row, column) for column in table.columns) for row in table.rows]
    notes = [f"- {note}" for note in table.notes]
    parts = [f"## {table.title}", "\n".join(lines)] + (["\n".join(notes)] if notes else [])
    return "\n\n".join(parts) + "\n"


def _line(cells):
    return "| " + " | ".join(cells) + " |"


def _cell(row, column):
    value = row.get(column.name)
    return "" if value is None else column.text(value).replace("|", "/")
