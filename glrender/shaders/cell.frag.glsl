// Traces the pixel's ray within its cell (paper §3). PATH selects how the cell's primitives are
// combined; every path looks for the first t in (enter, leave] at which the ray enters the solid.

flat in vec3 v_box_min;
flat in vec3 v_box_max;
flat in uvec2 v_list;

layout(location = 0) out vec4 o_color;
#if MEASURED
layout(location = 1) out vec4 o_measured;  // unit normal, t
layout(location = 2) out uint o_id;
#endif
#if CONSERVATIVE_DEPTH
// Depth falls with distance; a hit is never nearer than the front face of its cell.
layout(depth_less) out float gl_FragDepth;
#endif

uniform float u_tolerance;      // thinnest piece, along the normal, in world units (design.md §3)
uniform bool u_eye_inside;      // rays start in the solid: what is seen is the solid's complement
#if BEHIND
uniform sampler2D u_first;      // o_measured of the picture that this one lies behind
#endif

// A boundary of the solid on the ray.
struct Hit {
  float t;
  uint primitive;
  bool complement;
  bool at_end;   // the primitive's segment ends here, rather than starts
};

const Hit NO_HIT = Hit(INFINITY, 0u, false, false);

// How long, in t, a piece that starts at this boundary must be to exist: a piece of the solid thinner
// than the tolerance, measured along the normal, is none (regularised operations, design.md §3).
float shortest_piece(Ray ray, Hit hit) {
  vec3 normal = normal_at(ray, hit.primitive, hit.t, hit.at_end);
  return u_tolerance / max(abs(dot(normal, ray.direction)), GRAZING_COSINE);
}

// A piece of at least this length is thick enough at any angle that shortest_piece distinguishes.
float surely_long() { return u_tolerance / GRAZING_COSINE; }

Hit start_of(Segment segment, Literal literal) {
  return Hit(segment.start, literal.primitive, literal.complement, false);
}
Hit end_of(Segment segment, Literal literal) {
  return Hit(segment.end, literal.primitive, literal.complement, true);
}

bool piece_exists(Ray ray, Hit from, float to) {
  float thickness = to - from.t;
  return thickness > surely_long() || thickness > shortest_piece(ray, from);
}

// The hit lies in the cell, and the solid does not already hold where the ray enters the cell (step 8).
bool starts_within(Hit hit, float enter, float leave) { return hit.t > enter && hit.t <= leave; }

#if PATH == PATH_SINGLE

// Paper §3.2: one primitive or its complement. Step 8 is the condition t > enter: a segment that
// covers the cell's front extends towards the camera and is drawn by the cell in front.
Hit first_hit(Ray ray, float enter, float leave) {
  Literal a = fetch_literal(v_list.x);
  Segment segment = intersect(ray, a.primitive);
  Hit hit = a.complement ? end_of(segment, a) : start_of(segment, a);
  return starts_within(hit, enter, leave) ? hit : NO_HIT;
}

#elif PATH == PATH_BOTH
// Paper §3.3.4, case 1: segment ∩ segment (figures 7 and 8). The later start, if it comes before
// the earlier end.
Hit first_hit(Ray ray, float enter, float leave) {
  Literal a = fetch_literal(v_list.x);
  Literal b = fetch_literal(v_list.x + 1u);
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  Hit hit = start_of(segment_a, a);
  if (segment_b.start > segment_a.start) hit = start_of(segment_b, b);
  if (!starts_within(hit, enter, leave)) return NO_HIT;
  return piece_exists(ray, hit, min(segment_a.end, segment_b.end)) ? hit : NO_HIT;
}

#elif PATH == PATH_MINUS

// Paper §3.3.4, cases 2 and 3: segment ∩ two half-lines (figures 9 and 10): up to two pieces, what
// of A lies before B and what lies after it.
Hit first_hit(Ray ray, float enter, float leave) {
  Literal a = fetch_literal(v_list.x);
  Literal b = fetch_literal(v_list.x + 1u);
  if (a.complement) {
    Literal swap = a;
    a = b;
    b = swap;
  }
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  Hit before = start_of(segment_a, a);
  if (starts_within(before, enter, leave) && before.t < segment_b.start &&
      piece_exists(ray, before, min(segment_a.end, segment_b.start))) {
    return before;
  }
  Hit after = segment_a.start > segment_b.end ? start_of(segment_a, a) : end_of(segment_b, b);
  if (starts_within(after, enter, leave) && after.t < segment_a.end &&
      piece_exists(ray, after, segment_a.end)) {
    return after;
  }
  return NO_HIT;
}

