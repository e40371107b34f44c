// The server, `scadray serve`: one process for all documents and previews.
import * as vscode from 'vscode';
import { LanguageClient, State } from 'vscode-languageclient/node';
import type { Executable } from 'vscode-languageclient/node';

/** Leaves it to us to say that the server could not be started, and what to do. */
class Client extends LanguageClient {
  isStarting = false;

  override error(message: string, data?: unknown, show?: boolean | 'force'): void {
    super.error(message, data, this.isStarting ? false : show);
  }
}

export class Server implements vscode.Disposable {
  private client: Client | null = null;
  private readonly opened = new vscode.EventEmitter<void>();
  private readonly closed = new vscode.EventEmitter<void>();
  private readonly notified = new vscode.EventEmitter<{ method: string; params: unknown }>();
  readonly onOpened = this.opened.event;
  readonly onClosed = this.closed.event;
  readonly onNotification = this.notified.event;
  /** Starts and stops come one after the other. */
  private last: Promise<void> = Promise.resolve();

  get isOpen(): boolean {
    return this.client?.state === State.Running;
  }

  start(): Promise<void> {
    return this.then(() => this.begin());
  }

  restart(): Promise<void> {
    return this.then(async () => {
      await this.end();
      await this.begin();
    });
  }

  stop(): Promise<void> {
    return this.then(() => this.end());
  }

  request(method: string, params: unknown): Promise<unknown> {
    if (!this.client || !this.isOpen) return Promise.reject(new Error('scadray does not run'));
    return this.client.sendRequest(method, params);
  }

  notify(method: string, params: unknown): void {
    // One to a server that ends just now is lost; its previews are opened again.
    if (this.isOpen) this.client?.sendNotification(method, params).catch(() => {});
  }

  dispose(): void {
    void this.stop();
  }

  private then(action: () => Promise<void>): Promise<void> {
    this.last = this.last.then(action, action);
    return this.last;
  }

  private async begin(): Promise<void> {
    const settings = vscode.workspace.getConfiguration('scadray');
    const command = settings.get<string>('path') || 'scadray';
    const executable: Executable = { command, args: ['serve', `--language=${settings.get<string>('language')}`] };
    const client = new Client('scadray', 'scadray', executable, {
      documentSelector: [
        { language: 'scad', scheme: 'file' },
        { language: 'scad', scheme: 'untitled' },
      ],
    });
    for (const method of ['scadray/frame', 'scadray/design', 'scadray/progress']) {
      client.onNotification(method, (params: unknown) => this.notified.fire({ method, params }));
    }
    client.onDidChangeState(({ newState }) => {
      if (newState === State.Running) this.opened.fire();
      if (newState === State.Stopped) this.closed.fire();
    });
    this.client = client;
    client.isStarting = true;
    try {
      await client.start();
    } catch (error) {
      void this.tellOfFailure(command, error);
    } finally {
      client.isStarting = false;
    }
  }

  private async end(): Promise<void> {
    const { client } = this;
    this.client = null;
    // One that could not start cannot be stopped.
    await client?.dispose().catch(() => {});
  }

  private async tellOfFailure(command: string, error: unknown): Promise<void> {
    const settings = 'Open Settings';
    const said = error instanceof Error ? error.message : String(error);
    const chosen = await vscode.window.showErrorMessage(
      `${command} could not be started: ${said}. Install scadray, or set scadray.path.`,
      settings,
    );
    if (chosen === settings) await vscode.commands.executeCommand('workbench.action.openSettings', 'scadray.path');
  }
}
