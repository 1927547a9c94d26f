#!/usr/bin/env python3
# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a run is whole, tells what the report tells, needs no network, and its view runs."""
import base64
import html.parser
import json
import os
import re
import resource
import shlex
import shutil
import subprocess
import sys
import unittest

from program import RESIDENT_MEMORY_IS_OURS, enter_folder, refused, run

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

CHROMIUM = shutil.which("chromium")
ADDRESSES = ("src", "href", "action", "data", "srcset")
VOID = {"meta", "br", "img", "input", "link", "hr"}
EVIL = "</script><script>alert(1)</script> <b>&\"quoted\""


class Page(html.parser.HTMLParser):
    """Text, scripts by id, addresses; wrong nesting is an error."""

    def __init__(self, path):
        super().__init__()
        self.open, self.text, self.scripts, self.addresses, self.tags = [], [], {}, [], []
        with open(path, encoding="utf-8") as file:
            self.source = file.read()
        self.feed(self.source)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self.addresses += [attributes[key] for key in ADDRESSES if key in attributes]
        if tag not in VOID:
            self.open.append((tag, attributes.get("id", "")))

    def handle_startendtag(self, tag, attributes):
        self.tags.append(tag)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1][0] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1][0] == "script":
            self.scripts[self.open[-1][1]] = self.scripts.get(self.open[-1][1], "") + data
        else:
            self.text.append(data)


class RunPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        enter_folder(cls)
        run("synth", "voronoi", "--shape", "24,20,16", "--labels", "12", "--seed", "1", "-o", "v.npy")
        with open("names.csv", "w", encoding="utf-8") as file:
            file.write('id,name,r,g,b\n1,"%s",1,2,3\n' % EVIL.replace('"', '""'))
        cls.out = run(
            "mesh", "v.npy", "-o", "v.vtu", "--names", "names.csv", "--report", "v.json", "--html", "v.html",
            "--memory", "192MiB"
        )
        cls.peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
        cls.page = Page("v.html")
        with open("v.json", encoding="utf-8") as file:
            cls.report = json.load(file)

    def test_asks_no_network(self):
        self.assertIn("v.html", self.out)
        for address in self.page.addresses:
            self.assertTrue(address.startswith("data:image/png;base64,"), address[:60])
        self.assertEqual(len(self.page.addresses), 2)
        for piece in ("http:", "https:", "url(", "@import", "fetch(", "XMLHttp"):
            self.assertNotIn(piece, self.page.source)
        self.assertIn("default-src 'none'", self.page.source)

    def test_tells_what_the_report_tells(self):
        text = " ".join(" ".join(self.page.text).split())
        report = self.report
        shape, quality = report["shape"], report["quality"]
        for fact in (
            f'{report["output"]["vertices"]:,}',
            f'{report["output"]["tets"]:,}',
            report["digest"],
            f'{quality["radius_ratio_min"]:.4f}',
            f'{quality["radius_ratio_mean"]:.3f}',
            f'{quality["dihedral_min_deg"]:.1f}° to {quality["dihedral_max_deg"]:.1f}°',
            f'{100 * shape["volume_error_max_abs"]:.2f} %',
            "verify v.npy v.vtu",
        ):
            self.assertIn(fact, text)
        for row in shape["per_label"]:  # the spacing is 1, and of no unit
            figures = rf'{row["voxels"]:,} {row["volume_voxels"]:.4g} {100 * row["volume_error"]:.2f} %'
            self.assertRegex(text, rf'\b{row["label"]}\b.* [0-9,]+ {figures}'.replace(" -0.00", " 0.00"))
        rows = re.findall("</td><td>([0-9,]+)</td><td>[0-9,]+</td>", self.page.source)
        self.assertEqual(sum(int(row.replace(",", "")) for row in rows), report["output"]["tets"])
        self.assertIn(f'{report["performance"]["wall_s"]:.4g} s', text)
        self.assertNotIn("-0.00 %", text)

    def test_histograms_are_those_of_the_report(self):
        quality, shape = self.report["quality"], self.report["shape"]
        self.assertEqual(sum(quality["dihedral_histogram"]), 6 * self.report["output"]["tets"])
        self.assertAlmostEqual(sum(shape["bend_histogram"]), 1, places=9)
        titles = re.findall(r"<title>[^<]*: ([0-9.]+) %</title>", self.page.source)
        expected = [100 * n / self.report["output"]["tets"] for n in quality["radius_ratio_histogram"]]
        for title, share in zip(titles, expected):
            self.assertAlmostEqual(float(title), share, delta=0.006)

    def test_names_cannot_leave_their_place(self):
        self.assertIn(EVIL, " ".join(self.page.text))
        self.assertEqual(self.page.tags.count("script"), 4)

    def test_promises(self):
        # Without a certificate the run has seen P3, P6 and P8 to hold; with one also P1, P2 and P4.
        for certify, unchecked, holds in (("off", 5, 3), ("on", 2, 6)):
            run("mesh", "v.npy", "-o", "c.vtu", "--certify", certify, "--memory", "1GiB", "--html", "c.html")
            text = " ".join(Page("c.html").text)
            self.assertEqual(text.count("not checked here"), unchecked)
            self.assertEqual(text.count("holds"), holds)
            self.assertNotIn("FAILS", text)
        # A mesh without a floor is not said to keep one.
        run("mesh", "v.npy", "-o", "w.vtu", "--quality-floor", "0", "--html", "w.html")
        self.assertIn("the run had no floor", " ".join(Page("w.html").text))

    def test_rough_labels_are_judged_by_the_certificate(self):
        """Dust is off by more than 5 %, as it may be."""
        dust = numpy.random.default_rng(1).random((20, 20, 20)) < 0.15
        numpy.save("dust.npy", dust.astype(numpy.uint8))
        for certify, verdict in (("on", "holds"), ("off", "not checked here")):
            run("mesh", "dust.npy", "-o", "dust.vtu", "--certify", certify, "--memory", "1GiB",
                "--html", "dust.html", "--report", "dust.json")
            with open("dust.json", encoding="utf-8") as file:
                self.assertGreater(json.load(file)["shape"]["volume_error_max_abs"], 0.05)
            row = Page("dust.html").source.split('<th scope="row">P8</th>')[1].split("</tr>")[0]
            self.assertIn(f">{verdict}</td>", row)

    def test_second_opinion_is_a_command_that_works(self):
        masks = numpy.zeros((2, 8, 9, 10), numpy.uint8)
        masks[0, 1:6, 2:7, 2:6] = masks[1, 3:7, 3:8, 4:9] = 1
        for name, mask in zip("ab", masks):
            header = ("ObjectType = Image\nNDims = 3\nDimSize = 10 9 8\nElementType = MET_UCHAR\n"
                      "ElementSpacing = 1 1 1\nElementDataFile = LOCAL\n")
            with open(f"{name}.mha", "wb") as file:
                file.write(header.encode() + mask.tobytes())
        numpy.save("share.npy", masks[0].astype(numpy.float32))
        for options in (["v.npy", "--spacing", "2", "--crop", "1,1,1,12,11,10"],
                        ["v.npy", "--topology", "interfaces", "--background", "1"],
                        ["v.npy", "--element", "tet10-curved", "--background", "1"],
                        ["v.npy", "--object", "2", "--surface", "voxel"],
                        ["v.npy", "--merge", "1,2=1", "--drop-specks", "4/26"],
                        ["a.mha,b.mha", "--overlap", "all", "--background", "0"],
                        ["share.npy", "--values", "probabilities"]):
            with self.subTest(options=options):
                run("mesh", *options, "-o", "s.vtu", "--html", "s.html", "--force")
                command = re.search(r"<code>mwmesh (verify .*?)</code>", Page("s.html").source)[1]
                self.assertIn("all checks hold", run(*shlex.split(html.unescape(command))))
        run("mesh", "v.npy", "-o", "s.inp", "--html", "s.html", "--force")  # is not read
        self.assertNotIn("mwmesh verify", Page("s.html").source)

    def test_draws_a_cut_wherever_the_labels_are(self):
        for low in (1, 17):
            labels = numpy.zeros((10, 10, 24), numpy.uint8)
            labels[2:8, 2:8, low : low + 5] = 3
            numpy.save("far.npy", labels)
            run("mesh", "far.npy", "-o", "far.vtu", "--html", "far.html")
            self.assertEqual(len(Page("far.html").addresses), 2)

    def view(self):
        data = json.loads(self.page.scripts["view-data"])
        places = numpy.frombuffer(base64.b64decode(self.page.scripts["view-vertices"], validate=True), "<u2")
        lo, hi = numpy.array(data["lo"]), numpy.array(data["hi"])
        vertices = lo + places.reshape(-1, 3) / 65535 * (hi - lo)
        triangles = numpy.frombuffer(base64.b64decode(self.page.scripts["view-triangles"], validate=True), "<u4")
        return data, vertices, triangles.reshape(-1, 3)

    def test_surfaces_of_the_view_enclose_the_labels(self):
        data, vertices, triangles = self.view()
        self.assertEqual(sum(count for _, _, count in data["groups"]), len(triangles))
        volumes = {row["label"]: row["volume_voxels"] for row in self.report["shape"]["per_label"]}
        self.assertEqual({int(label["label"]) for label in data["labels"]}, set(volumes))
        for place, label in enumerate(data["labels"]):
            first, parts = 0, []
            for a, b, count in data["groups"]:
                group = triangles[first : first + count]
                if a == place:
                    parts.append(group)
                if b == place:
                    parts.append(group[:, ::-1])
                first += count
            surface = numpy.concatenate(parts)
            sides = numpy.concatenate([surface[:, [i, (i + 1) % 3]] for i in range(3)])
            self.assertEqual(sorted(map(tuple, sides)), sorted(map(tuple, sides[:, ::-1])), "closed")
            p, q, r = (vertices[surface[:, i]] for i in range(3))
            volume = (p * numpy.cross(q, r)).sum() / 6
            self.assertAlmostEqual(volume / volumes[int(label["label"])], 1, delta=0.01)
        self.assertEqual(data["labels"][0]["colour"], [1, 2, 3])

    @unittest.skipUnless(RESIDENT_MEMORY_IS_OURS, "resident memory is a sanitizer's")
    def test_memory_stays_under_the_budget(self):
        self.assertLess(self.peak, 192 << 20)

    def test_budget_that_a_page_needs(self):
        refused(["192MiB"], "mesh", "v.npy", "-o", "x.vtu", "--html", "x.html", "--memory", "191MiB",
                code=2)
        self.assertFalse(os.path.exists("x.html"))

    def test_names_of_files_are_used_once(self):
        for taken in ("v.npy", "x.vtu", "x.json"):
            refused(["--html " + taken], "mesh", "v.npy", "-o", "x.vtu", "--report", "x.json", "--html",
                    taken, code=2)

    def in_a_browser(self, page, script, *flags):
        """What the page's root says when the script has run."""
        with open("t.html", "w", encoding="utf-8") as file:
            file.write(page + "<script>const byId = (id) => document.getElementById(id);" + script + "</script>")
        # A busy machine may draw no frame before the time of the page is over.
        for budget in 3000, 10000, 30000, 100000:
            command = [CHROMIUM, "--headless", "--no-sandbox", *flags, f"--virtual-time-budget={budget}",
                       "--dump-dom", "file://" + os.path.abspath("t.html")]
            done = subprocess.run(command, capture_output=True, text=True, timeout=300)
            root = re.search("<html[^>]*>", done.stdout).group()
            if "dataset.seen" not in script or "data-seen" in root:
                break
        return root

    def in_a_view(self, page, script):
        root = self.in_a_browser(page, script, "--use-gl=angle", "--use-angle=swiftshader",
                                 "--enable-unsafe-swiftshader")
        if 'data-view="none"' in root:
            self.skipTest("this chromium has no WebGL 2")
        self.assertIn('data-view="drawn"', root)
        self.assertNotIn("data-error", root)
        return root

    @unittest.skipUnless(CHROMIUM, "no chromium")
    def test_runs_in_a_browser(self):
        """Draws, with a cut and edges too, without an error of script or WebGL."""
        self.in_a_view(self.page.source, "document.querySelector('input[name=cut][value=\"1\"]').click();"
                       "for (const id of ['view-edges', 'labels-none', 'labels-all']) byId(id).click();")

    @unittest.skipUnless(CHROMIUM, "no chromium")
    def test_box_is_within_the_view_and_its_sides_have_names(self):
        labels = numpy.ones((12, 10, 14), "u1")
        labels[4:8, 3:7, 2:6] = 2
        header = ("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 14 10 12\nencoding: raw\n"
                  "space: left-posterior-superior\nspace directions: (0,2,0) (-1,0,0) (0,0,3)\n"
                  "space origin: (0,0,0)\nspace units: \"mm\" \"mm\" \"mm\"\n\n")
        with open("lps.nrrd", "wb") as file:
            file.write(header.encode() + labels.tobytes())
        run("mesh", "lps.nrrd", "-o", "lps.vtu", "--html", "lps.html")
        page = Page("lps.html")
        self.assertRegex(" ".join(" ".join(page.text).split()), r"[0-9.]+ mL .*[0-9.]+ mm³")
        root = self.in_a_view(page.source, """
            byId('view-reset').click();
            requestAnimationFrame(() => {  // behind that of the page, and before the picture is gone
              const gl = byId('view').getContext('webgl2'), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
              const pixels = new Uint8Array(4 * w * h);
              gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
              let inside = 0, border = 0;
              for (let y = 0; y < h; ++y) for (let x = 0; x < w; ++x) {
                if (pixels[4 * (w * y + x) + 3] === 0) continue;
                ++inside;
                if (x === 0 || y === 0 || x === w - 1 || y === h - 1) ++border;
              }
              const ends = [...document.querySelectorAll('.screen span')].map((end) => end.textContent).join('');
              document.documentElement.dataset.seen = `${inside > 1000} ${border} ${ends}`;
            });""")
        self.assertIn('data-seen="true 0 APLRIS"', root)

    @unittest.skipUnless(CHROMIUM, "no chromium")
    def test_without_webgl_there_is_no_hole(self):
        script = """document.documentElement.dataset.seen = ['no-view', 'view', 'view-note', 'view-edges', 'labels-all']
            .map((id) => byId(id).offsetHeight > 0);"""
        root = self.in_a_browser(self.page.source, script, "--disable-3d-apis")
        self.assertIn('data-view="none"', root)
        self.assertIn('data-seen="true,false,false,false,false"', root)
        self.assertIn("pictures above", self.page.source)
        self.assertLess(self.page.source.index("<h2>Pictures"), self.page.source.index("pictures above"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