#elif PATH == PATH_NEITHER

// Paper §3.3.4, case 4 and Algorithm 1 (derived anew, as its subscripts are lost in print): two
// half-lines ∩ two half-lines. Left boundaries: that of the segment between the two primitives, if
// they are disjoint on the ray, and that of the half-line behind both.
Hit first_hit(Ray ray, float enter, float leave) {
  Literal a = fetch_literal(v_list.x);
  Literal b = fetch_literal(v_list.x + 1u);
  Segment segment_a = intersect(ray, a.primitive);
  Segment segment_b = intersect(ray, b.primitive);
  bool a_first = segment_a.end < segment_b.end;
  Hit between = a_first ? end_of(segment_a, a) : end_of(segment_b, b);
  float next_start = a_first ? segment_b.start : segment_a.start;
  if (starts_within(between, enter, leave) && between.t < next_start &&
      piece_exists(ray, between, next_start)) {
    return between;
  }
  Hit behind = a_first ? end_of(segment_b, b) : end_of(segment_a, a);
  return starts_within(behind, enter, leave) ? behind : NO_HIT;
}

#elif PATH == PATH_SHORT_LIST || PATH == PATH_LIST

#if PATH == PATH_SHORT_LIST
// Few primitives: each is intersected once, and the segments are kept.
vec2 kept[SHORT_LIST];  // start and end
#endif

// Any function: the short-circuit list is evaluated at t, and with it the next t at which one of
// the primitives that decided may change its mind; from boundary to boundary until it holds.
struct Evaluation {
  bool value;
  Hit next;   // next.t = +∞: never
};

Segment segment_of(Ray ray, uint index, uint primitive) {
#if PATH == PATH_SHORT_LIST
  return Segment(kept[index].x, kept[index].y, false, false);
#else
  return intersect(ray, primitive);
#endif
}

Evaluation evaluate(Ray ray, float t) {
  Evaluation result = Evaluation(false, NO_HIT);
  uint i = 0u;
  do {
    Literal literal = fetch_literal(v_list.x + i);
    Segment segment = segment_of(ray, i, literal.primitive);
    bool inside = segment.start <= t && t < segment.end;
    if (inside) {
      if (segment.end < result.next.t) result.next = end_of(segment, literal);
    } else if (t < segment.start && segment.start < result.next.t) {
      result.next = start_of(segment, literal);
    }
    i = inside ? literal.if_inside : literal.if_outside;
  } while (i < LIST_FALSE);
  result.value = (i == LIST_TRUE) != u_eye_inside;
  return result;
}

Hit first_hit(Ray ray, float enter, float leave) {
#if PATH == PATH_SHORT_LIST
  for (uint i = 0u; i < v_list.y; ++i) {
    Segment segment = intersect(ray, fetch_literal(v_list.x + i).primitive);
    kept[i] = vec2(segment.start, segment.end);
  }
#endif
  float t = enter;
  Evaluation now = evaluate(ray, t);
  if (now.value) {
    // The solid covers the cell's front (step 8), unless that is only a piece too thin to exist
    // which ends here.
    while (now.value && now.next.t - enter <= u_tolerance) now = evaluate(ray, now.next.t);
    if (now.value) return NO_HIT;
  }
  while (now.next.t <= leave) {
    Hit hit = now.next;
    now = evaluate(ray, hit.t);
    if (!now.value) continue;
    float shortest = -1.0;
    Evaluation then = now;
    while (then.value && then.next.t - hit.t <= surely_long()) {
      if (shortest < 0.0) shortest = shortest_piece(ray, hit);
      if (then.next.t - hit.t > shortest) break;
      then = evaluate(ray, then.next.t);
    }
    if (then.value) return hit;
    now = then;
  }
  return NO_HIT;
}

#endif

// Faces that coincide are crossed together, whichever of them rounding puts first: what is seen does
// not depend on it (design.md §3: no speckle). `reach`: how far apart, in t, they may be.
#if PATH == PATH_SINGLE

