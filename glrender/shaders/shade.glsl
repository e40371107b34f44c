// The colour of a hit (paper §3.2, step 9).

uniform vec3 u_front, u_back;      // colours of primitives that have none of their own
uniform vec4 u_from_within;        // the colour of faces that are seen from within, where a is 1
uniform vec3 u_light_position;     // of SHADING_PHONG alone

// `complement`: the operations take the primitive away here.
vec3 base_color(uint primitive, bool complement, bool eye_inside, int face) {
  uvec4 surface = texelFetch(u_surfaces, int(primitive));
  uint flags = surface.y >> SURFACE_FLAGS_SHIFT;
  uint cut_faces = flags >> CUT_FACES_SHIFT & uint(CUT_FACES_MASK);
  bool is_cut = cut_faces == uint(CUT_FACES_BY_TREE) ? complement : cut_faces == uint(CUT_FACES_ALWAYS);
  vec3 scheme = is_cut && !eye_inside ? u_back : u_front;
#if HAS_MESHES
  if ((flags & uint(FACE_COLORS_FLAG)) != 0u) {
    vec3 of_face = mesh_color(face);
    return mix(scheme, of_face, greaterThanEqual(of_face, vec3(0.0)));
  }
#endif
  vec3 own = vec3(uvec3(surface.x, surface.x >> 16u, surface.y) & 65535u) * (BRIGHTEST_COLOR / 65535.0);
  return mix(scheme, own, notEqual(flags & uvec3(1u, 2u, 4u), uvec3(0u)));
}

// `normal` points out of the solid.
vec3 shade(vec3 color, vec3 point, vec3 normal, vec3 ray_direction) {
#if SHADING == SHADING_PHONG
  vec3 to_eye = -normalize(ray_direction);
  vec3 n = dot(normal, to_eye) < 0.0 ? -normal : normal;
  vec3 to_light = normalize(u_light_position - point);
  float cosine = dot(n, to_light);
  vec3 result = color * (PHONG_AMBIENT + PHONG_DIFFUSE * max(cosine, 0.0));
  if (cosine > 0.0) {
    vec3 reflected = 2.0 * cosine * n - to_light;
    result += PHONG_SPECULAR * pow(max(dot(reflected, to_eye), 0.0), PHONG_EXPONENT);
  }
  return min(result, vec3(1.0));
#elif SHADING == SHADING_STUDIO
  vec3 n = dot(normal, ray_direction) > 0.0 ? -normal : normal;
  vec3 n_eye = vec3(dot(n, u_right), dot(n, u_up), -dot(n, u_forward));
  vec3 key = normalize(vec3(STUDIO_KEY_RIGHT, STUDIO_KEY_UP, STUDIO_KEY_NEAR));
  vec3 fill = normalize(vec3(STUDIO_FILL_RIGHT, STUDIO_FILL_UP, STUDIO_FILL_NEAR));
  return color * (STUDIO_AMBIENT + STUDIO_FILL * max(dot(n_eye, fill), 0.0) +
                  STUDIO_KEY * max(dot(n_eye, key), 0.0));
#else
  vec3 n_eye = vec3(dot(normal, u_right), dot(normal, u_up), -dot(normal, u_forward));
  return min(color * (0.2 + abs(dot(n_eye, vec3(-1.0, 1.0, 1.0))) / sqrt(3.0)), vec3(1.0));
#endif
}
