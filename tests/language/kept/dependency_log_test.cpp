// Compares the log of nested parts with plain sets.
#include "evaluation/dependency_log.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

namespace language {
namespace {

TEST(DependencyLog, HoldsWhatPlainSetsHold) {
  constexpr uint32_t kNumbers = 12;
  std::mt19937 random(1);
  DependencyLog log(kNumbers);
  std::vector<std::set<uint32_t>> parts;
  const auto noted = [&] {
    std::multiset<uint32_t> numbers;
    log.for_each([&](uint32_t number) { numbers.insert(number); });
    return numbers;
  };
  for (int step = 0; step < 20000; ++step) {
    const auto choice = random() % 10;
    if (parts.empty() || (choice < 2 && parts.size() < 9)) {
      log.begin();
      parts.emplace_back();
    } else if (choice < 4) {
      const uint32_t forgotten = random() % kNumbers;
      log.end([&](uint32_t number) { return number != forgotten; });
      const std::set<uint32_t> ended = parts.back();
      parts.pop_back();
      if (parts.empty()) continue;
      for (const uint32_t number : ended)
        if (number != forgotten) parts.back().insert(number);
    } else {
      const uint32_t number = random() % kNumbers;
      log.note(number);
      parts.back().insert(number);
      EXPECT_TRUE(log.has(number));
    }
    const std::multiset<uint32_t> wanted(parts.back().begin(), parts.back().end());
    ASSERT_EQ(noted(), wanted) << "step " << step;
  }
}

}  // namespace
}  // namespace language
