// Rays, segments and the ray-primitive intersections of paper §3.2, steps 1 to 4.

const float INFINITY = uintBitsToFloat(0x7F800000u);
const float LAST_T = uintBitsToFloat(0x7F7FFFFFu);  // as far as a ray goes

uniform samplerBuffer u_primitives;    // PRIMITIVE_TEXELS texels each
uniform usamplerBuffer u_surfaces;     // per primitive: colour, colour as a cut face, id
uniform usamplerBuffer u_literals;     // primitive and complement bit, if_inside, if_outside
#if HAS_POLYHEDRON
uniform samplerBuffer u_polyhedra;     // see polyhedron_texels.hpp
#endif

struct Ray {
  vec3 origin, direction;
};

// Where the ray is inside a primitive: start ≤ t < end. Empty: start = +∞, end = −∞.
struct Segment {
  float start, end;
  int start_face, end_face;  // texels of u_polyhedra; 0: on a sphere or frustum
};

struct Literal {
  uint primitive;
  bool complement;
  uint if_inside, if_outside;
};

const Segment NO_SEGMENT = Segment(INFINITY, -INFINITY, 0, 0);

Ray pixel_ray() {
  vec2 ndc = (2.0 * (gl_FragCoord.xy + u_displacement) - u_viewport) / u_viewport;
  vec3 lateral = ndc.x * u_half_extent.x * u_right + ndc.y * u_half_extent.y * u_up;
  if (PERSPECTIVE != 0) return Ray(u_eye_distance * lateral, u_forward + lateral);
  return Ray(lateral, u_forward);
}

// The first t that is drawn: the eye in perspective; everything in an orthographic picture.
float first_t() { return PERSPECTIVE != 0 ? -u_eye_distance : -INFINITY; }

// Paper §3.2, "Ray-cell intersection": x = where the ray enters the box, y = where it leaves it;
// x > y if it misses. Neighbouring cells share the very same plane, and so the very same t.
vec2 box_range(Ray ray, vec3 box_min, vec3 box_max) {
  float enter = -INFINITY;
  float leave = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    float o = ray.origin[axis];
    float d = ray.direction[axis];
    if (d == 0.0) {
      if (o < box_min[axis] || o > box_max[axis]) return vec2(INFINITY, -INFINITY);
    } else {
      float a = (box_min[axis] - o) / d;
      float b = (box_max[axis] - o) / d;
      enter = max(enter, min(a, b));
      leave = min(leave, max(a, b));
    }
  }
  return vec2(enter, leave);
}

Literal fetch_literal(uint index) {
  uvec4 texel = texelFetch(u_literals, int(index));
  return Literal(texel.x & 0x7FFFFFFFu, (texel.x & 0x80000000u) != 0u, texel.y, texel.z);
}

// The ray in a primitive's canonical space, re-based at `base_t`, where it passes closest to the
// primitive's centre: from there on the magnitudes are those of the primitive, not of its distance.
struct CanonicalRay {
  vec3 origin, direction;
  float base_t;
  float radius_mid, radius_slope;
  bool is_sphere;  // the primitive, or what encloses a polyhedron
  bool is_none;    // too thin a primitive to exist
  int faces;       // texel of u_polyhedra
  mat3 world_to_canonical;
};

