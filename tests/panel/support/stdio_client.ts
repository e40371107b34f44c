// An editor of a test: it runs `scadray serve`, and speaks the protocol as vscode-languageserver-protocol has it.
import { type ChildProcess, spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import {
  type Diagnostic,
  type InitializeResult,
  type Position,
  type ProtocolConnection,
  type PublishDiagnosticsParams,
  StreamMessageReader,
  StreamMessageWriter,
  createProtocolConnection,
} from 'vscode-languageserver-protocol/node';

/** The program under test, by tests/panel/run. */
export const program = process.env['SCADRAY_PROGRAM']!;

/** A text whose `|` is the cursor. */
export function marked(text: string): { text: string; position: Position } {
  const before = text.slice(0, text.indexOf('|')).split('\n');
  return { text: text.replace('|', ''), position: { line: before.length - 1, character: before.at(-1)!.length } };
}

export class StdioClient {
  readonly folder = mkdtempSync(join(tmpdir(), 'scadray-'));
  readonly connection: ProtocolConnection;
  initialized!: InitializeResult;
  private readonly child: ChildProcess;
  private readonly diagnostics = new Map<string, { version: number | undefined; list: Diagnostic[] }>();
  private readonly waiting: (() => void)[] = [];
  private version = 0;

  private constructor() {
    this.child = spawn(program, ['serve', '--stdio'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.connection = createProtocolConnection(
      new StreamMessageReader(this.child.stdout!),
      new StreamMessageWriter(this.child.stdin!),
    );
    this.connection.onNotification('textDocument/publishDiagnostics', (params: PublishDiagnosticsParams) => {
      this.diagnostics.set(params.uri, { version: params.version, list: params.diagnostics });
      for (const wake of this.waiting.splice(0)) wake();
    });
    this.connection.listen();
  }

  static async start(): Promise<StdioClient> {
    const client = new StdioClient();
    client.initialized = await client.connection.sendRequest('initialize', {
      processId: process.pid,
      rootUri: pathToFileURL(client.folder).href,
      capabilities: {
        textDocument: {
          publishDiagnostics: { relatedInformation: true, tagSupport: { valueSet: [1, 2] }, versionSupport: true },
        },
      },
    });
    await client.connection.sendNotification('initialized', {});
    return client;
  }

  uri(name: string): string {
    return pathToFileURL(join(this.folder, name)).href;
  }

  write(name: string, text: string): string {
    writeFileSync(join(this.folder, name), text);
    return this.uri(name);
  }

  async open(name: string, text: string): Promise<string> {
    const uri = this.uri(name);
    const textDocument = { uri, languageId: 'scad', version: ++this.version, text };
    await this.connection.sendNotification('textDocument/didOpen', { textDocument });
    return uri;
  }

  async change(uri: string, text: string): Promise<void> {
    const textDocument = { uri, version: ++this.version };
    await this.connection.sendNotification('textDocument/didChange', { textDocument, contentChanges: [{ text }] });
  }

  /** Returns the diagnostics of a document's newest version. */
  async diagnosticsOf(uri: string): Promise<Diagnostic[]> {
    for (;;) {
      const found = this.diagnostics.get(uri);
      if (found && (found.version === undefined || found.version >= this.version)) return found.list;
      await new Promise<void>((resolve) => this.waiting.push(resolve));
    }
  }

  async end(): Promise<void> {
    await this.connection.sendRequest('shutdown');
    await this.connection.sendNotification('exit');
    await new Promise((resolve) => this.child.once('exit', resolve));
    this.connection.dispose();
    rmSync(this.folder, { recursive: true });
  }
}
