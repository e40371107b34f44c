// The frustum: in canonical space |z| ≤ 1, and its larger end has radius 1.

// The slab |z| ≤ 1 cut with the wall x² + y² ≤ (mid + slope·z)², on the nappe with a radius ≥ 0.
Segment frustum_segment(CanonicalRay ray) {
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
  // The ray is re-based again, at its point nearest to the axis within the slab.
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

// Returns the gradient of the face, cap or wall, that the point is nearer to, so that no segment
// need carry the face. Distances are compared in the world, where t was rounded: a plate's cap is
// far nearer there than its wall.
vec3 frustum_gradient(CanonicalRay ray, vec3 point) {
  float radius = ray.radius_mid + ray.radius_slope * point.z;
  vec3 cap = vec3(0.0, 0.0, point.z < 0.0 ? -1.0 : 1.0);
  vec3 wall = vec3(point.xy, -ray.radius_slope * radius);
  float from_cap = abs(abs(point.z) - 1.0) * length(wall * ray.world_to_canonical);
  float from_wall = 0.5 * abs(dot(point.xy, point.xy) - radius * radius) *
                    length(cap * ray.world_to_canonical);
  return from_cap < from_wall ? cap : wall;
}
