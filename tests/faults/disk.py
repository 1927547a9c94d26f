# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What a disk may hold after its power was cut, from the record of what was written and synced.

A file is what was synced, and of each sector written since then any of its later contents or none;
its length is any that it had since then.  A name (made, renamed, removed) is as it was when its
folder was synced, or at any later moment.  Nothing orders one of these after another but a sync.
"""
from pathlib import Path

SECTOR = 512


class File:
    """Content as the program sees it; what is on the disk for sure; what may be."""

    def __init__(self, content=b""):
        self.now = bytearray(content)
        self.durable = content
        self.written = {}  # sector -> contents since the sync, oldest first
        self.sizes = []  # since the sync

    def touch(self, begin, end):
        for sector in range(begin // SECTOR, (end + SECTOR - 1) // SECTOR):
            now = bytes(self.now[sector * SECTOR : (sector + 1) * SECTOR])
            self.written.setdefault(sector, []).append(now.ljust(SECTOR, b"\0"))

    def write(self, offset, data):
        end = offset + len(data)
        if end > len(self.now):
            self.resize(end)
        self.now[offset:end] = data
        self.touch(offset, end)

    def resize(self, size):
        """Bytes that were cut off and come back are 0."""
        before = len(self.now)
        self.sizes.append(size)
        if size < before:
            del self.now[size:]
            self.touch(size, before)
        else:
            self.now.extend(bytes(size - before))

    def sync(self):
        self.durable = bytes(self.now)
        self.written, self.sizes = {}, []

    def after_cut(self, random):
        """Sectors live or die by themselves, or by pages of 4 KiB."""
        out = bytearray(self.durable)
        size = random.choice([len(out), *self.sizes])
        whole = max(len(out), size, *[(s + 1) * SECTOR for s in self.written], 0)
        out.extend(bytes(whole - len(out)))
        unit = random.choice([1, 8])
        share = random.choice([0, 0.1, 0.5, 0.9, 1])
        lives = {}
        for sector, contents in self.written.items():
            if not lives.setdefault(sector // unit, random.random() < share):
                continue
            content = random.choice([contents[-1], random.choice(contents)])
            out[sector * SECTOR : sector * SECTOR + len(content)] = content
        return bytes(out[:size])


class Disk:
    """The folder and all below it."""

    def __init__(self, folder, files=None):
        """files: relative path -> bytes, on the disk for sure."""
        self.folder = str(folder)
        self.names = {  # path -> File, as the program sees it
            f"{folder}/{name}": File(data) for name, data in (files or {}).items()
        }
        self.durable = dict(self.names)  # the same, as on the disk for sure
        self.pending = {}  # path -> what it may be since its folder was synced: Files or None

    def set_name(self, path, file):
        if file is None:
            self.names.pop(path, None)
        else:
            self.names[path] = file
        self.pending.setdefault(path, []).append(file)

    def apply(self, event):
        file = self.names.get(event.path)
        if event.name == "create":
            self.set_name(event.path, File())
        elif event.name == "unlink":
            if file is not None:
                self.set_name(event.path, None)
        elif event.name == "rename":
            self.set_name(event.other, file)
            self.set_name(event.path, None)
        elif event.name == "sync":
            self.sync(event.path, file)
        elif file is None:
            return  # without a name, or a folder
        elif event.name == "write":
            file.write(event.offset, event.data)
        elif event.name == "resize":
            file.resize(event.size)

    def sync(self, path, file):
        if file is not None:
            file.sync()
            return
        for name in [name for name in self.pending if str(Path(name).parent) == path]:
            last = self.pending.pop(name)[-1]
            self.durable.pop(name, None)
            if last is not None:
                self.durable[name] = last

    def after_cut(self, random):
        """Relative path -> bytes."""
        share = random.choice([0, 0.5, 1])
        names = dict(self.durable)
        for path, versions in self.pending.items():
            if random.random() >= share:
                continue
            names.pop(path, None)
            version = random.choice(versions)
            if version is not None:
                names[path] = version
        return {path[len(self.folder) + 1 :]: file.after_cut(random)
                for path, file in names.items()}
