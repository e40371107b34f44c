#include "arrangement/facet_pairs.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

/// A box in single precision, rounded outwards.
struct FacetBox {
  std::array<float, 3> min;
  std::array<float, 3> max;

  bool meets(const FacetBox& other) const {
    for (size_t i = 0; i < 3; ++i) {
      if (min[i] > other.max[i] || max[i] < other.min[i]) return false;
    }
    return true;
  }
};

float rounded_down(int64_t x) {
  const auto result = static_cast<float>(x);
  constexpr float kLowest = -std::numeric_limits<float>::infinity();
  return static_cast<double>(result) > static_cast<double>(x) ? std::nextafter(result, kLowest)
                                                              : result;
}

FacetBox box_of(const std::array<GridPoint, 3>& corners) {
  FacetBox box;
  for (size_t i = 0; i < 3; ++i) {
    const auto [least, most] = std::minmax({corners[0][i], corners[1][i], corners[2][i]});
    box.min[i] = rounded_down(least);
    box.max[i] = -rounded_down(-most);
  }
  return box;
}

class PairSearch {
 public:
  PairSearch(const Facets& facets, const std::vector<bool>& may_cross_itself)
      : facets_(facets), may_cross_itself_(may_cross_itself), boxes_(facets.facets.size()) {
    tbb::parallel_for(size_t{0}, boxes_.size(), [&](size_t i) {
      boxes_[i] = box_of(facets_.corners(static_cast<uint32_t>(i)));
    });
  }

  FacetPairs run() {
    std::vector<uint32_t> all(boxes_.size());
    std::iota(all.begin(), all.end(), 0u);
    search(std::move(all), 0);
    FacetPairs result;
    for (Found& found : found_) {
      result.pairs.insert(result.pairs.end(), found.pairs.begin(), found.pairs.end());
      std::ranges::move(found.alone, std::back_inserter(result.alone));
    }
    tbb::parallel_sort(result.pairs.begin(), result.pairs.end());
    result.pairs.erase(std::unique(result.pairs.begin(), result.pairs.end()), result.pairs.end());
    return result;
  }

 private:
  using Found = FacetPairs;

  bool is_alone(const std::vector<uint32_t>& list) const {
    const uint32_t operand = facets_.facets[list.front()].operand;
    return !may_cross_itself_[operand] && std::ranges::all_of(list, [&](uint32_t facet) {
      return facets_.facets[facet].operand == operand;
    });
  }

  void search(std::vector<uint32_t> list, int depth) {
    if (list.empty()) return;
    stop_point();
    if (is_alone(list)) {
      found_.local().alone.push_back(std::move(list));
      return;
    }
    constexpr size_t kFew = 24;
    constexpr int kDeepest = 60;
    std::vector<uint32_t> low;
    std::vector<uint32_t> high;
    if (list.size() <= kFew || depth == kDeepest || !split(list, low, high)) {
      add_pairs(list);
      return;
    }
    list = {};
    constexpr size_t kManyAtOnce = 4096;
    if (low.size() + high.size() < kManyAtOnce) {
      search(std::move(low), depth + 1);
      search(std::move(high), depth + 1);
      return;
    }
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_invoke(
        [&] {
          const StopScope scope(stop);
          search(std::move(low), depth + 1);
        },
        [&] {
          const StopScope scope(stop);
          search(std::move(high), depth + 1);
        });
  }

  /// Divides the facets by a plane into those below and those above; facets that reach both sides
  /// go to both. Returns whether that leaves enough fewer facets in each of them.
  bool split(const std::vector<uint32_t>& list, std::vector<uint32_t>& low,
             std::vector<uint32_t>& high) const {
    std::array<float, 3> least;
    std::array<float, 3> most;
    least.fill(std::numeric_limits<float>::infinity());
    most.fill(-std::numeric_limits<float>::infinity());
    constexpr size_t kSamples = 64;
    const size_t step = std::max<size_t>(list.size() / kSamples, 1);
    std::array<std::vector<float>, 3> centers;
    for (size_t i = 0; i < list.size(); i += step) {
      const FacetBox& box = boxes_[list[i]];
      for (size_t axis = 0; axis < 3; ++axis) {
        const float center = (box.min[axis] + box.max[axis]) / 2;
        centers[axis].push_back(center);
        least[axis] = std::min(least[axis], center);
        most[axis] = std::max(most[axis], center);
      }
    }
    std::array<size_t, 3> axes{0, 1, 2};
    std::ranges::sort(axes, std::greater(), [&](size_t axis) { return most[axis] - least[axis]; });
    for (const size_t axis : axes) {
      std::vector<float>& values = centers[axis];
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      const float plane = *middle;
      low.clear();
      high.clear();
      for (const uint32_t facet : list) {
        const FacetBox& box = boxes_[facet];
        if (box.min[axis] <= plane) low.push_back(facet);
        if (box.max[axis] >= plane) high.push_back(facet);
      }
      // Where most facets reach both sides, planes do not tell them apart.
      const size_t more = std::max(low.size(), high.size());
      if (10 * more <= 9 * list.size() && 10 * (low.size() + high.size()) <= 16 * list.size()) {
        return true;
      }
    }
    return false;
  }

  void add_pairs(std::vector<uint32_t>& list) {
    std::ranges::sort(list, {}, [&](uint32_t facet) { return boxes_[facet].min[0]; });
    auto& pairs = found_.local().pairs;
    for (size_t i = 0; i < list.size(); ++i) {
      const FacetBox& box = boxes_[list[i]];
      const uint32_t operand = facets_.facets[list[i]].operand;
      for (size_t j = i + 1; j < list.size(); ++j) {
        const FacetBox& other = boxes_[list[j]];
        if (other.min[0] > box.max[0]) break;
        if (!box.meets(other)) continue;
        if (operand == facets_.facets[list[j]].operand && !may_cross_itself_[operand]) continue;
        pairs.push_back(std::minmax(list[i], list[j]));
      }
    }
  }

  const Facets& facets_;
  const std::vector<bool>& may_cross_itself_;
  std::vector<FacetBox> boxes_;
  tbb::enumerable_thread_specific<Found> found_;
};

}  // namespace

FacetPairs facet_pairs(const Facets& facets, const std::vector<bool>& may_cross_itself) {
  return PairSearch(facets, may_cross_itself).run();
}

}  // namespace csgcore
