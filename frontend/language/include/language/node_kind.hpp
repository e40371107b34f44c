// The nodes of a design's tree, and the names of their arguments.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "language/word_table.hpp"

namespace language {

/// All nodes that OpenSCAD can write.
enum class NodeKind : uint8_t {
  kSphere,
  kCylinder,
  kCube,
  kPolyhedron,  // 3D primitives
  kCircle,
  kSquare,
  kPolygon,
  kText,  // 2D primitives
  kMultmatrix,
  kColor,
  kGroup,
  kRender,
  kUnion,
  kDifference,
  kIntersection,
  kHull,
  kFill,
  kMinkowski,
  kProjection,
  kOffset,
  kResize,
  kLinearExtrude,
  kRotateExtrude,
  kImport,
  kSurface,
  kRoof,
};

/// The names as they are spelled in a .csg, in NodeKind's order.
inline constexpr WordTable kNodeNames(std::to_array<std::string_view>({
    "sphere",     "cylinder",   "cube",         "polyhedron",     "circle",         "square",
    "polygon",    "text",       "multmatrix",   "color",          "group",          "render",
    "union",      "difference", "intersection", "hull",           "fill",           "minkowski",
    "projection", "offset",     "resize",       "linear_extrude", "rotate_extrude", "import",
    "surface",    "roof",
}));
static_assert(decltype(kNodeNames)::size() == static_cast<size_t>(NodeKind::kRoof) + 1);

/// Returns the name as it is spelled in a .csg ("sphere").
constexpr std::string_view name_of(NodeKind kind) { return kNodeNames[static_cast<uint8_t>(kind)]; }

/// All argument names that OpenSCAD writes or that a primitive takes.
inline constexpr WordTable kArgumentNames(std::to_array<std::string_view>({
    "$fn",       "$fa",       "$fs",      "$fe",    "r",        "r1",      "r2",     "d",
    "d1",        "d2",        "h",        "center", "size",     "points",  "faces",  "triangles",
    "paths",     "convexity", "cut",      "delta",  "chamfer",  "newsize", "auto",   "height",
    "twist",     "slices",    "scale",    "v",      "segments", "file",    "layer",  "origin",
    "timestamp", "angle",     "start",    "dpi",    "id",       "invert",  "text",   "spacing",
    "font",      "direction", "language", "script", "halign",   "valign",  "method", "m",
    "c",         "alpha",     "radius",
}));

/// The name of a node's argument: one of kArgumentNames, another one, or none. A literal becomes
/// one while it is compiled, so that names are compared as numbers.
class ArgumentName {
 public:
  constexpr ArgumentName() = default;
  consteval ArgumentName(const char* name) : number_(number_of(name)) {
    if (number_ == kUnknown) throw "not among kArgumentNames";
  }
  /// Returns the name for a word that stands before a '='.
  static constexpr ArgumentName named(std::string_view word) {
    ArgumentName name;
    name.number_ = number_of(word);
    return name;
  }

  /// Whether the argument has no name, but a place.
  constexpr bool is_positional() const { return number_ == kNone; }
  /// Returns the name; nothing of one that no node takes.
  constexpr std::string_view text() const {
    return number_ < kUnknown ? kArgumentNames[number_] : std::string_view();
  }
  constexpr bool operator==(const ArgumentName&) const = default;

 private:
  static constexpr uint8_t kUnknown = kArgumentNames.kNone - 1, kNone = kUnknown + 1;
  static_assert(decltype(kArgumentNames)::size() < kUnknown);

  static constexpr uint8_t number_of(std::string_view word) {
    if (word.empty()) return kNone;
    const uint8_t found = kArgumentNames.find(word);
    return found == kArgumentNames.kNone ? kUnknown : found;
  }

  uint8_t number_ = kNone;
};

}  // namespace language
