// The revolution of a profile. The half plane that holds the figure is passed by a ray on a branch
// of a hyperbola, its path (revolution_path-inl.hpp). A point of the half plane is a vec3 here: its
// distance r from the axis; its height above the path's at τ = 0; and, for the ray's point at this
// height, the ray's rise times its place ρ.

// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
const float REVOLUTION_BALL2 = 2.0001;
// Half the solid's height, and a little more.
const float REVOLUTION_END = 1.000001;
// A ray is level, or runs along the axis, if its direction has less than this share along it, or
// across it.
const float LEAST_SHARE = 1e-12;
// A height of 0 counts as one that is less than any other.
const float NO_HEIGHT = 1e-15;
const float BOX_MARGIN = 1.0 / 262144.0;  // Profile::kBoxMargin

// Newton's method, which bisects now and then, ends by this many steps, or by a smaller one.
const int MOST_STEPS = 40;
const float LEAST_STEP = 1.0 / 8388608.0;

struct RevolutionPath {
  float offset, start, height, run, rise;
  bool starts_nearest;
  float first, last;
  float base, unit;  // t = base + unit·τ
  float upwards;     // −1 or 1
  vec2 radii;
};

// Returns false if the ray misses the solid.
bool find_path(CanonicalRay ray, out RevolutionPath path) {
  float beside2 = REVOLUTION_BALL2 - dot(ray.origin, ray.origin);
  if (!(beside2 > 0.0)) return false;
  path.unit = inversesqrt(dot(ray.direction, ray.direction));
  vec3 along = ray.direction * path.unit;
  path.run = length(along.xy);
  path.rise = abs(along.z) > LEAST_SHARE ? along.z : 0.0;
  if (path.run <= LEAST_SHARE) path.run = 0.0;
  path.upwards = path.rise < 0.0 ? -1.0 : 1.0;
  path.last = sqrt(beside2);
  path.first = -path.last;
  if (path.rise != 0.0) {
    path.first = max(path.first, (-path.upwards * REVOLUTION_END - ray.origin.z) / path.rise);
    path.last = min(path.last, (path.upwards * REVOLUTION_END - ray.origin.z) / path.rise);
  } else if (abs(ray.origin.z) > 1.0) {
    return false;
  }
  if (!(path.first < path.last)) return false;
  float base = 0.0;
  path.starts_nearest = false;
  if (path.run > 0.0) {
    float nearest = -dot(ray.origin.xy, along.xy) / (path.run * path.run);
    base = clamp(nearest, path.first, path.last);
    path.starts_nearest = base == nearest;
  }
  vec3 start = ray.origin + base * along;
  vec2 ahead = path.run > 0.0 ? along.xy / path.run : vec2(1.0, 0.0);
  path.start = path.starts_nearest ? 0.0 : dot(start.xy, ahead);
  path.offset = abs(start.x * ahead.y - start.y * ahead.x);
  path.height = start.z;
  path.first -= base;
  path.last -= base;
  path.base = ray.base_t + base * path.unit;
  path.radii = texelFetch(u_profiles, ray.faces).zw;
  return path.offset <= 1.0;
}

vec3 seen_place(RevolutionPath path, vec2 place) {
  PRECISE float r = max(0.0, path.radii.x + path.radii.y * place.x);
  PRECISE float above = place.y - path.height;
  if (above == 0.0) above = NO_HEIGHT;
  PRECISE float run = path.rise * path.start + above * path.run;
  return vec3(r, above, run);
}

// The function that is > 0 within the path, where r is larger than the path's, and its polar form.
float within(RevolutionPath path, vec3 p) {
  PRECISE float beside = (p.x - path.offset) * (p.x + path.offset);
  PRECISE float value = path.rise * path.rise * beside - p.z * p.z;
  return value;
}
float within_polar(RevolutionPath path, vec3 a, vec3 b) {
  return path.rise * path.rise * (a.x * b.x - path.offset * path.offset) - a.z * b.z;
}

// `change`: 1 if the piece leads into the path there, −1 if it leads out of it.
void note_tau(RevolutionPath path, float tau, int change, int texel, float t,
              inout ProfileCrossings crossings) {
  float at = path.base + path.unit * clamp(tau, path.first, path.last);
  note_crossing(crossings, t, at, change * int(path.upwards), texel);
}

