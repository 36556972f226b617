"""Isosurfaces and their light: every setting by the command line and by the Python package is the same request over gRPC, and
the shadings, lights and broken files that a server with the real renderer gets."""

import json
import struct
import unittest

import radiata
from programs import BIN, DATASET, ClientTest, ServerProcess, png_size

SHAPE = ["--size", "96x64", "--samples", "1", "--no-annotations"]
GLOBAL = ["--global-light", "irradiance"]
SURFACE = {"dataset_id": DATASET, "isovalue": 0.25}

# Name, arguments after --isosurface, fields of the surface's layer, of the light, of the quality.
SETTINGS = [
    ("value chosen", [], {"isovalue": None}, {}, {}),
    ("exact hits", ["--surface-method", "exact"], {}, {}, {"isosurface": {"method": "SURFACE_METHOD_EXACT"}}),
    ("steps", ["--surface-method", "march-bisect", "--surface-step", "0.25", "--surface-bisections", "3"], {}, {},
     {"isosurface": {"method": "SURFACE_METHOD_MARCH_BISECT", "step": 0.25, "bisections": 3}}),
    ("triangles", ["--surface-method", "marching-cubes"], {}, {}, {"isosurface": {"method": "SURFACE_METHOD_MARCHING_CUBES"}}),
    ("trilinear normals", ["--surface-normals", "trilinear"], {}, {}, {"isosurface": {"normals": "SURFACE_NORMALS_TRILINEAR"}}),
    ("no bricks", ["--surface-bricks", "false"], {}, {}, {"isosurface": {"bricks": False}}),
    ("Lambert", ["--shading", "lambert"], {"shading": "SURFACE_SHADING_LAMBERT"}, {}, {}),
    ("Lambert in fog", ["--shading", "lambert-fog"], {"shading": "SURFACE_SHADING_LAMBERT", "fog": 0.9}, {}, {}),
    ("Phong", ["--shading", "phong"], {"shading": "SURFACE_SHADING_PHONG"}, {}, {}),
    ("hard shadows", ["--shadow", "hard"], {}, {"shadow": "SHADOW_HARD"}, {}),
    ("ambient occlusion", ["--ambient-occlusion", "8"], {}, {"ambient_occlusion": {"rays": 8}}, {}),
    ("vicinity", ["--shading", "vicinity"], {}, {"illumination": {"payload": "TEXEL_PAYLOAD_IRRADIANCE", "bounces": 0,
                                                                  "sky": {"radiance": {"x": 1, "y": 1, "z": 1}}}}, {}),
    ("full", ["--shading", "full"], {}, {"illumination": {"payload": "TEXEL_PAYLOAD_IRRADIANCE"}}, {}),
    ("paths", GLOBAL + ["--light-method", "path-tracing"], {}, {"illumination": {"method": "ILLUMINATION_METHOD_PATH_TRACING"}}, {}),
    ("constant sky", GLOBAL + ["--sky", "0.5,0.25,1"], {}, {"illumination": {"sky": {"radiance": {"x": 0.5, "y": 0.25, "z": 1}}}},
     {}),
    ("gradient sky", GLOBAL + ["--sky-gradient", "0.5,0.5,0.25", "--sky-up", "0,1,0"], {},
     {"illumination": {"sky": {"gradient": {"x": 0.5, "y": 0.5, "z": 0.25}, "up": {"x": 0, "y": 1, "z": 0}}}}, {}),
    ("suns", GLOBAL + ["--sun", "0,0,1,5,1,1,1", "--sun", "1,0,0,18,0.5,0.5,0"], {},
     {"illumination": {"suns": [{"direction": {"x": 0, "y": 0, "z": 1}, "angular_radius_deg": 5, "irradiance": {"x": 1, "y": 1, "z": 1}},
                                {"direction": {"x": 1, "y": 0, "z": 0}, "angular_radius_deg": 18,
                                 "irradiance": {"x": 0.5, "y": 0.5, "z": 0}}]}}, {}),
    ("points and spheres", GLOBAL + ["--lamp", "9,8,7,0,100,90,80", "--lamp", "1,2,3,4,5,6,7"], {},
     {"illumination": {"lights": [{"position_mm": {"x": 9, "y": 8, "z": 7}, "radius_mm": 0, "intensity": {"x": 100, "y": 90, "z": 80}},
                                  {"position_mm": {"x": 1, "y": 2, "z": 3}, "radius_mm": 4, "intensity": {"x": 5, "y": 6, "z": 7}}]}},
     {}),
    ("environment, turned", GLOBAL + ["--environment", "sky", "--environment-scale", "0.5", "--turn-light", "1,0,0,1"], {},
     {"illumination": {"environment": {"id": "sky", "scale": 0.5}, "rotation": [1, 0, 0, 1]}}, {}),
    ("transfer", ["--global-light", "transfer", "--transfer-orders", "4,3,2", "--bounces", "2"], {},
     {"illumination": {"payload": "TEXEL_PAYLOAD_TRANSFER", "orders": [4, 3, 2], "bounces": 2}}, {}),
    ("accuracy", GLOBAL + ["--light-error", "0.125", "--light-samples", "64", "--light-budget", "32", "--random-paths"], {},
     {"illumination": {"relative_error": 0.125, "samples_max": 64, "budget_mib": 32, "sampling": "TEXEL_SAMPLING_RANDOM"}}, {}),
    ("own level sets", GLOBAL + ["--own-level-sets"], {}, {"illumination": {"project": False}}, {}),
    ("whole lattice", GLOBAL + ["--full", "--own-level-sets"], {}, {"illumination": {"full": True, "project": False}}, {}),
] + [
    (f"storage {word}", GLOBAL + ["--texel-storage", word], {}, {"illumination": {"storage": f"TEXEL_STORAGE_{word.upper()}"}}, {})
    for word in ("float32", "float16", "rgb8")
] + [
    (f"interpolation {word}", GLOBAL + ["--texel-interpolation", word], {},
     {"illumination": {"interpolation": "TEXEL_INTERPOLATION_" + word.upper().replace("-", "_")}}, {})
    for word in ("own-isovalue", "nearest", "trilinear", "tricubic")
] + [
    (f"resolution {word}", GLOBAL + ["--texels-per-voxel", word], {}, {"illumination": {"resolution": f"LATTICE_RESOLUTION_{name}"}}, {})
    for word, name in (("1/8", "EIGHTH"), ("1", "ONE"), ("8", "EIGHT"))
]


