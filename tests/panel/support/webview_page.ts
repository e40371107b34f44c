// A webview of the stand-in for VS Code, shown in Chromium: the page that the extension makes, with the panel in it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { BrowserContext, Page } from 'playwright-core';
import type { WebviewPanel } from './vscode_mock';

const types: Record<string, string> = { html: 'text/html', js: 'text/javascript', css: 'text/css', svg: 'image/svg+xml' };

/** Shows it. What the panel keeps is in the page's sessionStorage. */
export async function showWebview(context: BrowserContext, { webview }: WebviewPanel, theme: string): Promise<Page> {
  const page = await context.newPage();
  const roots = webview.options.localResourceRoots!.map(({ path }) => path);
  await page.route(`${webview.cspSource}/**`, async (route) => {
    const path = new URL(route.request().url()).pathname;
    if (path === '/') {
      await route.fulfill({ contentType: 'text/html', body: webview.html.replace('<body>', `<body class="vscode-body ${theme}">`) });
    } else if (roots.some((root) => path.startsWith(`${root}/`))) {
      await route.fulfill({ contentType: types[path.split('.').pop()!]!, body: readFileSync(join('/', path)) });
    } else {
      await route.abort();
    }
  });
  await page.exposeFunction('toExtension', (message: unknown) => webview.received.fire(message));
  // Images are buffers, which cannot be passed to a page as they are.
  const pass = (message: { image?: ArrayBuffer }) => {
    const passed = message.image ? { ...message, image: Buffer.from(message.image).toString('base64') } : message;
    void page
      .evaluate((data: { image?: string | ArrayBuffer }) => {
        if (typeof data.image === 'string') data.image = Uint8Array.from(atob(data.image), (byte) => byte.charCodeAt(0)).buffer;
        window.postMessage(data);
      }, passed)
      .catch(() => {}); // the page is closed
  };
  const posted = webview.posted.splice(0) as { image?: ArrayBuffer }[];
  webview.postMessage = (message) => {
    pass(message as { image?: ArrayBuffer });
    return Promise.resolve(true);
  };
  for (const message of posted) pass(message);
  await page.addInitScript(() => {
    Object.assign(window, {
      acquireVsCodeApi: () => ({
        postMessage: (message: unknown) => (window as unknown as { toExtension(message: unknown): void }).toExtension(message),
        getState: () => JSON.parse(sessionStorage.getItem('state') ?? 'null') as unknown,
        setState: (state: unknown) => sessionStorage.setItem('state', JSON.stringify(state)),
      }),
    });
  });
  await page.goto(`${webview.cspSource}/`);
  return page;
}
