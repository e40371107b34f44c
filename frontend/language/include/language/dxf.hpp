// Drawings in DXF, as OpenSCAD 2021.01 reads them: pairs of lines, a group code and its value. They
// have no units.
// - The sections ENTITIES and BLOCKS count, and there LINE, LWPOLYLINE (flag 1 closes it; bulges do
//   not count), CIRCLE, ARC, ELLIPSE and INSERT (factors 41 and 42, angle 50; a block's base point
//   does not count). Others are named in a message, but for DIMENSION.
// - A value v becomes (v − origin) · scale; a scale that is not positive is 1. So does an ellipse's
//   axis, and its ratio is multiplied by scale. What stands in blocks is moved and scaled where it
//   is inserted.
// - layer is exact; an empty one is all of them. Of what is inserted only the INSERT's layer
//   counts.
// - Ends lie on a grid of 1/1024. One beside a cell that an end lies in already takes that end's
//   place.
// - Lines are joined end to end, each with the first one of the file that goes on. First come the
//   chains with an open end, which a straight line closes. Then come all others, which OpenSCAD
//   takes for closed: one that is not loses its first end, or its last one if it runs
//   counterclockwise at its leftmost point. All together are filled by the even-odd rule.
// - An entity that lacks points is given those of the next ones, and a number that cannot be read
//   is left out. At a group code that is no number the reading ends. Messages show words of the
//   file; scadray's do not before its first SECTION, since a file that is no DXF may be anybody's.
//   The last entity counts only if another group 0 follows.
// - With facets, a circle has the chords of its scaled radius from +x on, and an arc its share of
//   them, rounded up.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace language {

struct DxfPoint {
  double x = 0, y = 0;
};

/// A part of an ellipse: center + cos(t)·u + sin(t)·v, with t from `start` by `sweep`, in radians.
struct DxfArc {
  DxfPoint center{}, u{}, v{};
  double start = 0, sweep = 0;

  DxfPoint point(double t) const;
};

/// A line, or a curve whose ends are those of its arc.
struct DxfStroke {
  DxfPoint start{}, end{};
  bool is_arc = false;
  DxfArc arc{};
  int chords = 1;  // OpenSCAD's
};

/// A dimension; what its groups do not tell is 0.
struct DxfDimension {
  std::string name;  // group 1
  std::string layer;
  int type = 0;                      // 70
  double angle_deg = 0;              // 50
  std::array<DxfPoint, 7> points{};  // 10 to 16 and 20 to 26
};

struct DxfProblem {
  enum class Kind : uint8_t {
    kIllegalCode,     // `word` is no group code: what follows is not read
    kIllegalValue,    // `word` is no number: it is left out
    kMissingPoints,   // the entity before the one named `word` lacks points
    kTooManyStrokes,  // blocks within blocks make more strokes than may be
    kUnsupported,     // `count` entities named `word` are left out
  };
  Kind kind;
  std::string_view word;
  uint64_t count = 1;
};

struct DxfSettings {
  std::string layer{};  // whose contents are wanted; empty: those of all layers
  DxfPoint origin{};
  double scale = 1;
  std::function<int(double radius)> fragments;  // OpenSCAD's, of a circle
  std::function<void(const DxfProblem& problem)> tell;
};

struct DxfContents {
  std::vector<DxfStroke> strokes;        // blocks that are inserted among them
  std::vector<DxfDimension> dimensions;  // of all sections
};

/// Blocks that insert blocks may make any number of strokes: the file's length does not bound them.
constexpr size_t kMostDxfStrokes = 1 << 21;

/// Reads the bytes of a file. `tell` is called for each problem, in OpenSCAD's order.
DxfContents read_dxf(std::string_view text, const DxfSettings& settings);

}  // namespace language
