// build.mjs [FOLDER]: writes the panel's files, index.html, panel.js and panel.css, into the folder.
import { build } from 'esbuild';
import { copyFile, mkdir } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));

export async function buildPanel(folder) {
  await mkdir(folder, { recursive: true });
  await build({
    entryPoints: [join(here, 'src/panel.ts'), join(here, 'panel.css')],
    outdir: folder,
    entryNames: '[name]',
    bundle: true,
    minify: true,
    format: 'iife',
    target: 'es2022',
    logLevel: 'warning',
  });
  await copyFile(join(here, 'index.html'), join(folder, 'index.html'));
  await copyFile(join(here, '../../packaging/scadray.svg'), join(folder, 'icon.svg'));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await buildPanel(resolve(process.env.INIT_CWD ?? '.', process.argv[2] ?? 'panel'));
}
