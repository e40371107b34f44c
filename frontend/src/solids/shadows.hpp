// Shadows of solids along z, as OpenSCAD's projection() makes them.
#pragma once

#include <optional>
#include <string_view>

#include "solids/operations.hpp"
#include "solids/solid_pool.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

/// Finds the shadow that a solid casts on the plane z = 0.
class Shadows {
 public:
  explicit Shadows(SolidPool& pool) : pool_(pool) {}

  /// Returns the shadow; nothing if it cannot be found: failure() says why. The shadow of a union
  /// is that of its operands. Of differences and intersections it is exact where all their operands
  /// stand upright between two heights.
  std::optional<Operations<Figure>> of(const SolidValue& value);
  std::string_view failure() const { return failure_; }

 private:
  Operations<Figure> of_operation(const SolidValue& value);
  Operations<Figure> of_part(const SolidPart& part);
  void fail(std::string_view why);

  SolidPool& pool_;
  std::string_view failure_;
};

}  // namespace frontend
