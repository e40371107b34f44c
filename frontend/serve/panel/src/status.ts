// The line at the picture's foot: what is drawn and what takes long, and that the connection is lost.
import { make } from './dom';
import type { Preview } from './preview';

export class Status {
  readonly element = make('div', { class: 'status', role: 'status' });
  private readonly text = make('span');
  private readonly notice = make('span', { class: 'notice' });
  private readonly button = make('button', { type: 'button', class: 'link', hidden: true });
  private frame = '';
  private progress = '';
  private pressed: () => void = () => {};

  constructor(private readonly preview: Preview) {
    this.button.addEventListener('click', () => this.pressed());
    this.element.append(this.text, this.button, this.notice);
    preview.onState.listen(() => this.show());
    preview.onProgress.listen(({ stage, ms }) => {
      this.progress = stage && `${stage}, ${(ms / 1000).toFixed(0)} s`;
      this.show();
    });
    preview.onFrame.listen(({ frame }) => {
      this.frame = `${frame.width} × ${frame.height}, ${frame.ms.toFixed(frame.ms < 10 ? 1 : 0)} ms`;
      this.show();
    });
    preview.onDesign.listen(() => this.say(''));
    for (const begun of ['pointerdown', 'keydown']) addEventListener(begun, () => this.say(''), true);
    this.show();
  }

  /** Tells the outcome of the last action, until the next one. */
  say(notice: string): void {
    this.notice.textContent = notice;
  }

  private show(): void {
    const { state } = this.preview;
    this.element.classList.toggle('lost', typeof state === 'object');
    let button: [string, () => void] | null = null;
    if (state === 'connecting') {
      this.text.textContent = 'connecting …';
    } else if (state !== 'open') {
      this.text.textContent = 'lost' in state ? 'The connection to scadray is lost.' : state.failed;
      button = ['Try again', () => this.preview.retry()];
    } else if (this.progress) {
      this.text.textContent = this.progress;
      button = ['Stop', () => this.preview.stop()];
    } else {
      this.text.textContent = this.frame;
    }
    this.button.hidden = !button;
    if (button) [this.button.textContent, this.pressed] = button;
  }
}
