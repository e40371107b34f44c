// The constants that C++ and the shaders share. Every shader is compiled with a #define of each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "csgcore/blist.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/studio_light.hpp"

namespace glrender {

/// The ways to evaluate a list of primitives, a shader variant each. All cells or tiles of one path
/// are drawn by one call.
enum class Path : int {
  kSingle,     // a primitive or its complement; the depth buffer unites (paper §3.2, §3.3.3)
  kUnion,      // kSingle within a union whose later operands may have the same face
  kBoth,       // §3.3.4 case 1
  kMinus,      // cases 2 and 3
  kNeither,    // case 4
  kShortList,  // any Blist of up to short_list() primitives
  kLongList,   // a tile's Blist of up to kLongList primitives
  kList,       // any Blist
  kBoxes,      // the cells themselves
};
constexpr int kPaths = 9;

/// The most primitives for which a fragment keeps all segments of those that are convex: in cells,
/// 8 is the default K. `are_dear`: finding a segment that faces cut takes some hundred loop rounds
/// (see kMostRounds), and a primitive that is not convex makes a ray ask again and again, so that
/// longer lists are kept, too. In tiles all lists keep theirs.
constexpr uint32_t short_list(bool are_dear, bool tiles) { return are_dear || tiles ? 32 : 8; }
/// Longer lists of a tile are refused, as are those that take too many rounds.
constexpr uint32_t kLongList = 128;

/// In longer unions the shaders do not look for operands that share the face that is hit: the
/// operand that is drawn first keeps it. In a cell's list longer than kLongList, the last face in
/// file order that starts anything there is shown.
constexpr uint32_t kSharedFaces = 32;

/// A cell whose Blist takes more rounds is refused. Mesa's software renderer silently ends all of a
/// shader's loops after 65,535 rounds in total. Each test takes at least one, and a pixel may need
/// two evaluations.
constexpr uint64_t kMostRounds = 30000;
/// The limit for a tile, over all evaluations that a ray may need.
constexpr uint64_t kMostTileRounds = 60000;

/// A pixel that takes more rounds than this on primitives that are not convex is given up, and the
/// CPU draws it: it leaves enough for the rounds of the others.
constexpr uint32_t kMostNonconvexRounds = 30000;

/// What the shaders write beside a pixel's colour: whether the pixel is right; or whether a piece
/// that it shows may be too thin to exist; or whether it was given up.
constexpr float kMarkSure = 1, kMarkDoubtful = 0, kMarkUnfinished = 0.5;

constexpr unsigned kLocationLow = 0;
constexpr unsigned kLocationHigh = 1;
constexpr unsigned kLocationList = 2;

/// Texels of each primitive in its buffer. The first holds the centre, and in w the first texel of
/// a polyhedron's, mesh's or profile's data. The others hold the rows of world_to_canonical, and in
/// w radius_mid, radius_slope (of an extrusion over the profile's reach) and a kind (its number in
/// csgcore::Shape, or kShapeNone): the enclosure's, or the primitive's own if it is not convex.
constexpr int kPrimitiveTexels = 4;
constexpr float kShapeNone = -1;  // marks a primitive that is too thin to exist

/// Texels of surfaces: red and green; blue with flags beside it; the id. Channels are fixed-point
/// numbers of 16 bits, from 0 to a colour that OpenSCAD's light shows as white in any direction.
constexpr float kBrightestColor = 8;
constexpr uint32_t kSurfaceFlagsShift =
    16;                                 // of the flags: three bits, one for each channel that is
constexpr uint32_t kCutFacesShift = 3;  // the primitive's own; then csgcore::CutFaces
constexpr uint32_t kCutFacesMask = 3;
constexpr uint32_t kFaceColorsFlag = 1 << 5;  // the faces of its mesh have colours that show

struct ShaderConstant {
  std::string_view name;
  double value;
  bool is_integer;
};

inline constexpr std::array kShaderConstants = {
    ShaderConstant{"PATH_SINGLE", double(Path::kSingle), true},
    ShaderConstant{"PATH_UNION", double(Path::kUnion), true},
    ShaderConstant{"PATH_BOTH", double(Path::kBoth), true},
    ShaderConstant{"PATH_MINUS", double(Path::kMinus), true},
    ShaderConstant{"PATH_NEITHER", double(Path::kNeither), true},
    ShaderConstant{"PATH_SHORT_LIST", double(Path::kShortList), true},
    ShaderConstant{"PATH_LIST", double(Path::kList), true},
    ShaderConstant{"LONG_LIST", kLongList, true},
    ShaderConstant{"PATH_BOXES", double(Path::kBoxes), true},
    ShaderConstant{"LOCATION_LOW", kLocationLow, true},
    ShaderConstant{"LOCATION_HIGH", kLocationHigh, true},
    ShaderConstant{"LOCATION_LIST", kLocationList, true},
    ShaderConstant{"PRIMITIVE_TEXELS", kPrimitiveTexels, true},
    ShaderConstant{"SHAPE_NONE", kShapeNone, false},
    ShaderConstant{"BRIGHTEST_COLOR", kBrightestColor, false},
    ShaderConstant{"SURFACE_FLAGS_SHIFT", kSurfaceFlagsShift, true},
    ShaderConstant{"CUT_FACES_SHIFT", kCutFacesShift, true},
    ShaderConstant{"CUT_FACES_MASK", kCutFacesMask, true},
    ShaderConstant{"FACE_COLORS_FLAG", kFaceColorsFlag, true},
    ShaderConstant{"CUT_FACES_BY_TREE", double(csgcore::CutFaces::kByTree), true},
    ShaderConstant{"CUT_FACES_ALWAYS", double(csgcore::CutFaces::kAlways), true},
    ShaderConstant{"SHADING_OPENSCAD", 0, true},
    ShaderConstant{"SHADING_PHONG", 1, true},
    ShaderConstant{"SHADING_STUDIO", 2, true},
    ShaderConstant{"PHONG_AMBIENT", csgcore::kPhongAmbient, false},
    ShaderConstant{"PHONG_DIFFUSE", csgcore::kPhongDiffuse, false},
    ShaderConstant{"PHONG_SPECULAR", csgcore::kPhongSpecular, false},
    ShaderConstant{"PHONG_EXPONENT", csgcore::kPhongExponent, false},
    ShaderConstant{"STUDIO_AMBIENT", csgcore::kStudioAmbient, false},
    ShaderConstant{"STUDIO_KEY", csgcore::kStudioKey, false},
    ShaderConstant{"STUDIO_FILL", csgcore::kStudioFill, false},
    ShaderConstant{"STUDIO_KEY_RIGHT", csgcore::kStudioKeyDirection[0], false},
    ShaderConstant{"STUDIO_KEY_UP", csgcore::kStudioKeyDirection[1], false},
    ShaderConstant{"STUDIO_KEY_NEAR", csgcore::kStudioKeyDirection[2], false},
    ShaderConstant{"STUDIO_FILL_RIGHT", csgcore::kStudioFillDirection[0], false},
    ShaderConstant{"STUDIO_FILL_UP", csgcore::kStudioFillDirection[1], false},
    ShaderConstant{"STUDIO_FILL_NEAR", csgcore::kStudioFillDirection[2], false},
    // A thickness measured in float may lie on the wrong side of the tolerance between these
    // multiples of it. (In one pixel of a thousand, walls of 0.75 tolerances were seen to exist and
    // walls of 1.25 not to.)
    ShaderConstant{"LEAST_DOUBT", 0.5, false},
    ShaderConstant{"MOST_DOUBT", 1.5, false},
    // Pixels by which a cell's box is pushed out: several steps of the coarsest sub-pixel grid that
    // OpenGL allows (1/16 pixel).
    ShaderConstant{"INFLATION_PX", 0.25, false},
    // Below this cosine between ray and normal (0.0035° from the surface) the tolerance along the
    // ray stops growing: the rounding of the normal itself would decide there.
    ShaderConstant{"GRAZING_COSINE", 1.0 / 16384, false},
    ShaderConstant{"EDGE_WIDTH_PX", 0.75, false},
    ShaderConstant{"MOST_NONCONVEX_ROUNDS", kMostNonconvexRounds, true},
    ShaderConstant{"MARK_SURE", kMarkSure, false},
    ShaderConstant{"MARK_DOUBTFUL", kMarkDoubtful, false},
    ShaderConstant{"MARK_UNFINISHED", kMarkUnfinished, false},
    // The sheets of open meshes (csgcore/NUMERICS.md, "Meshes"). They are thick enough to exist
    // without a doubt, and thin enough to end within the overlap of cells (2 tolerances or more).
    ShaderConstant{"SHEET_THICKNESS", 1.75, false},
    ShaderConstant{"SHEET_COSINE", 1.0 / 1024, false},
};

}  // namespace glrender
