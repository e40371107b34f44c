// Draws the cells themselves, as boxes with their edges (paper, figure 5b).

flat in vec3 v_box_min;
flat in vec3 v_box_max;
flat in uvec2 v_list;

layout(location = 0) out vec4 o_color;
#if MEASURED
layout(location = 1) out vec4 o_measured;
layout(location = 2) out uint o_id;
#endif

uniform vec3 u_edge;

void main() {
  Ray ray = pixel_ray();
  vec2 range = box_range(ray, v_box_min, v_box_max);
  float t = range.x >= first_t() ? range.x : range.y;
  if (!(range.x <= range.y && t >= first_t())) discard;
  vec3 point = ray.origin + t * ray.direction;
  // The point's distance from the planes of the box, in pixels; on an edge it is near two of them.
  vec3 gap = min(abs(point - v_box_min), abs(v_box_max - point));
  float depth = u_eye_distance + t;
  vec3 gap_px = gap / (PERSPECTIVE != 0 ? u_pixel_size * depth : u_pixel_size);
  float nearest = min(gap_px.x, min(gap_px.y, gap_px.z));
  float furthest = max(gap_px.x, max(gap_px.y, gap_px.z));
  float second = gap_px.x + gap_px.y + gap_px.z - nearest - furthest;
  vec3 normal = nearest == gap_px.x ? vec3(1, 0, 0) : (nearest == gap_px.y ? vec3(0, 1, 0) : vec3(0, 0, 1));
  normal *= dot(normal, ray.direction) > 0.0 ? -1.0 : 1.0;
  vec3 face = shade(u_front, point, normal, ray.direction);
  o_color = vec4(second < EDGE_WIDTH_PX ? u_edge : face, 1.0);
#if MEASURED
  o_measured = vec4(normal, t);
  o_id = 0xFFFFFFFFu;
#endif
  float window = u_depth_scale * (u_far - t);
  if (PERSPECTIVE != 0) window /= depth;
  gl_FragDepth = clamp(window, 0.0, 1.0);
}
