// The panel in Chromium, with the server run for real: each test leaves a picture of the page.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import type { Browser, CDPSession, Page, WebSocketRoute } from 'playwright-core';
import { Panel, type PanelOptions, launch } from './support/browser';

let browser: Browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const box = `/* [Size] */
// of the box
width = 20; // [10:40]
height = 10;
/* [Form] */
form = "round"; // [round, square]
lid = true;

module hole() cylinder(h = 3 * height, d = 8, center = true);
difference() {
  cube([width, width, height], center = true);
  hole();
}
if (lid) translate([0, 0, height]) color("tomato") cube([width, width, 2], center = true);
`;

/** Runs a test with a panel; the page may not have met an error. */
function panelTest(
  name: string,
  run: (panel: Panel, page: Page) => Promise<void>,
  { text = box, ...options }: PanelOptions & { text?: string } = {},
): void {
  test(name, { timeout: 60_000 }, async () => {
    const panel = await Panel.open(browser, { text }, { shading: 'flat', ...options });
    try {
      await run(panel, panel.page);
      await panel.screenshot(name.replace(/[^a-z0-9]+/gi, '_'));
      assert.deepEqual(panel.errors, []);
    } finally {
      await panel.close();
    }
  });
}

panelTest('opens and follows each save', async (panel) => {
  const first = await panel.frame();
  const before = await panel.pixels();
  panel.write(box.replace('width = 20', 'width = 30'));
  await panel.frame({ number: first.number, version: first.version + 1 });
  assert.notEqual(await panel.pixels(), before);
  assert.match(await panel.text('.status'), /600 × 450, \d+(\.\d)? ms/);
}, { shading: 'studio' });

panelTest('the mouse turns, pans and zooms', async (panel, page) => {
  let shown = await panel.frame();
  const seen = [await panel.pixels()];
  const drag = async (button: 'left' | 'right' | 'middle') => {
    await page.mouse.move(300, 225);
    await page.mouse.down({ button });
    await page.mouse.move(330, 230, { steps: 5 });
    await page.mouse.up({ button });
  };
  for (const act of [() => drag('left'), () => drag('right'), () => drag('middle'), () => page.mouse.wheel(0, -300)]) {
    await act();
    shown = await panel.frame(shown);
    seen.push(await panel.pixels());
  }
  assert.equal(new Set(seen).size, seen.length);
  assert.ok(await page.locator('.card').isHidden(), 'a drag is no click');
});

/** Touches with fingers, which move from place to place. */
async function touch(session: CDPSession, steps: [number, number][][]): Promise<void> {
  const points = (places: [number, number][]) => places.map(([x, y], id) => ({ x, y, id }));
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: points(steps[0]!) });
  for (const places of steps.slice(1)) {
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: points(places) });
  }
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
}

panelTest(
  'fingers turn, pan, pinch and tap',
  async (panel, page) => {
    let shown = await panel.frame();
    const session = await page.context().newCDPSession(page);
    const seen = [await panel.pixels()];
    const gestures: [number, number][][][] = [
      [[[160, 250]], [[180, 260]], [[200, 270]]],
      [[[120, 250], [200, 250]], [[130, 280], [210, 280]], [[140, 300], [220, 300]]],
      [[[140, 250], [180, 250]], [[130, 250], [190, 250]], [[110, 250], [210, 250]]],
    ];
    for (const gesture of gestures) {
      await touch(session, gesture);
      shown = await panel.frame(shown);
      seen.push(await panel.pixels());
    }
    assert.equal(new Set(seen).size, seen.length);
    await page.touchscreen.tap(160, 280);
    await page.locator('.card').waitFor();
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 320, 'nothing is wider than the page');
  },
  { viewport: { width: 320, height: 560 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 },
);

