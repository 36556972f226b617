"""Starts servers and runs the client programs for the tests of this folder."""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(os.environ["RADIATA_BIN"])
SOURCE = pathlib.Path(os.environ["RADIATA_SOURCE"])
DATASET = "stub"
SERVER = [BIN / "radiata-server", "--listen", "127.0.0.1:0", "--stub-render", "0"]


class ServerProcess:
    """A server on a free loopback port; `address` as it printed it."""

    def __init__(self, command):
        self.log = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen([str(part) for part in command], stdout=subprocess.PIPE, stderr=self.log, text=True)
        lines = []
        for line in self.process.stdout:
            lines.append(line)
            found = re.search(r"\b127\.0\.0\.1:([1-9]\d*)\b", line)
            if found:
                self.address = found.group(0)
                return
        self.log.seek(0)
        lines.append(self.log.read())
        self.stop()
        raise RuntimeError(f"{command[0]} printed no address: {''.join(lines)}")

    def stop(self):
        """Ends the process; returns its exit status."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.process.stdout.close()
        self.log.close()
        return self.process.returncode


def real_server():
    return ServerProcess(SERVER)


def fake_server(mode):
    return ServerProcess([sys.executable, "-B", SOURCE / "tests/clients/fake_server.py", mode])


def run(program, *arguments, server=None, check=True, timeout=60):
    """Runs a client program; returns the finished process with text output."""
    command = [str(BIN / program)] + ([f"--server={server}"] if server else []) + [str(a) for a in arguments]
    environment = {k: v for k, v in os.environ.items() if k != "RADIATA_SERVER"}
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=timeout, env=environment)
    if check and done.returncode != 0:
        raise AssertionError(f"{' '.join(command)} ended with {done.returncode}: {done.stderr}")
    return done


def png_size(data):
    """(width, height) of a PNG's bytes."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[12:16] == b"IHDR", data[:16]
    return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")


class ClientTest(unittest.TestCase):
    """One real server for the tests of a class, and a folder for each test."""

    @classmethod
    def setUpClass(cls):
        cls.server = real_server()
        cls.addClassCleanup(cls.server.stop)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def radiata(self, *arguments, **options):
        return run("radiata", *arguments, server=self.server.address, **options)

    def assert_fails(self, done, code, *words):
        """The exit code, one line on stderr that starts with the program's name, and words that it must hold."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertRegex(done.stderr, r"\Aradiata(-load)?: [^\n]+\n\Z")
        for word in words:
            self.assertIn(word, done.stderr)
