// What the extrusion and the revolution share: the profile (csgcore/profile.hpp), and the crossings
// of a ray with its pieces.
//
// A vertex lies on one side of a ray's path through the figure's plane, or else on the other. Both
// pieces that share it decide this by the same operations, and a piece is crossed once, or an odd
// number of times, if its ends lie on different sides. So the crossings of a loop cancel on every
// ray, whatever was rounded.

uniform samplerBuffer u_profiles;  // see shape_texels.hpp

const int PIECE_TEXELS = 3;

struct Piece {
  vec2 start, control, end;
  float weight;  // 0: a line
};

Piece fetch_piece(int texel) {
  vec4 a = texelFetch(u_profiles, texel);
  vec4 b = texelFetch(u_profiles, texel + 1);
  return Piece(a.xy, a.zw, b.xy, b.z);
}

// The crossings of a ray behind some t.
struct ProfileCrossings {
  int turns_behind;  // by how much the winding number grows behind t
  float next;        // the t of the next crossing; +∞: there is none
  int next_turns;    // by how much the winding number grows at this t
  int next_piece;
};

#define NO_CROSSINGS ProfileCrossings(0, INFINITY, 0, 0)

void note_crossing(inout ProfileCrossings crossings, float t, float at, int turn, int piece) {
  if (!(at > t)) return;
  crossings.turns_behind += turn;
  if (at < crossings.next) {
    crossings.next = at;
    crossings.next_turns = 0;
    crossings.next_piece = piece;
  }
  if (at == crossings.next) crossings.next_turns += turn;
}

bool is_filled(CanonicalRay ray, int winding) {
  bool is_nonzero = texelFetch(u_profiles, ray.faces).y != 0.0;
  return is_nonzero ? winding != 0 : (winding & 1) != 0;
}

vec2 turned_right(vec2 v) { return vec2(v.y, -v.x); }

// Returns a normal of the piece, of any length, at a point on it (profile_line.cpp).
vec2 piece_normal(int texel, vec2 point) {
  Piece piece = fetch_piece(texel);
  vec4 ways = texelFetch(u_profiles, texel + 2);
  vec2 chord = turned_right(ways.xy);
  if (piece.weight == 0.0) return chord;
  vec2 from_start = turned_right(ways.zw);
  vec2 to_end = chord - from_start;
  float a = dot(to_end, point - piece.control);
  float c = dot(from_start, point - piece.start);
  float b = dot(chord, point - piece.start);
  vec2 normal = b * chord - 2.0 * piece.weight * piece.weight * (a * from_start + c * to_end);
  return normal == vec2(0.0) ? chord : normal;
}

// Returns the normal turned against the ray where it enters the solid, and along it where it leaves
// (face < 0).
vec3 faced_normal(CanonicalRay ray, vec3 normal, int face) {
  bool is_along = dot(normal, ray.direction) > 0.0;
  return is_along == face < 0 ? normal : -normal;
}
