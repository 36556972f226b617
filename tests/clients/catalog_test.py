"""radiata list, info and limits: tables and JSON."""

import json
import re
import unittest

from programs import DATASET, ClientTest


class CatalogTest(ClientTest):
    def test_list_is_a_table(self):
        lines = self.radiata("list").stdout.splitlines()
        self.assertRegex(lines[0], r"^dataset +kind +voxels +lmax +glyphs +fibres +GPU memory$")
        self.assertRegex(lines[1], rf"^{DATASET} +sh-image +\d+x\d+x\d+ +\d+ +\d+")

    def test_list_json_has_every_dataset(self):
        datasets = json.loads(self.radiata("list", "--json").stdout)["datasets"]
        self.assertEqual([entry["id"] for entry in datasets], [DATASET])
        self.assertEqual(len(datasets[0]["size"]), 3)
        self.assertIsInstance(datasets[0]["glyph_count"], int)
        self.assertEqual(len(datasets[0]["voxel_to_world"]["rows"]), 12)

    def test_info_prints_the_bytes_on_the_device(self):
        text = self.radiata("info", DATASET).stdout
        self.assertRegex(text, rf"^dataset +{DATASET}\n")
        self.assertRegex(text, r"\nGPU memory +(not resident|[\d.]+ \w+ \(\d+ bytes\))\n")
        entry = json.loads(self.radiata("info", DATASET, "--json").stdout)
        self.assertIsInstance(entry["gpu_bytes"], int)
        self.assertEqual(len(entry["bounds_world"]["minimum"]), 3)
        self.assertEqual(self.radiata("info").stdout, text)

    def test_limits(self):
        limits = json.loads(self.radiata("limits", "--json").stdout)
        self.assertGreater(limits["pixels_max"], 0)
        self.assertGreater(limits["window_max"], 0)
        table = self.radiata("limits").stdout
        self.assertIn(f"{limits['width_max']}x{limits['height_max']} pixels", table)
        self.assertIn(limits["device"], table)
        self.assertRegex(table, rf"\nrays of soft shadows +{limits['shadow_rays_max']} per sample")
        self.assertRegex(table, rf"\nrays of ambient occlusion +{limits['occlusion_rays_max']} per sample")

    def test_help_names_every_command(self):
        text = self.radiata("--help").stdout
        for command in ("list", "info", "limits", "render", "orbit", "pick"):
            self.assertTrue(re.search(rf"^ +{command} ", text, re.MULTILINE), command)


if __name__ == "__main__":
    unittest.main()
