#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Doxygen and Graphviz where they are missing and builds the documentation site, build/docs/html/index.html. Safe to repeat.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --for docs

mkdir -p build/docs
echo "docs: building build/docs/html"
doxygen docs/Doxyfile
if [ ! -s build/docs/html/index.html ]; then
  echo "docs: there is no page; see build/docs/warnings.txt" >&2
  exit 1
fi
echo "docs: $(find build/docs/html -name '*.html' | wc -l) pages, $(wc -l <build/docs/warnings.txt) lines of warnings (build/docs/warnings.txt)"
echo "docs: open build/docs/html/index.html"
