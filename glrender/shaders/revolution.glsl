// The revolution, which is not drawn (solid_buffers.cpp refuses it).

Stretch revolution_stretch(Ray world, CanonicalRay ray, float t) { return Stretch(false, INFINITY, 0); }

vec3 revolution_gradient(CanonicalRay ray, vec3 point, int face) { return vec3(0.0, 0.0, 1.0); }
