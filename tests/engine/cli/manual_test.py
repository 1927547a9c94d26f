#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The manual page and the completions hold every flag of every subcommand, and shells take them."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["MW_PROGRAM"]
KINDS = ("man", "bash", "zsh", "fish")


def run(*arguments, **options):
    done = subprocess.run(arguments, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def generated(kind):
    return run(PROGRAM, "generate", kind)


def listed(text, heading):
    """First words of the indented lines below a heading of help."""
    part = text.split(f"\n{heading}:\n", 1)[1] if f"\n{heading}:\n" in text else ""
    return re.findall(r"^  (\S+)", part.split("\n\n", 1)[0], re.MULTILINE)


COMMANDS = listed(run(PROGRAM, "--help"), "Subcommands")
FLAGS = {
    command: sorted(
        name
        for entry in listed(run(PROGRAM, command, "--help"), "Options")
        for name in entry.split(",")
    )
    for command in COMMANDS
}


def offers(*words):
    """What bash offers for the last of the words."""
    split = [part for word in words for part in re.split("(=)", word) if part or word == ""]
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _mwmesh; printf "%s\\n" "${COMPREPLY[@]}"'
    with tempfile.NamedTemporaryFile("w", suffix=".bash") as file:
        file.write(generated("bash"))
        file.flush()
        out = run("bash", "--norc", "-c", script, "bash", file.name, "mwmesh", *split)
    return sorted(out.split())


class Manual(unittest.TestCase):
    def test_help_was_understood(self):
        self.assertIn("mesh", COMMANDS)
        self.assertNotIn("generate", COMMANDS)
        self.assertIn("--edge-variance", FLAGS["mesh"])
        self.assertIn("--json", FLAGS["info"])
        self.assertIn("-o", FLAGS["mesh"])
        self.assertTrue(all(len(flags) >= 3 for flags in FLAGS.values()), FLAGS)

    def test_same_bytes_each_time_and_plain(self):
        for kind in KINDS:
            text = generated(kind)
            self.assertEqual(text, generated(kind))
            self.assertTrue(text.isascii(), kind)
            self.assertNotRegex(text, r"\b20[2-9]\d\b", kind)

    def test_help_no_longer_promises(self):
        for command in COMMANDS:
            self.assertNotIn("comes later", run(PROGRAM, command, "--help"))

    def test_manual_page_has_every_flag(self):
        text = generated("man").replace("\\-", "-")
        for command, flags in FLAGS.items():
            section = text.split(f".SS mwmesh {command}\n", 1)[1].split("\n.S", 1)[0]
            heads = set(re.findall(r"\\fB(-[-\w]*)\\fR", section))
            self.assertEqual(heads, set(flags), command)

    def test_man_takes_the_page(self):
        groff = shutil.which("groff")
        man = shutil.which("man")
        if not groff and not man:
            self.skipTest("neither groff nor man")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mwmesh.1")
            with open(path, "w", encoding="ascii") as file:
                file.write(generated("man"))
            if groff:
                done = subprocess.run(
                    [groff, "-man", "-ww", "-z", "-Tascii", path], capture_output=True, text=True, check=False
                )
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            else:
                page = subprocess.run(
                    [man, "-l", path], capture_output=True, text=True, check=False, env={**os.environ, "MANWIDTH": "80"}
                )
                self.assertIn("--edge-variance", page.stdout)

    def test_bash_offers_every_flag(self):
        self.assertEqual(offers(""), sorted([*COMMANDS, "-h", "--help", "--version"]))
        self.assertEqual(offers("ver"), ["verify"])
        for command, flags in FLAGS.items():
            self.assertEqual(offers(command, "-"), flags)
        self.assertEqual(offers("mesh", "v.npy", "--win"), ["--window"])

    def test_bash_offers_values(self):
        self.assertEqual(offers("mesh", "--start", ""), ["coarse", "dense", "octree"])
        self.assertEqual(offers("mesh", "--start", "d"), ["dense"])
        self.assertEqual(offers("mesh", "--start=d"), ["dense"])
        self.assertEqual(offers("mesh", "--start="), ["coarse", "dense", "octree"])
        self.assertEqual(offers("mesh", "--max-distance", ""), ["none"])
        self.assertEqual(offers("synth", "v"), ["voronoi"])
        # Files are bash's own affair.
        self.assertEqual(offers("mesh", ""), [])
        self.assertEqual(offers("mesh", "-o", ""), [])

    def test_other_shells_have_every_flag(self):
        zsh, fish = generated("zsh"), generated("fish")
        for command, flags in FLAGS.items():
            part = zsh.split(f"    {command})\n", 1)[1].split(";;", 1)[0]
            self.assertEqual(sorted(re.findall(r"^ +'(-[-\w]*)\[", part, re.MULTILINE)), flags)
            rows = [row for row in fish.splitlines() if f"__fish_seen_subcommand_from {command}'" in row]
            names = []
            for row in rows:
                names += ["-" + name for name in re.findall(r" -s (\S+)", row.split(" -d ")[0])]
                names += ["--" + name for name in re.findall(r" -l (\S+)", row.split(" -d ")[0])]
            self.assertEqual(sorted(names), flags)

    def test_shells_parse_their_scripts(self):
        for shell in ("bash", "zsh", "fish"):
            if not shutil.which(shell):
                print(f"skipped: no {shell}")
                continue
            with tempfile.NamedTemporaryFile("w") as file:
                file.write(generated(shell))
                file.flush()
                run(shell, "-n", file.name)

    def test_generates_whatever_the_environment(self):
        run(PROGRAM, "generate", "man", env={**os.environ, "MW_FOO": "1"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
