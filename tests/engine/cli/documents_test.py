# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What documents tell users to type works: commands and Python of README.md, options elsewhere;
the manual names options that there are, and io/FORMATS.md each format."""
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

try:
    import nibabel
    import numpy as np
except ImportError:
    raise SystemExit(77)
from program import PROGRAM, enter_folder, start

ROOT = pathlib.Path(__file__).resolve().parents[3]
DOCUMENTS = [ROOT / "README.md", *sorted(
    path for folder in ("engine", "kernels", "io", "tests", "bench", "configs")
    for path in (ROOT / folder).rglob("*.md"))]
MANUAL = ROOT / "engine" / "MANUAL.md"
FORMATS = ROOT / "io" / "FORMATS.md"
COMMANDS = ("mesh", "convert", "verify", "info", "surface", "picture", "serve", "digest", "synth")


def help_of(command):
    """All options of a command."""
    done = start(command, "--help-all")
    done = done if done.returncode == 0 else start(command, "--help")
    return done.stdout


def slug(title):
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def blocks(document):
    """(language, text) of the fenced blocks of a document."""
    return re.findall(r"^```(\w*)\n(.*?)^```", document.read_text(), re.M | re.S)


def commands(text):
    """The words of each line of a block that starts our program."""
    for line in text.replace("\\\n", " ").splitlines():
        if re.match(r"(build/release/)?mwmesh ", line):
            yield shlex.split(line, comments=True)[1:]


def all_commands(document):
    """Those of its blocks, and those within its sentences."""
    for _, text in blocks(document):
        yield from commands(text)
    for text in re.findall(r"`mwmesh ([a-z]+ [^`]*)`", document.read_text()):
        yield text.split()


class Documents(unittest.TestCase):
    def test_options_in_commands_exist(self):
        helps, seen = {}, 0
        for document in DOCUMENTS:
            for command, *words in all_commands(document):
                helps.setdefault(command, help_of(command))
                for flag in re.findall(r"--[a-z][a-z-]*", " ".join(words)):
                    with self.subTest(document=document.name, command=command, flag=flag):
                        self.assertRegex(helps[command], re.escape(flag) + r"\b")
                        seen += 1
        self.assertGreater(seen, 10)

    def test_options_of_the_manual_exist(self):
        known = set(re.findall(r"--[a-z][a-z-]*", "".join(map(help_of, COMMANDS))))
        named = set(re.findall(r"`(--[a-z][a-z-]*)", MANUAL.read_text()))
        self.assertGreater(len(named), 50)
        self.assertEqual(named - known, {"--help-all"})

    def test_formats_that_are_read_or_written_are_described(self):
        formats = FORMATS.read_text()
        last = [line for command in ("mesh", "convert") for line in help_of(command).splitlines()
                if line.startswith((".", "OUT", "MESH:"))]
        endings = set(re.findall(r"\.[a-z][a-z0-9]+", " ".join(last)))
        self.assertGreater(len(endings), 20)
        for ending in sorted(endings) + [".stl", ".ply", ".obj", ".vtp"]:
            with self.subTest(ending=ending):
                self.assertTrue(f"`{ending}`" in formats)

    def test_links_between_documents_lead_somewhere(self):
        seen = 0
        for document in DOCUMENTS:
            for target in re.findall(r"\]\(([^)\s]+)\)", document.read_text()):
                if re.match(r"[a-z]+:", target):
                    continue
                with self.subTest(document=str(document.relative_to(ROOT)), target=target):
                    name, _, anchor = target.partition("#")
                    path = (document.parent / name).resolve() if name else document
                    self.assertTrue(path.exists())
                    if anchor:
                        titles = re.findall(r"^#+ (.*)$", path.read_text(), re.M)
                        self.assertIn(anchor, map(slug, titles))
                    seen += 1
        self.assertGreater(seen, 50)

    def test_headers_link_the_specifications_that_formats_name(self):
        headers = "".join(path.read_text() for path in (ROOT / "io").rglob("*.h"))
        links = set(re.findall(r"\]\((https?://[^)]*)\)", FORMATS.read_text()))
        self.assertGreater(len(links), 30)
        for link in sorted(links):
            with self.subTest(link=link):
                self.assertTrue(re.search(re.escape(link) + r"(\s|$)", headers))

    def make_volumes(self):
        enter_folder(self)
        labels = np.zeros((24, 20, 18), np.uint8)
        labels[4:20, 4:16, 3:15] = 5
        labels[8:16, 7:13, 6:12] = 17
        edited = labels.copy()
        edited[4:7, 4:7, 3:6] = 0
        for name, array in (("brain", labels), ("edited", edited)):
            nibabel.save(nibabel.Nifti1Image(array, np.diag([1.0, 1, 1, 1])), f"{name}.nii.gz")
        return labels

    def make_volumes_of_others(self, labels):
        """A folder of masks as TotalSegmentator writes it, a Zarr array, an array of grains."""
        os.mkdir("totalseg")
        for name, label in (("liver", 5), ("heart", 17)):
            mask = nibabel.Nifti1Image((labels == label).astype(np.uint8), np.eye(4))
            nibabel.save(mask, f"totalseg/{name}.nii.gz")
        os.mkdir("neurons.zarr")
        shape = list(labels.shape)
        pathlib.Path("neurons.zarr/.zarray").write_text(json.dumps(
            {"zarr_format": 2, "shape": shape, "chunks": shape, "dtype": "|u1", "order": "C",
             "compressor": None, "filters": None, "fill_value": 0}))
        pathlib.Path("neurons.zarr/0.0.0").write_bytes(labels.tobytes())
        np.save("grains.npy", np.where(labels == 0, 1, labels)[:20, :20, :16])

    def test_commands_of_the_readme_work(self):
        self.make_volumes_of_others(self.make_volumes())
        kept = start("mesh", "brain.nii.gz", "-o", "first.vtu", "--keep", "kept")
        self.assertEqual(kept.returncode, 0, kept.stderr)
        readme = (ROOT / "README.md").read_text()
        section = readme[readme.index("## Commands"):]
        text = re.search(r"^```\n(.*?)^```", section, re.M | re.S).group(1)
        ran = 0
        for words in commands(text):
            done = start(*words)
            self.assertEqual(done.returncode, 0, (words, done.stderr))
            ran += 1
        self.assertEqual(ran, 9)
        for name in ("brain.vtu", "thalamus.stl", "brain.png", "torso.inp", "rve.inp"):
            self.assertGreater(os.path.getsize(name), 500)

    def test_python_of_the_readme_works(self):
        package = pathlib.Path(PROGRAM).parent / "python"
        if not (package / "mwmesh").is_dir():
            self.skipTest("built without Python")
        self.make_volumes()
        snippets = [text for language, text in blocks(ROOT / "README.md") if language == "python"]
        self.assertEqual(len(snippets), 1)
        done = subprocess.run([sys.executable, "-c", snippets[0]], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(package)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("17:", done.stdout)


if __name__ == "__main__":
    unittest.main()
