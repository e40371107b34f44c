// The design's parameters (OpenSCAD's customizer), and the sets that their values are kept in.
import type { Sheet } from './drawer';
import { iconButton, make } from './dom';
import type { Preview } from './preview';
import type { Design, Parameter, Value } from './protocol';

const equal = (a: Value, b: Value): boolean => JSON.stringify(a) === JSON.stringify(b);

/** A parameter's row. */
class Row {
  readonly element: HTMLElement;
  private value: Value;
  private readonly inputs: { show(value: Value): void }[] = [];

  constructor(
    readonly parameter: Parameter,
    private readonly set: (value: Value | null) => void,
  ) {
    this.value = parameter.value;
    const reset = iconButton('reset', `Reset ${parameter.name}`, () => {
      this.show(parameter.default);
      this.set(null);
    });
    reset.classList.add('reset');
    const name = make('span', { class: 'name' }, parameter.name);
    const note = parameter.description ? make('span', { class: 'note' }, parameter.description) : null;
    this.element = make('div', { class: 'parameter', role: 'group', 'aria-label': parameter.name });
    this.element.append(make('div', { class: 'parameter-name' }, name, note, reset), this.control());
    this.show(this.value);
  }

  /** Shows a value that has not been entered here. */
  show(value: Value): void {
    this.value = value;
    this.element.classList.toggle('changed', !equal(value, this.parameter.default));
    for (const input of this.inputs) input.show(value);
  }

  private enter(value: Value): void {
    if (equal(value, this.value)) return;
    this.show(value);
    this.set(equal(value, this.parameter.default) ? null : value);
  }

  private control(): HTMLElement {
    const { parameter } = this;
    if (parameter.choices?.length) return this.choice(parameter.choices);
    switch (parameter.kind) {
      case 'boolean':
        return this.checkbox();
      case 'text':
        return this.text();
      case 'number':
        return this.number(
          (value) => value as number,
          (entered) => entered,
          parameter.name,
        );
      case 'vector': {
        const numbers = parameter.default as number[];
        const controls = numbers.map((_, i) =>
          this.number(
            (value) => (value as number[])[i]!,
            (entered) => (this.value as number[]).map((old, j) => (i === j ? entered : old)),
            `${parameter.name}, ${i + 1} of ${numbers.length}`,
          ),
        );
        return make('div', { class: 'vector' }, ...controls);
      }
    }
  }

  private choice(choices: { value: number | string; label: string }[]): HTMLElement {
    const select = make('select', { 'aria-label': this.parameter.name });
    select.append(...choices.map(({ label }, i) => make('option', { value: String(i) }, label)));
    select.addEventListener('change', () => this.enter(choices[Number(select.value)]!.value));
    this.inputs.push({ show: (value) => (select.selectedIndex = choices.findIndex((one) => equal(one.value, value))) });
    return select;
  }

  private checkbox(): HTMLElement {
    const box = make('input', { type: 'checkbox', 'aria-label': this.parameter.name });
    box.addEventListener('change', () => this.enter(box.checked));
    this.inputs.push({ show: (value) => (box.checked = value as boolean) });
    return box;
  }

  private text(): HTMLElement {
    const field = make('input', { type: 'text', 'aria-label': this.parameter.name });
    if (this.parameter.length !== undefined) field.maxLength = this.parameter.length;
    field.addEventListener('input', () => this.enter(field.value));
    this.inputs.push({ show: (value) => field.value !== value && (field.value = value as string) });
    return field;
  }

