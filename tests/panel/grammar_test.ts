// VS Code's grammar, snippets and language configuration.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { before, test } from 'node:test';
import * as oniguruma from 'vscode-oniguruma';
import * as textmate from 'vscode-textmate';

const folder = `${process.env['SCADRAY_SOURCE']}/frontend/editors/vscode`;
const read = (name: string): string => readFileSync(`${folder}/${name}`, 'utf8');

let grammar: textmate.IGrammar;
before(async () => {
  await oniguruma.loadWASM(readFileSync(`${process.env['NODE_PATH']}/vscode-oniguruma/release/onig.wasm`));
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => textmate.parseRawGrammar(read('syntaxes/scad.tmLanguage.json'), 'scad.json'),
  });
  grammar = (await registry.loadGrammar('source.scad'))!;
});

/** Returns the innermost scope of each word of a text. */
function scopes(text: string): Record<string, string> {
  const found: Record<string, string> = {};
  let state = textmate.INITIAL;
  for (const line of text.split('\n')) {
    const { tokens, ruleStack } = grammar.tokenizeLine(line, state);
    for (const { startIndex, endIndex, scopes: of } of tokens) found[line.slice(startIndex, endIndex).trim()] = of.at(-1)!;
    state = ruleStack;
  }
  return found;
}

test('words have their scopes', () => {
  const of = scopes('use <lib.scad>\nmodule box(w = 1.5e3, d) { #cube([w, $fn, PI]); own(); }\nfunction f(x) = sin(x) + a.x;\ns = "a\\n"; // end');
  assert.equal(of['use'], 'keyword.control.import.scad');
  assert.equal(of['lib.scad'], 'string.quoted.other.file.scad');
  assert.equal(of['box'], 'entity.name.function.module.scad');
  assert.equal(of['1.5e3'], 'constant.numeric.scad');
  assert.equal(of['d'], 'variable.parameter.scad');
  assert.equal(of['#'], 'keyword.operator.modifier.scad');
  assert.equal(of['cube'], 'support.function.module.scad');
  assert.equal(of['own'], 'entity.name.function.call.scad');
  assert.equal(of['$fn'], 'variable.language.special.scad');
  assert.equal(of['PI'], 'constant.language.scad');
  assert.equal(of['sin'], 'support.function.scad');
  assert.equal(of['f'], 'entity.name.function.scad');
  assert.equal(of['\\n'], 'constant.character.escape.scad');
  assert.equal(of['end'], 'comment.line.double-slash.scad');
});

test('a comment of the customizer has its group', () => {
  assert.equal(scopes('/* [Size] */')['[Size]'], 'entity.name.section.scad');
  assert.equal(scopes('/* a\nb */ c')['c'], 'variable.other.scad');
});

test('snippets and the configuration are well formed', () => {
  const snippets = JSON.parse(read('snippets/scad.json')) as Record<string, { prefix: string; body: string | string[] }>;
  const prefixes = Object.values(snippets).map(({ prefix }) => prefix);
  assert.equal(new Set(prefixes).size, prefixes.length);
  const { wordPattern, indentationRules } = JSON.parse(read('language-configuration.json')) as {
    wordPattern: string;
    indentationRules: { increaseIndentPattern: string };
  };
  assert.equal('$fn'.match(new RegExp(wordPattern))?.[0], '$fn');
  assert.match('module m() {', new RegExp(indentationRules.increaseIndentPattern));
  assert.doesNotMatch('cube(1); // {', new RegExp(indentationRules.increaseIndentPattern));
});
