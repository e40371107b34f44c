// What mouse, pen and touch do to the picture: they move the camera and the section plane, measure, and name leaves.
import { Pan, moveAlong, pan, turn, turn_degPerPixel, zoom, zoomBy } from './camera';
import type { Picture } from './picture';
import type { Preview } from './preview';
import type { SectionPlane } from './section_plane';

/** A click moves no further than this; fingers and pens are less steady than a mouse. */
const clickReach_px = { mouse: 4, other: 10 };
/** The second click of two is no further from the first. */
const doubleClickReach_px = { mouse: 4, other: 20 };
const doubleClick_ms = 400;
const hover_ms = 400;
const notch_px = 100; // that a notch of the wheel scrolls

export interface PointerActions {
  /** A click or a tap at a place, in pixels of the device. */
  measure(x: number, y: number, snaps: boolean): void;
  center(x: number, y: number): void;
  copy(): void;
  /** The pointer rests at a place; null: no longer. */
  hover(place: { x: number; y: number; clientX: number; clientY: number } | null): void;
}

interface Held {
  x: number;
  y: number;
  startX: number;
  startY: number;
  button: number;
  pointer: 'mouse' | 'other';
}

export class PointerInput {
  private readonly held = new Map<number, Held>();
  private hasMoved = false;
  private pan: Pan | null = null;
  private lastClick = { time: -Infinity, x: 0, y: 0 };
  private hoverTimer = 0;

  constructor(
    private readonly picture: Picture,
    private readonly preview: Preview,
    private readonly section: SectionPlane,
    private readonly actions: PointerActions,
  ) {
    const { element } = picture;
    element.addEventListener('pointerdown', (event) => this.down(event));
    element.addEventListener('pointermove', (event) => this.move(event));
    element.addEventListener('pointerup', (event) => this.up(event));
    element.addEventListener('pointercancel', (event) => this.release(event));
    element.addEventListener('pointerleave', () => this.endHover());
    element.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    element.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  /** Returns a place in pixels of the device, from the picture's corner. */
  private place(x: number, y: number): { x: number; y: number } {
    const box = this.picture.element.getBoundingClientRect();
    return { x: (x - box.left) * this.picture.scale, y: (y - box.top) * this.picture.scale };
  }

  private down(event: PointerEvent): void {
    this.picture.element.focus();
    this.picture.element.setPointerCapture(event.pointerId);
    const { clientX: x, clientY: y } = event;
    this.held.set(event.pointerId, {
      x,
      y,
      startX: x,
      startY: y,
      button: event.button,
      pointer: event.pointerType === 'mouse' ? 'mouse' : 'other',
    });
    this.endHover();
    if (this.held.size > 1) this.hasMoved = true; // no finger of several clicks
    else this.hasMoved = false;
    if (event.button === 2) this.beginPan(event);
    if (event.button === 1) event.preventDefault(); // no scrolling by the middle button
  }

  private beginPan(event: PointerEvent): void {
    const camera = this.preview.camera;
    if (!camera) return;
    const begun = new Pan(camera);
    this.pan = begun;
    const at = this.place(event.clientX, event.clientY);
    void this.preview.pick(at.x, at.y).then((pick) => {
      const now = this.preview.camera;
      const moved = pick && this.pan === begun && now ? begun.take(pick.position, now, this.picture.size) : null;
      if (moved) this.preview.move({ camera: moved });
    });
  }

  /** The middle of what is held. */
  private middle(): { x: number; y: number } {
    const all = [...this.held.values()];
    const sum = (value: (held: Held) => number) => all.reduce((total, held) => total + value(held), 0) / all.length;
    return { x: sum((held) => held.x), y: sum((held) => held.y) };
  }

  /** How far apart the two fingers are. */
  private spread(): number {
    const [a, b] = [...this.held.values()];
    return a && b ? Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1) : 1;
  }