panelTest('a pen turns, hovers, measures and centres', async (panel, page) => {
  let shown = await panel.frame();
  const session = await page.context().newCDPSession(page);
  const seen = [await panel.pixels()];
  const pen = (type: 'mousePressed' | 'mouseMoved' | 'mouseReleased', x: number, y: number, button: 'left' | 'right' | 'none' = 'left') =>
    session.send('Input.dispatchMouseEvent', { type, x, y, button, clickCount: type === 'mouseMoved' ? 0 : 1, pointerType: 'pen' });
  for (const button of ['left', 'right'] as const) {
    await pen('mousePressed', 300, 225, button);
    for (let i = 1; i <= 5; i++) await pen('mouseMoved', 300 + 8 * i, 225 + 2 * i, button);
    await pen('mouseReleased', 340, 235, button);
    shown = await panel.frame(shown);
    seen.push(await panel.pixels());
  }
  assert.ok(await page.locator('.card').isHidden(), 'a drag is no tap');
  await pen('mouseMoved', 320, 230, 'none');
  await page.locator('.tooltip', { hasText: 'cube' }).waitFor();
  // Two taps that are as unsteady as a hand.
  await pen('mousePressed', 320, 230);
  await pen('mouseMoved', 325, 234);
  await pen('mouseReleased', 325, 234);
  await page.locator('.card').waitFor();
  await page.waitForTimeout(500);
  for (const [x, y] of [[250, 260], [257, 252]] as const) {
    await pen('mousePressed', x, y);
    await pen('mouseReleased', x, y);
  }
  await panel.frame(shown);
  seen.push(await panel.pixels());
  assert.ok(await page.locator('.card').isHidden(), 'a double tap centres');
  assert.equal(new Set(seen).size, seen.length);
});

panelTest('keys alone do all that the mouse does', async (panel, page) => {
  let shown = await panel.frame();
  await page.locator('.picture').focus();
  const seen = [await panel.pixels()];
  for (const key of ['ArrowLeft', 'Shift+ArrowUp', '+', '8', 'o', 'Home']) {
    await page.keyboard.press(key);
    shown = await panel.frame(shown);
    seen.push(await panel.pixels());
  }
  assert.equal(new Set(seen).size, seen.length);
  await page.keyboard.press('Enter');
  await page.locator('.card').waitFor();
  await page.keyboard.press('Escape');
  await page.locator('.card').waitFor({ state: 'hidden' });
  // Tab goes through the toolbar; the sheet takes the focus, and gives it back.
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement?.ariaLabel), 'View all (V, Home)');
  await page.keyboard.press('?');
  await page.locator('.drawer h2', { hasText: 'Mouse and keys' }).waitFor();
  assert.equal(await page.locator('.keys td', { hasText: /^Turn the section plane$/ }).count(), 1);
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => document.activeElement?.className), 'picture');
  await page.keyboard.press('w');
});

panelTest('a click measures, names the place and opens its line', async (panel, page) => {
  await panel.frame();
  await page.keyboard.press('4');
  await panel.frame();
  await page.mouse.click(300, 225);
  const card = page.locator('.card');
  await card.waitFor();
  assert.match(await card.innerText(), /cube[^]*normal \[0, 0, 1\][^]*design\.scad:14/);
  await page.locator('.card button.link').first().click();
  await page.locator('.line.revealed', { hasText: 'tomato' }).waitFor();
  await page.mouse.click(200, 260);
  await page.locator('.card .relation').first().waitFor();
  await panel.screenshot('measured');
  panel.write(box.replace('width = 20', 'width = 21')); // what was measured may be elsewhere now
  await card.waitFor({ state: 'hidden' });
});

panelTest('the cursor lights what its line makes', async (panel, page) => {
  let shown = await panel.frame();
  const plain = await panel.pixels();
  await page.keyboard.press('t');
  await page.locator('.line', { hasText: 'tomato' }).click();
  shown = await panel.frame(shown);
  const lit = await panel.pixels();
  assert.notEqual(lit, plain);
  await panel.screenshot('lit');
  await page.keyboard.press('Escape');
  await panel.frame(shown);
  assert.equal(await panel.pixels(), plain);
});

