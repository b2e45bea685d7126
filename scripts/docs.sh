#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Doxygen and Graphviz where they are missing and builds the documentation site, build/docs/html/index.html. Safe to repeat.
# Warnings are errors: Doxygen 1.9.4 of Debian 12 gives none. So are links that lead nowhere.
#
# A page of the site replays a run: that of data/aorta.json by build/release/cellwalk or build/demo/cellwalk. If neither is built, with meshing and
# viewer, the site has no such page. Where Chromium and the viewer's packages are there, too, the site is tried out in it (tests/docs/test_site.mjs).
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --for docs

mkdir -p build/docs
rm -rf build/docs/live build/docs/run
for built in build/release build/demo; do
  parts=$("$built/cellwalk" --version 2>/dev/null || true)
  if grep -q "^  tetgen   yes" <<<"$parts" && grep -q "^  viewer   yes" <<<"$parts"; then
    echo "docs: $built/cellwalk run data/aorta.json, for the page that replays it"
    mkdir -p build/docs/live
    "$built/cellwalk" run data/aorta.json -o build/docs/run --set output.picture=false --set output.frame_every=0 --set output.motion_every=2 >/dev/null
    "$built/cellwalk" view build/docs/run -o build/docs/live/aorta.html >/dev/null
    break
  fi
done
rm -rf build/docs/html  # with the pictures that were copied there, Doxygen would find some twice
echo "docs: building build/docs/html"
# The tree has the pages in the order of docs/README.md, tutorials first.
pages=$(grep -o '](\([^)#:]*\.md\))' docs/README.md | sed 's/^](/docs\//; s/)$//' | xargs realpath --relative-to=. | tr '\n' ' ')
(cat docs/Doxyfile && echo "INPUT = README.md $pages docs experiments paper/README.md CONTRIBUTING.md CHANGELOG.md include/cellwalk") | doxygen -
if [ ! -s build/docs/html/index.html ]; then
  echo "docs: there is no page; see build/docs/warnings.txt" >&2
  exit 1
fi
if [ -s build/docs/warnings.txt ]; then
  cat build/docs/warnings.txt >&2
  echo "docs: Doxygen $(doxygen --version) warns; links that lead nowhere are among such warnings" >&2
  exit 1
fi
# What pages lead to, beside pages (docs/page_filter.py).
grep -oh 'href="files/[^"]*"' build/docs/html/*.html | sort -u | sed 's/^href="files\///; s/"$//' | while read -r file; do
  mkdir -p "build/docs/html/files/$(dirname "$file")"
  cp "${file%.txt}" "build/docs/html/files/$file"
done
if [ -d build/docs/live ]; then cp -r build/docs/live build/docs/html/; fi
found=$(scripts/index_pages.py build/docs/html)
links=$(scripts/check_links.py build/docs/html)
echo "docs: no warnings; $found; $links"
modules=$(find build/release/viewer build/demo/viewer -maxdepth 1 -name node_modules 2>/dev/null | head -1 || true)
if [ -n "$modules" ] && command -v node chromium >/dev/null; then
  VIEWER_MODULES=$PWD/$modules node --test tests/docs/test_site.mjs >build/docs/tried.txt || { cat build/docs/tried.txt >&2; exit 1; }
  echo "docs: tried in Chromium: $(sed -n 's/^# pass /passed /p' build/docs/tried.txt) of $(sed -n 's/^# tests //p' build/docs/tried.txt)"
fi
echo "docs: open build/docs/html/index.html"
