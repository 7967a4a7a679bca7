#!/usr/bin/env python3
"""Opens the pages that `aplomb --html` writes in headless Chromium: what stands there, and whether it is seen."""
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
import zlib

CLI = os.environ["APLOMB_CLI"]
FIXTURES = pathlib.Path(os.environ["APLOMB_FIXTURES"])
CHROMIUM = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars"]
WIDTH, HEIGHT = 800, 800


def pixels(path):
    """(width, height, rows of RGB or RGBA bytes, bytes a pixel) of a PNG of 8 bits, not interlaced."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and colour in (2, 6) and interlace == 0
        elif kind == b"IDAT":
            packed += body
        at += length + 12
    size = 3 if colour == 2 else 4
    raw, rows, previous = zlib.decompress(packed), [], bytearray(width * size)
    for y in range(height):
        start = y * (width * size + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + width * size])
        for i in range(len(row)):
            left = row[i - size] if i >= size else 0
            up, corner = previous[i], previous[i - size] if i >= size else 0
            if method == 4:
                guess = left + up - corner
                nearest = min((left, up, corner), key=lambda v: abs(guess - v))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest if method == 4 else 0)[method]) & 255
        rows.append(row)
        previous = row
    return width, height, rows, size


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def write(self, exit_code, *arguments):
        page = self.path / "page.html"
        done = subprocess.run([CLI, *map(str, arguments), "--html", str(page), "-q"], cwd=self.path, capture_output=True, text=True)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        return page

    def chromium(self, *arguments):
        command = [*CHROMIUM, f"--user-data-dir={self.path / 'profile'}", *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True, timeout=120).stdout

    def shown(self, page, *flags):
        """The DOM as Chromium has it, and what it draws."""
        dom = self.chromium("--dump-dom", page.as_uri())
        picture = self.path / "picture.png"
        self.chromium(f"--window-size={WIDTH},{HEIGHT}", f"--screenshot={picture}", *flags, page.as_uri())
        return dom, pixels(picture)

    def test_tells_and_shows_how_a_carved_figure_stands_and_prints(self):
        page = self.write(0, "stand", FIXTURES / "trex.stl", "-o", "standing.3mf")
        self.assertLess(page.stat().st_size, 3_000_000)
        dom, (width, height, rows, size) = self.shown(page)
        self.assertRegex(dom, r"<h1>Stands now: 10\.\d degrees .*</h1>")
        for row in ("mesh.manifold", "mesh.roundtrip", "stand.nominal", "mass.gained"):
            self.assertRegex(dom, rf"<tr><td>{row}</td>")
        self.assertEqual(dom.count("<svg"), 2)
        self.assertEqual((width, height), (WIDTH, HEIGHT))
        colours = {tuple(row[x:x + 3]) for row in rows for x in range(0, len(row), 7 * size)}
        clay = sum(1 for r, g, b in colours if r > 1.5 * b and r > 1.15 * g and r > 120)
        self.assertGreater(clay, 50, "the figure's colours are not on the page")

    def test_needs_no_network_and_runs_no_code(self):
        text = self.write(6, "validate", FIXTURES / "trex.stl").read_text()
        self.assertNotRegex(text, r"https?://(?!www\.w3\.org)|<script|\bon\w+=|@import|<link")
        self.assertIn("default-src 'none'", text)

    def test_shows_what_is_in_the_way_with_place_and_remedy(self):
        page = self.write(6, "validate", FIXTURES / "broken_holes.stl")
        dom, _ = self.shown(page)
        self.assertRegex(dom, r"<h1>Will not print as it is \(fdm\)</h1>")
        self.assertRegex(dom, r"<td>mesh\.manifold</td>.*75; at most 0</td><td>\(-2\.6, 24\.1, 24\.7\) mm</td>")
        self.assertIn("not judged", dom)

    def test_is_dark_where_the_reader_prefers_it(self):
        page = self.write(0, "check", FIXTURES / "knight.stl")
        _, (_, _, light, size) = self.shown(page)
        _, (_, _, dark, _) = self.shown(page, "--blink-settings=preferredColorScheme=0")
        corner = lambda rows: sum(rows[-3][0:3])
        self.assertGreater(corner(light), 600)
        self.assertLess(corner(dark), 200)

    def test_names_are_text_and_not_markup(self):
        model = self.path / "a<b>&c.stl"
        model.write_bytes((FIXTURES / "knight.stl").read_bytes())
        dom, _ = self.shown(self.write(0, "check", model))
        self.assertIn("a&lt;b&gt;&amp;c.stl", dom)
        self.assertIsNone(re.search(r"<b>", dom))


if __name__ == "__main__":
    unittest.main()
