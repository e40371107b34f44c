#include "csgcore/kd_tree.hpp"

#include <algorithm>

namespace csgcore {
namespace {

/// Bytes. By the paper's rule, 1 pixel and 640×480, the cells of CS1000 take 12 MB, T1022's 30,
/// CC10000's 72, CS100000's 202, and 440 at half a pixel.
constexpr uint64_t kBudgetInAnyCase = uint64_t{64} << 20;
constexpr uint64_t kBudgetPerTest = 8192;
constexpr uint64_t kMostBudget = uint64_t{2} << 30;

}  // namespace

SubdivisionOptions SubdivisionOptions::paper(double threshold_px, const View& view) {
  SubdivisionOptions options;
  options.leaf_primitives = 2;
  options.stop_at_unions = true;
  options.threshold_px = threshold_px;
  options.view = view;
  options.split = SplitRule::kCyclic;
  return options;
}

uint64_t subdivision_budget(size_t tests) {
  return std::min(kBudgetInAnyCase + kBudgetPerTest * tests, kMostBudget);
}

}  // namespace csgcore
