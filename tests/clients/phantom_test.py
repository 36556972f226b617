"""radiata-phantom as a program: what it writes, what it refuses, with which exit codes."""

import gzip
import hashlib
import json
import pathlib
import struct
import tempfile
import unittest
import zipfile

from programs import run


def header(data):
    """(dim, datatype, first number of the sform) of a little-endian NIfTI-1 file."""
    assert struct.unpack_from("<i", data, 0)[0] == 348 and data[344:348] == b"n+1\0", data[:4]
    return struct.unpack_from("<8h", data, 40), struct.unpack_from("<h", data, 70)[0], struct.unpack_from("<f", data, 280)[0]


class PhantomTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def phantom(self, *arguments, **options):
        return run("radiata-phantom", *arguments, **options)

    def fails(self, arguments, *words):
        done = self.phantom(*arguments, check=False)
        self.assertNotEqual(done.returncode, 0, arguments)
        self.assertGreater(done.returncode, 0, "ended by a signal")
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [], "nothing is left behind")
        return done

    def test_same_options_same_bytes(self):
        sums = set()
        for name, seed in (("a.nii", 3), ("b.nii", 3), ("c.nii", 4)):
            done = self.phantom(self.folder / name, "--size", 12, "--lmax", 4, "--seed", seed)
            self.assertIn(f"seed {seed}", done.stdout)
            self.assertEqual(done.stderr, "")
            sums.add(hashlib.sha256((self.folder / name).read_bytes()).hexdigest())
        self.assertEqual(len(sums), 2)

    def test_size_bands_and_voxels_are_those_asked_for(self):
        self.phantom(self.folder / "a.nii.gz", "--size", 16, "--lmax", 6)
        dim, datatype, _ = header(gzip.decompress((self.folder / "a.nii.gz").read_bytes()))
        self.assertEqual((dim[0], max(dim[1:4]), dim[4], datatype), (4, 16, 28, 16))
        self.phantom(self.folder / "b.nii", "--voxel", 20, "--lmax", 0)
        dim, _, edge = header((self.folder / "b.nii").read_bytes())
        self.assertEqual(dim[4], 1)
        self.assertEqual(abs(edge), 20)
        done = self.phantom(self.folder / "c.nii", "--slice-dense", 500, "--lmax", 2)
        self.assertEqual(header((self.folder / "c.nii").read_bytes())[0][3], 1)
        self.assertGreaterEqual(int(done.stdout.split(" with a glyph")[0].split()[-1]), 500)

    def test_streamlines_have_groups_and_the_step_asked_for(self):
        done = self.phantom(self.folder / "a.nii", "--size", 8, "--lmax", 2, "--tracts", self.folder / "a.trx", "--fibres", 60,
                            "--step", 0.4)
        self.assertIn("60 streamlines, step 0.4 mm", done.stdout)
        with zipfile.ZipFile(self.folder / "a.trx") as trx:
            info = json.loads(trx.read("header.json"))
            groups = [name for name in trx.namelist() if name.startswith("groups/")]
            points = struct.unpack("<6f", trx.read("positions.3.float32")[:24])
        self.assertEqual((info["NB_STREAMLINES"], len(groups)), (60, 7))
        self.assertAlmostEqual(sum((points[i] - points[i + 3]) ** 2 for i in range(3)) ** 0.5, 0.4, 5)

    def test_noise_changes_the_image_and_nothing_else(self):
        self.phantom(self.folder / "a.nii", "--size", 10, "--lmax", 2)
        self.phantom(self.folder / "b.nii", "--size", 10, "--lmax", 2, "--noise", 0.01)
        plain, noisy = ((self.folder / name).read_bytes() for name in ("a.nii", "b.nii"))
        self.assertEqual(plain[:348], noisy[:348])
        self.assertNotEqual(plain, noisy)

    def test_labels_and_bundles(self):
        self.phantom(self.folder / "a.nii", "--size", 24, "--lmax", 2, "--labels", self.folder / "l.nii",
                     "--bundles", self.folder / "b.json", "--seed", 5)
        data = (self.folder / "l.nii").read_bytes()
        dim, _, _ = header(data)
        image, _, _ = header((self.folder / "a.nii").read_bytes())
        self.assertEqual(dim[1:4], image[1:4])
        labels = set(struct.unpack_from(f"<{dim[1] * dim[2] * dim[3]}f", data, 352))
        described = json.loads((self.folder / "b.json").read_text())
        self.assertEqual(described["seed"], 5)
        ids = {bundle["id"] for bundle in described["bundles"]}
        self.assertGreater(len(labels), 2)
        self.assertLessEqual(labels - {0.0}, {float(i) for i in ids})
        for bundle in described["bundles"]:
            self.assertTrue(bundle["name"])
            self.assertGreater(bundle["centre_lines"], 0)

    def test_stiffness_is_a_field_of_21_volumes(self):
        done = self.phantom(self.folder / "a.nii", "--stiffness", "--size", 8, "--seed", 2)
        self.assertIn("voigt-stiffness", done.stdout)
        dim, datatype, edge = header((self.folder / "a.nii").read_bytes())
        self.assertEqual((dim[1:5], datatype, abs(edge)), ((8, 4, 4, 21), 16, 6))
        self.phantom(self.folder / "b.nii", "--stiffness", "--size", 8, "--seed", 3)
        self.assertNotEqual((self.folder / "a.nii").read_bytes(), (self.folder / "b.nii").read_bytes())

    def test_usage(self):
        out = self.folder / "a.nii"
        self.fails([], "output")
        for arguments, word in ((["--lmax"], "--lmax"), (["--sizes", 3], "--sizes"), (["--size", "many"], "--size"),
                                (["--size", 9, "--voxel", 2], "--voxel"), (["--slice-dense", 0], "--slice-dense"),
                                (["--slice-dense", 10, "--size", 9], "--slice-dense"), (["--seed", -1], "--seed"),
                                (["--stiffness", "--lmax", 4], "--stiffness"), (["--stiffness", "--voxel", 2], "--voxel")):
            with self.subTest(arguments=arguments):
                self.fails([out] + arguments, word)

    def test_refused_with_one_sentence(self):
        out = self.folder / "a.nii"
        for arguments, word in (([out, "--size", 0], "size"), ([out, "--size", 1025], "1025"), ([out, "--lmax", 3], "3"),
                                ([out, "--lmax", 18], "18"), ([out, "--noise", 2], "noise"), ([out, "--noise", "nan"], "noise"),
                                ([out, "--voxel", 0.01], "0.01"), ([out, "--size", 1024, "--lmax", 16], "MiB"),
                                ([out, "--stiffness", "--size", 1], "2 to 256"), ([self.folder / "a.mif"], ".nii"), ([self.folder / "no" / "a.nii"], "no folder"),
                                ([out, "--labels", self.folder / "l.txt"], "l.txt")):
            with self.subTest(arguments=arguments):
                done = self.fails(arguments, word)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, r"\Aradiata-phantom: [^\n]+\n\Z")

    def test_help(self):
        self.assertIn("--slice-dense", self.phantom("--help").stdout)


if __name__ == "__main__":
    unittest.main()
