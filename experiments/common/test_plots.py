#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the scripts of plots, and their pictures where gnuplot is installed."""

import shutil
import tempfile
import unittest
from pathlib import Path

import plots

SERIES = {"a_line": [(1, 0.5, 0.4, 0.6), (10, 0.05, 0.04, 0.06)], "zeros": [(1, 0, 0, 3e-4)], "empty": []}


class Plots(unittest.TestCase):
    def test_script_names_axes_and_lines(self):
        script = plots.line_plot(SERIES, "distance (ulp)", "share of walks", log="xy")
        for text in ['set xlabel "distance (ulp)"', 'set ylabel "share of walks"', r'"a\\_line"', '"zeros"', '"empty"',
                     "set logscale x", "set logscale y"]:
            self.assertIn(text, script)
        self.assertNotIn("\n1 0 0 0.0003", script)  # has no place on a logarithmic axis
        self.assertIn("\n1 0.0003\n", script)       # but its bound has

    def test_lines_differ_without_colour(self):
        self.assertEqual(len(plots.STYLES), len({style[:2] for style in plots.STYLES}))

    def test_colours_differ_and_are_seen_on_paper(self):
        colours = [colour for *_, colour in plots.STYLES]
        self.assertEqual(len(colours), len(set(colours)))
        for colour in colours:
            red, green, blue = (int(colour[i:i + 2], 16) for i in (1, 3, 5))
            self.assertLess(0.3 * red + 0.59 * green + 0.11 * blue, 150)

    def test_pictures_are_drawn(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            script = plots.line_plot(SERIES, "x (cells)", "y (ns)", log="xy")
            drawn = plots.draw(folder, "sample", script)
            self.assertEqual(shutil.which("gnuplot") is not None, drawn)
            self.assertIn(script, (folder / "sample.gp").read_text(encoding="utf-8"))
            for suffix, start in {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}.items():
                picture = folder / f"sample.{suffix}"
                self.assertEqual(drawn, picture.exists())
                if drawn:
                    self.assertTrue(picture.read_bytes().startswith(start))


if __name__ == "__main__":
    unittest.main()
