// Rasterises a tile of the screen, one instance each: exactly its pixels, at the nearest depth.

layout(location = LOCATION_LOW) in vec3 a_low;    // x, y: pixels from the upper left corner; z:
                                                  // v_cut_t
layout(location = LOCATION_HIGH) in vec3 a_high;  // pixels
layout(location = LOCATION_LIST) in uvec2 a_list;  // first test, number of tests

flat out float v_cut_t;  // the solid holds at this t on every ray of the tile; +inf: no such t is
                         // known
flat out uvec2 v_list;

void main() {
  v_cut_t = a_low.z;
  v_list = a_list;
  vec2 corner = vec2((gl_VertexID & 1) != 0 ? a_high.x : a_low.x,
                     (gl_VertexID & 2) != 0 ? a_low.y : a_high.y);
  gl_Position = vec4(2.0 * corner / u_viewport - 1.0, 0.0, 1.0);
  gl_Position.y = -gl_Position.y;
}
