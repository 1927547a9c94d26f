# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""One mesher on one volume: runs it, checks its mesh, and keeps the facts for the next time.

No numpy here, see shapes.py.
"""

import dataclasses
import functools
import hashlib
import json
import pathlib
import shlex
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WORK = "work"  # the folder of a run that is not over
MESH = "mesh.vtu"
CHECK_FAILED = 5  # exit code of mwmesh verify: it has looked, and something fails


@dataclasses.dataclass(frozen=True)
class Mode:
    """How a volume is meshed."""

    name: str
    flags: tuple = ()
    tool: str = "mwmesh"  # or "cgal_mesh"
    checked: bool = True  # by mwmesh verify


@dataclasses.dataclass(frozen=True)
class Facts:
    """What is known of a run; the parts are empty when it failed."""

    volume: str
    mode: str
    failure: str = ""
    run: dict = dataclasses.field(default_factory=dict)  # report of the mesher
    check: dict = dataclasses.field(default_factory=dict)  # report of mwmesh verify
    shape: dict = dataclasses.field(default_factory=dict)  # see shapes.py


class RunFailure(Exception):
    """Of a mesher or a check; says why in a line."""


class Runner:
    """Programs, and the folder that keeps their reports."""

    def __init__(self, programs, folder, repeat=1, threads=1, timeout=None):
        self._programs = programs  # path by tool
        self._folder = folder
        self._repeat = repeat
        self._threads = threads
        self._timeout = timeout
        self.commands = []  # each once, as a reader would type it

    def measure(self, volume, mode):
        """Meshes `volume` unless the reports are there.  A failure is part of the facts."""
        try:
            return self._measure(pathlib.Path(volume), mode)
        except RunFailure as failure:
            return Facts(pathlib.Path(volume).name, mode.name, failure=str(failure))

    def version(self):
        return self._call("mwmesh", ["--version"]).stdout.strip()

    def _measure(self, volume, mode):
        self._note(mode)
        folder = self._folder / volume.name / self._key(volume, mode)
        reports = [folder / f"run-{i}.json" for i in range(self._repeat)]
        check, shape = folder / "check.json", folder / "shape.json"
        for report in reports:
            if not report.exists():
                self._mesh(volume, mode, report)
        if not shape.exists() or (mode.checked and not check.exists()):
            if not (folder / WORK / MESH).exists():
                self._mesh(volume, mode, reports[0])
            self._look_at(volume, mode, folder)
        shutil.rmtree(folder / WORK, ignore_errors=True)
        return Facts(
            volume.name,
            mode.name,
            run=median_run([_load(report) for report in reports]),
            check=_load(check) if mode.checked else {},
            shape=_load(shape),
        )

    def _mesh(self, volume, mode, report):
        work = report.parent / WORK
        shutil.rmtree(work, ignore_errors=True)  # of a run that was stopped
        work.mkdir(parents=True)
        made = work / report.name
        arguments = self._arguments(volume, mode, work / MESH)
        self._call(mode.tool, arguments + ["--report", str(made)])
        made.rename(report)

    def _look_at(self, volume, mode, folder):
        mesh, made = folder / WORK / MESH, folder / WORK / "shape.json"
        self._execute([sys.executable, str(HERE / "shapes.py"), str(mesh), str(made)])
        made.rename(folder / "shape.json")
        if mode.checked:
            # Neither the paper nor its peers promise volumes; what fails is what the paper claims.
            bounds = ["--max-volume-error", "none"]
            report = ["--report", str(folder / "check.json")]
            self._call("mwmesh", ["verify", str(volume), str(mesh), *bounds, *report], CHECK_FAILED)

    def _arguments(self, volume, mode, mesh):
        if mode.tool != "mwmesh":
            return [str(volume), *mode.flags, "-o", str(mesh)]
        threads = ["--threads", str(self._threads)]
        return ["mesh", str(volume), *threads, *mode.flags, "-o", str(mesh)]

    def _note(self, mode):
        words = [mode.tool, *self._arguments("VOLUME", mode, MESH)]
        command = shlex.join(word.replace(f"{ROOT}/", "") for word in words)
        if command not in self.commands:
            self.commands.append(command)

    def _key(self, volume, mode):
        """Of the run's facts: another program, volume or setting has its own."""
        settings = " ".join(mode.flags)
        if mode.tool == "mwmesh":
            arguments = self._arguments(volume, mode, MESH)
            settings = self._call("mwmesh", arguments + ["--print-config"]).stdout
        if not volume.exists():
            raise RunFailure("no such file")
        state = volume.stat()
        parts = [mode.tool, self._program_digest(mode.tool), settings, str(volume.resolve())]
        parts += [str(state.st_size), str(state.st_mtime_ns)]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:12]

    @functools.lru_cache(maxsize=None)
    def _program_digest(self, tool):
        return hashlib.sha256(self._program(tool).read_bytes()).hexdigest()

    def _program(self, tool):
        program = pathlib.Path(self._programs[tool])
        if not program.exists():
            raise RunFailure(f"{tool} is not built")
        return program

    def _call(self, tool, arguments, also=0):
        return self._execute([str(self._program(tool)), *arguments], also)

    def _execute(self, command, also=0):
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=self._timeout, check=False
            )
        except subprocess.TimeoutExpired as late:
            raise RunFailure(f"stopped after {self._timeout:g} s") from late
        if done.returncode not in (0, also):
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            raise RunFailure(lines[-1].partition("error: ")[2] or lines[-1])
        return done


def median_run(reports):
    """The first report with times and memory of the median of all.  They must be of one mesh."""
    digests = {report.get("digest") for report in reports}
    if len(digests) > 1:
        raise RunFailure("repeated runs gave different meshes")
    run = dict(reports[0])
    run["performance"] = _median([report["performance"] for report in reports])
    return run


def _median(values):
    """Of numbers, or by key."""
    if isinstance(values[0], dict):
        return {key: _median([value[key] for value in values]) for key in values[0]}
    return statistics.median(values)


def _load(path):
    return json.loads(path.read_text(encoding="utf-8"))
