#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""What one thread does alone is next to nothing in every stage of a run, so that many cores help."""

import json
import pathlib
import unittest

from program import enter_folder, run

# Shares of the whole run.  A small volume has relatively more of it than a large one.
MOST_OF_A_STAGE = 0.003
MOST_OF_ALL = 0.009
PATIENCE = 4  # runs, of which one has to be within these


def performance(threads):
    run("mesh", "v.npy", "-o", "v.vtkhdf", "--threads", threads, "--report", "r.json")
    return json.loads(pathlib.Path("r.json").read_text(encoding="utf-8"))["performance"]


class Costs(unittest.TestCase):
    def setUp(self):
        enter_folder(self)
        run("synth", "voronoi", "--shape", "64,64,64", "--labels", "200", "--seed", "1", "-o", "v.npy")

    def test_every_stage_is_shared(self):
        # What another process does to a cache or a disk counts as work of one thread.
        for _ in range(PATIENCE - 1):
            try:
                return self.expect_shared(performance(1))
            except AssertionError as late:
                print(late)
        return self.expect_shared(performance(1))

    def expect_shared(self, found):
        costs = {stage["name"]: stage for stage in found["costs"]}
        for name in ("labels", "prepare", "march", "output", "certificate", "parts", "figures", "file"):
            self.assertIn(name, costs)
        whole = sum(stage["cpu_s"] for stage in costs.values())
        self.assertLessEqual(whole, found["cpu_s"])
        self.assertGreater(whole, 0.9 * found["cpu_s"])
        for name, stage in costs.items():
            self.assertLessEqual(stage["alone_s"], MOST_OF_A_STAGE * whole, name)
        self.assertLessEqual(sum(stage["alone_s"] for stage in costs.values()), MOST_OF_ALL * whole)

    def test_several_threads_do_not_tell_what_one_does_alone(self):
        for stage in performance(2)["costs"]:
            self.assertIsNone(stage["alone_s"])


if __name__ == "__main__":
    unittest.main()
