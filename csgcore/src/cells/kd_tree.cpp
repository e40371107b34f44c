#include "csgcore/kd_tree.hpp"

#include <algorithm>

namespace csgcore {
namespace {

/// The default budget, in bytes. By the paper's rules, at a threshold of 1 pixel and 640×480, the
/// cells of CS1000 take 12 MB, those of T1022 30 MB, of CC10000 72 MB, of CS100000 202 MB, and of
/// the latter at half a pixel 440 MB.
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
