// Which of the faces that the ray crosses together is seen.

// Faces with too little between them are crossed together, whichever of them rounding puts first:
// what is seen does not depend on it (no speckle).
#if PATH == PATH_SINGLE

bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  return true;
}

#elif PATH == PATH_UNION

// In a union the last operand with that face draws it. v_list.y operands come behind this one.
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

// What a test, or all of the list from it on, comes to at the faces that are crossed together:
// ENDS if it does not hold behind them; HOLDS if it holds before and behind them; else it starts to
// hold there, and the number says by which test, in file order of the primitives.
const uint ENDS = 0u;
const uint HOLDS = 0xFFFFFFFFu;
uint starts_by(uint index, uint primitive) { return 1u + primitive * MOST_SHARED + index; }
uint index_of(uint starting) { return (starting - 1u) % MOST_SHARED; }

// Where the test starts to hold (where it starts not to, if the eye is inside), or ends.
Hit boundary(Segment segment, BlistTest test, bool starts) {
  if ((test.complement == u_eye_inside) == starts) return start_of(segment, test);
  return end_of(segment, test);
}

// Whether another face than the hit's own may start the solid there (most often none does), and the
// last in file order of all that start something there.
bool is_shared(Ray ray, Hit hit, out Hit last) {
  bool shared = false;
  last = hit;
  for (uint i = 0u; i < v_list.y; ++i) {
    BlistTest test = fetch_test(v_list.x + i);
    Hit start = boundary(segment_of(ray, i, test.primitive), test, true);
    bool near = too_thin(abs(start.t - hit.t), hit.speed);
    shared = shared || near && test.primitive != hit.primitive;
    if (near && test.primitive > last.primitive) last = start;
  }
  return shared;
}

// Along both normals: a flat view takes in walls that stand beside the face that is hit.
bool together(Ray ray, Hit hit, Hit other) {
  return too_thin(abs(other.t - hit.t), max(hit.speed, crossing_speed(ray, other)));
}

uint across_test(Ray ray, Hit hit, uint index, BlistTest test) {
  Segment segment = segment_of(ray, index, test.primitive);
  bool starts = together(ray, hit, boundary(segment, test, true));
  bool ends = together(ray, hit, boundary(segment, test, false));
  if (starts && !ends) return starts_by(index, test.primitive);
  if (ends && !starts) return ENDS;
  bool inside = !starts && segment.start <= hit.t && hit.t < segment.end;  // not if only grazed
  return inside == (test.complement == u_eye_inside) ? HOLDS : ENDS;
}

uint across[MOST_SHARED];  // from a test on

uint across_target(uint target) {
  if (target < LIST_FALSE) return across[target];
  return (target == LIST_TRUE) != u_eye_inside ? HOLDS : ENDS;
}

// A union starts by the last operand that does, unless one holds before; an intersection by the last
// of those that have not held before.
uint either(uint a, uint b) { return max(a, b); }
uint both(uint a, uint b) {
  if (a == HOLDS || b == ENDS) return b;
  if (b == HOLDS || a == ENDS) return a;
  return max(a, b);
}

// The last in file order of those operands that start the solid (NUMERICS.md, the definition).
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  Hit last;
  seen = hit;
  if (!is_shared(ray, hit, last)) return true;
  if (v_list.y > MOST_SHARED) {
    seen = last;
    return true;
  }
  // (if_true and the test) or if_false, from the last test to the first.
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
  seen = boundary(segment_of(ray, index_of(whole), test.primitive), test, true);
  return true;
}

#else

// Of a pair, each bounds it: the later one, if that does not end there, too.
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
