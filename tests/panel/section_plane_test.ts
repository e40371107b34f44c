// How the section plane is laid, moved and turned (frontend/serve/panel/src/section_plane.ts).
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { cross, dot, length, project, subtract, viewOf } from '../../frontend/serve/panel/src/camera';
import type { Preview } from '../../frontend/serve/panel/src/preview';
import type { Camera, Section, Vec3 } from '../../frontend/serve/panel/src/protocol';
import { SectionPlane, positionsIn } from '../../frontend/serve/panel/src/section_plane';

const camera: Camera = { rotation: [55, 10, 25], translation: [1, 2, 3], distance: 140, fov: 22.5, projection: 'ortho' };
const size = { width: 800, height: 600 };
const bounds = { min: [0, 0, 0] as Vec3, max: [10, 20, 30] as Vec3 };

/** As much of a preview as a plane needs. */
function planeOf(): SectionPlane {
  const wanted: { section?: Section | null } = {};
  const change = (part: typeof wanted) => Object.assign(wanted, part);
  return new SectionPlane({ wanted, camera, design: { bounds }, change, move: change } as unknown as Preview);
}

function near(a: readonly number[], b: readonly number[]): void {
  a.forEach((x, i) => assert.ok(Math.abs(x - b[i]!) < 1e-9 * (1 + Math.abs(x)), `${a} ≠ ${b}`));
}
const unitOf = (v: Vec3): Vec3 => v.map((x) => x / length(v)) as Vec3;

test('positions are those at which it meets the box', () => {
  near(positionsIn(bounds, [0, 1, 0]), [0, 20]);
  near(positionsIn(bounds, [-0.6, 0, 0.8]), [-6, 24]);
});

test('it lies across the middle, and cuts off the side towards the eye', () => {
  const plane = planeOf();
  plane.toggle();
  assert.equal(plane.now!.position, 5);
  for (const normal of [[0, 0, 1], [0, 0, -1], [0.6, 0, 0.8]] as Vec3[]) {
    plane.layAcross(normal);
    near([plane.now!.position], [dot([5, 10, 15], normal)]);
    const cutOff = plane.now!.flipped ? -1 : 1;
    assert.ok(cutOff * dot(normal, viewOf(camera).forward) < 0);
  }
  plane.toggle();
  assert.equal(plane.now, null);
  plane.toggle();
  near(plane.now!.normal, [0.6, 0, 0.8]);
});

test('it lies through three points that are on no line', () => {
  const plane = planeOf();
  const points: [Vec3, Vec3, Vec3] = [[1, 2, 3], [4, 2, 8], [1, 9, 9]];
  assert.ok(plane.layThrough(points));
  for (const point of points) near([dot(point, plane.now!.normal)], [plane.now!.position]);
  const { now } = plane;
  assert.ok(!plane.layThrough([[0, 0, 0], [1, 2, 3], [2, 4, 6]]));
  assert.ok(!plane.layThrough([[0, 0, 0], [0, 0, 0], [2, 4, 6]]));
  assert.equal(plane.now, now);
});

test('it moves within the design', () => {
  const plane = planeOf();
  plane.layAcross([0, 0, 1]);
  plane.move(0.1);
  near([plane.now!.position], [18]);
  plane.move(7);
  near([plane.now!.position], [30]);
});

test('it turns about the axes of the picture', () => {
  const plane = planeOf();
  const { right, up, forward } = viewOf(camera);
  plane.layAcross(up);
  plane.turn(30, 0);
  near([dot(plane.now!.normal, right)], [0]);
  near([dot(plane.now!.normal, up)], [Math.cos(Math.PI / 6)]);
  near([dot(cross(up, plane.now!.normal), right)], [0.5]);
  near([plane.now!.position], [dot([5, 10, 15], plane.now!.normal)]);
  plane.layAcross(right);
  plane.turn(0, 90);
  near(plane.now!.normal, forward);
});

test('it keeps its point that is nearest to the middle when it gets another normal', () => {
  const plane = planeOf();
  plane.layAcross([0, 0, 1]);
  plane.moveTo(20);
  plane.direct([3, 0, 4]);
  near(plane.now!.normal, [0.6, 0, 0.8]);
  near([plane.now!.position], [dot([5, 10, 20], [0.6, 0, 0.8])]);
  const { now } = plane;
  plane.direct([0, 0, 0]);
  assert.equal(plane.now, now);
});

test('it follows a drag along its normal', () => {
  const plane = planeOf();
  plane.layAcross(unitOf([1, 1, 1]));
  const { normal, position } = plane.now!;
  const seen = (at: number) => {
    const place = project(camera, size, normal.map((x) => at * x) as Vec3)!;
    return [place.x, place.y, 0] as Vec3;
  };
  const [dx, dy] = subtract(seen(position + 2), seen(position));
  plane.drag(dx, dy, size);
  near([plane.now!.position], [position + 2]);
  plane.layAcross(viewOf(camera).forward); // it is seen end-on
  const before = plane.now!.position;
  plane.drag(0, 1, size);
  assert.ok(plane.now!.position > before);
});
