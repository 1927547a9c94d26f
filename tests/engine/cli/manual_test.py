#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Manual pages and completions hold every flag of every subcommand, and shells take them."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["MW_PROGRAM"]
KINDS = ("man", "bash", "zsh", "fish")
# Those that have subcommands.
PROGRAMS = ("mwmesh", "mwmesh-mpi")


def run(*arguments, **options):
    done = subprocess.run(arguments, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout


def generated(kind, program="mwmesh"):
    return run(PROGRAM, "generate", kind, program)


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


def commands_of(program):
    return COMMANDS if program == "mwmesh" else ["mesh"]


def offers(*words, program="mwmesh"):
    """What bash offers for the last of the words."""
    split = [part for word in words for part in re.split("(=)", word) if part or word == ""]
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); "_$1"; printf "%s\\n" "${COMPREPLY[@]}"'
    with tempfile.NamedTemporaryFile("w", suffix=".bash") as file:
        file.write(generated("bash", program))
        file.flush()
        out = run("bash", "--norc", "-c", script, "bash", file.name, program, *split)
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
        for program in PROGRAMS:
            for kind in KINDS:
                text = generated(kind, program)
                self.assertEqual(text, generated(kind, program))
                self.assertTrue(text.isascii(), kind)
                self.assertNotRegex(text, r"\b20[2-9]\d\b", kind)
        self.assertEqual(run(PROGRAM, "generate", "man"), generated("man"))

    def test_other_programs_are_refused(self):
        done = subprocess.run([PROGRAM, "generate", "man", "mwmesh-x"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected mwmesh, mwmesh-mpi or mwmesh-codt", done.stderr)

    def test_help_no_longer_promises(self):
        for command in COMMANDS:
            self.assertNotIn("comes later", run(PROGRAM, command, "--help"))

    def test_manual_page_has_every_flag(self):
        for program in PROGRAMS:
            text = generated("man", program).replace("\\-", "-")
            sections = re.findall(rf"^\.SS {program} (\w+)$", text, re.MULTILINE)
            self.assertEqual(sections, commands_of(program))
            for command in sections:
                section = text.split(f".SS {program} {command}\n", 1)[1].split("\n.S", 1)[0]
                heads = set(re.findall(r"\\fB(-[-\w]*)\\fR", section))
                self.assertEqual(heads, set(FLAGS[command]), command)

    def test_man_takes_the_pages(self):
        if not shutil.which("groff") and not shutil.which("man"):
            self.skipTest("neither groff nor man")
        for program in (*PROGRAMS, "mwmesh-codt"):
            with self.subTest(program), tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, program + ".1")
                with open(path, "w", encoding="ascii") as file:
                    file.write(generated("man", program))
                self.take_page(path, program)

    def take_page(self, path, program):
        if shutil.which("groff"):
            done = subprocess.run(
                ["groff", "-man", "-ww", "-z", "-Tascii", path], capture_output=True, text=True, check=False
            )
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        else:
            page = subprocess.run(
                ["man", "-l", path], capture_output=True, text=True, check=False, env={**os.environ, "MANWIDTH": "80"}
            )
            self.assertIn(program + " - ", page.stdout)

    def test_bash_offers_every_flag(self):
        self.assertEqual(offers(""), sorted([*COMMANDS, "-h", "--help", "--version"]))
        self.assertEqual(offers("ver"), ["verify"])
        for command, flags in FLAGS.items():
            self.assertEqual(offers(command, "-"), flags)
        self.assertEqual(offers("mesh", "v.npy", "--win"), ["--window"])
        self.assertEqual(offers("m", program="mwmesh-mpi"), ["mesh"])
        self.assertEqual(offers("verify", "-", program="mwmesh-mpi"), [])
        self.assertEqual(offers("mesh", "-", program="mwmesh-mpi"), FLAGS["mesh"])

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
        for program in PROGRAMS:
            zsh, fish = generated("zsh", program), generated("fish", program)
            self.assertTrue(zsh.startswith(f"#compdef {program}\n"))
            for command in commands_of(program):
                part = zsh.split(f"    {command})\n", 1)[1].split(";;", 1)[0]
                self.assertEqual(sorted(re.findall(r"^ +'(-[-\w]*)\[", part, re.MULTILINE)), FLAGS[command])
                start = f"complete -c {program} -n '__fish_seen_subcommand_from {command}'"
                rows = [row.split(" -d ")[0] for row in fish.splitlines() if row.startswith(start)]
                names = []
                for row in rows:
                    names += ["-" + name for name in re.findall(r" -s (\S+)", row)]
                    names += ["--" + name for name in re.findall(r" -l (\S+)", row)]
                self.assertEqual(sorted(names), FLAGS[command])

    def test_shells_parse_their_scripts(self):
        for shell in ("bash", "zsh", "fish"):
            if not shutil.which(shell):
                print(f"skipped: no {shell}")
                continue
            for program in PROGRAMS:
                with tempfile.NamedTemporaryFile("w") as file:
                    file.write(generated(shell, program))
                    file.flush()
                    run(shell, "-n", file.name)

    def test_generates_whatever_the_environment(self):
        run(PROGRAM, "generate", "man", env={**os.environ, "MW_FOO": "1"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
