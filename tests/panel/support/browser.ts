// Chromium, and in it the panel of a design that `scadray serve --http` shows.
import { type ChildProcess, spawn } from 'node:child_process';
import { mkdtempSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { pathToFileURL } from 'node:url';
import { type Browser, type BrowserContextOptions, type Page, chromium } from 'playwright-core';
import { program } from './stdio_client';

const panel = `${process.env['SCADRAY_EXTENSION']}/dist/panel`;
const pictures = process.env['SCADRAY_PICTURES']!;

export function launch(): Promise<Browser> {
  const executablePath = process.env['SCADRAY_CHROMIUM'] ?? '/usr/bin/chromium';
  return chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu'] });
}

export interface PanelOptions extends BrowserContextOptions {
  /** As if the page had been left so. The studio's last picture takes long. */
  shading?: 'studio' | 'flat';
  before?: (page: Page) => Promise<void>;
}

export interface Shown {
  number: number;
  version: number;
}

/** A server, and a page of its design. */
export class Panel {
  /** What went wrong in the page. */
  readonly errors: string[] = [];
  private constructor(
    readonly page: Page,
    readonly folder: string,
    private readonly server: ChildProcess,
  ) {
    page.on('pageerror', ({ message }) => this.errors.push(message));
    page.on('console', (message) => {
      if (message.type() === 'error') this.errors.push(message.text());
    });
  }

  /** Opens a text as design.scad, or a file as it is. Other files stand beside it. */
  static async open(
    browser: Browser,
    design: { text: string } | { file: string },
    { shading, before, ...options }: PanelOptions = {},
  ): Promise<Panel> {
    const folder = mkdtempSync(join(tmpdir(), 'scadray-'));
    const file = 'file' in design ? design.file : join(folder, 'design.scad');
    if ('text' in design) writeFileSync(file, design.text);
    const server = spawn(program, ['serve', '--http', `--panel=${panel}`, file], { stdio: ['ignore', 'pipe', 'inherit'] });
    process.once('exit', () => server.kill());
    const lines = createInterface({ input: server.stdout });
    const address = await new Promise<string>((resolve, reject) => {
      lines.on('line', (line) => {
        const found = /http:\S+/.exec(line)?.[0];
        if (found) resolve(found);
      });
      server.once('exit', (code) => reject(new Error(`the server ended with ${code}`)));
    });
    const context = await browser.newContext({ viewport: { width: 600, height: 450 }, ...options });
    const page = await context.newPage();
    const shown = new Panel(page, folder, server);
    if (shading) {
      const kept = [`scadray ${pathToFileURL(file).href}`, JSON.stringify({ look: { shading } })] as const;
      await page.addInitScript(([key, value]) => {
        if (!sessionStorage.getItem(key)) sessionStorage.setItem(key, value);
      }, kept);
    }
    await before?.(page);
    await page.goto(address);
    return shown;
  }

  /** Saves another text, as editors do: no one reads half of it. */
  write(text: string): void {
    const file = join(this.folder, 'design.scad');
    writeFileSync(`${file}~`, text);
    renameSync(`${file}~`, file);
  }

  /** Waits for a full frame that fits, and returns its numbers. */
  async frame(after: Shown = { number: 0, version: 0 }): Promise<Shown> {
    const handle = await this.page.waitForFunction(({ number, version }) => {
      const { dataset } = document.querySelector('canvas')!;
      const now = { number: Number(dataset['number']), version: Number(dataset['version']) };
      return dataset['final'] === 'true' && now.number > number && now.version >= version && now;
    }, after);
    return (await handle.jsonValue()) as Shown;
  }

  /** The picture alone, as bytes of a PNG: equal pictures are equal bytes. */
  async pixels(): Promise<string> {
    return this.page.evaluate(() => document.querySelector('canvas')!.toDataURL());
  }

  /** Takes a picture of the page, to be looked at. */
  async screenshot(name: string): Promise<void> {
    await this.page.screenshot({ path: join(pictures, `${name}.png`) });
  }

  text(selector: string): Promise<string> {
    return this.page.locator(selector).innerText();
  }

  async close(): Promise<void> {
    await this.page.context().close();
    this.server.kill();
    rmSync(this.folder, { recursive: true });
  }
}
