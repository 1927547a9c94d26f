#!/usr/bin/python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's Tables 2 to 6 and Figs 11 to 13 of any labelled volumes, beside what it prints.

Writes DIR/tables.md with commands and machine, one CSV a table and figure, one SVG a figure.
DIR/runs keeps what was measured: the same command again goes on where it was stopped.
"""

import argparse
import importlib.util
import pathlib
import sys

import figures
import machine
import render
import studies
from runs import ROOT, Runner

STUDIES = studies.TABLES | figures.FIGURES
PACKAGES = {"numpy": "python3-numpy", "matplotlib": "python3-matplotlib"}


def main():
    options = parse(sys.argv[1:])
    drawn = any(name in figures.FIGURES for name in options.tables)
    need_packages(["numpy", "matplotlib"] if drawn else ["numpy"])
    programs = {"mwmesh": options.program, "cgal_mesh": options.cgal}
    runner = Runner(
        programs, options.out / "runs", options.repeat, options.threads, options.timeout
    )
    runs = measure(runner, options.volumes, [STUDIES[name] for name in options.tables])
    tables = [STUDIES[name].build(runs) for name in options.tables]
    write(tables, runner, options.out)


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("volumes", nargs="+", metavar="VOLUME", type=pathlib.Path)
    build = ROOT / "build" / "release"
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build" / "tables",
                        metavar="DIR")
    parser.add_argument("--tables", type=names, default=list(STUDIES), metavar="2,3,...",
                        help="of " + ",".join(STUDIES) + "; default: all")
    parser.add_argument("--repeat", type=positive, default=1, metavar="N",
                        help="runs of each; time and memory are their median")
    parser.add_argument("--threads", type=positive, default=1, metavar="N", help="of mwmesh")
    parser.add_argument("--timeout", type=float, metavar="SECONDS", help="of each run")
    parser.add_argument("--program", type=pathlib.Path, default=build / "mwmesh")
    parser.add_argument("--cgal", type=pathlib.Path, default=build / "cgal_mesh")
    options = parser.parse_args(arguments)
    if len({volume.name for volume in options.volumes}) < len(options.volumes):
        parser.error("volumes need different file names")
    return options


def names(text):
    wanted = text.split(",")
    for name in wanted:
        if name not in STUDIES:
            raise argparse.ArgumentTypeError(f"no table {name!r}; there are {', '.join(STUDIES)}")
    return wanted


def positive(text):
    if int(text) < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return int(text)


def need_packages(modules):
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if missing:
        packages = " ".join(PACKAGES[name] for name in missing)
        sys.exit(f"tables.py: {sys.executable} has no {', '.join(missing)};"
                 f" apt-get install {packages} for /usr/bin/python3")


def measure(runner, volumes, wanted):
    """{volume: {mode: Facts}}; checked runs first, because others may share their facts."""
    modes = list(dict.fromkeys(mode for study in wanted for mode in study.modes))
    modes.sort(key=lambda mode: not mode.checked)
    runs = {}
    for volume in volumes:
        runs[volume] = {}
        for mode in modes:
            facts = runner.measure(volume, mode)
            runs[volume][mode] = facts
            print(f"{volume.name}: {mode.name}: {facts.failure or 'done'}", file=sys.stderr)
    return runs


def write(tables, runner, folder):
    folder.mkdir(parents=True, exist_ok=True)
    parts = ["# The paper's tables\n"]
    for table in tables:
        (folder / f"{table.name}.csv").write_text(render.to_csv(table), encoding="utf-8")
        if table.name in figures.FIGURES:
            figures.plot(table, folder / f"{table.name}.svg")
            parts.append(f"## {table.title}\n\n![{table.title}]({table.name}.svg)\n")
        else:
            parts.append(render.to_markdown(table))
    parts.append(conditions(runner))
    (folder / "tables.md").write_text("\n".join(parts), encoding="utf-8")
    print(folder / "tables.md")


def conditions(runner):
    facts = [*machine.facts(), ("program", runner.version())]
    lines = [f"- {name}: {value}" for name, value in facts]
    commands = "\n".join(runner.commands)
    return "## Machine and commands\n\n" + "\n".join(lines) + f"\n\n```\n{commands}\n```\n"


if __name__ == "__main__":
    main()
