# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What servers sent is kept for later runs, and never taken for something else."""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time
import unittest

try:
    import numpy as np
    import remote_stores
except ImportError:
    raise SystemExit(77)
from program import PROGRAM, enter_folder, refused, run
from remote_server import Server

SECRET = "Bearer 5ecret-0f-the-test"
DOCUMENTS = ("info", "zarr.json", ".zarray", ".zattrs", ".zgroup", ".zmetadata", "attributes.json")


def files_of(folder):
    return [os.path.join(path, name) for path, _, names in os.walk(folder) for name in names]


def size_of(folder):
    return sum(os.path.getsize(file) for file in files_of(folder))


class Cache(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "41,36,40", "--labels", "7", "--seed", "3", "-o", "v.npy")
        cls.labels = np.load("v.npy").astype("<u8") + 1
        cls.labels[:16, :16, :16] = 0  # a chunk that is missing
        cls.digests = {}
        for name, write in remote_stores.KINDS.items():
            write(f"stores/{name}", cls.labels)
            run("mesh", f"stores/{name}", "-o", "m.vtkhdf", "--force")
            cls.digests[name] = run("digest", "m.vtkhdf")

    def setUp(self):
        shutil.rmtree("kept", ignore_errors=True)

    def check(self, server, name, cache="kept", digest=None):
        """Meshes it, and returns which files the server was asked for that it has and that are labels."""
        before = len(server.requests)
        run("mesh", f"{server.address}/{name}", "-o", "m.vtkhdf", "--force", "--cache", cache)
        self.assertEqual(run("digest", "m.vtkhdf"), digest or self.digests[name], name)
        asked = {path for path, _ in server.requests[before:]}
        return {path for path in asked
                if os.path.isfile("stores" + path) and os.path.basename(path) not in DOCUMENTS}

    def test_the_second_run_asks_for_no_labels(self):
        for name in remote_stores.KINDS:
            with self.subTest(name), Server("stores") as server:
                self.assertGreater(len(self.check(server, name)), 0)
                self.assertEqual(self.check(server, name), set())

    def test_a_fifth_of_the_requests_fails(self):
        for name in list(remote_stores.KINDS)[::2]:
            with self.subTest(name), Server("stores", 0.2, 7) as server:
                self.check(server, name)
                self.assertEqual(self.check(server, name), set())

    def test_kills_while_files_are_kept(self):
        chance = random.Random(5)
        with Server("stores", 0.02, 3) as server:
            for _ in range(20):
                name = chance.choice(list(remote_stores.KINDS))
                command = [PROGRAM, "mesh", f"{server.address}/{name}", "-o", "m.vtkhdf", "--force", "--cache", "kept"]
                process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(chance.uniform(0.0, 0.3))
                process.send_signal(signal.SIGKILL)
                process.wait()
            for name in remote_stores.KINDS:
                self.check(server, name)
                self.assertEqual(self.check(server, name), set())

    def test_damaged_files_are_fetched_again(self):
        chance = random.Random(6)
        for name in remote_stores.KINDS:
            with self.subTest(name), Server("stores") as server:
                shutil.rmtree("kept", ignore_errors=True)
                self.check(server, name)
                for file in files_of("kept"):
                    with open(file, "rb") as source:
                        content = bytearray(source.read())
                    way = chance.randrange(4)
                    if way == 0:
                        content = content[:chance.randrange(len(content))]
                    elif way == 1:
                        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
                    elif way == 2:
                        content += b"more"
                    with open(file, "wb") as target:
                        target.write(content)
                self.assertGreater(len(self.check(server, name)), 0)
                self.assertEqual(self.check(server, name), set())

    def test_exchanged_files_are_fetched_again(self):
        for name in remote_stores.KINDS:
            with self.subTest(name), Server("stores") as server:
                shutil.rmtree("kept", ignore_errors=True)
                self.check(server, name)
                files = sorted(files_of("kept"))
                contents = [pathlib.Path(file).read_bytes() for file in files]
                for file, content in zip(files, contents[1:] + contents[:1], strict=True):
                    pathlib.Path(file).write_bytes(content)
                self.assertGreater(len(self.check(server, name)), 0)
                self.assertEqual(self.check(server, name), set())

    def test_the_files_have_no_more_bytes_than_they_may(self):
        with Server("stores") as server:
            self.check(server, "precomputed")
            whole = size_of("kept")
            limit = whole // 2
            self.check(server, "precomputed", f"kept,{limit}")
            self.assertLessEqual(size_of("kept"), limit)
            self.assertGreater(size_of("kept"), limit // 2)

    def test_files_of_others_in_the_folder_stay(self):
        others = ["kept/notes.txt", "kept/ab/notes.txt", "kept/abc/" + 30 * "0"]
        for file in others:
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "wb") as target:
                target.write(bytes(1 << 20))
        with Server("stores") as server:
            self.check(server, "precomputed", "kept,4096")
        self.assertEqual([file for file in others if not os.path.exists(file)], [])

    def test_other_metadata_are_of_another_store(self):
        changed = self.labels[::-1].copy()
        shutil.rmtree("stores/changing", ignore_errors=True)
        remote_stores.KINDS["precomputed"]("stores/changing", self.labels)
        with Server("stores") as server:
            self.check(server, "changing", digest=self.digests["precomputed"])
            shutil.rmtree("stores/changing")
            remote_stores.KINDS["precomputed"]("stores/changing", changed)
            with open("stores/changing/info", encoding="utf-8") as file:
                info = file.read()
            with open("stores/changing/info", "w", encoding="utf-8") as file:
                file.write(info + " ")
            run("mesh", "stores/changing", "-o", "m.vtkhdf", "--force")
            self.check(server, "changing", digest=run("digest", "m.vtkhdf"))

    def test_secrets_are_not_kept(self):
        os.environ["MW_HTTP_AUTHORIZATION"] = SECRET
        try:
            with Server("stores") as server:
                self.check(server, "precomputed")
                self.assertEqual(server.requests[0][1].get("Authorization"), SECRET)
        finally:
            del os.environ["MW_HTTP_AUTHORIZATION"]
        self.assertEqual(os.stat("kept").st_mode & 0o077, 0)
        for file in files_of("kept"):
            with open(file, "rb") as source:
                self.assertNotIn(SECRET.encode(), source.read())

    def test_folders_that_cannot_be(self):
        with open("file", "w", encoding="utf-8"), Server("stores") as server:
            for cache, words in (("file", "cannot make the folder"), ("file/below", "cannot make the folder"),
                                 (",1G", "expected a folder"), ("kept,1X", "a size such as")):
                refused([words], "info", f"{server.address}/precomputed", "--cache", cache, code=2)


if __name__ == "__main__":
    unittest.main()
