// A preview of a document: the panel (frontend/serve/panel) in a webview. What it says to the server is passed on.
import { randomBytes } from 'node:crypto';
import * as vscode from 'vscode';
import type { Frame, Place } from '../../../serve/panel/src/protocol';
import type { FromExtension, ToExtension } from '../../../serve/panel/src/webview';
import type { Server } from './server';

export const viewType = 'scadray.preview';

/** The methods that a panel may call: those of previews. */
const previewMethod = /^scadray\/[A-Za-z]+$/;

/** What waits for a preview to open gives up after so long. */
const mostWait_ms = 10_000;

export class PreviewPanel {
  /** The server's number; null: the preview is not open there. */
  private preview: number | null = null;
  private readonly hasOpened = new vscode.EventEmitter<number>();
  private readonly disposables: vscode.Disposable[] = [];

  constructor(
    readonly panel: vscode.WebviewPanel,
    readonly uri: vscode.Uri,
    extension: vscode.Uri,
    private readonly server: Server,
    private readonly write: (panel: PreviewPanel, what: 'picture' | 'model') => void,
  ) {
    const files = vscode.Uri.joinPath(extension, 'dist', 'panel');
    panel.webview.options = { enableScripts: true, localResourceRoots: [files] };
    panel.iconPath = vscode.Uri.joinPath(files, 'icon.svg');
    this.disposables.push(
      panel.webview.onDidReceiveMessage((message: ToExtension) => void this.take(message)),
      panel.onDidChangeViewState(() => {
        // A hidden webview is gone; it says "ready" when it is shown again.
        if (!panel.visible) this.close();
      }),
      server.onOpened(() => this.post({ kind: 'opened' })),
      server.onClosed(() => {
        this.preview = null;
        this.post({ kind: 'closed' });
      }),
      server.onNotification(({ method, params }) => this.takeFromServer(method, params)),
    );
    panel.onDidDispose(() => {
      this.close();
      for (const disposable of this.disposables) disposable.dispose();
    });
    panel.webview.html = page(panel.webview, files, uri.toString());
  }

  /** The server's number of the preview, once it is open there. */
  opened(): Promise<number> {
    if (this.preview !== null) return Promise.resolve(this.preview);
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error('the preview is not open')), mostWait_ms);
      const listening = this.hasOpened.event((preview) => {
        clearTimeout(timer);
        listening.dispose();
        resolve(preview);
      });
    });
  }

  /** Has the panel do one of its commands. */
  run(name: string): void {
    this.post({ kind: 'command', name });
  }

  /** Lights what the place makes; without a place nothing. */
  setCursor(place?: { uri: string; position: { line: number; character: number } }): void {
    if (this.preview !== null) this.server.notify('scadray/cursor', { preview: this.preview, ...place });
  }

  private post(message: FromExtension): void {
    void this.panel.webview.postMessage(message);
  }

  private close(): void {
    if (this.preview !== null) void this.server.request('scadray/closePreview', { preview: this.preview }).catch(() => {});
    this.preview = null;
  }

  private async take(message: ToExtension): Promise<void> {
    switch (message.kind) {
      case 'ready':
        this.close();
        if (this.server.isOpen) this.post({ kind: 'opened' });
        break;
      case 'message':
        await this.pass(message.message);
        break;
      case 'reveal':
        await reveal(message.place);
        break;
      case 'retry':
        await this.server.restart();
        break;
      case 'write':
        this.write(this, message.what);
        break;
    }
  }

  private async pass({ id, method, params }: { id?: number; method?: string; params?: unknown }): Promise<void> {
    if (method === undefined || !previewMethod.test(method)) return;
    if (id === undefined) {
      this.server.notify(method, params);
      return;
    }
    try {
      const result = await this.server.request(method, params);
      if (method === 'scadray/openPreview') {
        this.preview = (result as { preview: number }).preview;
        this.hasOpened.fire(this.preview);
      }
      this.post({ kind: 'message', message: { jsonrpc: '2.0', id, result } });
    } catch (error) {
      const { code = -32603, message } = error as Error & { code?: number };
      this.post({ kind: 'message', message: { jsonrpc: '2.0', id, error: { code, message } } });
    }
  }

  private takeFromServer(method: string, params: unknown): void {
    if ((params as { preview: number }).preview !== this.preview) return;
    if (method === 'scadray/frame') {
      const { data, ...frame } = params as Frame & { data: string };
      // A buffer of its own, which can be handed over.
      const image = new Uint8Array(Buffer.from(data, 'base64')).buffer;
      this.post({ kind: 'frame', frame, image });
    } else {
      this.post({ kind: 'message', message: { jsonrpc: '2.0', method, params } });
    }
  }
}

/** Shows a place in the editor that has the document, or else in the first column. */
export async function reveal({ uri, range }: Place): Promise<void> {
  const document = await vscode.workspace.openTextDocument(vscode.Uri.parse(uri, true));
  const shown = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
  await vscode.window.showTextDocument(document, {
    viewColumn: shown?.viewColumn ?? vscode.ViewColumn.One,
    selection: new vscode.Range(range.start.line, range.start.character, range.end.line, range.end.character),
  });
}

const escaped = (text: string): string => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);

function page(webview: vscode.Webview, files: vscode.Uri, design: string): string {
  const file = (name: string) => webview.asWebviewUri(vscode.Uri.joinPath(files, name)).toString();
  const nonce = randomBytes(16).toString('hex');
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta http-equiv="Content-Security-Policy"
      content="default-src 'none'; script-src 'nonce-${nonce}'; style-src ${webview.cspSource}; img-src blob:" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="scadray-design" content="${escaped(design)}" />
    <link rel="stylesheet" href="${file('panel.css')}" />
    <script defer nonce="${nonce}" src="${file('panel.js')}"></script>
  </head>
  <body></body>
</html>`;
}
