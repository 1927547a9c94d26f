#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""LS-DYNA's .k and Ansys' .cdb, read here field by field as their manuals lay them out."""
import csv
import re
import sys
import unittest

from program import enter_folder, refused, run

try:
    from reading_meshio import meshio
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def fields(line, width, count=None):
    """Integers of a line in fields of that many columns."""
    line = line.rstrip("\n")
    assert len(line) % width == 0, line
    out = [int(line[i:i + width]) for i in range(0, len(line), width)]
    assert count is None or len(out) == count, line
    return out


class Deck:
    """points {id: xyz}; tets [(id, material, nodes)]; node_sets, faces {name: [nodes, ...]}."""

    def __init__(self):
        self.points, self.tets = {}, []
        self.titles, self.materials = {}, set()
        self.node_sets, self.faces = {}, {}


def read_k(path):
    deck = Deck()
    with open(path, encoding="ascii") as file:
        lines = [line.rstrip("\n") for line in file if not line.startswith("$")]
    assert lines[0] == "*KEYWORD" and lines[-1] == "*END"
    assert max(map(len, lines)) <= 80
    cards, forms, parts = [], {}, {}
    for line in lines:
        if line.startswith("*"):
            cards.append((line, []))
        else:
            cards[-1][1].append(line)
    sets = {"node": [], "segment": []}
    for keyword, rows in cards:
        if keyword == "*NODE":
            for row in rows:
                deck.points[int(row[:8])] = [float(row[8 + 16 * i:24 + 16 * i]) for i in range(3)]
        elif keyword == "*SECTION_SOLID":
            number, form = fields(rows[0], 10, 2)
            forms[number] = form
        elif keyword == "*PART":
            number, section, material = fields(rows[1], 10, 3)
            deck.titles[number] = rows[0]
            parts[number] = forms[section], material
        elif keyword == "*MAT_ELASTIC":
            deck.materials.add(int(rows[0][:10]))
            assert [float(rows[0][i:i + 10]) for i in (10, 20, 30)] == [1, 1, 0.3]
        elif keyword == "*ELEMENT_SOLID":
            while rows:
                row = fields(rows.pop(0), 8)
                nodes = row[2:] or fields(rows.pop(0), 8, 10)
                assert parts[row[1]][0] == {8: 10, 10: 16}[len(nodes)]
                if len(nodes) == 8:
                    assert len(set(nodes[3:])) == 1
                    nodes = nodes[:4]
                deck.tets.append((row[0], row[1], nodes))
        elif keyword in ("*SET_NODE_LIST_TITLE", "*SET_SEGMENT_TITLE"):
            kind = "node" if "NODE" in keyword else "segment"
            sets[kind] += fields(rows[1], 10, 1)
            members = [fields(row, 10) for row in rows[2:]]
            if kind == "node":
                assert rows[0] not in deck.node_sets
                deck.node_sets[rows[0]] = sum(members, [])
                continue
            assert rows[0] not in deck.faces
            assert all(len(m) == 4 and m[2] == m[3] for m in members)
            deck.faces[rows[0]] = [m[:3] for m in members]
        else:
            assert keyword in ("*KEYWORD", "*TITLE", "*END"), keyword
    for numbers in sets.values():
        assert numbers == list(range(1, len(numbers) + 1))
    assert {material for _, material in parts.values()} == deck.materials
    return deck


