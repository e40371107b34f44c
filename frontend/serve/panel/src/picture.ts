// The picture: the frames on a canvas, and above them what has been measured.
import type { Size } from './camera';
import { project } from './camera';
import { svgElement } from './dom';
import type { Preview } from './preview';
import type { Camera, Frame, Vec3 } from './protocol';

const mostPixels = 4096; // of a side

export class Picture {
  readonly canvas = document.createElement('canvas');
  readonly overlay = svgElement('svg', { class: 'overlay', 'aria-hidden': 'true' });
  frame: Frame | null = null;
  /** In pixels of the device. */
  size: Size = { width: 1, height: 1 };
  /** The points of each line or mark, in the design's space. */
  private marks: Vec3[][] = [];
  private readonly context = this.canvas.getContext('bitmaprenderer')!;

  constructor(
    readonly element: HTMLElement,
    private readonly preview: Preview,
  ) {
    element.append(this.canvas, this.overlay);
    preview.onFrame.listen(({ frame, image }) => void this.show(frame, image));
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  /** Pixels of the device in one of the page. */
  get scale(): number {
    return this.size.width / Math.max(this.element.clientWidth, 1);
  }

  mark(marks: Vec3[][]): void {
    this.marks = marks;
    this.drawMarks();
  }

  private resize(): void {
    const ratio = devicePixelRatio;
    const { clientWidth, clientHeight } = this.element;
    const scale = Math.min(ratio, mostPixels / clientWidth, mostPixels / clientHeight);
    this.size = {
      width: Math.max(1, Math.round(clientWidth * scale)),
      height: Math.max(1, Math.round(clientHeight * scale)),
    };
    const { wanted } = this.preview;
    if (wanted.width !== this.size.width || wanted.height !== this.size.height) this.preview.move({ ...this.size });
    this.drawMarks();
  }

  private async show(frame: Frame, image: Blob): Promise<void> {
    let bitmap: ImageBitmap;
    try {
      bitmap = await createImageBitmap(image);
    } catch {
      // A damaged image: the one before stays, and the next can come.
      this.preview.shown(frame);
      return;
    }
    const { width, height } = bitmap;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    this.context.transferFromImageBitmap(bitmap);
    this.frame = frame;
    Object.assign(this.canvas.dataset, { number: frame.number, version: frame.version, final: frame.final });
    this.drawMarks();
    this.preview.shown(frame);
  }

  private drawMarks(): void {
    const camera = this.frame?.camera;
    const size = { width: this.element.clientWidth, height: this.element.clientHeight };
    this.overlay.replaceChildren(...(camera ? this.marks.flatMap((mark) => drawnMark(camera, size, mark)) : []));
  }
}

/** Draws a point as a ring, or points as a line, where they are seen. */
function drawnMark(camera: Camera, size: Size, points: Vec3[]): SVGElement[] {
  const seen = points.map((point) => project(camera, size, point)).filter((place) => place !== null);
  if (seen.length < points.length) return [];
  if (seen.length === 1) return [svgElement('circle', { cx: seen[0]!.x, cy: seen[0]!.y, r: 5 })];
  return [svgElement('polyline', { points: seen.map(({ x, y }) => `${x},${y}`).join(' ') })];
}
