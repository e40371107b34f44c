// Finds where the ray of a pixel enters the solid within its cell or tile (paper §3). PATH selects
// how the primitives are combined. Every path looks for the first t in (enter, leave].

flat in uvec2 v_list;           // first test; number of tests (PATH_UNION: of later operands)

#if TILES
flat in float v_cut_t;          // the solid holds at this t, however thin there; +inf: unknown
#endif
uniform bool u_eye_inside;      // rays start in the solid, and the solid's complement is drawn

// A boundary of the solid on the ray.
struct Hit {
  float t;
  uint primitive;
  int face;  // see Segment
  bool complement;
  float speed;  // see crossing_speed; 0 until asked for
};

#define NO_HIT Hit(INFINITY, 0u, 0, false, 0.0)

Hit start_of(Segment segment, BlistTest test) {
  return Hit(segment.start, test.primitive, segment.start_face, test.complement, 0.0);
}
Hit end_of(Segment segment, BlistTest test) {
  return Hit(segment.end, test.primitive, segment.end_face, test.complement, 0.0);
}
Hit end_of(Stretch stretch, BlistTest test) {
  return Hit(stretch.end, test.primitive, stretch.face, test.complement, 0.0);
}

// Returns how fast the ray crosses the face, along its normal: a length in t times this speed is a
// thickness.
float crossing_speed(Ray ray, Hit hit) {
  float speed = abs(dot(normal_at(ray, hit.primitive, hit.t, hit.face), ray.direction));
  return max(speed, GRAZING_COSINE);
}
Hit with_speed(Ray ray, Hit hit) {
  hit.speed = crossing_speed(ray, hit);
  return hit;
}

// Regularised operations (csgcore/NUMERICS.md): a piece of the solid, or a gap in it, does not
// exist if it is no thicker than the tolerance.
bool too_thin(float length_t, float speed) { return length_t * speed <= u_tolerance; }

// Set if the thickness of the piece that is shown was measured so close to the tolerance that the
// piece may not exist. The pixel is then marked, and the CPU may draw it anew (renderer.cpp).
bool doubtful = false;

// Returns whether a piece of that length does not exist, however its length was rounded. A doubtful
// piece counts as existing.
bool surely_gone(float length_t, float speed) {
  float thickness = length_t * speed;
  if (thickness <= LEAST_DOUBT * u_tolerance) return true;
  doubtful = thickness < MOST_DOUBT * u_tolerance;
  return false;
}

// Returns whether the hit lies in the cell and behind the point where the ray enters it (step 8).
bool starts_within(Hit hit, float enter, float leave) { return hit.t > enter && hit.t <= leave; }

#if PATH == PATH_SINGLE || PATH == PATH_UNION

Hit hit_of(Ray ray, BlistTest test) {
  Segment segment = intersect(ray, test.primitive);
  if (test.complement) return end_of(segment, test);
  return start_of(segment, test);
}

// One primitive or its complement (paper §3.2). Step 8 is the condition t > enter: a segment that
// contains the entry point extends towards the camera, and the cell in front draws it.
Hit first_hit(Ray ray, float enter, float leave) {
  Hit hit = hit_of(ray, fetch_test(v_list.x));
  return starts_within(hit, enter, leave) ? hit : NO_HIT;
}

#elif PATH == PATH_BOTH

// Segment ∩ segment (paper §3.3.4, case 1, figures 7 and 8): the later start, if it comes before
// the earlier end.
Hit first_hit(Ray ray, float enter, float leave) {
  BlistTest a = fetch_test(v_list.x);
  BlistTest b = fetch_test(v_list.x + 1u);
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  Hit hit = start_of(segment_a, a);
  if (segment_b.start > segment_a.start) hit = start_of(segment_b, b);
  hit = with_speed(ray, hit);
  bool exists = !surely_gone(min(segment_a.end, segment_b.end) - hit.t, hit.speed);
  return starts_within(hit, enter, leave) && exists ? hit : NO_HIT;
}

#elif PATH == PATH_MINUS

// Segment ∩ two half-lines (paper §3.3.4, cases 2 and 3, figures 9 and 10): up to two pieces, the
// part of A before B and the part after B.
Hit first_hit(Ray ray, float enter, float leave) {
  BlistTest a = fetch_test(v_list.x);
  BlistTest b = fetch_test(v_list.x + 1u);
  if (a.complement) {
    BlistTest swap = a;
    a = b;
    b = swap;
  }
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  Hit before = with_speed(ray, start_of(segment_a, a));
  float before_ends = min(segment_a.end, segment_b.start);
  if (starts_within(before, enter, leave) && !surely_gone(before_ends - before.t, before.speed)) {
    return before;
  }
  Hit after = segment_a.start > segment_b.end ? start_of(segment_a, a) : end_of(segment_b, b);
  after = with_speed(ray, after);
  bool exists = !surely_gone(segment_a.end - after.t, after.speed);
  return starts_within(after, enter, leave) && exists ? after : NO_HIT;
}

