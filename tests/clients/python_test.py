"""The Python package and its example against the real server."""

import json
import pathlib
import subprocess
import sys
import unittest

import grpc
import numpy as np

import radiata
from programs import DATASET, SOURCE, ClientTest, png_size

CAMERA = {"eye_mm": [30.0, -200.0, 40.0], "target_mm": [1.0, 2.0, 3.0], "up": [0.0, 0.0, 1.0], "height_mm": 120.0}


class PackageTest(ClientTest):
    def setUp(self):
        super().setUp()
        self.client = radiata.Client(self.server.address, timeout=60)
        self.addCleanup(self.client.close)

    def test_catalogue(self):
        self.client.wait_until_serving(30)
        self.assertEqual([entry.id for entry in self.client.list()], [DATASET])
        self.assertEqual(self.client.info(DATASET).id, DATASET)
        self.assertGreater(self.client.limits().pixels_max, 0)
        camera = self.client.fit_camera(DATASET, aspect=1.5, plane="coronal")
        self.assertGreater(camera.height_mm, 0)

    def test_render_gives_a_png_and_arrays(self):
        outputs = {"depth": ("f4", ()), "id": ("i4", (4,)), "position": ("f4", (3,)), "normal": ("f4", (3,)),
                   "steps": ("i4", ())}
        frame = self.client.render(DATASET, size=(96, 64), samples=2, camera=CAMERA, outputs=list(outputs))
        self.assertEqual(png_size(frame.png), (96, 64))
        self.assertEqual(set(frame.arrays), set(outputs))
        for name, (kind, channels) in outputs.items():
            self.assertEqual(frame.arrays[name].shape, (64, 96) + channels, name)
            self.assertEqual(frame.arrays[name].dtype, np.dtype(kind), name)
        self.assertEqual(frame.depth_mm.dtype, np.float64)
        self.assertEqual(frame.position_mm.shape, (64, 96, 3))
        self.assertTrue(frame.converged)
        self.assertEqual(radiata.camera_to_json(frame.message.request.camera), CAMERA)

    def test_same_picture_as_the_command_line(self):
        frame = self.client.render(DATASET, size=(96, 64), plane="sagittal", scale="per-glyph", lobes="shown", samples=3)
        self.radiata("render", "--size", "96x64", "--plane", "sagittal", "--scale", "per-glyph", "--lobes", "shown",
                     "--samples", "3", "-o", self.folder / "a.png")
        self.assertEqual(frame.png, (self.folder / "a.png").read_bytes())

    def test_colours(self):
        def echoed(**options):
            frame = self.client.render(DATASET, size=(96, 64), samples=1, **options)
            return frame.message.request.scene.layers[0].glyphs.colour
        self.assertEqual(echoed().WhichOneof("source"), "direction")
        self.assertEqual(echoed(colour="radius", colour_map="inferno", colour_range=(1, 2)).radius.range.high, 2)
        self.assertEqual(echoed(colour="scalar", colour_image="fa").scalar.image_id, "fa")
        self.assertEqual(echoed(colour=(0, 0.5, 1)).uniform.y, 0.5)
        for options in ({"colour": "scalar"}, {"colour_range": (0, 1)}, {"colour": "rainbow"},
                        {"colour": "radius", "colour_map": "jet"}):
            with self.assertRaises(ValueError):
                self.client.render(DATASET, **options)

    def test_layers_of_every_kind(self):
        request = radiata.frame_request(layers=[
            {"isosurface": {"dataset_id": "t1", "isovalue": 40.0}, "opacity": 0.25},
            {"tractogram": {"dataset_id": "tracts", "line_width_px": 2}}],
            light_fields={"illumination": {"bounces": 2}}, quality_fields={"fiblet_culling": "FIBLET_CULLING_NONE"})
        surface, tracts = request.scene.layers
        self.assertEqual((surface.isosurface.dataset_id, surface.opacity), ("t1", 0.25))
        self.assertEqual((tracts.tractogram.dataset_id, tracts.tractogram.line_width_px), ("tracts", 2))
        both = radiata.frame_request(DATASET, uncertainty={"dataset_id": "outer", "extinction_per_mm": 3.0},
                                     layers=[{"tractogram": {"dataset_id": "tracts"}}])
        self.assertEqual(both.scene.layers[0].glyphs.uncertainty.dataset_id, "outer")
        self.assertEqual(len(both.scene.layers), 2)
        for options in ({}, {"layers": [{"tractogram": {"path": "/etc"}}]}, {"dataset": DATASET, "uncertainty": {"sigma": 1}}):
            with self.assertRaises(ValueError):
                radiata.frame_request(**options)
        with self.assertRaisesRegex(radiata.Refused, "nothing"):
            self.client.render(layers=[{"tractogram": {"dataset_id": "nothing"}}])

    def test_stream_comes_to_rest_and_follows_the_camera(self):
        with self.client.stream(DATASET, size=(96, 64), samples=4) as view:
            first = next(frame for frame in view if frame.converged)
            sequence = view.update(camera=CAMERA)
            moved = next(frame for frame in view if frame.message.camera_sequence == sequence and frame.converged)
            self.assertEqual(moved.message.samples, 4)
            self.assertNotEqual(first.png, moved.png)
            view.close()
            self.assertEqual(list(view), [])
        unary = self.client.render(DATASET, size=(96, 64), samples=4, camera=CAMERA)
        self.assertEqual(unary.png, moved.png)

    def test_refusals_carry_the_servers_sentence(self):
        with self.assertRaisesRegex(radiata.Refused, "nobody") as caught:
            self.client.info("nobody")
        self.assertEqual(caught.exception.code, grpc.StatusCode.NOT_FOUND)
        with self.assertRaisesRegex(radiata.Refused, "up"):
            self.client.stream(DATASET, camera={**CAMERA, "up": [0, 0, 0]})
        with self.client.stream(DATASET, size=(64, 64)) as view:
            with self.assertRaisesRegex(radiata.Refused, "eye_mm"):
                view.update(camera={**CAMERA, "eye_mm": CAMERA["target_mm"]})
            self.assertTrue(next(frame for frame in view if frame.converged).png)

    def test_fibres_are_picked_and_selected(self):
        picture = {"size": (64, 48), "camera": CAMERA}
        self.assertEqual(self.client.pick_fibres([(1, 2), (30, 40)], DATASET, **picture), [], "glyphs are no fibres")
        with self.assertRaisesRegex(radiata.Refused, "outline"):
            self.client.pick_fibres([], DATASET, **picture)
        with self.assertRaisesRegex(radiata.Refused, "tractogram"):
            self.client.select(DATASET, "everything")

    def test_unreachable(self):
        with radiata.Client("127.0.0.1:1", timeout=5) as client:
            with self.assertRaises(radiata.Unreachable):
                client.list()
            with self.assertRaises(radiata.Unreachable):
                client.wait_until_serving(0.3)

    def test_words_and_cameras_are_checked_here(self):
        with self.assertRaisesRegex(ValueError, "axial"):
            self.client.render(DATASET, plane="diagonal")
        for camera in ({}, {**CAMERA, "fov": 1}, {**CAMERA, "field_of_view_deg": 3}, {**CAMERA, "up": [0, 1]}):
            with self.assertRaises(ValueError):
                radiata.camera_from_json(camera)

    def test_example_writes_pictures_and_arrays(self):
        path = self.folder / "path.json"
        path.write_text(json.dumps([CAMERA, {**CAMERA, "height_mm": 60.0}]))
        out = self.folder / "out"
        example = SOURCE / "client/python/examples/render_path.py"
        command = [sys.executable, example, "--server", self.server.address, "--dataset", DATASET, "--path", path, "--output",
                   out, "--size", "96", "64", "--samples", "1", "--outputs", "depth", "normal"]

        def example_run():
            return subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  timeout=60)

        done = example_run()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 2)
        names = sorted(entry.name for entry in pathlib.Path(out).iterdir())
        self.assertEqual(names, [f"frame-000{i}{part}" for i in (1, 2) for part in ("-depth.npy", "-normal.npy", ".png")])
        self.assertEqual(np.load(out / "frame-0002-normal.npy").shape, (64, 96, 3))
        command[command.index(DATASET)] = "nobody"
        done = example_run()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Arender_path: [^\n]*nobody[^\n]*\n\Z")


if __name__ == "__main__":
    unittest.main()