CanonicalRay canonical_ray(Ray ray, uint primitive) {
  int texel = int(primitive) * PRIMITIVE_TEXELS;
  vec4 center = texelFetch(u_primitives, texel);
  vec4 row_x = texelFetch(u_primitives, texel + 1);
  vec4 row_y = texelFetch(u_primitives, texel + 2);
  vec4 row_z = texelFetch(u_primitives, texel + 3);
  CanonicalRay result;
  result.world_to_canonical = transpose(mat3(row_x.xyz, row_y.xyz, row_z.xyz));
  vec3 offset = ray.origin - center.xyz;
  result.base_t = -dot(offset, ray.direction) / dot(ray.direction, ray.direction);
  result.origin = result.world_to_canonical * (offset + result.base_t * ray.direction);
  result.direction = result.world_to_canonical * ray.direction;
  result.radius_mid = row_x.w;
  result.radius_slope = row_y.w;
  result.is_sphere = row_z.w == SHAPE_SPHERE;
  result.is_none = row_z.w == SHAPE_NONE;
  result.faces = int(center.w);
#if HAS_POLYHEDRON
  // Flat solids are steep in canonical space: there, what passes closest is another point.
  float nearest = -dot(result.origin, result.direction) / dot(result.direction, result.direction);
  result.origin += nearest * result.direction;
  result.base_t += nearest;
#endif
  return result;
}

// |origin + s·direction| ≤ 1, about the point nearest to the centre.
Segment intersect_sphere(CanonicalRay ray) {
  float length2 = dot(ray.direction, ray.direction);
  float nearest = -dot(ray.origin, ray.direction) / length2;
  vec3 q = ray.origin + nearest * ray.direction;
  float inside = 1.0 - dot(q, q);
  if (!(inside > 0.0)) return NO_SEGMENT;
  float half_chord = sqrt(inside / length2);
  float middle = ray.base_t + nearest;
  return Segment(middle - half_chord, middle + half_chord, 0, 0);
}

// The slab |z| ≤ 1 cut with the wall x² + y² ≤ (mid + slope·z)², on the nappe with a radius ≥ 0.
Segment intersect_frustum(CanonicalRay ray) {
  vec3 p = ray.origin;
  vec3 d = ray.direction;
  float slab_start = -INFINITY;
  float slab_end = INFINITY;
  if (d.z != 0.0) {
    float a = (-1.0 - p.z) / d.z;
    float b = (1.0 - p.z) / d.z;
    slab_start = min(a, b);
    slab_end = max(a, b);
  } else if (abs(p.z) > 1.0) {
    return NO_SEGMENT;
  }
  // Re-based again, at the ray's nearest point to the axis within the slab.
  float lateral2 = dot(d.xy, d.xy);
  float base = lateral2 > 0.0 ? -dot(p.xy, d.xy) / lateral2 : 0.0;
  base = clamp(base, slab_start, slab_end);
  p += base * d;
  float radius = ray.radius_mid + ray.radius_slope * p.z;
  float growth = ray.radius_slope * d.z;
  float a = lateral2 - growth * growth;
  float h = dot(p.xy, d.xy) - growth * radius;
  float c = dot(p.xy, p.xy) - radius * radius;
  float wall_start = -INFINITY;
  float wall_end = INFINITY;
  if (a == 0.0 && h == 0.0) {
    if (c > 0.0) return NO_SEGMENT;
  } else {
    float discriminant = h * h - a * c;
    if (a >= 0.0 && !(discriminant > 0.0)) return NO_SEGMENT;
    float q = -(h + (h < 0.0 ? -1.0 : 1.0) * sqrt(max(discriminant, 0.0)));
    float root_a = q / a;
    float root_b = q != 0.0 ? c / q : 0.0;  // q = 0: the ray passes through the apex, at 0
    if (a >= 0.0) {
      wall_start = min(root_a, root_b);
      wall_end = max(root_a, root_b);
    } else if (growth > 0.0) {
      wall_start = max(root_a, root_b);
    } else {
      wall_end = min(root_a, root_b);
    }
  }
  float start = max(slab_start - base, wall_start);
  float end = min(slab_end - base, wall_end);
  if (!(start < end)) return NO_SEGMENT;
  float offset = ray.base_t + base;
  return Segment(offset + start, offset + end, 0, 0);
}

