"""radiata-lab: what it needs to run, its list, its JSON and what --check refuses. No times are judged here."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

LAB = pathlib.Path(os.environ["RADIATA_BIN"]) / "radiata-lab"
# The C and C++ runtime; the Vulkan loader is opened at run time.
RUNTIME = r"^(linux-vdso|libvulkan|libstdc\+\+|libm|libgcc_s|libc|ld-linux-x86-64)\.so"
EXPERIMENTS = ["glyph-frame", "march-vs-polynomial", "glyph-pareto", "peters-bounds", "peters-table1", "peters-fig1", "peters-fig3", "peters-fig4",
               "peters-fig5", "peters-fig6", "peters-fig7", "hlawitschka-table1", "hlawitschka-table2", "hlawitschka-fig1", "hlawitschka-fig2", "hlawitschka-fig5",
               "isosurface-hits", "wyman-fig5", "wyman-table2", "wyman-fig6", "wyman-fig7", "wyman-fig9", "wyman-fig12", "wyman-table1", "wyman-fig4", "wyman-fig10", "wyman-fig11",
               "illumination-sampling", "illumination-first", "illumination-memory", "illumination-pareto", "fiblet-codec",
               "schertzer-table1", "schertzer-fig9", "fiblet-pipelines", "schertzer-table2", "schertzer-table3", "schertzer-fig8",
               "fiblet-scaling", "fiblet-streaming"]


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
        self.assertEqual(names, EXPERIMENTS)

    def test_small_run_writes_all_values_and_fails_its_check(self):
        with tempfile.TemporaryDirectory() as folder:
            file, svg_file = pathlib.Path(folder) / "run.json", pathlib.Path(folder) / "run.svg"
            result = lab("run", "glyph-frame", "--size", "64", "--repeats", "1", "--json", str(file), "--svg", str(svg_file), "--check")
            report = json.loads(file.read_text())
            picture = xml.etree.ElementTree.parse(svg_file).getroot()
        words = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("tiles, direct", words)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("not a full run", result.stdout)
        self.assertTrue(any("height 64" in reason for reason in report["shortfalls"]))
        self.assertTrue(all(len(series["values"]) == 1 for series in report["series"]))
        self.assertIn("glyph pass / same boxes (auto)", [check["name"] for check in report["checks"]])
        capped = next(check for check in report["checks"] if check["name"] == "capped rays")
        self.assertEqual(capped["value"], 0)

    def test_error_against_time_as_table_and_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            json_file, svg_file = pathlib.Path(folder) / "run.json", pathlib.Path(folder) / "run.svg"
            result = lab("run", "glyph-pareto", "--size", "32", "--repeats", "1", "--json", str(json_file), "--svg", str(svg_file))
            report = json.loads(json_file.read_text())
            picture = xml.etree.ElementTree.parse(svg_file).getroot()
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = [row for table in report["tables"] for row in table["rows"]]
        words = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        for method in ("march", "march, pole table", "polynomial, bracket stop", "polynomial, paper's stop"):
            self.assertIn(method, [row[0] for row in rows])
            self.assertIn(method, words)
        missed = report["tables"][0]["columns"].index("missed")
        self.assertTrue(all(row[missed] == "0" for row in rows if row[0].startswith("march")))
        self.assertEqual(words.count("dashed: Pareto front"), len(report["plots"]))
        self.assertEqual(len(report["plots"]), 2 * len(report["tables"]))

    def test_a_picture_of_an_experiment_without_plots_is_refused(self):
        result = lab("run", "glyph-frame", "--size", "16", "--repeats", "1", "--svg", "unused.svg")
        self.assertEqual(result.returncode, 3)
        self.assertIn("has no plot", result.stderr)

    def test_unknown_experiment_is_one_sentence(self):
        result = lab("run", "nothing")
        self.assertEqual(result.returncode, 3)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("radiata-lab list", result.stderr)


if __name__ == "__main__":
    unittest.main()
