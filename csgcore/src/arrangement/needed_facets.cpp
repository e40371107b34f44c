#include "arrangement/needed_facets.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "arrangement/exact_center.hpp"
#include "csgcore/stop_scope.hpp"

namespace csgcore {
namespace {

class Selection {
 public:
  Selection(const Facets& facets, const FacetTrees& trees, const Covers& covers)
      : facets_(facets),
        trees_(trees),
        covers_(covers),
        decisions_(covers.decisions()),
        is_needed_(facets.facets.size(), 1) {}

  std::vector<uint32_t> run() {
    const std::stop_token* const stop = stop_of_work;
    tbb::parallel_for(size_t{0}, trees_.size(), [&](size_t i) {
      const StopScope scope(stop);
      stop_point();
      select(static_cast<uint32_t>(i));
    });
    std::vector<uint32_t> result;
    result.reserve(static_cast<size_t>(std::ranges::count(is_needed_, 1)));
    for (uint32_t i = 0; i < is_needed_.size(); ++i) {
      if (is_needed_[i] != 0) result.push_back(i);
    }
    return result;
  }

 private:
  void select(uint32_t operand) {
    if (trees_.is_empty(operand)) return;
    const FacetBox& box = trees_.box(operand);
    const bool is_apart = decisions_.any_decides_outside(operand, [&](uint32_t other) {
      return other != operand && (trees_.is_empty(other) || !trees_.box(other).meets(box));
    });
    if (is_apart) {
      leave_out(trees_.first(operand), trees_.end(operand));
      return;
    }
    covers_.visit(box, [&](uint32_t other) {
      compare(operand, other);
      return false;
    });
  }

  void leave_out(uint32_t begin, uint32_t end) {
    std::fill(is_needed_.begin() + begin, is_needed_.begin() + end, uint8_t{0});
  }

  /// Leaves out facets of the operand where the other one decides, in groups as large as possible.
  void compare(uint32_t operand, uint32_t other) {
    const std::array<bool, 2> decides{decisions_.decides(other, false, operand),
                                      decisions_.decides(other, true, operand)};
    if (operand == other || (!decides[0] && !decides[1])) return;
    // The last facet that was found to be apart from the other surface, and whether inside of it.
    std::array<uint32_t, 3> last{kNoPlace, kNoPlace, kNoPlace};
    bool is_inside = false;
    // The facet is one of those in the box.
    const auto is_decided = [&](const FacetBox& box, uint32_t facet) {
      if (!trees_.box(other).meets(box)) return decides[0];
      if (trees_.meet(other, box)) return false;
      const auto& corners = facets_.facets[facet].corners;
      // Two that share a corner are on one side.
      if (std::ranges::find_first_of(corners, last) == corners.end()) {
        const MovedPoint corner(facets_.points[corners[0]]);
        is_inside = trees_.winding(other, corner, 0, [](uint32_t) { return false; }) != 0;
      }
      last = corners;
      return decides[is_inside ? 1 : 0];
    };
    const BoxTree& tree = trees_.tree(operand);
    const uint32_t first = trees_.first(operand);
    for (uint32_t i = 0; i < tree.nodes().size();) {
      const auto& [box, begin, end, after] = tree.nodes()[i];
      if (is_decided(box, first + begin)) {
        leave_out(first + begin, first + end);
        i = after;
        continue;
      }
      for (uint32_t facet = first + begin; tree.is_leaf(i) && facet < first + end; ++facet) {
        if (is_needed_[facet] == 0) continue;
        if (is_decided(trees_.facet_box(facet), facet) || (decides[1] && is_held(other, facet))) {
          leave_out(facet, facet + 1);
        }
      }
      ++i;
    }
  }

  bool is_held(uint32_t operand, uint32_t facet) const {
    if (!trees_.box(operand).holds(trees_.facet_box(facet))) return false;
    const auto [a, b, c] = facets_.corners(facet);
    const std::array corners{to_vec3(a), to_vec3(b), to_vec3(c)};
    return covers_.hold(operand, corners);
  }

  const Facets& facets_;
  const FacetTrees& trees_;
  const Covers& covers_;
  const Decisions& decisions_;
  std::vector<uint8_t> is_needed_;  // by facet; bytes, since several threads write them
};

}  // namespace

std::vector<uint32_t> needed_facets(const Facets& facets, const FacetTrees& trees,
                                    const Covers& covers) {
  return Selection(facets, trees, covers).run();
}

}  // namespace csgcore
