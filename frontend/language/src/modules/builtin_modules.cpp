#include "modules/builtin_modules.hpp"

#include <algorithm>
#include <array>

namespace language {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view kSizeCenter[] = {"size", "center"};
constexpr std::string_view kR[] = {"r"};
constexpr std::string_view kD[] = {"d"};
constexpr std::string_view kCylinder[] = {"h", "r1", "r2", "center"};
constexpr std::string_view kCylinderNamed[] = {"r", "d", "d1", "d2"};
constexpr std::string_view kPolyhedron[] = {"points", "faces", "convexity"};
constexpr std::string_view kTriangles[] = {"triangles"};
constexpr std::string_view kPolygon[] = {"points", "paths", "convexity"};
constexpr std::string_view kText[] = {"text", "size", "font"};
constexpr std::string_view kTextNamed[] = {"direction", "language", "script",
                                           "halign",    "valign",   "spacing"};
constexpr std::string_view kV[] = {"v"};
constexpr std::string_view kRotate[] = {"a", "v"};
constexpr std::string_view kM[] = {"m"};
constexpr std::string_view kColor[] = {"c", "alpha"};
constexpr std::string_view kLinearExtrude[] = {"file",  "layer",  "height", "origin",
                                               "scale", "center", "twist",  "slices"};
constexpr std::string_view kRotateExtrude[] = {"file", "layer", "origin", "scale"};
constexpr std::string_view kRotateExtrudeNamed[] = {"convexity", "angle"};
constexpr std::string_view kCut[] = {"cut"};
constexpr std::string_view kOnlyConvexity[] = {"convexity"};
constexpr std::string_view kOffsetNamed[] = {"delta", "chamfer"};
constexpr std::string_view kResize[] = {"newsize", "auto", "convexity"};
constexpr std::string_view kImport[] = {"file", "layer", "convexity", "origin", "scale"};
constexpr std::string_view kImportNamed[] = {"width",     "height", "filename",
                                             "layername", "center", "dpi"};
constexpr std::string_view kSurface[] = {"file", "center", "convexity"};
constexpr std::string_view kInvert[] = {"invert"};

constexpr auto kTakes = ChildRule::kTakes;
constexpr auto kRefuses = ChildRule::kRefuses;
constexpr auto kIgnores = ChildRule::kIgnores;

constexpr BuiltinModule kModules[] = {
    {"circle", kR, kD, kRefuses, make_circle},
    {"color", kColor, {}, kTakes, make_color},
    {"cube", kSizeCenter, {}, kRefuses, make_cube},
    {"cylinder", kCylinder, kCylinderNamed, kRefuses, make_cylinder},
    {"dxf_linear_extrude", kLinearExtrude, kOnlyConvexity, kTakes, make_linear_extrude,
     "linear_extrude()", wants_height},
    {"dxf_rotate_extrude", kRotateExtrude, kRotateExtrudeNamed, kTakes, make_rotate_extrude,
     "rotate_extrude()"},
    {"hull", {}, {}, kTakes, make_hull},
    {"import", kImport, kImportNamed, kIgnores, make_import},
    {"import_dxf", kImport, kImportNamed, kIgnores, make_typed_import, "import()"},
    {"import_off", kImport, kImportNamed, kIgnores, make_typed_import, "import()"},
    {"import_stl", kImport, kImportNamed, kIgnores, make_typed_import, "import()"},
    {"linear_extrude",
     kLinearExtrude,
     kOnlyConvexity,
     kTakes,
     make_linear_extrude,
     {},
     wants_height},
    {"minkowski", kOnlyConvexity, {}, kTakes, make_minkowski},
    {"mirror", kV, {}, kTakes, make_mirror},
    {"multmatrix", kM, {}, kTakes, make_multmatrix},
    {"offset", kR, kOffsetNamed, kTakes, make_offset},
    {"polygon", kPolygon, {}, kRefuses, make_polygon},
    {"polyhedron", kPolyhedron, kTriangles, kRefuses, make_polyhedron},
    {"projection", kCut, kOnlyConvexity, kTakes, make_projection},
    {"render", kOnlyConvexity, {}, kTakes, make_render},
    {"resize", kResize, {}, kTakes, make_resize},
    {"rotate", kRotate, {}, kTakes, make_rotate},
    {"rotate_extrude", kRotateExtrude, kRotateExtrudeNamed, kTakes, make_rotate_extrude},
    {"scale", kV, {}, kTakes, make_scale},
    {"sphere", kR, kD, kRefuses, make_sphere},
    {"square", kSizeCenter, {}, kRefuses, make_square},
    {"surface", kSurface, kInvert, kIgnores, make_surface},
    {"text", kText, kTextNamed, kIgnores, make_text},
    {"translate", kV, {}, kTakes, make_translate},
};
static_assert(std::ranges::is_sorted(kModules, {}, &BuiltinModule::name));

}  // namespace

std::span<const BuiltinModule> builtin_modules() { return kModules; }

}  // namespace language
