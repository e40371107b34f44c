// run.mjs PROGRAM FOLDER [NAME…]: checks all that is written in TypeScript, builds it into the folder, and runs the tests
// (of these names, "lsp" for example) with the program scadray; or measures, if the name is "measure". Pictures that tests take stand in FOLDER/pictures.
import { build } from 'esbuild';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readdirSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { assemble } from '../../frontend/editors/vscode/package.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..');
const [program, folderName, ...names] = process.argv.slice(2);
const folder = resolve(folderName);
const pictures = join(folder, 'pictures');
mkdirSync(pictures, { recursive: true });

function run(command, ...words) {
  const { status } = spawnSync(command, words, {
    stdio: 'inherit',
    cwd: root,
    env: {
      ...process.env,
      SCADRAY_PROGRAM: resolve(program),
      SCADRAY_SOURCE: root,
      SCADRAY_EXTENSION: join(folder, 'extension'),
      SCADRAY_PICTURES: pictures,
      NODE_PATH: join(root, 'node_modules'), // of what is not bundled, wherever the folder is
    },
  });
  if (status !== 0) process.exit(status ?? 1);
}

const tsc = join(root, 'node_modules/typescript/bin/tsc');
for (const project of ['frontend/serve/panel', 'frontend/editors/vscode', 'tests/panel']) run(process.execPath, tsc, '-p', project);
await assemble(join(folder, 'extension'));

const measures = names[0] === 'measure';
const files = readdirSync(here)
  .filter((name) => (measures ? name === 'measure.ts' : name.endsWith('_test.ts')))
  .filter((name) => measures || names.length === 0 || names.includes(name.replace('_test.ts', '')));
await build({
  entryPoints: files.map((name) => join(here, name)),
  outdir: folder,
  bundle: true,
  external: ['playwright-core', 'vscode'],
  platform: 'node',
  format: 'cjs',
  target: 'node18',
  sourcemap: 'inline',
  logLevel: 'warning',
});
const options = measures ? [] : ['--test', '--test-reporter=spec'];
run(process.execPath, '--enable-source-maps', ...options, ...files.map((name) => join(folder, name.replace('.ts', '.js'))));
