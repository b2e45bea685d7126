// SPDX-License-Identifier: LGPL-3.0-or-later
// The panel: what the run was, what is seen of it, and its counts.
import { decisionOf, decisions, kinds } from './colours.js';

const number = value => Number(value).toLocaleString('en-US');
const percent = value => `${(100 * value).toFixed(1)} %`;

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
const swatch = colour => {
  const made = element('span', { className: 'swatch' });
  made.style.background = colour;
  return made;
};
const plural = (count, word, many = word + 's') => `${number(count)} ${count === 1 ? word : many}`;

function table(id, rows) {
  const body = document.getElementById(id);
  for (const [name, value, colour] of rows)
    body.append(element('tr', {}, element('td', {}, ...(colour ? [swatch(colour)] : []), name),
                        element('td', { textContent: value })));
}

export class Panel {
  constructor(motion, contacts, report, change) {
    const find = id => document.getElementById(id);
    Object.assign(this, { motion, contacts, find });
    const bodies = motion.bodies.filter(body => body.kind !== 'catheter').length;
    const parts = [`${motion.dimension}D`, plural(motion.cells, 'cell')];
    if (bodies > 0) parts.push(plural(bodies, 'body', 'bodies'));
    if (bodies < motion.bodyCount) parts.push('a catheter');
    if (motion.particles > 0) parts.push(plural(motion.particles, 'particle'));
    parts.push(plural(motion.steps, 'step'));
    const title = report.manifest?.scene?.title || 'A run of Cellwalk';
    document.title = `${title} · Cellwalk`;
    find('title').textContent = title;
    find('subtitle').textContent = parts.join(' · ');
    if (motion.bodyCount === 0) document.querySelector('[value=certificate]').disabled = true;

    this.legend = find('legend');
    this.cells = motion.decisions.map(name => {
      const { title, colour } = decisionOf(name), count = element('td');
      const row = element('tr', {}, element('td', {}, swatch(colour), title), count);
      this.legend.append(row);
      return count;
    });
    for (const id of ['walls', 'normals', 'window'])
      find(id).addEventListener('change', change);
    for (const radio of document.querySelectorAll('[name=colour]')) radio.addEventListener('change', change);
    this.counts(report);
    if (motion.every > 1) find('since').textContent = `Contacts in the last ${motion.every} steps`;
    find('version').textContent = `cellwalk ${report.manifest?.cellwalk ?? ''}`;
  }

  get mode() { return document.querySelector('[name=colour]:checked').value; }
  get window() { return Number(this.find('window').value); }
  get showsWalls() { return this.find('walls').checked; }
  get showsNormals() { return this.find('normals').checked; }

  counts(report) {
    const all = Object.values(report.contacts).reduce((a, b) => a + b, 0);
    table('run', [
      ['Cells', number(report.environment.cells)], ['Walls', number(report.environment.walls)],
      ['Contacts', number(all)],
      ...[2, 1, 0].map(k => [`with ${kinds[k].name === 'vertex' ? 'vertices' : kinds[k].name + 's'}`,
                             number(report.contacts[kinds[k].name]), kinds[k].colour]),
    ]);
    const counts = report.body_counts;
    if (counts) {
      const shares = counts.shares;
      table('run', [['Moves of vertices', number(counts.moves)], ['in regions free of walls', percent(shares.in_region), decisions.region.colour],
        ['Edges checked', number(counts.edges.checked)],
        ...[['same_cell'], ['same_chain'], ['relinked'], ['events', 'event_sweeps']].map(([name, share = name]) =>
          [decisions[name].title, percent(shares[share]), decisions[name].colour])]);
    }
    if (report.catheter)
      table('run', [['Catheter', report.catheter.arrived ? 'arrived' : `at waypoint ${report.catheter.waypoint}`]]);
    table('run', [['Validated', report.validated ? 'yes' : 'no']]);
  }

  /** What the counts are at a record. */
  update(record, shown) {
    const step = this.motion.stepOf(record), so = this.contacts.begin(step + 1);
    const here = so - this.contacts.begin(record === 0 ? 0 : this.motion.stepOf(record - 1) + 1);
    this.find('here').textContent = number(record === 0 ? 0 : here);
    this.find('sofar').textContent = number(so);
    this.find('shown').textContent = number(shown);
    this.legend.hidden = this.mode !== 'certificate';
    if (this.legend.hidden) return;
    const count = new Uint32Array(this.motion.decisions.length);
    for (const decision of this.motion.decisionsOf(record)) ++count[decision];
    this.cells.forEach((cell, i) => { cell.textContent = number(count[i]); });
  }
}
