"""radiata render: pictures, exact outputs, frame information, the live view's picture."""

import json
import subprocess
import unittest

import numpy as np

from programs import BIN, DATASET, ClientTest, png_size

CAMERA = {"eye_mm": [30.0, -200.0, 40.0], "target_mm": [1.0, 2.0, 3.0], "up": [0.0, 0.0, 1.0], "field_of_view_deg": 30.0,
          "clip": {"nearest_mm": 10.0, "farthest_mm": 500.0}}

# Output, option, element type, channels.
ARRAYS = [("depth", "--depth", "<f4", ()), ("id", "--id", "<i4", (4,)), ("position", "--position-out", "<f4", (3,)),
          ("normal", "--normal-out", "<f4", (3,)), ("steps", "--steps", "<i4", ())]


class RenderTest(ClientTest):
    def render(self, *arguments, **options):
        return self.radiata("render", "--size", "96x64", *arguments, **options)

    def test_picture_has_the_size_and_the_only_dataset_is_the_default(self):
        self.render("-o", self.folder / "a.png")
        self.assertEqual(png_size((self.folder / "a.png").read_bytes()), (96, 64))

    def test_picture_goes_to_standard_output(self):
        command = [BIN / "radiata", "--server", self.server.address, "render", "--size", "96x64", "-o", "-"]
        done = subprocess.run(command, stdout=subprocess.PIPE, check=True, timeout=60)
        self.assertEqual(png_size(done.stdout), (96, 64))

    def test_format_follows_the_name_or_the_option(self):
        for name, option in (("a.jpg", []), ("b.jpeg", []), ("c.bin", ["--format", "jpeg"])):
            self.render("-o", self.folder / name, *option)
            self.assertEqual((self.folder / name).read_bytes()[:3], b"\xff\xd8\xff")

    def test_outputs_are_npy_files_of_the_stated_shape_and_type(self):
        files = [part for name, option, _, _ in ARRAYS for part in (option, self.folder / f"{name}.npy")]
        self.render(*files)
        for name, _, kind, channels in ARRAYS:
            array = np.load(self.folder / f"{name}.npy")
            self.assertEqual(array.shape, (64, 96) + channels, name)
            self.assertEqual(array.dtype, np.dtype(kind), name)
            self.assertTrue(array.flags.c_contiguous, name)

    def test_colours_are_echoed(self):
        cases = {
            ("--colour", "direction"): {"direction": {}},
            ("--colour", "radius", "--colour-map", "black-red-yellow", "--colour-range", "0.5,2"):
                {"radius": {"map": "black-red-yellow", "range": {"low": 0.5, "high": 2.0}}},
            ("--colour", "scalar", "--colour-image", "fa"): {"scalar": {"image_id": "fa", "map": "viridis"}},
            ("--colour", "uniform", "--uniform-colour", "1,0.5,0.25"): {"uniform": [1, 0.5, 0.25]},
        }
        for arguments, colour in cases.items():
            self.render("--info", self.folder / "a.json", *arguments)
            info = json.loads((self.folder / "a.json").read_text())
            self.assertEqual(info["request"]["scene"]["layers"][0]["glyphs"]["colour"], colour)

    def test_shadows_are_echoed(self):
        self.render("--info", self.folder / "a.json", "--light-world", "1,2,3", "--shadow", "soft", "--light-radius", "8",
                    "--shadow-rays", "4", "--ambient-occlusion", "6", "--occlusion-radius", "2.5", "--casts-no-shadows")
        scene = json.loads((self.folder / "a.json").read_text())["request"]["scene"]
        light = scene["light"]
        self.assertEqual(light["direction_world"], [1, 2, 3])
        self.assertNotIn("direction_camera", light)
        self.assertEqual((light["shadow"], light["angular_radius_deg"], light["shadow_rays"]), ("soft", 8, 4))
        self.assertEqual(light["ambient_occlusion"], {"rays": 6, "radius_mm": 2.5})
        self.assertFalse(scene["layers"][0]["casts_shadows"])

    def test_contradicting_colours_are_refused(self):
        for arguments, word in ((("--colour", "scalar"), "--colour-image"), (("--colour-image", "fa"), "--colour scalar"),
                                (("--colour-range", "0,1"), "--colour-range"), (("--uniform-colour", "1,1,1"), "--uniform"),
                                (("--colour", "direction", "--colour-map", "grey"), "--colour-map"),
                                (("--colour", "rainbow"), "rainbow"), (("--colour", "radius", "--colour-map", "jet"), "jet")):
            self.assert_fails(self.render("-o", self.folder / "a.png", *arguments, check=False), 2, word)
        backwards = self.render("-o", self.folder / "a.png", "--colour", "radius", "--colour-range", "2,1", check=False)
        self.assert_fails(backwards, 4, "range of the colour map")

    def test_info_echoes_what_was_asked(self):
        self.render("--dataset", DATASET, "--plane", "oblique", "--position", "1,-2,3.5", "--normal", "0,1,1", "--slab", "4",
                    "--scale", "per-glyph", "--factor", "0.5", "--lmax", "4", "--lobes", "shown", "--samples", "3",
                    "--intersection", "march", "--traversal", "ray_query", "--pole-table", "off",
                    "--light", "-1,1,2", "--irradiance", "2",
                    "--ambient", "0.25", "--background", "0.5,0.25,0", "--convention", "neurological", "--no-annotations",
                    "--opacity", "0.5", "--camera", json.dumps(CAMERA), "--info", self.folder / "info.json")
        info = json.loads((self.folder / "info.json").read_text())
        self.assertEqual((info["width"], info["height"], info["samples"], info["state"]), (96, 64, 3, "converged"))
        self.assertGreater(len(info["passes"]), 0)
        self.assertIn("time_ms", info["passes"][0])
        self.assertEqual(info["methods"]["intersection"], "march")
        self.assertIn("hit_pixels", info["counters"])
        request = info["request"]
        self.assertEqual(request["camera"], CAMERA)
        layer = request["scene"]["layers"][0]
        self.assertEqual(layer["opacity"], 0.5)
        glyphs = layer["glyphs"]
        slab = glyphs["selection"]["slab"]
        self.assertEqual(slab["thickness_mm"], 4)
        self.assertEqual(slab["middle"], {"plane": "oblique", "position_mm": [1, -2, 3.5], "normal": [0, 1, 1]})
        self.assertEqual(glyphs["scale"], {"mode": "per-glyph", "factor": 0.5})
        self.assertEqual((glyphs["lmax"], glyphs["negative_lobes"]), (4, "shown"))
        self.assertEqual((request["quality"]["traversal"], request["quality"]["pole_table"]), ("ray-query", "off"))
        self.assertEqual(request["scene"]["background"], [0.5, 0.25, 0])
        self.assertEqual(request["scene"]["light"], {"direction_camera": [-1, 1, 2], "irradiance": 2, "ambient": 0.25,
                                                     "shadow": "none", "angular_radius_deg": 5, "shadow_rays": 16})
        self.assertEqual(request["scene"]["annotations"], {"convention": "neurological", "hidden": True})

    def test_what_is_left_out_is_told(self):
        done = self.render("--lmax", "4", "-o", self.folder / "a.png", "--info", self.folder / "info.json")
        self.assertIn("bands to 4 of 8 drawn\n", done.stderr)
        left_out = json.loads((self.folder / "info.json").read_text())["left_out"]
        self.assertEqual([(one["layer"], one["lmax"], one["lmax_available"]) for one in left_out], [(0, 4, 8)])
        self.assertEqual(left_out[0]["texts"], ["bands to 4 of 8 drawn"])
        self.assertEqual(self.render("-o", self.folder / "a.png").stderr, "")

    def test_methods_and_their_settings_are_echoed(self):
        cases = {
            ("march",): ("march", {}),
            ("pole-table",): ("pole-table", {}),
            ("polynomial", "--polynomial-stop", "step", "--tolerance", "0.01", "--lmax", "4"):
                ("polynomial", {"polynomial": {"stop": "step", "tolerance": 0.01}}),
            ("polynomial-double", "--lmax", "4"): ("polynomial-double", {"polynomial": {"stop": "bracket", "tolerance": 1e-12}}),
            ("laguerre", "--lmax", "4"): ("laguerre", {"polynomial": {"stop": "unspecified", "tolerance": 0.001}}),
            ("ray-march-peeters", "--march-steps", "50", "--refinements", "6", "--lmax", "4"):
                ("ray-march-peeters", {"ray_march": {"steps": 50, "refinements": 6}}),
            ("ray-march-van-almsick", "--lmax", "4"):
                ("ray-march-van-almsick", {"ray_march": {"steps": 100, "refinements": 4}}),
        }
        for arguments, (name, settings) in cases.items():
            self.render("--info", self.folder / "info.json", "--samples", "1", "--method", *arguments)
            quality = json.loads((self.folder / "info.json").read_text())["request"]["quality"]
            self.assertEqual(quality["intersection"], name)
            self.assertEqual({key: quality[key] for key in ("polynomial", "ray_march") if key in quality}, settings)
        self.assert_fails(self.render("-o", self.folder / "a.png", "--method", "guess", check=False), 2, "guess")
        bad = self.render("-o", self.folder / "a.png", "--method", "ray-march-peeters", "--march-steps", "0", check=False)
        self.assert_fails(bad, 4, "ray_march.steps")

    def test_camera_file_and_echoed_camera_give_the_same_picture(self):
        (self.folder / "camera.json").write_text(json.dumps(CAMERA))
        self.render("--camera", self.folder / "camera.json", "-o", self.folder / "a.png", "--info", self.folder / "a.json")
        echoed = json.loads((self.folder / "a.json").read_text())["request"]["camera"]
        self.render("--camera", json.dumps(echoed), "-o", self.folder / "b.png")
        self.assertEqual((self.folder / "a.png").read_bytes(), (self.folder / "b.png").read_bytes())

    def test_whole_volume(self):
        self.render("--volume", "--info", self.folder / "info.json")
        request = json.loads((self.folder / "info.json").read_text())["request"]
        self.assertIn("volume", request["scene"]["layers"][0]["glyphs"]["selection"])

    def test_stream_gives_the_picture_of_the_unary_call(self):
        self.render("--samples", "5", "-o", self.folder / "unary.png")
        self.render("--samples", "5", "--stream", "-o", self.folder / "stream.png", "--info", self.folder / "stream.json")
        self.assertEqual((self.folder / "unary.png").read_bytes(), (self.folder / "stream.png").read_bytes())
        info = json.loads((self.folder / "stream.json").read_text())
        self.assertEqual((info["state"], info["format"], info["samples"]), ("converged", "png", 5))
        self.assertEqual(info["request"]["quality"]["samples"], 5)

    def test_an_existing_picture_is_replaced_as_a_whole(self):
        file = self.folder / "a.png"
        file.write_bytes(b"old")
        self.render("-o", file)
        self.assertEqual(png_size(file.read_bytes()), (96, 64))
        self.assertEqual([entry.name for entry in self.folder.iterdir()], ["a.png"])

    def test_wait_returns_as_soon_as_the_server_serves(self):
        self.radiata("list", "--wait", "30")


if __name__ == "__main__":
    unittest.main()
