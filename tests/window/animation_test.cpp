#include "animation.hpp"

#include <gtest/gtest.h>

namespace window {
namespace {

using std::chrono::milliseconds;

class AnimationTest : public testing::Test {
 protected:
  AnimationTest() {
    animation_.set_steps(10, now_);
    animation_.set_frames_per_second(20, now_);
  }
  bool advance(int ms) { return animation_.advance(now_ += milliseconds(ms)); }

  Animation animation_;
  Animation::Clock::time_point now_{};
};

TEST_F(AnimationTest, RunsAtItsRateRoundAndRound) {
  EXPECT_FALSE(advance(1000)) << "it does not play yet";
  animation_.play(now_);
  EXPECT_FALSE(advance(49));
  EXPECT_TRUE(advance(1));
  EXPECT_EQ(animation_.time(), 0.1);
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(advance(50));
  EXPECT_EQ(animation_.time(), 0);
  EXPECT_EQ(animation_.due(), now_ + milliseconds(50));
}

TEST_F(AnimationTest, SkipsFramesRatherThanShowThemLate) {
  animation_.play(now_);
  EXPECT_TRUE(advance(170));
  EXPECT_EQ(animation_.frame(), 3);
  EXPECT_FALSE(advance(20));
  EXPECT_TRUE(advance(10)) << "the rate stays";
  EXPECT_EQ(animation_.frame(), 4);
  EXPECT_TRUE(advance(1000));
  EXPECT_EQ(animation_.frame(), 4);
}

TEST_F(AnimationTest, PausesSeeksAndStops) {
  animation_.play(now_);
  advance(100);
  animation_.pause();
  EXPECT_FALSE(advance(100));
  EXPECT_EQ(animation_.frame(), 2);
  animation_.play(now_);
  animation_.seek(8, now_);
  EXPECT_FALSE(advance(49));
  EXPECT_TRUE(advance(1));
  EXPECT_EQ(animation_.frame(), 9);
  animation_.seek(99, now_);
  EXPECT_EQ(animation_.frame(), 9);
  animation_.stop();
  EXPECT_FALSE(animation_.is_playing());
  EXPECT_EQ(animation_.time(), 0);
}

TEST_F(AnimationTest, OtherStepsKeepTheTime) {
  animation_.seek(5, now_);
  animation_.set_steps(100, now_);
  EXPECT_EQ(animation_.frame(), 50);
  animation_.set_steps(0, now_);
  EXPECT_EQ(animation_.steps(), 1);
  EXPECT_EQ(animation_.time(), 0);
  animation_.set_frames_per_second(1000, now_);
  EXPECT_EQ(animation_.frames_per_second(), Animation::kMostFrames_s);
}

}  // namespace
}  // namespace window
