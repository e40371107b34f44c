// The outcome of set operations on solids, as solids whose union it is.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "csgcore/triangle_set.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

class SolidUnion {
 public:
  /// What is round, and takes part in a difference or an intersection, has as many chords as
  /// OpenSCAD gives it, but at least so many.
  explicit SolidUnion(SolidPool& pool, int least_chords = kChordsOfCutDisc)
      : pool_(pool), least_chords_(least_chords) {}

  /// Returns parts whose union is the value, or nothing if failure() is not empty. What no
  /// difference or intersection takes part in stays what it is. The others are convex bodies of
  /// points, or closed meshes.
  std::vector<SolidPart> parts_of(const SolidValue& value);
  std::string_view failure() const { return failure_; }

 private:
  std::vector<SolidPart> outcome(const SolidValue& value);
  csgcore::TriangleSet triangles_of(const SolidPart& part, bool& is_smooth);
  void fail(std::string_view why);

  SolidPool& pool_;
  int least_chords_;
  std::string_view failure_;
  size_t triangles_ = 0;  // of all operands so far
};

/// Returns the part that the closed surface bounds: a convex body if it is convex.
SolidPart part_of(csgcore::TriangleSet surface, bool is_smooth);

}  // namespace frontend
