// Traces the pixel's ray within its cell (paper §3), or the whole ray of a tile (first_hit.glsl,
// shared_faces.glsl).

#if !TILES
flat in vec3 v_box_min;
flat in vec3 v_box_max;
#endif

layout(location = 0) out vec4 o_color;
#if MEASURED
layout(location = 1) out vec4 o_measured;  // unit normal, t
layout(location = 2) out uint o_id;
#endif
#if CONSERVATIVE_DEPTH
// Depth falls with distance; a hit is never nearer than the front face of its cell.
layout(depth_less) out float gl_FragDepth;
#endif

#if BEHIND
uniform sampler2D u_first;      // o_measured of the picture in front of this one
#endif

// Returns whether the driver has ended a loop too soon. Mesa's software renderer grants the loops of
// a pixel, and of those that it runs beside, some rounds in total (kMostRounds). Once these are
// spent, every loop ends after its first round, and so does this one.
bool is_out_of_rounds() {
  int all = u_viewport.x > 0.0 ? 2 : 1;  // a number that no compiler knows
  int rounds = 0;
  while (rounds < all) ++rounds;
  return rounds < all;
}

void main() {
  Ray ray = pixel_ray();
#if TILES
  vec2 range = vec2(-INFINITY, LAST_T);
#else
  vec2 range = box_range(ray, v_box_min, v_box_max);
#endif
#if BEHIND
  float enter = max(range.x, texelFetch(u_first, ivec2(gl_FragCoord.xy), 0).w);
#else
  // Boundaries within the tolerance of the eye count as crossed: an eye in a face is on its far
  // side.
  float enter = max(range.x, first_t() + u_tolerance);
#endif
  if (!(enter <= range.y) || enter == INFINITY) discard;
  Hit hit = first_hit(ray, enter, range.y);
  Hit seen = hit;
  bool is_shown = hit.t != INFINITY && is_seen(ray, hit, seen);
  if (unfinished || is_out_of_rounds()) {
    o_color = vec4(0.0, 0.0, 0.0, MARK_UNFINISHED);
#if MEASURED
    o_measured = vec4(0.0, 0.0, 0.0, INFINITY);
    o_id = 0xFFFFFFFFu;
#endif
#if !TILES
    gl_FragDepth = gl_FragCoord.z;  // hits in cells further away do not hide the mark
#endif
    return;
  }
  if (!is_shown) discard;
  vec3 point = ray.origin + seen.t * ray.direction;
  // A complement's normal is turned round (paper §3.2, step 4).
  vec3 normal = normal_at(ray, seen.primitive, seen.t, seen.face);
  if (seen.complement) normal = -normal;
  // The boundary behind the first one is traced as if the eye were on its other side.
  bool eye_inside = u_eye_inside != (BEHIND != 0);
  vec3 color = eye_inside && u_from_within.a != 0.0
                   ? u_from_within.rgb
                   : base_color(seen.primitive, seen.complement, eye_inside, seen.face);
  o_color = vec4(shade(color, point, normal, ray.direction), doubtful ? MARK_DOUBTFUL : MARK_SURE);
#if MEASURED
  o_measured = vec4(normal, seen.t);
  o_id = texelFetch(u_surfaces, int(seen.primitive)).z;
#endif
#if !TILES
  // The depth is that of the boundary in the cell; the face that is seen may lie outside it.
  float depth = u_depth_scale * (u_far - hit.t);
  if (PERSPECTIVE != 0) depth /= u_eye_distance + hit.t;
  gl_FragDepth = clamp(depth, 0.0, 1.0);
#endif
}
