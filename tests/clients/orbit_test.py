"""radiata orbit: numbered pictures of a turn and of a path, and progress for files and pipes."""

import json
import math
import unittest

from programs import ClientTest, png_size


class OrbitTest(ClientTest):
    def orbit(self, *arguments, **options):
        return self.radiata("orbit", "--size", "64x48", "--samples", "1", *arguments, **options)

    def test_a_turn_gives_numbered_pictures_and_plain_progress_lines(self):
        done = self.orbit("-o", self.folder / "turn", "--frames", "5")
        names = [f"frame-{i:04d}.png" for i in range(1, 6)]
        self.assertEqual(sorted(entry.name for entry in (self.folder / "turn").iterdir()), names)
        pictures = [(self.folder / "turn" / name).read_bytes() for name in names]
        self.assertEqual({png_size(picture) for picture in pictures}, {(64, 48)})
        lines = done.stderr.splitlines()
        self.assertEqual([line.split()[0] for line in lines], [f"{i}/5" for i in range(1, 6)])
        self.assertNotIn("\r", done.stderr)

    def test_the_path_of_a_turn_renders_the_same_pictures(self):
        camera = {"eye_mm": [0, -300, 0], "target_mm": [0, 0, 0], "up": [0, 0, 1], "field_of_view_deg": 30}
        path = self.folder / "path.json"
        self.orbit("-o", self.folder / "a", "--frames", "3", "--azimuth", "10", "--elevation", "5", "--write-path", path,
                   "--camera", json.dumps(camera), "--quiet")
        cameras = json.loads(path.read_text())
        self.assertEqual(len(cameras), 3)
        self.assertEqual(cameras[0], camera)
        for entry in cameras:
            self.assertTrue(math.isclose(math.dist(entry["eye_mm"], (0, 0, 0)), 300, rel_tol=1e-12))
        done = self.orbit("-o", self.folder / "b", "--path", path, "--quiet")
        self.assertEqual(done.stderr, "")
        for i in range(1, 4):
            name = f"frame-{i:04d}.png"
            self.assertEqual((self.folder / "a" / name).read_bytes(), (self.folder / "b" / name).read_bytes())

    def test_jpeg(self):
        self.orbit("-o", self.folder, "--frames", "1", "--format", "jpeg")
        self.assertEqual((self.folder / "frame-0001.jpg").read_bytes()[:3], b"\xff\xd8\xff")

    def test_what_is_left_out_is_told_once(self):
        done = self.orbit("-o", self.folder, "--frames", "3", "--lmax", "4", "--quiet")
        self.assertEqual(done.stderr, "bands to 4 of 8 drawn\n")

    def test_a_path_excludes_the_options_of_a_turn(self):
        done = self.orbit("-o", self.folder, "--path", "x.json", "--frames", "3", check=False)
        self.assert_fails(done, 2, "--path")


if __name__ == "__main__":
    unittest.main()
