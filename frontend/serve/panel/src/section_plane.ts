// The section plane, as mouse and keys move it like the window's (frontend/window/state.hpp): what lies beyond it along
// its normal is cut off.
import type { Size } from './camera';
import { clamp, cross, dot, length, plus, project, radians, subtract, viewOf } from './camera';
import type { Preview } from './preview';
import type { Box, Section, Vec3 } from './protocol';

/** A plane's step on the screen, by which its normal is seen, as a share of the design's size. */
const step_share = 0.01;
/** A normal along which that step is shorter than this is seen end-on. */
const leastStep_px = 0.25;
/** The least sine between two sides of a triangle that lays a plane. */
const leastSine = 1e-6;

export const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] } as const satisfies Record<string, Readonly<Vec3>>;

const centerOf = ({ min, max }: Box): Vec3 => min.map((low, i) => (low + max[i]!) / 2) as Vec3;

/** Returns the least and the largest position of a plane with that normal that meets the box. */
export function positionsIn(box: Box, normal: Vec3): [number, number] {
  const middle = dot(centerOf(box), normal);
  const reach = dot(subtract(box.max, box.min), normal.map(Math.abs) as Vec3) / 2;
  return [middle - reach, middle + reach];
}

/** Returns the vector with length 1; null: it has no direction. */
export function unit(v: Vec3): Vec3 | null {
  const size = length(v);
  return size > 0 && Number.isFinite(size) ? (v.map((x) => x / size) as Vec3) : null;
}

function turned(v: Vec3, axis: Vec3, angle_deg: number): Vec3 {
  const sine = Math.sin(radians(angle_deg));
  const cosine = Math.cos(radians(angle_deg));
  const within = v.map((x) => cosine * x) as Vec3;
  return plus(plus(within, sine, cross(axis, v)), (1 - cosine) * dot(axis, v), axis);
}

export class SectionPlane {
  private normal: Vec3 = [1, 0, 0]; // of the last one

  constructor(private readonly preview: Preview) {}

  get now(): Section | null {
    return this.preview.wanted.section ?? null;
  }

  /** Of the design; null: there is nothing to be cut. */
  get bounds(): Box | null {
    return this.preview.design?.bounds ?? null;
  }

  toggle(): void {
    if (this.now) this.preview.change({ section: null });
    else this.layAcross(this.normal);
  }

  flip(): void {
    if (this.now) this.preview.change({ section: { ...this.now, flipped: !this.now.flipped } });
  }

  /** Lays it across the middle of the design. */
  layAcross(normal: Readonly<Vec3>): void {
    this.lay([...normal], this.bounds ? centerOf(this.bounds) : [0, 0, 0]);
  }

  /** Lays it through three points. Returns whether they give a plane. */
  layThrough([a, b, c]: [Vec3, Vec3, Vec3]): boolean {
    const sides = [subtract(b, a), subtract(c, a)] as const;
    const across = cross(...sides);
    const normal = unit(across);
    if (!normal || !(length(across) > leastSine * length(sides[0]) * length(sides[1]))) return false;
    this.lay(normal, a);
    return true;
  }

  /** Moves it by a share of the design's size along its normal. */
  move(share: number): void {
    const { now, bounds } = this;
    if (!now || !bounds) return;
    const [low, high] = positionsIn(bounds, now.normal);
    this.moveTo(now.position + share * (high - low));
  }

  /** Moves it, within the design. */
  moveTo(position: number): void {
    const { now, bounds } = this;
    if (!now || !bounds) return;
    this.preview.move({ section: { ...now, position: clamp(position, ...positionsIn(bounds, now.normal)) } });
  }

  /** Turns it about the axes of the picture, and about its point that is nearest to the design's middle. */
  turn(aboutRight_deg: number, aboutUp_deg: number): void {
    const { camera } = this.preview;
    if (!this.now || !camera) return;
    const { right, up } = viewOf(camera);
    this.direct(turned(turned(this.now.normal, right, aboutRight_deg), up, aboutUp_deg));
  }

  /** Gives it another normal, of any length, about the same point. */
  direct(direction: Vec3): void {
    const { now, bounds } = this;
    const normal = unit(direction);
    if (!now || !bounds || !normal) return;
    this.normal = normal;
    this.preview.move({ section: { ...now, normal, position: dot(middleOf(now, bounds), normal) } });
  }

  /** Moves it so that it follows a drag in the picture along its normal, as that is seen. */
  drag(dx: number, dy: number, size: Size): void {
    const { now, bounds } = this;
    const { camera } = this.preview;
    if (!now || !bounds || !camera) return;
    const onPlane = middleOf(now, bounds);
    const step = step_share * length(subtract(bounds.max, bounds.min));
    const from = project(camera, size, onPlane);
    const to = project(camera, size, plus(onPlane, step, now.normal));
    if (!from || !to) return;
    const [x, y] = [to.x - from.x, to.y - from.y];
    const length_px = Math.hypot(x, y);
    // A plane that is seen along its normal does not move on the screen: a drag downwards moves it forward.
    const moved = length_px >= leastStep_px ? (dx * x + dy * y) / length_px : dy;
    this.moveTo(now.position + (step * moved) / Math.max(length_px, leastStep_px));
  }

  /** The side towards the eye is cut off. */
  private lay(normal: Vec3, point: Vec3): void {
    const { camera } = this.preview;
    if (!camera) return;
    this.normal = normal;
    this.preview.change({ section: { normal, position: dot(normal, point), flipped: dot(viewOf(camera).forward, normal) > 0 } });
  }
}

/** Returns the plane's point that is nearest to the middle of the box. */
function middleOf({ normal, position }: Section, box: Box): Vec3 {
  const center = centerOf(box);
  return plus(center, position - dot(center, normal), normal);
}
