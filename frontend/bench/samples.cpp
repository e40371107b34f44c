#include "samples.hpp"

#include <algorithm>
#include <span>

namespace bench {
namespace {

/// Interpolates between the two values that are nearest to the place.
double quantile(std::span<const double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(place);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Summary summarise(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.5), values.front(), quantile(values, 0.25), quantile(values, 0.75),
          values.size()};
}

}  // namespace bench