  /** One number: a slider if it has a range, and a field. */
  private number(get: (value: Value) => number, put: (entered: number) => Value, label: string): HTMLElement {
    const { parameter } = this;
    const limits: Record<string, string> = { step: String(parameter.step ?? 'any') };
    if (parameter.min !== undefined) limits['min'] = String(parameter.min);
    if (parameter.max !== undefined) limits['max'] = String(parameter.max);
    const field = make('input', { type: 'number', 'aria-label': label, ...limits });
    field.step = 'any'; // what is typed need not lie on the grid
    field.addEventListener('input', () => {
      if (field.value !== '' && Number.isFinite(field.valueAsNumber)) this.enter(put(field.valueAsNumber));
    });
    this.inputs.push({
      show: (value) => field.valueAsNumber !== get(value) && (field.value = String(get(value))),
    });
    if (parameter.min === undefined || parameter.max === undefined) return field;
    const slider = make('input', { type: 'range', 'aria-label': label, ...limits });
    slider.addEventListener('input', () => this.enter(put(slider.valueAsNumber)));
    this.inputs.push({ show: (value) => (slider.value = String(get(value))) });
    return make('div', { class: 'number' }, slider, field);
  }
}

export class ParametersSheet implements Sheet {
  readonly name = 'parameters';
  readonly title = 'Parameters';
  readonly body = make('div', { class: 'parameters' });
  private readonly list = make('div');
  private readonly sets = make('select', { 'aria-label': 'Set of values' });
  private readonly setName = make('input', { type: 'text', placeholder: 'name of a set', 'aria-label': 'Name of a set' });
  private readonly problem = make('p', { class: 'problem', role: 'alert', hidden: true });
  private rows: Row[] = [];
  private form = '';

  constructor(private readonly preview: Preview) {
    this.sets.addEventListener('change', () => void this.act('choose', this.sets.value));
    const save = make('button', { type: 'button', on: { click: () => void this.act('save', this.setName.value.trim()) } }, 'Save');
    const erase = make('button', { type: 'button', on: { click: () => void this.act('erase', this.sets.value) } }, 'Erase');
    const reset = make('button', { type: 'button', on: { click: () => this.resetAll() } }, 'Reset all');
    const sets = make(
      'details',
      { class: 'sets' },
      make('summary', {}, 'Sets'),
      make('div', {}, this.sets, erase),
      make('div', {}, this.setName, save),
      this.problem,
    );
    this.body.append(sets, this.list, make('div', { class: 'foot' }, reset));
    preview.onDesign.listen((design) => this.show(design));
  }

  private async act(action: 'choose' | 'save' | 'erase', name: string): Promise<void> {
    if (action !== 'choose' && name === '') return;
    const problem = await this.preview.parameterSet(action, name).catch((error: Error) => error.message);
    this.problem.textContent = problem;
    this.problem.hidden = problem === '';
    if (action === 'save' && !problem) this.setName.value = '';
  }

  private resetAll(): void {
    const changed = this.rows.filter((row) => row.element.classList.contains('changed'));
    for (const row of changed) row.show(row.parameter.default);
    this.preview.setParameters(Object.fromEntries(changed.map((row) => [row.parameter.name, null])));
  }

  private show(design: Design): void {
    this.sets.replaceChildren(make('option', { value: '' }, 'design’s defaults'));
    this.sets.append(...design.sets.map((name) => make('option', { value: name }, name)));
    this.sets.value = design.set;
    // A newer version mostly has the same parameters: what is being entered stays then.
    const form = JSON.stringify(design.parameters.map(({ value: _value, ...rest }) => rest));
    if (form === this.form) {
      design.parameters.forEach((parameter, i) => {
        const row = this.rows[i]!;
        if (!row.element.contains(document.activeElement)) row.show(parameter.value);
      });
      return;
    }
    this.form = form;
    this.rows = design.parameters.map(
      (parameter) => new Row(parameter, (value) => this.preview.setParameters({ [parameter.name]: value })),
    );
    const groups = new Map<string, HTMLElement[]>();
    for (const row of this.rows) {
      const { group } = row.parameter;
      groups.set(group, [...(groups.get(group) ?? []), row.element]);
    }
    this.list.replaceChildren(
      ...[...groups].map(([group, rows]) =>
        group ? make('details', { open: true }, make('summary', {}, group), ...rows) : make('div', {}, ...rows),
      ),
    );
    if (this.rows.length === 0) this.list.append(make('p', { class: 'note' }, 'The design has no parameters.'));
  }
}
