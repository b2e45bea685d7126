#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
# Installs Doxygen and Graphviz where they are missing and builds the documentation site, build/docs/html/index.html. Safe to repeat.
# Warnings are errors: Doxygen 1.9.4 of Debian 12 gives none.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --for docs

mkdir -p build/docs
rm -rf build/docs/html  # with the pictures that were copied there, Doxygen would find some twice
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
# What pages lead to, beside pages (docs/page_filter.py).
grep -oh 'href="files/[^"]*"' build/docs/html/*.html | sort -u | sed 's/^href="files\///; s/"$//' | while read -r file; do
  mkdir -p "build/docs/html/files/$(dirname "$file")"
  cp "${file%.txt}" "build/docs/html/files/$file"
done
links=$(scripts/check_links.py build/docs/html)
echo "docs: no warnings; $links"
echo "docs: open build/docs/html/index.html"
