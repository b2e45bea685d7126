#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Plants excerpts that differ from their files, and expects them to be reported."""

import tempfile
import unittest
from pathlib import Path

import check_excerpts

PAGE = "Text.\n\n<!-- excerpt code.cpp part -->\n```cpp\nint a;\nif (a) b();\n```\nMore.\n"
CODE = "// SPDX-License-Identifier: X\n  //! [part]\n  int a;\n  //! [inner]\n  if (a) b();\n  //! [inner]\n  //! [part]\nint c;\n"


class Planted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "docs").mkdir()
        self.page, self.code = self.root / "docs" / "page.md", self.root / "code.cpp"
        (self.root / "README.md").write_text("Nothing.\n", encoding="utf-8")
        self.page.write_text(PAGE, encoding="utf-8")
        self.code.write_text(CODE, encoding="utf-8")

    def assert_caught(self, part):
        _, breaches = check_excerpts.check(self.root)
        self.assertEqual(len(breaches), 1, breaches)
        self.assertIn("docs/page.md", breaches[0])
        self.assertIn(part, breaches[0])

    def test_equal_excerpts_pass(self):
        self.assertEqual(check_excerpts.check(self.root), (1, []))

    def test_drift_is_caught_and_mended(self):
        self.code.write_text(CODE.replace("int a;", "int a = 1;"), encoding="utf-8")
        self.assert_caught("is not what code.cpp holds")
        check_excerpts.check(self.root, fix=True)
        self.assertEqual(check_excerpts.check(self.root), (1, []))
        self.assertIn("int a = 1;\nif (a) b();\n```\nMore.\n", self.page.read_text(encoding="utf-8"))

    def test_pages_of_subfolders_are_checked(self):
        (self.root / "docs" / "more").mkdir()
        self.page.rename(self.root / "docs" / "more" / "page.md")
        self.code.write_text(CODE.replace("int a;", "int a = 1;"), encoding="utf-8")
        _, breaches = check_excerpts.check(self.root)
        self.assertEqual(len(breaches), 1, breaches)

    def test_a_missing_mark_is_caught(self):
        self.code.write_text(CODE.replace("//! [part]\nint c", "int c"), encoding="utf-8")
        self.assert_caught("1 marks [part]")

    def test_a_missing_file_is_caught(self):
        self.code.unlink()
        self.assert_caught("code.cpp")

    def test_an_excerpt_without_code_is_caught(self):
        self.page.write_text(PAGE.replace("```cpp\nint a;\nif (a) b();\n```\n", ""), encoding="utf-8")
        self.assert_caught("not followed by a block")


if __name__ == "__main__":
    unittest.main()
