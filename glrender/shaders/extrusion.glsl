// The extrusion of a profile. In the figure's plane a ray projects to a straight line, along which
// it moves on (extrusion-inl.hpp). Here radius_mid and radius_slope are those of the figure's scale.

// The face of both caps. Side faces have the number of their piece's first texel.
const int EXTRUSION_CAP = 1;
// The solid lies within |z| ≤ 1, hypot(x, y) ≤ 1, and in a ball of this squared radius.
const float EXTRUSION_BALL2 = 2.0001;
// The figure lies in the square [−1, 1]², and no line that is further than this from its middle
// meets it.
const float FURTHEST_LINE = 1.4143;
// A ray that moves by less than this share of its length stays at its place in the figure.
const float LEAST_MOTION = 1e-12;

// The line of the points p with direction × p = offset. The ray is at
// along = foot + speed·t / (scale·(scale + growth·t)), for t relative to `base`.
struct ExtrusionLine {
  vec2 direction;
  float offset;
  float first, last;      // where the ray enters and leaves the part between the caps, along the
  float first_t, last_t;  // line and in t relative to the ray's base_t
  float base, foot, speed, scale, growth;
};

float along_at(ExtrusionLine line, float t, float scale) {
  float way = line.speed * (t - line.base);
  if (way == 0.0) return line.foot;
  if (scale > 0.0) return line.foot + way / (line.scale * scale);
  return way < 0.0 ? -INFINITY : INFINITY;
}

// Returns t at a place on the line, −∞ before the part between the caps, and +∞ behind it.
float extrusion_t(CanonicalRay ray, ExtrusionLine line, float along) {
  if (along >= line.last) return INFINITY;
  if (along <= line.first) return -INFINITY;
  float way = (along - line.foot) * line.scale;
  float slowed = line.speed - way * line.growth;
  float t = slowed > 0.0 ? line.base + way * line.scale / slowed
                         : (way > 0.0 ? line.last_t : line.first_t);
  return ray.base_t + clamp(t, line.first_t, line.last_t);
}

// Returns false if the ray misses the solid.
bool find_line(CanonicalRay ray, out ExtrusionLine line) {
  vec3 o = ray.origin;
  vec3 d = ray.direction;
  float length2 = dot(d, d);
  float beside2 = EXTRUSION_BALL2 - dot(o, o);
  if (!(beside2 > 0.0)) return false;
  line.last_t = sqrt(beside2 / length2);
  line.first_t = -line.last_t;
  float first_z = o.z + line.first_t * d.z;
  float last_z = o.z + line.last_t * d.z;
  if (d.z != 0.0) {
    float rise = d.z > 0.0 ? 1.0 : -1.0;
    float enter = (-rise - o.z) / d.z;
    float leave = (rise - o.z) / d.z;
    if (enter > line.first_t) {
      line.first_t = enter;
      first_z = -rise;
    }
    if (leave < line.last_t) {
      line.last_t = leave;
      last_z = rise;
    }
  } else if (abs(o.z) > 1.0) {
    return false;
  }
  if (!(line.first_t < line.last_t)) return false;
  float first_scale = ray.radius_mid + ray.radius_slope * first_z;
  float last_scale = ray.radius_mid + ray.radius_slope * last_z;
  // About the point where the figure is largest, nothing cancels.
  line.growth = ray.radius_slope * d.z;
  line.base = line.growth == 0.0 ? 0.0 : (line.growth > 0.0 ? line.last_t : line.first_t);
  line.scale = line.growth == 0.0 ? first_scale : max(first_scale, last_scale);
  if (!(line.scale > 0.0)) return false;
  vec2 at = o.xy + line.base * d.xy;
  vec2 place = at / line.scale;
  vec2 motion = line.scale * d.xy - line.growth * at;
  line.speed = length(motion);
  if (!(line.speed > LEAST_MOTION * sqrt(length2))) line.speed = 0.0;
  // A ray that stays at its place asks what is there, on any line through it.
  line.direction = line.speed > 0.0 ? motion / line.speed : vec2(1.0, 0.0);
  line.offset = line.direction.x * place.y - line.direction.y * place.x;
  if (!(abs(line.offset) <= FURTHEST_LINE)) return false;
  line.foot = dot(line.direction, place);
  line.first = along_at(line, line.first_t, first_scale);
  line.last = along_at(line, line.last_t, last_scale);
  return true;
}

// Returns the distance of a point from the line, > 0 on its left.
float line_height(ExtrusionLine line, vec2 point) {
  PRECISE float height =
      line.direction.x * point.y - line.direction.y * point.x - line.offset;
  return height;
}

// The part of a curve where it crosses the line: its start and end count by these shares.
float curve_along(ExtrusionLine line, Piece piece, float start_share, float end_share) {
  float largest = max(abs(start_share), abs(end_share));
  vec2 share = largest > 0.0 ? abs(vec2(start_share, end_share)) / largest : vec2(1.0);
  float a = share.x * share.x;
  float b = 2.0 * share.x * share.y * piece.weight;
  float c = share.y * share.y;
  return (a * dot(line.direction, piece.start) + b * dot(line.direction, piece.control) +
          c * dot(line.direction, piece.end)) / (a + b + c);
}

