// Which of the faces that the ray crosses together is seen.

// Faces with too little between them are crossed together, whichever of them rounding puts first:
// what is seen does not depend on it (design.md §3: no speckle).
#if PATH == PATH_SINGLE

bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  return true;
}

#elif PATH == PATH_UNION

// In a union the earliest operand with that face draws it. v_list.y operands come before this one.
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  Hit nearest = NO_HIT;
  float apart = INFINITY;
  for (uint i = 1u; i <= v_list.y; ++i) {
    Hit earlier = hit_of(ray, fetch_literal(v_list.x - i));
    float this_apart = abs(earlier.t - hit.t);
    if (this_apart < apart) {
      apart = this_apart;
      nearest = earlier;
    }
  }
  return !too_thin(apart, max(crossing_speed(ray, hit), crossing_speed(ray, nearest)));
}

#elif PATH == PATH_SHORT_LIST || PATH == PATH_LIST

// The ray at the hit, where it crosses several faces together: one bit for each of the first
// literals.
struct Crossed {
  uint faces;   // those that start the solid there
  uint inside;  // the primitives that the ray is inside of behind them
  float t;      // where the other literals are asked
};

// Whether the solid holds behind the hit if the ray has not crossed some of the faces.
bool holds_without(Ray ray, Crossed crossed, uint faces) {
  uint inside = crossed.inside ^ faces;
  uint i = 0u;
  do {
    Literal literal = fetch_literal(v_list.x + i);
    bool is_inside = (inside >> i & 1u) != 0u;
#if PATH == PATH_LIST || SHORT_LIST > SHARED_FACES
    if (i >= uint(SHARED_FACES)) {
      Segment segment = segment_of(ray, i, literal.primitive);
      is_inside = segment.start <= crossed.t && crossed.t < segment.end;
    }
#endif
    i = is_inside ? literal.if_inside : literal.if_outside;
  } while (i < LIST_FALSE);
  return (i == LIST_TRUE) != u_eye_inside;
}

// Where the literal starts to hold (where it starts not to, if the eye is inside), or ends.
Hit boundary(Segment segment, Literal literal, bool starts) {
  if ((literal.complement == u_eye_inside) == starts) return start_of(segment, literal);
  return end_of(segment, literal);
}

// Whether another face than the hit's own may start the solid there. Most often none does.
bool is_shared(Ray ray, Hit hit) {
  bool shared = false;
  for (uint i = 0u; i < min(v_list.y, uint(SHARED_FACES)); ++i) {
    Literal literal = fetch_literal(v_list.x + i);
    Hit start = boundary(segment_of(ray, i, literal.primitive), literal, true);
    bool near = too_thin(abs(start.t - hit.t), hit.speed);
    shared = shared || near && literal.primitive != hit.primitive;
  }
  return shared;
}

// Along both normals: a flat view takes in walls that stand beside the face that is hit.
bool together(Ray ray, Hit hit, Hit other) {
  return too_thin(abs(other.t - hit.t), max(hit.speed, crossing_speed(ray, other)));
}

Crossed crossed_at(Ray ray, Hit hit) {
  Crossed result = Crossed(0u, 0u, hit.t + u_tolerance / hit.speed);
  for (uint i = 0u; i < min(v_list.y, uint(SHARED_FACES)); ++i) {
    Literal literal = fetch_literal(v_list.x + i);
    Segment segment = segment_of(ray, i, literal.primitive);
    bool starts = together(ray, hit, boundary(segment, literal, true));
    bool ends = together(ray, hit, boundary(segment, literal, false));
    bool inside = segment.start <= hit.t && hit.t < segment.end;
    if (starts != ends) inside = (literal.complement == u_eye_inside) == starts;
    if (starts && ends) inside = false;  // only grazed
    if (starts && !ends) result.faces |= 1u << i;
    if (inside) result.inside |= 1u << i;
  }
  return result;
}

// The first of some faces without which the solid would not start, the crossings of others set
// aside; SHARED_FACES if there is none.
uint first_decider(Ray ray, Crossed crossed, uint faces, uint aside) {
  for (uint i = 0u; i < uint(SHARED_FACES); ++i) {
    if (faces >> i == 0u) break;
    bool among = (faces >> i & 1u) != 0u;
    if (among && !holds_without(ray, crossed, aside | 1u << i)) return i;
  }
  return uint(SHARED_FACES);
}

// A face without which the solid would not start here: the earliest. If several make do without
// each other, then of only as many, from the earliest, as make it start.
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  seen = hit;
  if (!is_shared(ray, hit)) return true;
  Crossed crossed = crossed_at(ray, hit);
  uint faces = crossed.faces;
  if (faces == 0u) return true;
  uint aside = 0u;
  uint decider = uint(SHARED_FACES);
  for (int turn = 0; turn < 2; ++turn) {
    decider = first_decider(ray, crossed, faces & ~aside, aside);
    if (decider < uint(SHARED_FACES)) break;
    crossed.t = hit.t - u_tolerance / hit.speed;
    aside = faces;
    for (uint i = 0u; aside != 0u && !holds_without(ray, crossed, aside); ++i) aside &= ~(1u << i);
  }
  // More than have a bit may be needed.
  if (decider == uint(SHARED_FACES)) {
    decider = 0u;
    while ((faces >> decider & 1u) == 0u) ++decider;
  }
  Literal literal = fetch_literal(v_list.x + decider);
  seen = boundary(segment_of(ray, decider, literal.primitive), literal, true);
  return true;
}

#else

// Of a pair, each bounds it: the earlier one.
bool is_seen(Ray ray, Hit hit, out Hit seen) {
  Literal a = fetch_literal(v_list.x);
  Literal b = fetch_literal(v_list.x + 1u);
  Literal literal = a;
  if (a.primitive == hit.primitive) literal = b;
  Segment segment = intersect(ray, literal.primitive);
  Hit other = literal.complement ? end_of(segment, literal) : start_of(segment, literal);
  other = with_speed(ray, other);
  seen = hit;
  float apart = abs(other.t - hit.t);
  if (other.primitive < hit.primitive && too_thin(apart, max(hit.speed, other.speed))) seen = other;
  return true;
}

#endif
