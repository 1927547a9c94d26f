#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Says by folder how many lines ran, from gcovr's JSON; fails where a tree is below its floor.

    coverage_table.py LINES.json --never-run FUNCTIONS.txt --floor kernels=90 ...
"""
import argparse
import collections
import json
import sys
from pathlib import PurePosixPath


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("lines", help="what gcovr --json wrote")
    parser.add_argument("--never-run", required=True, help="list of functions to write")
    parser.add_argument("--floor", action="append", default=[], metavar="TREE=PERCENT")
    return parser.parse_args()


def line_counts(file):
    """Lines that ran, and all."""
    counts = [line["count"] for line in file["lines"] if not line["gcovr/noncode"]]
    return sum(count > 0 for count in counts), len(counts)


def by_folder(files):
    """Folder (of two levels), tree (of one) -> [lines that ran, all]."""
    out = collections.defaultdict(lambda: [0, 0])
    for file in files:
        parts = PurePosixPath(file["file"]).parent.parts
        for folder in {"/".join(parts[:2]), parts[0]}:
            for k, count in enumerate(line_counts(file)):
                out[folder][k] += count
    return out


def never_run(files):
    """Functions of which no instance ran: "FILE:LINE NAME"."""
    out = []
    for file in files:
        starts = collections.defaultdict(list)
        for function in file["functions"]:
            starts[function["lineno"]].append(function)
        out += [f"{file['file']}:{line} {instances[0]['name']}"
                for line, instances in sorted(starts.items())
                if not any(function["execution_count"] for function in instances)]
    return out


def percent(counts):
    ran, all_lines = counts
    return 100 * ran / max(all_lines, 1)


def failures(folders, floors):
    for floor in floors:
        tree, _, least = floor.partition("=")
        if tree not in folders:
            yield f"nothing of {tree} was counted"
        elif percent(folders[tree]) < float(least):
            yield f"{tree}: {percent(folders[tree]):.2f} % of lines ran, the floor is {least} %"


def main():
    args = arguments()
    with open(args.lines, encoding="utf-8") as file:
        files = json.load(file)["files"]
    folders = by_folder(files)
    print(f"{'folder':<24}{'lines':>8}{'ran':>9}")
    for folder, counts in sorted(folders.items()):
        print(f"{folder:<24}{counts[1]:>8}{percent(counts):>7.1f} %")
    unused = never_run(files)
    with open(args.never_run, "w", encoding="utf-8") as out:
        out.writelines(line + "\n" for line in unused)
    print(f"{len(unused)} functions never ran: {args.never_run}")
    failed = list(failures(folders, args.floor))
    for failure in failed:
        print(f"coverage: {failure}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
