"""radiata list, info and select on the sample brain's streamlines: a server with a device, catalogue, cache, regions, export."""

import json
import pathlib
import struct
import tempfile
import unittest
import zipfile

from programs import BIN, ServerProcess, run


class SelectTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        data = cls.folder / "data"
        data.mkdir()
        run("radiata-phantom", data / "brain.nii", "--size", 8, "--lmax", 2, "--tracts", data / "bundles.trx", "--fibres", 400)
        # A box of six sides around the left half.
        corners = [f"v {-200 if c & 1 else 0} {200 if c & 2 else -200} {200 if c & 4 else -200}\n" for c in range(8)]
        sides = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"]
        (data / "left.obj").write_text("".join(corners) + "".join(f"f {side}\n" for side in sides))
        cls.server = ServerProcess([BIN / "radiata-server", "--listen", "127.0.0.1:0", "--data", data, "--tract-cache",
                                    cls.folder / "cache"])
        cls.addClassCleanup(cls.server.stop)

    def radiata(self, *arguments, **options):
        return run("radiata", *arguments, server=self.server.address, **options)

    def count(self, selection):
        return json.loads(self.radiata("select", "bundles", selection, "--json").stdout)["selected"]

    def test_catalogue_tells_fibres_groups_and_columns(self):
        self.assertRegex(self.radiata("list").stdout, r"\nbundles +tractogram +400 by its header *\n")
        entry = json.loads(self.radiata("info", "bundles", "--json").stdout)
        self.assertEqual((entry["fibres"], len(entry["fibre_groups"])), (400, 7))
        self.assertEqual((entry["fibre_columns"], entry["vertex_columns"]), (["bundle"], ["along"]))
        self.assertLessEqual(entry["error_max_um"], 10)
        self.assertIn("columns per vertex", self.radiata("info", "bundles").stdout)
        self.assertEqual(len(list((self.folder / "cache").glob("bundles.trx-*.fiblet"))), 1)

    def test_memory_for_tractograms_is_a_setting(self):
        server = ServerProcess([BIN / "radiata-server", "--listen", "127.0.0.1:0", "--data", self.folder / "data", "--tract-cache",
                                self.folder / "cache", "--tract-memory", 0.04])
        try:
            limits = json.loads(run("radiata", "limits", "--json", server=server.address).stdout)
            run("radiata", "render", "--tracts", "bundles", "--size", "64x48", "--samples", 2, "-o", self.folder / "some.png",
                server=server.address)
            entry = json.loads(run("radiata", "info", "bundles", "--json", server=server.address).stdout)
            text = run("radiata", "info", "bundles", server=server.address).stdout
        finally:
            server.stop()
        self.assertEqual(limits["tract_memory_bytes"], 41943)
        self.assertLessEqual(entry["gpu_bytes"], 41943)
        self.assertTrue(0 < entry["resident_pages"] < entry["fiblet_pages"])
        self.assertRegex(text, r"GPU memory .*\d+ of \d+ pages and a subset")

    def test_regions_and_filters_are_joined(self):
        self.assertEqual(self.count("everything"), 400)
        left, right = self.count("all plane(0, 0, 0, 1, 0, 0)"), self.count("all plane(0, 0, 0, -1, 0, 0)")
        crossing = self.count("plane(0, 0, 0, 1, 0, 0) and plane(0, 0, 0, -1, 0, 0)")
        self.assertEqual(left + right + crossing, 400)
        self.assertGreater(min(left, right, crossing), 20)
        self.assertEqual(self.count("not (all plane(0, 0, 0, 1, 0, 0) or all plane(0, 0, 0, -1, 0, 0))"), crossing)
        self.assertEqual(self.radiata("select", "bundles", "fibres(3, 390-500)").stdout, "11 of 400 fibres\n")
        self.assertEqual(self.radiata("select", "bundles", "fibres(3, 398-500)", "--list").stdout, "3\n398\n399\n")

    def test_meshes_select_and_cut(self):
        self.assertRegex(self.radiata("list").stdout, r"\nleft +mesh")
        self.assertEqual(json.loads(self.radiata("info", "left", "--json").stdout)["triangles"], 12)
        self.assertEqual(self.count("all mesh(left)"), self.count("all plane(0, 0, 0, 1, 0, 0)"))
        picture = ["--tracts", "bundles", "--size", "64x48", "--samples", 1, "--no-annotations"]
        seen = {}
        for name, flags in {"all": ["--fiblet-culling", "auto"], "left": ["--cut-inside", "mesh(left)"],
                            "right": ["--cut-outside", "mesh(left)", "--fiblet-culling", "two-phase"],
                            "depths": ["--cut-outside", "mesh(left)", "--cut-by-depths"], "one": ["--show", "fibres(3)"]}.items():
            lasso = self.radiata("lasso", *picture, *flags, "--outline", "0,0,64,48", "--list").stdout.split()
            seen[name] = {int(fibre) for fibre in lasso}
            through = self.radiata("lasso", *picture, *flags, "--outline", "0,0,64,48", "--through", "--json").stdout
            self.assertLessEqual(seen[name], set(json.loads(through)["layers"][0]["fibres"]))
        self.assertEqual(seen["one"], {3})
        self.assertGreater(len(seen["all"]), 30)
        self.assertTrue(seen["left"] and seen["right"])
        # A box is convex, so they differ by segments that cross its faces only.
        self.assertLess(5 * len(seen["depths"] ^ seen["right"]), len(seen["right"]), seen)
        looks = ["--fibre-colour", "point", "--fibre-column", "along", "--criterion", "along,0.2,0.9", "--select", "group(cst_left)",
                 "--fibre-opacity", 0.5, "--fxaa", "--exact-width", "-o", self.folder / "look.png"]
        groups = [entry["name"] for entry in json.loads(self.radiata("info", "bundles", "--json").stdout)["fibre_groups"]]
        looks[looks.index("group(cst_left)")] = f'group("{groups[0]}")'
        self.radiata("render", *picture, *looks)
        self.assertTrue((self.folder / "look.png").read_bytes().startswith(b"\x89PNG"))
        distance = ["--fibre-colour", "distance", "--fibre-near", "mesh(left)", "-o", self.folder / "far.png"]
        self.radiata("render", *picture, *distance)
        for flags, words in ((["--cut-inside", "mesh(brain)"], "mesh"), (["--criterion", "along,1,0"], "at most"),
                             (["--cut-inside", "sphere(0, 0, 0, 9)", "--cut-by-depths"], "instead of mesh"),
                             (["--fibre-colour", "ends", "--show", "sphere(1)"], "character")):
            done = self.radiata("render", *picture, *flags, "-o", self.folder / "no.png", check=False)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(words, done.stderr)

    def test_wrong_selections_are_refused_with_a_sentence(self):
        for selection, words in (("sphere(1, 2)", "at character 7"), ("group(none)", "there are: "), ("mask(brain)", "scalar")):
            done = self.radiata("select", "bundles", selection, check=False)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.radiata("select", "brain", "everything", check=False).returncode, 4)

    def test_exports_are_the_original_points_with_columns_and_groups(self):
        self.radiata("select", "bundles", "fibres(3, 7)", "--export", self.folder / "two.trx")
        with zipfile.ZipFile(self.folder / "two.trx") as two, zipfile.ZipFile(self.folder / "data/bundles.trx") as all_fibres:
            info = json.loads(two.read("header.json"))
            offsets = struct.unpack("<9Q", all_fibres.read("offsets.uint64")[:72])
            positions = all_fibres.read("positions.3.float32")
            expected = positions[12 * offsets[3]:12 * offsets[4]] + positions[12 * offsets[7]:12 * offsets[8]]
            self.assertEqual(two.read("positions.3.float32"), expected)
            self.assertEqual(info["NB_STREAMLINES"], 2)
            self.assertEqual(len(two.read("dps/bundle.float32")), 8)
        self.radiata("select", "bundles", "fibres(3)", "--export", self.folder / "one.tck")
        self.assertEqual(sorted(path.name for path in self.folder.glob("one*")), ["one.tck", "one_along.tsf", "one_bundle.txt"])
        self.assertTrue((self.folder / "one.tck").read_bytes().startswith(b"mrtrix tracks\n"))


if __name__ == "__main__":
    unittest.main()