def words(message):
    """A message as `radiata render --info` writes it: vectors as lists, enums as words."""
    if message.DESCRIPTOR.name == "Vec3":
        return [message.x, message.y, message.z]

    def single(field, value):
        if field.message_type is not None:
            return words(value)
        if field.enum_type is None:
            return value
        names = field.enum_type.values_by_number
        prefix = names[0].name[:-len("UNSPECIFIED")]
        return names[value].name[len(prefix):].lower().replace("_", "-")

    result = {}
    for field in message.DESCRIPTOR.fields:
        value = getattr(message, field.name)
        if field.label == field.LABEL_REPEATED:
            result[field.name] = [single(field, entry) for entry in value]
        elif not field.has_presence or message.HasField(field.name):
            result[field.name] = single(field, value)
    return result


class SettingsTest(ClientTest):
    def test_settings_are_one_request_by_both_clients(self):
        client = radiata.Client(self.server.address, timeout=60)
        self.addCleanup(client.close)
        info = self.folder / "a.json"
        seen = set()
        for name, arguments, surface, light, quality in SETTINGS:
            layer = {key: value for key, value in {**SURFACE, **surface}.items() if value is not None}
            value = f":{layer['isovalue']}" if "isovalue" in layer else ""
            self.radiata("render", *SHAPE, "--isosurface", DATASET + value, *arguments, "--info", info)
            request = json.loads(info.read_text())["request"]
            frame = client.render(layers=[{"isosurface": layer}], size=(96, 64), samples=1, annotations=False, light_fields=light,
                                  quality_fields=quality)
            echo = frame.message.request
            self.assertEqual(request["scene"]["layers"], [words(entry) for entry in echo.scene.layers], name)
            self.assertEqual(request["scene"]["light"], words(echo.scene.light), name)
            self.assertEqual(request["quality"]["isosurface"], words(echo.quality.isosurface), name)
            seen.add(echo.scene.SerializeToString(deterministic=True) + echo.quality.SerializeToString(deterministic=True))
        # Those that are defaults are one request: exact hits, irradiance as it comes.
        self.assertGreaterEqual(len(seen), len(SETTINGS) - 6)


