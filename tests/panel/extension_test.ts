// The extension as it is packed, with a stand-in for VS Code (support/vscode_mock.ts) and the server run for real.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import Module from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import type { Frame, Pick } from '../../frontend/serve/panel/src/protocol';
import type { FromExtension, ToExtension } from '../../frontend/serve/panel/src/webview';
import { launch } from './support/browser';
import { program } from './support/stdio_client';
import * as vscode from './support/vscode_mock';
import { Document, type WebviewPanel, host } from './support/vscode_mock';
import { showWebview } from './support/webview_page';

const extension = process.env['SCADRAY_EXTENSION']!;
const folder = mkdtempSync(join(tmpdir(), 'scadray-'));
const subscriptions: { dispose(): void }[] = [];

before(async () => {
  const load = (Module as unknown as { _load: (name: string, ...rest: unknown[]) => unknown })._load;
  const mock = new Proxy(vscode, { get: (target, name) => Reflect.get(target, name) ?? vscode.others });
  Object.assign(Module, { _load: (name: string, ...rest: unknown[]) => (name === 'vscode' ? mock : load(name, ...rest)) });
  host.settings.set('scadray.path', program);
  host.settings.set('scadray.language', '2026');
  host.settings.set('scadray.lightCursor', true);
  const { activate } = require(join(extension, 'dist/extension.js')) as { activate(context: unknown): Promise<void> };
  await activate({ extensionUri: vscode.Uri.file(extension), subscriptions });
});
after(async () => {
  for (const panel of host.panels) panel.dispose();
  for (const one of subscriptions) one.dispose();
  rmSync(folder, { recursive: true });
});
afterEach(() => assert.deepEqual(host.errors.splice(0), []));

/** A preview whose panel the test plays. */
class Page {
  private id = 0;
  constructor(readonly panel: WebviewPanel) {}

  static async open(name: string, text: string): Promise<{ page: Page; document: Document; preview: number }> {
    const path = join(folder, name);
    writeFileSync(path, text);
    const document = new Document(vscode.Uri.file(path), text);
    host.open(document);
    await host.commands.get('scadray.openPreview')!();
    const page = new Page(host.panels.at(-1)!);
    page.say({ kind: 'ready' });
    await page.hear('opened');
    const { preview } = (await page.request('scadray/openPreview', {
      textDocument: { uri: document.uri.toString() },
      look: { width: 100, height: 80 },
    })) as { preview: number };
    return { page, document, preview };
  }

  say(message: ToExtension): void {
    this.panel.webview.received.fire(message);
  }
  hear<K extends FromExtension['kind']>(kind: K): Promise<Extract<FromExtension, { kind: K }>> {
    return this.panel.webview.take<Extract<FromExtension, { kind: K }>>((message) => message.kind === kind);
  }
  /** Asks; frames that come before the answer are shown. */
  async request(method: string, params: unknown): Promise<unknown> {
    const id = ++this.id;
    this.say({ kind: 'message', message: { jsonrpc: '2.0', id, method, params } });
    const answer = await this.panel.webview.take<FromExtension>(
      (message) => message.kind === 'message' && message.message.id === id,
    );
    assert.ok(answer.kind === 'message');
    if (answer.message.error) throw new Error(answer.message.error.message);
    return answer.message.result;
  }
  notify(method: string, params: unknown): void {
    this.say({ kind: 'message', message: { jsonrpc: '2.0', method, params } });
  }
  /** Waits for a full frame of at least a version of the design, and says that each one is shown. */
  async frame(fits: (frame: Frame) => boolean): Promise<{ frame: Frame; image: ArrayBuffer }> {
    for (;;) {
      const { frame, image } = await this.hear('frame');
      this.notify('scadray/shown', { preview: frame.preview, number: frame.number });
      if (frame.final && fits(frame)) return { frame, image };
    }
  }
}

