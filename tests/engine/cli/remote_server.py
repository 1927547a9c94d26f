# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""A web server on the loopback that serves a folder by ranges, and fails on purpose if it is told to."""
import http.server
import os
import random
import re
import threading
import time

#: What may go wrong with an answer that is otherwise right.
FAULTS = ("503", "429", "reset", "short", "wrong range", "whole", "slow", "empty", "unasked part")


class Server:
    """Serves `folder` at `address` until it is closed.

    share: the part of the requests that fail; seed: of the choice which ones.
    requests: (path, headers) of all so far; failed: how many of them failed on purpose.
    handlers: functions of a request handler by the path that they answer instead.
    missing: the status that answers for files that are not there.
    wait: seconds before each answer; waiting: how many requests waited then when each came.
    """

    def __init__(self, folder, share=0.0, seed=1):
        self.folder, self.share = folder, share
        self.wait, self.waiting, self._held = 0, [], 0
        self.requests, self.failed, self.handlers = [], 0, {}
        self.missing = 404
        self._random, self._lock = random.Random(seed), threading.Lock()
        server = self

        class Handler(_Handler):
            owner = server

        self._http = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._http.daemon_threads = True
        self.address = f"http://127.0.0.1:{self._http.server_port}"
        threading.Thread(target=self._http.serve_forever, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._http.shutdown()
        self._http.server_close()

    def fault_of(self, path, headers):
        with self._lock:
            self.requests.append((path, dict(headers)))
            if self._random.random() >= self.share:
                return None
            self.failed += 1
            return FAULTS[self._random.randrange(len(FAULTS))]

    def hold(self):
        """Holds a request back for a while, and counts those that wait."""
        if not self.wait:
            return
        with self._lock:
            self._held += 1
            self.waiting.append(self._held)
        time.sleep(self.wait)
        with self._lock:
            self._held -= 1


class _Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def handle(self):
        try:
            super().handle()
        except ConnectionError:
            pass  # a client that was killed, or has enough

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        if "Content_Length" not in headers:
            self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        owner = self.owner
        fault = owner.fault_of(self.path, self.headers)
        owner.hold()
        if self.path in owner.handlers:
            owner.handlers[self.path](self)
        else:
            self.serve(owner.folder + self.path, fault)

    def serve(self, path, fault):
        if fault in ("503", "429"):
            return self.answer(int(fault), b"not now")
        if fault == "reset":
            self.close_connection = True
            return self.connection.shutdown(2)
        if not os.path.isfile(path):
            return self.answer(self.owner.missing)
        if fault == "slow":
            time.sleep(0.05)
        with open(path, "rb") as file:
            content = file.read()
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        status, facts = 200, {"ETag": f'"{os.stat(path).st_mtime_ns}"'}
        if wanted and fault != "whole":
            first, last = int(wanted[1]), min(int(wanted[2]), len(content) - 1)
            if first > last:
                return self.answer(416)
            shift = 1 if fault == "wrong range" else 0
            status = 206
            facts["Content_Range"] = f"bytes {first + shift}-{last + shift}/{len(content)}"
            content = content[first:last + 1]
        elif fault == "unasked part":
            status = 206
            facts["Content_Range"] = f"bytes 0-{len(content) - 1}/{len(content)}"
        if fault in ("short", "empty"):
            self.close_connection = True
            facts["Content_Length"] = str(len(content))
            content = content[:len(content) // 2 if fault == "short" else 0]
        self.answer(status, content, **facts)
