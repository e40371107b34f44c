// The revolution.

Segment revolution_segment(CanonicalRay ray) { return NO_SEGMENT; }

vec3 revolution_gradient(CanonicalRay ray, vec3 point) { return vec3(0.0, 0.0, 1.0); }
