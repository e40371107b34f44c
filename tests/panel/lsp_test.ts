// Each feature of the language server, through the types of vscode-languageserver-protocol.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import {
  ColorInformation,
  ColorPresentationRequest,
  type CompletionItem,
  CompletionItemKind,
  CompletionRequest,
  DefinitionRequest,
  Diagnostic,
  DiagnosticSeverity,
  DiagnosticTag,
  DocumentColorRequest,
  DocumentSymbol,
  DocumentSymbolRequest,
  FoldingRange,
  FoldingRangeRequest,
  Hover,
  HoverRequest,
  Location,
  MarkupContent,
  PrepareRenameRequest,
  Range,
  ReferencesRequest,
  RenameRequest,
  SignatureHelpRequest,
  SymbolKind,
  TextEdit,
  WorkspaceEdit,
} from 'vscode-languageserver-protocol/node';
import { StdioClient, marked } from './support/stdio_client';

let client: StdioClient;
before(async () => (client = await StdioClient.start()));
after(() => client.end());

let files = 0;
/** Opens a text whose `|` is the cursor, and returns what a request at it needs. */
async function at(text: string) {
  const { text: plain, position } = marked(text);
  return { textDocument: { uri: await client.open(`at${++files}.scad`, plain) }, position };
}

test('the server tells its capabilities', () => {
  const { capabilities, serverInfo } = client.initialized;
  assert.equal(serverInfo?.name, 'scadray');
  for (const name of ['hoverProvider', 'definitionProvider', 'referencesProvider', 'documentSymbolProvider'] as const) {
    assert.ok(capabilities[name], name);
  }
  assert.deepEqual(capabilities.renameProvider, { prepareProvider: true });
});

test('diagnostics follow what is typed and not saved', async () => {
  const uri = client.write('typed.scad', 'cube(1);\n');
  await client.open('typed.scad', 'cube(1;\n');
  const [error] = await client.diagnosticsOf(uri);
  assert.ok(Diagnostic.is(error));
  assert.equal(error.severity, DiagnosticSeverity.Error);
  assert.equal(error.source, 'scadray');
  await client.change(uri, 'cube(1);\nsphere(r);\n');
  const [warning] = await client.diagnosticsOf(uri);
  assert.ok(Diagnostic.is(warning));
  assert.equal(warning.severity, DiagnosticSeverity.Warning);
  assert.match(warning.message, /unknown variable .?r/);
  assert.deepEqual(warning.range, Range.create(1, 7, 1, 8));
  await client.change(uri, 'cube(1);\n');
  assert.deepEqual(await client.diagnosticsOf(uri), []);
});

test('a trace is related information', async () => {
  const uri = await client.open('trace.scad', 'module m(x) { assert(x > 1); }\nm(1);\n');
  const [error] = await client.diagnosticsOf(uri);
  const related = error?.relatedInformation ?? [];
  assert.ok(related.length > 0 && related.every(({ location }) => Location.is(location)));
  assert.ok(related.some(({ location }) => location.range.start.line === 1));
});

test('deprecated things are tagged', async () => {
  const uri = await client.open('old.scad', 'assign(a = 1) cube(a);\n');
  const list = await client.diagnosticsOf(uri);
  assert.ok(list.some(({ tags }) => tags?.includes(DiagnosticTag.Deprecated)), JSON.stringify(list));
});

test('completion', async () => {
  const found = await client.connection.sendRequest(CompletionRequest.type, await at('module mybox() {}\nmy|\n'));
  assert.ok(found);
  const items: CompletionItem[] = Array.isArray(found) ? found : found.items;
  const item = items.find(({ label }) => label === 'mybox');
  assert.ok(item);
  assert.ok(item.kind !== undefined && Object.values(CompletionItemKind).includes(item.kind as never));
});

test('completion of files', async () => {
  client.write('library.scad', 'module l() {}\n');
  const found = await client.connection.sendRequest(CompletionRequest.type, await at('include <lib|>\n'));
  const items = Array.isArray(found) ? found : (found?.items ?? []);
  assert.ok(items.some(({ label }) => label === 'library.scad'));
});

test('signature help', async () => {
  const help = await client.connection.sendRequest(SignatureHelpRequest.type, await at('cylinder(h = 1, |)\n'));
  assert.ok(help);
  assert.match(help.signatures[0]!.label, /^cylinder\(/);
  assert.ok(help.signatures[0]!.parameters!.length > 2);
});

test('hover', async () => {
  const hover = await client.connection.sendRequest(HoverRequest.type, await at('// A box.\nmodule box(w) cube(w);\nb|ox(1);\n'));
  assert.ok(hover && Hover.is(hover) && MarkupContent.is(hover.contents));
  assert.match(hover.contents.value, /module box\(w\)[^]*A box\./);
});

test('definition and references, across files', async () => {
  const library = client.write('parts.scad', 'module part() {}\n');
  const where = await at('use <parts.scad>\npart();\npa|rt();\n');
  const definition = await client.connection.sendRequest(DefinitionRequest.type, where);
  const places = [definition ?? []].flat();
  assert.ok(places.every((place) => Location.is(place)));
  assert.equal((places[0] as Location).uri, library);
  const references = await client.connection.sendRequest(ReferencesRequest.type, {
    ...where,
    context: { includeDeclaration: true },
  });
  assert.ok(references?.every(Location.is));
  assert.equal(references.length, 3);
});

test('rename', async () => {
  const where = await at('size = 1; // 𝒂\ncube(si|ze);\n');
  const prepared = await client.connection.sendRequest(PrepareRenameRequest.type, where);
  const range = prepared && 'range' in prepared ? prepared.range : prepared;
  assert.deepEqual(range, Range.create(1, 5, 1, 9));
  const edit = await client.connection.sendRequest(RenameRequest.type, { ...where, newName: 'width' });
  assert.ok(WorkspaceEdit.is(edit));
  assert.deepEqual(
    edit.changes?.[where.textDocument.uri]?.map((one) => one.range.start.line).sort(),
    [0, 1],
  );
});

test('document symbols', async () => {
  const { textDocument } = await at('module outer() { module inner() {} }\nx = 1;|\n');
  const symbols = await client.connection.sendRequest(DocumentSymbolRequest.type, { textDocument });
  assert.ok(symbols?.every((symbol) => DocumentSymbol.is(symbol)));
  const [outer, x] = symbols as DocumentSymbol[];
  assert.equal(outer?.name, 'outer');
  assert.equal(outer?.children?.[0]?.name, 'inner');
  assert.equal(x?.kind, SymbolKind.Variable);
});

test('folding', async () => {
  const { textDocument } = await at('module m() {\n  cube(1);\n  cube(2);\n}|\n');
  const ranges = await client.connection.sendRequest(FoldingRangeRequest.type, { textDocument });
  assert.ok(ranges?.length && ranges.every(FoldingRange.is));
  assert.equal(ranges[0]?.startLine, 0);
});

test('colours', async () => {
  const { textDocument } = await at('color("red") cube(1);|\n');
  const [color] = await client.connection.sendRequest(DocumentColorRequest.type, { textDocument });
  assert.ok(ColorInformation.is(color));
  assert.deepEqual(color.color, { red: 1, green: 0, blue: 0, alpha: 1 });
  const spelled = await client.connection.sendRequest(ColorPresentationRequest.type, {
    textDocument,
    range: color.range,
    color: { red: 0, green: 0, blue: 1, alpha: 1 },
  });
  assert.deepEqual(spelled[0]?.label, '"#0000ff"');
  assert.ok(spelled.every(({ textEdit }) => TextEdit.is(textEdit)));
});
