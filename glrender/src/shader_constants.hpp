// The constants that C++ and the shaders share; every shader is compiled with a #define of each.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "csgcore/blist.hpp"
#include "csgcore/phong.hpp"
#include "csgcore/primitive.hpp"

namespace glrender {

/// How a cell's primitives are combined: one draw call for all cells of a path.
enum class Path : int {
  kSingle,     // a primitive or its complement; unions by the depth buffer (paper §3.2, §3.3.3)
  kUnion,      // the same, of a union whose later operands may have the same face
  kBoth,       // §3.3.4 case 1
  kMinus,      // cases 2 and 3
  kNeither,    // case 4
  kShortList,  // any function of up to short_list() primitives
  kLongList,   // the same of up to kLongList primitives, in tiles
  kList,       // any function
  kBoxes,      // the cells themselves
};
constexpr int kPaths = 9;

/// Up to so many primitives a fragment keeps all segments: in cells the default K. Segments
/// that are cut by faces take a hundred rounds of a loop each (see kMostRounds): it rather keeps
/// them than finds them again; in tiles, all.
constexpr uint32_t short_list(bool has_cuts, bool tiles) { return has_cuts || tiles ? 32 : 8; }
/// Longer lists of a tile are refused, as are those of too many rounds.
constexpr uint32_t kLongList = 128;

/// In longer unions the operands are not asked whether they share the face that is hit, and the one
/// that is drawn first keeps it. Of a cell's list beyond kLongList, the last face in file order
/// that starts anything there is shown.
constexpr uint32_t kSharedFaces = 32;

/// A cell whose function takes more rounds is refused: Mesa's software renderer ends all of a
/// shader's loops silently after 65,535 rounds of them together, each at least one test, and a
/// pixel may need two evaluations.
constexpr uint64_t kMostRounds = 30000;
/// The same of a tile, for all evaluations that a ray may need.
constexpr uint64_t kMostTileRounds = 60000;

constexpr unsigned kLocationLow = 0;
constexpr unsigned kLocationHigh = 1;
constexpr unsigned kLocationList = 2;

/// Texels of the primitive buffer: centre, with the first texel of a polyhedron's faces beside it;
/// three rows of world_to_canonical, with radius_mid, radius_slope and the enclosure's kind beside
/// them, as its number in csgcore::Shape, or kShapeNone.
constexpr int kPrimitiveTexels = 4;
constexpr float kShapeNone = -1;  // of what is too thin to exist

/// Texels of surfaces: red and green; blue with flags beside it; the id. Channels are fixed-point
/// numbers of 16 bits, from 0 to a colour that OpenSCAD's light shows as white in any direction.
constexpr float kBrightestColor = 8;
constexpr uint32_t kSurfaceFlagsShift =
    16;                                 // of the flags: three bits, one for each channel that is
constexpr uint32_t kCutFacesShift = 3;  // the primitive's own; then csgcore::CutFaces

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
    ShaderConstant{"CUT_FACES_BY_TREE", double(csgcore::CutFaces::kByTree), true},
    ShaderConstant{"CUT_FACES_ALWAYS", double(csgcore::CutFaces::kAlways), true},
    ShaderConstant{"SHADING_OPENSCAD", 0, true},
    ShaderConstant{"SHADING_PHONG", 1, true},
    ShaderConstant{"PHONG_AMBIENT", csgcore::kPhongAmbient, false},
    ShaderConstant{"PHONG_DIFFUSE", csgcore::kPhongDiffuse, false},
    ShaderConstant{"PHONG_SPECULAR", csgcore::kPhongSpecular, false},
    ShaderConstant{"PHONG_EXPONENT", csgcore::kPhongExponent, false},
    // Shares of the tolerance between which a measured thickness may be wrong about it. (Walls of
    // 0.75 tolerances were seen to exist, walls of 1.25 not to, in one pixel of a thousand.)
    ShaderConstant{"LEAST_DOUBT", 0.5, false},
    ShaderConstant{"MOST_DOUBT", 1.5, false},
    // A pixel's share that a cell's outline is pushed out: several steps of the coarsest sub-pixel
    // grid that OpenGL allows (1/16 pixel).
    ShaderConstant{"INFLATION_PX", 0.25, false},
    // Below this cosine between ray and surface (0.0035°) the tolerance along the ray stops
    // growing: what is so flat is as thin as an edge, and its normal's own rounding would decide.
    ShaderConstant{"GRAZING_COSINE", 1.0 / 16384, false},
    ShaderConstant{"EDGE_WIDTH_PX", 0.75, false},
};

}  // namespace glrender
