"""radiata-lab: what it needs to run, its list, its JSON and what --check refuses. No times are judged here."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

LAB = pathlib.Path(os.environ["RADIATA_BIN"]) / "radiata-lab"
# The C and C++ runtime; the Vulkan loader is opened at run time.
RUNTIME = r"^(linux-vdso|libvulkan|libstdc\+\+|libm|libgcc_s|libc|ld-linux-x86-64)\.so"


def lab(*arguments):
    return subprocess.run([LAB, *arguments], capture_output=True, text=True, timeout=170)


class LabTest(unittest.TestCase):
    def test_needs_only_the_runtime_and_the_vulkan_loader(self):
        lines = subprocess.run(["ldd", LAB], capture_output=True, text=True, check=True).stdout.splitlines()
        libraries = [pathlib.Path(line.split()[0]).name for line in lines if line.strip()]
        self.assertTrue(libraries)
        self.assertEqual([name for name in libraries if not re.match(RUNTIME, name)], [])

    def test_lists_its_experiments(self):
        names = [line.split()[0] for line in lab("list").stdout.splitlines()]
        self.assertEqual(names, ["glyph-frame", "march-vs-polynomial"])

    def test_small_run_writes_all_values_and_fails_its_check(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "run.json"
            result = lab("run", "glyph-frame", "--size", "64", "--repeats", "1", "--json", str(file), "--check")
            report = json.loads(file.read_text())
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("not a full run", result.stdout)
        self.assertTrue(any("height 64" in reason for reason in report["shortfalls"]))
        self.assertTrue(all(len(series["values"]) == 1 for series in report["series"]))
        self.assertIn("glyph pass / same boxes (auto)", [check["name"] for check in report["checks"]])
        capped = next(check for check in report["checks"] if check["name"] == "capped rays")
        self.assertEqual(capped["value"], 0)

    def test_unknown_experiment_is_one_sentence(self):
        result = lab("run", "nothing")
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("radiata-lab list", result.stderr)


if __name__ == "__main__":
    unittest.main()
