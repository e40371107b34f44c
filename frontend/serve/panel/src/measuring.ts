// The points that have been measured, at most two, and where what stands there comes from in the design's text.
import { digits, iconButton, make, nameOf } from './dom';
import { dot, length, subtract } from './camera';
import type { Picture } from './picture';
import type { Preview } from './preview';
import type { Pick, Place, Vec3 } from './protocol';

/** A click measures a vertex, an edge or a circle's centre that is no further away, in pixels of the page. */
const snapReach_px = 7;

/** What is so much smaller than the largest coordinate is rounding. */
const rounding = 1e-9;

function coordinates(v: Vec3): string {
  const least = rounding * Math.max(...v.map(Math.abs));
  return `[${v.map((x) => digits(Math.abs(x) < least ? 0 : x)).join(', ')}]`;
}

/** Returns what is known of the surface at a point, a line each. */
export function wordsOf(pick: Pick): string[] {
  const words: string[] = [];
  const kind = pick.feature?.kind;
  if (kind === 'vertex') words.push('vertex');
  if (kind === 'edge') words.push(pick.radius === undefined ? 'edge' : 'circle');
  if (kind === 'center') words.push('centre');
  if (pick.radius !== undefined) words.push(`radius ${digits(pick.radius)}`);
  if (pick.length !== undefined) words.push(`length ${digits(pick.length)}`);
  if (!kind && pick.radius === undefined) words.push(`normal ${coordinates(pick.normal)}`);
  return words;
}

/** Returns how two points, and the faces at them, lie to each other. */
export function relationOf(a: Pick, b: Pick): string[] {
  const between = subtract(b.position, a.position);
  const words = [`distance ${digits(length(between))}`, `difference ${coordinates(between)}`];
  if (!a.flat || !b.flat) return words;
  const cosine = dot(a.normal, b.normal);
  if (Math.abs(cosine) > 1 - 1e-9) words.push(`parallel faces ${digits(Math.abs(dot(between, a.normal)))} apart`);
  else words.push(`angle of the normals ${digits((Math.acos(cosine) * 180) / Math.PI)}°`);
  return words;
}

export class Measuring {
  readonly element = make('section', { class: 'card', 'aria-label': 'Measured', 'aria-live': 'polite', hidden: true });
  readonly hovered = make('div', { class: 'tooltip', role: 'status', hidden: true });
  private points: Pick[] = [];
  /** Of the last clicks, at most three. */
  lastPlaces: Vec3[] = [];
  private hoverNumber = 0;

  constructor(
    private readonly preview: Preview,
    private readonly picture: Picture,
    private readonly reveal: (place: Place) => void,
  ) {
    preview.onDesign.listen(({ ok }) => ok && this.forget());
  }

  get isEmpty(): boolean {
    return this.points.length === 0;
  }

  /** The normal of the flat face that was measured last. */
  get face(): Vec3 | null {
    const last = this.points.at(-1);
    return last?.flat ? last.normal : null;
  }

  /** Measures what is seen at a place, in pixels of the device. Next to nothing, it forgets the points. */
  async measure(x: number, y: number, snaps: boolean): Promise<void> {
    const pick = await this.preview.pick(x, y, snaps ? snapReach_px * this.picture.scale : 0);
    if (this.points.length === 2 || !pick) this.points = [];
    if (pick) {
      this.points.push(pick);
      this.lastPlaces = [...this.lastPlaces.slice(-2), pick.position];
    }
    this.show();
  }

  forget(): void {
    this.points = [];
    this.lastPlaces = [];
    this.show();
  }

  /** Names the leaf at a place; null: no longer. */
  async hover(place: { x: number; y: number; clientX: number; clientY: number } | null): Promise<void> {
    const number = ++this.hoverNumber;
    this.hovered.hidden = true;
    if (!place) return;
    const pick = await this.preview.pick(place.x, place.y);
    if (!pick || number !== this.hoverNumber) return;
    const [leaf, module] = pick.places;
    const lines = [pick.leaf, leaf ? where(leaf) : null, module ? `in ${module.label}` : null];
    this.hovered.replaceChildren(...lines.filter((line) => line !== null).map((line) => make('div', {}, line)));
    this.hovered.hidden = false;
    const width = this.picture.element.clientWidth;
    this.hovered.style.left = `${Math.max(0, Math.min(place.clientX + 14, width - this.hovered.offsetWidth))}px`;
    this.hovered.style.top = `${place.clientY + 16}px`;
  }

  /** Opens the place of the last point. */
  open(): void {
    const place = this.points.at(-1)?.places[0];
    if (place) this.reveal(place);
  }

  copy(): void {
    if (!this.isEmpty) void navigator.clipboard?.writeText(this.lines().join('\n'));
  }

  private lines(): string[] {
    const lines = this.points.flatMap((pick) => [
      `${pick.leaf} at ${coordinates(pick.position)}`,
      ...wordsOf(pick),
      ...pick.places.map((place) => `${place.label} ${where(place)}`),
    ]);
    const [a, b] = this.points;
    return a && b ? [...lines, ...relationOf(a, b)] : lines;
  }

  private show(): void {
    const [a, b] = this.points;
    const last = this.points.at(-1);
    this.element.hidden = !last;
    this.picture.mark([
      ...this.points.map(({ position }) => [position]),
      ...this.points.filter(({ feature }) => feature?.kind === 'edge').map(({ feature }) => feature!.points),
      ...(a && b ? [[a.position, b.position]] : []),
    ]);
    if (!last) return;
    const row = (text: string) => make('div', { class: 'row' }, text);
    this.element.replaceChildren(
      make('header', {}, make('strong', {}, last.leaf), iconButton('close', 'Forget (Esc)', () => this.forget())),
      row(`at ${coordinates(last.position)}`),
      ...wordsOf(last).map(row),
      ...(a && b ? relationOf(a, b) : []).map((text) => make('div', { class: 'row relation' }, text)),
      ...last.places.map((place) =>
        make(
          'button',
          { type: 'button', class: 'link', on: { click: () => this.reveal(place) } },
          make('span', { class: 'text' }, place.label),
          make('span', { class: 'place' }, where(place)),
        ),
      ),
    );
  }
}

function where({ uri, range }: Place): string {
  return `${nameOf(uri)}:${range.start.line + 1}`;
}
