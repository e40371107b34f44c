// The design's text, in a browser: what an editor would show. A click on a line lights what it makes.
import type { Drawer, Sheet } from './drawer';
import { make, nameOf } from './dom';
import type { Preview } from './preview';
import type { Place } from './protocol';

export class SourceSheet implements Sheet {
  readonly name = 'source';
  title: string;
  readonly body = make('div', { class: 'source' });
  private uri: string;
  private lit = -1;
  private lines: HTMLElement[] = [];

  constructor(
    private readonly preview: Preview,
    private readonly drawer: Drawer,
  ) {
    this.uri = preview.uri;
    this.title = nameOf(this.uri);
    preview.onDesign.listen(() => this.drawer.shown === this.name && void this.load());
  }

  /** Shows a place's line. */
  async reveal(place: Place): Promise<void> {
    this.uri = place.uri;
    this.title = nameOf(place.uri);
    this.drawer.open(this);
    await this.load();
    this.lines.forEach((line, i) =>
      line.classList.toggle('revealed', i >= place.range.start.line && i <= place.range.end.line),
    );
    this.lines[place.range.start.line]?.scrollIntoView({ block: 'center' });
  }

  opened(): void {
    if (this.lines.length === 0) void this.load();
  }

  closed(): void {
    this.light(-1);
  }

  private async load(): Promise<void> {
    const text = await this.preview.source(this.uri).catch(() => null);
    if (text === null) {
      this.lines = [];
      this.body.replaceChildren(make('p', { class: 'note' }, `${nameOf(this.uri)} cannot be shown.`));
      return;
    }
    const before = this.body.scrollTop;
    this.lines = text.split(/\r?\n/).map((line, i) =>
      make(
        'button',
        { type: 'button', class: 'line', 'aria-pressed': String(i === this.lit), on: { click: () => this.light(i === this.lit ? -1 : i) } },
        make('span', { class: 'line-number' }, String(i + 1)),
        line,
      ),
    );
    this.body.replaceChildren(...this.lines);
    this.body.scrollTop = before;
  }

  /** Lights what the line's first statement makes; -1: nothing. */
  private light(line: number): void {
    if (line === this.lit) return;
    this.lit = line;
    this.lines.forEach((element, i) => element.setAttribute('aria-pressed', String(i === line)));
    if (line < 0) {
      this.preview.setCursor();
      return;
    }
    const text = this.lines[line]!.lastChild?.textContent ?? '';
    this.preview.setCursor({ uri: this.uri, position: { line, character: text.search(/\S|$/) } });
  }
}
