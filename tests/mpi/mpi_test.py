#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""mwmesh-mpi under mpirun: the bytes of mwmesh, errors, killed ranks, and going on from them.

MW_PROGRAM and MW_TEST_MPI_PROGRAM name the programs; skipped (77) where there is no mpirun.
Its longer form: mpi_test.py --kills 50 [--seed 1]."""

import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.environ.get("MW_PROGRAM", "mwmesh")
SHARED = os.environ.get("MW_TEST_MPI_PROGRAM", "mwmesh-mpi")
LIMIT = 120  # seconds, of a run
KILLS = 6
SEED = 1


def environment():
    allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    return {**os.environ, **allowed}


def mpirun(ranks, *arguments):
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks), SHARED,
            *map(str, arguments)]


def digest(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def children_of(name, parent):
    """Process ids of programs of that name below a process."""
    parents, found = {}, []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            stat = (entry / "stat").read_text()
        except OSError:
            continue
        command = stat[stat.index("(") + 1:stat.rindex(")")]
        parents[int(entry.name)] = int(stat[stat.rindex(")") + 2:].split()[1])
        if command == name[:15]:
            found.append(int(entry.name))

    def is_below(process):
        while process > 1:
            if process == parent:
                return True
            process = parents.get(process, 0)
        return False

    return sorted(p for p in found if is_below(p))


class SharedRuns(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="mwmesh-mpi-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.volume = self.folder / "v.npy"

    def synth(self, kind, shape, labels):
        subprocess.run([PROGRAM, "synth", kind, "--shape", shape, "--labels", str(labels),
                        "--seed", "3", "-o", self.volume], check=True, capture_output=True)

    def alone(self, *options):
        out = self.folder / "alone.vtkhdf"
        subprocess.run([PROGRAM, "mesh", self.volume, "-o", out, "--certify", "off", *options],
                       check=True, capture_output=True)
        return digest(out)

    def command(self, ranks, *options):
        return mpirun(ranks, "mesh", self.volume, "-o", self.folder / "shared.vtkhdf", *options)

    def run_shared(self, ranks, *options):
        return subprocess.run(self.command(ranks, *options), capture_output=True, text=True,
                              timeout=LIMIT, env=environment())

    def expect_same(self, ranks, expected, *options):
        with self.subTest(ranks=ranks, options=options):
            done = self.run_shared(ranks, *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(digest(self.folder / "shared.vtkhdf"), expected)
            self.assertFalse((self.folder / "shared.vtkhdf.work").exists())

    def test_bytes_are_those_of_one_process(self):
        self.synth("voronoi", "48,56,64", 30)
        for order in ("raster", "colour"):
            expected = self.alone("--order", order)
            for ranks in (1, 2, 3, 4, 8):
                self.expect_same(ranks, expected, "--order", order, "--threads", str(2 * ranks),
                                 "--certify", "off")

    def test_a_count_is_met_by_the_mesh_of_one_process(self):
        self.synth("voronoi", "64,64,64", 60)
        options = ["--count", "8000", "--certify", "off"]  # the first mesh misses it
        report = self.folder / "r.json"
        expected = self.alone("--count", "8000", "--report", report)
        pilot = json.loads(report.read_text())["size"]["count"]["pilot"]
        self.assertGreater(pilot["voxels"], 64 ** 3)
        self.expect_same(2, expected, *options)

    def test_passes_and_formats_are_those_of_one_process(self):
        self.synth("spheres", "24,24,40", 6)
        for output, options in (
                ("m.vtkhdf", ["--order", "raster"]),
                ("m.vtkhdf", ["--element", "tet10-curved"]),
                ("m.vtkhdf", ["--size", "1.3"]),
                ("m.vtkhdf", ["--periodic", "xyz"]),
                ("m.vtkhdf", ["--sample", f"x={self.volume}:mean"]),
                ("m.vtu", ["--background", "0", "--parts", "3", "--split", "*"]),
                ("m.inp", ["--background", "0", "--cohesive", "*"]),
                ("m.msh", ["--element", "tet10", "--open-hinges"])):
            with self.subTest(output=output, options=options):
                options = ["--window", "8", "--certify", "off", *options]
                made = []
                for command in ([PROGRAM], mpirun(3)):
                    path = self.folder / output
                    done = subprocess.run([*command, "mesh", self.volume, "-o", path, *options],
                                          capture_output=True, text=True, timeout=LIMIT,
                                          env=environment())
                    self.assertEqual(done.returncode, 0, done.stderr)
                    made.append(digest(path))
                    path.unlink()
                self.assertEqual(made[0], made[1])

    def test_the_report_is_that_of_one_process(self):
        self.synth("voronoi", "40,48,56", 20)
        options = ["--window", "8", "--size", "3=4"]
        one, all_of_them = self.folder / "one.json", self.folder / "all.json"
        self.alone(*options, "--report", one)
        alone = json.loads(one.read_text())
        shape = alone.pop("shape")
        for more in ([], ["--html", self.folder / "page.html"], ["--certify", "on"]):
            done = self.run_shared(3, *options, "--report", all_of_them, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            shared = json.loads(all_of_them.read_text())
            for part in ("input", "lattice", "parts", "quality", "size", "digest"):
                self.assertEqual(shared[part], alone[part], part)
            if not more:
                self.assertEqual(shared["shape"], shape)
        self.assertTrue((self.folder / "page.html").exists())
        self.assertIn("longest_edge", json.dumps(shape["per_label"]))
        self.assertTrue(shared["certificate"]["made"])

    def limit_files(self, run, rank, size):
        """From now on that rank of a run cannot write beyond `size` bytes of any file."""
        victims = []
        while run.poll() is None and not victims:
            if any(self.folder.glob(".shared.vtkhdf.partial-*")):
                victims = [p for p in children_of(pathlib.Path(SHARED).name, run.pid)
                           if f"OMPI_COMM_WORLD_RANK={rank}\0".encode()
                           in pathlib.Path(f"/proc/{p}/environ").read_bytes()]
            time.sleep(0.01)
        self.assertEqual(len(victims), 1)
        resource.prlimit(victims[0], resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

    def test_the_rank_that_writes_ends_all_when_it_cannot_and_leaves_nothing(self):
        self.synth("voronoi", "64,64,80", 40)
        run = subprocess.Popen(self.command(3, "--window", "8", "--order", "colour",
                                            "--certify", "off", "--save-every", "1000"),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env=environment())
        self.limit_files(run, 0, 100_000)
        _, err = run.communicate(timeout=LIMIT)
        self.assertEqual(run.returncode, 4, err)
        self.assertIn("File too large", err)
        self.assertEqual(err.count("mwmesh: error:"), 1, err)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["v.npy"])

    def test_under_a_tight_budget_and_with_epochs(self):
        self.synth("spheres", "64,64,96", 8)
        expected = self.alone()
        for ranks in (2, 4):
            # A rank's share of the budget is near the least that works.
            self.expect_same(ranks, expected, "--memory", f"{64 * ranks}MiB", "--certify", "off",
                             "--save-every", "0.2")

    def test_the_memory_that_is_asked_for_is_that_of_the_machine(self):
        self.synth("voronoi", "40,40,48", 20)
        expected = self.alone()
        budget = "3MiB"
        for _ in range(8):
            done = self.run_shared(3, "--memory", budget, "--certify", "off")
            if done.returncode == 0:
                break
            self.assertEqual(done.returncode, 4, done.stderr)
            budget = re.search(r"--memory (\d+MiB)", done.stderr).group(1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(digest(self.folder / "shared.vtkhdf"), expected)

    def test_rank_0_checks_and_reports(self):
        self.synth("spheres", "40,40,40", 4)
        report = self.folder / "r.json"
        done = self.run_shared(3, "--certify", "on", "--report", report)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("P3 radius ratio, P4 distance and P8 volumes hold", done.stdout)
        self.assertEqual(done.stdout.count("vertices"), 1)
        self.assertTrue(report.exists())

    def test_errors_are_told_once(self):
        self.volume.write_bytes(b"no volume")
        done = self.run_shared(3)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("mwmesh: error:"), 1, done.stderr)
        self.assertFalse((self.folder / "shared.vtkhdf").exists())

    def test_only_mesh_is_shared(self):
        done = subprocess.run(mpirun(2, "info", self.volume), capture_output=True, text=True,
                              timeout=LIMIT, env=environment())
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("mwmesh-mpi shares out mesh", done.stderr)

    def test_help_is_printed_once(self):
        done = subprocess.run(mpirun(3, "mesh", "--help"), capture_output=True, text=True,
                              timeout=LIMIT, env=environment())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("--max-distance"), 1)

    def kill_a_rank(self, chance, ranks, resume):
        """Starts a run, kills one of its processes after a while; whether the mesh was done."""
        options = ["--certify", "off", "--save-every", "0.2"] + (["--resume"] if resume else [])
        run = subprocess.Popen(self.command(ranks, *options), stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, env=environment())
        time.sleep(chance.uniform(0.5, 4))
        victims = children_of(pathlib.Path(SHARED).name, run.pid)
        if victims:
            os.kill(chance.choice(victims), signal.SIGKILL)
        begun = time.monotonic()
        _, err = run.communicate(timeout=LIMIT)
        self.assertLess(time.monotonic() - begun, 60)
        if run.returncode == 0:
            return True
        self.assertNotIn("internal", err)
        return (self.folder / "shared.vtkhdf").exists()  # then it was complete before the kill

    def test_killed_ranks_lose_nothing_that_counts(self):
        chance = random.Random(SEED)
        self.synth("voronoi", "64,64,80", 40)
        expected = self.alone()
        kills = went_on = 0
        while kills < KILLS:
            shutil.rmtree(self.folder / "shared.vtkhdf.work", ignore_errors=True)
            (self.folder / "shared.vtkhdf").unlink(missing_ok=True)
            resume = False
            for _ in range(3):
                if self.kill_a_rank(chance, chance.choice([2, 3, 4]), resume):
                    break
                kills += 1
                resume = (self.folder / "shared.vtkhdf.work" / "epochs").exists()
                went_on += resume
            else:
                ranks = chance.choice([1, 2, 3, 4])
                self.expect_same(ranks, expected, "--certify", "off",
                                 *(["--resume"] if resume else []))
                continue
            self.assertEqual(digest(self.folder / "shared.vtkhdf"), expected)
        print(f"{kills} kills, {went_on} times gone on from an epoch", file=sys.stderr)
        self.assertGreater(went_on, 0)

    def test_one_process_meshes_edits_of_what_several_have_kept(self):
        self.synth("voronoi", "48,56,64", 30)
        expected = self.alone("--order", "colour")
        kept = self.folder / "kept"
        for ranks in (2, 3):
            shutil.rmtree(kept, ignore_errors=True)
            self.expect_same(ranks, expected, "--certify", "off", "--keep", kept)
            self.assertFalse(list(kept.glob("part-*")))
            report = self.folder / "report.json"
            self.assertEqual(self.alone("--force", "--from", kept, "--report", report), expected)
            marches = json.loads(report.read_text())["engine"]["remesh"]["marches"]
            self.assertEqual([march["visited"] for march in marches], [0] * len(marches))

    def test_what_was_kept_is_gone_on_with_by_one_process(self):
        self.synth("voronoi", "64,64,80", 40)
        expected = self.alone("--order", "colour")
        kept = self.folder / "kept"
        run = subprocess.Popen(self.command(3, "--certify", "off", "--keep", kept,
                                            "--save-every", "0.1"),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env=environment())
        while run.poll() is None and not list(kept.glob("part-*/windows")):
            time.sleep(0.01)
        time.sleep(0.5)
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=60)
        if run.returncode == 0:
            self.skipTest("the run was over before the signal")
        for options in (["--keep", kept, "--resume"], ["--from", kept]):
            refused = self.run_shared(2, "--force", *options)
            self.assertEqual(refused.returncode, 2, refused.stderr)
            self.assertIn("without mpirun", refused.stderr)
        self.assertEqual(self.alone("--force", "--keep", kept, "--resume"), expected)

    def end_by_signal(self, number, epochs):
        """Starts a run and sends mpirun a signal once an epoch counts; its exit code."""
        run = subprocess.Popen(self.command(3, "--certify", "off", "--save-every", "0.1"),
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               env=environment())
        while run.poll() is None and not epochs.exists():
            time.sleep(0.01)
        ranks = children_of(pathlib.Path(SHARED).name, run.pid)
        run.send_signal(number)
        _, err = run.communicate(timeout=60)
        begun = time.monotonic()
        while any(pathlib.Path(f"/proc/{r}").exists() for r in ranks):
            self.assertLess(time.monotonic() - begun, 60, "ranks are left")
            time.sleep(0.05)
        return run.returncode, err

    def test_signals_end_all_and_lose_nothing_that_counts(self):
        self.synth("voronoi", "96,96,128", 90)
        expected = self.alone()
        epochs = self.folder / "shared.vtkhdf.work" / "epochs"
        for number in (signal.SIGUSR1, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(signal=number):
                code, err = self.end_by_signal(number, epochs)
                if code == 0:
                    self.skipTest("the run was over before the signal")
                if number == signal.SIGUSR1:
                    self.assertEqual(code, 75, err)
                    self.assertIn("add --resume", err)
                    self.assertTrue(epochs.exists())
                resume = ["--resume"] if epochs.exists() else []
                self.expect_same(2, expected, "--certify", "off", *resume)
                (self.folder / "shared.vtkhdf").unlink()

    def test_files_of_others_stay_in_a_folder_that_is_named_as_the_work_folder(self):
        self.synth("voronoi", "16,16,16", 3)
        for name in ("epochs", "gen-0000/thesis", "gen-0001/rank-0000/blocks", "lock"):
            with self.subTest(name):
                path = self.folder / "u" / name
                path.parent.mkdir(parents=True)
                path.write_text("precious")
                refused = self.run_shared(2, "--workdir", self.folder / "u")
                self.assertEqual(refused.returncode, 2, refused.stderr)
                self.assertIn("is no work folder of mwmesh-mpi", refused.stderr)
                self.assertEqual(path.read_text(), "precious")
                shutil.rmtree(self.folder / "u")

    def test_saved_work_is_not_overwritten_or_mixed(self):
        chance = random.Random(SEED)
        self.synth("voronoi", "64,64,80", 40)
        epochs = self.folder / "shared.vtkhdf.work" / "epochs"
        for _ in range(20):
            if self.kill_a_rank(chance, 2, False):
                (self.folder / "shared.vtkhdf").unlink()
                shutil.rmtree(epochs.parent, ignore_errors=True)
            if epochs.exists():
                break
        self.assertTrue(epochs.exists())
        refused = self.run_shared(2)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("add --resume", refused.stderr)
        other = self.run_shared(2, "--resume", "--quality-floor", "0.1")
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertIn("quality-floor was", other.stderr)
        epochs.write_text("generation = x\n")
        damaged = self.run_shared(2, "--resume")
        self.assertEqual(damaged.returncode, 3, damaged.stderr)
        self.assertIn("delete that folder", damaged.stderr)


def main():
    global KILLS, SEED
    if shutil.which("mpirun") is None or not os.access(SHARED, os.X_OK):
        print("skipped: no mpirun or no mwmesh-mpi")
        return 77
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, default=KILLS)
    parser.add_argument("--seed", type=int, default=SEED)
    arguments, rest = parser.parse_known_args()
    KILLS, SEED = arguments.kills, arguments.seed
    result = unittest.main(argv=[sys.argv[0], *rest], exit=False).result
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
