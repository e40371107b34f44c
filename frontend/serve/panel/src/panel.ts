// Puts the panel together.
import { AnimationStrip } from './animation';
import type { StandardView } from './camera';
import { lookFrom, pan, standardViews, turnBy, zoom } from './camera';
import { Commands } from './commands';
import type { Command } from './commands';
import { Connection } from './connection';
import { Drawer } from './drawer';
import type { Sheet } from './drawer';
import { iconButton, make, nameOf } from './dom';
import type { Icon } from './dom';
import { hostOf } from './host';
import { Measuring } from './measuring';
import { MessagesSheet } from './messages';
import { ParametersSheet } from './parameters';
import { Picture } from './picture';
import { PointerInput } from './pointer';
import { Preview } from './preview';
import type { Camera, Place } from './protocol';
import { SaveSheet } from './saving';
import { SectionStrip } from './section';
import { SectionPlane, axes } from './section_plane';
import { SourceSheet } from './source';
import { Status } from './status';
import { followTheme, schemeOfTheme } from './theme';
import { ViewSheet } from './view_sheet';

const keyTurn_deg = 5;
const keyPan = 0.05; // of the picture's height
const keySection = 0.02; // of the design's size

const uri = document.querySelector<HTMLMetaElement>('meta[name=scadray-design]')!.content;
const host = hostOf(uri);
const connection = new Connection(host.transport);
const memory = host.recall();
const preview = new Preview(connection, uri, {
  look: { shading: 'studio', axes: false, edges: true, colorscheme: schemeOfTheme(), ...memory.look },
  values: memory.values,
});
followTheme(preview);

const pictureElement = make('div', {
  class: 'picture',
  tabIndex: 0,
  role: 'application',
  'aria-label': `Preview of ${nameOf(uri)}. Arrows turn it, + and − zoom, ? lists the keys.`,
});
const picture = new Picture(pictureElement, preview);
const drawer = new Drawer(() => pictureElement.focus());
const source = new SourceSheet(preview, drawer);
const reveal = host.reveal ?? ((place: Place) => void source.reveal(place));
const status = new Status(preview);
const messages = new MessagesSheet(preview, reveal);
const parameters = new ParametersSheet(preview);
const section = new SectionPlane(preview);
const sectionStrip = new SectionStrip(preview, section, { layAlongFace, layThroughPoints });
const animation = new AnimationStrip(preview);
const measuring = new Measuring(preview, picture, reveal);
const saving = { picture: new SaveSheet('picture', preview, drawer, status), model: new SaveSheet('model', preview, drawer, status) };

/** Moves the camera as long as something changes it. */
function move(change: (camera: Camera) => Camera): void {
  if (preview.camera) preview.move({ camera: change(preview.camera) });
}
/** Changes the camera at once. */
function set(change: (camera: Camera) => Camera): void {
  if (preview.camera) preview.change({ camera: change(preview.camera) });
}
const middle = () => [picture.size.width / 2, picture.size.height / 2] as const;

function write(what: 'picture' | 'model'): void {
  if (host.write) host.write(what);
  else drawer.open(saving[what]);
}

function viewAll(): void {
  const insets = drawer.insets(pictureElement);
  const { scale } = picture;
  const inPixels = { left: insets.left * scale, top: insets.top * scale, right: insets.right * scale, bottom: insets.bottom * scale };
  preview.viewAll(inPixels).catch((error: Error) => status.say(error.message));
}

function layAlongFace(): void {
  if (measuring.face) section.layAcross(measuring.face);
  else status.say('Click on a flat face first: the section plane is laid along it.');
}

function layThroughPoints(): void {
  const [a, b, c] = measuring.lastPlaces;
  if (!a || !b || !c) status.say('Click on three points first: the section plane is laid through them.');
  else if (!section.layThrough([a, b, c])) status.say('The three points lie on a line: they give no section plane.');
}

/** Ends the nearest of what can be ended. */
function escape(): void {
  if (drawer.shown) drawer.close();
  else if (!measuring.isEmpty) measuring.forget();
  else preview.stop();
}