// Notes where the line crosses a piece (profile_line.hpp).
void cross_piece(CanonicalRay ray, ExtrusionLine line, int texel, float t,
                 inout ProfileCrossings crossings) {
  Piece piece = fetch_piece(texel);
  float start = line_height(line, piece.start);
  float end = line_height(line, piece.end);
  bool from_left = start >= 0.0;
  bool crosses = from_left != (end >= 0.0);
  int turn = from_left ? 1 : -1;
  if (piece.weight == 0.0) {
    if (!crosses) return;
    float share = start / (start - end);
    // Along an edge across the line this is the same for both of its directions.
    float along = dot(line.direction, piece.start);
    along += share * (dot(line.direction, piece.end) - along);
    note_crossing(crossings, t, extrusion_t(ray, line, along), turn, texel);
    return;
  }
  float middle = piece.weight * line_height(line, piece.control);
  float discriminant = middle * middle - start * end;
  bool touches = (middle >= 0.0) != from_left;
  if (!crosses && !(touches && discriminant > 0.0)) return;
  float larger = abs(middle) + sqrt(max(0.0, discriminant));
  if (!crosses || touches) {
    float along = curve_along(line, piece, larger, start);
    note_crossing(crossings, t, extrusion_t(ray, line, along), turn, texel);
  }
  if (!crosses || !touches) {
    float along = curve_along(line, piece, end, larger);
    note_crossing(crossings, t, extrusion_t(ray, line, along), crosses ? turn : -turn, texel);
  }
}

ProfileCrossings extrusion_crossings(CanonicalRay ray, ExtrusionLine line, float t) {
  ProfileCrossings result = NO_CROSSINGS;
  int texel = ray.faces + 1;
  int end = texel + int(texelFetch(u_profiles, ray.faces).x);
  int leaf_end = 0;  // the texels of a leaf's pieces end here
  // A round passes a node or a piece.
  for (; texel < end && rounds_spent < MOST_NONCONVEX_ROUNDS; ++rounds_spent) {
    if (texel < leaf_end) {
      cross_piece(ray, line, texel, t, result);
      texel += PIECE_TEXELS;
      continue;
    }
    vec4 box = texelFetch(u_profiles, texel);
    vec2 counts = texelFetch(u_profiles, texel + 1).xy;
    texel += 2;
    vec2 center = 0.5 * (box.xy + box.zw);
    vec2 half_size = 0.5 * (box.zw - box.xy);
    vec2 along = abs(line.direction);
    bool passes = abs(line_height(line, center)) <= dot(along, half_size.yx);
    // Crossings before t are not needed. Along a figure that grows or shrinks, rounding may take
    // the end of a box before one of its crossings.
    float leave = extrusion_t(ray, line, dot(line.direction, center) + dot(along, half_size));
    passes = passes && leave != -INFINITY && (line.growth != 0.0 || leave > t);
    if (passes) {
      leaf_end = texel + PIECE_TEXELS * int(counts.y);
    } else {
      texel += int(counts.x);
    }
  }
  if (texel < end) unfinished = true;
  return result;
}

// A face's number is negative where the ray leaves the solid.
Stretch extrusion_stretch(Ray world, CanonicalRay ray, float t) {
  Stretch none = Stretch(false, INFINITY, 0);
  ExtrusionLine line;
  if (!find_line(ray, line)) return none;
  float first = ray.base_t + line.first_t;
  float last = ray.base_t + line.last_t;
  if (!(t < last && first < last)) return none;
  bool is_before = t < first;
  Stretch result = Stretch(false, max(t, first), EXTRUSION_CAP);
  for (;;) {
    ProfileCrossings crossings = extrusion_crossings(ray, line, result.end);
    if (unfinished) return none;
    bool inside = is_filled(ray, crossings.turns_behind);
    if (is_before && inside) return result;
    is_before = false;
    if (!(crossings.next < last)) return inside ? Stretch(true, last, -EXTRUSION_CAP) : none;
    result = Stretch(inside, crossings.next, inside ? -crossings.next_piece : crossings.next_piece);
    if (is_filled(ray, crossings.turns_behind - crossings.next_turns) != inside) return result;
  }
}

vec3 extrusion_gradient(CanonicalRay ray, vec3 point, int face) {
  int texel = abs(face);
  if (texel == EXTRUSION_CAP) return faced_normal(ray, vec3(0.0, 0.0, 1.0), face);
  Piece piece = fetch_piece(texel);
  float scale = ray.radius_mid + ray.radius_slope * point.z;
  vec2 place = piece.weight != 0.0 && scale > 0.0 ? point.xy / scale : piece.start;
  vec2 across = piece_normal(texel, place);
  // The plane that touches the surface there passes through the apex.
  return faced_normal(ray, vec3(across, -ray.radius_slope * dot(across, place)), face);
}
