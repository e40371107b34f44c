// The triangle mesh (csgcore/triangle_mesh.hpp).
//
// The corners of a triangle are seen in a plane of which the ray is the origin. All triangles that
// share a corner compute it by the same operations, and the two triangles at an edge judge the edge
// by the same comparison. So the crossings of a closed mesh cancel on every ray, however the
// products were rounded.

uniform samplerBuffer u_meshes;  // see shape_texels.hpp

// A ray further from the canonical origin misses the mesh, which lies in the unit ball. The excess
// is far more than the rounding of the ray's distance.
const float MESH_REACH2 = 1.001;

// The crossings of a ray with a mesh, before and behind some t.
struct MeshCrossings {
  int turns;          // by how much the winding number grows on the whole line (open meshes only)
  int turns_behind;   // by how much it grows behind t
  float next;         // the t of the next crossing; +∞: there is none
  int next_turns;     // by how much the winding number grows at this t
  int next_face;
  float sheet_end;    // the furthest end of the sheets (NUMERICS.md, "Meshes") that begin up to t
  int sheet_face;
};

// Returns 1 if the edge from a to b passes the positive x axis counterclockwise, −1 if it passes
// clockwise, else 0. The sum over a polygon's edges is how often it winds around the origin.
int passes_axis(vec2 a, vec2 b) {
  bool upwards = a.y < 0.0;
  if (upwards == b.y < 0.0) return 0;
  vec2 low = upwards ? a : b;
  vec2 high = upwards ? b : a;
  PRECISE float left = low.x * high.y;
  PRECISE float right = low.y * high.x;
  if (!(left > right)) return 0;
  return upwards ? 1 : -1;
}

// Returns the axes of the plane in which the ray is seen, and the ray's direction over its squared
// length (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
mat3 mesh_frame(vec3 direction) {
  float length2 = dot(direction, direction);
  vec3 d = direction * inversesqrt(length2);
  float side = d.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (side + d.z);
  float b = d.x * d.y * a;
  return mat3(vec3(1.0 + side * d.x * d.x * a, side * b, -side * d.x),
              vec3(b, side + d.y * d.y * a, -d.y), direction / length2);
}

// Returns where the corner is seen in that plane, and its depth in t.
vec3 seen_corner(CanonicalRay ray, mat3 frame, vec3 corner) {
  PRECISE vec3 seen = (corner - ray.origin) * frame;
  return seen;
}

// Returns the length of a sheet in t.
float sheet_length(Ray world, CanonicalRay ray, vec3 normal) {
  float speed = abs(dot(normal, ray.direction)) / length(normal * ray.world_to_canonical);
  return SHEET_THICKNESS * u_tolerance / max(speed, SHEET_COSINE * length(world.direction));
}

// Stands in for the infinite inverse of a coordinate that is 0 or almost: its product with 0 is 0.
const float LARGEST_INVERSE = 1e30;