test('a preview of what is typed and not saved', async () => {
  const { page, document } = await Page.open('typed.scad', 'cube(10);\n');
  const first = await page.frame(() => true);
  assert.equal(first.frame.type, 'image/png');
  assert.equal(Buffer.from(first.image).subarray(1, 4).toString(), 'PNG');
  host.type(document, 'sphere(10);\n');
  const second = await page.frame(({ version }) => version > first.frame.version);
  assert.notDeepEqual(Buffer.from(second.image), Buffer.from(first.image));
  assert.equal(readFileSync(document.uri.fsPath, 'utf8'), 'cube(10);\n');
});

test('the page may run our script and nothing else', async () => {
  const { page } = await Page.open('page.scad', 'cube(1);\n');
  const { html, options } = page.panel.webview;
  const nonce = /'nonce-([0-9a-f]{32})'/.exec(html)?.[1];
  assert.match(html, /default-src 'none'/);
  assert.ok(html.includes(`<script defer nonce="${nonce}" src="https://webview.test${extension}/dist/panel/panel.js">`));
  assert.doesNotMatch(html, /unsafe/);
  assert.deepEqual(options.localResourceRoots?.map(({ path }) => path), [`${extension}/dist/panel`]);
  assert.ok(statSync(`${extension}/dist/panel/panel.js`).size > 10_000);
});

test('a panel may call the methods of previews only', async () => {
  const { page, preview } = await Page.open('methods.scad', 'cube(1);\n');
  page.notify('exit', null);
  page.notify('textDocument/didClose', {});
  assert.ok(await page.request('scadray/viewAll', { preview, camera: (await page.frame(() => true)).frame.camera }));
});

test('a pick has its place, and revealing it shows the line', async () => {
  const { page, preview, document } = await Page.open('pick.scad', '\n\ncube(10, center = true);\n');
  const { frame } = await page.frame(() => true);
  const pick = (await page.request('scadray/pick', { preview, camera: frame.camera, x: 50, y: 40 })) as Pick;
  const place = pick.places[0]!;
  assert.equal(place.uri, document.uri.toString());
  page.say({ kind: 'reveal', place });
  for (let i = 0; i < 100 && host.shown.length === 0; i++) await new Promise((resolve) => setTimeout(resolve, 10));
  const { document: shown, options } = host.shown.pop()!;
  assert.equal(shown, document);
  assert.equal(options.selection?.start.line, 2);
});

test('the cursor lights what its statement makes, until something is typed', async () => {
  const { page, document } = await Page.open('cursor.scad', 'cube(10);\ntranslate([20, 0, 0]) sphere(8);\n');
  const plain = await page.frame(() => true);
  const at = new vscode.Position(1, 25);
  const selections = [new vscode.Selection(at, at)];
  host.onSelection.fire({ textEditor: { document }, kind: vscode.TextEditorSelectionChangeKind.Mouse, selections });
  const lit = await page.frame(() => true);
  assert.notDeepEqual(Buffer.from(lit.image), Buffer.from(plain.image));
  host.type(document, document.getText());
  const again = await page.frame(() => true);
  assert.deepEqual(Buffer.from(again.image), Buffer.from(plain.image));
});

test('commands write a picture and a model', async () => {
  const { page } = await Page.open('write.scad', 'cube(10);\n');
  await page.frame(() => true);
  for (const [command, name] of [['scadray.savePicture', 'saved.png'], ['scadray.exportModel', 'saved.stl']] as const) {
    host.saveTo = vscode.Uri.file(join(folder, name));
    await host.commands.get(command)!();
    assert.ok(statSync(join(folder, name)).size > 100, name);
  }
});

test('commands reach the panel', async () => {
  const { page } = await Page.open('section.scad', 'cube(10);\n');
  await host.commands.get('scadray.toggleSection')!();
  assert.equal((await page.hear('command')).name, 'section');
});

test('diagnostics stand at the document', async () => {
  const { page, document } = await Page.open('wrong.scad', 'cube(1;\n');
  await page.panel.webview.take<FromExtension>((message) => message.kind === 'message' && message.message.method === 'scadray/design');
  const uri = document.uri.toString();
  for (let i = 0; i < 200 && !host.diagnostics.get(uri)?.length; i++) await new Promise((resolve) => setTimeout(resolve, 10));
  assert.equal(host.diagnostics.get(uri)?.[0]?.severity, vscode.DiagnosticSeverity.Error);
});

