// SPDX-License-Identifier: LGPL-3.0-or-later
// Makes one page of index.html, the modules and the styles, as a C++ source that holds it.
//
//   node build.mjs OUT.cpp      VIEWER_MODULES: where the packages are (default: node_modules beside this file)
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const modules = process.env.VIEWER_MODULES ?? join(here, 'node_modules');
const esbuild = createRequire(join(modules, 'x.js'))('esbuild');

const built = await esbuild.build({
  entryPoints: [join(here, 'src/main.js')],
  bundle: true, minify: true, format: 'iife', target: 'es2022', charset: 'ascii', legalComments: 'inline',
  nodePaths: [modules], write: false, outdir: 'page',
});
const text = end => built.outputFiles.find(file => file.path.endsWith(end)).text.trim();
const page = readFileSync(join(here, 'src/index.html'), 'utf8')
  .replace('/*STYLE*/', () => text('.css'))
  .replace('/*SCRIPT*/', () => text('.js'));

// A raw string for every part, since compilers may bound its length.
const partLength = 15000, mark = 'cellwalk_page';
if (page.includes(`)${mark}"`)) throw new Error('the page holds the end of the string that is to hold it');
const parts = page.match(new RegExp(`[^]{1,${partLength}}`, 'g'));
writeFileSync(process.argv[2], `// Made by viewer/build.mjs.
#include "cli/common/viewer_page.h"

namespace cellwalk::cli {
const std::string_view viewer_page =
${parts.map(part => `    R"${mark}(${part})${mark}"`).join('\n')};
}
`);
