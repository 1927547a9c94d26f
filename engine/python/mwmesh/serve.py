# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Shows a folder of precomputed meshes: serves it on this machine and prints a link to neuroglancer.

    python3 -m mwmesh.serve FOLDER [--port N] [--viewer ADDRESS]

FOLDER is what `mwmesh surface MESH --format draco -o FOLDER` or `--format precomputed` wrote.  Only
programs on this machine reach the server; the viewer, a page in your browser, is one of them.
"""
import argparse
import functools
import http.server
import json
import os
import re
import shutil
import sys
import urllib.parse

VIEWER = "https://neuroglancer-demo.appspot.com/"
MOST_SHOWN = 100  # segments that the link selects, the largest first


class _Handler(http.server.SimpleHTTPRequestHandler):
    """Files, and the parts of them that are asked for, for pages from anywhere.

    Links that lead out of the folder are not followed: there is nothing at their addresses.
    """

    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def end_headers(self):
        self.send_header("Access-Control-Allow-Origin", "*")
        self.send_header("Access-Control-Allow-Headers", "Range")
        self.send_header("Access-Control-Allow-Private-Network", "true")
        self.send_header("Accept-Ranges", "bytes")
        super().end_headers()

    def translate_path(self, path):
        file = super().translate_path(path)
        # In place of a folder its index is sent, which may be such a link, too.
        sent = [file] + [os.path.join(file, name) for name in ("index.html", "index.htm")]
        return file if all(map(self._is_inside, sent)) else ""

    def _is_inside(self, file):
        folder = os.path.realpath(self.directory)
        return ("\0" not in file
                and os.path.commonpath((folder, os.path.realpath(file))) == folder)

    def do_OPTIONS(self):
        self.send_response(204)
        self.end_headers()

    def do_GET(self):
        # A range that no file has, of more digits, is passed over, as one that is no range.
        asked = re.fullmatch(r"bytes=(\d{0,18})-(\d{0,18})", self.headers.get("Range", ""))
        path = self.translate_path(self.path)
        if asked is None or asked.groups() == ("", "") or not os.path.isfile(path):
            return super().do_GET()
        with open(path, "rb") as file:
            size = os.fstat(file.fileno()).st_size
            first, last = asked.groups()
            begin = int(first) if first else max(0, size - int(last))
            end = min(int(last) + 1, size) if first and last else size
            if begin >= end:
                self.send_response(416)
                self.send_header("Content-Range", f"bytes */{size}")
                self.send_header("Content-Length", "0")
                return self.end_headers()
            self.send_response(206)
            self.send_header("Content-Type", "application/octet-stream")
            self.send_header("Content-Range", f"bytes {begin}-{end - 1}/{size}")
            self.send_header("Content-Length", str(end - begin))
            self.end_headers()
            file.seek(begin)
            shutil.copyfileobj(_Part(file, end - begin), self.wfile)


class _Part:
    """The next `left` bytes of a file."""

    def __init__(self, file, left):
        self._file, self._left = file, left

    def read(self, most):
        data = self._file.read(min(most, self._left))
        self._left -= len(data)
        return data


class Server(http.server.ThreadingHTTPServer):
    """Serves `folder` at `address` on the loopback; port 0 is any that is free."""

    daemon_threads = True

    def __init__(self, folder, port=0):
        super().__init__(("127.0.0.1", port), functools.partial(_Handler, directory=str(folder)))
        self.address = f"http://127.0.0.1:{self.server_port}"


def _largest_segments(folder, info):
    with open(os.path.join(folder, info["segment_properties"], "info"), encoding="utf-8") as file:
        inline = json.load(file)["inline"]
    numbers = {p["id"]: p["values"] for p in inline["properties"] if p["type"] == "number"}
    sizes = numbers.get("volume") or numbers["area"]
    # Neuroglancer takes 0 for what is no segment, and does not show it.
    rows = [row for row, segment in enumerate(inline["ids"]) if segment != "0"]
    rows.sort(key=lambda row: (-sizes[row], row))
    return [inline["ids"][row] for row in rows[:MOST_SHOWN]]


def link(folder, address, viewer=VIEWER):
    """The address of a view of the whole folder, which is served at `address`.

    Raises ValueError where the folder has no meshes that `mwmesh surface` wrote.
    """
    try:
        with open(os.path.join(folder, "info"), encoding="utf-8") as file:
            info = json.load(file)
        low, high = info["mwmesh_box"]
        segments = _largest_segments(folder, info)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ValueError(f"{folder}: no precomputed meshes of mwmesh here ({error}); write them by "
                         "mwmesh surface MESH --format draco -o FOLDER") from error
    state = {
        "dimensions": {axis: [1e-9, "m"] for axis in "xyz"},
        "position": [(l + h) / 2 for l, h in zip(low, high)],
        "projectionScale": 2 * max(h - l for l, h in zip(low, high)),
        "layout": "3d",
        "showSlices": False,
        "layers": [{"type": "segmentation", "name": os.path.basename(os.path.abspath(folder)),
                    "source": f"precomputed://{address}", "segments": segments}],
    }
    return f"{viewer}#!{urllib.parse.quote(json.dumps(state))}"


def main(arguments=None):
    about = __doc__.split("\n\n")
    parser = argparse.ArgumentParser(prog="python3 -m mwmesh.serve", description=about[0])
    parser.add_argument("folder", help="what mwmesh surface --format draco wrote")
    parser.add_argument("--port", type=int, default=0, help="[any that is free]")
    parser.add_argument("--viewer", default=VIEWER, help="[%(default)s]")
    asked = parser.parse_args(arguments)
    try:
        with Server(asked.folder, asked.port) as server:
            print(link(asked.folder, server.address, asked.viewer), flush=True)
            print("serving until Ctrl-C", file=sys.stderr)
            server.serve_forever()
    except KeyboardInterrupt:
        return 0
    except (OSError, OverflowError, ValueError) as error:
        print(f"mwmesh.serve: error: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