#elif PATH == PATH_NEITHER

// Two half-lines ∩ two half-lines (paper §3.3.4, case 4 and Algorithm 1, derived anew, as its
// subscripts are lost in print). The left boundaries are those of the segment between the two
// primitives, if they are disjoint on the ray, and of the half-line behind both.
Hit first_hit(Ray ray, float enter, float leave) {
  BlistTest a = fetch_test(v_list.x);
  BlistTest b = fetch_test(v_list.x + 1u);
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  bool a_first = segment_a.end < segment_b.end;
  Hit between = with_speed(ray, a_first ? end_of(segment_a, a) : end_of(segment_b, b));
  float next_start = a_first ? segment_b.start : segment_a.start;
  if (starts_within(between, enter, leave) && !surely_gone(next_start - between.t, between.speed)) {
    return between;
  }
  Hit behind = with_speed(ray, a_first ? end_of(segment_b, b) : end_of(segment_a, a));
  return starts_within(behind, enter, leave) ? behind : NO_HIT;
}

#elif PATH == PATH_SHORT_LIST || PATH == PATH_LIST

#if PATH == PATH_SHORT_LIST
// Each convex primitive is intersected once, and its segment kept.
Segment kept[SHORT_LIST];
#endif

// The value of the Blist at some t, and the next t beyond it at which one of the evaluated
// primitives may change the value. The ray is followed from boundary to boundary until the Blist
// holds.
struct Evaluation {
  bool value;
  Hit next;   // next.t = +∞: there is none
};

Segment segment_of(Ray ray, uint index, uint primitive) {
#if PATH == PATH_SHORT_LIST
  return kept[index];
#else
  return intersect(ray, primitive);
#endif
}

Stretch stretch_of(Segment segment, float t) {
  if (segment.start <= t && t < segment.end) return Stretch(true, segment.end, segment.end_face);
  if (t < segment.start) return Stretch(false, segment.start, segment.start_face);
  return Stretch(false, INFINITY, 0);
}

// Returns the test's primitive's stretch that begins at t.
Stretch stretch_at(Ray ray, uint index, BlistTest test, float t) {
#if HAS_NONCONVEX
  if (!test.is_convex) return stretch_from(ray, test.primitive, t);
#endif
  return stretch_of(segment_of(ray, index, test.primitive), t);
}

Evaluation evaluate(Ray ray, float t) {
  Evaluation result = Evaluation(false, NO_HIT);
  uint i = 0u;
  do {
    BlistTest test = fetch_test(v_list.x + i);
    Stretch stretch = stretch_at(ray, i, test, t);
    if (stretch.end < result.next.t) result.next = end_of(stretch, test);
    i = stretch.inside ? test.if_inside : test.if_outside;
  } while (i < LIST_FALSE);
  result.value = (i == LIST_TRUE) != u_eye_inside;
  return result;
}

// Returns whether the ray ends in the piece that starts at `from`. `covered`: the piece contains
// the start of the ray. In a cell such a piece may end the ray, since it hides what lies behind; in
// a tile it may not, unless it never ends.
bool ends_in(Hit from, float piece_ends, bool covered) {
#if TILES
  if (covered) return piece_ends == INFINITY;
  bool is_cut = from.t <= v_cut_t && v_cut_t < piece_ends;
  bool gone = surely_gone(piece_ends - from.t, from.speed);
  doubtful = doubtful && !is_cut;
  return !gone || is_cut;
#else
  return !surely_gone(piece_ends - from.t, from.speed);
#endif
}

Hit first_hit(Ray ray, float enter, float leave) {
#if PATH == PATH_SHORT_LIST
  for (uint i = 0u; i < v_list.y; ++i) {
    kept[i] = intersect(ray, fetch_test(v_list.x + i).primitive);
  }
#endif
  // There is one loop with one evaluation in it: a software driver runs every loop's body at least
  // once.
  Hit crossing = NO_HIT;  // the last boundary passed
  crossing.t = enter;
  Hit from = NO_HIT;      // start of the piece that the ray is in; t = +∞: in none
  bool covered = false;   // that piece contains the start of the ray
  for (bool first = true;; first = false) {
    Evaluation now = evaluate(ray, crossing.t);
    if (now.value) {
      if (from.t == INFINITY) {
        from = crossing;
        covered = first;
      }
      from.speed = crossing_speed(ray, covered ? now.next : from);
      if (ends_in(from, now.next.t, covered)) break;
    } else {
      from = NO_HIT;
      covered = false;
      if (!(now.next.t <= leave)) break;
    }
    crossing = now.next;
  }
  // The cell in front draws the start of a piece that contains the entry point (step 8).
  return covered ? NO_HIT : from;
}

#endif
