#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the rules of docs/architecture.md on the sources: layers, licences, predicates, form. Prints one line per breach.

usage: check_layers.py ROOT [CGAL_INCLUDE_DIR]
"""

import re
import sys
from pathlib import Path

# The headers for users and for those who repeat the paper, which no file of the library includes. They include the core, and what a first
# program needs besides.
UMBRELLAS = {Path("include/cellwalk/cellwalk.h"), Path("include/cellwalk/paper.h")}
CORE = ["kernel", "records", "generators", "environment", "walk", "edge", "query", "body", "reshape"]
# Headers that layers share and users do not see: <cellwalk/internal/LAYER/...>.
SHARED = Path("src/shared")
PAGE = Path("docs/architecture.md")
HERE = Path(__file__).resolve().parents[2]
INSTALL = Path("cmake/CellwalkInstall.cmake")

# Headers whose floor neither a source of that name nor their own name tells.
HEADER_FLOORS = {"edge/swept_triangle.h": "exact", "edge/sweep_along.h": "sweep", "environment/planes.h": "snapshot",
                 "environment/flat_array.h": "snapshot", "environment/facet_table.h": "soup", "reshape/move.h": "residents",
                 "environment/build_map.h": "map", "environment/cell_list.h": "snapshot", "environment/cell_check.h": "certify",
                 "meshing/mesher_limits.h": "child",
                 "io/build_features.h": "mesh", "io/parse_surface.h": "mesh", "io/planar_file.h": "mesh"}

# Public headers that include CGAL, which costs whoever includes them seconds. docs/embedding.md names them.
CGAL_HEADERS = {Path("include/cellwalk/environment/map.h")}
# The layer that walks on maps of others takes the predicates of their kernels, and includes CGAL.
ON_MAPS = "lcc"

# What tests of a layer include besides what the layer itself may: worlds to test in, and readers of public data.
TEST_WORLDS = {"generators": {"environment"}, "environment": {"generators"}, "walk": {"generators", "io", "meshing"},
               "lcc": {"kernel", "records", "generators", "environment", "walk", "edge"},
               "edge": {"generators", "io"}, "query": {"generators"}, "body": {"generators"}, "reshape": {"generators"},
               "simulation": {"io", "meshing"},
               "meshing": {"environment"}, "drawing": {"io", "generators"}}
# Folders of tests that are of no one layer.
OVERALL_TESTS = {"cli", "consumer", "fuzz", "viewer"}
# Experiments whose results are judged by the oracles of tests, and where those are.
JUDGED = {"02_exact_versus_float", "05_degenerate_worlds", "07_moving_walls", "13_endurance", "degenerate_corpus"}
JUDGES = {"oracle", "kernel", "walk", "edge", "reshape"}

GPL_LAYERS = {"meshing"}
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
# Names that were given up, and those in use. CHANGELOG.md may say what was.
GIVEN_UP = {"Wall_contact": "Contact", "rounded_time": "Contact::time", "Contact_policy": "Step_rule", "Edge_rule": "Step_rule",
            "Change_result": "Outcome", "peel": "split_vertex", "mean_of": "centroid", "Told": "State_request", "Stand_in": "Remote_body",
            "elsewhere_": "remote_bodies_", "hindrance": "severity, why_not_shared", "find_out_if_apart": "update_is_apart",
            "Way_within": "Path_within_cells", "any_way": "any_path", "Pointed": "With_points", "Attentive_wait": "Interruptible_wait",
            "Swept_hit": "Collision", "Star_block": "Collision", "Cells_of_vertex": "Followed_vertex", "Followed_end": "Followed_vertex"}
GIVEN_UP_WORD = re.compile(r"(?<!\w)(" + "|".join(GIVEN_UP) + r")(?!\w)")
# What makes a std::ranges::subrange, which clang 14 cannot compile with GCC's library.
SUBRANGE = re.compile(
    r"std::ranges::(subrange|unique|equal_range|search(_n)?|find_(end|last\w*)|(stable_)?partition|remove(_if)?|rotate|shift_(left|right))\b"
    r"|std::(ranges::)?views\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)

MAX_LINES = 400
# clang-format breaks neither comments nor literals.
MAX_COLUMNS = int(re.search(r"^ColumnLimit: (\d+)$", (HERE / ".clang-format").read_text(encoding="utf-8"), re.MULTILINE)[1])
SOURCES = {".h", ".cpp"}
FORM_FOLDERS = ["include", "src", "tests", "experiments", "examples", "python", "scripts", "cmake"]
FORM_SUFFIXES = SOURCES | {".py", ".pyi", ".sh", ".cmake", ".txt"}


class Plan:
    """What docs/architecture.md draws: which layer stands on which, and which folder of a layer on which."""

    def __init__(self, root):
        own = root / PAGE
        text = (own if own.is_file() else HERE / PAGE).read_text(encoding="utf-8")
        self.is_own = own.is_file()
        drawing = re.search(r"```mermaid\n(.*?)```", text, re.DOTALL)[1]
        self.arrows = set(re.findall(r"^ *(\w+) --> (\w+)$", drawing, re.MULTILINE))
        self.layers = {layer: self.reached(layer) for layer in {layer for arrow in self.arrows for layer in arrow}}
        self.layers["umbrella"] = {*CORE, "drawing", "loading"}
        self.floors = {}
        for layer, floor, below in re.findall(r"^\| `(\w+)/(\w+)` \|.*\|([^|]*)\|$", text, re.MULTILINE):
            self.floors.setdefault(layer, {})[floor] = set(re.findall(r"`(\w+)`", below))

    def reached(self, layer):
        """All layers that arrows lead to."""
        found, queue = set(), [layer]
        while queue:
            below = {b for a, b in self.arrows if a == queue[-1]} - found
            queue.pop()
            found |= below
            queue += below
        return found


def without_comments_and_strings(text):
    return COMMENT_OR_STRING.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def layer_of(path, root):
    """The layer of a file of include/cellwalk or src, None for files outside layers (build files)."""
    name = path.relative_to(root)
    if name in UMBRELLAS:
        return "umbrella"
    start = 4 if is_internal(name) else 2 if name.parts[0] == "include" else 1
    return name.parts[start] if len(name.parts) > start + 1 else None


def is_internal(name):
    return name.is_relative_to(SHARED)


def is_private(name):
    return name.parts[0] == "src" and not is_internal(name)


def floor_of(name, layer, floors, sources):
    """The folder of its layer that a file belongs to, "" for the top one, or None."""
    if is_private(name):
        return "/".join(name.parts[2:-1])
    declared = HEADER_FLOORS.get(f"{layer}/{name.name}")
    if declared is not None:
        return declared
    return sources.get((layer, name.stem), name.stem if name.stem in floors else None)


def is_gpl(header, cgal):
    if GPL_HEADERS.match(header):
        return True
    installed = cgal / header
    if not header.startswith("CGAL/") or not installed.is_file():
        return False
    return GPL_SPDX.search(installed.read_text(encoding="utf-8", errors="replace")[:4000]) is not None


def check_file(path, root, cgal, plan, sources):
    """Yields breaches of one source file of the library."""
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    layer = layer_of(path, root)
    if layer not in plan.layers:
        yield f"{name}:1: is in no known layer: move it, or draw its folder in {PAGE}"
        return
    floors = plan.floors.get(layer, {})
    floor = floor_of(name, layer, floors, sources)
    if floors and floor != "" and floor not in floors:
        yield f"{name}:1: is in no folder that {PAGE} tells of: move it, or name it after its source"
    for match in INCLUDE.finditer(text):
        where = f"{name}:{line_of(text, match.start(2))}"
        header = match.group(2)
        target = target_layer(match.group(1), header, path, root)
        resolved = resolve(match.group(1), header, path, root)
        if target is not None and target != layer and target not in plan.layers[layer]:
            yield f"{where}: layer {layer} must not include {header} (layer {target})"
        elif resolved is not None and target != layer and is_private(resolved.relative_to(root)):
            yield f"{where}: {header} is layer {target}'s own: what layers share is in {SHARED}"
        elif resolved is not None and target == layer and floors and floor in floors:
            below = floor_of(resolved.relative_to(root), layer, floors, sources)
            if below is not None and below != floor and below not in floors[floor]:
                yield f"{where}: {layer}/{floor} must not include {header} (of {layer}/{below})"
        if layer not in GPL_LAYERS and is_gpl(header, cgal):
            yield f"{where}: {header} is GPL: only meshing may include it"
        elif header.startswith("CGAL/") and name.parts[0] == "include" and name not in CGAL_HEADERS and layer != ON_MAPS:
            yield f"{where}: {header} in a public header: include it in sources, or declare the header in check_layers.py"
    if layer not in {"kernel", ON_MAPS}:
        code = without_comments_and_strings(text)
        for match in PREDICATE.finditer(code):
            yield (f"{name}:{line_of(code, match.start())}: {match.group().strip('( ')}: "
                   "signs are asked of a kernel policy, as Exact::orientation(counts, ...)")
    if path.suffix == ".h":
        inner = name.parts[3:] if is_internal(name) else name.parts[2:] if name.parts[0] == "include" else name.parts[1:]
        guard = "CELLWALK_" + re.sub(r"\W", "_", "/".join(inner)).upper()
        if f"#ifndef {guard}\n#define {guard}\n" not in text:
            yield f"{name}:1: the include guard must be {guard}"


def check_user(path, root, plan):
    """Yields breaches of a file outside the library: examples, the Python module, experiments, tests."""
    name = path.relative_to(root)
    top, folder = name.parts[0], name.parts[1]
    reach = plan.layers.get(folder, set()) | {folder} | TEST_WORLDS.get(folder, set())
    for match in INCLUDE.finditer(text := path.read_text(encoding="utf-8")):
        header = match.group(2)
        resolved = resolve(match.group(1), header, path, root)
        if resolved is None:
            continue
        where = f"{name}:{line_of(text, match.start(2))}"
        target = resolved.relative_to(root)
        if target.parts[0] in ("tests", "experiments", "python"):
            if target.parts[0] != "tests":
                continue
            if top == "experiments" and not (folder in JUDGED and target.parts[1] in JUDGES):
                yield f"{where}: {header} is of the tests: only {', '.join(sorted(JUDGED))} are judged by their oracles"
            elif top == "tests" and target.parts[1] not in reach | {"oracle"} and folder not in OVERALL_TESTS:
                yield f"{where}: tests of {folder} must not include {header}"
            continue
        layer = layer_of(resolved, root)
        if top == "examples" and target.parts[0] != "include":
            yield f"{where}: {header} is not for users"
        elif is_private(target) and not (top == "tests" and folder in OVERALL_TESTS | {layer}):
            yield f"{where}: {header} is layer {layer}'s own: what others need is in {SHARED}"
        elif top == "tests" and folder in plan.layers and folder not in OVERALL_TESTS and layer not in reach:
            yield f"{where}: tests of {folder} must not include {header} (layer {layer})"


def target_layer(bracket, header, path, root):
    """The layer a header belongs to, None if it is not the project's."""
    resolved = resolve(bracket, header, path, root)
    if resolved is not None:
        return layer_of(resolved, root)
    if header.startswith("cellwalk/"):
        parts = header.split("/")
        return parts[2 if parts[1] == "internal" else 1] if len(parts) > 2 else None
    return None