/** Returns whether elements of the page cover each other. */
async function overlap(page: Page, a: string, b: string): Promise<boolean> {
  const [p, q] = await Promise.all([a, b].map((selector) => page.locator(selector).boundingBox()));
  if (!p || !q) return false;
  return p.x < q.x + q.width && q.x < p.x + p.width && p.y < q.y + q.height && q.y < p.y + p.height;
}

for (const width of [320, 600, 900]) {
  panelTest(
    `a sheet and a strip leave each other room at ${width} pixels`,
    async (panel, page) => {
      await panel.frame();
      await page.keyboard.press('c');
      await page.locator('.strip.section').waitFor();
      assert.ok(!(await overlap(page, '.status', '.strip.section')));
      const fit = () => page.locator('.strip.section input[type=number]').evaluateAll((fields) => fields.every((field) => field.scrollWidth <= field.clientWidth));
      assert.ok(await fit(), 'the normal is shown whole');
      await page.locator('.picture').focus();
      await page.keyboard.press('Enter');
      await page.locator('.card').waitFor();
      await page.keyboard.press('Shift+P');
      await page.locator('.drawer').waitFor();
      assert.ok(!(await overlap(page, '.drawer', '.card')));
      assert.ok(!(await overlap(page, '.drawer', '.strip.section')));
      assert.ok(await fit(), 'the normal is shown whole beside a sheet');
      assert.ok(!(await overlap(page, '.drawer', '.status')));
      assert.ok(!(await overlap(page, '.status', '.strip.section')));
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      await panel.screenshot(`room_${width}`);
    },
    { viewport: { width, height: 480 }, colorScheme: width === 320 ? 'dark' : 'light' },
  );
}

panelTest('parameters move the design', async (panel, page) => {
  const shown = await panel.frame();
  const plain = await panel.pixels();
  await page.keyboard.press('Shift+P');
  const slider = page.locator('input[type=range][aria-label=width]');
  await slider.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press('ArrowRight');
  assert.equal(await page.locator('input[type=number][aria-label=width]').inputValue(), '25');
  await panel.frame(shown);
  await page.waitForTimeout(300);
  const wide = await panel.pixels();
  assert.notEqual(wide, plain);
  await page.locator('input[aria-label=lid]').uncheck();
  await page.locator('select[aria-label=form]').selectOption({ label: 'square' });
  assert.equal(await page.locator('.parameter.changed').count(), 3);
  await panel.screenshot('parameters');
  await page.locator('summary', { hasText: 'Sets' }).click();
  await page.locator('input[aria-label="Name of a set"]').fill('wide');
  await page.locator('button', { hasText: 'Save' }).first().click();
  await page.locator('select[aria-label="Set of values"] option', { hasText: 'wide' }).waitFor({ state: 'attached' });
  assert.match(readFileSync(join(panel.folder, 'design.json'), 'utf8'), /"width": "25"/);
  await page.locator('button', { hasText: 'Reset all' }).click();
  await page.waitForFunction((before) => document.querySelector('canvas')!.toDataURL() === before, plain);
  await page.locator('select[aria-label="Set of values"]').selectOption('wide');
  await page.waitForFunction(() => document.querySelector<HTMLInputElement>('input[type=number][aria-label=width]')!.value === '25');
});

