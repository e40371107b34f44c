// As much of VS Code's API as the extension and its language client use, without an editor. What the extension registers,
// posts and shows can be read, and a test plays the user and the webview.
import { EventEmitter as NodeEmitter } from 'node:events';
import { pathToFileURL } from 'node:url';

export class Disposable {
  constructor(private readonly end: () => void = () => {}) {}
  static from(...all: { dispose(): void }[]): Disposable {
    return new Disposable(() => all.forEach((one) => one.dispose()));
  }
  dispose(): void {
    this.end();
  }
}

export class EventEmitter<T> {
  private readonly emitter = new NodeEmitter().setMaxListeners(0);
  readonly event = (listener: (value: T) => unknown, self?: unknown, into?: Disposable[]): Disposable => {
    const bound = self ? listener.bind(self) : listener;
    this.emitter.on('event', bound);
    const disposable = new Disposable(() => this.emitter.off('event', bound));
    into?.push(disposable);
    return disposable;
  };
  fire(value: T): void {
    this.emitter.emit('event', value);
  }
  dispose(): void {
    this.emitter.removeAllListeners();
  }
}

export class Uri {
  private constructor(
    readonly scheme: string,
    readonly path: string,
  ) {}
  static file(path: string): Uri {
    return new Uri('file', path);
  }
  static parse(text: string): Uri {
    const [, scheme, path] = /^([a-z-]+):(?:\/\/)?(.*)$/.exec(text)!;
    return new Uri(scheme!, decodeURIComponent(path!));
  }
  static joinPath(base: Uri, ...parts: string[]): Uri {
    return new Uri(base.scheme, [base.path, ...parts].join('/'));
  }
  with({ path }: { path: string }): Uri {
    return new Uri(this.scheme, path);
  }
  get fsPath(): string {
    return this.path;
  }
  toString(): string {
    return this.scheme === 'file' ? pathToFileURL(this.path).href : `${this.scheme}:${this.path}`;
  }
}

export class Position {
  constructor(
    readonly line: number,
    readonly character: number,
  ) {}
}

export class Range {
  readonly start: Position;
  readonly end: Position;
  constructor(...numbers: [number, number, number, number] | [Position, Position]) {
    const [a, b, c, d] = numbers;
    this.start = a instanceof Position ? a : new Position(a, b as number);
    this.end = a instanceof Position ? (b as Position) : new Position(c!, d!);
  }
}
export class Selection extends Range {
  get active(): Position {
    return this.end;
  }
}

export class Diagnostic {
  constructor(
    readonly range: Range,
    readonly message: string,
    readonly severity: number,
  ) {}
}

export class Document {
  version = 1;
  readonly languageId = 'scad';
  readonly isClosed = false;
  constructor(
    readonly uri: Uri,
    private text: string,
  ) {}
  get fileName(): string {
    return this.uri.path;
  }
  getText(): string {
    return this.text;
  }
  set(text: string): void {
    this.text = text;
    this.version++;
  }
}

/** A webview, whose page the test plays. */
export class Webview {
  html = '';
  options: { enableScripts?: boolean; localResourceRoots?: Uri[] } = {};
  readonly cspSource = 'https://webview.test';
  readonly posted: unknown[] = [];
  private readonly wakers: (() => void)[] = [];
  readonly received = new EventEmitter<unknown>();
  readonly onDidReceiveMessage = this.received.event;
  asWebviewUri(uri: Uri): string {
    return `${this.cspSource}${uri.path}`;
  }
  postMessage(message: unknown): Promise<boolean> {
    this.posted.push(message);
    for (const wake of this.wakers.splice(0)) wake();
    return Promise.resolve(true);
  }
  /** Waits for a message that the extension posts, of those not taken yet, and takes it and all before it. */
  async take<T>(fits: (message: T) => boolean): Promise<T> {
    for (;;) {
      const index = this.posted.findIndex((message) => fits(message as T));
      if (index >= 0) return this.posted.splice(0, index + 1).at(-1) as T;
      await new Promise<void>((resolve) => this.wakers.push(resolve));
    }
  }
}

export class WebviewPanel {
  readonly webview = new Webview();
  readonly disposed = new EventEmitter<void>();
  readonly viewStateChanged = new EventEmitter<void>();
  readonly onDidDispose = this.disposed.event;
  readonly onDidChangeViewState = this.viewStateChanged.event;
  visible = true;
  active = false;
  iconPath: unknown;
  constructor(
    readonly viewType: string,
    readonly title: string,
    readonly where: unknown,
  ) {}
  reveal(): void {}
  dispose(): void {
    this.disposed.fire();
  }
}

/** What the extension did, and what the user would do. */
export const host = {
  settings: new Map<string, unknown>(),
  commands: new Map<string, (...words: unknown[]) => unknown>(),
  panels: [] as WebviewPanel[],
  errors: [] as string[],
  shown: [] as { document: Document; options: { viewColumn?: number; selection?: Range } }[],
  diagnostics: new Map<string, Diagnostic[]>(),
  saveTo: undefined as Uri | undefined,
  serializer: undefined as { deserializeWebviewPanel(panel: WebviewPanel, state: unknown): Promise<void> } | undefined,
  documents: [] as Document[],
  onOpen: new EventEmitter<Document>(),
  onChange: new EventEmitter<{ document: Document; contentChanges: unknown[]; reason: undefined }>(),
  onSelection: new EventEmitter<unknown>(),
  onSettings: new EventEmitter<{ affectsConfiguration(name: string): boolean }>(),
  open(document: Document): void {
    this.documents.push(document);
    window.activeTextEditor = { document };
    this.onOpen.fire(document);
  },
  type(document: Document, text: string): void {
    const before = document.getText();
    const range = new Range(0, 0, before.split('\n').length, 0); // all of it
    document.set(text);
    const contentChanges = [{ range, rangeOffset: 0, rangeLength: before.length, text }];
    this.onChange.fire({ document, contentChanges, reason: undefined });
  },
};