def resolve(bracket, header, path, root):
    candidates = [path.parent / header] if bracket == '"' else []
    if path.relative_to(root).parts[0] in ("tests", "experiments"):
        candidates.append(root / "tests" / header)
    candidates += [root / "include" / header, root / SHARED / header, root / "src" / header]
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
            if path.suffix not in SOURCES:
                continue
            for number, line in enumerate(lines, 1):
                if found := GIVEN_UP_WORD.search(line):
                    yield f"{name}:{number}: {found[0]} was given up: say {GIVEN_UP[found[0]]}"
                if found := SUBRANGE.search(line):
                    yield f"{name}:{number}: clang 14 cannot compile {found[0]}: take the function of std, or a bound"
                if len(line) > MAX_COLUMNS:
                    yield f"{name}:{number}: has {len(line)} columns, more than the {MAX_COLUMNS} of .clang-format: break it"


def check_installed(root, graph):
    """Installed with the public headers are those internal ones that they include, directly or not, and no others."""
    needed, queue = set(), [f for f in graph if f.startswith("include/")]
    while queue:
        new = {f for f in graph.get(queue.pop(), ()) if f.startswith(str(SHARED))} - needed
        needed |= new
        queue += new
    needed = {"/".join(Path(f).parts[4:]) for f in needed}
    rules = root / INSTALL
    listed = re.search(r"set\(installed_internals([^)]*)\)", rules.read_text(encoding="utf-8")) if rules.is_file() else None
    found = set(listed[1].split()) if listed else set()
    for header in sorted(needed - found):
        yield f"{INSTALL}:1: {header} is missing in installed_internals: a public header includes it"
    for header in sorted(found - needed):
        yield f"{INSTALL}:1: {header} is one too many in installed_internals: no public header includes it"


