// The extrusion, which is not drawn (solid_buffers.cpp refuses it).

Stretch extrusion_stretch(Ray world, CanonicalRay ray, float t) { return Stretch(false, INFINITY, 0); }

vec3 extrusion_gradient(CanonicalRay ray, int face) { return vec3(0.0, 0.0, 1.0); }
