#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of meshes show what they should where they should, as another PNG reader sees them."""
import os
import struct
import sys
import unittest
import zlib

from program import enter_folder, refused, run

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# The colours of the labels 1 and 2 in the palette.
BLUE = (78, 121, 167)
ORANGE = (242, 142, 43)
WHITE = (255, 255, 255)


def draw(mesh, picture, *arguments):
    """Without edges."""
    return run("picture", mesh, "-o", picture, "--edges", "off", *arguments)


def paeth(a, b, c):
    pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def unfiltered(kind, line, above, step):
    line = bytearray(line)
    for i, _ in enumerate(line):
        left = line[i - step] if i >= step else 0
        corner = above[i - step] if i >= step else 0
        guess = (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]
        line[i] = (line[i] + guess) & 255
    return line


def read_png(path):
    """An array of rows, columns, colours."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, kinds = 8, b"", []
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        content = data[at + 8 : at + 8 + size]
        assert zlib.crc32(kind + content) == struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0]
        kinds.append(kind)
        if kind == b"IHDR":
            width, height, depth, colour, *rest = struct.unpack(">IIBBBBB", content)
        if kind == b"IDAT":
            packed += content
        at += 12 + size
    assert depth == 8 and rest == [0, 0, 0] and b"tIME" not in kinds, (depth, rest, kinds)
    step = {2: 3, 6: 4}[colour]
    raw, rows, above = zlib.decompress(packed), [], bytes(width * step)
    for y in range(height):
        line = raw[y * (width * step + 1) : (y + 1) * (width * step + 1)]
        above = unfiltered(line[0], line[1:], above, step)
        rows.append(numpy.frombuffer(bytes(above), numpy.uint8))
    return numpy.array(rows).reshape(height, width, step)


def count(image, colour):
    return int((image == numpy.array(colour, numpy.uint8)).all(axis=2).sum())


class Picture(unittest.TestCase):
    def setUp(self):
        enter_folder(self)

    def halves(self):
        """h.vtu: a cube of two labels, 1 where x is small."""
        labels = numpy.ones((20, 20, 20), numpy.uint8)
        labels[:, :, 12:] = 2  # [z, y, x]
        numpy.save("h.npy", labels)
        run("mesh", "h.npy", "-o", "h.vtu")

    def test_colours_are_where_the_labels_are(self):
        self.halves()
        out = draw("h.vtu", "h.png", "--view", "z", "--pixels", "200x160", "--cut", "z=0.5")
        self.assertNotIn("left out", out)
        image = read_png("h.png")
        self.assertEqual(image.shape, (160, 200, 3))
        # 4 % of the shorter side are left free, so the cube is 147.2 pixels wide; 12 of 20 are blue.
        side = 160 * 0.92
        self.assertAlmostEqual(count(image, BLUE) / side**2, 0.6, delta=0.02)
        self.assertAlmostEqual(count(image, ORANGE) / side**2, 0.4, delta=0.02)
        self.assertEqual(tuple(image[80, 60]), BLUE)
        self.assertEqual(tuple(image[80, 150]), ORANGE)
        self.assertEqual(tuple(image[3, 3]), WHITE)

    def test_lit_faces_keep_their_hue(self):
        self.halves()
        draw("h.vtu", "h.png", "--view", "z", "--pixels", "100x100")
        seen = read_png("h.png")[50, 20].astype(float)
        shares = seen / numpy.array(BLUE)
        self.assertLess(shares.max() - shares.min(), 0.02)
        self.assertGreater(shares.min(), 0.5)

    def test_edges_darken(self):
        self.halves()
        for edges in ("on", "off"):
            run("picture", "h.vtu", "-o", edges + ".png", "--view", "z", "--pixels", "300x300",
                "--edges", edges)
        with_edges, without = read_png("on.png").astype(int), read_png("off.png").astype(int)
        self.assertTrue((with_edges <= without).all())
        self.assertGreater((with_edges < without).any(axis=2).mean(), 0.01)
        self.assertLess((with_edges < without).any(axis=2).mean(), 0.4)

    def test_only_the_labels_asked_for(self):
        self.halves()
        draw("h.vtu", "one.png", "--labels", "2", "--view", "z", "--cut", "z=0.5", "--pixels", "100x100")
        image = read_png("one.png")
        self.assertEqual(count(image, BLUE), 0)
        # 8 x 20 voxels, of which 20 fill the height.
        self.assertAlmostEqual(count(image, ORANGE) / (92 * 92 * 0.4), 1, delta=0.05)

    def test_transparent_where_nothing_is(self):
        self.halves()
        run("picture", "h.vtu", "-o", "t.png", "--transparent", "--view", "z", "--pixels", "100x100")
        image = read_png("t.png")
        self.assertEqual(image.shape, (100, 100, 4))
        self.assertEqual(image[0, 0, 3], 0)
        self.assertEqual(image[50, 50, 3], 255)
        self.assertAlmostEqual(float(image[:, :, 3].sum()) / 255, 92 * 92, delta=100)

    def test_what_surrounds_the_others_is_left_out_and_said(self):
        labels = numpy.zeros((16, 16, 16), numpy.uint8)
        labels[4:12, 4:12, 4:12] = 2
        numpy.save("b.npy", labels)
        run("mesh", "b.npy", "-o", "b.vtu")
        out = draw("b.vtu", "b.png", "--cut", "y=0.5", "--pixels", "80x80")
        self.assertIn("left out    label 0", out)
        self.assertGreater(count(read_png("b.png"), ORANGE), 1000)
        out = draw("b.vtu", "b.png", "--cut", "y=0.5", "--pixels", "80x80", "--labels", "0,2")
        self.assertNotIn("left out", out)
        self.assertGreater(count(read_png("b.png"), (186, 176, 172)), count(read_png("b.png"), ORANGE))

    def test_a_body_without_its_background_is_shown(self):
        """Also where it alone reaches the box, and is around another label."""
        labels = numpy.zeros((20, 20, 20), numpy.uint8)
        labels[4:, 4:16, 4:16] = 1
        labels[10:14, 8:12, 8:12] = 2
        numpy.save("b.npy", labels)
        run("mesh", "b.npy", "-o", "b.vtu", "--background", "0")
        out = draw("b.vtu", "b.png", "--cut", "y=0.5", "--pixels", "80x80")
        self.assertNotIn("left out", out)
        self.assertGreater(count(read_png("b.png"), BLUE), 1000)

    def legend(self, name, *arguments):
        """The picture of h.vtu with its legend, and the part of it right of the scene."""
        run("picture", "h.vtu", "-o", name, "--view", "z", "--cut", "z=0.5", "--edges", "off",
            "--pixels", "600x450", *arguments)
        image = read_png(name)
        seen = numpy.flatnonzero((image[225] != 255).any(axis=1))
        return image, image[:, seen.max() + 2 :]

    def test_the_legend_has_a_box_of_each_label_the_largest_first(self):
        self.halves()
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write("id,name\n1,left\n2,Größe\n")
        image, side = self.legend("h.png", "--names", "names.csv")
        self.assertEqual((count(side, BLUE), count(side, ORANGE)), (13 * 13, 13 * 13))
        rows = [numpy.flatnonzero((side == numpy.array(c, numpy.uint8)).all(axis=2).any(axis=1))[0]
                for c in (BLUE, ORANGE)]
        self.assertLess(rows[0], rows[1])
        # Letters stand behind the boxes: more of them where names are longer.
        inks = [count(side[row : row + 15], (50, 50, 50)) for row in rows]
        self.assertLess(30, inks[0])
        self.assertLess(inks[0], inks[1])
        self.assertEqual(count(self.legend("o.png", "--legend", "off")[1], BLUE), 0)
        alone = self.legend("a.png", "--names", "names.csv", "--labels", "Größe")[1]
        self.assertEqual((count(alone, BLUE), count(alone, ORANGE)), (0, 13 * 13))

    def test_the_scale_bar_is_as_long_as_it_says(self):
        self.halves()
        image, side = self.legend("h.png")
        scene = (image[225] != 255).any(axis=1).sum()  # 20 units
        bar = (side[-12] == 50).all(axis=1).sum()
        self.assertAlmostEqual(bar / (scene / 20), 5, delta=0.1)

    def test_letters_say_the_directions(self):
        """Which differ between RAS and LPS, and are x, y and z where the frame is not known."""
        self.halves()
        pictures = {}
        for frame, space in (("own", ""), ("ras", "right-anterior-superior"),
                             ("lps", "left-posterior-superior")):
            with open("h.nrrd", "wb") as file:
                file.write("\n".join((
                    "NRRD0004", "type: uint8", "dimension: 3", "sizes: 20 20 20", "encoding: raw",
                    *((f"space: {space}", "space directions: (1,0,0) (0,1,0) (0,0,1)")
                      if space else ()), "", "")).encode() + numpy.load("h.npy").tobytes())
            run("mesh", "h.nrrd", "-o", "h.vtu")
            pictures[frame] = self.legend("h.png")[1]
        for a, b in (("own", "ras"), ("ras", "lps"), ("own", "lps")):
            different = (pictures[a] != pictures[b]).any(axis=2)
            self.assertGreater(different.sum(), 5, (a, b))
            self.assertTrue(numpy.flatnonzero(different.any(axis=1)).min() > 200)

    def test_names_give_colours(self):
        self.halves()
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write("id,name,r,g,b\n1,left,10,200,30\n")
        draw("h.vtu", "n.png", "--names", "names.csv", "--cut", "z=0.5", "--pixels", "80x80")
        self.assertGreater(count(read_png("n.png"), (10, 200, 30)), 500)

    def test_same_bytes_from_every_format(self):
        run("synth", "voronoi", "--shape", "16,16,16", "--labels", "8", "--seed", "2", "-o", "v.npy")
        run("mesh", "v.npy", "-o", "v.vtu")
        pictures = set()
        for mesh in ("v.vtu", "v.vtkhdf", "v.mesh", "v.vtu"):
            run("convert", "v.vtu", mesh) if not os.path.exists(mesh) else None
            run("picture", mesh, "-o", "v.png", "--cut", "x=0.4", "--pixels", "200x150")
            with open("v.png", "rb") as file:
                pictures.add(file.read())
        self.assertEqual(len(pictures), 1)

    def test_refuses_what_makes_no_sense(self):
        self.halves()
        run("convert", "h.vtu", "h.mesh")
        with open("h.mesh", encoding="utf-8") as file:
            lines = file.read().split("\n")
        first = lines.index("Vertices") + 2
        for name, place in (("nan", "nan 0 0 0"), ("far", "1e300 0 0 0")):
            with open(name + ".mesh", "w", encoding="utf-8") as file:
                file.write("\n".join(lines[:first] + [place] + lines[first + 1 :]))
        before = set(os.listdir("."))
        for code, piece, *arguments in (
            (2, "--labels: the mesh has no label 7", "h.vtu", "-o", "p.png", "--labels", "7"),
            (2, "on, off", "h.vtu", "-o", "p.png", "--legend", "left"),
            (2, "x=SHARE", "h.vtu", "-o", "p.png", "--cut", "w=0.5"),
            (2, "0 to 1", "h.vtu", "-o", "p.png", "--cut", "x=1.5"),
            (2, "AZIMUTH", "h.vtu", "-o", "p.png", "--view", "behind"),
            (2, "-90 to 90", "h.vtu", "-o", "p.png", "--view", "0,91"),
            (2, "8192", "h.vtu", "-o", "p.png", "--pixels", "9000x10"),
            (2, ".png", "h.vtu", "-o", "p.jpg"),
            (2, "MESH", "-o", "p.png"),
            (3, "no.vtu", "no.vtu", "-o", "p.png"),
            (3, "nan.mesh", "nan.mesh", "-o", "p.png"),
            (3, "far.mesh: vertices lie", "far.mesh", "-o", "p.png"),
        ):
            refused([piece], "picture", *arguments, code=code)
        self.assertEqual(set(os.listdir(".")), before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
