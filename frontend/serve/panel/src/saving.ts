// Asks for the path of a picture or a model that the server is to write.
import type { Drawer, Sheet } from './drawer';
import { make, nameOf } from './dom';
import type { Preview } from './preview';
import type { Status } from './status';

export class SaveSheet implements Sheet {
  readonly name: string;
  readonly title: string;
  readonly body: HTMLElement;
  private readonly path = make('input', { type: 'text', 'aria-label': 'Path', spellcheck: false });
  private readonly problem = make('p', { class: 'problem', role: 'alert', hidden: true });

  constructor(
    private readonly what: 'picture' | 'model',
    private readonly preview: Preview,
    private readonly drawer: Drawer,
    private readonly status: Status,
  ) {
    this.name = `save ${what}`;
    this.title = what === 'picture' ? 'Save picture' : 'Export';
    const note =
      what === 'picture'
        ? 'A PNG of the picture as it is shown.'
        : 'By its suffix: .stl, .off, .obj, .3mf or .amf; of a plane figure .svg, .dxf or .pdf.';
    const write = make('button', { type: 'submit', class: 'primary' }, what === 'picture' ? 'Save' : 'Export');
    this.body = make(
      'form',
      { class: 'save', on: { submit: (event) => this.write(event) } },
      make('label', {}, 'File, beside the design or with its whole path', this.path),
      make('p', { class: 'note' }, note),
      this.problem,
      write,
    );
  }

  opened(): void {
    if (this.path.value) return;
    const suffixes = this.what === 'picture' ? ['.png'] : this.preview.design?.plane ? ['.svg', '.dxf'] : ['.stl', '.3mf'];
    // A mesh or a drawing that is shown is not to be replaced by what it is exported to.
    const design = nameOf(this.preview.uri);
    const names = suffixes.map((suffix) => design.replace(/\.[^.]*$/, '') + suffix);
    this.path.value = names.find((name) => name !== design)!;
  }

  private write(event: Event): void {
    event.preventDefault();
    const path = this.path.value.trim();
    if (!path) return;
    this.problem.hidden = true;
    this.status.say(`${path} is being written …`);
    const written = this.what === 'picture' ? this.preview.savePicture(path) : this.preview.exportModel(path);
    written.then(
      ({ path: where }) => {
        this.status.say(`${where} is written`);
        if (this.drawer.shown === this.name) this.drawer.close();
      },
      (error: Error) => {
        this.status.say('');
        this.problem.textContent = error.message;
        this.problem.hidden = false;
      },
    );
  }
}
