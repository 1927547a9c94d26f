# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Tables as text, and rows from reports."""

import unittest

import rows
import studies
from render import Column, Table, change, count, percent, short, to_csv, to_markdown
from runs import Facts, RunFailure, median_run

TWO = Table(
    "two",
    "A title",
    [Column("name"), Column("n", count), Column("share", percent), Column("RR", short)],
    [
        {"name": "a|b", "n": 1234567, "share": 12.3456, "RR": 2.3e-6, "unused": 1},
        {"name": "c", "n": None, "share": 0},
    ],
    ["a note"],
)


class Text(unittest.TestCase):
    def test_markdown_is_for_readers(self):
        self.assertEqual(
            to_markdown(TWO),
            "## A title\n\n"
            "| name | n | share | RR |\n"
            "| --- | --- | --- | --- |\n"
            "| a/b | 1,234,567 | 12.3 % | 2.3e-06 |\n"
            "| c |  | 0 % |  |\n\n"
            "- a note\n",
        )

    def test_csv_is_for_programs(self):
        self.assertEqual(
            to_csv(TWO), "name,n,share,RR\na|b,1234567,12.3456,2.3e-06\nc,,0,\n"
        )

    def test_changes_have_signs(self):
        self.assertEqual([change(n) for n in (-3, 0, 4)], ["-3", "0", "+4"])


def label_distance(there, back):
    return {
        "label": 1,
        "input_to_mesh_max": there,
        "input_to_mesh_mean": there and there / 2,
        "mesh_to_input_max": back,
        "mesh_to_input_mean": back and back / 2,
    }


def fake_run(mode, changed=0, components=5, distances=()):
    return Facts(
        "volume.npy",
        mode.name,
        run={
            "input": {"voxels": 1000},
            "output": {"vertices": 30, "tets": 99, "vertex_fraction": 0.0225},
            "quality": {
                "radius_ratio_min": 0.25,
                "radius_ratio_mean": 0.75,
                "sliver_fraction": 0.015,
                "dihedral_min_deg": 11,
            },
            "performance": {
                "wall_s": 2.0,
                "cpu_s": 1.5,
                "voxels_per_s": 500.0,
                "peak_rss_bytes": 3 * 2**20,
                "stages": {
                    "labels_s": 1,
                    "prepare_s": 2,
                    "start_s": 4,
                    "simplify_s": 8,
                    "optimise_s": 16,
                    "exchange_s": 32,
                    "output_s": 64,
                },
            },
            "engine": {"windows": 8, "bytes_written": 0},
        },
        check={
            "labels": 9,
            "topology": {"labels_changed": changed},
            "checks": [{"name": "A", "passed": True}, {"name": "B", "passed": changed == 0}],
            "distance": {"per_label": list(distances)},
        },
        shape={"labels": 8, "components": components},
    )


def failed(mode):
    return Facts("volume.npy", mode.name, failure="refused")


class Rows(unittest.TestCase):
    def test_distance_leaves_out_labels_with_a_boundary_on_one_side_only(self):
        distances = [label_distance(2.0, 1.0), label_distance(None, None), label_distance(0.5, 4.0)]
        found = rows.distance(fake_run(studies.DEFAULT, distances=distances))
        self.assertEqual(found["distance max"], 4.0)
        self.assertEqual(found["distance mean"], (1.0 + 0.5 + 0.25 + 2.0) / 4)

    def test_components_of_the_volume_come_from_a_mesh_that_kept_all_labels(self):
        lossy = fake_run(studies.CGAL, changed=3, components=2)
        exact = fake_run(studies.DEFAULT)
        self.assertIsNone(rows.components_of_volume([lossy, failed(studies.PAPER)]))
        known = rows.components_of_volume([lossy, exact])
        self.assertEqual(rows.topology(lossy, known)["change of components"], -3)
        self.assertEqual(rows.topology(lossy, known)["labels lost"], 1)

    def test_stages_are_split_into_io_and_process(self):
        found = rows.stages(fake_run(studies.DEFAULT))
        self.assertEqual((found["I/O s"], found["process s"]), (99, 28))

    def test_failing_checks_are_named(self):
        found = rows.failing(fake_run(studies.DEFAULT, changed=1))
        self.assertEqual(found, {"verify fails": "B"})


class Studies(unittest.TestCase):
    def build(self, name, make):
        study = studies.TABLES[name]
        return study.build({"volume.npy": {mode: make(mode) for mode in study.modes}})

    def ours(self, table):
        return [row for row in table.rows if row["volume"] == "volume.npy"]

    def test_every_table_has_a_row_for_each_run(self):
        for name, study in studies.TABLES.items():
            table = self.build(name, fake_run)
            self.assertEqual(len(self.ours(table)), len(study.modes), name)
            columns = {column.name for column in table.columns}
            for row in self.ours(table):
                missing = columns - row.keys() - {"distance max", "distance mean"}
                self.assertEqual(missing, set(), name)

    def test_a_failed_run_is_a_row_with_the_reason(self):
        for name, study in studies.TABLES.items():
            table = self.build(name, failed)
            self.assertEqual(
                [row["note"] for row in self.ours(table)], ["refused"] * len(study.modes), name
            )
            self.assertIn("| refused |", to_markdown(table))
            self.assertIn(",refused\n", to_csv(table))

    def test_table_2_has_ours_and_the_paper_s_side_by_side(self):
        text = to_markdown(self.build("2", fake_run))
        ours = "| volume.npy | default | 1,000 | 30 | 2.25 % | 3 | 2.0 | 1.5 | 500 |  |"
        self.assertIn(ours, text)
        self.assertIn("| Kidney | paper: Marching Windows |", text)


class Repeats(unittest.TestCase):
    @staticmethod
    def report(seconds, digest="same"):
        return {"digest": digest, "performance": {"wall_s": seconds, "stages": {"a_s": seconds}}}

    def test_times_are_medians_stages_too(self):
        run = median_run([self.report(seconds) for seconds in (9, 1, 2)])
        self.assertEqual(run["performance"], {"wall_s": 2, "stages": {"a_s": 2}})

    def test_different_meshes_are_a_failure(self):
        with self.assertRaises(RunFailure):
            median_run([self.report(1), self.report(1, "other")])


if __name__ == "__main__":
    unittest.main()
