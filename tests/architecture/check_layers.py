#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the rules of docs/architecture.md on the sources: layers, licences, predicates, form. Prints one line per breach.

usage: check_layers.py ROOT [CGAL_INCLUDE_DIR]
"""

import re
import sys
from pathlib import Path

# What each layer may include besides itself; nothing else, so no include points upward or sideways.
_STACK = ["kernel", "records", "environment", "walk", "edge", "query", "body", "simulation"]
LAYERS = {layer: set(_STACK[:i]) for i, layer in enumerate(_STACK)}
LAYERS["io"] = {"kernel", "records"}
LAYERS["meshing"] = {"kernel", "records"}
LAYERS["loading"] = {"kernel", "records", "environment", "io", "meshing"}
LAYERS["cli"] = set(LAYERS)
# The one header for users, which no file of the library includes.
UMBRELLA = Path("include/cellwalk/cellwalk.h")
LAYERS["umbrella"] = set(_STACK)

# Public headers that include CGAL, which costs whoever includes them seconds. docs/embedding.md names these and what includes them.
CGAL_HEADERS = {Path("include/cellwalk/environment/map.h"), Path("include/cellwalk/kernel/exact_value.h")}

# Gmsh is GPL too: io is LGPL only when it is built without it.
GPL_LAYERS = {"meshing"}
GPL_EXCEPTIONS = {"io": {"gmsh.h"}}
# GPL whatever the installed files say. Other headers of CGAL are judged by their own SPDX line, and those that are
# included indirectly by the compiler (CGAL_LICENSE_ERROR in cmake/CellwalkLayer.cmake).
GPL_HEADERS = re.compile(
    r"CGAL/(AABB_|Alpha_|Boolean_set|Constrained_|Delaunay_|Kd_tree|Mesh_|Nef_|Polygon_mesh_processing|Polyhedron_3"
    r"|Regular_triangulation|Search_|Surface_mesh|Triangulation_[23\w]|box_intersection_d|convex_|make_mesh_3)"
    r"|tetgen\.h|gmsh\.h")
GPL_SPDX = re.compile(r"SPDX-License-Identifier:\s*A?GPL")
PREDICATE = re.compile(
    r"CGAL::(orientation|coplanar|collinear|coplanar_orientation|left_turn|right_turn|side_of_\w+|do_intersect)\b"
    r"|\borientation_[23]_object\b"
    r"|(?<![\w:])orientation\s*\(")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)

MAX_LINES = 400
SOURCES = {".h", ".cpp"}
FORM_FOLDERS = ["include", "src", "tests", "experiments", "examples", "python", "scripts", "cmake"]
FORM_SUFFIXES = SOURCES | {".py", ".pyi", ".sh", ".cmake", ".txt"}


def without_comments_and_strings(text):
    return COMMENT_OR_STRING.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def layer_of(path, root):
    """The layer of a file of include/cellwalk or src, None for files outside layers (build files)."""
    if path.relative_to(root) == UMBRELLA:
        return "umbrella"
    parts = path.relative_to(root).parts
    start = 2 if parts[0] == "include" else 1
    return parts[start] if len(parts) > start + 1 else None


def is_gpl(header, cgal):
    if GPL_HEADERS.match(header):
        return True
    installed = cgal / header
    if not header.startswith("CGAL/") or not installed.is_file():
        return False
    return GPL_SPDX.search(installed.read_text(encoding="utf-8", errors="replace")[:4000]) is not None


def check_file(path, root, cgal):
    """Yields breaches of one source file, and appends its project includes to the graph."""
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    layer = layer_of(path, root)
    if layer not in LAYERS:
        yield f"{name}:1: is in no known layer: move it, or declare its folder in check_layers.py"
        return
    for match in INCLUDE.finditer(text):
        where = f"{name}:{line_of(text, match.start(2))}"
        header = match.group(2)
        target = target_layer(match.group(1), header, path, root)
        if target is not None and target != layer and target not in LAYERS[layer]:
            yield f"{where}: layer {layer} must not include {header} (layer {target})"
        if layer not in GPL_LAYERS and header not in GPL_EXCEPTIONS.get(layer, ()) and is_gpl(header, cgal):
            yield f"{where}: {header} is GPL: only meshing may include it"
        elif header.startswith("CGAL/") and name.parts[0] == "include" and name not in CGAL_HEADERS:
            yield f"{where}: {header} in a public header: include it in sources, or declare the header in check_layers.py"
    if layer != "kernel":
        code = without_comments_and_strings(text)
        for match in PREDICATE.finditer(code):
            yield (f"{name}:{line_of(code, match.start())}: {match.group().strip('( ')}: "
                   "signs are asked of a kernel policy, as Exact::orientation(counts, ...)")
    if path.suffix == ".h":
        inner = name.parts[2:] if name.parts[0] == "include" else name.parts[1:]
        guard = "CELLWALK_" + re.sub(r"\W", "_", "/".join(inner)).upper()
        if f"#ifndef {guard}\n#define {guard}\n" not in text:
            yield f"{name}:1: the include guard must be {guard}"


def target_layer(bracket, header, path, root):
    """The layer a header belongs to, None if it is not the project's."""
    resolved = resolve(bracket, header, path, root)
    if resolved is not None:
        return layer_of(resolved, root)
    if header.startswith("cellwalk/"):
        parts = header.split("/")
        return parts[1] if len(parts) > 2 else None
    return None


