// The nodes of a design's tree, and the names of their arguments.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace language {

/// Finds a word's index in a fixed list. The hash combines the length and the first, middle and
/// last letters, by which the words that OpenSCAD writes seldom collide.
template <size_t kCount>
class WordTable {
 public:
  static constexpr uint8_t kNone = 255;
  static_assert(kCount < kNone);

  explicit consteval WordTable(const std::array<std::string_view, kCount>& names) : names_(names) {
    slots_.fill(kNone);
    for (size_t i = 0; i < kCount; ++i) {
      size_t slot = hash(names[i]);
      while (slots_[slot] != kNone) slot = (slot + 1) % kSlots;
      slots_[slot] = static_cast<uint8_t>(i);
    }
  }

  /// Returns the index of `word`, which must not be empty, or kNone.
  constexpr uint8_t find(std::string_view word) const {
    for (size_t slot = hash(word); slots_[slot] != kNone; slot = (slot + 1) % kSlots) {
      if (names_[slots_[slot]] == word) return slots_[slot];
    }
    return kNone;
  }

  constexpr std::string_view operator[](uint8_t index) const { return names_[index]; }
  static constexpr size_t size() { return kCount; }

 private:
  static constexpr size_t kSlots = 256;  // several times the words, so that most have their own

  static constexpr size_t hash(std::string_view word) {
    const auto at = [&](size_t i) { return static_cast<size_t>(static_cast<uint8_t>(word[i])); };
    return (word.size() * 5 + at(0) * 7 + at(word.size() - 1) * 3 + at(word.size() / 2) * 11) %
           kSlots;
  }

  std::array<std::string_view, kCount> names_;
  std::array<uint8_t, kSlots> slots_{};
};

template <size_t kCount>
WordTable(const std::array<std::string_view, kCount>&) -> WordTable<kCount>;

/// The modifiers of a module call, which its node keeps, as bits. What has `*` is dropped by the
/// parser.
enum CallModifier : uint8_t {
  kRootModifier = 1,        // !
  kHighlightModifier = 2,   // #
  kBackgroundModifier = 4,  // %
};

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
