"""radiata-convert as a program: what it writes, what it refuses, with which exit codes."""

import math
import pathlib
import struct
import tempfile
import unittest

from programs import run


def samples(path):
    data = path.read_bytes()
    dim = struct.unpack_from("<8h", data, 40)
    count = dim[1] * dim[2] * dim[3]
    return dim, [struct.unpack_from(f"<{count}f", data, 352 + 4 * count * volume) for volume in range(dim[4])]


class ConvertTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.image = self.folder / "in.nii"
        run("radiata-phantom", self.image, "--size", 10, "--lmax", 2)

    def convert(self, *arguments, **options):
        return run("radiata-convert", "uncertainty", *arguments, **options)

    def test_uncertainty_by_the_recipe(self):
        names = [self.folder / name for name in ("a.nii", "b.nii", "c.nii")]
        for name, seed in zip(names, (3, 3, 4)):
            done = self.convert(self.image, name, "--seed", seed)
            self.assertIn(f"seed {seed}", done.stdout)
            self.assertEqual(done.stderr, "")
        self.assertEqual(names[0].read_bytes(), names[1].read_bytes())
        self.assertNotEqual(names[0].read_bytes(), names[2].read_bytes())
        dim, before = samples(self.image)
        after_dim, after = samples(names[0])
        self.assertEqual(dim, after_dim)
        for volume, factor in ((0, 1.7), (3, 1.0)):
            ratios = [b / a for a, b in zip(before[volume], after[volume]) if abs(a) > 1e-3]
            self.assertGreater(len(ratios), 100)
            # Deviation 0.05 over some hundred voxels.
            self.assertAlmostEqual(sum(ratios) / len(ratios), factor, delta=0.02)
        self.assertEqual([a == 0 for a in before[0]], [b == 0 for b in after[0]])

    def test_without_change_the_file_is_the_same_in_any_convention(self):
        for options in ([], ["--sh-convention", "descoteaux07"], ["--sh-axes", "voxel"]):
            out = self.folder / "same.nii"
            self.convert(self.image, out, "--constant", 1, "--deviation", 0, *options)
            for before, after in zip(samples(self.image)[1], samples(out)[1]):
                for a, b in zip(before, after):
                    self.assertAlmostEqual(a, b, delta=2e-6)

    def test_refused_with_one_sentence(self):
        out = self.folder / "out.nii"
        for arguments, word in (([self.folder / "none.nii", out], "none.nii"), ([self.image, self.folder / "out.mif"], ".nii"),
                                ([self.image, self.folder / "no" / "a.nii"], "no folder"), ([self.image, self.image], "same file"),
                                ([self.image, out, "--deviation", -1], "deviation"), ([self.image, out, "--deviation", "nan"], "deviation"),
                                ([self.image, out, "--constant", 101], "101"), ([self.image, out, "--sh-axes", "tilted"], "tilted")):
            with self.subTest(arguments=arguments):
                done = self.convert(*arguments, check=False)
                self.assertEqual(done.returncode, 1)
                self.assertIn(word, done.stderr)
                self.assertRegex(done.stderr, r"\Aradiata-convert: [^\n]+\n\Z")
                self.assertFalse(out.exists())

    def test_usage(self):
        for arguments in ([], ["uncertainty"], ["nothing"], ["uncertainty", self.image, "out.nii", "--seed", -1]):
            done = run("radiata-convert", *arguments, check=False)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertRegex(done.stderr, r"\Aradiata-convert: [^\n]+\n\Z")
        self.assertIn("--deviation", run("radiata-convert", "uncertainty", "--help").stdout)

    def test_tensors_become_the_bands_of_the_same_functions(self):
        brick, out = self.folder / "brick.nii", self.folder / "sh.nii"
        run("radiata-phantom", brick, "--stiffness", "--size", 6)
        done = run("radiata-convert", "tensors", brick, out, "--format", "voigt-stiffness")
        self.assertIn("tensors of order 4", done.stdout)
        dim, upper = samples(brick)
        sh_dim, bands = samples(out)
        self.assertEqual((dim[4], sh_dim[4]), (21, 15))
        at = {}
        for row in range(6):
            for column in range(row, 6):
                at[row, column] = at[column, row] = len(set(at.values()))
        for voxel in range(0, dim[1] * dim[2] * dim[3], 7):
            m = {pair: upper[volume][voxel] for pair, volume in at.items()}
            normal = sum(m[i, j] for i in range(3) for j in range(3))
            shear = sum(m[i, i] for i in range(3)) + 2 * sum(m[i, i] for i in range(3, 6))
            # The mean over all directions, C_iijj + 2 C_ijij over 15, is the constant band.
            mean = (normal + 2 * shear) / 15
            self.assertAlmostEqual(bands[0][voxel] / (4 * math.pi) ** 0.5, mean, delta=1e-5 * mean)
        for arguments, word in (((brick, out), "nothing says which volume"), ((brick, out, "--format", "camino"), "camino"),
                                ((brick, out, "--format", "dipy"), "21 volumes"), ((brick, brick, "--format", "mandel"), "same file")):
            failed = run("radiata-convert", "tensors", *arguments, check=False)
            self.assertEqual(failed.returncode, 1)
            self.assertIn(word, failed.stderr)

    def tracts(self, *arguments, **options):
        return run("radiata-convert", "tracts", *arguments, **options)

    def tck(self, name, tracks, lines=("datatype: Float32LE",)):
        nan, inf = math.nan, math.inf
        numbers = [n for track in tracks for point in [*track, (nan,) * 3] for n in point] + [inf] * 3
        header = "\n".join(["mrtrix tracks", *lines, "file: . 200", "END"]).encode().ljust(200, b"\n")
        path = self.folder / name
        path.write_bytes(header + struct.pack(f"<{len(numbers)}f", *numbers))
        return path

    def test_tracts_say_what_was_assumed_left_out_and_lost(self):
        line = [(0.2 * i, 5 * math.sin(0.04 * i), 0) for i in range(100)]
        odd = self.tck("odd.tck", [line, [(1e9, 0, 0)]], lines=())
        stray = self.tck("stray.tck", [line, [(15000, 0, 0), (15000, 0.2, 0)]])
        uneven = self.tck("uneven.tck", [[(x * x / 100, 0.01 * x * x * x / 100, 0) for x in range(60)]])
        assumed = "The header names no datatype; Float32LE is assumed. 1 fibre is left out"
        for ending in ("fiblet", "tck", "fiblet76"):
            self.assertIn(f"odd.tck: {assumed}", self.tracts(odd, self.folder / f"o.{ending}").stdout, ending)
        self.assertIn(assumed, self.tracts(self.folder / "o.fiblet", self.folder / "again.tck").stdout)
        out = self.folder / "out.fiblet"
        done = self.tracts(stray, out, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("fibre 1 reaches (15000.0", done.stderr)
        within = done.stderr.split("--within ")[1].split(")")[0]
        self.assertIn("1 fibre reaches farther than", self.tracts(stray, out, "--within", within).stdout)
        for name in ("u.qfib", "u.fiblet76"):
            self.assertRegex(self.tracts(uneven, self.folder / name).stdout,
                             r"bytes a point, error mean .*um\n.*points were set anew.*um at most")
            self.assertEqual(self.tracts(self.folder / name, self.folder / "u.tck").returncode, 0)
        empty = self.tck("empty.tck", [])
        for name in ("e.fiblet", "e.qfib", "e.fiblet76"):
            said = self.tracts(empty, self.folder / name).stdout
            self.assertIn("0 fibres, 0 points", said)
            self.assertNotIn("inf", said)
            self.tracts(self.folder / name, self.folder / "e.tck")
        for option, value in (("--step", "nan"), ("--within", "nan"), ("--within", 0), ("--vtk-space", "las")):
            self.assertEqual(self.tracts(stray, out, option, value, check=False).returncode, 2, option)


if __name__ == "__main__":
    unittest.main()
