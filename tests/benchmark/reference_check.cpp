#include "reference_check.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "support/reference.hpp"

namespace frame_benchmark {
namespace {

using csgcore::Hits;

/// Returns pixels that show something, and seeded ones of any kind: most wrong pixels of a wrong
/// answer are hits, but all of them may be missing.
std::vector<size_t> sampled_pixels(const Hits& hits) {
  constexpr size_t kHits = 80;
  constexpr size_t kAny = 40;
  std::vector<size_t> seen;
  for (size_t i = 0; i < hits.primitive.size(); ++i) {
    if (hits.primitive[i] != Hits::kMiss) seen.push_back(i);
  }
  std::mt19937 random(1);
  std::vector<size_t> sample;
  for (size_t i = 0; i < kHits && !seen.empty(); ++i) {
    sample.push_back(seen[random() % seen.size()]);
  }
  for (size_t i = 0; i < kAny; ++i) sample.push_back(random() % hits.primitive.size());
  return sample;
}

}  // namespace

bool agrees_with_reference(const csgcore::Scene& scene, const csgcore::View& view,
                           const Hits& hits) {
  const csgcore::Reference reference(scene, view);
  const double far = csgcore::kReferencePositionError * reference.model_size();
  for (const size_t pixel : sampled_pixels(hits)) {
    const uint32_t x = static_cast<uint32_t>(pixel % hits.width_px);
    const uint32_t y = static_cast<uint32_t>(pixel / hits.width_px);
    const csgcore::ReferenceHit expected = reference.at(x, y);
    const bool same = hits.primitive[pixel] == expected.primitive &&
                      (!expected.hit() || std::abs(hits.s[pixel] - double(expected.s)) <= far);
    if (!same && !reference.undecided(x, y)) return false;
  }
  return true;
}

}  // namespace frame_benchmark
