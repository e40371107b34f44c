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

// Says how a test, or the list from that test on, behaves at the coincident faces. ENDS: it does
// not hold behind them. HOLDS: it holds before and behind them. Any other number: it starts to hold
// there. The number then encodes the test that starts it, and grows with its primitive's place in
// the file.
const uint ENDS = 0u;
const uint HOLDS = 0xFFFFFFFFu;
uint starts_by(uint index, uint primitive) { return 1u + primitive * MOST_SHARED + index; }
uint index_of(uint starting) { return (starting - 1u) % MOST_SHARED; }

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
  bool shared = false;
  last = hit;
  for (uint i = 0u; i < v_list.y; ++i) {
    BlistTest test = fetch_test(v_list.x + i);
    if (test.primitive == hit.primitive) continue;
    Hit start = start_beside(ray, hit, i, test);
    bool near = too_thin(abs(start.t - hit.t), hit.speed);
    shared = shared || near;
    if (near && test.primitive > last.primitive) last = start;
  }
  return shared;
}

uint across_test(Ray ray, Hit hit, uint index, BlistTest test) {
#if HAS_NONCONVEX
  if (!test.is_convex) {
    Passage passage = passage_at(ray, hit, test);
    if (!holds_behind(passage, test)) return ENDS;
    return passage.changes ? starts_by(index, test.primitive) : HOLDS;
  }
#endif
  Segment segment = segment_of(ray, index, test.primitive);
  bool starts = together(ray, hit, boundary(segment, test, true));
  bool ends = together(ray, hit, boundary(segment, test, false));
  if (starts && !ends) return starts_by(index, test.primitive);
  if (ends && !starts) return ENDS;
  bool inside = !starts && segment.start <= hit.t && hit.t < segment.end;  // false if the ray only
                                                                           // grazes it
  return inside == (test.complement == u_eye_inside) ? HOLDS : ENDS;
}

uint across[MOST_SHARED];  // by test, for the list from that test on

uint across_target(uint target) {
  if (target < LIST_FALSE) return across[target];
  return (target == LIST_TRUE) != u_eye_inside ? HOLDS : ENDS;
}

// A union starts by its last operand that starts, unless one holds before; an intersection by the
// last of those that have not held before.
uint either(uint a, uint b) { return max(a, b); }
uint both(uint a, uint b) {
  if (a == HOLDS || b == ENDS) return b;
  if (b == HOLDS || a == ENDS) return a;
  return max(a, b);
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
  // The list from a test on is (the test and if_true) or if_false. It is evaluated from the last
  // test on.
  uint whole = ENDS;
  for (uint i = v_list.y; i-- > 0u;) {
    BlistTest test = fetch_test(v_list.x + i);
    bool is_true_inside = test.complement == u_eye_inside;
    uint if_true = across_target(is_true_inside ? test.if_inside : test.if_outside);
    uint if_false = across_target(is_true_inside ? test.if_outside : test.if_inside);
    whole = either(both(across_test(ray, hit, i, test), if_true), if_false);
    across[i] = whole;
  }
  if (whole == ENDS || whole == HOLDS) return true;
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
  bool shared = too_thin(abs(other.t - hit.t), speed) && !too_thin(segment.end - segment.start, speed);
  if (other.primitive > hit.primitive && shared) seen = other;
  return true;
}

#endif
