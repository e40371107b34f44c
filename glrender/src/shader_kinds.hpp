// Composes the shaders' code for the kinds of primitives.
#pragma once

#include <compare>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "csgcore/shape.hpp"

namespace glrender {

/// A set of kinds of primitives, for which a shader is compiled.
class KindSet {
 public:
  constexpr KindSet() = default;
  constexpr KindSet(std::initializer_list<csgcore::Shape> kinds) {
    for (const csgcore::Shape kind : kinds) add(kind);
  }

  constexpr void add(csgcore::Shape kind) { bits_ |= bit(kind); }
  constexpr bool has(csgcore::Shape kind) const { return (bits_ & bit(kind)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }

  auto operator<=>(const KindSet&) const = default;

 private:
  static constexpr uint32_t bit(csgcore::Shape kind) { return uint32_t{1} << int(kind); }

  uint32_t bits_ = 0;
};

/// Returns GLSL that defines the functions that ray.glsl declares: the files of the given kinds
/// alone (shaders/sphere.glsl and so on), and code that calls their functions by a primitive's
/// kind.
///
/// `enclosures` are the kinds of the convex primitives' enclosures, each of which has a segment of
/// its own. `cuts` are the kinds of the primitives whose enclosure is of another kind, which cut
/// its segment. `nonconvex` are the kinds of primitives that are not convex.
std::string kinds_source(KindSet enclosures, KindSet cuts, KindSet nonconvex);

}  // namespace glrender
