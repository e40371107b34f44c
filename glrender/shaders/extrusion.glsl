// The extrusion.

Segment extrusion_segment(CanonicalRay ray) { return NO_SEGMENT; }

vec3 extrusion_gradient(CanonicalRay ray, vec3 point) { return vec3(0.0, 0.0, 1.0); }