def write_volume(path, size, value, promised=None):
    """A NIfTI file of floats, voxels of 1 mm about the origin."""
    count = size[0] * size[1] * size[2]
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *(promised or size), 1, 1, 1, 1)
    struct.pack_into("<2h", header, 70, 16, 32)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<2f", header, 108, 352, 1)
    struct.pack_into("<h", header, 254, 1)
    for axis in range(3):
        row = [0.0, 0.0, 0.0, -0.5 * (size[axis] - 1)]
        row[axis] = 1.0
        struct.pack_into("<4f", header, 280 + 16 * axis, *row)
    header[344:348] = b"n+1\0"
    voxels = [value(n % size[0], n // size[0] % size[1], n // (size[0] * size[1])) for n in range(count)]
    path.write_bytes(bytes(header) + struct.pack(f"<{count}f", *voxels))


def ball(x, y, z):
    return 5 - ((x - 5.5) ** 2 + (y - 5.5) ** 2 + (z - 5.5) ** 2) ** 0.5


class RealSurfacesTest(ClientTest):
    @classmethod
    def setUpClass(cls):
        pass

    def setUp(self):
        super().setUp()
        nan = float("nan")
        data = self.folder / "data"
        data.mkdir()
        write_volume(data / "ball.nii", (12, 12, 12), ball)
        write_volume(data / "holes.nii", (12, 12, 12), lambda x, y, z: nan if x < 2 else ball(x, y, z))
        write_volume(data / "nothing.nii", (4, 4, 4), lambda x, y, z: nan)
        write_volume(data / "even.nii", (4, 4, 4), lambda x, y, z: 3)
        write_volume(data / "voxel.nii", (1, 1, 1), ball)
        write_volume(data / "slice.nii", (12, 12, 1), ball)
        write_volume(data / "liar.nii", (4, 4, 4), ball, promised=(400, 4, 4))
        write_volume(data / "negative.nii", (4, 4, 4), ball, promised=(-4, 4, 4))
        raw = "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\nendian: little\nencoding: raw\n"
        (data / "lost.nhdr").write_text(raw + "data file: nowhere.raw\n")
        (data / "climbs.nhdr").write_text(raw + "data file: ../ball.nii\n")
        row = b"\x02\x02\x00\x10" + 4 * b"\x90\x80"
        picture = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n"
        (data / "sky.hdr").write_bytes(picture % (8, 16) + 8 * row)
        (data / "short.hdr").write_bytes(picture % (8, 16) + 7 * row + row[:4])
        (data / "huge.hdr").write_bytes(picture % (1000000, 2000000) + 8 * row)
        self.server = ServerProcess([BIN / "radiata-server", "--listen", "127.0.0.1:0", "--data", data, "--pipeline-cache",
                                     self.folder / "pipelines", "--tract-cache", ""])
        self.addCleanup(self.server.stop)

    def render(self, *arguments, **options):
        return self.radiata("render", "--size", "24x16", "--samples", "1", "--no-annotations", "-o", self.folder / "a.png",
                            *arguments, **options)

    def test_shadings_and_lights_differ_and_broken_files_are_told_in_one_sentence(self):
        traced = ["--light-samples", "16", "--light-error", "0.5"]
        looks = {
            "Phong": ["--shading", "phong"],
            "Lambert in fog": ["--shading", "lambert-fog"],
            "vicinity": ["--shading", "vicinity", *traced],
            "full, map": ["--shading", "full", "--environment", "sky", "--sun", "1,0,1,5,1,1,1", *traced],
            "full, lamps": ["--shading", "full", "--lamp", "0,-9,9,0,60,60,60", "--lamp", "9,-9,0,2,60,0,0", *traced],
            "transfer": ["--global-light", "transfer", "--transfer-orders", "2,2", "--bounces", "1", *traced],
        }
        pictures = set()
        for name, arguments in looks.items():
            done = self.render("--isosurface", "ball:0.5", *arguments)
            self.assertEqual("global light: " in done.stderr + done.stdout, "--light-samples" in arguments, name)
            picture = (self.folder / "a.png").read_bytes()
            self.assertEqual(png_size(picture), (24, 16))
            pictures.add(picture)
        self.assertEqual(len(pictures), len(looks))
        self.render("--isosurface", "holes:0.5")
        self.assertRegex(self.radiata("info", "holes").stdout, r"voxels without a value +288\b")

        done = self.render("--isosurface", "ball:0.5,opacity=0.5", *GLOBAL, "--info", self.folder / "info.json")
        self.assertEqual(done.stderr, "no global light: only opaque isosurfaces without a shading of their own take it\n")
        left_out = json.loads((self.folder / "info.json").read_text())["left_out"]
        self.assertEqual([(one["layer"], one["global_light"]) for one in left_out], [(0, True)])
        done = self.render("--isosurface", "ball:0.7", *GLOBAL, "--light-samples", "4", "--light-error", "0.001")
        self.assertRegex(done.stderr, r"global light: (\d+) of \1 texels done \(lattice of 1728\), \d+ of them by the most samples")
        done = self.render("--isosurface", "ball:0.5", *GLOBAL, "--light-method", "path-tracing", *traced)
        self.assertRegex(done.stderr, r"global light: (\d+) of \1 lit pixels done \(picture of 384\)")

        little = self.render("--isosurface", "ball:0.5", *GLOBAL, *traced, "--light-budget", "0.001")
        self.assertIn("the budget had no room for", little.stderr + little.stdout)
        light = ["--isosurface", "ball:0.5", *GLOBAL, *traced]
        for arguments, sentence in (
                (["--isosurface", "ball:50"], "isovalue is 50; 'ball' has values from -"),
                (["--isosurface", "nothing"], "none of the 64 voxels is a finite number"),
                (["--isosurface", "even"], "'even' has the value 3 everywhere"),
                (["--isosurface", "voxel"], "1 x 1 x 1 voxels; an isosurface needs at least 2"),
                (["--isosurface", "slice"], "12 x 12 x 1 voxels"),
                (["--isosurface", "liar"], "the header promises data up to byte"),
                (["--isosurface", "negative"], "axis 1 has length -4; it must be at least 1"),
                (["--isosurface", "lost"], "there is no data file 'nowhere.raw'"),
                (["--isosurface", "climbs"], "is not inside the header's folder"),
                ([*light, "--environment", "short"], "it ends before its last pixel"),
                ([*light, "--environment", "huge"], "2x1 to 16384x16384 are read"),
                ([*light, "--environment", "ball"], "needs an environment map"),
                ([*light, "--light-budget", "0"], "budget_mib is 0; it must be 0.001 to"),
        ):
            self.assert_fails(self.render(*arguments, check=False), 4, sentence)


if __name__ == "__main__":
    unittest.main()