MeshCrossings mesh_crossings(Ray world, CanonicalRay ray, float t) {
  MeshCrossings result = MeshCrossings(0, 0, INFINITY, 0, 0, -INFINITY, 0);
  vec4 header = texelFetch(u_meshes, ray.faces);
  bool is_closed = header.y != 0.0;
  mat3 frame = mesh_frame(ray.direction);
  vec3 inverse = vec3(LARGEST_INVERSE);
  for (int axis = 0; axis < 3; ++axis) {
    if (abs(ray.direction[axis]) * LARGEST_INVERSE > 1.0) inverse[axis] = 1.0 / ray.direction[axis];
  }
  int texel = ray.faces + 1;
  int stride = int(header.z);
  int end = texel + int(header.x);
  int leaf_end = 0;  // the texels of a leaf's triangles end here
  if (dot(ray.origin, ray.origin) > MESH_REACH2) end = texel;
  // A round passes a node or a triangle.
  for (; texel < end && rounds_spent < MOST_NONCONVEX_ROUNDS; ++rounds_spent) {
    vec4 a = texelFetch(u_meshes, texel);
    vec4 b = texelFetch(u_meshes, texel + 1);
    if (texel >= leaf_end) {
      texel += 2;
      vec3 to_low = (a.xyz - ray.origin) * inverse;
      vec3 to_high = (b.xyz - ray.origin) * inverse;
      vec3 near = min(to_low, to_high);
      vec3 far = max(to_low, to_high);
      float leave = min(far.x, min(far.y, far.z));
      bool passes = max(near.x, max(near.y, near.z)) <= leave;
      // Crossings of closed meshes before t are not needed.
      if (is_closed) passes = passes && ray.base_t + leave > t;
      if (passes) {
        leaf_end = texel + stride * int(b.w);
      } else {
        texel += int(a.w);
      }
      continue;
    }
    vec4 c = texelFetch(u_meshes, texel + 2);
    vec3 seen_a = seen_corner(ray, frame, a.xyz);
    vec3 seen_b = seen_corner(ray, frame, b.xyz);
    vec3 seen_c = seen_corner(ray, frame, c.xyz);
    // A triangle that is counterclockwise along the ray is left there.
    int turn = -(passes_axis(seen_a.xy, seen_b.xy) + passes_axis(seen_b.xy, seen_c.xy) +
                 passes_axis(seen_c.xy, seen_a.xy));
    if (turn != 0) {
      vec3 normal = vec3(a.w, b.w, c.w);
      float nearest = min(seen_a.z, min(seen_b.z, seen_c.z));
      float furthest = max(seen_a.z, max(seen_b.z, seen_c.z));
      float growth = dot(normal, ray.direction);
      // Along its plane a triangle is passed somewhere between its corners.
      float at = growth != 0.0 ? dot(normal, a.xyz - ray.origin) / growth : nearest;
      at = ray.base_t + clamp(at, nearest, furthest);
      result.turns += turn;
      if (at > t) {
        result.turns_behind += turn;
        if (at < result.next) {
          result.next = at;
          result.next_turns = 0;
          result.next_face = texel;
        }
        if (at == result.next) result.next_turns += turn;
      } else if (!is_closed) {
        float sheet_end = at + sheet_length(world, ray, normal);
        if (sheet_end > result.sheet_end) {
          result.sheet_end = sheet_end;
          result.sheet_face = texel;
        }
      }
    }
    texel += stride;
  }
  if (texel < end) unfinished = true;
  if (is_closed) result.turns = 0;
  return result;
}

// A face's number is the first of its texels, negative where the ray leaves the mesh. If a sheet
// begins before another one ends, the stretch may end with the other one, and the next stretch is
// inside, too.
Stretch mesh_stretch(Ray world, CanonicalRay ray, float t) {
  Stretch result = Stretch(false, t, 0);
  for (;;) {
    MeshCrossings crossings = mesh_crossings(world, ray, result.end);
    if (unfinished) return Stretch(false, INFINITY, 0);
    bool in_sheets = crossings.turns != 0;
    result.inside = in_sheets ? crossings.sheet_end > result.end : crossings.turns_behind != 0;
    if (in_sheets && result.inside) {
      return Stretch(true, crossings.sheet_end, -crossings.sheet_face);
    }
    result.end = crossings.next;
    result.face = result.inside ? -crossings.next_face : crossings.next_face;
    bool changes = in_sheets || (crossings.turns_behind != crossings.next_turns) != result.inside;
    if (changes || result.end == INFINITY) return result;
  }
}

// Returns the colour of a face of a mesh whose faces have colours.
vec3 mesh_color(int face) { return texelFetch(u_meshes, abs(face) + 3).rgb; }

// Returns the normal that is turned against the ray where it enters the mesh, and along it where it
// leaves.
vec3 mesh_gradient(CanonicalRay ray, vec3 point, int face) {
  int texel = abs(face);
  vec3 normal = vec3(texelFetch(u_meshes, texel).w, texelFetch(u_meshes, texel + 1).w,
                     texelFetch(u_meshes, texel + 2).w);
  bool is_along = dot(normal, ray.direction) > 0.0;
  return is_along == face < 0 ? normal : -normal;
}
