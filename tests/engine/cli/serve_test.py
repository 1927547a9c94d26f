#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""`mwmesh serve` as a user and the viewer's pages meet it."""
import http.client
import json
import os
import pathlib
import signal
import socket
import subprocess
import threading
import unittest
import urllib.parse

from program import PROGRAM, RESIDENT_MEMORY_IS_OURS, enter_folder, run, start


def state_of(link):
    """What the viewer gets to know by the link."""
    return json.loads(urllib.parse.unquote(link.split("#!", 1)[1]))


class Serving:
    """`mwmesh serve` with these arguments, until the end of the block or of the test."""

    def __init__(self, *arguments, prefix=()):
        self.process = subprocess.Popen([*prefix, PROGRAM, "serve", *map(str, arguments)],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.link = self.process.stdout.readline()
        source = state_of(self.link)["layers"][0]["source"]
        self.port = int(source.rpartition(":")[2])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        self.process.communicate(timeout=20)

    def fact(self, name):
        """What the system knows of the process, such as the most KiB of memory that it has had."""
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as facts:
            return int(next(line for line in facts if line.startswith(name + ":")).split()[1])

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)

    def ask(self, method, path, **headers):
        """The answer, and its content."""
        connection = self.connect()
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        content = answer.read()
        connection.close()
        return answer, content

    def send(self, request):
        """All that comes back for these bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as connection:
            connection.sendall(request)
            connection.shutdown(socket.SHUT_WR)
            return b"".join(iter(lambda: connection.recv(1 << 16), b""))


class Serve(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "22,18,20", "--labels", 6, "--seed", 3, "-o", "v.npy")
        run("mesh", "v.npy", "--spacing", "2,2,3", "-o", "m.vtu")
        for form in ("draco", "precomputed"):
            run("surface", "m.vtu", "--format", form, "--unit", "um", "-o", form)
        cls.whole = pathlib.Path("draco/1").read_bytes()

    def test_the_link_shows_where_the_meshes_are(self):
        rows = json.loads(run("info", "m.vtu", "--json"))["volume"]["per_label"]
        rows.sort(key=lambda row: -row["volume"])
        largest = [str(row["label"]) for row in rows if row["label"] != 0]
        for form in ("draco", "precomputed"):
            with Serving(form, "--viewer", "http://viewer.example/") as server:
                self.assertTrue(server.link.startswith("http://viewer.example/#!"), server.link)
                self.assertRegex(server.link, r"^[!-~]+\n$")
                state = state_of(server.link)
            for found, expected in zip(state["position"], (22e3, 18e3, 30e3), strict=True):
                self.assertAlmostEqual(found / expected, 1, places=6)
            [layer] = state["layers"]
            self.assertEqual(layer["source"], f"precomputed://http://127.0.0.1:{server.port}")
            self.assertEqual((layer["name"], layer["segments"]), (form, largest))

    def test_parts_of_files_are_served(self):
        whole, size = self.whole, len(self.whole)
        parts = {"bytes=3-17": (206, whole[3:18]), "bytes=9-": (206, whole[9:]),
                 "bytes=-5": (206, whole[-5:]), "bytes=0-99999999": (206, whole),
                 f"bytes=-{size + 7}": (206, whole), f"bytes={size - 1}-": (206, whole[-1:]),
                 f"bytes={size}-": (416, b""), "bytes=99999999-": (416, b""),
                 "bytes=-0": (416, b""),
                 "bytes=-": (200, whole), "bytes=x-": (200, whole), "bytes=17-3": (200, whole),
                 "lines=1-2": (200, whole), None: (200, whole),
                 f"bytes=0-{2**63}": (206, whole), f"bytes={2**63}-": (416, b""),
                 f"bytes={5000 * '9'}-": (200, whole), f"bytes=0-{5000 * '9'}": (200, whole)}
        with Serving("draco") as server:
            for asked, (status, content) in parts.items():
                answer, found = server.ask("GET", "/1", **({"Range": asked} if asked else {}))
                self.assertEqual((answer.status, found), (status, content), asked)
                self.assertEqual(int(answer.headers["Content-Length"]), len(content), asked)
                self.assertEqual(answer.headers.get_all("Access-Control-Allow-Origin"),
                                 ["https://neuroglancer-demo.appspot.com"])
                if status == 416:
                    self.assertEqual(answer.headers["Content-Range"], f"bytes */{size}")
                elif status == 200:
                    self.assertIsNone(answer.headers["Content-Range"], asked)
            answer, _ = server.ask("GET", "/1", Range="bytes=3-17")
            self.assertEqual(answer.headers["Content-Range"], f"bytes 3-17/{size}")
            # Several ranges may ask for the file many times over.
            for many in ("bytes=0-1,4-5", "bytes=" + 2000 * "0-," + "0-", "bytes=0-,x",
                         "bytes=0-,,,"):
                answer, found = server.ask("GET", "/1", Range=many)
                self.assertEqual((answer.status, found), (200, whole), many)
                self.assertEqual(answer.headers["Content-Type"], "application/octet-stream")

    def test_a_page_may_ask_whether_it_may_ask(self):
        with Serving("draco", "--viewer", "https://viewer.example/v/") as server:
            for path in ("/1", "/none", "*"):
                answer, content = server.ask("OPTIONS", path, Origin="https://viewer.example",
                                             **{"Access-Control-Request-Headers": "range",
                                                "Access-Control-Request-Private-Network": "true"})
                self.assertEqual((answer.status, content), (204, b""))
                for header, value in (("Origin", "https://viewer.example"), ("Headers", "Range"),
                                      ("Private-Network", "true")):
                    self.assertEqual(answer.headers[f"Access-Control-Allow-{header}"], value)
            for method in ("POST", "PUT", "DELETE"):
                self.assertEqual(server.ask(method, "/1")[0].status, 405, method)

    def test_no_other_page_may_read(self):
        """Neither by the name of its own host, which it may have made lead here."""
        with Serving("draco", "--viewer", "http://localhost:8080/") as server:
            for host, status in (("127.0.0.1", 200), (f"localhost:{server.port}", 200),
                                 ("[::1]:9", 200), ("evil.example", 421), ("127.0.0.1.evil.example", 421),
                                 (f"evil.example:{server.port}", 421), ("localhost.evil.example", 421)):
                answer, content = server.ask("GET", "/1", Host=host, Origin="https://evil.example")
                self.assertEqual((answer.status, content), (status, self.whole if status == 200 else b""))
                self.assertEqual(answer.headers.get_all("Access-Control-Allow-Origin"),
                                 ["http://localhost:8080"])
            self.assertIn(b" 421 ", server.send(b"GET /1 HTTP/1.0\r\n\r\n").partition(b"\r\n")[0])
        for wrong in ("viewer.example", "ftp://viewer.example/", "file:///viewer.html", ""):
            done = start("serve", "draco", "--viewer", wrong)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn("--viewer", done.stderr)

    def test_one_client_does_not_keep_others_out(self):
        with Serving("draco") as server:
            used = server.connect()
            held = []
            for begun in 2 * (b"", b"GET /1 HTTP/1.1\r\nX: "):
                for _ in range(150):
                    held.append(socket.create_connection(("127.0.0.1", server.port), timeout=20))
                    held[-1].sendall(begun)
                # Connections are taken in their order, so all that are held are open by then.
                fresh = http.client.HTTPConnection("127.0.0.1", server.port, timeout=8)
                fresh.request("GET", "/1")
                self.assertEqual(fresh.getresponse().read(), self.whole)
                fresh.close()
                used.request("GET", "/1")
                first = used.sock
                self.assertEqual(used.getresponse().read(), self.whole)
                self.assertIs(used.sock, first)
            used.close()
            for connection in held:
                connection.close()

    def test_nothing_outside_the_folder_is_served(self):
        run("surface", "m.vtu", "--format", "draco", "-o", "linked")
        os.symlink("../m.vtu", "linked/out")
        os.symlink("/etc/passwd", "linked/x")
        os.symlink("1", "linked/link")
        os.symlink("..", "linked/above")
        os.symlink("circle", "linked/circle")
        os.mkdir("linked/pages")
        os.symlink("../../m.vtu", "linked/pages/index.html")
        os.mkfifo("linked/pipe")
        os.mkdir("linked-2")
        pathlib.Path("linked-2/1").touch()
        statuses = {"/../m.vtu": 404, "/%2e%2e/m.vtu": 404, "/%2e%2e%2fm.vtu": 404,
                    "//etc/passwd": 404, "/segment_properties/../../m.vtu": 404, "/out": 404,
                    "/x": 404, "/above/m.vtu": 404, "/above/": 404, "/pages/": 404, "/pages": 404,
                    "/": 404, "/../linked-2/1": 404, "/circle": 404, "/pipe": 404, "/none": 404,
                    "/1%00": 404, "/%00/1": 404, "/1/": 404, "/..%5c1": 404, "/" + 5000 * "a": 404,
                    "/link": 200, "/1": 200, "/%31": 200, "/1?x=y": 200,
                    "/segment_properties/../1": 200, "/../linked/1": 200}
        whole = pathlib.Path("linked/1").read_bytes()
        with Serving("linked") as server:
            for path, status in statuses.items():
                for method in ("GET", "HEAD"):
                    answer, content = server.ask(method, path, Range="bytes=x-")
                    self.assertEqual(answer.status, status, (method, path))
                    self.assertEqual(content, whole if (method, status) == ("GET", 200) else b"")
                    if status == 200:
                        self.assertEqual(int(answer.headers["Content-Length"]), len(whole))
                answer, content = server.ask("GET", path, Range="bytes=0-3")
                self.assertEqual((answer.status, content),
                                 (206, whole[:4]) if status == 200 else (404, b""), path)

    def test_a_connection_is_used_again(self):
        with Serving("draco") as server:
            connection = server.connect()
            for turn in range(40):
                method = ("GET", "HEAD", "OPTIONS")[turn % 3]
                connection.request(method, "/none" if turn % 7 == 0 else "/1")
                if turn == 0:
                    used = connection.sock
                self.assertIs(connection.sock, used)
                answer = connection.getresponse()
                self.assertEqual(len(answer.read()),
                                 len(self.whole) if (method, answer.status) == ("GET", 200) else 0)
            connection.close()

    def test_many_connections(self):
        with Serving("draco") as server:
            idle = [server.connect() for _ in range(10)]
            for connection in idle:
                connection.connect()
            for connection in [server.connect() for _ in range(200)]:
                idle.append(connection)
                connection.request("GET", "/1", headers={"Range": "bytes=5-"})
            for connection in idle[10:]:
                self.assertEqual(connection.getresponse().read(), self.whole[5:])
            for connection in idle[10:]:
                connection.close()
            found = []
            threads = [threading.Thread(target=lambda: found.append(server.ask("GET", "/1")[1]))
                       for _ in range(100)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(found, 100 * [self.whole])
            for connection in idle:
                connection.close()

    def test_one_thread_is_enough(self):
        """Also where some clients take nothing of what they asked for, and others go away."""
        run("surface", "m.vtu", "--format", "draco", "-o", "slow")
        with open("slow/big", "wb") as file:
            file.truncate(64 << 20)
        with Serving("slow") as server:
            stuck = [server.connect() for _ in range(20)]
            for connection in stuck:
                connection.request("GET", "/big")
            for connection in stuck[::2]:
                connection.close()
            self.assertEqual(server.ask("GET", "/1")[1], self.whole)
            self.assertEqual(len(stuck[1].getresponse().read()), 64 << 20)
            if RESIDENT_MEMORY_IS_OURS:
                self.assertEqual(server.fact("Threads"), 1)
            for connection in stuck:
                connection.close()

    def test_headers_without_an_end_take_no_memory(self):
        with Serving("draco") as server:
            server.ask("GET", "/1")
            before = server.fact("VmHWM")
            for begin, piece in ((b"GET /1 HTTP/1.1\r\nRange: bytes=", b"9"), (b"GET /", b"a"),
                                 (b"GET /1 HTTP/1.1\r\n", b"a: b\r\n"), (b"", b"a")):
                answer = b""
                with socket.create_connection(("127.0.0.1", server.port), timeout=5) as connection:
                    try:
                        connection.sendall(begin + (8 << 20) // len(piece) * piece)
                        answer = connection.recv(1 << 16)
                    except (ConnectionError, TimeoutError):
                        pass  # libmicrohttpd 1.0 reads no more until its patience ends
                self.assertRegex(answer, rb"^(HTTP/1.1 4\d\d |$)")
            if RESIDENT_MEMORY_IS_OURS:
                self.assertLess(server.fact("VmHWM") - before, 1 << 10)
            self.assertEqual(server.ask("GET", "/1")[1], self.whole)

    def test_a_body_is_not_read_as_a_request(self):
        with Serving("draco") as server:
            connection = server.connect()
            for method, status in (("POST", 405), ("GET", 200), ("OPTIONS", 204)):
                for size in (1, 100, 300_000):
                    connection.request(method, "/1", body=size * b"GET /2 HTTP/1.1\r\n\r\n")
                    answer = connection.getresponse()
                    self.assertEqual((answer.status, answer.read()),
                                     (status, self.whole if status == 200 else b""), size)
            connection.close()

    def test_what_is_no_request_ends_no_server(self):
        with Serving("draco") as server:
            for request in (b"", b"\r\n\r\n", b"GET /1\r\n\r\n", b"GET /1 HTTP/1.1\r\nRange",
                            bytes(range(256)),
                            b"GET /" + 9000 * b"a" + b" HTTP/1.1\r\n\r\n",
                            b"GET /1 HTTP/1.1\r\nRange: " + 9000 * b"a" + b"\r\n\r\n",
                            b"GET /1 HTTP/1.1\r\nRange: bytes=%2d%s\r\n\r\n",
                            b"GET /1\0 HTTP/1.1\r\n\r\n", b"GET /%u0000 HTTP/1.1\r\n\r\n",
                            b"POST /1 HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\nabc",
                            b"PUT /1 HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n"):
                self.assertNotIn(b" 500 ", server.send(request).partition(b"\r\n")[0], request)
            self.assertEqual(server.ask("GET", "/1")[1], self.whole)
            self.assertIsNone(server.process.poll())

    def test_any_stack_is_enough_for_long_headers(self):
        for limit in ("512", "unlimited"):
            limited = ("sh", "-c", f'ulimit -s {limit}; exec "$@"', "sh")
            with Serving("draco", prefix=limited) as server:
                for asked in ("bytes=" + 8100 * "9", "bytes=" + 2650 * "0-," + "0-",
                              "bytes=1-" + 8100 * "9", "bytes=" + 2650 * "0-," + "x"):
                    self.assertEqual(server.ask("GET", "/1", Range=asked)[1], self.whole, limit)

    def test_files_are_sent_piece_by_piece(self):
        """A large one as it is on disk, and one that is cut while it is sent does not end it."""
        run("surface", "m.vtu", "--format", "draco", "-o", "large")
        piece = bytes(range(256)) * 4096
        with open("large/big", "wb") as file:
            file.write(piece)
            file.truncate(64 << 20)
        with Serving("large") as server:
            answer, content = server.ask("GET", "/big")
            self.assertEqual((answer.status, len(content)), (200, 64 << 20))
            self.assertEqual(content[:len(piece)], piece)
            self.assertEqual(server.ask("GET", "/big", Range="bytes=65530-65545")[1],
                             piece[65530:65546])
            with open("large/huge", "wb") as file:
                file.seek(5 << 30)
                file.write(b"end")
            for begin in (size - 5 for size in (2**31, 2**32, (5 << 30) + 3)):
                answer, content = server.ask("GET", "/huge", Range=f"bytes={begin}-{begin + 9}")
                last = begin + len(content) - 1
                self.assertEqual((answer.status, answer.headers["Content-Range"]),
                                 (206, f"bytes {begin}-{last}/{(5 << 30) + 3}"))
                self.assertEqual(content, b"\0\0end" if begin > 2**32 else bytes(10))
            self.assertEqual(len(server.ask("GET", "/huge", Range="bytes=5300000000-")[1]), 68709123)
            if RESIDENT_MEMORY_IS_OURS:
                self.assertLess(server.fact("VmHWM"), 60 << 10)
            connection = server.connect()
            connection.request("GET", "/big")
            answer = connection.getresponse()
            os.truncate("large/big", 1000)
            with self.assertRaises((http.client.IncompleteRead, ConnectionError)):
                answer.read()
            connection.close()
            self.assertEqual(len(server.ask("GET", "/big")[1]), 1000)
            pathlib.Path("large/none").touch()
            self.assertEqual(server.ask("GET", "/none")[0].headers["Content-Length"], "0")
            self.assertEqual(server.ask("GET", "/none", Range="bytes=0-")[0].status, 416)

    def test_it_says_what_is_no_folder_of_meshes(self):
        os.mkdir("empty")
        for folder in ("empty", "none", "m.vtu"):
            done = start("serve", folder)
            self.assertEqual((done.returncode, done.stdout), (3, ""), done.stderr)
            self.assertIn(f"{folder}: no precomputed meshes of mwmesh here", done.stderr)
            self.assertIn("mwmesh surface MESH --format draco -o FOLDER", done.stderr)

    def test_a_port_in_use_is_refused(self):
        with Serving("draco") as server:
            done = start("serve", "draco", "--port", server.port)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertIn(f"port {server.port} of 127.0.0.1: Address already in use", done.stderr)
            self.assertIn("without --port", done.stderr)
            port = server.port
            self.assertEqual(server.ask("GET", "/1")[0].status, 200)
        # It is free at once, though connections of the server that has ended linger.
        with Serving("draco", "--port", port) as server:
            self.assertEqual(server.port, port)
        for wrong in ("65536", "-1", "http", "80.5"):
            self.assertEqual(start("serve", "draco", f"--port={wrong}").returncode, 2, wrong)

    def test_it_listens_on_the_loopback_alone(self):
        with Serving("draco") as server:
            with open("/proc/net/tcp", encoding="ascii") as table:
                bound = [line.split()[1] for line in table if f":{server.port:04X} " in line]
            self.assertIn(f"0100007F:{server.port:04X}", bound)
            self.assertFalse([place for place in bound if place.startswith("00000000")])

    def test_it_serves_until_it_is_interrupted(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            server = Serving("draco", "--port", 0)
            idle = server.connect()
            idle.connect()
            self.assertIn(b"neuroglancer_multilod_draco", server.ask("GET", "/info")[1])
            server.process.send_signal(number)
            _, errors = server.process.communicate(timeout=20)
            self.assertEqual((server.process.returncode, errors), (0, "serving until Ctrl-C\n"))
            idle.close()

    def test_it_says_when_nobody_reads_the_link(self):
        reading, writing = os.pipe()
        os.close(reading)
        done = subprocess.run([PROGRAM, "serve", "draco"], stdout=writing, stderr=subprocess.PIPE,
                              text=True, timeout=20)
        os.close(writing)
        self.assertEqual(done.returncode, 4, done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
