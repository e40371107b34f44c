#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "base/evaluation_thread.hpp"

namespace language {
namespace {

int depth_of(int left) {
  volatile char frame[1000] = {};  // 20 MB in all
  return left == 0 ? frame[0] : 1 + depth_of(left - 1);
}

TEST(WithDeepStack, HoldsDeepRecursion) {
  int depth = 0;
  with_deep_stack(20'000, [&] { depth = depth_of(20'000); });
  EXPECT_EQ(depth, 20'000);
}

TEST(WithDeepStack, IsOneForCallsWithinACall) {
  std::thread::id outer, inner;
  with_deep_stack(20'000, [&] {
    outer = std::this_thread::get_id();
    with_deep_stack(20'000, [&] { inner = std::this_thread::get_id(); });
  });
  EXPECT_EQ(outer, inner);
  EXPECT_NE(outer, std::this_thread::get_id());
}

TEST(WithDeepStack, PassesOnWhatIsThrown) {
  EXPECT_THROW(with_deep_stack(20'000, [] { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace language
