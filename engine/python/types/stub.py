# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the types of the package's functions, with the arguments that the table of options has.

Usage: stub.py FOLDER TEMPLATE STUB    where the package is in FOLDER

A line `# options: USE` of the template becomes the arguments of a use ("open", "mesh", "write",
"verify") that the function does not have already and that are no settings.
"""

import pathlib
import re
import sys

sys.path.insert(0, sys.argv[1])
from mwmesh import _options  # noqa: E402
from mwmesh._errors import NAMES  # noqa: E402


def type_of(name):
    """Returns the type of the value of an option, as _options takes it."""
    row = _options.TABLE[name]
    if name in NAMES:
        return "bool"
    out = _options.maker_of(row).__annotations__["value"]
    choices = ", ".join(f'"{choice}"' for choice in row["choices"])
    out = out.replace("_Text", f"Literal[{choices}]" if choices else "_Path")
    return out if row["default"] is not None else f"{out} | None"


def with_arguments(template):
    lines = []
    for line in template.splitlines(keepends=True):
        found = re.match(r"( *)# options: (\w+)$", line)
        if not found:
            lines.append(line)
            continue
        begin = max(at for at, one in enumerate(lines) if one.lstrip().startswith("def "))
        known = re.findall(r"^ *(\w+):", "".join(lines[begin:]), re.MULTILINE)
        for name, row in _options.TABLE.items():
            argument = NAMES.get(name, name)
            if (argument in _options.arguments_of(found[2]) and argument not in known
                    and not row["setting"]):
                lines.append(f"{found[1]}{argument}: {type_of(name)} = ...,\n")
    return "".join(lines)


source, target = map(pathlib.Path, sys.argv[2:])
target.write_text(with_arguments(source.read_text(encoding="utf-8")), encoding="utf-8")
