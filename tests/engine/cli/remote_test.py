# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Remote volumes: the same meshes as from files, whatever the server does, or a clear error."""
import gzip
import json
import os
import shutil
import signal
import subprocess
import threading
import time
import unittest

try:
    import numpy as np
    import remote_stores
except ImportError:
    raise SystemExit(77)
from program import PROGRAM, enter_folder, refused, run, start
from remote_server import Server

SECRET = "Bearer 5ecret-0f-the-test"


def mesh(volume, output="remote.vtkhdf", *more, code=0):
    return run("mesh", volume, "-o", output, "--force", *more, code=code)


class Remote(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "41,36,40", "--labels", "7", "--seed", "3", "-o", "v.npy")
        labels = np.load("v.npy").astype("<u8") + 1
        labels[:16, :16, :16] = 0  # a chunk that is missing
        np.save("v.npy", labels)
        cls.digests = {}
        for name, write in remote_stores.KINDS.items():
            write(f"stores/{name}", labels)
            mesh(f"stores/{name}", f"{name}.vtkhdf")
            cls.digests[name] = run("digest", f"{name}.vtkhdf")
        cls.labels = labels

    def check(self, server, name, *more):
        mesh(f"{server.address}/{name}", "remote.vtkhdf", *more)
        self.assertEqual(run("digest", "remote.vtkhdf"), self.digests[name], name)

    def fails(self, code, address, *pieces, command="info"):
        done = start(command, address, "--scale", "0")
        self.assertEqual(done.returncode, code, done.stderr)
        for piece in pieces:
            self.assertIn(piece, done.stderr)

    def test_each_store_gives_the_mesh_of_its_files(self):
        mesh("v.npy", "npy.vtkhdf", "--spacing", "4")
        self.assertEqual(run("digest", "npy.vtkhdf"), self.digests["precomputed"])
        with Server("stores") as server:
            for name in remote_stores.KINDS:
                with self.subTest(name):
                    self.check(server, name)
                    run("verify", f"{server.address}/{name}/", "remote.vtkhdf")
            run("info", server.address.replace("http", "HTTP") + "/zarr2", "--scale", "0")

    def test_several_requests_wait_at_once_on_one_thread(self):
        """In all passes: the first and the last of a run are those for labels and for its check."""
        with Server("stores") as server:
            server.wait = 0.05
            address = f"{server.address}/precomputed"
            for command in (["mesh", address, "-o", "remote.vtkhdf", "--force", "--threads", "1",
                             "--certify", "on"],
                            ["verify", address, "remote.vtkhdf", "--threads", "1"],
                            ["info", address, "--scale", "0"]):
                with self.subTest(command[0]):
                    server.waiting = []
                    run(*command)
                    self.assertGreater(max(server.waiting[:20]), 1)
                    self.assertGreater(max(server.waiting[-20:]), 1)
                    self.assertLessEqual(max(server.waiting), 8)
            self.assertEqual(run("digest", "remote.vtkhdf"), self.digests["precomputed"])

    def test_several_requests_wait_at_once_before_a_run(self):
        """Where labels are looked through for an object, for specks and for what is welded."""
        with Server("stores") as server:
            for steps in (["--object", "3,4,5"], ["--drop-specks", "9"], ["--weld", "0"]):
                with self.subTest(steps[0]):
                    server.wait, server.waiting = 0.05, []
                    facts = json.loads(run("info", f"{server.address}/zarr2", "--scale", "0",
                                           "--json", *steps))
                    paths = [path for path, _ in server.requests[-len(server.waiting):]]
                    first = next(i for i, path in enumerate(paths) if path[-1].isdigit())
                    self.assertGreater(max(server.waiting[first:first + 20]), 1)
                    self.assertLessEqual(max(server.waiting), 8)
                    local = json.loads(run("info", "stores/zarr2", "--scale", "0", "--json", *steps))
                    self.assertEqual(facts["labels"], local["labels"])

    def test_a_run_without_a_cache_tells_of_it(self):
        with Server("stores") as server:
            for more, is_told in ((["--cache", "told"], False), ([], True)):
                done = start("mesh", f"{server.address}/n5", "-o", "told.vtkhdf", "--force", *more)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual("with --cache DIR" in done.stderr, is_told, done.stderr)
        self.assertNotIn("--cache", start("mesh", "v.npy", "-o", "told.vtkhdf", "--force").stderr)

    def test_a_fifth_of_the_requests_fails(self):
        failed = 0
        for seed in range(5):
            for name in remote_stores.KINDS:
                with self.subTest(name, seed=seed), Server("stores", 0.2, seed) as server:
                    self.check(server, name)
                    failed += server.failed
        self.assertGreater(failed, 200)

    def test_gzipped_files_of_a_copied_bucket(self):
        remote_stores.precomputed("stores/packed", self.labels, ".gz")
        with Server("stores") as server:
            self.digests["packed"] = self.digests["precomputed"]
            self.check(server, "packed")

    def test_bodies_that_the_server_packs(self):
        with Server("stores") as server:
            for folder, _, files in os.walk("stores/precomputed"):
                for file in files:
                    path = os.path.join(folder, file)

                    def packed(handler, path=path):
                        with open(path, "rb") as content:
                            handler.answer(200, gzip.compress(content.read()),
                                           Content_Encoding="gzip")
                    server.handlers[path[len("stores"):]] = packed
            self.check(server, "precomputed")

    def answer_whole(self, server, how):
        """Answers all requests for files of a sharded store with whole files."""
        for folder, _, files in os.walk("stores/sharded"):
            for file in files:
                path = os.path.join(folder, file)

                def whole(handler, path=path):
                    with open(path, "rb") as source:
                        how(handler, source.read())
                server.handlers["/" + os.path.relpath(path, "stores")] = whole

    def test_parts_of_whole_files_of_unknown_size(self):
        def in_chunks(handler, content, packed=None):
            handler.send_response(200)
            handler.send_header("Transfer-Encoding", "chunked")
            if packed:
                handler.send_header("Content-Encoding", packed)
            handler.end_headers()
            for at in range(0, len(content), 1000):
                piece = content[at:at + 1000]
                handler.wfile.write(b"%x\r\n" % len(piece) + piece + b"\r\n")
            handler.wfile.write(b"0\r\n\r\n")

        def packed(handler, content):
            handler.answer(200, gzip.compress(content), Content_Encoding="gzip")

        def packed_in_chunks(handler, content):
            in_chunks(handler, gzip.compress(content), "gzip")

        def until_the_end(handler, content):
            handler.send_response(200)
            handler.send_header("Connection", "close")
            handler.end_headers()
            handler.wfile.write(content)
            handler.close_connection = True

        for how in (in_chunks, packed, packed_in_chunks):
            with self.subTest(how.__name__), Server("stores") as server:
                self.answer_whole(server, how)
                self.check(server, "sharded")
        with Server("stores") as server:  # the end may be that of a broken connection
            self.answer_whole(server, until_the_end)
            self.fails(3, f"{server.address}/sharded", "whole files only", "3 attempts")

    def test_a_chunk_that_is_gone_is_not_taken_for_missing(self):
        with Server("stores") as server:
            server.missing = 410
            self.fails(3, f"{server.address}/zarr2", "status 410")

    def test_missing_metadata_and_groups(self):
        with Server("stores") as server:
            self.fails(3, f"{server.address}/nothing", "/nothing: format", "no metadata")
        os.makedirs("stores/group", exist_ok=True)
        with open("stores/group/.zgroup", "w", encoding="utf-8") as file:
            file.write('{"zarr_format": 2}')
        with Server("stores") as server:
            self.fails(3, f"{server.address}/group", "--dataset")
            done = run("info", f"{server.address}/group", "--dataset", "../zarr3", code=2)
            self.assertEqual(done, "")

    def test_a_server_that_refuses(self):
        with Server("stores") as server:
            server.handlers["/precomputed/info"] = lambda handler: handler.answer(403)
            self.fails(3, f"{server.address}/precomputed", "status 403", "MW_HTTP_AUTHORIZATION",
                       "/precomputed/info")

    def test_a_server_that_refuses_what_it_does_not_have(self):
        """As S3 does where the public may read files, and not list folders."""
        with Server("stores") as server:
            server.missing = 403
            for name, write in remote_stores.KINDS.items():
                with self.subTest(name):
                    write(f"stores/whole_{name}", self.labels + 1)  # has all of its chunks
                    mesh(f"stores/whole_{name}", "whole.vtkhdf")
                    mesh(f"{server.address}/whole_{name}", "remote.vtkhdf")
                    self.assertEqual(run("digest", "remote.vtkhdf"), run("digest", "whole.vtkhdf"))
            self.fails(3, f"{server.address}/zarr2", "status 403", "/zarr2/0/0/0")
            self.fails(3, f"{server.address}/nothing", "shows no metadata", "status 403",
                       "/nothing/info", "MW_HTTP_AUTHORIZATION")
            self.fails(3, f"{server.address}/nothing.zarr", "no metadata", "status 403")

    def test_redirects(self):
        with Server("stores") as server:
            def again(handler):
                handler.answer(302, Location="/loop/info")

            def there(handler):
                handler.answer(307, Location="/precomputed/info")
            server.handlers.update({"/loop/info": again, "/moved/info": there})
            self.fails(3, f"{server.address}/loop", "redirects again and again")
            self.assertLess(len(server.requests), 10)
            self.assertIn("precomputed", run("info", f"{server.address}/moved"))

    def test_bombs(self):
        """256 MiB in a quarter of one, for a chunk that can have 48 KiB, and as metadata."""
        bomb = gzip.compress(bytes(2**28))
        chunk = "/precomputed/4_4_4/16-32_0-16_0-16"
        with Server("stores") as server:
            for path in (chunk, "/n5/attributes.json"):
                def burst(handler):
                    handler.answer(200, bomb, Content_Encoding="gzip")
                server.handlers[path] = burst
            self.fails(3, f"{server.address}/precomputed", chunk, "sends more than")
            self.fails(3, f"{server.address}/n5", "attributes.json", "sends more than")

    def test_files_that_change_between_parts(self):
        with Server("stores") as server:
            def ever_new(handler):
                server.version = getattr(server, "version", 0) + 1
                with open("stores/zarr3/c/0/0/1", "rb") as file:
                    content = file.read()
                first, last = map(int, handler.headers["Range"][len("bytes="):].split("-"))
                last = min(last, len(content) - 1)
                handler.answer(206, content[first:last + 1], ETag=f'"{server.version}"',
                               Content_Range=f"bytes {first}-{last}/{len(content)}")
            server.handlers["/zarr3/c/0/0/1"] = ever_new
            self.fails(3, f"{server.address}/zarr3", "/zarr3/c/0/0/1", "changed on the server")

    def test_info_lists_scales_and_reads_no_labels(self):
        with Server("stores") as server:
            facts = json.loads(run("info", f"{server.address}/sharded", "--json"))
            self.assertFalse([path for path, _ in server.requests if path.endswith(".shard")])
        self.assertEqual([row["shape_xyz"] for row in facts["scales"]],
                         [[41, 36, 40], [21, 18, 20]])
        self.assertEqual(facts["scales"][1]["spacing_xyz"], [8, 8, 8])
        local = json.loads(run("info", "stores/precomputed", "--json"))
        self.assertEqual(local["scales"], facts["scales"])
        self.assertEqual(local["labels"]["count"], len(np.unique(self.labels)))

    def test_a_signal_ends_a_wait_for_a_silent_server(self):
        """For metadata, for labels in the middle of a run, and between two attempts."""
        asked = threading.Event()

        def silent(_):
            asked.set()
            time.sleep(60)

        def busy(handler):
            asked.set()
            handler.answer(503, Retry_After="60")

        chunk = next(f"{path.removeprefix('stores')}/{name}"
                     for path, _, names in os.walk("stores/precomputed") for name in sorted(names)
                     if name != "info")
        with Server("stores") as server:
            for number, path, handler in ((signal.SIGINT, "/precomputed/info", silent),
                                          (signal.SIGTERM, chunk, silent),
                                          (signal.SIGINT, "/precomputed/info", busy)):
                with self.subTest(path, handler=handler.__name__):
                    server.handlers = {path: handler}
                    asked.clear()
                    command = [PROGRAM, "mesh", f"{server.address}/precomputed", "-o", "stopped.vtu"]
                    process = subprocess.Popen(command, stdout=subprocess.DEVNULL,
                                               stderr=subprocess.PIPE, text=True)
                    self.addCleanup(process.kill)
                    self.assertTrue(asked.wait(20))
                    process.send_signal(number)
                    begin = time.monotonic()
                    _, said = process.communicate(timeout=100)
                    self.assertLess(time.monotonic() - begin, 20)
                    self.assertEqual(process.returncode, 130, said)
                    self.assertIn("interrupted; nothing was written", said)

    def test_no_server(self):
        with Server("stores") as server:
            address = server.address
        refused(["attempts"], "info", f"{address}/zarr2", "--scale", "0", code=4)

    def test_addresses_that_are_none(self):
        for address, piece in (("https://user:pass@h/v", ".netrc"), ("https://h/v?key=1", "query"),
                               ("gs://", "bucket"), ("s3:///", "bucket"), ("ftp://h/v", "ftp://")):
            self.fails(2, address, piece)
            self.assertNotIn("pass@", start("info", address).stderr)

    def test_authorization(self):
        """It goes to the host of the address alone, and is not in anything that is written."""
        environment = {**os.environ, "MW_HTTP_AUTHORIZATION": SECRET}
        with Server("stores") as server, Server("stores") as other:
            def guarded(handler):
                if handler.headers.get("Authorization") != SECRET:
                    return handler.answer(401)
                return handler.serve("stores/precomputed/info", None)
            moved = "/precomputed/4_4_4/16-32_0-16_0-16"

            def elsewhere(handler):
                handler.answer(302, Location=other.address + moved)
            server.handlers.update({"/precomputed/info": guarded, moved: elsewhere})
            done = subprocess.run(
                [PROGRAM, "mesh", f"{server.address}/precomputed", "-o", "a.vtkhdf", "--report",
                 "a.json", "--html", "a.html", "--keep", "a.kept", "--force"],
                env=environment, capture_output=True, text=True, check=True)
            self.assertTrue(all(h.get("Authorization") == SECRET for _, h in server.requests))
            self.assertTrue(other.requests)
            self.assertFalse(any("Authorization" in h for _, h in other.requests))
        mesh("stores/precomputed", "fresh.vtkhdf")
        self.assertEqual(run("digest", "a.vtkhdf"), run("digest", "fresh.vtkhdf"))
        written = [done.stdout.encode(), done.stderr.encode()]
        for path in ["a.vtkhdf", "a.json", "a.html"] + [
                os.path.join(folder, file) for folder, _, files in os.walk("a.kept")
                for file in files]:
            with open(path, "rb") as file:
                written.append(file.read())
        self.assertFalse(any(b"5ecret" in content for content in written))
        done = subprocess.run([PROGRAM, "info", "http://192.0.2.1/v"], env=environment,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertNotIn("5ecret", done.stderr)

    def test_nothing_for_this_machine_goes_to_a_proxy(self):
        environment = {**os.environ, "MW_HTTP_AUTHORIZATION": SECRET}
        with Server("stores") as server, Server("stores") as proxy:
            for name in ("http_proxy", "all_proxy", "ALL_PROXY"):
                subprocess.run([PROGRAM, "info", f"{server.address}/n5"], check=True,
                               env={**environment, name: proxy.address}, capture_output=True)
            self.assertTrue(server.requests)
            self.assertFalse(proxy.requests)

    def test_netrc(self):
        os.makedirs("home", exist_ok=True)
        with open("home/.netrc", "w", encoding="utf-8") as file:
            file.write("machine 127.0.0.1 login me password 5ecret\n")
        with Server("stores") as server:
            subprocess.run([PROGRAM, "info", f"{server.address}/n5"], check=True,
                           env={**os.environ, "HOME": os.path.abspath("home")},
                           capture_output=True)
            self.assertTrue(server.requests[0][1]["Authorization"].startswith("Basic "))

    def test_netrc_is_for_the_host_of_the_address(self):
        """A host to which it redirects is told nothing, not even its own password."""
        os.makedirs("home", exist_ok=True)
        with open("home/.netrc", "w", encoding="utf-8") as file:
            file.write("machine 127.0.0.1 login me password 5ecret\n"
                       "machine localhost login me password 0ther\n")
        chunk = "/precomputed/4_4_4/16-32_0-16_0-16"
        with Server("stores") as server, Server("stores") as other:
            elsewhere = other.address.replace("127.0.0.1", "localhost")
            server.handlers[chunk] = lambda h: h.answer(302, Location=elsewhere + chunk)
            server.handlers["/precomputed/info"] = lambda h: h.answer(301, Location="/moved/info")
            server.handlers["/moved/info"] = lambda h: h.serve("stores/precomputed/info", None)
            subprocess.run([PROGRAM, "info", f"{server.address}/precomputed", "--scale", "0"],
                           env={**os.environ, "HOME": os.path.abspath("home")}, check=True,
                           capture_output=True)
            self.assertTrue(all("Authorization" in headers for _, headers in server.requests))
            self.assertIn("/moved/info", [path for path, _ in server.requests])
            self.assertEqual([path for path, _ in other.requests], [chunk])
            self.assertNotIn("Authorization", other.requests[0][1])

    def test_netrc_is_not_shown_on_the_way(self):
        """What a proxy sees of http:// to another machine, all on the way to that see, too."""
        os.makedirs("home", exist_ok=True)
        with open("home/.netrc", "w", encoding="utf-8") as file:
            file.write("machine data.example login me password 5ecret\n")
        with Server("stores") as proxy:
            prefix = "http://data.example"
            proxy.handlers[f"{prefix}/precomputed/info"] = lambda h: h.answer(401)
            done = subprocess.run([PROGRAM, "info", f"{prefix}/precomputed"], text=True,
                                  env={**os.environ, "HOME": os.path.abspath("home"),
                                       "http_proxy": proxy.address}, capture_output=True)
            self.assertEqual(done.returncode, 3)
            self.assertIn("https://", done.stderr)
            self.assertTrue(proxy.requests)
            self.assertFalse(any("Authorization" in headers for _, headers in proxy.requests))

    def long_run(self, server):
        """A run of a few seconds that saves all the time, of a volume with no two voxels alike."""
        return [PROGRAM, "mesh", f"{server.address}/noise", "-o", "noise.vtkhdf", "--force",
                "--workdir", "work", "--resume", "--window", "8", "--save-every", "0", "--report",
                "noise.json"]

    def write_noise(self):
        labels = np.random.default_rng(1).integers(1, 4, (30, 30, 30)).astype("<u8")
        shutil.rmtree("stores/noise", ignore_errors=True)
        shutil.rmtree("work", ignore_errors=True)
        remote_stores.zarr3("stores/noise", labels)
        return labels

    def test_killed_and_resumed(self):
        self.write_noise()
        with Server("stores", 0.1) as server:
            command = self.long_run(server)
            for pause in (0.1, 0.3, 0.6, 0.8, 1, 1):
                running = subprocess.Popen(command, stderr=subprocess.DEVNULL)
                time.sleep(pause)
                running.kill()
                running.wait()
            subprocess.run(command, check=True, capture_output=True)
        with open("noise.json", encoding="utf-8") as file:
            self.assertGreater(json.load(file)["engine"]["windows_resumed"], 0)
        mesh("stores/noise", "noise_file.vtkhdf", "--window", "8")
        self.assertEqual(run("digest", "noise.vtkhdf"), run("digest", "noise_file.vtkhdf"))

    def test_labels_that_changed_are_not_resumed(self):
        labels = self.write_noise()
        with Server("stores") as server:
            command = self.long_run(server)
            running = subprocess.Popen(command, stderr=subprocess.DEVNULL)
            time.sleep(1.2)
            running.send_signal(signal.SIGINT)
            self.assertEqual(running.wait(), 75)
            labels[29, 29, 29] += 1
            shutil.rmtree("stores/noise")
            remote_stores.zarr3("stores/noise", labels)
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("label fingerprint was", done.stderr)


if __name__ == "__main__":
    unittest.main()
