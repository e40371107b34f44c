// Where the ray of a pixel enters the solid within its cell (paper §3). PATH selects how the cell's
// primitives are combined; every path looks for the first t in (enter, leave].

flat in uvec2 v_list;           // first test; how many (PATH_UNION: how many come behind it)

#if TILES
flat in float v_cut_t;          // the solid holds there, however thin the piece; +inf: nobody knows
#endif
uniform float u_tolerance;      // thinnest piece, along the normal, in world units
uniform bool u_eye_inside;      // rays start in the solid: what is seen is the solid's complement

// A boundary of the solid on the ray.
struct Hit {
  float t;
  uint primitive;
  int face;  // see Segment
  bool complement;
  float speed;  // see crossing_speed; 0 until asked for
};

const Hit NO_HIT = Hit(INFINITY, 0u, 0, false, 0.0);

Hit start_of(Segment segment, BlistTest test) {
  return Hit(segment.start, test.primitive, segment.start_face, test.complement, 0.0);
}
Hit end_of(Segment segment, BlistTest test) {
  return Hit(segment.end, test.primitive, segment.end_face, test.complement, 0.0);
}

// How fast the ray crosses the face, along its normal: what is t long is so many times t thick.
float crossing_speed(Ray ray, Hit hit) {
  float speed = abs(dot(normal_at(ray, hit.primitive, hit.t, hit.face), ray.direction));
  return max(speed, GRAZING_COSINE);
}
Hit with_speed(Ray ray, Hit hit) {
  hit.speed = crossing_speed(ray, hit);
  return hit;
}

// Regularised operations (csgcore/NUMERICS.md): a piece of the solid, or a gap in it, thinner than
// the tolerance does not exist.
bool too_thin(float length_t, float speed) { return length_t * speed <= u_tolerance; }

// The piece that is shown may be too thin, and just measured too long. Then the pixel is marked, and
// the CPU looks at it (renderer.cpp).
bool doubtful = false;

// Whether a piece that long does not exist, whatever rounding does to its length. What may or may
// not exist counts as if it did.
bool surely_gone(float length_t, float speed) {
  float thickness = length_t * speed;
  if (thickness <= LEAST_DOUBT * u_tolerance) return true;
  doubtful = thickness < MOST_DOUBT * u_tolerance;
  return false;
}

// The hit lies in the cell, and the solid does not already hold where the ray enters the cell (step 8).
bool starts_within(Hit hit, float enter, float leave) { return hit.t > enter && hit.t <= leave; }

#if PATH == PATH_SINGLE || PATH == PATH_UNION

Hit hit_of(Ray ray, BlistTest test) {
  Segment segment = intersect(ray, test.primitive);
  if (test.complement) return end_of(segment, test);
  return start_of(segment, test);
}

// Paper §3.2: one primitive or its complement. Step 8 is the condition t > enter: a segment that
// covers the cell's front extends towards the camera and is drawn by the cell in front.
Hit first_hit(Ray ray, float enter, float leave) {
  Hit hit = hit_of(ray, fetch_test(v_list.x));
  return starts_within(hit, enter, leave) ? hit : NO_HIT;
}

#elif PATH == PATH_BOTH

// Paper §3.3.4, case 1: segment ∩ segment (figures 7 and 8). The later start, if it comes before
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

// Paper §3.3.4, cases 2 and 3: segment ∩ two half-lines (figures 9 and 10): up to two pieces, what
// of A lies before B and what lies after it.
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

// Paper §3.3.4, case 4 and Algorithm 1 (derived anew, as its subscripts are lost in print): two
// half-lines ∩ two half-lines. Left boundaries: that of the segment between the two primitives, if
// they are disjoint on the ray, and that of the half-line behind both.
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
// Few primitives: each is intersected once, and the segments are kept.
Segment kept[SHORT_LIST];
#endif

// Any function: the Blist is evaluated at t, and with it the next t at which one of
// the primitives that decided may change its mind; from boundary to boundary until it holds.
struct Evaluation {
  bool value;
  Hit next;   // next.t = +∞: never
};

Segment segment_of(Ray ray, uint index, uint primitive) {
#if PATH == PATH_SHORT_LIST
  return kept[index];
#else
  return intersect(ray, primitive);
#endif
}

Evaluation evaluate(Ray ray, float t) {
  Evaluation result = Evaluation(false, NO_HIT);
  uint i = 0u;
  do {
    BlistTest test = fetch_test(v_list.x + i);
    Segment segment = segment_of(ray, i, test.primitive);
    bool inside = segment.start <= t && t < segment.end;
    if (inside) {
      if (segment.end < result.next.t) result.next = end_of(segment, test);
    } else if (t < segment.start && segment.start < result.next.t) {
      result.next = start_of(segment, test);
    }
    i = inside ? test.if_inside : test.if_outside;
  } while (i < LIST_FALSE);
  result.value = (i == LIST_TRUE) != u_eye_inside;
  return result;
}

// Whether the piece that starts there is what the ray ends in. Of a cell, also one that covers its
// front, and hides what lies behind; of a tile, none that covers the eye.
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
  // One loop with one evaluation in it: a software driver runs every loop's body at least once.
  Hit crossing = NO_HIT;  // the last one
  crossing.t = enter;
  Hit from = NO_HIT;      // where the piece starts that the ray is in
  bool covered = false;   // that piece covers the cell's front
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
  // The start of what covers the front is drawn by the cell before this one (step 8).
  return covered ? NO_HIT : from;
}

#endif
