// SPDX-License-Identifier: LGPL-3.0-or-later
import './style.css';
import { makeBodies } from './bodies.js';
import { makeContacts } from './contacts.js';
import { parseContacts, parseMotion, unpacked } from './motion.js';
import { Panel } from './panel.js';
import { makePath } from './path.js';
import { Stage } from './stage.js';
import { Timeline } from './timeline.js';
import { makeWalls } from './walls.js';

const normalShare = 0.022;  // of the box's diagonal

async function start() {
  const motion = parseMotion(await unpacked('motion-data'));
  const contacts = parseContacts(await unpacked('contact-data'));
  const report = JSON.parse(document.getElementById('run-data').textContent);
  const toward = report.manifest?.scene?.output?.picture?.toward;
  const stage = new Stage(document.getElementById('stage'), motion, toward?.length === 3 ? toward : undefined);
  const walls = makeWalls(motion), bodies = makeBodies(motion);
  const seen = makeContacts(contacts, 2 * stage.radius * normalShare, stage.isFlat);
  stage.add(walls.group, walls.lines);
  stage.add(bodies.group, bodies.lines);
  stage.add(seen.group, [seen.normals]);
  const path = makePath(report.catheter?.path);
  stage.add(path.object, [path]);

  const show = record => {
    const step = motion.stepOf(record);
    walls.group.visible = panel.showsWalls;
    walls.show(record);
    seen.normals.object.visible = panel.showsNormals;
    bodies.show(record, panel.mode);
    panel.update(record, seen.show(panel.window === 0 ? 0 : Math.max(0, step - panel.window), step));
    stage.redraw();
  };
  const panel = new Panel(motion, contacts, report, () => timeline.go(timeline.record));
  const timeline = new Timeline(motion, contacts, show);
  document.getElementById('fit').addEventListener('click', () => stage.fit());
  document.addEventListener('keydown', event => {
    if (event.key === 'f') stage.fit();
  });
  timeline.go(0);
  document.body.dataset.state = 'ready';
}

start().catch(error => {
  document.body.dataset.state = 'failed';
  const note = document.getElementById('failure');
  note.hidden = false;
  note.textContent = `This run cannot be shown: ${error.message}. The page needs WebGL and a browser of 2023 or later.`;
  console.error(error);
});