const directionKeys: Record<StandardView, string> = { diagonal: '0', top: '4', bottom: '5', left: '6', right: '7', front: '8', back: '9' };
const capital = (text: string) => text[0]!.toUpperCase() + text.slice(1);
const arrows = [['Left', -1, 0], ['Right', 1, 0], ['Up', 0, 1], ['Down', 0, -1]] as const;

const table: Command[] = [
  { name: 'all', label: 'View all', keys: ['v', 'Home'], run: viewAll },
  { name: 'center', label: 'Centre', keys: ['Shift+Home'], run: () => set((camera) => ({ ...camera, translation: [0, 0, 0] })) },
  { name: 'zoom in', label: 'Zoom in', keys: ['+', '='], run: () => move((camera) => zoom(camera, 1, ...middle(), picture.size)) },
  { name: 'zoom out', label: 'Zoom out', keys: ['-'], run: () => move((camera) => zoom(camera, -1, ...middle(), picture.size)) },
  ...(Object.keys(standardViews) as StandardView[]).map((name) => ({
    name,
    label: capital(name),
    keys: [directionKeys[name]],
    run: () => set((camera) => lookFrom(camera, name)),
  })),
  { name: 'perspective', label: 'Perspective', keys: ['p'], run: () => set((camera) => ({ ...camera, projection: 'perspective' })) },
  {
    name: 'orthographic',
    label: 'Orthographic',
    keys: ['o'],
    run: () => set((camera) => ({ ...camera, projection: camera.projection === 'ortho' ? 'perspective' : 'ortho' })),
    isOn: () => preview.camera?.projection === 'ortho',
  },
  ...arrows.flatMap(([name, right, up]) => [
    { name: `turn ${name}`, label: 'Turn', keys: [`Arrow${name}`], run: () => move((camera) => turnBy(camera, up * keyTurn_deg, -right * keyTurn_deg)) },
    {
      name: `pan ${name}`,
      label: 'Pan',
      keys: [`Shift+Arrow${name}`],
      run: () => {
        const step = keyPan * picture.size.height;
        move((camera) => pan(camera, right * step, -up * step, picture.size));
      },
    },
  ]),
  { name: 'edges', label: 'Edges', keys: ['1'], run: () => preview.change({ edges: !preview.wanted.edges }), isOn: () => preview.wanted.edges === true },
  { name: 'axes', label: 'Axes', keys: ['2'], run: () => preview.change({ axes: !preview.wanted.axes }), isOn: () => preview.wanted.axes === true },
  {
    name: 'studio',
    label: 'Studio’s light',
    keys: ['l'],
    run: () => preview.change({ shading: preview.wanted.shading === 'studio' ? 'flat' : 'studio' }),
    isOn: () => preview.wanted.shading === 'studio',
  },
  { name: 'section', label: 'Section plane', keys: ['c'], run: () => section.toggle(), isOn: () => section.now !== null },
  ...Object.entries(axes).map(([name, axis]) => ({ name, label: `Section across ${name}`, keys: [name], run: () => section.layAcross(axis) })),
  { name: 'section face', label: 'Section along the measured face', keys: ['Shift+f'], run: layAlongFace },
  { name: 'section points', label: 'Section through the last three points', keys: ['Shift+c'], run: layThroughPoints },
  ...arrows.map(([name, right, up]) => ({
    name: `section ${name}`,
    label: 'Turn the section plane',
    keys: [`Ctrl+Arrow${name}`],
    run: () => section.turn(up * keyTurn_deg, right * keyTurn_deg),
  })),
  { name: 'flip', label: 'Other side of the section', keys: ['f'], run: () => section.flip() },
  { name: 'section up', label: 'Move the section plane', keys: ['PageUp'], run: () => section.move(keySection) },
  { name: 'section down', label: 'Move the section plane', keys: ['PageDown'], run: () => section.move(-keySection) },
  { name: 'measure', label: 'Measure the point in the middle', keys: ['Enter'], run: () => void measuring.measure(...middle(), true) },
  { name: 'open', label: 'Open the place of the measured point', keys: ['e'], run: () => measuring.open() },
  { name: 'view', label: 'View', keys: ['w'], run: () => drawer.toggle(viewSheet) },
  { name: 'parameters', label: 'Parameters', keys: ['Shift+p'], run: () => drawer.toggle(parameters) },
  { name: 'messages', label: 'Messages', keys: ['m'], run: () => drawer.toggle(messages) },
  ...(host.reveal ? [] : [{ name: 'source', label: 'Source', keys: ['t'], run: () => drawer.toggle(source) }]),
  { name: 'animation', label: 'Animation', keys: ['a'], run: () => animation.toggle() },
  { name: 'play', label: 'Play and pause the animation', keys: [' '], run: () => animation.play() },
  { name: 'picture', label: 'Save picture…', keys: ['s'], run: () => write('picture') },
  { name: 'model', label: 'Export…', keys: ['Shift+s'], run: () => write('model') },
  { name: 'escape', label: 'Close; forget the measured points; stop', keys: ['Escape'], run: escape },
  { name: 'help', label: 'Mouse and keys', keys: ['?', 'h'], run: () => drawer.toggle(help) },
];
const commands = new Commands(table);
const viewSheet = new ViewSheet(preview, commands);
host.listen?.((name) => commands.named(name).run());

