// package.mjs [FILE]: packs the extension; without a file into build/scadray.vsix of the repository. Everything is put
// together in a folder beside that, so that nothing is generated among the sources.
import { createVSIX } from '@vscode/vsce';
import { build } from 'esbuild';
import { cp, mkdir, rm } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { buildPanel } from '../../serve/panel/build.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../../..');

export async function assemble(folder) {
  await rm(folder, { recursive: true, force: true });
  await mkdir(folder, { recursive: true });
  for (const name of ['package.json', 'README.md', 'icon.png', 'language-configuration.json', 'syntaxes', 'snippets']) {
    await cp(join(here, name), join(folder, name), { recursive: true });
  }
  await cp(join(root, 'LICENSE'), join(folder, 'LICENSE'));
  await cp(join(root, 'CHANGELOG.md'), join(folder, 'CHANGELOG.md'));
  await build({
    entryPoints: [join(here, 'src/extension.ts')],
    outfile: join(folder, 'dist/extension.js'),
    bundle: true,
    minify: true,
    platform: 'node',
    format: 'cjs',
    target: 'node18',
    external: ['vscode'],
    logLevel: 'warning',
  });
  await buildPanel(join(folder, 'dist/panel'));
}

export async function pack(file) {
  const folder = `${file}.contents`;
  await assemble(folder);
  process.chdir(folder); // vsce measures files from here
  await createVSIX({ cwd: folder, packagePath: file, dependencies: false, allowMissingRepository: true });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const file = process.argv[2] ? resolve(process.env.INIT_CWD ?? '.', process.argv[2]) : join(root, 'build/scadray.vsix');
  await mkdir(dirname(file), { recursive: true });
  await pack(file);
}
