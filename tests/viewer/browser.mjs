// SPDX-License-Identifier: LGPL-3.0-or-later
// Chromium without a window, network and graphics card.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const modules = process.env.VIEWER_MODULES ?? fileURLToPath(new URL('../../viewer/node_modules', import.meta.url));
const software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const quiet = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];

export function launch() {
  const { chromium } = createRequire(join(modules, 'x.js'))('playwright-core');
  return chromium.launch({ executablePath: process.env.CELLWALK_CHROMIUM ?? '/usr/bin/chromium', args: [...software, ...quiet] });
}
