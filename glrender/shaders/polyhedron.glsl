// The convex polyhedron: its enclosure, cut by its faces (csgcore/polyhedron.hpp).

uniform samplerBuffer u_polyhedra;  // see shape_texels.hpp

// Cuts the segment by the faces. A face's number is its texel in u_polyhedra. It is noted even if
// rounding puts the face beyond the enclosure's own end.
Segment polyhedron_cut(CanonicalRay ray, Segment segment) {
  float enters = -INFINITY;
  float leaves = INFINITY;
  int last = ray.faces + int(texelFetch(u_polyhedra, ray.faces).x);
  for (int i = ray.faces + 1; i <= last && segment.start < segment.end; ++i) {
    vec4 entry = texelFetch(u_polyhedra, i);
    float height = dot(entry.xyz, ray.origin);
    float growth = dot(entry.xyz, ray.direction);
    if (entry.w > 0.0) {
      // A branch. Its bound is linear along the segment: it holds all along if it holds at both
      // ends.
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

vec3 polyhedron_cut_gradient(CanonicalRay ray, vec3 point, int face, vec3 gradient) {
  if (face > 0) gradient = texelFetch(u_polyhedra, face).xyz;
  return gradient;
}