// A line makes a cone, whose radius at τ is (q + κ·τ)/Δz, and which a ray meets at the roots of
// a·τ² + 2h·τ + c.
void cross_cone(RevolutionPath path, vec3 start, vec3 end, bool from_within, bool to_within,
                int texel, float t, inout ProfileCrossings crossings) {
  float rise = end.y - start.y;
  float growth = end.x - start.x;
  if (from_within != to_within && rise == 0.0) {
    note_tau(path, start.y / path.rise, to_within ? 1 : -1, texel, t, crossings);
    return;
  }
  // What lies within the path is convex.
  if (from_within && to_within) return;
  bool is_pair = from_within == to_within;
  if (is_pair && !(within_polar(path, start, end) > 0.0)) return;
  float kappa = path.rise * growth;
  float q = start.x * rise - growth * start.y;
  float lean = q * path.run - kappa * path.start;
  float turned = path.offset * kappa;
  float level = path.offset * rise * path.run;
  float discriminant = lean * lean + (turned - level) * (turned + level);
  if (is_pair && !(discriminant > 0.0)) return;
  float root = abs(rise) * sqrt(max(0.0, discriminant));
  float steep = path.run * rise;
  float a = (steep - kappa) * (steep + kappa);
  float h = steep * rise * path.start - q * kappa;
  float c = rise * rise * path.offset * path.offset +
            (rise * path.start - q) * (rise * path.start + q);
  for (int change = 1; change >= -1; change -= 2) {
    if (!is_pair && to_within != change > 0) continue;
    // The ray leaves the cone outwards at the larger root if a > 0.
    bool outwards = (path.upwards * float(change) > 0.0) == (rise < 0.0);
    float own = outwards ? root - h : -h - root;
    float other = outwards ? -h - root : root - h;
    note_tau(path, (h <= 0.0) == outwards ? own / a : c / other, change, texel, t, crossings);
  }
}

// A curve, or a part of one: the control points and their weights.
struct PathCurve {
  vec3 start, control, end;
  vec3 weights;
};

vec3 curve_point(PathCurve curve, vec3 shares) {
  return (shares.x * curve.start + shares.y * curve.control + shares.z * curve.end) /
         (shares.x + shares.y + shares.z);
}

vec3 curve_shares(PathCurve curve, float s) {
  return vec3((1.0 - s) * (1.0 - s), 2.0 * s * (1.0 - s), s * s) * curve.weights;
}

// Returns how far the curve is within the path at s, and the growth of that.
vec2 curve_within(RevolutionPath path, PathCurve curve, float s) {
  vec3 shares = curve_shares(curve, s);
  vec3 point = curve_point(curve, shares);
  vec3 growths = vec3(2.0 * s - 2.0, 2.0 - 4.0 * s, 2.0 * s) * curve.weights;
  vec3 slope = (growths.x * (curve.start - point) + growths.y * (curve.control - point) +
                growths.z * (curve.end - point)) / (shares.x + shares.y + shares.z);
  return vec2(within(path, point),
              2.0 * (path.rise * path.rise * point.x * slope.x - point.z * slope.z));
}

void note_root(RevolutionPath path, PathCurve curve, float s, bool to_within, bool is_below,
               int texel, float t, inout ProfileCrossings crossings) {
  vec3 point = curve_point(curve, curve_shares(curve, s));
  float across = sqrt(max(0.0, (point.x - path.offset) * (point.x + path.offset)));
  float rho = is_below == path.upwards > 0.0 ? -across : across;
  // The place of the point and its height both tell τ. A point on the more level one of the two is
  // found by the other.
  bool by_height = path.rise != 0.0 && abs(path.rise) * point.x >= across * path.run;
  float tau = by_height ? point.y / path.rise : (rho - path.start) / path.run;
  note_tau(path, tau, to_within ? 1 : -1, texel, t, crossings);
}

