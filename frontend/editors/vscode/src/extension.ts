// The extension's commands, and what its previews have to know of the editors.
import * as vscode from 'vscode';
import { PreviewPanel, viewType } from './preview_panel';
import { Server } from './server';

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const server = new Server();
  const previews = new Previews(context.extensionUri, server);
  const command = (name: string, run: (...arguments_: never[]) => unknown) =>
    vscode.commands.registerCommand(`scadray.${name}`, run);
  context.subscriptions.push(
    server,
    command('openPreview', (uri?: vscode.Uri) => previews.open(uri)),
    command('exportModel', () => previews.write('model')),
    command('savePicture', () => previews.write('picture')),
    command('toggleSection', () => previews.run('section')),
    command('viewAll', () => previews.run('all')),
    command('restartServer', () => server.restart()),
    vscode.window.registerWebviewPanelSerializer(viewType, {
      deserializeWebviewPanel: async (panel, state?: { uri?: string }) => {
        if (state?.uri) previews.adopt(panel, vscode.Uri.parse(state.uri, true));
        else panel.dispose();
      },
    }),
    vscode.window.onDidChangeTextEditorSelection((event) => previews.follow(event)),
    vscode.workspace.onDidChangeTextDocument(({ document }) => {
      // Who types wants to see all of the design.
      if (document.languageId === 'scad') previews.setCursor();
    }),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration('scadray.path') || event.affectsConfiguration('scadray.language')) void server.restart();
      if (event.affectsConfiguration('scadray.lightCursor')) previews.setCursor();
    }),
  );
  await server.start();
}

/** All previews that are open. */
class Previews {
  private readonly all = new Set<PreviewPanel>();
  private last: PreviewPanel | null = null;

  constructor(
    private readonly extension: vscode.Uri,
    private readonly server: Server,
  ) {}

  /** Shows a document's preview beside it; without one, that of the active editor. */
  open(uri = vscode.window.activeTextEditor?.document.uri): PreviewPanel | null {
    if (!uri) return null;
    const existing = [...this.all].find((preview) => preview.uri.toString() === uri.toString());
    if (existing) {
      existing.panel.reveal(undefined, true);
      return existing;
    }
    const name = uri.path.slice(uri.path.lastIndexOf('/') + 1);
    const where = { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true };
    return this.adopt(vscode.window.createWebviewPanel(viewType, `Preview ${name}`, where), uri);
  }

  adopt(panel: vscode.WebviewPanel, uri: vscode.Uri): PreviewPanel {
    const preview = new PreviewPanel(panel, uri, this.extension, this.server, (of, what) => void this.writeOf(of, what));
    this.all.add(preview);
    this.last = preview;
    panel.onDidChangeViewState(() => panel.active && (this.last = preview));
    panel.onDidDispose(() => {
      this.all.delete(preview);
      if (this.last === preview) this.last = null;
    });
    return preview;
  }

  run(name: string): void {
    this.chosen()?.run(name);
  }

  async write(what: 'picture' | 'model'): Promise<void> {
    const preview = this.chosen();
    if (preview) await this.writeOf(preview, what);
  }

  /** Lights what the cursor's statement makes, when the cursor is moved and not by typing. */
  follow({ textEditor, kind, selections }: vscode.TextEditorSelectionChangeEvent): void {
    const { document } = textEditor;
    if (document.languageId !== 'scad' || kind === undefined) return;
    if (!vscode.workspace.getConfiguration('scadray').get<boolean>('lightCursor')) return;
    const { line, character } = selections[0]!.active;
    this.setCursor({ uri: document.uri.toString(), position: { line, character } });
  }

  setCursor(place?: Parameters<PreviewPanel['setCursor']>[0]): void {
    for (const preview of this.all) preview.setCursor(place);
  }

  /** The preview that was used last; that of the active editor, which is opened, if there is none. */
  private chosen(): PreviewPanel | null {
    const { activeTextEditor } = vscode.window;
    return activeTextEditor?.document.languageId === 'scad' ? this.open() : (this.last ?? null);
  }

  private async writeOf(preview: PreviewPanel, what: 'picture' | 'model'): Promise<void> {
    const isModel = what === 'model';
    const path = preview.uri.path.replace(/\.[^./]*$/, '') + (isModel ? '.stl' : '.png');
    const asked: vscode.SaveDialogOptions = {
      filters: isModel
        ? { Solids: ['stl', '3mf', 'off', 'obj', 'amf'], 'Plane figures': ['svg', 'dxf', 'pdf'] }
        : { Pictures: ['png'] },
    };
    if (preview.uri.scheme === 'file') asked.defaultUri = preview.uri.with({ path });
    const target = await vscode.window.showSaveDialog(asked);
    if (!target) return;
    const method = isModel ? 'scadray/exportModel' : 'scadray/savePicture';
    const title = `Writing ${target.fsPath}`;
    try {
      await vscode.window.withProgress({ location: vscode.ProgressLocation.Notification, title }, async () =>
        this.server.request(method, { preview: await preview.opened(), path: target.fsPath }),
      );
    } catch (error) {
      void vscode.window.showErrorMessage((error as Error).message);
    }
  }
}
