// Rasterises the box of a cell, in which its rays are traced (paper §3.1.1). There is one instance
// a cell. All coordinates are along world axes, relative to the view's focus.

layout(location = LOCATION_LOW) in vec3 a_box_min;
layout(location = LOCATION_HIGH) in vec3 a_box_max;
layout(location = LOCATION_LIST) in uvec2 a_list;  // first test, number of tests

flat out vec3 v_box_min;
flat out vec3 v_box_max;
flat out uvec2 v_list;

void main() {
  v_box_min = a_box_min;
  v_box_max = a_box_max;
  v_list = a_list;
  bvec3 upper = bvec3((gl_VertexID & 1) != 0, (gl_VertexID & 2) != 0, (gl_VertexID & 4) != 0);
  vec3 corner = mix(a_box_min, a_box_max, upper);
  // The box is pushed out by a fraction of a pixel: the rasteriser rounds vertices to its sub-pixel
  // grid, and no ray that meets the box may be lost by that. The fragment shader clips exactly.
  float depth = abs(u_eye_distance + dot(corner, u_forward));
  float pixel = PERSPECTIVE != 0 ? u_pixel_size * depth : u_pixel_size;
  corner += mix(vec3(-1.0), vec3(1.0), upper) * (INFLATION_PX * pixel + u_overlap);

  float along = dot(corner, u_forward);
  vec2 lateral = vec2(dot(corner, u_right), dot(corner, u_up)) / u_half_extent;
  if (PERSPECTIVE != 0) {
    float w = u_eye_distance + along;
    gl_Position = vec4(lateral, u_depth_scale * (u_far - along), w);
  } else {
    gl_Position = vec4(lateral, u_depth_scale * (u_far - along), 1.0);
  }
  // The box is moved by the rays' displacement, so that a pixel is drawn if its displaced ray meets
  // it.
  gl_Position.xy -= 2.0 * u_displacement / u_viewport * gl_Position.w;
#if !CLIP_ZERO_TO_ONE
  gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
#endif
}