def read_cdb(path):
    deck = Deck()
    with open(path, encoding="ascii") as file:
        lines = file.read().splitlines()
    types, elements, components, at = {}, {}, {}, 0
    while at < len(lines):
        words = [word.strip() for word in lines[at].split(",")]
        at += 1
        if words[0] == "ET":
            types[int(words[1])] = int(words[2])
        elif words[0] == "KEYOPT":
            assert words[1:3] == ["2", "1"]
            types["key"] = int(words[3])
        elif words[0] == "NBLOCK":
            assert words[1:3] == ["6", "SOLID"] and lines[at] == "(3i9,6e21.13e3)"
            for line in lines[at + 1:at + 1 + int(words[4])]:
                assert fields(line[:27], 9)[1:] == [0, 0] and len(line) == 27 + 3 * 21
                for i in (27, 48, 69):
                    assert re.fullmatch(r" *-?\d\.\d{13}E[+-]\d{3}", line[i:i + 21]), line
                deck.points[int(line[:9])] = [float(line[i:i + 21]) for i in (27, 48, 69)]
            assert len(deck.points) == int(words[4]) == max(deck.points) == int(words[3])
            at += 1 + int(words[4])
            assert lines[at].startswith("N,R5.3,LOC,")
            at += 1
        elif words[0] == "EBLOCK":
            assert words[1:3] == ["19", "SOLID"] and lines[at] == "(19i9)"
            at += 1
            while lines[at] != "       -1":
                row = fields(lines[at], 9)
                at += 1
                head, nodes = row[:11], row[11:]
                if head[8] > 8:
                    nodes += fields(lines[at], 9)
                    at += 1
                assert head[4:8] == [0, 0, 0, 0] and head[9] == 0 and len(nodes) == head[8]
                assert head[10] not in elements
                elements[head[10]] = head[0], types[head[1]], nodes
            at += 1
            assert len(elements) == int(words[4]) == max(elements) == int(words[3])
        elif words[0] == "CMBLOCK":
            assert re.fullmatch("[A-Za-z][A-Za-z0-9_]{0,31}", words[1]), words
            assert lines[at] == "(8i10)" and words[1].upper() not in components
            at += 1
            items = []
            while len(items) < int(words[3]):
                items += fields(lines[at], 10)
                at += 1
            members = []
            for item in items:
                members += range(members[-1] + 1, -item + 1) if item < 0 else [item]
            components[words[1].upper()] = words[1], words[2], members
        elif words[0] == "MP":
            deck.materials.add(int(words[2]))
        else:
            assert words[0] in ("/COM", "/PREP7", "FINISH"), words
    for name, kind, members in components.values():
        if kind == "NODE":
            deck.node_sets[name] = members
            continue
        kinds = {elements[m][1] for m in members}
        assert len(kinds) == 1
        if kinds == {200}:
            size = {4: 3, 5: 6}[types["key"]]
            assert {len(elements[m][2]) for m in members} == {size}
            deck.faces[name.removeprefix("F_")] = [elements[m][2] for m in members]
        else:
            (number,) = {elements[m][0] for m in members}
            deck.titles[number] = name
    for number, (material, kind, nodes) in elements.items():
        if kind != 200:
            assert (kind, len(nodes)) in ((285, 4), (187, 10))
            deck.tets.append((number, material, nodes))
    return deck


READERS = {"k": read_k, "cdb": read_cdb}