test('a hidden preview is closed, and opened again when it is shown', async () => {
  const { page, preview } = await Page.open('hidden.scad', 'cube(10);\n');
  const { frame } = await page.frame(() => true);
  page.panel.visible = false;
  page.panel.viewStateChanged.fire();
  await assert.rejects(page.request('scadray/pick', { preview, camera: frame.camera, x: 1, y: 1 }));
  page.say({ kind: 'ready' });
  await page.hear('opened');
});

test('the panel in its webview, in Chromium', async () => {
  const browser = await launch();
  try {
    const text = 'module leg() cylinder(h = 30, d = 6);\ncube([40, 40, 4]);\nfor (x = [5, 35], y = [5, 35])\n  translate([x, y, -30]) leg();\n';
    const design = new Document(vscode.Uri.file(join(folder, 'webview.scad')), text);
    writeFileSync(design.uri.fsPath, text);
    host.open(design);
    await host.commands.get('scadray.openPreview')!();
    const context = await browser.newContext({ viewport: { width: 500, height: 600 } });
    const page = await showWebview(context, host.panels.at(-1)!, 'vscode-dark');
    const errors: string[] = [];
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    await page.locator('canvas[data-final=true]').waitFor();
    const pixels = () => page.evaluate(() => document.querySelector('canvas')!.toDataURL());
    const first = await pixels();
    assert.equal(await page.locator('button[aria-label^="Source"]').count(), 0, 'the editor shows the text');
    host.type(design, text.replace('d = 6', 'd = 9')); // not saved
    await page.waitForFunction((before) => document.querySelector('canvas')!.toDataURL() !== before, first);
    await host.commands.get('scadray.toggleSection')!();
    await page.locator('.strip[aria-label="Section plane"]').waitFor();
    await page.locator('button[aria-label^="No section"]').click();
    await page.mouse.click(250, 300);
    host.shown.length = 0;
    await page.locator('.card button.link').first().click();
    for (let i = 0; i < 100 && host.shown.length === 0; i++) await new Promise((resolve) => setTimeout(resolve, 20));
    assert.equal(host.shown.pop()?.document, design);
    await page.screenshot({ path: `${process.env['SCADRAY_PICTURES']}/webview.png` });
    // What VS Code throws away and loads again is as it was.
    const state = await page.evaluate(() => sessionStorage.getItem('state'));
    assert.equal((JSON.parse(state!) as { uri: string }).uri, design.uri.toString());
    await page.reload();
    await page.locator('canvas[data-final=true]').waitFor();
    await page.evaluate(() => delete document.querySelector('canvas')!.dataset['final']);
    await host.commands.get('scadray.restartServer')!();
    await page.locator('canvas[data-final=true]').waitFor();
    assert.deepEqual(errors, []);
  } finally {
    await browser.close();
  }
});

test('a restart of the server is told to the panels', async () => {
  const { page, document } = await Page.open('restart.scad', 'cube(10);\n');
  await page.frame(() => true);
  await host.commands.get('scadray.restartServer')!();
  await page.hear('closed');
  await page.hear('opened');
  await page.request('scadray/openPreview', { textDocument: { uri: document.uri.toString() }, look: { width: 100, height: 80 } });
  await page.frame(() => true);
});

test('a preview is restored with the window', async () => {
  const panel = new vscode.WebviewPanel('scadray.preview', 'Preview', undefined);
  host.panels.push(panel);
  await host.serializer!.deserializeWebviewPanel(panel, { uri: 'file:///a%20b.scad' });
  assert.match(panel.webview.html, /content="file:\/\/\/a%20b\.scad"/);
});

test('a program that is not there is told of', async () => {
  host.settings.set('scadray.path', '/nowhere/scadray');
  await host.commands.get('scadray.restartServer')!();
  assert.match(host.errors.splice(0)[0] ?? '', /\/nowhere\/scadray could not be started.*scadray\.path/);
});
