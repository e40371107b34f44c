// Makes elements of the page.

type Child = Node | string | null;
type Properties = {
  class?: string;
  on?: { [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
} & Record<string, unknown>;

/** Makes an element. Properties with a dash (aria-…, data-…) and role are attributes. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === 'on') {
      for (const [event, listener] of Object.entries(value as object)) {
        element.addEventListener(event, listener as EventListener);
      }
    } else if (name === 'class') element.className = value as string;
    else if (name === 'role' || name === 'for' || name.includes('-')) element.setAttribute(name, String(value));
    else Reflect.set(element, name, value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** Paths of 24 by 24 units, drawn as lines. */
const icons = {
  views: 'M12 3 20 7.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9',
  all: 'M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5M9 9h6v6H9z',
  section: 'M5 8l7-4 7 4v8l-7 4-7-4zM3 17 21 7',
  parameters: 'M4 7h9M17 7h3M4 17h3M11 17h9M15 5v4M9 15v4',
  messages: 'M4 5h16v11H9l-5 4zM8 9h8M8 12h5',
  animation: 'M8 5l11 7-11 7z',
  pause: 'M8 5v14M16 5v14',
  source: 'M9 7l-5 5 5 5M15 7l5 5-5 5',
  more: 'M5 12h.01M12 12h.01M19 12h.01',
  close: 'M6 6l12 12M18 6 6 18',
  face: 'M3 18 8 12h13l-5 6zM12 12V3M12 3 9.5 6M12 3l2.5 3',
  points: 'M5 18h.01M20 15h.01M11 5h.01M7 16l3-8M13 7l5.5 6.5M7.5 17.5l10-2',
  flip: 'M7 4v16M7 4 4 7M7 4l3 3M17 20V4M17 20l-3-3M17 20l3-3',
  reset: 'M5 5v5h5M5.5 10a7 7 0 1 1-.5 4',
} as const;

export type Icon = keyof typeof icons;

export function icon(name: Icon): SVGSVGElement {
  const svg = svgElement('svg', { viewBox: '0 0 24 24', 'aria-hidden': 'true', class: 'icon' });
  svg.append(svgElement('path', { d: icons[name] }));
  return svg;
}

export function svgElement<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

export function iconButton(name: Icon, label: string, press: () => void): HTMLButtonElement {
  return make('button', { type: 'button', class: 'icon-button', title: label, 'aria-label': label, on: { click: press } }, icon(name));
}

/** Returns a number with six digits, as the window shows it. */
export function digits(x: number): string {
  return String(Number(x.toPrecision(6)) || 0);
}

/** Returns a file's name, of its URI. */
export function nameOf(uri: string): string {
  return decodeURIComponent(uri.slice(uri.lastIndexOf('/') + 1));
}
