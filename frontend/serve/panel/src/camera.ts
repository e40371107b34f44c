// The camera as mouse, touch and keys move it, like the window's (frontend/window/navigation.hpp). Movements and places
// are in pixels of the picture, x to the right and y downwards from its upper left corner.
import type { Camera, Vec3 } from './protocol';

export interface Size {
  width: number;
  height: number;
}

/** A camera's axes in the design's space: unit vectors, and its eye. */
export interface View {
  eye: Vec3;
  right: Vec3;
  up: Vec3;
  forward: Vec3;
  /** Half of the picture's height, at a distance of 1 from the eye; in an orthographic view at any. */
  halfHeight: number;
}

export const turn_degPerPixel = 0.7;
const pan_distances = 3 * 0.7; // by a drag across the picture
const zoomOfNotch = 0.9;
const leastDistance = 1e-90;
const largestDistance = 1e90;

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const subtract = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const length = (v: Vec3): number => Math.hypot(...v);
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** Returns a + factor · b. */
export const plus = (a: Vec3, factor: number, b: Vec3): Vec3 => [
  a[0] + factor * b[0],
  a[1] + factor * b[1],
  a[2] + factor * b[2],
];

export const radians = (angle_deg: number): number => (angle_deg * Math.PI) / 180;
export const clamp = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);

/** Returns the angle in [0, 360), as OpenSCAD shows it. */
function fullTurn(angle_deg: number): number {
  const rest = angle_deg % 360;
  return rest < 0 ? rest + 360 : rest;
}

export function viewOf(camera: Camera): View {
  const [sx, sy, sz] = camera.rotation.map((angle) => Math.sin(radians(angle))) as Vec3;
  const [cx, cy, cz] = camera.rotation.map((angle) => Math.cos(radians(angle))) as Vec3;
  // The columns of OpenSCAD's rotate(): about x, then y, then z.
  const right: Vec3 = [cz * cy, sz * cy, -sy];
  const up: Vec3 = [cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx];
  const back: Vec3 = [cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx];
  const slope = Math.tan(radians(camera.fov / 2));
  return {
    eye: plus(camera.translation, camera.distance, back),
    right,
    up,
    forward: [-back[0], -back[1], -back[2]],
    halfHeight: camera.projection === 'ortho' ? slope * camera.distance : slope,
  };
}

/** Returns where a point is seen; null if a perspective view has it behind the eye or in its plane. */
export function project(camera: Camera, size: Size, point: Vec3): { x: number; y: number } | null {
  const view = viewOf(camera);
  const offset = subtract(point, view.eye);
  let scale = view.halfHeight;
  if (camera.projection === 'perspective') {
    const depth = dot(offset, view.forward);
    if (!(depth > 0)) return null;
    scale *= depth;
  }
  const unit = (0.5 * size.height) / scale;
  return {
    x: 0.5 * size.width + unit * dot(offset, view.right),
    y: 0.5 * size.height - unit * dot(offset, view.up),
  };
}

/** Returns the size of a pixel of what is that far before the eye. */
function pixelSize(camera: Camera, view: View, height: number, depth: number): number {
  return (2 * view.halfHeight * (camera.projection === 'perspective' ? depth : 1)) / height;
}

/** A drag of the left button, or of a finger; `aboutY` with shift. */
export function turn(camera: Camera, dx: number, dy: number, aboutY = false): Camera {
  const [x, y, z] = camera.rotation;
  const about = fullTurn((aboutY ? y : z) - turn_degPerPixel * dx);
  return { ...camera, rotation: [fullTurn(x - turn_degPerPixel * dy), aboutY ? about : y, aboutY ? z : about] };
}

/** Turns about the picture's x axis and the world's z axis. */
export function turnBy(camera: Camera, aboutX_deg: number, aboutZ_deg: number): Camera {
  const [x, y, z] = camera.rotation;
  return { ...camera, rotation: [fullTurn(x + aboutX_deg), y, fullTurn(z + aboutZ_deg)] };
}

/** A drag of the right button: what is `depth` before the eye moves with the mouse. */
export function pan(camera: Camera, dx: number, dy: number, size: Size, depth = camera.distance): Camera {
  const view = viewOf(camera);
  const unit = pixelSize(camera, view, size.height, depth);
  return { ...camera, translation: plus(plus(camera.translation, unit * dy, view.up), -unit * dx, view.right) };
}

/** A drag of the middle button: moves forward and back. */
export function moveAlong(camera: Camera, dy: number, size: Size): Camera {
  const step = (pan_distances * camera.distance * dy) / size.height;
  return { ...camera, translation: plus(camera.translation, step, viewOf(camera).forward) };
}

/** Makes the distance `factor` times as long; what is under (x, y) at the target's depth stays there. */
export function zoomBy(camera: Camera, factor: number, x: number, y: number, size: Size): Camera {
  const view = viewOf(camera);
  const unit = pixelSize(camera, view, size.height, camera.distance);
  const distance = clamp(camera.distance * factor, leastDistance, largestDistance);
  const share = 1 - distance / camera.distance;
  const across = plus(camera.translation, share * unit * (x - 0.5 * size.width), view.right);
  return { ...camera, distance, translation: plus(across, share * unit * (0.5 * size.height - y), view.up) };
}

/** The wheel; notches > 0: nearer. */
export function zoom(camera: Camera, notches: number, x: number, y: number, size: Size): Camera {
  return zoomBy(camera, zoomOfNotch ** notches, x, y, size);
}

export const standardViews = {
  diagonal: [55, 0, 25],
  top: [0, 0, 0],
  bottom: [180, 0, 0],
  left: [90, 0, 270],
  right: [90, 0, 90],
  front: [90, 0, 0],
  back: [90, 0, 180],
} as const satisfies Record<string, Readonly<Vec3>>;

export type StandardView = keyof typeof standardViews;

export function lookFrom(camera: Camera, view: StandardView): Camera {
  return { ...camera, rotation: [...standardViews[view]] };
}

/** A drag that pans. How far the point that it began at is before the eye becomes known only after a while. */
export class Pan {
  depth: number;
  private now: Camera;
  private dx = 0;
  private dy = 0;

  constructor(private start: Camera) {
    this.now = start;
    this.depth = start.distance;
  }

  /** Goes on from a camera, which something else may have moved meanwhile. */
  move(from: Camera, dx: number, dy: number, size: Size): Camera {
    if (from !== this.now) {
      this.start = from;
      this.dx = this.dy = 0;
    }
    this.dx += dx;
    this.dy += dy;
    this.now = pan(this.start, this.dx, this.dy, size, this.depth);
    return this.now;
  }

  /** Takes the point that is under the mouse. Returns the camera that keeps it there; null: it has moved otherwise. */
  take(point: Vec3, camera: Camera, size: Size): Camera | null {
    const view = viewOf(this.start);
    this.depth = dot(subtract(point, view.eye), view.forward);
    return camera === this.now ? this.move(camera, 0, 0, size) : null;
  }
}