  private move(event: PointerEvent): void {
    const held = this.held.get(event.pointerId);
    if (!held) {
      this.beginHover(event);
      return;
    }
    const { clientX: x, clientY: y } = event;
    if (!this.hasMoved && Math.hypot(x - held.startX, y - held.startY) < clickReach_px[held.pointer]) return;
    this.hasMoved = true;
    const before = { x: held.x, y: held.y, middle: this.middle(), spread: this.spread() };
    const dx = (x - held.x) * this.picture.scale;
    const dy = (y - held.y) * this.picture.scale;
    held.x = x;
    held.y = y;
    const camera = this.preview.camera;
    if (!camera) return;
    const { size } = this.picture;
    if (this.held.size === 2) {
      this.pinch(before);
    } else if (this.held.size > 2) {
      return;
    } else if (held.button === 0 && (event.ctrlKey || event.metaKey) && this.section.now) {
      if (event.shiftKey) this.section.turn(turn_degPerPixel * (y - before.y), turn_degPerPixel * (x - before.x));
      else this.section.drag(dx, dy, size);
    } else if (held.button === 0) {
      // Angles are of the page's pixels, so that a dense display turns as far.
      this.preview.move({ camera: turn(camera, x - before.x, y - before.y, event.shiftKey) });
    } else if (held.button === 1 || event.shiftKey) {
      this.preview.move({ camera: moveAlong(camera, dy, size) });
    } else if (this.pan) {
      this.preview.move({ camera: this.pan.move(camera, dx, dy, size) });
    }
  }

  /** Two fingers pan by their middle, and zoom by what they are apart. */
  private pinch(before: { middle: { x: number; y: number }; spread: number }): void {
    const camera = this.preview.camera!;
    const { size, scale } = this.picture;
    const middle = this.middle();
    const at = this.place(middle.x, middle.y);
    const dx = (middle.x - before.middle.x) * scale;
    const dy = (middle.y - before.middle.y) * scale;
    const zoomed = zoomBy(pan(camera, dx, dy, size), before.spread / this.spread(), at.x, at.y, size);
    this.preview.move({ camera: zoomed });
  }

  private up(event: PointerEvent): void {
    const held = this.held.get(event.pointerId);
    this.release(event);
    if (!held || this.hasMoved) return;
    const at = this.place(event.clientX, event.clientY);
    if (held.button === 2) {
      this.actions.copy();
    } else if (held.button === 0) {
      const { time, x, y } = this.lastClick;
      const reach = doubleClickReach_px[held.pointer] * this.picture.scale;
      const isSecond = event.timeStamp - time < doubleClick_ms && Math.hypot(at.x - x, at.y - y) < reach;
      this.lastClick = { time: isSecond ? -Infinity : event.timeStamp, ...at };
      if (isSecond) this.actions.center(at.x, at.y);
      else this.actions.measure(at.x, at.y, !event.altKey);
    }
  }

  private release(event: PointerEvent): void {
    this.held.delete(event.pointerId);
    this.pan = null;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.endHover();
    const camera = this.preview.camera;
    if (!camera) return;
    const unit = [1, notch_px / 3, 3 * notch_px][event.deltaMode] ?? 1;
    // A pinch on a touchpad comes as a wheel with ctrl, with small steps.
    const notches = (-event.deltaY * unit * (event.ctrlKey ? 5 : 1)) / notch_px;
    const at = this.place(event.clientX, event.clientY);
    this.preview.move({ camera: zoom(camera, notches, at.x, at.y, this.picture.size) });
  }

  private beginHover(event: PointerEvent): void {
    this.endHover();
    if (event.pointerType === 'touch') return;
    const { clientX, clientY } = event;
    this.hoverTimer = setTimeout(
      () => this.actions.hover({ ...this.place(clientX, clientY), clientX, clientY }),
      hover_ms,
    );
  }

  private endHover(): void {
    clearTimeout(this.hoverTimer);
    this.actions.hover(null);
  }
}
