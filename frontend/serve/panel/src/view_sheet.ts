// The sheet of what is seen from where, and how it is drawn.
import type { StandardView } from './camera';
import type { Commands } from './commands';
import type { Sheet } from './drawer';
import { make } from './dom';
import type { Preview } from './preview';

export const colorSchemes = [
  'Cornfield', 'Metallic', 'Sunset', 'Starnight', 'BeforeDawn', 'Nature', 'Daylight Gem', 'Nocturnal Gem', 'DeepOcean',
  'Solarized', 'Tomorrow', 'Tomorrow Night', 'ClearSky', 'Monotone',
];

const directions: StandardView[] = ['top', 'bottom', 'front', 'back', 'left', 'right', 'diagonal'];

export class ViewSheet implements Sheet {
  readonly name = 'view';
  readonly title = 'View';
  readonly body = make('div', { class: 'view' });

  constructor(
    preview: Preview,
    private readonly commands: Commands,
  ) {
    const orthographic = this.checkbox('orthographic');
    const switches = ['axes', 'edges', 'studio'].map((name) => this.checkbox(name));
    const colors = make('select', { 'aria-label': 'Colours' }, ...colorSchemes.map((name) => make('option', {}, name)));
    colors.addEventListener('change', () => preview.change({ colorscheme: colors.value }));
    preview.onLook.listen(({ colorscheme }) => {
      for (const { show } of [orthographic, ...switches]) show();
      colors.value = colorscheme ?? colorSchemes[0]!;
    });
    this.body.append(
      make('div', { class: 'directions' }, ...directions.map((name) => this.button(name)), this.button('all')),
      orthographic.element,
      ...switches.map(({ element }) => element),
      make('label', { class: 'choice' }, 'Colours', colors),
      make('div', { class: 'foot' }, this.button('picture'), this.button('model'), this.button('help')),
    );
  }

  private button(name: string): HTMLElement {
    const { label, keys, run } = this.commands.named(name);
    return make('button', { type: 'button', title: keys.join(', '), on: { click: run } }, label);
  }

  private checkbox(name: string): { element: HTMLElement; show(): void } {
    const command = this.commands.named(name);
    const box = make('input', { type: 'checkbox', on: { change: () => command.run() } });
    const show = () => (box.checked = command.isOn?.() ?? false);
    show();
    return { element: make('label', { class: 'switch' }, box, command.label), show };
  }
}