// Crosses the part of a curve that can meet only the lower or the upper half of the path, at the
// roots of a quartic. Between two roots of its derivative there is one root at most, and between
// two roots of its second derivative there is one of those.
void cross_half(RevolutionPath path, PathCurve curve, bool from_within, bool to_within,
                bool is_below, int texel, float t, inout ProfileCrossings crossings) {
  vec3 w = curve.weights;
  // In Bernstein form.
  float first = w.x * w.x * within(path, curve.start);
  vec4 bernstein = vec4(w.x * w.y * within_polar(path, curve.start, curve.control),
                        (2.0 * w.y * w.y * within(path, curve.control) +
                         w.x * w.z * within_polar(path, curve.start, curve.end)) / 3.0,
                        w.y * w.z * within_polar(path, curve.control, curve.end),
                        w.z * w.z * within(path, curve.end));
  // There are no more roots than changes of sign.
  bvec4 positive = greaterThan(bernstein, vec4(0.0));
  int changes = int(from_within != positive.x) + int(positive.x != positive.y) +
                int(positive.y != positive.z) + int(positive.z != to_within);
  if (changes == 0) return;
  // The coefficients of s to s⁴.
  vec4 power = vec4(
      4.0 * (bernstein.x - first), 6.0 * (bernstein.y - 2.0 * bernstein.x + first),
      4.0 * (bernstein.z - 3.0 * (bernstein.y - bernstein.x) - first),
      bernstein.w - 4.0 * (bernstein.z + bernstein.x) + 6.0 * bernstein.y + first);
  float discriminant = 9.0 * power.z * power.z - 24.0 * power.w * power.y;
  vec2 bends = vec2(1.0);  // the roots of the second derivative
  if (discriminant > 0.0) {
    float sum = -0.5 * (3.0 * power.z + (power.z < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
    if (power.w != 0.0) bends.x = clamp(sum / (6.0 * power.w), 0.0, 1.0);
    if (sum != 0.0) bends.y = clamp(power.y / sum, 0.0, 1.0);
  }
  vec3 ends = vec3(min(bends.x, bends.y), max(bends.x, bends.y), 1.0);
  float from = 0.0;
  bool side = power.x > 0.0;
  // A level path is met at its middle, which is an end of the curve.
  bool is_level = path.rise == 0.0;
  int first_part = changes == 1 || is_level ? 6 : 0;
  for (int i = first_part; i < 7; ++i) {
    ++rounds_spent;
    bool is_slope = i < 3;
    if (i == 3 || i == 6 && first_part == 6) {
      from = 0.0;
      side = from_within;
    }
    float to = is_slope ? ends[i] : (i < 6 ? ends[i - 3] : 1.0);
    bool to_side = to_within;
    if (is_slope) {
      to_side = power.x + to * (2.0 * power.y + to * (3.0 * power.z + to * 4.0 * power.w)) > 0.0;
    } else if (i < 6) {
      to_side = to > from ? curve_within(path, curve, to).x > 0.0 : side;
    }
    if (side != to_side) {
      // Newton's method between bounds.
      float low = from;
      float high = to;
      float s = is_level ? (to_side ? 1.0 : 0.0) : 0.5 * (low + high);
      float step_before = high - low;
      for (int round = 0; round < MOST_STEPS && !is_level; ++round) {
        ++rounds_spent;
        vec2 value;
        if (is_slope) {
          value = vec2(power.x + s * (2.0 * power.y + s * (3.0 * power.z + s * 4.0 * power.w)),
                       2.0 * power.y + s * (6.0 * power.z + s * 12.0 * power.w));
        } else {
          value = curve_within(path, curve, s);
        }
        if ((value.x > 0.0) == side) {
          low = s;
        } else {
          high = s;
        }
        float next = s - value.x / value.y;
        if (!(next > low && next < high && 2.0 * abs(next - s) < step_before)) {
          next = 0.5 * (low + high);
        }
        step_before = abs(next - s);
        s = next;
        if (step_before <= LEAST_STEP) break;
      }
      if (is_slope) {
        ends[i] = s;
      } else {
        note_root(path, curve, s, to_side, is_below, texel, t, crossings);
      }
    }
    from = to;
    side = to_side;
  }
}

void cross_curve(RevolutionPath path, PathCurve curve, bool from_within, bool to_within, int texel,
                 float t, inout ProfileCrossings crossings) {
  bool starts_below = curve.start.y < 0.0;
  bool ends_below = curve.end.y < 0.0;
  // The path's two halves, of which one comes and one goes, are below and above its middle. The
  // curve's heights are start·a² + 2·middle·a·b + end·b² for shares a and b.
  bool is_divided = path.starts_nearest && starts_below != ends_below;
  float middle = curve.weights.y * curve.control.y;
  float larger = abs(middle) + sqrt(max(0.0, middle * middle - curve.start.y * curve.end.y));
  bool is_steeper_at_start = (middle < 0.0) != starts_below;
  float a = is_steeper_at_start ? larger : abs(curve.end.y);
  float b = is_steeper_at_start ? abs(curve.start.y) : larger;
  // De Casteljau's algorithm.
  vec4 start = vec4(curve.start, 1.0);
  vec4 control = curve.weights.y * vec4(curve.control, 1.0);
  vec4 end = vec4(curve.end, 1.0);
  vec4 left = (a * start + b * control) / (a + b);
  vec4 right = (a * control + b * end) / (a + b);
  vec4 at = (a * left + b * right) / (a + b);
  vec3 cut = vec3(at.x / at.w, 0.0, path.rise * path.start);
  bool is_middle_within = cut.x > length(vec2(path.offset, path.start));
  for (int i = is_divided ? 0 : 1; i < 2; ++i) {
    PathCurve part = curve;
    bool from = from_within;
    bool to = to_within;
    bool is_below = path.starts_nearest ? starts_below : path.start < 0.0 == path.upwards > 0.0;
    if (is_divided && i == 0) {
      part = PathCurve(curve.start, left.xyz / left.w, cut, vec3(1.0, left.w, at.w));
      to = is_middle_within;
    } else if (is_divided) {
      part = PathCurve(cut, right.xyz / right.w, curve.end, vec3(at.w, right.w, 1.0));
      from = is_middle_within;
      is_below = ends_below;
    }
    cross_half(path, part, from, to, is_below, texel, t, crossings);
  }
}

void cross_ring(RevolutionPath path, int texel, float t, inout ProfileCrossings crossings) {
  Piece piece = fetch_piece(texel);
  vec3 start = seen_place(path, piece.start);
  vec3 end = seen_place(path, piece.end);
  bool from_within = within(path, start) > 0.0;
  bool to_within = within(path, end) > 0.0;
  if (piece.weight == 0.0) {
    cross_cone(path, start, end, from_within, to_within, texel, t, crossings);
  } else {
    PathCurve curve =
        PathCurve(start, seen_place(path, piece.control), end, vec3(1.0, piece.weight, 1.0));
    cross_curve(path, curve, from_within, to_within, texel, t, crossings);
  }
}

// Returns the last τ at which the path may be in a box; −∞ if it never is.
float leaves_ring(RevolutionPath path, vec4 box) {
  float inner = max(0.0, path.radii.x + path.radii.y * box.x - BOX_MARGIN);
  float outer = path.radii.x + path.radii.y * box.z + BOX_MARGIN;
  // Stands in for infinity, whose product with 0 is none.
  float inverse = path.rise != 0.0 ? 1.0 / path.rise : 1e30;
  float a = (box.y - path.height) * inverse;
  float b = (box.w - path.height) * inverse;
  float enter = max(min(a, b), path.first - BOX_MARGIN);
  float leave = min(max(a, b), path.last + BOX_MARGIN);
  float from = path.start + enter * path.run;
  float to = path.start + leave * path.run;
  float offset2 = path.offset * path.offset;
  // Somewhere in the box's height, ρ is as near to 0 as it can be between its ends.
  float nearest = max(max(from, -to), 0.0);
  float furthest = max(abs(from), abs(to));
  bool meets = enter <= leave && offset2 + nearest * nearest <= outer * outer &&
               offset2 + furthest * furthest >= inner * inner;
  return meets ? leave : -INFINITY;
}

ProfileCrossings revolution_crossings(CanonicalRay ray, RevolutionPath path, float t) {
  ProfileCrossings result = NO_CROSSINGS;
  int texel = ray.faces + 1;
  int end = texel + int(texelFetch(u_profiles, ray.faces).x);
  int leaf_end = 0;  // the texels of a leaf's pieces end here
  // A round passes a node or a piece.
  for (; texel < end && rounds_spent < MOST_NONCONVEX_ROUNDS; ++rounds_spent) {
    if (texel < leaf_end) {
      cross_ring(path, texel, t, result);
      texel += PIECE_TEXELS;
      continue;
    }
    vec4 box = texelFetch(u_profiles, texel);
    vec2 counts = texelFetch(u_profiles, texel + 1).xy;
    texel += 2;
    // Crossings before t are not needed.
    float leave = leaves_ring(path, box);
    if (leave != -INFINITY && path.base + path.unit * leave > t) {
      leaf_end = texel + PIECE_TEXELS * int(counts.y);
    } else {
      texel += int(counts.x);
    }
  }
  if (texel < end) unfinished = true;
  return result;
}

// A face's number is its piece's first texel, negative where the ray leaves the solid.
Stretch revolution_stretch(Ray world, CanonicalRay ray, float t) {
  Stretch none = Stretch(false, INFINITY, 0);
  RevolutionPath path;
  if (!find_path(ray, path)) return none;
  Stretch result = Stretch(false, t, 0);
  for (;;) {
    ProfileCrossings crossings = revolution_crossings(ray, path, result.end);
    if (unfinished || crossings.next == INFINITY) return none;
    bool inside = is_filled(ray, crossings.turns_behind);
    result = Stretch(inside, crossings.next, inside ? -crossings.next_piece : crossings.next_piece);
    if (is_filled(ray, crossings.turns_behind - crossings.next_turns) != inside) return result;
  }
}

vec3 revolution_gradient(CanonicalRay ray, vec3 point, int face) {
  vec2 radii = texelFetch(u_profiles, ray.faces).zw;
  float radius = length(point.xy);
  vec2 across = piece_normal(abs(face), vec2((radius - radii.x) / radii.y, point.z));
  // At an apex, the axis stands in.
  vec3 normal = vec3(across.x * point.xy, radii.y * radius * across.y);
  return faced_normal(ray, normal == vec3(0.0) ? vec3(0.0, 0.0, 1.0) : normal, face);
}