def resolve(bracket, header, path, root):
    candidates = [path.parent / header] if bracket == '"' else []
    candidates += [root / "include" / header, root / "src" / header]
    for candidate in candidates:
        candidate = candidate.resolve()
        if candidate.is_file() and root in candidate.parents:
            return candidate
    return None


def find_cycle(graph):
    """One cycle of the include graph as a list of files, or None."""
    state = {}

    def visit(node, trail):
        state[node] = "open"
        for successor in sorted(graph.get(node, ())):
            if state.get(successor) == "open":
                return trail[trail.index(successor):] + [successor]
            if successor not in state:
                cycle = visit(successor, trail + [successor])
                if cycle:
                    return cycle
        state[node] = "done"
        return None

    for node in sorted(graph):
        if node not in state:
            cycle = visit(node, [node])
            if cycle:
                return cycle
    return None


def check_form(root):
    for folder in FORM_FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if not path.is_file() or path.suffix not in FORM_SUFFIXES:
                continue
            lines = path.read_text(encoding="utf-8").splitlines()
            name = path.relative_to(root)
            if len(lines) > MAX_LINES:
                yield f"{name}:{MAX_LINES + 1}: has {len(lines)} lines: name its parts and split it"
            if not any("SPDX-License-Identifier: " in line for line in lines[:2]):
                yield f"{name}:1: lacks its SPDX-License-Identifier"


def check(root, cgal="/usr/include"):
    """All breaches, as lines FILE:LINE: message; raises ValueError if there is nothing to check."""
    root = Path(root).resolve()
    files = [p for folder in ("include/cellwalk", "src") for p in sorted((root / folder).rglob("*"))
             if p.suffix in SOURCES]
    if not files:
        raise ValueError(f"no sources under {root}")
    breaches = []
    graph = {}
    for path in files:
        breaches += check_file(path, root, Path(cgal))
        includes = INCLUDE.findall(path.read_text(encoding="utf-8"))
        targets = {resolve(bracket, header, path, root) for bracket, header in includes}
        graph[str(path.relative_to(root))] = {str(t.relative_to(root)) for t in targets if t is not None}
    cycle = find_cycle(graph)
    if cycle:
        breaches.append(f"{cycle[0]}:1: include cycle: " + " -> ".join(cycle))
    return breaches + list(check_form(root))


def main():
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    breaches = check(*sys.argv[1:])
    print("\n".join(breaches))
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
