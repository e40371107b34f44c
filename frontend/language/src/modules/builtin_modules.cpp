#include "modules/builtin_modules.hpp"

#include <algorithm>
#include <array>

#include "functions/text_parameters.hpp"

namespace language {
namespace {

using Names = std::span<const std::string_view>;

constexpr std::string_view kSizeCenter[] = {"size", "center"};
constexpr std::string_view kOnlyR[] = {"r"};
constexpr std::string_view kOnlyD[] = {"d"};
constexpr std::string_view kCylinder[] = {"h", "r1", "r2", "center"};
constexpr std::string_view kCylinderNamed[] = {"r", "d", "d1", "d2"};
constexpr std::string_view kPolyhedron[] = {"points", "faces", "convexity"};
constexpr std::string_view kOnlyTriangles[] = {"triangles"};
constexpr std::string_view kPolygon[] = {"points", "paths", "convexity"};
constexpr size_t kPositionalOfText = 3;
constexpr Names kText = Names(kTextParameters).first(kPositionalOfText);
constexpr Names kTextNamed =
    Names(kTextParameters).first(kOldTextParameters).subspan(kPositionalOfText);
constexpr Names kNewTextNamed = Names(kTextParameters).subspan(kPositionalOfText);
constexpr std::string_view kOnlyV[] = {"v"};
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
constexpr std::string_view kOnlyInvert[] = {"invert"};

constexpr auto kTakes = ChildRule::kTakes;
constexpr auto kRefuses = ChildRule::kRefuses;
constexpr auto kIgnores = ChildRule::kIgnores;

constexpr BuiltinModule kModules[] = {
    {"circle", kOnlyR, kOnlyD, kRefuses, make_circle},
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
    {"mirror", kOnlyV, {}, kTakes, make_mirror},
    {"multmatrix", kM, {}, kTakes, make_multmatrix},
    {"offset", kOnlyR, kOffsetNamed, kTakes, make_offset},
    {"polygon", kPolygon, {}, kRefuses, make_polygon},
    {"polyhedron", kPolyhedron, kOnlyTriangles, kRefuses, make_polyhedron},
    {"projection", kCut, kOnlyConvexity, kTakes, make_projection},
    {"render", kOnlyConvexity, {}, kTakes, make_render},
    {"resize", kResize, {}, kTakes, make_resize},
    {"rotate", kRotate, {}, kTakes, make_rotate},
    {"rotate_extrude", kRotateExtrude, kRotateExtrudeNamed, kTakes, make_rotate_extrude},
    {"scale", kOnlyV, {}, kTakes, make_scale},
    {"sphere", kOnlyR, kOnlyD, kRefuses, make_sphere},
    {"square", kSizeCenter, {}, kRefuses, make_square},
    {"surface", kSurface, kOnlyInvert, kIgnores, make_surface},
    {"text", kText, kTextNamed, kIgnores, make_text},
    {"translate", kOnlyV, {}, kTakes, make_translate},
};
static_assert(std::ranges::is_sorted(kModules, {}, &BuiltinModule::name));

constexpr std::string_view kNewLinearExtrude[] = {"height", "v",      "scale",   "center",
                                                  "twist",  "slices", "segments"};
constexpr std::string_view kNewLinearExtrudeNamed[] = {"convexity", "h"};
constexpr std::string_view kNewRotateExtrude[] = {"angle", "start", "convexity"};
constexpr std::string_view kNewRotateExtrudeNamed[] = {"a"};
constexpr std::string_view kNewImportNamed[] = {"width",  "height", "filename", "layername",
                                                "center", "dpi",    "id"};
constexpr std::string_view kRoof[] = {"method", "convexity"};

/// In place of the rows of these names, or beside them.
constexpr BuiltinModule kModulesOf2026[] = {
    {"fill", {}, {}, kTakes, make_fill},
    {"import", kImport, kNewImportNamed, kRefuses, make_import_2026},
    {"linear_extrude", kNewLinearExtrude, kNewLinearExtrudeNamed, kTakes, make_linear_extrude_2026},
    {"polygon", kPolygon, {}, kRefuses, make_polygon_2026},
    {"polyhedron", kPolyhedron, kOnlyTriangles, kRefuses, make_polyhedron_2026},
    {"roof", kRoof, {}, kTakes, make_roof},
    {"rotate_extrude", kNewRotateExtrude, kNewRotateExtrudeNamed, kTakes, make_rotate_extrude_2026},
    {"surface", kSurface, kOnlyInvert, kRefuses, make_surface},
    {"text", kText, kNewTextNamed, kRefuses, make_text_2026},
};

std::vector<BuiltinModule> modules_of_2026() {
  std::vector<BuiltinModule> modules(std::begin(kModulesOf2026), std::end(kModulesOf2026));
  for (const BuiltinModule& module : kModules) {
    if (std::ranges::find(kModulesOf2026, module.name, &BuiltinModule::name) ==
        std::end(kModulesOf2026))
      modules.push_back(module);
  }
  std::ranges::sort(modules, {}, &BuiltinModule::name);
  return modules;
}

}  // namespace

std::span<const BuiltinModule> builtin_modules(LanguageVersion version) {
  static const std::vector<BuiltinModule> of_2026 = modules_of_2026();
  if (version == LanguageVersion::k2026) return of_2026;
  return kModules;
}

}  // namespace language
