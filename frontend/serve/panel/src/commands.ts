// What keys, menus and buttons do. The keys are the window's (frontend/window/README.md) where the browser has no other
// use for them.
import { make } from './dom';

export interface Command {
  name: string;
  label: string;
  keys: string[];
  run(): void;
  /** Whether it is on, of what can be switched. */
  isOn?(): boolean;
}

/** Returns a key's name as the table of commands has it: "c", "Shift+l", "Home", "?". */
export function keyOf(event: KeyboardEvent): string {
  const { key } = event;
  // Of a sign shift is a part: "?" and "+" need no name of it.
  const isSign = key.length === 1 && key.toLowerCase() === key.toUpperCase();
  const shift = event.shiftKey && (!isSign || key === ' ') ? 'Shift+' : '';
  const other = (event.ctrlKey ? 'Ctrl+' : '') + (event.altKey ? 'Alt+' : '') + (event.metaKey ? 'Meta+' : '');
  return other + shift + (key.length === 1 ? key.toLowerCase() : key);
}

/** Returns whether an element takes the keys itself: what is typed, or what arrows move. */
function takesKeys(element: Element | null, key: string): boolean {
  if (!element) return false;
  if (element.matches('textarea, select, input:not([type=checkbox], [type=range])')) return true;
  if (element.matches('input[type=range]')) return /^(Shift\+)?(Arrow|Page|Home|End)/.test(key);
  return element.matches('button, summary, input, [href]') && (key === 'Enter' || key === ' ');
}

export class Commands {
  constructor(private readonly commands: Command[]) {
    addEventListener('keydown', (event) => {
      const key = keyOf(event);
      if (event.defaultPrevented || takesKeys(document.activeElement, key)) return;
      const command = commands.find((row) => row.keys.includes(key));
      if (!command) return;
      event.preventDefault();
      command.run();
    });
  }

  named(name: string): Command {
    const command = this.commands.find((row) => row.name === name);
    if (!command) throw new Error(`no command ${name}`);
    return command;
  }

  /** Lists keys, for the help: those of equal labels once. */
  list(): HTMLElement {
    const keysOf = new Map<string, string[]>();
    for (const { label, keys } of this.commands) keysOf.set(label, [...(keysOf.get(label) ?? []), ...keys]);
    const rows = [...keysOf].map(([label, keys]) =>
      make('tr', {}, make('td', {}, ...keys.map((key) => make('kbd', {}, keyText(key)))), make('td', {}, label)),
    );
    return make('table', { class: 'keys' }, make('tbody', {}, ...rows));
  }
}

function keyText(key: string): string {
  const arrows: Record<string, string> = { ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', ' ': 'Space' };
  return key
    .split(/(?<=.)\+/)
    .map((part) => arrows[part] ?? (part.length === 1 ? part.toUpperCase() : part))
    .join('+');
}