// In a union the earliest operand with that face draws it. v_list.y operands come before this one.
bool is_seen(Ray ray, Hit hit, float reach, out Hit seen) {
  seen = hit;
  float apart = INFINITY;
  for (uint i = 1u; i <= v_list.y; ++i) {
    Literal earlier = fetch_literal(v_list.x - i);
    Segment segment = intersect(ray, earlier.primitive);
    apart = min(apart, abs((earlier.complement ? segment.end : segment.start) - hit.t));
  }
  return !(apart <= reach);
}

#elif PATH == PATH_SHORT_LIST || PATH == PATH_LIST

// Whether the solid holds at t if the ray has not crossed the boundary of `primitive` there.
bool holds_without(Ray ray, float t, uint primitive) {
  uint i = 0u;
  do {
    Literal literal = fetch_literal(v_list.x + i);
    Segment segment = segment_of(ray, i, literal.primitive);
    bool inside = (segment.start <= t && t < segment.end) != (literal.primitive == primitive);
    i = inside ? literal.if_inside : literal.if_outside;
  } while (i < LIST_FALSE);
  return (i == LIST_TRUE) != u_eye_inside;
}

// A face without which the solid would not start here, if there is one, and of these the earliest.
// Two loops, as a software driver takes every branch of a loop: most hits have one face only.
bool is_seen(Ray ray, Hit hit, float reach, out Hit seen) {
  seen = hit;
  uint others = 0u;
  uint last = min(v_list.y, 32u);  // one bit each
  for (uint i = 0u; i < last; ++i) {
    Literal literal = fetch_literal(v_list.x + i);
    Segment segment = segment_of(ray, i, literal.primitive);
    float t = literal.complement == u_eye_inside ? segment.start : segment.end;
    if (literal.primitive != hit.primitive && abs(t - hit.t) <= reach) others |= 1u << i;
  }
  if (others == 0u) return true;
  float behind = hit.t + reach;
  bool decides = !holds_without(ray, behind, hit.primitive);
  for (uint i = 0u; others != 0u; ++i, others >>= 1) {
    if ((others & 1u) == 0u) continue;
    Literal other = fetch_literal(v_list.x + i);
    bool other_decides = !holds_without(ray, behind, other.primitive);
    if (other_decides == decides ? other.primitive < seen.primitive : other_decides) {
      seen.primitive = other.primitive;
      seen.complement = other.complement;
      decides = other_decides;
    }
  }
  return true;
}

#else

// Of a pair, each bounds it: the earlier one.
bool is_seen(Ray ray, Hit hit, float reach, out Hit seen) {
  Literal a = fetch_literal(v_list.x);
  Literal b = fetch_literal(v_list.x + 1u);
  Literal other = a;
  if (a.primitive == hit.primitive) other = b;
  Segment segment = intersect(ray, other.primitive);
  float t = other.complement ? segment.end : segment.start;
  seen = hit;
  if (abs(t - hit.t) <= reach && other.primitive < hit.primitive) {
    seen.primitive = other.primitive;
    seen.complement = other.complement;
  }
  return true;
}

#endif

void main() {
  Ray ray = pixel_ray();
  vec2 range = box_range(ray, v_box_min, v_box_max);
#if BEHIND
  float enter = max(range.x, texelFetch(u_first, ivec2(gl_FragCoord.xy), 0).w);
#else
  float enter = max(range.x, first_t());
#endif
  if (!(enter <= range.y) || enter == INFINITY) discard;
  Hit hit = first_hit(ray, enter, range.y);
  if (hit.t == INFINITY) discard;
  vec3 point = ray.origin + hit.t * ray.direction;
  // Paper §3.2, step 4: a complement's normal is turned round.
  vec3 normal = normal_at(ray, hit.primitive, hit.t, hit.at_end);
  if (hit.complement) normal = -normal;
  float reach = u_tolerance / max(abs(dot(normal, ray.direction)), GRAZING_COSINE);
  Hit seen;
  if (!is_seen(ray, hit, reach, seen)) discard;
  vec3 color = base_color(seen.primitive, seen.complement && !u_eye_inside);
  o_color = vec4(shade(color, point, normal, ray.direction), 1.0);
#if MEASURED
  o_measured = vec4(normal, hit.t);
  o_id = texelFetch(u_surfaces, int(seen.primitive)).z;
#endif
  float depth = u_depth_scale * (u_far - hit.t);
  if (PERSPECTIVE != 0) depth /= u_eye_distance + hit.t;
  gl_FragDepth = clamp(depth, 0.0, 1.0);
}
