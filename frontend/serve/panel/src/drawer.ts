// The sheet beside the picture, or below it where that is narrow: one thing is shown in it at a time.
import { iconButton, make } from './dom';
import type { Insets } from './protocol';
import { Signal } from './signal';

export interface Sheet {
  name: string;
  title: string;
  body: HTMLElement;
  opened?(): void;
  closed?(): void;
}

export class Drawer {
  readonly element = make('aside', { class: 'drawer', hidden: true });
  readonly onChange = new Signal<string | null>();
  private sheet: Sheet | null = null;

  constructor(private readonly returnFocus: () => void) {
    this.element.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      event.stopPropagation();
      this.close();
    });
  }

  get shown(): string | null {
    return this.sheet?.name ?? null;
  }

  open(sheet: Sheet): void {
    if (this.sheet !== sheet) this.sheet?.closed?.();
    this.sheet = sheet;
    const title = make('h2', { tabIndex: -1 }, sheet.title);
    const close = iconButton('close', 'Close (Esc)', () => this.close());
    this.element.replaceChildren(make('header', {}, title, close), sheet.body);
    this.element.setAttribute('aria-label', sheet.title);
    this.element.hidden = false;
    sheet.opened?.();
    title.focus();
    this.onChange.emit(sheet.name);
  }

  close(): void {
    if (!this.sheet) return;
    this.sheet.closed?.();
    this.sheet = null;
    this.element.hidden = true;
    this.returnFocus();
    this.onChange.emit(null);
  }

  toggle(sheet: Sheet): void {
    if (this.sheet === sheet) this.close();
    else this.open(sheet);
  }

  /** What it hides of the picture, in pixels of the page. */
  insets(picture: HTMLElement): Insets {
    const insets = { left: 0, top: 0, right: 0, bottom: 0 };
    if (!this.sheet) return insets;
    const box = this.element.getBoundingClientRect();
    const all = picture.getBoundingClientRect();
    if (box.width < 0.7 * all.width) insets.right = all.right - box.left;
    else insets.bottom = all.bottom - box.top;
    return insets;
  }
}
