// Rays, segments, and what the ray-primitive intersections of the kinds (paper §3.2, steps 1 to 4)
// share. Each kind of primitive has a file of its own (sphere.glsl and so on) and is one of three
// sorts:
// - It has a segment on a ray, and a gradient: kind_segment() and kind_gradient().
// - It is a primitive of another kind, its enclosure, cut further: kind_cut() and
//   kind_cut_gradient().
// - It is not convex, so that a ray may meet it in any number of segments: kind_stretch() and
//   kind_gradient().
//
// kinds_source() (shader_kinds.hpp) writes the code that calls these functions by name, for the
// kinds that the scene has.

// Keeps a compiler from ordering the operations otherwise in one place than in another.
#ifdef GL_ARB_gpu_shader5
#define PRECISE precise
#else
#define PRECISE
#endif

#define INFINITY uintBitsToFloat(0x7F800000u)  // no constant for Khronos' compiler
#define LAST_T uintBitsToFloat(0x7F7FFFFFu)  // the largest t of a ray

uniform samplerBuffer u_primitives;    // PRIMITIVE_TEXELS texels each
uniform usamplerBuffer u_surfaces;  // per primitive: colour, flags, id
uniform usamplerBuffer u_tests;     // per test: primitive and complement bit, if_inside, if_outside,
                                    // whether the primitive is convex
uniform float u_tolerance;          // thinner pieces do not exist; along the normal, in world units

struct Ray {
  vec3 origin, direction;
};

// The part of a ray inside a primitive: start ≤ t < end. It is empty if start = +∞ and end = −∞.
struct Segment {
  float start, end;
  int start_face, end_face;  // > 0: the face that the kind's cut has noted; 0: a face of the
                             // enclosure
};

// The part of a ray from some t to the next t at which the ray enters or leaves the primitive.
struct Stretch {
  bool inside;  // whether this part lies in the primitive
  float end;    // +∞: it does not end
  int face;     // the face at its end: see Segment and the kind's own file
};

struct BlistTest {
  uint primitive;
  bool complement, is_convex;
  uint if_inside, if_outside;
};

#define NO_SEGMENT Segment(INFINITY, -INFINITY, 0, 0)

Ray pixel_ray() {
  vec2 ndc = (2.0 * (gl_FragCoord.xy + u_displacement) - u_viewport) / u_viewport;
  vec3 lateral = ndc.x * u_half_extent.x * u_right + ndc.y * u_half_extent.y * u_up;
  if (PERSPECTIVE != 0) return Ray(u_eye_distance * lateral, u_forward + lateral);
  return Ray(lateral, u_forward);
}

// The least t that is drawn: the eye's in perspective; orthographic rays have none.
float first_t() { return PERSPECTIVE != 0 ? -u_eye_distance : -INFINITY; }

// Returns where the ray enters the box (x) and leaves it (y); x > y if it misses (paper §3.2,
// "Ray-cell intersection"). Neighbouring cells share the very same plane, and so the very same t.
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

BlistTest fetch_test(uint index) {
  uvec4 texel = texelFetch(u_tests, int(index));
  return BlistTest(texel.x & 0x7FFFFFFFu, (texel.x & 0x80000000u) != 0u, texel.w != 0u, texel.y,
                   texel.z);
}

// The ray in a primitive's canonical space, re-based at `base_t`, where it passes closest to the
// primitive's centre. From there on magnitudes are of the primitive's size, not of its distance.
struct CanonicalRay {
  vec3 origin, direction;
  float base_t;
  float radius_mid, radius_slope;
  float enclosure;  // kind of the primitive's enclosure, which is its own unless it is cut
  bool is_none;     // the primitive is too thin to exist
  int faces;        // first texel of the primitive's faces (polyhedron.glsl, mesh.glsl, profile.glsl)
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
  result.enclosure = row_z.w;
  result.is_none = row_z.w == SHAPE_NONE;
  result.faces = int(center.w);
#if HAS_CUTS || HAS_NONCONVEX
  // A flat solid is steep in canonical space, where another point of the ray is the closest.
  float nearest = -dot(result.origin, result.direction) / dot(result.direction, result.direction);
  result.origin += nearest * result.direction;
  result.base_t += nearest;
#endif
  return result;
}

// The segment of the primitive's enclosure, which is all of the primitive unless it is cut.
Segment enclosure_segment(CanonicalRay ray);
// The canonical gradient of the enclosure at a point of its surface, of any length.
vec3 enclosure_gradient(CanonicalRay ray, vec3 point);

Segment fallback_segment(CanonicalRay ray) {
  if (ray.is_none) return NO_SEGMENT;
  return enclosure_segment(ray);
}

#if HAS_CUTS

// Returns the part of the enclosure's segment that belongs to the primitive. A kind's cut leaves
// the segments of other kinds as they are.
Segment cut_segment(CanonicalRay ray, Segment segment);
// Returns the canonical gradient at a point of the primitive's surface: that of the face if a cut has noted
// one, else the enclosure's, unless the primitive's kind has another there.
vec3 cut_gradient(CanonicalRay ray, vec3 point, int face, vec3 gradient);

Segment intersect(Ray ray, uint primitive) {
  CanonicalRay canonical = canonical_ray(ray, primitive);
  // The segment is cut before it becomes relative to the focus: near the primitive, floats are
  // finer.
  float base_t = canonical.base_t;
  canonical.base_t = 0.0;
  Segment segment = cut_segment(canonical, fallback_segment(canonical));
  if (!(segment.start < segment.end)) return NO_SEGMENT;
  segment.start += base_t;
  segment.end += base_t;
  return segment;
}

#else

Segment intersect(Ray ray, uint primitive) { return fallback_segment(canonical_ray(ray, primitive)); }

#endif

// Set if the pixel is given up. The CPU draws it then (renderer.cpp).
bool unfinished = false;

#if HAS_NONCONVEX

// Loop rounds that the pixel has spent on primitives that are not convex. If it would spend more
// than MOST_NONCONVEX_ROUNDS, it is given up.
int rounds_spent = 0;

bool is_nonconvex(CanonicalRay ray);
// Returns the stretch that begins at t. It always ends behind t.
Stretch nonconvex_stretch(Ray world, CanonicalRay ray, float t);
// Returns the canonical normal, of any length, at a stretch's end, the point.
vec3 nonconvex_gradient(CanonicalRay ray, vec3 point, int face);

Stretch stretch_from(Ray ray, uint primitive, float t) {
  return nonconvex_stretch(ray, canonical_ray(ray, primitive), t);
}

#endif

// Returns the outward unit normal of the primitive itself, in world space, where the ray crosses
// its surface at t, on `face` (see Segment).
vec3 normal_at(Ray ray, uint primitive, float t, int face) {
  CanonicalRay canonical = canonical_ray(ray, primitive);
  vec3 q = canonical.origin + (t - canonical.base_t) * canonical.direction;
  vec3 gradient = enclosure_gradient(canonical, q);
#if HAS_CUTS
  gradient = cut_gradient(canonical, q, face, gradient);
#endif
#if HAS_NONCONVEX
  if (is_nonconvex(canonical)) gradient = nonconvex_gradient(canonical, q, face);
#endif
  vec3 normal = gradient * canonical.world_to_canonical;
  float length2 = dot(normal, normal);
  // The apex of a cone has no normal: it faces the viewer.
  return length2 > 0.0 ? normal * inversesqrt(length2) : -normalize(ray.direction);
}
