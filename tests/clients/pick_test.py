"""radiata pick and the picks of the Python package, against the stub's glyph, which fills the left half of every picture."""

import json
import unittest

import radiata
from programs import DATASET, ClientTest


class PickTest(ClientTest):
    def pick(self, pixel, *arguments, **options):
        return self.radiata("pick", "--size", "96x64", "--pixel", pixel, *arguments, **options)

    def test_table_names_what_lies_there(self):
        text = self.pick("3,5").stdout
        self.assertRegex(text, rf"(?m)^layer +0 \({DATASET}\)$")
        self.assertRegex(text, r"(?m)^voxel +3, 5, 0$")
        self.assertRegex(text, r"(?m)^direction +0\.0000, 0\.6000, 0\.8000$")
        self.assertRegex(text, r"(?m)^peak +1 of 1 peak, 53\.13 degrees away$")
        self.assertRegex(text, r"(?m)^peak 1 +0\.55523 along ")

    def test_nothing_is_an_answer(self):
        self.assertEqual(self.pick("95,5").stdout, "nothing lies under this pixel\n")
        self.assertEqual(json.loads(self.pick("95,5", "--json").stdout), {})

    def test_json_has_all_of_it(self):
        glyph = json.loads(self.pick("3,5", "--json").stdout)["glyph"]
        self.assertEqual(glyph["voxel"], [3, 5, 0])
        self.assertAlmostEqual(glyph["direction"][1], 0.6)
        self.assertAlmostEqual(glyph["radius_mm"], 2 * glyph["amplitude"], 12)
        self.assertEqual(glyph["peak_rank"], 1)

    def test_all_hits_of_the_ray(self):
        text = self.pick("3,5", "--all-hits").stdout
        self.assertRegex(text, r"(?m)^hit 1 +enters a positive lobe 100\.0000 mm from the eye at ")
        self.assertRegex(text, r"(?m)^hit 2 +leaves a positive lobe 101\.5217 mm from the eye at .* along -?0\.0000, -0\.6000, -0\.8000$")
        self.assertNotIn("hit 1", self.pick("3,5").stdout)
        hits = json.loads(self.pick("3,5", "--all-hits", "--json").stdout)["glyph"]["hits"]
        self.assertEqual([hit["leaving"] for hit in hits], [False, True])
        self.assert_fails(self.pick("3,5", "--all-hits", "--method", "ray-march-peeters", check=False), 4,
                          "all hits are found by march, pole-table, polynomial")

    def test_pixels_that_are_not_there_are_refused(self):
        self.assert_fails(self.pick("96,0", check=False), 4, "96, 0 lies outside the picture of 96 x 64 pixels")
        for pixel in ("3", "-1,0", "a,b"):
            self.assert_fails(self.pick(pixel, check=False), 2, "--pixel")
        self.assert_fails(self.radiata("pick", check=False), 2, "--pixel")

    def test_python_picks_on_pictures_and_on_frames_of_views(self):
        with radiata.Client(self.server.address, timeout=60) as client:
            glyph = client.pick(DATASET, 3, 5, size=(96, 64))
            self.assertEqual(list(glyph.voxel), [3, 5, 0])
            self.assertIsNone(client.pick(DATASET, 95, 5, size=(96, 64)))
            self.assertEqual(len(client.pick(DATASET, 3, 5, size=(96, 64), all_hits=True).hits), 2)
            with self.assertRaisesRegex(radiata.Refused, "outside"):
                client.pick(DATASET, 96, 5, size=(96, 64))
            with client.stream(DATASET, size=(96, 64), samples=2) as view:
                frame = next(frame for frame in view if frame.converged)
                self.assertEqual(list(view.pick(frame, 40, 60).voxel), [40, 60, 0])
                self.assertEqual(len(view.pick(frame, 40, 60, all_hits=True).hits), 2)
                self.assertIsNone(view.pick(frame, 90, 60))
                frame.message.sequence = 1000
                with self.assertRaisesRegex(radiata.Refused, "never sent"):
                    view.pick(frame, 40, 60)


if __name__ == "__main__":
    unittest.main()