const never = new EventEmitter<never>().event;
const nothing = (): Disposable => new Disposable();

export const window = {
  activeTextEditor: undefined as { document: Document } | undefined,
  visibleTextEditors: [] as { document: Document; viewColumn: number }[],
  visibleNotebookEditors: [],
  tabGroups: { all: [], onDidChangeTabs: never, onDidChangeTabGroups: never },
  onDidChangeActiveTextEditor: never,
  onDidChangeVisibleTextEditors: never,
  onDidChangeVisibleNotebookEditors: never,
  onDidChangeTextEditorSelection: host.onSelection.event,
  createOutputChannel: () => ({ append() {}, appendLine() {}, show() {}, clear() {}, dispose() {} }),
  createWebviewPanel: (viewType: string, title: string, where: unknown) => {
    const panel = new WebviewPanel(viewType, title, where);
    host.panels.push(panel);
    return panel;
  },
  registerWebviewPanelSerializer: (_type: string, serializer: typeof host.serializer) => {
    host.serializer = serializer;
    return nothing();
  },
  showErrorMessage: (message: string) => {
    host.errors.push(message);
    return Promise.resolve(undefined);
  },
  showSaveDialog: () => Promise.resolve(host.saveTo),
  showTextDocument: (document: Document, options: { viewColumn?: number; selection?: Range }) => {
    host.shown.push({ document, options });
    return Promise.resolve();
  },
  withProgress: (_options: unknown, task: () => Promise<unknown>) => task(),
};

export const workspace = {
  workspaceFolders: undefined,
  textDocuments: host.documents,
  notebookDocuments: [],
  fs: {},
  isTrusted: true,
  onDidOpenTextDocument: host.onOpen.event,
  onDidChangeTextDocument: host.onChange.event,
  onDidCloseTextDocument: never,
  onDidSaveTextDocument: never,
  onWillSaveTextDocument: never,
  onDidChangeConfiguration: host.onSettings.event,
  onDidChangeWorkspaceFolders: never,
  onDidCreateFiles: never,
  onDidRenameFiles: never,
  onDidDeleteFiles: never,
  onWillCreateFiles: never,
  onWillRenameFiles: never,
  onWillDeleteFiles: never,
  onDidOpenNotebookDocument: never,
  onDidCloseNotebookDocument: never,
  onDidChangeNotebookDocument: never,
  onDidSaveNotebookDocument: never,
  getWorkspaceFolder: () => undefined,
  getConfiguration: (section?: string) => ({
    get: (name: string, fallback?: unknown) => host.settings.get(section ? `${section}.${name}` : name) ?? fallback,
    inspect: () => undefined,
  }),
  createFileSystemWatcher: () => ({ onDidCreate: never, onDidChange: never, onDidDelete: never, dispose() {} }),
  openTextDocument: (uri: Uri) => {
    const open = host.documents.find((document) => document.uri.toString() === uri.toString());
    return Promise.resolve(open ?? new Document(uri, ''));
  },
  registerTextDocumentContentProvider: nothing,
  applyEdit: () => Promise.resolve(true),
};

export const commands = {
  registerCommand: (name: string, run: (...words: unknown[]) => unknown) => {
    host.commands.set(name, run);
    return new Disposable(() => host.commands.delete(name));
  },
  executeCommand: (name: string, ...words: unknown[]) => host.commands.get(name)?.(...words),
};

export const languages = new Proxy(
  {
    createDiagnosticCollection: () => ({
      set: (uri: Uri, list: Diagnostic[]) => host.diagnostics.set(uri.toString(), list),
      delete: (uri: Uri) => host.diagnostics.delete(uri.toString()),
      clear: () => host.diagnostics.clear(),
      dispose() {},
    }),
    match: (selector: { language?: string; scheme?: string }[], document: Document) =>
      [selector].flat().some(({ language, scheme }) => {
        return (!language || language === document.languageId) && (!scheme || scheme === document.uri.scheme);
      })
        ? 10
        : 0,
  } as Record<string, unknown>,
  // All registrations of providers.
  { get: (target, name: string) => target[name] ?? nothing },
);

export const env = { appName: 'test', language: 'en', machineId: 'test', openExternal: () => Promise.resolve(true) };
export const version = '1.82.0';
export const extensions = { getExtension: () => undefined };
export const ViewColumn = { Active: -1, Beside: -2, One: 1 };
export const ProgressLocation = { Window: 10, Notification: 15 };
export const TextEditorSelectionChangeKind = { Keyboard: 1, Mouse: 2, Command: 3 };
export const DiagnosticSeverity = { Error: 0, Warning: 1, Information: 2, Hint: 3 };
export const DiagnosticTag = { Unnecessary: 1, Deprecated: 2 };
export const TextDocumentSaveReason = { Manual: 1, AfterDelay: 2, FocusOut: 3 };
export const FileType = { Unknown: 0, File: 1, Directory: 2, SymbolicLink: 64 };
export const LogLevel = { Off: 0, Trace: 1, Debug: 2, Info: 3, Warning: 4, Error: 5 };
export class CancellationTokenSource {
  readonly token = { isCancellationRequested: false, onCancellationRequested: never };
  cancel(): void {}
  dispose(): void {}
}
export class CancellationError extends Error {}

/** Kinds and forms that the language client names, and no test looks at. */
const any: unknown = new Proxy(class {}, { get: (target, name) => Reflect.get(target, name) ?? 0 });
export const others = any;
