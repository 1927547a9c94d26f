# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What the figures depend on: the processor, the memory, the system."""

import os
import pathlib


def facts():
    """(name, value) pairs."""
    return [
        ("processor", _first("/proc/cpuinfo", "model name")),
        ("logical cores", str(os.cpu_count())),
        ("memory", _first("/proc/meminfo", "MemTotal")),
        ("system", _first("/etc/os-release", "PRETTY_NAME").strip('"')),
        ("kernel", os.uname().release),
    ]


def _first(path, key):
    """The value of the first line `key: value` or `key=value`."""
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        name, mark, value = line.replace("=", ":", 1).partition(":")
        if mark and name.strip() == key:
            return value.strip()
    return "unknown"