class Cards(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "11,10,9", "--labels", "7", "--seed", "2", "-o", "v.npy")
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write('id,name\n1,"Matrix (epoxy)-1"\n2,F_X_MIN\n3,' + "x" * 90 + "\n")
        run("mesh", "v.npy", "-o", "m.mesh", "--names", "names.csv", "--spacing", "0.5,1,2")
        run("mesh", "v.npy", "-o", "m.vtu", "--spacing", "0.5,1,2")
        mesh = meshio.read("m.vtu")
        cls.points, cls.tets = mesh.points, mesh.cells_dict["tetra"]
        cls.labels = mesh.cell_data_dict["label"]["tetra"].ravel()

    def canonical(self, points, tets, labels):
        """Tets by places of corners to ten digits, and labels."""
        rows = []
        for corners, label in zip(points[tets[:, :4]], labels):
            rows.append((*sorted(tuple(f"{x:.8e}" for x in p) for p in corners.tolist()),
                         str(label)))
        return sorted(rows)

    def check(self, deck, table, ten):
        with open(table, newline="", encoding="utf-8") as file:
            ids = {int(row["number"]): int(row["id"]) for row in csv.DictReader(file)}
        count = len(deck.points)
        self.assertEqual(sorted(deck.points), list(range(1, count + 1)))
        points = np.array([deck.points[i + 1] for i in range(count)])
        self.assertEqual(sorted(n for n, _, _ in deck.tets), list(range(1, len(self.tets) + 1)))
        tets = np.array([nodes for _, _, nodes in deck.tets]) - 1
        labels = np.array([ids[part] for _, part, _ in deck.tets])
        self.assertEqual(tets.shape[1], 10 if ten else 4)
        self.assertEqual(self.canonical(points, tets, labels),
                         self.canonical(self.points, self.tets, self.labels))
        a, b, c, d = (points[tets[:, i]] for i in range(4))
        volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
        self.assertGreater(volumes.min(), 0)
        if ten:
            for i, (p, q) in enumerate(EDGES):
                middle = (points[tets[:, p]] + points[tets[:, q]]) / 2
                np.testing.assert_allclose(points[tets[:, 4 + i]], middle, rtol=1e-8, atol=1e-8)
        self.assertEqual(sorted(deck.titles), sorted(deck.materials))
        self.assertEqual(len({title.upper() for title in deck.titles.values()}),
                         len(np.unique(self.labels)))
        self.check_faces(deck, points, tets, labels, {ids[n]: t for n, t in deck.titles.items()})

    def check_faces(self, deck, points, tets, labels, titles):
        """Triangles of tets with one owner or of two labels are in the sets of their sides, turned
        outwards, and no others are."""
        owners = {}
        for tet, label in zip(tets, labels):
            for i in range(4):
                owners.setdefault(frozenset(np.delete(tet[:4], i).tolist()), []).append(
                    (label, points[tet[i]]))
        seen = {}
        for name, faces in deck.faces.items():
            faces = np.array(faces) - 1
            if faces.shape[1] == 6:
                for i in range(3):
                    middle = (points[faces[:, i]] + points[faces[:, (i + 1) % 3]]) / 2
                    np.testing.assert_allclose(points[faces[:, 3 + i]], middle, atol=1e-8)
            elif tets.shape[1] == 10:  # LS-DYNA: four of each
                faces = self.joined(faces)
            for face in faces[:, :3]:
                key = frozenset(face.tolist())
                a, b, c = points[face]
                normal = np.cross(b - a, c - a)
                inside = [label for label, apex in owners[key] if normal @ (apex - a) < 0]
                self.assertEqual(len(inside), 1)
                seen.setdefault(key, []).append((name, inside[0]))
            nodes = set(faces.ravel().tolist()) if tets.shape[1] == 4 or faces.shape[1] == 6 else None
            if name in deck.node_sets and nodes is not None:
                self.assertEqual(deck.node_sets[name], sorted(n + 1 for n in nodes))
        wanted = {key for key, both in owners.items() if both[0][0] != both[-1][0] or len(both) == 1}
        self.assertEqual(set(seen), wanted)
        lo, hi = points.min(0), points.max(0)
        for key, sets in seen.items():
            if len(owners[key]) == 1:
                ((name, _),) = sets
                axis, end = "XYZ".index(name[0]), {"MIN": lo, "MAX": hi}[name[2:]]
                np.testing.assert_allclose(points[list(key)][:, axis], end[axis], atol=1e-9)
                continue
            (one, first), (other, second) = sets
            self.assertNotEqual(one, other)
            self.assertEqual({first, second}, {label for label, _ in owners[key]})
        self.assertEqual(set(deck.node_sets) - set(deck.faces), set())
        for side in ("X_MIN", "X_MAX", "Y_MIN", "Y_MAX", "Z_MIN", "Z_MAX"):
            self.assertIn(side, deck.node_sets)

    @staticmethod
    def joined(faces):
        """Six nodes from each four triangles."""
        out = []
        for i in range(0, len(faces), 4):
            (a, d, f), (d2, b, e), (f2, e2, c), inner = faces[i:i + 4]
            assert (d, e, f) == (d2, e2, f2) == tuple(inner)
            out.append((a, b, c, d, e, f))
        return np.array(out)

    def test_decks_hold_the_mesh(self):
        for ending, reader in READERS.items():
            for element in ("tet4", "tet10"):
                run("convert", "m.vtu", f"m.{ending}", "--element", element)
                self.check(reader(f"m.{ending}"), f"m.{ending}.labels.csv", element == "tet10")

    def test_names_are_those_that_the_programs_allow(self):
        run("convert", "m.mesh", "m.cdb")
        run("convert", "m.mesh", "m.k")
        titles = read_cdb("m.cdb").titles
        self.assertEqual([titles[i] for i in (1, 2)], ["Matrix_epoxy_1", "F_X_MIN_2"])
        self.assertEqual(len(titles[3]), 32)
        with open("m.cdb", encoding="ascii") as file:
            content = file.read()
        for name in ("F_X_MIN", "F_X_MIN_2"):  # of the side, and of the label
            self.assertEqual(content.count(f"CMBLOCK,{name},ELEM,"), 1)
        titles = read_k("m.k").titles
        self.assertEqual([titles[i] for i in (1, 2)], ["Matrix_epoxy_-1", "F_X_MIN"])
        self.assertEqual(len(titles[3]), 80)

    def test_open_interfaces_have_two_node_sets(self):
        run("mesh", "v.npy", "-o", "s.vtu", "--split", "*")
        for ending, reader in READERS.items():
            run("convert", "s.vtu", f"s.{ending}")
            deck = reader(f"s.{ending}")
            pairs = [name for name in deck.node_sets if name.startswith("FACE_")]
            self.assertGreater(len(pairs), 4)
            for name in pairs:
                _, a, b = name.split("_")
                nodes = set(np.ravel(deck.faces[name]).tolist())
                self.assertEqual(deck.node_sets[name], sorted(nodes))
                self.assertFalse(nodes & set(deck.node_sets[f"FACE_{b}_{a}"]))

    def test_what_does_not_fit_is_refused(self):
        with open("large.mesh", "w", encoding="ascii") as file:
            file.write("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1e120 0 0 0\n"
                       "0 1e120 0 0\n0 0 -1e120 0\nTetrahedra\n1\n1 3 2 4 5\nEnd\n")
        refused(["exponent"], "convert", "large.mesh", "large.k", code=2)
        run("convert", "large.mesh", "large.cdb")
        self.assertEqual(read_cdb("large.cdb").points[4], [0, 0, -1e120])


if __name__ == "__main__":
    unittest.main()
