"""Every exit code of the client programs, each with one line on stderr: 2 usage, 3 not reachable, 4 refused, 5 output."""

import json
import os
import socket
import unittest

from programs import SOURCE, ClientTest, fake_server, run

CAMERA = {"eye_mm": [0, 0, 100], "target_mm": [0, 0, 0], "up": [0, 1, 0], "height_mm": 100}


def closed_port():
    """An address of this machine on which nobody listens."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"127.0.0.1:{probe.getsockname()[1]}"


class ErrorsTest(ClientTest):
    def fails(self, code, arguments, *words, server=None, program="radiata"):
        done = run(program, *arguments, server=server or self.server.address, check=False)
        self.assert_fails(done, code, *words)

    def test_usage(self):
        out = self.folder / "a.png"
        for arguments, word in (([], "command is needed"),
                                (["rendr"], "rendr"),
                                (["render"], "-o FILE"),
                                (["render", "-o", out, "--plane", "diagonal"], "diagonal"),
                                (["render", "-o", out, "--plane", "oblique"], "--normal"),
                                (["render", "-o", out, "--normal", "0,0,1"], "--plane oblique"),
                                (["render", "-o", out, "--position", "1,2"], "--position"),
                                (["render", "-o", out, "--size", "12"], "WIDTHxHEIGHT"),
                                (["render", "-o", out, "--volume", "--slab", "2"], "--slab"),
                                (["render", "-o", out, "--shadow", "long"], "--shadow"),
                                (["render", "-o", out, "--light-radius", "5"], "--shadow soft"),
                                (["render", "-o", out, "--shadow", "hard", "--shadow-rays", "5"], "--shadow soft"),
                                (["render", "-o", out, "--occlusion-radius", "5"], "--ambient-occlusion"),
                                (["render", "-o", out, "--tracts", "a", "--cut-by-depths"], "--cut-inside"),
                                (["render", "-o", out, "--tracts", "a", "--hide-unselected"], "--select"),
                                (["render", "-o", out, "--tracts", "a", "--fibre-slab", "0,0,0,0,0,1,0"], "thickness of 0"),
                                (["render", "-o", out, "--tracts", "a", "--uncertainty", "b"], "glyphs"),
                                (["render", "-o", out, "--isosurface", "a,shading=phong,shading=lambert"], "shading is given twice"),
                                (["render", "-o", out, "--isosurface", "a", "--vicinity", "--shading", "phong"], "--vicinity"),
                                (["render", "-o", out, "--isosurface", "a", "--global-light", "transfer", "--shading", "phong"],
                                 "--global-light"),
                                (["render", "-o", out, "--light", "0,0,1", "--light-world", "0,0,1"], "--light-world"),
                                (["render", "-o", out, "--camera", "{broken"], "JSON"),
                                (["render", "-o", out, "--camera", "no-such-file.json"], "no-such-file.json"),
                                (["render", "-o", out, "--camera", json.dumps({**CAMERA, "fov": 3})], "'fov'"),
                                (["render", "-o", out, "--depth", out], "two outputs"),
                                (["render", "-o", self.folder / "a.gif"], "ends in .gif"),
                                (["render", "-o", out, "--stream", "--depth", self.folder / "d.npy"], "--stream"),
                                (["orbit", "-o", self.folder, "--frames", "0"], "--frames"),
                                (["orbit"], "--output")):
            with self.subTest(arguments=arguments):
                self.fails(2, arguments, word)
        self.assertFalse(out.exists())

    def test_unreachable(self):
        self.fails(3, ["list"], "cannot be reached", server=closed_port())
        self.fails(3, ["list", "--wait", "0.3"], "cannot be reached", server=closed_port())
        self.fails(3, ["--clients", "1"], "cannot be reached", server=closed_port(), program="radiata-load")

    def test_refused_with_the_servers_sentence(self):
        out = ["-o", self.folder / "a.png"]
        self.fails(4, ["info", "nobody"], "nobody")
        self.fails(4, ["info", "../../etc/passwd"], "passwd")
        self.fails(4, ["render", "--dataset", "nobody"] + out, "nobody")
        self.fails(4, ["render", "--size", "100000x100000"] + out, "100000x100000")
        self.fails(4, ["render", "--size", "0x10"] + out, "0x10")
        self.fails(4, ["render", "--samples", "65"] + out, "65")
        self.fails(4, ["render", "--factor", "nan"] + out, "factor")
        for radius in ("0", "-1", "nan"):
            self.fails(4, ["render", "--shadow", "soft", "--light-radius", radius] + out, "angular_radius_deg")
        self.fails(4, ["render", "--shadow", "soft", "--shadow-rays", "10000"] + out, "shadow_rays is 10000")
        self.fails(4, ["render", "--light", "0,0,0"] + out, "direction_camera is (0, 0, 0)")
        self.fails(4, ["render", "--background", "0,2,0"] + out, "background is (0, 2, 0)")
        self.fails(4, ["render", "--plane", "oblique", "--normal", "0,nan,1"] + out, "normal is (0, nan, 1)")
        for camera, word in (({**CAMERA, "up": [0, 0, 0]}, "up"), ({**CAMERA, "up": [0, 0, 2]}, "parallel"),
                             ({**CAMERA, "eye_mm": [0, 0, 0]}, "differ"), ({**CAMERA, "height_mm": -1}, "height_mm"),
                             ({**CAMERA, "clip": {"nearest_mm": 3, "farthest_mm": 2}}, "clip")):
            with self.subTest(camera=camera):
                self.fails(4, ["render", "--camera", json.dumps(camera)] + out, word)
                self.fails(4, ["render", "--stream", "--camera", json.dumps(camera)] + out, word)
        self.fails(4, ["--clients", "1", "--dataset", "nobody"], "nobody", program="radiata-load")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_output_that_cannot_be_written(self):
        self.fails(5, ["render", "-o", self.folder / "missing" / "a.png"], "missing")
        self.fails(5, ["render", "-o", self.folder], "folder")
        self.fails(5, ["render", "--depth", "/proc/depth.npy"], "/proc/depth.npy")
        (self.folder / "file").write_text("in the way")
        self.fails(5, ["orbit", "-o", self.folder / "file"], "file")
        self.fails(5, ["--clients", "1", "--json", self.folder / "missing" / "a.json"], "missing", program="radiata-load")
        if os.path.exists("/dev/full"):
            self.fails(5, ["render", "--size", "64x64", "-o", "/dev/full"], "/dev/full")

    def test_the_servers_own_flags(self):
        for arguments, word in ((["--listen", "127.0.0.1:99999"], "0 to 65535"), (["--listen", "here"], "0 to 65535"),
                                (["--limits", "width=-1"], "width=-1"), (["--threads", "0"], "--threads")):
            with self.subTest(arguments=arguments):
                done = run("radiata-server", "--stub-render", "0", *arguments, check=False)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, r"\Aradiata-server: [^\n]+\n\Z")
                self.assertIn(word, done.stderr)

    def test_the_service_unit_names_flags_that_there_are(self):
        unit = (SOURCE / "deploy/radiata-server.service").read_text().replace("\\\n", " ")
        command = next(line for line in unit.splitlines() if line.startswith("ExecStart="))
        known = run("radiata-server", "--help").stdout
        flags = [word for word in command.split() if word.startswith("--")]
        self.assertIn("--data", flags)
        for flag in flags:
            self.assertIn(f"  {flag} ", known)

    def test_a_misbehaving_server_is_named(self):
        for mode, arguments, code, word in (
                ("array", ["render", "--depth", self.folder / "d.npy"], 4, "4 bytes"),
                ("picture", ["render", "-o", self.folder / "a.png"], 4, "no picture"),
                ("view", ["render", "--stream", "-o", self.folder / "a.png"], 3, "ended the view"),
                ("health", ["list"], 3, "SERVING")):
            with self.subTest(mode=mode):
                server = fake_server(mode)
                self.addCleanup(server.stop)
                self.fails(code, arguments, word, server=server.address)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_load_keeps_to_this_machine(self):
        self.fails(2, ["--clients", "1"], "--allow-remote", server="192.0.2.1:50051", program="radiata-load")


if __name__ == "__main__":
    unittest.main()