def check_arrows(root, plan, files):
    """Arrows that no include needs are not drawn."""
    used = set()
    for path in files:
        layer = layer_of(path, root)
        for match in INCLUDE.finditer(path.read_text(encoding="utf-8")):
            used.add((layer, target_layer(match.group(1), match.group(2), path, root)))
    for a, b in sorted(plan.arrows - used):
        yield f"{PAGE}:1: the arrow from {a} to {b} is drawn, and nothing in {a} includes anything of {b}"


def check(root, cgal="/usr/include"):
    """All breaches, as lines FILE:LINE: message; raises ValueError if there is nothing to check."""
    root = Path(root).resolve()
    files = [p for folder in ("include/cellwalk", "src") for p in sorted((root / folder).rglob("*"))
             if p.suffix in SOURCES]
    if not files:
        raise ValueError(f"no sources under {root}")
    plan = Plan(root)
    sources = {(p.relative_to(root).parts[1], p.stem): "/".join(p.relative_to(root).parts[2:-1])
               for p in files if p.suffix == ".cpp" and is_private(p.relative_to(root))}
    breaches = []
    graph = {}
    for path in files:
        breaches += check_file(path, root, Path(cgal), plan, sources)
        includes = INCLUDE.findall(path.read_text(encoding="utf-8"))
        targets = {resolve(bracket, header, path, root) for bracket, header in includes}
        graph[str(path.relative_to(root))] = {str(t.relative_to(root)) for t in targets if t is not None}
    for folder in ("examples", "python", "experiments", "tests"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SOURCES:
                breaches += check_user(path, root, plan)
    cycle = find_cycle(graph)
    if cycle:
        breaches.append(f"{cycle[0]}:1: include cycle: " + " -> ".join(cycle))
    breaches += check_installed(root, graph)
    if plan.is_own:
        breaches += check_arrows(root, plan, files)
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
