// Convex polyhedra as the shaders read them (polyhedron.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "csgcore/polyhedron.hpp"

namespace glrender {

/// The faces of several polyhedra, one polyhedron after the other. Each starts with a texel that
/// holds the number of texels that follow. Then come its entries (csgcore/polyhedron.hpp) in their
/// order, in canonical space. A face is its normal and 0. A branch is its normal and the number of
/// texels to skip after it, with its limit in a texel of its own. Texel 0 stands for a primitive
/// without faces.
class PolyhedronTexels {
 public:
  using Texel = std::array<float, 4>;
  /// The shaders read texel numbers as floats, which hold integers up to 2^24 exactly.
  static constexpr size_t kMostTexels = size_t{1} << 24;

  explicit PolyhedronTexels(size_t most_texels = kMostTexels) : most_texels_(most_texels) {}

  /// Returns the polyhedron's first texel; 0 if it is null. Adds a polyhedron that is not there
  /// yet, which must live as long as this object. Throws GlError if there would be too many texels.
  uint32_t first_of(const csgcore::Polyhedron* polyhedron);

  const std::vector<Texel>& texels() const { return texels_; }
  bool empty() const { return first_.empty(); }

 private:
  size_t most_texels_;
  std::vector<Texel> texels_{Texel{}};
  std::unordered_map<const csgcore::Polyhedron*, uint32_t> first_;
};

/// Estimates how many loop rounds the shaders take to cut a segment by the polyhedron's faces; 0 if
/// it is null.
uint64_t face_rounds(const csgcore::Polyhedron* polyhedron);

}  // namespace glrender
