// The triangle mesh.

Segment mesh_segment(CanonicalRay ray) { return NO_SEGMENT; }

vec3 mesh_gradient(CanonicalRay ray, vec3 point) { return vec3(0.0, 0.0, 1.0); }
