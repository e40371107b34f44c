// measure.ts: how long Chromium's panel of 800 × 600 pixels takes to show an edit, and how fast it turns. By
// `tests/panel/run PROGRAM FOLDER measure`; no test, since times depend on what else the machine does. Each line of its
// output that begins with "{" is the JSON of one of these:
//   {"design", "light", "edit_ms": from each save to the full frame}
//   {"design", "frames_per_second": while the mouse turns it, "width_px": of half of the frames or more,
//    "gap_ms": between frames}
import { join } from 'node:path';
import { Panel, launch } from './support/browser';

const edits = 20;
const turn_s = 4;

/** 30 lines, of which each edit changes one number. */
const short = (n: number): string =>
  [
    `size = ${10 + n / 100};`, 'wall = 1.5;', 'height = 8;', 'holes = 6;',
    'module post(x, y) translate([x, y, 0]) cylinder(r = wall, h = height);',
    'module box() {', '  difference() {', '    cube([4 * size, 3 * size, height]);',
    '    translate([wall, wall, wall])', '      cube([4 * size - 2 * wall, 3 * size - 2 * wall, height]);', '  }', '}',
    'module lid() {', '  difference() {', '    cube([4 * size, 3 * size, wall]);', '    for (i = [0 : holes - 1])',
    '      translate([4 + 5 * i, 4, -1]) cylinder(d = 3, h = 10);', '  }', '}',
    'function corners() = [for (x = [3, 4 * size - 3], y = [3, 3 * size - 3]) [x, y]];', 'box();',
    'for (c = corners()) post(c[0], c[1]);', 'translate([0, 4 * size, 0]) lid();', 'translate([-10, 0, 0]) sphere(r = 4);',
    'translate([-10, 10, 0]) sphere(r = 3);', 'color("red") translate([-10, 20, 0]) cube(4);', 'rotate([0, 0, 30])',
    '  translate([-20, 0, 0])', '  cube([3, 3, 9]);', '',
  ].join('\n');

/** 2,000 primitives of nested modules. */
const many = (n: number): string => `bump = ${1 + n / 1000};
module pin() { cylinder(r = 0.4, h = 3); translate([0, 0, 3]) sphere(r = 0.4 * bump); }
module row() { for (i = [0 : 39]) translate([i, 0, 0]) pin(); }
for (j = [0 : 24]) translate([0, j, 0]) row();
`;

const told = (measured: object): void => console.log(JSON.stringify(measured));
const middle = (values: number[]): number => [...values].sort((a, b) => a - b)[values.length >> 1]!;

/** Notes when each frame is on the canvas, in ms since 1970. */
async function note(panel: Panel): Promise<void> {
  await panel.page.evaluate(() => {
    const shown: { at: number; version: number; width: number; final: boolean }[] = [];
    Object.assign(window, { shown });
    const canvas = document.querySelector('canvas')!;
    new MutationObserver(() => {
      const { version, final } = canvas.dataset;
      shown.push({ at: performance.timeOrigin + performance.now(), version: Number(version), width: canvas.width, final: final === 'true' });
    }).observe(canvas, { attributes: true, attributeFilter: ['data-number'] });
  });
}

type Noted = { shown: { at: number; version: number; width: number; final: boolean }[] };

async function measureEdits(name: string, text: (n: number) => string): Promise<void> {
  const browser = await launch();
  for (const light of ['studio', 'flat']) {
    const panel = await Panel.open(browser, { text: text(0) }, { viewport: { width: 800, height: 600 } });
    let { version } = await panel.frame();
    if (light === 'flat') await panel.page.keyboard.press('l');
    await panel.page.waitForTimeout(1500);
    await note(panel);
    const times: number[] = [];
    for (let n = 1; n <= edits; n++) {
      const begun = performance.timeOrigin + performance.now();
      panel.write(text(n));
      const wanted = version + 1;
      const handle = await panel.page.waitForFunction(
        (least) => (window as unknown as Noted).shown.find((one) => one.version >= least && one.width === 800)?.at,
        wanted,
      );
      times.push(((await handle.jsonValue()) as number) - begun);
      await panel.page.waitForFunction((least) => (window as unknown as Noted).shown.some((one) => one.version >= least && one.final), wanted);
      await panel.page.waitForTimeout(100);
      version = await panel.page.evaluate(() => (window as unknown as Noted).shown.at(-1)!.version);
    }
    told({ design: name, light, edit_ms: times });
    await panel.close();
  }
  await browser.close();
}

async function measureTurning(): Promise<void> {
  const browser = await launch();
  const file = join(process.env['SCADRAY_SOURCE']!, 'examples/cs1000.scad');
  const panel = await Panel.open(browser, { file }, { viewport: { width: 800, height: 600 } });
  await panel.frame();
  await note(panel);
  const { page } = panel;
  await page.mouse.move(400, 300);
  await page.mouse.down();
  const begun = performance.now();
  for (let i = 0; performance.now() - begun < 1000 * turn_s; i++) {
    await page.mouse.move(400 + 200 * Math.sin(i / 20), 300 + 60 * Math.cos(i / 20));
  }
  const frames = await page.evaluate(() => (window as unknown as Noted).shown);
  await page.mouse.up();
  const gaps = frames.slice(1).map(({ at }, i) => at - frames[i]!.at);
  told({ design: 'CS1000', frames_per_second: frames.length / turn_s, width_px: middle(frames.map(({ width }) => width)), gap_ms: gaps });
  await panel.close();
  await browser.close();
}

void (async () => {
  await measureEdits('30 lines', short);
  await measureEdits('2,000 primitives', many);
  await measureTurning();
})();
