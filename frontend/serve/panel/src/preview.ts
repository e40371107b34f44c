// A preview of a design: what is to be drawn, what is known of the design, and the frames as they come. It outlives
// connections: whenever there is a new one, the preview is opened again as it was.
import type { Connection } from './connection';
import { RequestError } from './connection';
import type { Camera, Design, Frame, Insets, Look, Pick, Position, Value } from './protocol';
import { Signal } from './signal';

/** The view is at rest if nothing has moved it for so long. */
const rest_ms = 120;

/** What a panel keeps when it is closed and opened again. */
export interface Memory {
  look: Look;
  values: Record<string, Value>;
}

export type State = 'connecting' | 'open' | { lost: number | null } | { failed: string };

export class Preview {
  design: Design | null = null;
  state: State = 'connecting';
  readonly onDesign = new Signal<Design>();
  readonly onFrame = new Signal<{ frame: Frame; image: Blob }>();
  readonly onLook = new Signal<Look>();
  readonly onProgress = new Signal<{ stage: string; ms: number }>();
  readonly onState = new Signal<State>();

  private id: number | null = null;
  private look: Look;
  /** The parameters that have been given a value other than the design's. */
  private values: Record<string, Value>;
  /** A set has been chosen: the next design tells the values that count from then on. */
  private takesValues = false;
  private unsent: Look = {};
  private scheduled = false;
  private restTimer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly connection: Connection,
    readonly uri: string,
    memory: Memory,
  ) {
    this.look = memory.look;
    this.values = memory.values;
    connection.onOpened = () => void this.open();
    connection.onClosed = (retryIn_ms) => {
      this.id = null;
      this.setState({ lost: retryIn_ms });
    };
    connection.onNotification = (method, params) => this.take(method, params);
    connection.onFrame = (frame, image) => {
      if (frame.preview === this.id) this.takeFrame(frame, image);
    };
  }

  get memory(): Memory {
    const { width: _width, height: _height, moving: _moving, ...look } = this.look;
    return { look, values: this.values };
  }

  /** The camera; null until the first picture tells which one shows the design. */
  get camera(): Camera | null {
    return this.look.camera ?? null;
  }

  get wanted(): Readonly<Look> {
    return this.look;
  }

  retry(): void {
    this.connection.retry();
  }

  /** Changes what is drawn, with the next picture of the display. */
  change(part: Look): void {
    Object.assign(this.look, part);
    Object.assign(this.unsent, part);
    this.onLook.emit(this.look);
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.send();
    });
  }

  /** Does so while something moves. At rest the picture gets as good as it can be. */
  move(part: Look): void {
    this.change({ ...part, moving: true });
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => this.change({ moving: false }), rest_ms);
  }

  setParameters(values: Record<string, Value | null>): void {
    for (const [name, value] of Object.entries(values)) {
      if (value === null) delete this.values[name];
      else this.values[name] = value;
    }
    if (this.id !== null) this.connection.notify('scadray/parameters', { preview: this.id, values });
    this.onLook.emit(this.look);
  }

  /** Returns the camera that shows all of the design from where it is seen now, clear of the insets in pixels. */
  async viewAll(insets: Insets): Promise<void> {
    const camera = this.camera;
    if (this.id === null || !camera) return;
    const all = await this.connection.request('scadray/viewAll', { preview: this.id, camera, insets });
    this.change({ camera: all.camera });
  }

  /** Returns what is seen at a place in the picture; nothing without a connection. */
  async pick(x: number, y: number, snap = 0): Promise<Pick | null> {
    const camera = this.camera;
    if (this.id === null || !camera) return null;
    this.send(); // what is asked about is what is wanted now
    try {
      return await this.connection.request('scadray/pick', { preview: this.id, camera, x, y, snap });
    } catch (error) {
      if (error instanceof RequestError) return null;
      throw error;
    }
  }

  savePicture(path: string): Promise<{ path: string }> {
    return this.connection.request('scadray/savePicture', { preview: this.opened(), path });
  }

  exportModel(path: string): Promise<{ path: string }> {
    return this.connection.request('scadray/exportModel', { preview: this.opened(), path });
  }

  async parameterSet(action: 'choose' | 'save' | 'erase', name: string): Promise<string> {
    const { problem } = await this.connection.request('scadray/parameterSet', { preview: this.opened(), action, name });
    if (action === 'choose' && !problem) this.takesValues = true;
    return problem;
  }

  /** Returns the text of a file that the design reads. */
  async source(uri: string): Promise<string | null> {
    return (await this.connection.request('scadray/source', { preview: this.opened(), uri }))?.text ?? null;
  }

  /** Lights what the place's statement makes; without a place it draws as ever. */
  setCursor(place?: { uri: string; position: Position }): void {
    if (this.id !== null) this.connection.notify('scadray/cursor', { preview: this.id, ...place });
  }

  stop(): void {
    if (this.id !== null) this.connection.notify('scadray/stop', { preview: this.id });
  }

  /** Tells that a frame is on the screen: the next one is sent after that. */
  shown(frame: Frame): void {
    if (this.id === frame.preview) this.connection.notify('scadray/shown', { preview: this.id, number: frame.number });
  }

  private opened(): number {
    if (this.id === null) throw new RequestError(0, 'there is no connection');
    return this.id;
  }

  private async open(): Promise<void> {
    try {
      this.unsent = {};
      const look = { ...this.look, moving: false };
      const opened = await this.connection.request('scadray/openPreview', { textDocument: { uri: this.uri }, look });
      this.id = opened.preview;
      this.setState('open');
      if (Object.keys(this.values).length > 0) this.setParameters(this.values);
      if (opened.design) this.takeDesign(opened.design);
    } catch (error) {
      if (error instanceof RequestError && error.code !== 0) this.setState({ failed: error.message });
    }
  }

  private setState(state: State): void {
    this.state = state;
    this.onState.emit(state);
  }

  private send(): void {
    const look = this.unsent;
    if (this.id === null || Object.keys(look).length === 0) return; // opening sends all
    this.unsent = {};
    this.connection.notify('scadray/look', { preview: this.id, look });
  }

  private take(method: string, params: unknown): void {
    const { preview } = (params ?? {}) as { preview?: number };
    if (method === 'scadray/design') {
      const design = params as { preview: number; design: Design };
      if (preview === this.id) this.takeDesign(design.design);
    } else if (method === 'scadray/progress' && preview === this.id) {
      this.onProgress.emit(params as { stage: string; ms: number });
    }
  }

  private takeDesign(design: Design): void {
    const asked = this.design && design.camera && JSON.stringify(design.camera) !== JSON.stringify(this.design.camera);
    this.design = design;
    if (this.takesValues) {
      const changed = design.parameters.filter(({ value, default: fallback }) => JSON.stringify(value) !== JSON.stringify(fallback));
      this.values = Object.fromEntries(changed.map(({ name, value }) => [name, value]));
      this.takesValues = false;
    }
    // A camera that the design asks for anew, as in an animation, is followed.
    if (asked) this.change({ camera: design.camera! });
    this.onDesign.emit(design);
  }

  private takeFrame(frame: Frame, image: Blob): void {
    if (!this.look.camera) this.change({ camera: frame.camera });
    this.onFrame.emit({ frame, image });
  }
}
