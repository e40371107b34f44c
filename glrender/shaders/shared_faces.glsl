// Coincidence resolution: selects which of the coincident faces at a hit is shown.

// Faces are coincident on a ray if the pieces between them are too thin to exist. Rounding orders
// such faces at random, and the face that is shown must not depend on that (speckle).
#if PATH == PATH_SINGLE

bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  return true;
}

#elif PATH == PATH_UNION

// In a union the last operand with the face draws it. v_list.y operands are later than this one.
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  Hit nearest = NO_HIT;
  float apart = INFINITY;
  for (uint i = 1u; i <= v_list.y; ++i) {
    Hit later = hit_of(ray, fetch_test(v_list.x + i));
    float this_apart = abs(later.t - hit.t);
    if (this_apart < apart) {
      apart = this_apart;
      nearest = later;
    }
  }
  return !too_thin(apart, max(crossing_speed(ray, hit), crossing_speed(ray, nearest)));
}

#elif PATH == PATH_SHORT_LIST || PATH == PATH_LIST

#if PATH == PATH_SHORT_LIST
const uint MOST_SHARED = uint(SHORT_LIST);
#else
const uint MOST_SHARED = uint(LONG_LIST);
#endif

// The state of a test, or of an operation, at the coincident faces (`turning` in
// csgcore/src/tree/list_expression.hpp): whether it holds before and behind them. FAILS: neither.
// ENDS: before them alone. HOLDS: both. Any other number: it starts to hold there. The number then
// encodes the test that starts it, and grows with its primitive's place in the file.
const uint FAILS = 0u;
const uint ENDS = 1u;
const uint HOLDS = 0xFFFFFFFFu;
uint starts_by(uint index, uint primitive) { return 2u + primitive * MOST_SHARED + index; }
uint index_of(uint starting) { return (starting - 2u) % MOST_SHARED; }
bool is_turned(uint state) { return state > ENDS && state < HOLDS; }

uint state_of(bool before, bool behind, uint starting) {
  if (!behind) return before ? ENDS : FAILS;
  return before ? HOLDS : starting;
}

// Returns where the test starts to hold (`starts`) or ends to. If the eye is inside, it is the
// test's complement that starts or ends.
Hit boundary(Segment segment, BlistTest test, bool starts) {
  if ((test.complement == u_eye_inside) == starts) return start_of(segment, test);
  return end_of(segment, test);
}

// The distance is measured along both normals: a ray at a flat angle also passes close to walls
// that stand beside the face that is hit.
bool together(Ray ray, Hit hit, Hit other) {
  return too_thin(abs(other.t - hit.t), max(hit.speed, crossing_speed(ray, other)));
}

#if HAS_NONCONVEX

// How a ray passes the primitive of a test at the faces that coincide with a hit.
struct Passage {
  bool inside;   // whether the ray lies in the primitive behind them
  bool changes;  // whether an odd number of them are faces of the primitive
  Hit first;     // at the first of these
};

Passage passage_at(Ray ray, Hit hit, BlistTest test) {
  Passage result = Passage(false, false, NO_HIT);
  float reach = u_tolerance / hit.speed;
  float t = hit.t - reach;
  bool begins = true;
  do {
    Stretch stretch = stretch_from(ray, test.primitive, t);
    if (begins) result.inside = stretch.inside;
    begins = false;
    t = stretch.end;
    Hit face = end_of(stretch, test);
    bool is_together = t <= hit.t + reach && together(ray, hit, face);
    if (is_together) {
      if (result.first.t == INFINITY) result.first = face;
      result.changes = !result.changes;
    }
    if (is_together || t <= hit.t) result.inside = !stretch.inside;
  } while (t < hit.t + reach);
  return result;
}

// Returns whether the test's operand holds, or its complement if the eye is inside.
bool holds_behind(Passage passage, BlistTest test) {
  return passage.inside == (test.complement == u_eye_inside);
}

#endif

// Returns where the test's primitive may start to hold next to the hit. t = +∞: nowhere.
Hit start_beside(Ray ray, Hit hit, uint index, BlistTest test) {
#if HAS_NONCONVEX
  if (!test.is_convex) {
    Passage passage = passage_at(ray, hit, test);
    if (passage.changes && holds_behind(passage, test)) return passage.first;
    return NO_HIT;
  }
#endif
  return boundary(segment_of(ray, index, test.primitive), test, true);
}

// Returns whether a face other than the hit's own may start the solid there (most often none does).
// `last` is the last in file order of all faces that start a primitive or complement there.
bool is_shared(Ray ray, Hit hit, out Hit last) {
  bool is_common = false;
  last = hit;
  for (uint i = 0u; i < v_list.y; ++i) {
    BlistTest test = fetch_test(v_list.x + i);
    if (test.primitive == hit.primitive) continue;
    Hit start = start_beside(ray, hit, i, test);
    bool near = too_thin(abs(start.t - hit.t), hit.speed);
    is_common = is_common || near;
    if (near && test.primitive > last.primitive) last = start;
  }
  return is_common;
}

