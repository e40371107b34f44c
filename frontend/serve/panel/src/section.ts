// The strip of the section plane: its normal, its position, and what lays it.
import { digits, iconButton, make } from './dom';
import type { Preview } from './preview';
import type { Vec3 } from './protocol';
import { type SectionPlane, axes, positionsIn } from './section_plane';

const steps = 500; // of the slider

export interface SectionActions {
  layAlongFace(): void;
  layThroughPoints(): void;
}

export class SectionStrip {
  readonly element = make('div', { class: 'strip section', role: 'group', 'aria-label': 'Section plane', hidden: true });
  private readonly buttons = Object.entries(axes).map(([name, axis]) =>
    make('button', { type: 'button', title: `Across ${name} (${name.toUpperCase()})`, on: { click: () => this.plane.layAcross(axis) } }, name),
  );
  private readonly slider = make('input', { type: 'range', 'aria-label': 'Position of the section plane' });
  private readonly position = make('output');
  private readonly normal = Object.keys(axes).map((name, i) =>
    make('input', { type: 'number', step: '0.1', 'aria-label': `Normal, ${name}`, on: { input: () => this.enter(i) } }),
  );

  constructor(
    preview: Preview,
    private readonly plane: SectionPlane,
    actions: SectionActions,
  ) {
    this.slider.addEventListener('input', () => plane.moveTo(this.slider.valueAsNumber));
    this.element.append(
      make('div', {}, ...this.buttons, this.slider, this.position,
        iconButton('flip', 'Other side (F)', () => plane.flip()),
        iconButton('close', 'No section (C)', () => plane.toggle())),
      make('div', {}, make('span', {}, 'normal'), ...this.normal,
        iconButton('face', 'Along the measured face (Shift+F)', () => actions.layAlongFace()),
        iconButton('points', 'Through the last three points (Shift+C)', () => actions.layThroughPoints())),
    );
    preview.onLook.listen(() => this.show());
    preview.onDesign.listen(() => this.show());
  }

  private enter(index: number): void {
    const { now } = this.plane;
    const entered = this.normal[index]!.valueAsNumber;
    if (now && Number.isFinite(entered)) this.plane.direct(now.normal.map((x, i) => (i === index ? entered : x)) as Vec3);
  }

  private show(): void {
    const { now, bounds } = this.plane;
    this.element.hidden = !now;
    if (!now) return;
    this.buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(Math.abs(now.normal[i]!) === 1)));
    if (bounds) {
      const [low, high] = positionsIn(bounds, now.normal);
      Object.assign(this.slider, { min: String(low), max: String(high), step: String((high - low) / steps || 1) });
    }
    this.slider.value = String(now.position);
    this.position.value = digits(now.position);
    this.normal.forEach((field, i) => {
      if (field !== document.activeElement) field.value = now.normal[i]!.toFixed(3);
    });
  }
}