Segment intersect_quadric(CanonicalRay ray) {
  if (ray.is_none) return NO_SEGMENT;
#if HAS_SPHERE && HAS_FRUSTUM
  if (ray.is_sphere) return intersect_sphere(ray);
  return intersect_frustum(ray);
#elif HAS_SPHERE
  return intersect_sphere(ray);
#else
  return intersect_frustum(ray);
#endif
}

#if HAS_POLYHEDRON

// Cuts the segment of what encloses a polyhedron by its faces (csgcore/polyhedron.hpp). A face is
// noted though rounding may put it behind the enclosure's own end.
Segment cut_by_faces(CanonicalRay ray, Segment segment) {
  float enters = -INFINITY;
  float leaves = INFINITY;
  int last = ray.faces + int(texelFetch(u_polyhedra, ray.faces).x);
  for (int i = ray.faces + 1; i <= last && segment.start < segment.end; ++i) {
    vec4 entry = texelFetch(u_polyhedra, i);
    float height = dot(entry.xyz, ray.origin);
    float growth = dot(entry.xyz, ray.direction);
    if (entry.w > 0.0) {
      // A branch: what holds at both ends holds between them.
      float limit = texelFetch(u_polyhedra, ++i).x;
      float reach = height + max(segment.start * growth, segment.end * growth);
      if (reach <= limit) i += int(entry.w);
    } else {
      float room = 1.0 - height;
      float at = room / growth;
      if (growth < 0.0 && at > enters) {
        enters = at;
        segment.start = max(segment.start, at);
        segment.start_face = i;
      } else if (growth > 0.0 && at < leaves) {
        leaves = at;
        segment.end = min(segment.end, at);
        segment.end_face = i;
      } else if (growth == 0.0 && room < 0.0) {
        segment.start = INFINITY;
      }
    }
  }
  return segment;
}

Segment intersect(Ray ray, uint primitive) {
  CanonicalRay canonical = canonical_ray(ray, primitive);
  // Cut before it becomes relative to the focus, where a small polyhedron's faces are close together.
  float base_t = canonical.base_t;
  canonical.base_t = 0.0;
  Segment segment = cut_by_faces(canonical, intersect_quadric(canonical));
  if (!(segment.start < segment.end)) return NO_SEGMENT;
  segment.start += base_t;
  segment.end += base_t;
  return segment;
}

#else

Segment intersect(Ray ray, uint primitive) { return intersect_quadric(canonical_ray(ray, primitive)); }

#endif

// The primitive's own outward unit normal, in world space, where the ray crosses its surface at t.
// Of a frustum's faces the point lies on the one that it is nearer to: no segment need carry which.
// Of a polyhedron's it is `face` (see Segment).
vec3 normal_at(Ray ray, uint primitive, float t, int face) {
  CanonicalRay canonical = canonical_ray(ray, primitive);
  vec3 q = canonical.origin + (t - canonical.base_t) * canonical.direction;
  vec3 gradient = q;
  if (!canonical.is_sphere) {
    // By distances in the world, where t was rounded: a plate's cap is far nearer there than its
    // wall.
    float radius = canonical.radius_mid + canonical.radius_slope * q.z;
    vec3 cap = vec3(0.0, 0.0, q.z < 0.0 ? -1.0 : 1.0);
    vec3 wall = vec3(q.xy, -canonical.radius_slope * radius);
    float from_cap = abs(abs(q.z) - 1.0) * length(wall * canonical.world_to_canonical);
    float from_wall = 0.5 * abs(dot(q.xy, q.xy) - radius * radius) *
                      length(cap * canonical.world_to_canonical);
    gradient = from_cap < from_wall ? cap : wall;
  }
#if HAS_POLYHEDRON
  if (face > 0) gradient = texelFetch(u_polyhedra, face).xyz;
#endif
  vec3 normal = gradient * canonical.world_to_canonical;
  float length2 = dot(normal, normal);
  // At a cone's very apex there is none: it faces the viewer.
  return length2 > 0.0 ? normal * inversesqrt(length2) : -normalize(ray.direction);
}
