"""radiata-load against the stub renderer: every count adds up, the clients are served alike. No time decides a test."""

import json
import unittest

from programs import ClientTest, run

STAGES = ["camera_to_frame", "without_render_encode", "queue", "render", "encode", "transport", "send_delay"]


class LoadTest(ClientTest):
    def load(self, *arguments, **options):
        return run("radiata-load", *arguments, server=self.server.address, **options)

    def test_eight_clients_at_thirty_hertz(self):
        file = self.folder / "report.json"
        done = self.load("--clients", "8", "--seconds", "5", "--rate", "30", "--size", "320x180", "--json", file)
        report = json.loads(file.read_text())
        p95 = report["stages_ms"]["without_render_encode"]["p95"]
        print(f"Jain {report['jain']:.4f}, without render and encode p95 {p95:.2f} ms, "
              f"{report['frames']} frames of {report['updates']}")
        self.assertEqual(report["updates"], 8 * 5 * 30)
        self.assertEqual(report["frames"] + report["skipped"], report["updates"])
        self.assertGreaterEqual(report["jain"], 0.9)
        self.assertEqual(list(report["stages_ms"]), STAGES)
        for name in STAGES[:-1]:
            stage = report["stages_ms"][name]
            self.assertEqual(stage["count"], report["frames"])
            self.assertLessEqual(stage["p50"], stage["p95"])
            self.assertLessEqual(stage["p95"], stage["p99"])
        self.assertEqual(len(report["clients"]), 8)
        for client in report["clients"]:
            self.assertEqual(client["updates"], 150)
            self.assertGreater(client["frames"], 0)
            self.assertGreater(client["bytes"], 0)
            self.assertEqual((client["failed_updates"], client["error"]), (0, ""))
        for name in STAGES:
            self.assertIn(name, done.stdout)
        self.assertIn("Jain", done.stdout)

    def test_a_path_file_and_json_to_standard_output(self):
        path = self.folder / "path.json"
        cameras = [{"eye_mm": [x, -300, 0], "target_mm": [0, 0, 0], "up": [0, 0, 1], "height_mm": 150} for x in range(5)]
        path.write_text(json.dumps({"cameras": cameras}))
        done = self.load("--clients", "2", "--seconds", "0.5", "--warmup", "0.2", "--size", "64x64", "--path", path,
                         "--window", "3", "--json", "-")
        report = json.loads(done.stdout)
        self.assertEqual((report["window"], report["width"], report["height"]), (3, 64, 64))
        self.assertEqual(report["frames"] + report["skipped"], report["updates"])

    def test_more_views_than_the_server_keeps_are_refused(self):
        limit = json.loads(run("radiata", "limits", "--json", server=self.server.address).stdout)["views_max"]
        done = self.load("--clients", limit + 1, "--seconds", "0.2", "--size", "16x16", check=False)
        self.assert_fails(done, 4, str(limit))

    def test_an_impossible_window_is_refused(self):
        self.assert_fails(self.load("--clients", "1", "--window", "1000", check=False), 4, "1000")


if __name__ == "__main__":
    unittest.main()
