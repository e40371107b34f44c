#include "archive.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

namespace slow_search {

Archive::Slot Archive::slot_of(const std::string& family, std::size_t bytes) {
  return {family, std::bit_width(bytes)};
}

double Archive::least_excess_ms(const std::string& family, std::size_t bytes) const {
  const auto kept = kept_.find(slot_of(family, bytes));
  return kept == kept_.end() ? 0 : kept->second.ms_per_byte() * static_cast<double>(bytes);
}

void Archive::add(Found found) {
  const auto [kept, is_new] = kept_.try_emplace(slot_of(found.family, found.bytes), found);
  if (!is_new && found.ms_per_byte() > kept->second.ms_per_byte()) kept->second = std::move(found);
}

const Found& Archive::any(Random& random) const {
  constexpr std::size_t kLargest = 8;
  std::vector<const Found*> all;
  for (const auto& [slot, found] : kept_) all.push_back(&found);
  if (random.one_in(2)) {
    const std::size_t count = std::min(kLargest, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                      [](const Found* a, const Found* b) { return a->excess_ms > b->excess_ms; });
    all.resize(count);
  }
  return *all[random.below(all.size())];
}

std::vector<Found> Archive::ranked(double threshold_ms) const {
  std::vector<Found> all;
  for (const auto& [slot, found] : kept_) all.push_back(found);
  std::stable_sort(all.begin(), all.end(), [&](const Found& a, const Found& b) {
    const bool a_is_slow = a.excess_ms > threshold_ms, b_is_slow = b.excess_ms > threshold_ms;
    if (a_is_slow != b_is_slow) return a_is_slow;
    return a.ms_per_byte() > b.ms_per_byte();
  });
  return all;
}

}  // namespace slow_search
