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
        cls.server = ServerProcess([BIN / "radiata-server", "--listen", "127.0.0.1:0", "--data", data, "--tract-cache",
                                    cls.folder / "cache"])
        cls.addClassCleanup(cls.server.stop)

    def radiata(self, *arguments, **options):
        return run("radiata", *arguments, server=self.server.address, **options)

    def count(self, selection):
        return json.loads(self.radiata("select", "bundles", selection, "--json").stdout)["selected"]

    def test_catalogue_tells_fibres_groups_and_columns(self):
        self.assertRegex(self.radiata("list").stdout, r"\nbundles +tractogram +400 *\n|\nbundles +tractogram +400 *$")
        entry = json.loads(self.radiata("info", "bundles", "--json").stdout)
        self.assertEqual((entry["fibres"], len(entry["fibre_groups"])), (400, 7))
        self.assertEqual((entry["fibre_columns"], entry["vertex_columns"]), (["bundle"], ["along"]))
        self.assertLessEqual(entry["error_max_um"], 10)
        self.assertIn("columns per vertex", self.radiata("info", "bundles").stdout)
        self.assertEqual(len(list((self.folder / "cache").glob("bundles.trx-*.fiblet"))), 1)

    def test_regions_and_filters_are_joined(self):
        self.assertEqual(self.count("everything"), 400)
        left, right = self.count("all plane(0, 0, 0, 1, 0, 0)"), self.count("all plane(0, 0, 0, -1, 0, 0)")
        crossing = self.count("plane(0, 0, 0, 1, 0, 0) and plane(0, 0, 0, -1, 0, 0)")
        self.assertEqual(left + right + crossing, 400)
        self.assertGreater(min(left, right, crossing), 20)
        self.assertEqual(self.count("not (all plane(0, 0, 0, 1, 0, 0) or all plane(0, 0, 0, -1, 0, 0))"), crossing)
        self.assertEqual(self.radiata("select", "bundles", "fibres(3, 390-500)").stdout, "11 of 400 fibres\n")
        self.assertEqual(self.radiata("select", "bundles", "fibres(3, 398-500)", "--list").stdout, "3\n398\n399\n")

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
