#include "picture_check.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace bench {
namespace {

/// At most one in this many hits may lie so near to an edge that float shows the other side of it;
/// in a small picture kEdgePixels may (tests/glrender/cpu_agreement_test.cpp).
constexpr uint64_t kHitsPerEdgePixel = 2000;
constexpr uint64_t kEdgePixels = 4;
/// Unit normals further apart belong to different faces.
constexpr float kFaceDistance = 0.05f;

}  // namespace

uint64_t wrong_pixels(const csgcore::Image& image, const csgcore::Image& exact) {
  uint64_t wrong = 0;
  for (size_t i = 0; i < exact.id.size(); ++i) {
    wrong += image.id[i] != exact.id[i] ||
             glm::distance(image.normal[i], exact.normal[i]) > kFaceDistance;
  }
  return wrong;
}

bool is_same(const csgcore::Image& a, const csgcore::Image& b) {
  return a.rgb == b.rgb && a.id == b.id && a.z == b.z && a.normal == b.normal &&
         a.position == b.position;
}

bool float_explains(uint64_t wrong_pixels, uint64_t hits) {
  return wrong_pixels <= std::max(kEdgePixels, hits / kHitsPerEdgePixel);
}

}  // namespace bench
