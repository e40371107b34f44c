// Convex polyhedra as the shaders read them (polyhedron.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "csgcore/polyhedron.hpp"

namespace glrender {

/// The faces of different polyhedra, one after the other. Of each: the number of texels that
/// follow; then its entries (csgcore/polyhedron.hpp) in their order, in canonical space. A face is
/// its normal and 0; a branch is its normal and the number of texels after it to pass over, with
/// its limit in a texel of its own. Texel 0 is of what has no faces.
class PolyhedronTexels {
 public:
  using Texel = std::array<float, 4>;
  /// The shaders have the numbers of texels as floats.
  static constexpr size_t kMostTexels = size_t{1} << 24;

  explicit PolyhedronTexels(size_t most_texels = kMostTexels) : most_texels_(most_texels) {}

  /// The polyhedron's first texel, which is 0 if it is null; adds one that is not yet there, which
  /// must live as long as this. Throws GlError if there would be too many texels.
  uint32_t first_of(const csgcore::Polyhedron* polyhedron);

  const std::vector<Texel>& texels() const { return texels_; }
  bool empty() const { return first_.empty(); }

 private:
  size_t most_texels_;
  std::vector<Texel> texels_{Texel{}};
  std::unordered_map<const csgcore::Polyhedron*, uint32_t> first_;
};

/// Rounds of a loop in which the shaders cut a segment by the polyhedron's faces, about; 0 if it is
/// null.
uint64_t face_rounds(const csgcore::Polyhedron* polyhedron);

}  // namespace glrender
