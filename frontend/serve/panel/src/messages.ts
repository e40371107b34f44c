// What the design's evaluation has said; and its error over the picture.
import type { Sheet } from './drawer';
import { make, nameOf } from './dom';
import type { Preview } from './preview';
import type { Design, Message, Place } from './protocol';

const severities = ['', 'error', 'warning', 'information', 'hint'] as const;

/** Returns equal messages once, with their number. */
export function counted(messages: Message[]): { message: Message; count: number }[] {
  const found = new Map<string, { message: Message; count: number }>();
  for (const message of messages) {
    const key = JSON.stringify(message);
    const one = found.get(key) ?? { message, count: 0 };
    one.count++;
    found.set(key, one);
  }
  return [...found.values()];
}

function placeOf(message: Message): Place | null {
  return message.uri !== undefined && message.range ? { uri: message.uri, range: message.range } : null;
}

/** Returns a message in OpenSCAD's words. */
const wordsOf = ({ group, text }: Message): string => (group ? `${group}: ${text}` : text);

/** Makes a message's line. A click on it opens its place. */
function line(message: Message, count: number, reveal: (place: Place) => void): HTMLElement {
  const place = placeOf(message);
  const parts = [
    make('span', { class: 'text' }, wordsOf(message)),
    count > 1 ? make('span', { class: 'count' }, `${count}×`) : null,
    place ? make('span', { class: 'place' }, `${nameOf(place.uri)}:${place.range.start.line + 1}`) : null,
  ];
  const name = severities[message.severity];
  if (!place) return make('div', { class: `message ${name}` }, ...parts);
  return make('button', { type: 'button', class: `message ${name}`, on: { click: () => reveal(place) } }, ...parts);
}

export class MessagesSheet implements Sheet {
  readonly name = 'messages';
  readonly title = 'Messages';
  readonly body = make('div', { class: 'messages' });
  /** The design's errors, over its last good picture. */
  readonly banner = make('div', { class: 'banner', role: 'alert', hidden: true });
  private readonly filter = make('input', { type: 'search', placeholder: 'filter', 'aria-label': 'Filter' });
  private readonly list = make('ul');
  private messages: Message[] = [];

  constructor(
    preview: Preview,
    private readonly reveal: (place: Place) => void,
  ) {
    this.body.append(this.filter, this.list);
    this.filter.addEventListener('input', () => this.showList());
    preview.onDesign.listen((design) => this.show(design));
  }

  get count(): number {
    return this.messages.length;
  }

  get hasErrors(): boolean {
    return this.messages.some((message) => message.severity === 1);
  }

  private show(design: Design): void {
    this.messages = design.messages;
    this.showList();
    const errors = counted(design.messages.filter((message) => message.severity === 1));
    this.banner.hidden = errors.length === 0;
    this.banner.replaceChildren(...errors.slice(0, 3).map(({ message, count }) => line(message, count, this.reveal)));
    if (errors.length > 3) this.banner.append(make('div', { class: 'note' }, `and ${errors.length - 3} more`));
  }

  private showList(): void {
    const wanted = this.filter.value.toLowerCase();
    const shown = counted(this.messages.filter((message) => wordsOf(message).toLowerCase().includes(wanted)));
    this.list.replaceChildren(...shown.map(({ message, count }) => make('li', {}, line(message, count, this.reveal))));
    if (shown.length === 0) this.list.append(make('li', { class: 'note' }, 'Nothing has been said.'));
  }
}
