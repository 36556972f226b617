"""What comparisons with mrview have in common: running both programs, and telling times."""
import os
import pathlib
import platform
import re
import socket
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent


class Mrview:
    """mrview with what a comparison shows in it (words()), painted by one grab after the other. \\param fov_mm  field of view"""

    def __init__(self, name, size, work, fov_mm):
        self.name, self.size, self.work, self.fov_mm = name, size, work, fov_mm
        self.counter = work / "paint_counter.so"
        subprocess.run(["g++", "-O2", "-shared", "-fPIC", HERE / "paint_counter.cpp", "-o", self.counter, "-ldl"], check=True)

    def words(self):
        """The image, and options that load what is shown."""
        raise NotImplementedError

    def run(self, grabs):
        """\\return seconds, the draws of each paint of everything, and the most draws"""
        counts = self.work / "paints.txt"
        counts.unlink(missing_ok=True)
        width, height = self.size
        command = ["xvfb-run", "-a", "-s", f"-screen 0 {width + 1100}x{height + 700}x24", "mrview", *map(str, self.words()),
                   "-noannotations", "-size", f"{width},{height}", "-plane", "2", "-capture.folder", self.work,
                   "-capture.prefix", "mrview"]
        for i in range(grabs):
            command += ["-fov", str(self.fov_mm + 0.1 * i), "-capture.grab"]
        command.append("-exit")
        environment = {**os.environ, "PAINT_COUNTER": str(counts), "LD_PRELOAD": str(self.counter)}
        start = time.monotonic()
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=900)
        seconds = time.monotonic() - start
        draws = [int(line) for line in counts.read_text().split()] if counts.exists() else []
        if done.returncode != 0 or not draws:
            sys.exit(f"{self.name}: mrview ended with {done.returncode} after {len(draws)} paints: {done.stderr.strip()[-500:]}")
        return seconds, [d for d in draws if d > 0.8 * max(draws)], max(draws)

    def frame(self):
        """\\return seconds a frame, by the difference of two runs, and the draws of a paint"""
        once, paints_once, draws = self.run(1)
        twice, paints_twice, _ = self.run(2)
        more = len(paints_twice) - len(paints_once)
        if more < 1 or twice <= once:
            sys.exit(f"{self.name}: two grabs took {twice:.1f} s and {len(paints_twice)} paints, one {once:.1f} s and "
                     f"{len(paints_once)}: nothing can be said; is the machine busy?")
        return (twice - once) / more, draws


class Radiata:
    """A server with one dataset."""

    def __init__(self, name, dataset, programs, work, options=()):
        self.name, self.programs, self.work = name, programs, work
        folder = work / "data"
        folder.mkdir()
        (folder / dataset.name).symlink_to(dataset.resolve())
        self.address = f"127.0.0.1:{free_port()}"
        self.log = open(work / "server.log", "w")
        self.server = subprocess.Popen([programs / "radiata-server", "--listen", self.address, "--data", folder, *options],
                                       stdout=self.log, stderr=subprocess.STDOUT)
        self.id = re.sub(r"[^a-z0-9_-]", "_", dataset.name.split(".")[0].lower())
        for _ in range(300):
            if self.server.poll() is not None:
                sys.exit(f"{name}: radiata-server ended: {(work / 'server.log').read_text()[-500:]}")
            if self.call("list").returncode == 0:
                break
            time.sleep(0.2)

    def dataset(self):
        return self.id

    def call(self, *words):
        return subprocess.run([self.programs / "radiata", "--server", self.address, "--timeout", "3000", *words], capture_output=True,
                              text=True, timeout=3600)

    def close(self):
        self.server.terminate()
        self.server.wait(30)
        self.log.close()


def require(name, programs):
    for program in ("radiata", "radiata-server"):
        if not (programs / program).exists():
            sys.exit(f"{name}: {programs / program} is not there; --bin names the folder")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def spread(times):
    return f"{statistics.median(times):8.3f}  {min(times):.3f}-{max(times):.3f}"


def processor():
    found = re.search(r"model name\s*:\s*(.+)", pathlib.Path("/proc/cpuinfo").read_text())
    return found.group(1) if found else platform.processor()
