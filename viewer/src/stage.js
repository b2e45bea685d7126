// SPDX-License-Identifier: LGPL-3.0-or-later
// Canvas, camera and controls. Draws when something changed, not all the time.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const fieldOfView = 32, margin = 1.06, layers = 10;

export class Stage {
  constructor(holder, motion, toward) {
    this.isFlat = motion.dimension === 2;
    this.holder = holder;
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setClearColor(this.isFlat ? '#e2e8f0' : '#f8fafc');
    holder.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.box = new THREE.Box3(new THREE.Vector3(...motion.lower), new THREE.Vector3(...motion.upper));
    this.radius = this.box.getSize(new THREE.Vector3()).length() / 2;
    this.toward = new THREE.Vector3(...(toward ?? [0.55, -1, 0.5])).normalize();
    this.fat = [];
    this.points = motion.points;
    if (this.isFlat) {
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -layers * this.radius, layers * this.radius);
    } else {
      this.camera = new THREE.PerspectiveCamera(fieldOfView, 1, this.radius / 200, this.radius * 40);
      this.camera.up.set(0, 0, 1);
      const sun = new THREE.DirectionalLight('#ffffff', 1.6);
      sun.position.set(0.4, 0.7, 1);
      this.camera.add(sun);
      this.scene.add(this.camera, new THREE.AmbientLight('#ffffff', 1.6));
    }
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.zoomToCursor = true;
    this.controls.enableRotate = !this.isFlat;
    if (this.isFlat) {
      this.controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
      this.controls.touches.ONE = THREE.TOUCH.PAN;
    }
    this.controls.addEventListener('change', () => this.redraw());
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
    this.fit();
  }

  /** Adds what make...() returned; its fat lines learn the size of the canvas. */
  add(object, lines = []) {
    this.scene.add(object);
    this.fat.push(...lines);
    this.resize();
  }

  /** The environment, seen from `toward`, fills the canvas. */
  fit() {
    const middle = this.box.getCenter(new THREE.Vector3());
    if (this.isFlat) {
      const size = this.box.getSize(new THREE.Vector3());
      this.camera.zoom = 1;
      this.halfHeight = margin * Math.max(size.y, size.x / this.aspect()) / 2;
      this.camera.position.set(middle.x, middle.y, this.radius);
    } else {
      this.camera.position.copy(middle).addScaledVector(this.toward, this.distanceTo(middle));
    }
    this.controls.target.copy(middle);
    this.setLens();
    this.controls.update();
    this.redraw();
  }

  /** From where all points are seen; moves `middle` across the view to the middle of what is seen. */
  distanceTo(middle) {
    const forward = this.toward.clone().negate(), right = forward.clone().cross(this.camera.up).normalize();
    const up = right.clone().cross(forward), tangent = Math.tan(THREE.MathUtils.degToRad(fieldOfView / 2));
    const at = new THREE.Vector3();
    const each = visit => {
      for (let i = 0; i < this.points.length; i += 3) visit(at.fromArray(this.points, i).sub(middle));
    };
    for (const axis of [right, up]) {
      let low = Infinity, high = -Infinity;
      each(p => { low = Math.min(low, p.dot(axis)); high = Math.max(high, p.dot(axis)); });
      middle.addScaledVector(axis, (low + high) / 2);
    }
    let distance = 0;
    each(p => {
      const beyond = Math.max(Math.abs(p.dot(up)), Math.abs(p.dot(right)) / this.aspect()) * margin / tangent;
      distance = Math.max(distance, beyond - p.dot(forward));
    });
    return distance;
  }

  aspect() {
    return Math.max(1, this.holder.clientWidth) / Math.max(1, this.holder.clientHeight);
  }

  setLens() {
    if (this.isFlat) {
      Object.assign(this.camera, { top: this.halfHeight, bottom: -this.halfHeight,
        right: this.halfHeight * this.aspect(), left: -this.halfHeight * this.aspect() });
    } else {
      this.camera.aspect = this.aspect();
    }
    this.camera.updateProjectionMatrix();
  }

  resize() {
    const width = Math.max(1, this.holder.clientWidth), height = Math.max(1, this.holder.clientHeight);
    this.renderer.setSize(width, height);
    for (const lines of this.fat) lines.setResolution(width, height);
    if (this.controls) this.setLens();
    this.redraw();
  }

  redraw() {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
