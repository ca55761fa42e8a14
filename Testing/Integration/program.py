# SPDX-License-Identifier: BSD-3-Clause
"""Runs the built program as a stranger would: its words, its exit codes, the files that it leaves."""
import os
import pathlib
import resource
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = sys.argv[1]
ROOT = pathlib.Path(sys.argv[2])
SAMPLE = str(ROOT / "Data" / "sample_climate.nc")
SHARED = ROOT.parent / "shared" / "data"


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=240, **options)


def run_on_full_disk(*arguments):
    """No file may grow beyond 20 kB; Python's children would otherwise die of the signal. VTK's XML writer leaks when it fails."""
    return run(*arguments, restore_signals=False, env=os.environ | {"ASAN_OPTIONS": "detect_leaks=0"},
               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000)))


def unfiltered(kind, row, above, step):
    """A row of a PNG from its filtered bytes: PNG specification, section 9."""
    row = bytearray(row)
    for i, byte in enumerate(row):
        left = row[i - step] if i >= step else 0
        up = above[i]
        corner = above[i - step] if i >= step else 0
        guess = left + up - corner
        paeth = min((left, up, corner), key=lambda value: abs(guess - value))
        row[i] = (byte + (0, left, up, (left + up) // 2, paeth)[kind]) & 255
    return row


def pixels(path):
    """Width, height and rows of an 8-bit RGB PNG."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    assert (depth, color) == (8, 2), "not 8-bit RGB"
    raw = zlib.decompress(packed)
    rows, above = [], bytearray(3 * width)
    for y in range(height):
        start = y * (3 * width + 1)
        above = unfiltered(raw[start], raw[start + 1:start + 1 + 3 * width], above, 3)
        rows.append(above)
    return width, height, rows


def cloudy_share(path):
    """The share of pixels that are bright and grey, as clouds are."""
    width, height, rows = pixels(path)
    colors = (row[3 * x:3 * x + 3] for row in rows for x in range(width))
    return sum(1 for color in colors if min(color) > 90 and max(color) - min(color) < 70) / (width * height)


class ProgramTest(unittest.TestCase):
    """A folder of its own for each test, and what every failure has to look like."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def files(self):
        return sorted(os.listdir(self.folder))

    def assert_done(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)

    def assert_failed(self, done, *words):
        """After the note which time was chosen."""
        done.stderr = "".join(line for line in done.stderr.splitlines(True) if ", step " not in line)
        self.assert_refused(done, 1, *words)

    def assert_refused(self, done, code, *words):
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, "one line: " + done.stderr)
        self.assertTrue(done.stderr.startswith("nephoscope: "), done.stderr)
        # An address begins a word; the random name of a test's folder may hold "0x" too.
        self.assertNotRegex(done.stderr, r"\.cxx|ERROR|\b0x|terminate")
        for word in words:
            self.assertIn(word, done.stderr)


def main():
    unittest.main(argv=sys.argv[:1])