// Returns the state of a test.
uint state_across(Ray ray, Hit hit, uint index, BlistTest test) {
#if HAS_NONCONVEX
  if (!test.is_convex) {
    Passage passage = passage_at(ray, hit, test);
    bool behind = holds_behind(passage, test);
    return state_of(behind != passage.changes, behind, starts_by(index, test.primitive));
  }
#endif
  Segment segment = segment_of(ray, index, test.primitive);
  bool starts = together(ray, hit, boundary(segment, test, true));
  bool ends = together(ray, hit, boundary(segment, test, false));
  bool inside = !starts && segment.start <= hit.t && hit.t < segment.end;  // false if the ray only
                                                                           // grazes it
  bool changes = starts != ends;
  bool behind = changes ? starts : inside == (test.complement == u_eye_inside);
  return state_of(behind != changes, behind, starts_by(index, test.primitive));
}

// The state of a union and of an intersection. If several operands start, that of the last in file
// order counts. If one ends as another one starts, the union holds, and the intersection fails.
uint either(uint a, uint b) {
  uint last = max(a, b);
  return min(a, b) == ENDS && last > ENDS ? HOLDS : last;
}
uint both(uint a, uint b) {
  uint first = min(a, b);
  uint last = max(a, b);
  if (last == HOLDS || first == last) return first;
  return first > ENDS ? last : FAILS;
}

// Adjacent tests whose jumps out of the block have two targets. The list is read as the expression
// that it was compiled from, as ListExpression does (csgcore/src/tree/list_expression.hpp).
struct Block {
  uint entry;  // the first test
  uint if_true, if_false;
  uint true_jumps, false_jumps;  // how many jumps lead there
  uint state;
};
Block blocks[MOST_SHARED];  // no operands yet; the last one comes first in the list
uint jumps[MOST_SHARED];    // by test, how many jumps lead there

// Merges the blocks if they are operands of one operation, and returns whether they are.
bool combine(inout Block block, Block next) {
  bool is_intersection = block.if_true == next.entry && block.if_false == next.if_false &&
                         block.true_jumps == jumps[next.entry];
  bool is_union = block.if_false == next.entry && block.if_true == next.if_true &&
                  block.false_jumps == jumps[next.entry];
  if (is_intersection) {
    block.if_true = next.if_true;
    block.true_jumps = next.true_jumps;
    block.false_jumps += next.false_jumps;
  } else if (is_union) {
    block.if_false = next.if_false;
    block.false_jumps = next.false_jumps;
    block.true_jumps += next.true_jumps;
  } else {
    return false;
  }
  // Around an eye in the solid, the complement of everything is evaluated.
  block.state = is_intersection != u_eye_inside ? both(block.state, next.state)
                                                : either(block.state, next.state);
  return true;
}

uint state_of_list(Ray ray, Hit hit) {
  for (uint i = 0u; i < v_list.y; ++i) jumps[i] = 0u;
  for (uint i = 0u; i < v_list.y; ++i) {
    BlistTest test = fetch_test(v_list.x + i);
    if (test.if_inside < LIST_FALSE) ++jumps[test.if_inside];
    if (test.if_outside < LIST_FALSE) ++jumps[test.if_outside];
  }
  uint count = 0u;
  for (uint i = v_list.y; i-- > 0u;) {
    BlistTest test = fetch_test(v_list.x + i);
    Block block = Block(i, test.complement ? test.if_outside : test.if_inside,
                        test.complement ? test.if_inside : test.if_outside, 1u, 1u,
                        state_across(ray, hit, i, test));
    while (count > 0u && combine(block, blocks[count - 1u])) --count;
    blocks[count] = block;
    ++count;
  }
  return count == 1u ? blocks[0].state : FAILS;
}

// Shows the last in file order of the operands that start the solid (NUMERICS.md, the definition).
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  Hit last;
  seen = hit;
  if (!is_shared(ray, hit, last)) return true;
  if (v_list.y > MOST_SHARED) {
    seen = last;
    return true;
  }
  uint whole = state_of_list(ray, hit);
  if (!is_turned(whole)) return true;
  BlistTest test = fetch_test(v_list.x + index_of(whole));
  seen = start_beside(ray, hit, index_of(whole), test);
  return true;
}

#else

// Both primitives of a pair bound it. The later one is shown, unless it ends there, too.
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  BlistTest a = fetch_test(v_list.x);
  BlistTest b = fetch_test(v_list.x + 1u);
  BlistTest test = a;
  if (a.primitive == hit.primitive) test = b;
  Segment segment = intersect(ray, test.primitive);
  Hit other = test.complement ? end_of(segment, test) : start_of(segment, test);
  other = with_speed(ray, other);
  seen = hit;
  float speed = max(hit.speed, other.speed);
  bool is_common = too_thin(abs(other.t - hit.t), speed) && !too_thin(segment.end - segment.start, speed);
  if (other.primitive > hit.primitive && is_common) seen = other;
  return true;
}

#endif