panelTest('a section plane cuts the design open', async (panel, page) => {
  let shown = await panel.frame();
  const plain = await panel.pixels();
  await page.locator('button[aria-label^="Section plane"]').click();
  shown = await panel.frame(shown);
  const cut = await panel.pixels();
  assert.notEqual(cut, plain);
  await page.keyboard.press('y');
  shown = await panel.frame(shown);
  await page.keyboard.press('PageUp');
  shown = await panel.frame(shown);
  await page.mouse.move(300, 225);
  await page.keyboard.down('Control');
  await page.mouse.down();
  await page.mouse.move(310, 190, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up('Control');
  shown = await panel.frame(shown);
  assert.equal(await page.locator('.strip [aria-pressed=true]').innerText(), 'y');
  await panel.screenshot('section');
  await page.keyboard.press('c');
  await panel.frame(shown);
  assert.equal(await panel.pixels(), plain);
});

panelTest('a section plane lies along a face, through three points and at any angle', async (panel, page) => {
  let shown = await panel.frame();
  const seen = [await panel.pixels()];
  const normal = () => Promise.all(['x', 'y', 'z'].map(async (axis) => Number(await page.locator(`input[aria-label="Normal, ${axis}"]`).inputValue())));
  const next = async () => {
    shown = await panel.frame(shown);
    seen.push(await panel.pixels());
  };
  await page.locator('.picture').focus();
  await page.keyboard.press('Shift+F');
  assert.match(await panel.text('.status'), /Click on a flat face first/);
  await page.keyboard.press('Shift+C');
  assert.match(await panel.text('.status'), /Click on three points first/);
  await page.keyboard.press('8');
  assert.doesNotMatch(await panel.text('.status'), /Click/);
  shown = await panel.frame(shown);
  await page.mouse.click(300, 270); // the front of the box
  await page.locator('.card').waitFor();
  await page.keyboard.press('Shift+F');
  await next();
  assert.deepEqual((await normal()).map(Math.abs), [0, 1, 0]);
  await page.keyboard.press('0');
  await next();
  await page.keyboard.press('Control+ArrowUp');
  await next();
  const [x, y, z] = await normal();
  assert.ok(Math.abs(Math.hypot(x!, y!, z!) - 1) < 1e-3 && Math.abs(y!) < 1, `${x}, ${y}, ${z}`);
  await page.mouse.move(300, 225);
  await page.keyboard.down('Control');
  await page.keyboard.down('Shift');
  await page.mouse.down();
  await page.mouse.move(340, 240, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up('Shift');
  await page.keyboard.up('Control');
  await next();
  await page.locator('input[aria-label="Normal, z"]').fill('2');
  await next();
  assert.ok((await normal())[0]! < 1, 'the others follow what is typed');
  await panel.screenshot('tilted_section');
  await page.keyboard.press('Escape');
  await page.locator('.picture').focus();
  await page.keyboard.press('c');
  await panel.frame(shown);
  assert.equal(await panel.pixels(), seen[0]);
  await page.keyboard.press('4');
  shown = await panel.frame(shown);
  await page.keyboard.down('Alt');
  for (const [x, y] of [[270, 200], [330, 200], [290, 240]] as const) await page.mouse.click(x, y);
  await page.keyboard.up('Alt');
  await page.locator('.card').waitFor();
  await page.waitForTimeout(100);
  await page.keyboard.press('Shift+C');
  await next();
  assert.deepEqual((await normal()).map(Math.abs), [0, 0, 1]);
  assert.equal(new Set(seen).size, seen.length);
});

panelTest('an error stands over the last good picture', async (panel, page) => {
  await panel.frame();
  const good = await panel.pixels();
  panel.write(box.replace('hole();', 'hole(;'));
  await page.locator('.banner').waitFor();
  assert.equal(await panel.pixels(), good);
  assert.match(await page.title(), /^error: design\.scad/);
  await page.locator('.banner button').click();
  await page.locator('.line.revealed', { hasText: 'hole(;' }).waitFor();
  await panel.screenshot('error');
  panel.write(box);
  await page.locator('.banner').waitFor({ state: 'hidden' });
});

panelTest('messages are counted and filtered', async (panel, page) => {
  await panel.frame();
  assert.equal(await panel.text('.badge'), '4');
  await page.keyboard.press('m');
  assert.equal(await page.locator('.messages li').count(), 2);
  assert.match(await panel.text('.messages li:first-child'), /ECHO: 1[^]*3×/);
  await page.locator('.messages input').fill('unknown');
  assert.equal(await page.locator('.messages li').count(), 1);
}, { text: 'for (i = [1 : 3]) echo(1);\ncube(10);\nsphere(nothing);\n' });

panelTest('an animation plays', async (panel, page) => {
  await panel.frame();
  await page.locator('button[aria-label^="Animation"]').waitFor();
  await page.keyboard.press(' ');
  await page.waitForFunction(() => Number(document.querySelector<HTMLInputElement>('input[aria-label="$t"]')!.value) > 0.05);
  await page.keyboard.press(' ');
  assert.equal(await page.locator('button[aria-label^="Play"]').count(), 1);
}, { text: 'translate([20 * $t, 0, 0]) cube(10);\ncube(1);\n' });

panelTest('pictures and models are written', async (panel, page) => {
  await panel.frame();
  for (const [key, name] of [['s', 'design.png'], ['Shift+S', 'design.stl']] as const) {
    await page.keyboard.press(key);
    await page.locator('.save button[type=submit]').click();
    await page.locator('.notice', { hasText: name }).filter({ hasText: 'is written' }).waitFor();
    assert.ok(existsSync(join(panel.folder, name)));
  }
});

let sockets: WebSocketRoute[] = [];
let isCut = false;
panelTest(
  'a lost connection is told of, and comes back as it was',
  async (panel, page) => {
    const shown = await panel.frame();
    await page.keyboard.press('8');
    await page.keyboard.press('Shift+P');
    await page.locator('input[type=number][aria-label=width]').fill('30');
    await page.locator('button[aria-label^="Section plane"]').click();
    await panel.frame(shown);
    await page.waitForTimeout(300);
    const before = await panel.pixels();
    isCut = true;
    for (const socket of sockets.splice(0)) await socket.close();
    await page.locator('.status.lost').waitFor();
    assert.match(await panel.text('.status'), /connection to scadray is lost/);
    assert.equal(await panel.pixels(), before);
    await panel.screenshot('lost');
    await page.mouse.move(200, 200);
    isCut = false;
    await page.locator('.status button', { hasText: 'Try again' }).click();
    await page.waitForFunction(() => !document.querySelector('.status.lost'));
    await page.waitForFunction((picture) => document.querySelector('canvas')!.toDataURL() === picture, before);
    const width = 'input[type=number][aria-label=width]';
    await page.waitForFunction((field) => document.querySelector<HTMLInputElement>(field)!.value === '30', width);
    // It tries again by itself, too, and a page that is loaded anew is as it was.
    for (const socket of sockets.splice(0)) await socket.close();
    await page.waitForFunction(() => !document.querySelector('.status.lost'));
    await page.reload();
    await panel.frame();
    await page.waitForFunction((picture) => document.querySelector('canvas')!.toDataURL() === picture, before);
  },
  {
    before: (page) =>
      page.routeWebSocket(/socket/, (socket) => {
        if (isCut) {
          void socket.close();
        } else {
          socket.connectToServer();
          sockets.push(socket);
        }
      }),
  },
);

panelTest(
  'is dark where the browser is, and follows it',
  async (panel, page) => {
    const shown = await panel.frame();
    const dark = await panel.pixels();
    await page.keyboard.press('w');
    await panel.screenshot('dark');
    await page.emulateMedia({ colorScheme: 'light' });
    await panel.frame(shown);
    assert.notEqual(await panel.pixels(), dark);
    assert.equal(await page.locator('select[aria-label=Colours]').inputValue(), 'Cornfield');
  },
  { colorScheme: 'dark' },
);

test('the picture in README.md', { timeout: 120_000 }, async () => {
  const file = `${process.env['SCADRAY_SOURCE']}/examples/enclosure.scad`;
  const panel = await Panel.open(browser, { file }, { viewport: { width: 960, height: 540 }, colorScheme: 'light' });
  try {
    const { page } = panel;
    let shown = await panel.frame();
    await page.keyboard.press('t');
    await page.keyboard.press('v'); // clear of the text
    shown = await panel.frame(shown);
    await page.locator('.line', { hasText: 'standoff();' }).click();
    await panel.frame(shown);
    await panel.screenshot('panel');
    assert.deepEqual(panel.errors, []);
  } finally {
    await panel.close();
  }
});
