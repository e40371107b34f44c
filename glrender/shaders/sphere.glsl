// The sphere: in canonical space the unit ball.

// The part of the ray with |origin + s·direction| ≤ 1, solved about the point nearest to the
// centre.
Segment sphere_segment(CanonicalRay ray) {
  float length2 = dot(ray.direction, ray.direction);
  float nearest = -dot(ray.origin, ray.direction) / length2;
  vec3 q = ray.origin + nearest * ray.direction;
  float inside = 1.0 - dot(q, q);
  if (!(inside > 0.0)) return NO_SEGMENT;
  float half_chord = sqrt(inside / length2);
  float middle = ray.base_t + nearest;
  return Segment(middle - half_chord, middle + half_chord, 0, 0);
}

vec3 sphere_gradient(CanonicalRay ray, vec3 point) { return point; }
