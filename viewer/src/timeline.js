// SPDX-License-Identifier: LGPL-3.0-or-later
// Play, scrub, step; contacts of each record as bars above the slider.
import { pictures } from './colours.js';

const recordsASecond = 30, farStep = 10;

export class Timeline {
  /** `show(record)` is called whenever another record is to be seen. */
  constructor(motion, contacts, show) {
    const find = id => document.getElementById(id);
    Object.assign(this, { motion, show, record: 0, isPlaying: false, rest: 0 });
    this.slider = find('slider');
    this.button = find('play');
    this.speed = find('speed');
    this.label = find('time');
    this.bars = find('bars');
    this.slider.max = motion.records - 1;
    this.slider.addEventListener('input', () => this.go(Number(this.slider.value)));
    this.button.addEventListener('click', () => this.toggle());
    find('first').addEventListener('click', () => this.go(0));
    find('back').addEventListener('click', () => this.go(this.record - 1));
    find('on').addEventListener('click', () => this.go(this.record + 1));
    find('last').addEventListener('click', () => this.go(motion.records - 1));
    document.addEventListener('keydown', event => this.key(event));
    this.counts = Array.from({ length: motion.records }, (_, r) => r === 0 ? 0 :
      contacts.begin(motion.stepOf(r) + 1) - contacts.begin(motion.stepOf(r - 1) + 1));
    new ResizeObserver(() => this.drawBars()).observe(this.bars);
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches?.('select')) return;
    const far = event.shiftKey ? farStep : 1;
    const actions = {
      ' ': () => this.toggle(),
      ArrowRight: () => this.go(this.record + far),
      ArrowLeft: () => this.go(this.record - far),
      Home: () => this.go(0),
      End: () => this.go(this.motion.records - 1),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  }

  go(record) {
    this.record = Math.min(this.motion.records - 1, Math.max(0, record));
    this.slider.value = this.record;
    const step = this.motion.stepOf(this.record);
    this.label.textContent = `step ${step} of ${this.motion.steps}   t = ${(step * this.motion.time_step).toFixed(3)}`;
    this.show(this.record);
  }

  toggle() {
    this.isPlaying = !this.isPlaying;
    this.button.textContent = this.isPlaying ? '❚❚' : '►';
    this.button.setAttribute('aria-label', this.isPlaying ? 'Pause' : 'Play');
    if (!this.isPlaying) return;
    if (this.record === this.motion.records - 1) this.go(0);
    this.before = undefined;
    requestAnimationFrame(time => this.tick(time));
  }

  tick(time) {
    if (!this.isPlaying) return;
    if (this.before !== undefined) this.rest += (time - this.before) / 1000 * recordsASecond * Number(this.speed.value);
    this.before = time;
    const whole = Math.floor(this.rest);
    this.rest -= whole;
    if (whole > 0) this.go(this.record + whole);
    if (this.record === this.motion.records - 1) this.toggle();
    else requestAnimationFrame(later => this.tick(later));
  }

  drawBars() {
    const scale = window.devicePixelRatio, width = this.bars.clientWidth, height = this.bars.clientHeight;
    Object.assign(this.bars, { width: width * scale, height: height * scale });
    const context = this.bars.getContext('2d');
    context.scale(scale, scale);
    context.fillStyle = `${pictures.contact}cc`;
    const columns = new Float64Array(width);
    this.counts.forEach((count, r) => {
      const column = Math.min(width - 1, Math.floor(r / Math.max(1, this.counts.length - 1) * (width - 1)));
      columns[column] += count;
    });
    const most = columns.reduce((a, b) => Math.max(a, b), 1);
    columns.forEach((count, x) => {
      const tall = count > 0 ? 1 + (height - 1) * count / most : 0;
      context.fillRect(x, height - tall, 1, tall);
    });
  }
}
