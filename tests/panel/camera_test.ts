// The camera's arithmetic (frontend/serve/panel/src/camera.ts).
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pan, lookFrom, moveAlong, pan, project, turn, viewOf, zoom } from '../../frontend/serve/panel/src/camera';
import type { Camera, Vec3 } from '../../frontend/serve/panel/src/protocol';

const camera: Camera = { rotation: [55, 10, 25], translation: [1, 2, 3], distance: 140, fov: 22.5, projection: 'perspective' };
const size = { width: 800, height: 600 };

function near(a: readonly number[], b: readonly number[]): void {
  a.forEach((x, i) => assert.ok(Math.abs(x - b[i]!) < 1e-9 * (1 + Math.abs(x)), `${a} ≠ ${b}`));
}
const seen = (of: Camera, point: Vec3): number[] => {
  const place = project(of, size, point)!;
  return [place.x, place.y];
};

test('the target is in the middle, and the eye at its distance', () => {
  near(seen(camera, [1, 2, 3]), [400, 300]);
  near([Math.hypot(...viewOf(camera).eye.map((x, i) => x - camera.translation[i]!))], [140]);
});

test('axes are those of the standard views', () => {
  const front = viewOf(lookFrom(camera, 'front'));
  near(front.right, [1, 0, 0]);
  near(front.up, [0, 0, 1]);
  near(front.forward, [0, 1, 0]);
  near(viewOf(lookFrom(camera, 'left')).forward, [1, 0, 0]);
});

test('a point behind the eye is not seen', () => {
  const top = { ...lookFrom(camera, 'top'), translation: [0, 0, 0] as Vec3 };
  assert.equal(project(top, size, [0, 0, 141]), null);
});

for (const projection of ['perspective', 'ortho'] as const) {
  test(`the wheel keeps what is under it (${projection})`, () => {
    const before = { ...camera, projection };
    const { right, up } = viewOf(before);
    const point = before.translation.map((x, i) => x + 7 * right[i]! - 4 * up[i]!) as Vec3;
    const [x, y] = seen(before, point);
    const after = zoom(before, 3, x!, y!, size);
    near([after.distance], [140 * 0.9 ** 3]);
    near(seen(after, point), [x!, y!]);
  });

  test(`a pan keeps the point under the mouse (${projection})`, () => {
    const before = { ...camera, projection };
    const point: Vec3 = [5, -3, 20];
    const [x, y] = seen(before, point);
    const drag = new Pan(before);
    let moved = drag.move(before, 10, 5, size);
    moved = drag.take(point, moved, size)!; // its depth is known only then
    moved = drag.move(moved, 20, -40, size);
    near(seen(moved, point), [x! + 30, y! - 35]);
  });
}

test('a pan goes on from where something else has moved the camera', () => {
  const drag = new Pan(camera);
  drag.move(camera, 10, 0, size);
  const elsewhere = turn(camera, 5, 5);
  assert.deepEqual(drag.move(elsewhere, 3, 4, size), pan(elsewhere, 3, 4, size));
});

test('a drag turns as the window does', () => {
  near(turn(camera, 10, -20).rotation, [69, 10, 18]);
  near(turn(camera, 10, 100, true).rotation, [345, 3, 25]);
});

test('moving along goes where the camera looks', () => {
  near(seen(moveAlong(camera, 60, size), camera.translation), [400, 300]);
  const { translation } = moveAlong(camera, 60, size);
  near(viewOf(camera).forward.map((x, i) => camera.translation[i]! + 29.4 * x), translation);
});
