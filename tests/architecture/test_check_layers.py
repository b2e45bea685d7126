#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Plants every breach that check_layers.py knows, one at a time, and expects it to be reported."""

import tempfile
import unittest
from pathlib import Path

import check_layers

SPDX = "// SPDX-License-Identifier: LGPL-3.0-or-later\n"


class Planted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "project"
        self.cgal = Path(folder.name) / "cgal"
        self.header("kernel/sign.h")
        self.header("walk/walk.h", "#include <cellwalk/kernel/sign.h>\n#include <vector>\n")

    def header(self, name, body=""):
        guard = "CELLWALK_" + name.upper().replace("/", "_").replace(".", "_")
        self.write(f"include/cellwalk/{name}", f"{SPDX}#ifndef {guard}\n#define {guard}\n{body}#endif\n")

    def write(self, name, text, folder=None):
        path = (folder or self.root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def source(self, name, body):
        self.write(f"src/{name}", SPDX + body)

    def shared(self, name, body=""):
        guard = "CELLWALK_INTERNAL_" + name.upper().replace("/", "_").replace(".", "_")
        self.write(f"src/shared/cellwalk/internal/{name}", f"{SPDX}#ifndef {guard}\n#define {guard}\n{body}#endif\n")

    def private(self, name, body=""):
        guard = "CELLWALK_" + name.upper().replace("/", "_").replace(".", "_")
        self.source(name, f"#ifndef {guard}\n#define {guard}\n{body}#endif\n")

    def page(self, arrows, rows=""):
        drawn = "".join(f"  {a} --> {b}\n" for a, b in arrows)
        self.write("docs/architecture.md", f"```mermaid\nflowchart BT\n{drawn}```\n\n{rows}")

    def check(self):
        return check_layers.check(self.root, self.cgal)

    def assert_caught(self, *parts):
        breaches = self.check()
        self.assertEqual(len(breaches), 1, breaches)
        for part in parts:
            self.assertIn(part, breaches[0])

    def test_a_clean_tree_passes(self):
        self.source("walk/walk.cpp", "#include <cellwalk/walk/walk.h>\nint s = Exact::orientation(counts, a, b);\n")
        self.assertEqual(self.check(), [])

    def test_an_empty_tree_is_an_error(self):
        with self.assertRaises(ValueError):
            check_layers.check(self.root / "nowhere")

    def test_upward_include(self):
        self.source("kernel/sign.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assert_caught("src/kernel/sign.cpp:2", "layer kernel must not include", "layer walk")

    def test_upward_include_of_a_header_that_does_not_exist(self):
        self.source("kernel/sign.cpp", "#include <cellwalk/body/body.h>\n")
        self.assert_caught("layer kernel must not include", "layer body")

    def test_cgal_in_a_public_header(self):
        self.header("environment/map.h", "#include <CGAL/Linear_cell_complex.h>\n")
        self.header("walk/locate.h", "#include <CGAL/Bbox_3.h>\n")
        self.assert_caught("include/cellwalk/walk/locate.h:4", "CGAL/Bbox_3.h in a public header")

    def test_the_umbrellas_may_not_include_readers(self):
        for umbrella in ("cellwalk.h", "paper.h"):
            self.header(umbrella, "#include <cellwalk/io/mesh_file.h>\n")
            self.assert_caught(f"include/cellwalk/{umbrella}:4", "layer umbrella must not include", "layer io")
            self.header(umbrella, "#include <cellwalk/walk/walk.h>\n")
            self.assertEqual(self.check(), [])

    def test_the_umbrella_is_not_for_the_library(self):
        self.header("cellwalk.h", "#include <cellwalk/walk/walk.h>\n")
        self.source("walk/walk.cpp", "#include <cellwalk/cellwalk.h>\n")
        self.assert_caught("src/walk/walk.cpp:2", "layer walk must not include", "layer umbrella")

    def test_sideways_include_that_a_stack_would_allow(self):
        self.source("body/body.cpp", "#include <cellwalk/query/query.h>\n")
        self.assert_caught("src/body/body.cpp:2", "layer body must not include", "layer query")
        self.source("body/body.cpp", "#include <cellwalk/generators/grid.h>\n")
        self.assert_caught("layer body must not include", "layer generators")
        self.source("body/body.cpp", "")
        self.source("simulation/world.cpp", "#include <cellwalk/internal/io/csv.h>\n")
        self.assert_caught("layer simulation must not include", "layer io")

    def test_only_arrows_of_the_page_count_and_each_is_needed(self):
        self.page([("walk", "kernel")])
        self.assertEqual(self.check(), [])
        self.source("kernel/sign.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assert_caught("src/kernel/sign.cpp:2", "layer kernel must not include", "layer walk")
        self.source("kernel/sign.cpp", "")
        self.page([("walk", "kernel"), ("body", "walk")])
        self.assert_caught("docs/architecture.md:1", "the arrow from body to walk")

    def test_folders_of_a_layer(self):
        self.page([("walk", "kernel")], "| `walk/low` | a |  |\n| `walk/high` | b | `low` |\n")
        self.header("walk/walk.h", "#include <cellwalk/kernel/sign.h>\n")
        self.source("walk/walk.cpp", '#include "walk/high/high.h"\n')
        self.private("walk/low/low.h")
        self.private("walk/high/high.h", '#include "walk/low/low.h"\n')
        self.assertEqual(self.check(), [])
        self.source("walk/low/low.cpp", '#include "walk/high/high.h"\n')
        self.assert_caught("src/walk/low/low.cpp:2", "walk/low must not include walk/high/high.h")
        self.source("walk/low/low.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assert_caught("src/walk/low/low.cpp:2", "walk/low must not include")
        self.source("walk/low/low.cpp", "")
        self.source("walk/loft/loft.cpp", "")
        self.assert_caught("src/walk/loft/loft.cpp:1", "in no folder")

    def test_a_public_header_is_on_the_floor_of_its_source(self):
        self.page([("walk", "kernel")], "| `walk/low` | a |  |\n| `walk/high` | b | `low` |\n")
        self.source("walk/high/walk.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assertEqual(self.check(), [])
        self.source("walk/low/low.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assert_caught("src/walk/low/low.cpp:2", "of walk/high")

    def test_private_header_of_another_layer(self):
        self.private("walk/inner.h")
        self.source("body/body.cpp", '#include "walk/inner.h"\n')
        self.assert_caught("src/body/body.cpp:2", "walk/inner.h is layer walk's own")

    def test_users_see_public_headers_only(self):
        self.shared("walk/signs.h")
        self.write("examples/first.cpp", SPDX + "#include <cellwalk/internal/walk/signs.h>\n")
        self.assert_caught("examples/first.cpp:2", "is not for users")
        self.write("examples/first.cpp", SPDX + "#include <cellwalk/walk/walk.h>\n")
        self.write("python/bindings/module.cpp", SPDX + "#include <cellwalk/internal/walk/signs.h>\n")
        self.assertEqual(self.check(), [])

    def test_experiments_see_nothing_private_and_few_the_oracles(self):
        self.private("walk/inner.h")
        self.shared("walk/signs.h")
        self.write("tests/oracle/oracle.h", SPDX)
        self.write("experiments/figures/a.cpp", SPDX + "#include <cellwalk/internal/walk/signs.h>\n")
        self.write("experiments/02_exact_versus_float/a.cpp", SPDX + '#include "oracle/oracle.h"\n')
        self.assertEqual(self.check(), [])
        self.write("experiments/figures/a.cpp", SPDX + '#include "walk/inner.h"\n')
        self.assert_caught("experiments/figures/a.cpp:2", "layer walk's own")
        self.write("experiments/figures/a.cpp", SPDX + '#include "oracle/oracle.h"\n')
        self.assert_caught("experiments/figures/a.cpp:2", "is of the tests")

    def test_tests_of_a_layer_stand_where_it_stands(self):
        self.private("walk/inner.h")
        self.header("body/body.h")
        self.write("tests/walk/test_walk.cpp", SPDX + '#include <cellwalk/walk/walk.h>\n#include "walk/inner.h"\n')
        self.assertEqual(self.check(), [])
        self.write("tests/walk/test_walk.cpp", SPDX + "#include <cellwalk/body/body.h>\n")
        self.assert_caught("tests/walk/test_walk.cpp:2", "tests of walk must not include", "layer body")
        self.write("tests/walk/test_walk.cpp", SPDX)
        self.write("tests/body/test_body.cpp", SPDX + '#include "walk/inner.h"\n')
        self.assert_caught("tests/body/test_body.cpp:2", "layer walk's own")
        self.write("tests/body/test_body.cpp", SPDX)
        self.write("tests/body/worlds.h", SPDX)
        self.write("tests/walk/test_walk.cpp", SPDX + '#include "body/worlds.h"\n')
        self.assert_caught("tests/walk/test_walk.cpp:2", "tests of walk must not include body/worlds.h")

    def test_internal_headers_are_installed_where_public_ones_need_them(self):
        self.shared("kernel/exact.h")
        self.shared("kernel/deep.h")
        self.write("cmake/CellwalkInstall.cmake", "# SPDX-License-Identifier: LGPL-3.0-or-later\nset(installed_internals)\n")
        self.assertEqual(self.check(), [])
        self.header("walk/walk.h", "#include <cellwalk/internal/kernel/exact.h>\n")
        self.shared("kernel/exact.h", "#include <cellwalk/internal/kernel/deep.h>\n")
        listed = "# SPDX-License-Identifier: LGPL-3.0-or-later\nset(installed_internals\n  kernel/exact.h"
        self.write("cmake/CellwalkInstall.cmake", f"{listed})\n")
        self.assert_caught("kernel/deep.h is missing in installed_internals")
        self.write("cmake/CellwalkInstall.cmake", f"{listed}\n  kernel/deep.h\n  kernel/odd.h)\n")
        self.assert_caught("kernel/odd.h is one too many")

    def test_upward_include_by_a_relative_path(self):
        self.private("walk/inner.h")
        self.source("kernel/sign.cpp", '#include "../walk/inner.h"\n')
        self.assert_caught("src/kernel/sign.cpp:2", "layer walk")

    def test_sideways_includes(self):
        self.source("meshing/tet.cpp", "#include <cellwalk/io/read.h>\n")
        self.assert_caught("layer meshing must not include", "layer io")
        self.source("meshing/tet.cpp", "")
        self.source("io/read.cpp", "#include <cellwalk/walk/walk.h>\n")
        self.assert_caught("layer io must not include", "layer walk")

    def test_include_cycle_within_a_layer(self):
        self.header("walk/a.h", "#include <cellwalk/walk/b.h>\n")
        self.header("walk/b.h", "#include <cellwalk/walk/a.h>\n")
        self.assert_caught("include cycle: include/cellwalk/walk/a.h -> include/cellwalk/walk/b.h")

    def test_unknown_layer(self):
        self.source("misc/a.cpp", "int a;\n")
        self.assert_caught("src/misc/a.cpp:1", "no known layer")

    def test_gpl_header_by_name(self):
        for header in ("AABB_tree.h", "Mesh_3/C3T3_helpers.h", "Polygon_mesh_processing/repair.h",
                       "Triangulation_3.h", "Delaunay_triangulation_2.h", "box_intersection_d.h"):
            self.source("walk/walk.cpp", f"#include <CGAL/{header}>\n")
            self.assert_caught("src/walk/walk.cpp:2", header, "is GPL")

    def test_gpl_header_by_its_licence(self):
        self.write("CGAL/new_package.h", "// SPDX-License-Identifier: GPL-3.0-or-later\n", self.cgal)
        self.write("CGAL/kernel.h", "// SPDX-License-Identifier: LGPL-3.0-or-later\n", self.cgal)
        self.source("walk/walk.cpp", "#include <CGAL/kernel.h>\n#include <CGAL/new_package.h>\n")
        self.assert_caught("src/walk/walk.cpp:3", "CGAL/new_package.h is GPL")

    def test_gpl_header_in_meshing_is_fine(self):
        self.source("meshing/tet.cpp", "#include <CGAL/Mesh_3/C3T3_helpers.h>\n#include <tetgen.h>\n")
        self.assertEqual(self.check(), [])

    def test_predicate_outside_the_kernel(self):
        for call in ("CGAL::orientation(a, b, c)", "orientation(a, b, c)", "kernel.orientation_3_object()(a, b, c, d)",
                     "CGAL::coplanar(a, b, c, d)"):
            self.source("walk/walk.cpp", f"int s = {call};\n")
            self.assert_caught("src/walk/walk.cpp:2", "signs are asked of a kernel policy")

    def test_predicate_in_the_kernel_a_comment_or_a_string_is_fine(self):
        self.source("kernel/sign.cpp", "int s = CGAL::orientation(a, b, c);\n")
        self.source("walk/walk.cpp", '// orientation(a, b)\n/* CGAL::orientation(a,\nb) */ auto t = "orientation(";\n')
        self.assertEqual(self.check(), [])

    def test_wrong_include_guard(self):
        self.write("include/cellwalk/walk/walk.h", SPDX + "#ifndef WALK_H\n#define WALK_H\n#endif\n")
        self.assert_caught("must be CELLWALK_WALK_WALK_H")

    def test_long_file(self):
        self.write("experiments/long.cpp", SPDX + "int a;\n" * check_layers.MAX_LINES)
        self.assert_caught("experiments/long.cpp:401", "has 401 lines")

    def test_wide_line(self):
        widest = "// " + "x" * (check_layers.MAX_COLUMNS - 3)
        self.write("tests/walk/wide.cpp", f"{SPDX}{widest}\n{widest}x\n")
        self.assert_caught("tests/walk/wide.cpp:3", f"has {check_layers.MAX_COLUMNS + 1} columns")

    def test_words_that_were_given_up(self):
        for word in check_layers.GIVEN_UP:
            self.write("tests/walk/words.cpp", f"{SPDX}// {word}: again\n// {word}s and un{word} are other words\n")
            self.assert_caught("tests/walk/words.cpp:2", f"{word} was given up")
            self.write("tests/walk/words.cpp", f"{SPDX}// {word}s and un{word} are other words\n")
            self.assertEqual(self.check(), [])

    def test_what_clang_cannot_compile(self):
        for call in ("std::ranges::unique(v)", "std::ranges::stable_partition(v, f)", "v | std::views::reverse"):
            self.write("tests/walk/order.cpp", f"{SPDX}auto r = {call};\nauto i = std::ranges::find(v, 1);\n")
            self.assert_caught("tests/walk/order.cpp:2", "clang 14 cannot compile")

    def test_missing_licence_line(self):
        self.write("scripts/run.sh", "#!/bin/sh\necho\n")
        self.assert_caught("scripts/run.sh:1", "SPDX")


if __name__ == "__main__":
    unittest.main()
