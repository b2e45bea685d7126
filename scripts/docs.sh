#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Doxygen and Graphviz where they are missing and builds the documentation site, build/docs/html/index.html. Safe to repeat.
# Warnings are errors: Doxygen 1.9.4 of Debian 12 gives none.
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
if [ -s build/docs/warnings.txt ]; then
  cat build/docs/warnings.txt >&2
  echo "docs: Doxygen $(doxygen --version) warns; links that lead nowhere are among such warnings" >&2
  exit 1
fi
echo "docs: $(find build/docs/html -name '*.html' | wc -l) pages, no warnings"
echo "docs: open build/docs/html/index.html"