const gestures: [string, string][] = [
  ['Left drag, one finger', 'Turn; with shift about y'],
  ['Right drag, two fingers', 'Pan'],
  ['Wheel, pinch', 'Zoom'],
  ['Middle drag, shift + right drag', 'Forward and back'],
  ['Click, tap', 'Measure a point and find its place; with alt not the corner or edge next to it'],
  ['Double click, double tap', 'Centre on the point'],
  ['Right click', 'Copy what is measured'],
  ['Ctrl + left drag', 'Drag the section plane; with shift turn it'],
];
const help: Sheet = {
  name: 'help',
  title: 'Mouse and keys',
  body: make(
    'div',
    { class: 'help' },
    make('table', { class: 'keys' }, make('tbody', {}, ...gestures.map(([what, does]) => make('tr', {}, make('td', {}, what), make('td', {}, does))))),
    commands.list(),
  ),
};

/** Makes a button of the toolbar for a command. */
function tool(iconName: Icon, name: string): HTMLButtonElement {
  const { label, keys, run } = commands.named(name);
  return iconButton(iconName, `${label} (${keys.map((key) => (key.length === 1 ? key.toUpperCase() : key)).join(', ')})`, run);
}
const tools = {
  all: tool('all', 'all'),
  view: tool('views', 'view'),
  section: tool('section', 'section'),
  animation: tool('animation', 'animation'),
  parameters: tool('parameters', 'parameters'),
  source: host.reveal ? null : tool('source', 'source'),
  messages: tool('messages', 'messages'),
};
const toolbar = make('div', { class: 'toolbar', role: 'toolbar', 'aria-label': 'Preview' }, ...Object.values(tools));
const badge = make('span', { class: 'badge' });
tools.messages.append(badge);

drawer.onChange.listen((shown) => {
  for (const name of ['view', 'parameters', 'messages', 'source'] as const) {
    tools[name]?.setAttribute('aria-expanded', String(shown === name));
  }
});
preview.onLook.listen(() => {
  tools.section.setAttribute('aria-pressed', String(section.now !== null));
  host.remember(preview.memory);
});
preview.onDesign.listen((design) => {
  tools.animation.hidden = !design.animated;
  tools.parameters.hidden = design.parameters.length === 0;
  badge.textContent = messages.count > 0 ? String(messages.count) : '';
  badge.classList.toggle('error', messages.hasErrors);
  document.title = `${messages.hasErrors ? 'error: ' : ''}${nameOf(uri)}`;
});
tools.animation.hidden = true;
tools.parameters.hidden = true;

new PointerInput(picture, preview, section, {
  measure: (x, y, snaps) => void measuring.measure(x, y, snaps),
  center: (x, y) => {
    measuring.forget();
    void preview.pick(x, y).then((pick) => {
      measuring.forget(); // the first of the two clicks has measured a point
      if (pick) set((camera) => ({ ...camera, translation: pick.position }));
    });
  },
  copy: () => measuring.copy(),
  hover: (place) => void measuring.hover(place),
});

document.body.append(
  pictureElement,
  make('div', { class: 'notes' }, messages.banner, measuring.element),
  toolbar,
  drawer.element,
  make('div', { class: 'strips' }, sectionStrip.element, animation.element, status.element),
  measuring.hovered,
);
connection.start();
