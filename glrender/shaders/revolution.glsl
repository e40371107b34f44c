// The revolution of a profile of lines (solid_buffers.cpp refuses curves). The half plane that holds the figure is passed by a ray on a branch
// of a hyperbola, its path (revolution_path.hpp). A point of the half plane is a vec3 here: its
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

void cross_ring(RevolutionPath path, int texel, float t, inout ProfileCrossings crossings) {
  Piece piece = fetch_piece(texel);
  vec3 start = seen_place(path, piece.start);
  vec3 end = seen_place(path, piece.end);
  bool from_within = within(path, start) > 0.0;
  bool to_within = within(path, end) > 0.0;
  cross_cone(path, start, end, from_within, to_within, texel, t, crossings);
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
  const Stretch NONE = Stretch(false, INFINITY, 0);
  RevolutionPath path;
  if (!find_path(ray, path)) return NONE;
  Stretch result = Stretch(false, t, 0);
  for (;;) {
    ProfileCrossings crossings = revolution_crossings(ray, path, result.end);
    if (unfinished || crossings.next == INFINITY) return NONE;
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
