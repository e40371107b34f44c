// The section plane: what lies beyond it is cut off.
import { digits, iconButton, make } from './dom';
import { viewOf } from './camera';
import type { Preview } from './preview';
import type { Section } from './protocol';

const axes = ['x', 'y', 'z'] as const;

export class SectionStrip {
  readonly element = make('div', { class: 'strip', role: 'group', 'aria-label': 'Section plane', hidden: true });
  private readonly buttons = axes.map((name, i) =>
    make('button', { type: 'button', title: `Across ${name} (${name.toUpperCase()})`, on: { click: () => this.setAxis(i as 0 | 1 | 2) } }, name),
  );
  private readonly slider = make('input', { type: 'range', 'aria-label': 'Position of the section plane' });
  private readonly position = make('output');
  private last: Section['axis'] = 0;

  constructor(private readonly preview: Preview) {
    this.slider.addEventListener('input', () => {
      const section = this.section;
      if (section) this.preview.setSection({ ...section, position: this.slider.valueAsNumber }, true);
    });
    const flip = iconButton('flip', 'Other side (F)', () => this.flip());
    const close = iconButton('close', 'No section (C)', () => this.toggle());
    this.element.append(...this.buttons, this.slider, this.position, flip, close);
    preview.onLook.listen(() => this.show());
    preview.onDesign.listen(() => this.show());
  }

  get section(): Section | null {
    return this.preview.wanted.section ?? null;
  }

  toggle(): void {
    if (this.section) this.preview.setSection(null);
    else this.setAxis(this.last);
  }

  /** Cuts across the middle of the design; the side towards the eye is cut off. */
  setAxis(axis: Section['axis']): void {
    const bounds = this.preview.design?.bounds;
    const camera = this.preview.camera;
    if (!camera) return;
    this.last = axis;
    const position = bounds ? (bounds.min[axis] + bounds.max[axis]) / 2 : 0;
    this.preview.setSection({ axis, position, flipped: viewOf(camera).forward[axis] > 0 });
  }

  flip(): void {
    if (this.section) this.preview.setSection({ ...this.section, flipped: !this.section.flipped });
  }

  /** Moves the plane by a share of the design's size. */
  move(share: number): void {
    const { section } = this;
    const bounds = this.preview.design?.bounds;
    if (!section || !bounds) return;
    const low = bounds.min[section.axis];
    const high = bounds.max[section.axis];
    const position = Math.min(Math.max(section.position + share * (high - low), low), high);
    this.preview.setSection({ ...section, position }, true);
  }

  private show(): void {
    const { section } = this;
    this.element.hidden = !section;
    if (!section) return;
    this.buttons.forEach((button, i) => button.setAttribute('aria-pressed', String(i === section.axis)));
    const bounds = this.preview.design?.bounds;
    if (bounds) {
      const low = bounds.min[section.axis];
      const high = bounds.max[section.axis];
      Object.assign(this.slider, { min: String(low), max: String(high), step: String((high - low) / 500 || 1) });
    }
    this.slider.value = String(section.position);
    this.position.value = digits(section.position);
  }
}
