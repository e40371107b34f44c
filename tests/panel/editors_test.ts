// The configurations in frontend/editors/README.md are what their editors can read, and start the server.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const readme = readFileSync(`${process.env['SCADRAY_SOURCE']}/frontend/editors/README.md`, 'utf8');

/** Returns the configuration below an editor's heading. */
function configurationOf(editor: string): string {
  const found = new RegExp(`^## ${editor}\n[^#]*?\`\`\`[a-z]+\n([^]*?)\`\`\``, 'm').exec(readme);
  assert.ok(found, editor);
  return found[1]!;
}

function jsonOfToml(text: string): unknown {
  const script = 'import json, sys, tomllib; print(json.dumps(tomllib.loads(sys.stdin.read())))';
  const { status, stdout, stderr } = spawnSync('python3', ['-c', script], { input: text, encoding: 'utf8' });
  assert.equal(status, 0, stderr);
  return JSON.parse(stdout);
}

test('Helix', () => {
  assert.deepEqual(jsonOfToml(configurationOf('Helix')), {
    'language-server': { scadray: { command: 'scadray', args: ['serve'] } },
    language: [{ name: 'openscad', 'language-servers': ['scadray'] }],
  });
});

test('Kate', () => {
  const { servers } = JSON.parse(configurationOf('Kate')) as { servers: Record<string, { command: string[] }> };
  assert.deepEqual(servers['openscad']!.command, ['scadray', 'serve']);
});

test('Sublime Text', () => {
  const { clients } = JSON.parse(configurationOf('Sublime Text')) as { clients: Record<string, unknown> };
  assert.deepEqual(clients['scadray'], { enabled: true, command: ['scadray', 'serve'], selector: 'source.scad' });
});
