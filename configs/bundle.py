#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Puts the shared libraries that programs need beside them, so that they run where none of them is.

Usage: bundle.py WHEEL FOLDER    writes the wheel with its libraries into FOLDER, and prints its path
       bundle.py TREE            puts them into TREE/lib/bundled, for a tree that can be moved

Libraries that PEP 600 lets a wheel expect of every system stay outside.  The new wheel has the
platform tag manylinux_2_N, where 2.N is the latest version of glibc that any file in it asks for,
as readelf reads it.  Needs patchelf and binutils.
"""
import base64
import hashlib
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

#: What every system of a manylinux tag has, by PEP 600.
OF_THE_SYSTEM = re.compile(
    r"(ld-linux.*|linux-vdso|lib(c|m|dl|rt|pthread|resolv|util|nsl|gcc_s|stdc\+\+))\.so(\.\d+)*$")


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def needed_by(file):
    """The names that the file asks the loader for."""
    return re.findall(r"\(NEEDED\).*\[(.+)\]", output_of("readelf", "-d", file))


def soname_of(file):
    """What others call a shared library; the name of the file where it does not say."""
    found = re.findall(r"\(SONAME\).*\[(.+)\]", output_of("readelf", "-d", file))
    return found[0] if found else file.name


def found_by_loader(file):
    """Where the loader finds each library that the file needs, itself or by others."""
    pairs = re.findall(r"^\s*(\S+) => (/\S+)", output_of("ldd", file), re.MULTILINE)
    return {name: pathlib.Path(path) for name, path in pairs}


def glibc_asked_for(file):
    """The latest version of glibc whose symbols the file asks for, as a pair."""
    versions = re.findall(r"Name: GLIBC_(\d+)\.(\d+)", output_of("readelf", "-V", file))
    return max(((int(major), int(minor)) for major, minor in versions), default=(2, 5))


def patch(file, *words):
    """One change at a time: patchelf mixes up several in one call."""
    subprocess.run(["patchelf", *words, file], check=True)


def bundled_name(path):
    """A name that no other wheel's library has: two of one name would be loaded as one."""
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:8]
    stem, _, rest = path.name.partition(".so")
    return f"{stem}-{digest}.so{rest}"


def is_binary(path):
    """Whether it is a program or a shared library."""
    if not path.is_file() or path.is_symlink():
        return False
    with path.open("rb") as file:
        return file.read(4) == b"\x7fELF"


def bundle(tree, folder):
    """Copies libraries into the folder and lets all look for each other there.  Returns all files."""
    modules = sorted(filter(is_binary, tree.rglob("*")))
    ours = {name for module in modules for name in (module.name, soname_of(module))}
    folder.mkdir(parents=True)
    places = {}
    for module in modules:
        places.update({name: path for name, path in found_by_loader(module).items()
                       if name not in ours and not OF_THE_SYSTEM.match(name)})
    names = {name: bundled_name(path.resolve()) for name, path in places.items()}
    for name, path in sorted(places.items()):
        shutil.copyfile(path, folder / names[name])
    libraries = sorted(folder.iterdir())
    for module in modules:
        module.chmod(0o755)
    files = modules + libraries
    for file in files:
        missing = [name for name in needed_by(file)
                   if name not in names and name not in ours and not OF_THE_SYSTEM.match(name)]
        if missing:
            sys.exit(f"bundle: {file.name}: {', '.join(missing)} is not on this system")
        for name in needed_by(file):
            if name in names:
                patch(file, "--replace-needed", name, names[name])
        if file.parent == folder:
            patch(file, "--set-soname", file.name)
        patch(file, "--set-rpath", f"$ORIGIN/{os.path.relpath(folder, file.parent)}")
    # The library of DICOM looks for its dictionary beside it (io/volume/dicom/read_dicom.cpp).
    if any(name.startswith("libdcmdata.") for name in places):
        dictionary, = pathlib.Path("/usr/share").glob("libdcmtk*/dicom.dic")
        shutil.copyfile(dictionary, folder / dictionary.name)
    return files


def record_row(tree, file):
    digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=")
    return f"{file.relative_to(tree)},sha256={digest.decode()},{file.stat().st_size}\n"


def write_wheel(tree, info, target):
    """Zips the tree with a new list of its files."""
    files = sorted(path for path in tree.rglob("*") if path.is_file() and path.name != "RECORD")
    record = info / "RECORD"
    record.write_text("".join(record_row(tree, file) for file in files)
                      + f"{record.relative_to(tree)},,\n")
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as out:
        for file in [*files, record]:
            out.write(file, file.relative_to(tree))


def bundle_wheel(wheel, target):
    with tempfile.TemporaryDirectory() as folder:
        tree = pathlib.Path(folder)
        with zipfile.ZipFile(wheel) as old:
            old.extractall(tree)
        files = bundle(tree, tree / "mwmesh.libs")
        major, minor = max(glibc_asked_for(file) for file in files)
        tag = f"manylinux_{major}_{minor}_{platform.machine()}"
        (info,) = tree.glob("*.dist-info")
        facts = info / "WHEEL"
        facts.write_text(re.sub(r"(?m)^(Tag: .*-)[^-\n]+$", rf"\g<1>{tag}", facts.read_text()))
        name = re.sub(r"-[^-]+\.whl$", f"-{tag}.whl", wheel.name)
        target.mkdir(parents=True, exist_ok=True)
        write_wheel(tree, info, target / name)
        print(target / name)


def main():
    paths = [pathlib.Path(argument) for argument in sys.argv[1:]]
    if len(paths) not in (1, 2):
        sys.exit(__doc__)
    for tool in ("patchelf", "readelf"):
        if shutil.which(tool) is None:
            sys.exit(f"bundle: needs {tool}: apt-get install patchelf binutils")
    if len(paths) == 2:
        bundle_wheel(*paths)
    else:
        bundle(paths[0], paths[0] / "lib" / "bundled")


main()
