// The design's time, $t, which runs from 0 to 1 in steps. A step that would come late is skipped.
import { digits, icon, iconButton, make } from './dom';
import type { Preview } from './preview';

const steps = 100;
const step_ms = 40;

export class AnimationStrip {
  readonly element = make('div', { class: 'strip', role: 'group', 'aria-label': 'Animation', hidden: true });
  private readonly button = iconButton('animation', 'Play (Space)', () => this.play());
  private readonly slider = make('input', { type: 'range', min: '0', max: '1', step: String(1 / steps), 'aria-label': '$t' });
  private readonly time = make('output');
  private started: { at: number; step: number } | null = null;

  constructor(private readonly preview: Preview) {
    this.slider.addEventListener('input', () => {
      this.pause();
      this.preview.move({ time: this.slider.valueAsNumber });
    });
    const close = iconButton('close', 'No animation (A)', () => this.toggle());
    this.element.append(make('div', {}, this.button, make('span', {}, '$t'), this.slider, this.time, close));
    preview.onLook.listen(({ time }) => {
      this.slider.value = String(time ?? 0);
      this.time.value = digits(time ?? 0);
    });
  }

  toggle(): void {
    this.element.hidden = !this.element.hidden;
    if (!this.element.hidden) return;
    this.pause();
    this.preview.change({ time: 0 });
  }

  play(): void {
    this.element.hidden = false;
    if (this.started) {
      this.pause();
      return;
    }
    this.started = { at: performance.now(), step: Math.round(this.slider.valueAsNumber * steps) };
    this.showButton();
    this.advance();
  }

  private pause(): void {
    this.started = null;
    this.showButton();
  }

  private showButton(): void {
    this.button.replaceChildren(icon(this.started ? 'pause' : 'animation'));
    this.button.setAttribute('aria-label', this.started ? 'Pause (Space)' : 'Play (Space)');
  }

  private advance(): void {
    if (!this.started) return;
    const passed = Math.floor((performance.now() - this.started.at) / step_ms);
    const time = ((this.started.step + passed) % steps) / steps;
    if (time !== this.preview.wanted.time) this.preview.move({ time });
    requestAnimationFrame(() => this.advance());
  }
}
