# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""One case: volume and settings drawn from a number, run in several ways, held to all promises."""
import json
import math
import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
import traceback
from pathlib import Path

import settings as settings_of
import volumes

try:
    from netCDF4 import Dataset
except ImportError:
    Dataset = None

TIMEOUT = 600  # s; the slowest of these volumes takes a thirtieth of it on an idle core
REFUSALS = {  # the only ways in which these settings may be refused
    2: [r"quality-floor .* cannot be promised for voxels", r"--background: it is the only label",
        r"--parts .*: no part is that large"],
}
JUDGED = ("vtkhdf", "vtu", "mesh")


class Failed(Exception):
    """A promise was broken."""


class Refused(Exception):
    """The settings ask for what cannot be promised, and the program said so."""


class Case:
    def __init__(self, number, program, judge, folder, tell=None):
        self.number, self.program, self.judge, self.folder = number, program, judge, Path(folder)
        self.tell = tell or (lambda line: None)
        self.random = random.Random(number)
        self.commands, self.did = [], []

    # Running ------------------------------------------------------------------------------------

    def start(self, arguments):
        command = [self.program, *map(str, arguments)]
        self.commands.append("mwmesh " + shlex.join(command[1:]))
        self.tell(self.commands[-1])
        return subprocess.Popen(command, cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                errors="replace")

    def end(self, process):
        try:
            text, _ = process.communicate(timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Failed(f"still running after {TIMEOUT} s") from None
        return process.returncode, text

    def run(self, arguments, allowed=(0,)):
        code, text = self.end(self.start(arguments))
        if code not in allowed:
            raise Failed(f"exit code {code}\n{text}")
        return code, text

    def files(self, folder):
        return {p.name: p.read_bytes() for p in (self.folder / folder).iterdir() if p.is_file()}

    def entries(self, folder):
        return sorted(p.name for p in (self.folder / folder).iterdir())

    # The volume as the program ought to see it ----------------------------------------------------

    def prepared(self, settings):
        v = self.volume
        labels, shape = v.labels, v.shape
        if settings.crop:
            lo, hi = settings.crop
            shape = tuple(h - l for l, h in zip(lo, hi))
            labels = [
                labels[(z * v.shape[1] + y) * v.shape[0] + x]
                for z in range(lo[2], hi[2]) for y in range(lo[1], hi[1])
                for x in range(lo[0], hi[0])
            ]
        if settings.merged:
            labels = [settings.merged.get(label, label) for label in labels]
        return v.with_labels(labels, shape)

    def layered(self, volume):
        """Thick voxels cut into layers, as smooth surfaces take them."""
        least = min(volume.spacing)
        layers = [math.floor(h / least + 0.5) for h in volume.spacing]
        nx, ny, _ = volume.shape
        shape = tuple(n * k for n, k in zip(volume.shape, layers))
        labels = [
            volume.labels[(z // layers[2] * ny + y // layers[1]) * nx + x // layers[0]]
            for z in range(shape[2]) for y in range(shape[1]) for x in range(shape[0])
        ]
        out = volume.with_labels(labels, shape)
        out.spacing = tuple(h / k for h, k in zip(volume.spacing, layers))
        return out

    # Oracles --------------------------------------------------------------------------------------

    def mesh_arguments(self, output, extra=()):
        return ["mesh", self.volume.file, *self.volume.arguments, *self.settings.arguments(),
                "-o", output, *extra]

    def base_run(self):
        """The reference: one thread, undisturbed."""
        self.report = self.random.random() < 0.3
        extra = ["--report", "r.json"] if self.report else []
        (self.folder / "a").mkdir()
        begin = time.monotonic()
        code, text = self.run(
            self.mesh_arguments("a/" + self.settings.output, ["--threads=1", *extra]),
            allowed=(0, *REFUSALS))
        self.seconds = time.monotonic() - begin
        if code == 0:
            self.expected = self.files("a")
            self.check_base_files()
            return
        if not any(re.search(reason, text) for reason in REFUSALS[code]):
            raise Failed(f"exit code {code} for no good reason\n{text}")
        if self.entries("a") or (self.folder / "r.json").exists():
            raise Failed(f"a refused run left files: {self.entries('a')}")
        raise Refused(text)

    def check_base_files(self):
        stem = self.settings.output.split(".")[0] + "."
        others = [name for name in self.entries("a") if not name.startswith(stem)]
        folders = [p.name for p in (self.folder / "a").iterdir() if p.is_dir()]
        if others or folders or self.settings.output not in self.expected:
            raise Failed(f"files after the run: {self.entries('a')}")

    def digest(self, path):
        return self.run(["digest", path])[1].strip()

    def check_report(self):
        if not self.report:
            return
        report = json.loads((self.folder / "r.json").read_text())
        if report["digest"] != self.digest("a/" + self.settings.output):
            raise Failed("the report has another digest than the file")

    def verify(self):
        arguments = settings_of.verify_arguments(self.random, self.settings)
        self.run(["verify", self.volume.file, *self.volume.arguments, *arguments,
                  "a/" + self.settings.output])

    def converted(self):
        """Any format holds the same mesh.  The path of the one made."""
        other = self.random.choice(settings_of.FORMATS)
        if self.random.random() < 0.5:
            other = self.random.choice(JUDGED)
        if "cohesive" in self.settings.flags and other == "mesh":
            other = "vtu"  # .mesh has no place for wedges
        (self.folder / "c").mkdir()
        path = "c/c." + other
        self.run(["convert", "a/" + self.settings.output, path])
        if self.digest(path) != self.digest("a/" + self.settings.output):
            raise Failed(f"{path} has another digest")
        return path

    def exodus(self):
        """In Exodus the node set of a name has the id of its side set, and no id has two names."""
        if Dataset is None or "cohesive" in self.settings.flags or self.random.random() < 0.5:
            return
        self.run(["convert", "a/" + self.settings.output, "x.exo", "--element", "tet4"])
        sets = {}
        with Dataset(self.folder / "x.exo") as file:
            for kind in ("ss", "ns"):
                if kind + "_names" not in file.variables:
                    continue
                rows = file[kind + "_names"][:].filled(b"")
                names = [b"".join(row).decode() for row in rows]
                sets[kind] = dict(zip(names, file[kind + "_prop1"][:].tolist()))
        sides, nodes = sets.get("ss", {}), sets.get("ns", {})
        if len(set(sides.values())) < len(sides) or nodes != {n: sides.get(n) for n in nodes}:
            raise Failed(f"ids of sets in Exodus: sides {sides}, nodes {nodes}")
        self.did.append("exodus")

    def curved(self):
        """Curved tets of the same mesh are positive, and their labels what they were."""
        if ({"split", "cohesive", "open-hinges"} & set(self.settings.flags)
                or self.settings.output.split(".")[1] not in settings_of.KEEP_PROMISES
                or self.random.random() < 0.6):
            return
        (self.folder / "k").mkdir()
        path = "k/k." + self.random.choice(("vtu", "vtkhdf"))
        self.run(["convert", "a/" + self.settings.output, path, "--element", "tet10-curved"])
        arguments = [f"--{name}={value}" for name, value in self.settings.prepare.items()]
        text = self.run(["verify", self.volume.file, *self.volume.arguments, *arguments, path])[1]
        if "P2 Jacobians" not in text:
            raise Failed("verify does not look at Jacobians")
        self.did.append("curved")

    def judged(self, converted):
        """Another program's opinion, where there is one and it can read what was made."""
        meshes = [p for p in ("a/" + self.settings.output, converted)
                  if p.rsplit(".", 1)[1] in JUDGED]
        if max(self.volume.values()) > 2**63 - 1:  # the judge reads no such number in a text
            meshes = [p for p in meshes if not p.endswith(".mesh")]
        flags = self.settings.flags
        if (self.judge is None or not meshes or self.volume.turned
                or {"element", "split", "cohesive", "open-hinges"} & set(flags)
                or self.settings.chosen or self.settings.changes_voxels()):
            return
        volume = self.prepared(self.settings)
        if self.settings.is_smooth():
            volume = self.layered(volume)
        volumes.write_npy(self.folder / "j.npy", volume)
        command = [self.judge, "--volume", "j.npy", "--mesh", meshes[0], "--threads", "1",
                   "--spacing", volumes.triple(volume.spacing),
                   "--origin", volumes.triple(volume.origin), "--require-positive",
                   "--min-radius-ratio", self.settings.floor()]
        if self.settings.max_distance() is not None:
            command += ["--max-distance", repr(self.settings.max_distance())]
        self.commands.append(shlex.join(["judge", *command[1:]]))
        self.tell(self.commands[-1])
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True,
                              timeout=TIMEOUT, check=False)
        if done.returncode != 0:
            raise Failed(f"the judge ends with {done.returncode}\n{done.stdout}{done.stderr}")
        self.did.append("judged")

    def same_labels(self):
        """What has to be made labels of is meshed as an array of these labels is."""
        if self.volume.is_plain:
            return
        (self.folder / "l").mkdir()
        volumes.write_npy(self.folder / "l.npy", self.volume)
        common = ["--frame=voxel", "--spacing", volumes.triple(self.volume.spacing),
                  "--surface=voxel", "--quality-floor=0", "--max-distance=none", "--background=none"]
        self.run(["mesh", self.volume.file, *self.volume.meaning, *common, "-o", "l/v.vtu"])
        self.run(["mesh", "l.npy", *common, "-o", "l/l.vtu"])
        if self.digest("l/v.vtu") != self.digest("l/l.vtu"):
            raise Failed("labels that are made from the file are others than those of an array")
        self.did.append("scored" if self.volume.has_scores else "masked")

    # Ways to run that must not matter -------------------------------------------------------------

    def disturbed_run(self):
        """Draws threads, budget and kills; the files must come out as they did before."""
        (self.folder / "b").mkdir()
        draw = self.random
        way = draw.choice(["threads", "budget", "budget", "kill", "kill", "signal", "change"])
        if way == "change":
            self.changed_run()
        kills = draw.randint(1, 3) if way in ("kill", "signal") else 0
        for _ in range(kills):
            self.stopped_run(signal.SIGKILL if way == "kill" else
                             draw.choice([signal.SIGTERM, signal.SIGINT]))
        mib = 1 if way == "budget" else None
        while mib := self.run_within(mib, resume=kills > 0):
            kills = 1
        self.check_same()
        self.did.append(way)

    def run_within(self, mib, resume):
        """Nothing when the mesh is there, else what the program asks for when it has too little."""
        extra = self.schedule(mib) + (["--resume"] if resume else [])
        arguments = self.mesh_arguments("b/" + self.settings.output, extra)
        code, text = self.run(arguments, (0, 4) if mib else (0,))
        if code == 0:
            return None
        if self.settings.output in self.entries("b"):
            raise Failed("exit code 4 and a mesh")
        # Of specks in large slices no more is known yet than what two of them take.
        told = re.search(r"--memory (\d+)MiB", text)
        if not told or int(told[1]) <= mib:
            raise Failed(f"no better budget than {mib} MiB is told\n{text}")
        return int(told[1])

    def schedule(self, mib=None):
        """Flags that are no part of the result."""
        draw = self.random
        out = [f"--threads={draw.randint(1, 6)}", f"--save-every={draw.choice([0, 0.01, 0.1, 10])}"]
        return out + ([f"--memory={mib}MiB"] if mib else [])

    def stopped_run(self, number):
        """One attempt, stopped after a random share of the time that a whole run takes."""
        after = self.random.uniform(0, 1.1) * self.seconds
        extra = [*self.schedule(), "--resume"]
        process = self.start(self.mesh_arguments("b/" + self.settings.output, extra))
        try:
            process.wait(after)
        except subprocess.TimeoutExpired:
            process.send_signal(number)
        code, text = self.end(process)
        # SIGTERM ends it at once until it is watched for.
        allowed = (0, -9) if number == signal.SIGKILL else (0, 75, 130, -number)
        if code not in allowed:
            raise Failed(f"exit code {code} after {number.name}\n{text}")
        if code == 0:
            self.check_same()
        elif self.settings.output in self.entries("b"):
            if (self.folder / "b" / self.settings.output).read_bytes() != \
                    self.expected[self.settings.output]:
                raise Failed(f"after {number.name} there is another mesh")
        if code == 75 and not any(name.endswith(".work") for name in self.entries("b")):
            raise Failed("exit code 75 without a work folder")

    def changed_run(self):
        """Writes other labels into the file under a run, which meshes what it read first or says
        so; then the file is as it was."""
        path = self.folder / self.volume.file
        if not self.volume.is_plain:
            return
        if path.suffix == ".gz" or b"gzip" in path.read_bytes()[:400]:
            return  # unpacked once, at the start
        before = path.read_bytes()
        after = self.random.uniform(0, 1) * self.seconds
        process = self.start(self.mesh_arguments("b/" + self.settings.output, self.schedule()))
        try:
            process.wait(after)
        except subprocess.TimeoutExpired:
            labels = volumes.packed(volumes.changed(self.random, self.volume))
            with open(path, "r+b") as file:
                file.seek(len(before) - len(labels))
                file.write(labels)
        code, text = self.end(process)
        path.write_bytes(before)
        self.remove_work()
        names_labels = self.settings.names_labels() or "size" in self.settings.flags
        if code not in (0, 3) and not (code == 2 and names_labels):
            raise Failed(f"exit code {code} after labels changed under the run\n{text}")
        if code == 3 and "changed while it was read" not in text:
            raise Failed(f"nothing is said of labels that changed under the run\n{text}")

    def remove_work(self):
        for path in sorted((self.folder / "b").rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()

    def check_same(self):
        """The files are those of the undisturbed run, and no others: what killed runs had no chance
        to clear away is gone as well.  Then they go."""
        found = self.files("b")
        others = sorted(set(found) ^ set(self.expected))
        if others or any(p.is_dir() for p in (self.folder / "b").iterdir()):
            raise Failed(f"files after the run: {self.entries('b')}, not {list(self.expected)}")
        for name, content in self.expected.items():
            if found[name] != content:
                raise Failed(f"{name} has other bytes than that of the undisturbed run")
        self.remove_work()

    # Edits ----------------------------------------------------------------------------------------

    def edited_runs(self):
        """A chain of edits, meshed from what the runs before have kept, some of them killed: the
        files are those of runs that begin afresh."""
        if not self.volume.is_plain:
            return
        path, flags = self.folder / self.volume.file, self.settings.flags
        named = self.settings.names_labels() or "size" in flags or "split" in flags
        if named or "count" in flags or flags.get("order") == "raster" or path.suffix == ".gz":
            return  # labels that are named may vanish
        before = path.read_bytes()
        if b"gzip" in before[:400]:
            return
        flags["order"] = "colour"
        kept, volume = ["--keep=kept"], self.volume
        if self.random.random() < 0.4:
            kept.append(f"--keep-bytes={self.random.choice([100_000, 1_000_000, 10_000_000])}")
        for folder in ("e", "f"):
            (self.folder / folder).mkdir()
        for _ in range(self.random.randint(2, 4)):
            if kept[0] == "--from=kept" and self.random.random() < 0.3:
                self.killed_run(kept)
            early = self.badly_told_run() if kept[0] == "--from=kept" else None
            self.run(self.mesh_arguments("e/" + self.settings.output, [*self.schedule(), *kept]))
            self.run(self.mesh_arguments("f/" + self.settings.output, ["--threads=1"]))
            if self.files("e") != self.files("f"):
                raise Failed("after an edit the mesh is another one than that of a fresh run")
            if early not in (None, self.files("f")):
                raise Failed("an edit that --changed did not tell gave a stale mesh")
            meshed = volume
            volume, changed = self.edit(meshed, before)
            kept = ["--from=kept"]
            if self.random.random() < 0.5:
                kept.append(changed)
        if self.random.random() < 0.5:
            self.mixed_folders(meshed, before)
        path.write_bytes(before)
        self.did.append("edited")

    def edit(self, volume, file):
        """The volume edited, in the place of that in the file, and the flag that tells where."""
        volume, lo, hi = volumes.edited(self.random, volume)
        labels = volumes.packed(volume)
        (self.folder / self.volume.file).write_bytes(file[:len(file) - len(labels)] + labels)
        return volume, "--changed=" + ",".join(map(str, lo + hi))

    def mixed_folders(self, meshed, file):
        """Some files of the folder of another edit are refused, or make no difference."""
        other, kept = self.folder / "other", self.folder / "kept"
        self.edit(meshed, file)
        self.run(self.mesh_arguments("f/" + self.settings.output, ["--keep=other"]))
        _, changed = self.edit(meshed, file)
        self.run(self.mesh_arguments("f/" + self.settings.output, ["--threads=1"]))
        names = sorted(path.name for path in other.iterdir())
        for name in self.random.sample(names, self.random.randint(1, 2)):
            shutil.copy(other / name, kept / name)
        code, text = self.end(self.start(self.mesh_arguments(
            "e/" + self.settings.output, [*self.schedule(), "--from=kept", changed])))
        is_refused = code == 3 and "is damaged: delete that folder" in text
        if is_refused or (code == 2 and "labels have changed outside of its boxes" in text):
            self.did.append("mixed, refused")
        elif code != 0 or self.files("e") != self.files("f"):
            raise Failed(f"files of another folder were not noticed, exit code {code}\n{text}")
        else:
            self.did.append("mixed")

    def badly_told_run(self):
        """An edit, and a box that need not hold it: the program refuses, or reads it all the same.
        Returns the files of a run that ended well."""
        if self.random.random() < 0.6:
            return None
        lo = [self.random.randrange(n) for n in self.volume.shape]
        box = ",".join(map(str, lo + [n + 1 for n in lo]))
        code, text = self.run(self.mesh_arguments("e/" + self.settings.output, [
            *self.schedule(), "--from=kept", "--changed=" + box]), allowed=(0, 2))
        if code == 0:
            return self.files("e")
        if "labels have changed outside of its boxes" not in text:
            raise Failed(f"exit code 2 for no good reason\n{text}")
        self.did.append("refused-edit")
        return None

    def killed_run(self, kept):
        process = self.start(self.mesh_arguments("e/" + self.settings.output,
                                                 ["--save-every=0", *kept]))
        try:
            process.wait(self.random.uniform(0, 1.1) * self.seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
        code, text = self.end(process)
        if code not in (0, -9):
            raise Failed(f"exit code {code} after SIGKILL\n{text}")

    # All of it ------------------------------------------------------------------------------------

    def check(self):
        """ERRORS: Failed, Refused."""
        self.volume = volumes.draw(self.random, self.folder, self.run)
        self.settings = settings_of.draw(
            self.random, self.volume, lambda settings: self.prepared(settings).values())
        self.same_labels()
        self.base_run()
        self.verify()
        self.check_report()
        self.judged(self.converted())
        self.exodus()
        self.curved()
        self.disturbed_run()
        if self.random.random() < 0.5:
            self.edited_runs()
        self.did.append("meshed")
        return self.did


def run_case(number, program, judge, keep=False, tell=None):
    """What was done, or the failure.  Returns (verdict, list of words or text)."""
    folder = tempfile.mkdtemp(prefix=f"campaign-{number}-") if keep else None
    with tempfile.TemporaryDirectory() as passing:
        case = Case(number, program, judge, folder or passing, tell)
        os.makedirs(case.folder, exist_ok=True)
        try:
            return "ok", case.check()
        except Refused:
            return "ok", ["refused"]
        except Exception as failure:  # a fault of the campaign's own is to be seen as well
            why = str(failure) if isinstance(failure, Failed) else traceback.format_exc()
            return "failed", "\n".join([f"$ {line}" for line in case.commands] + [why])
