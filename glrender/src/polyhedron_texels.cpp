#include "polyhedron_texels.hpp"

#include <algorithm>

#include "glrender/context.hpp"

namespace glrender {
namespace {

using csgcore::Polyhedron;

/// Bound on the rounding error of a point's height in canonical space, computed in float as a sum
/// of products of at most 2. A branch's faces are skipped only if they are further away than that.
constexpr double kBranchSlack = 0x1p-19;

PolyhedronTexels::Texel texel(const csgcore::Vec3& normal, uint32_t skip) {
  return {static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z),
          static_cast<float>(skip)};
}

}  // namespace

uint32_t PolyhedronTexels::first_of(const Polyhedron* polyhedron) {
  if (!polyhedron) return 0;
  const auto [place, is_new] =
      first_.try_emplace(polyhedron, static_cast<uint32_t>(texels_.size()));
  if (!is_new) return place->second;
  const std::vector<Polyhedron::Entry>& entries = polyhedron->entries();
  // start[i] is the offset of entry i after the polyhedron's header.
  std::vector<uint32_t> start{0};
  for (const Polyhedron::Entry& entry : entries) {
    start.push_back(start.back() + (entry.skip > 0 ? 2 : 1));
  }
  if (texels_.size() + start.back() >= most_texels_) {
    throw GlError("the polyhedra have more faces than OpenGL can number (use a smaller $fn)");
  }
  texels_.push_back({static_cast<float>(start.back())});
  for (size_t i = 0; i < entries.size(); ++i) {
    const Polyhedron::Entry& entry = entries[i];
    texels_.push_back(texel(entry.normal, start[i + 1 + entry.skip] - start[i + 1]));
    if (entry.skip > 0) {
      texels_.push_back({static_cast<float>(entry.limit - kBranchSlack)});
    }
  }
  return place->second;
}

uint64_t face_rounds(const Polyhedron* polyhedron) {
  /// The measured rounds of a polyhedron with thousands of faces; they grow little with the faces.
  constexpr size_t kOfManyFaces = 256;
  return polyhedron ? std::min(polyhedron->entries().size(), kOfManyFaces) : 0;
}

}  // namespace glrender
