#include "motion_meter.hpp"

#include <gtest/gtest.h>

namespace window {
namespace {

using std::chrono::milliseconds;

TEST(MotionMeter, CountsThePicturesOfOneMotion) {
  MotionMeter meter;
  MotionMeter::Clock::time_point now{};
  EXPECT_EQ(meter.frames_per_second(), 0);
  for (int i = 0; i < 11; ++i) meter.count(now += milliseconds(20));
  EXPECT_DOUBLE_EQ(meter.frames_per_second(), 50);
}

TEST(MotionMeter, APauseBeginsAnotherMotion) {
  MotionMeter meter;
  MotionMeter::Clock::time_point now{};
  for (int i = 0; i < 11; ++i) meter.count(now += milliseconds(20));
  now += milliseconds(900);
  for (int i = 0; i < 11; ++i) meter.count(now += milliseconds(10));
  EXPECT_DOUBLE_EQ(meter.frames_per_second(), 100);
}

TEST(MotionMeter, AFewPicturesTellNothing) {
  MotionMeter meter;
  MotionMeter::Clock::time_point now{};
  for (int i = 0; i < 3; ++i) meter.count(now += milliseconds(20));
  EXPECT_EQ(meter.frames_per_second(), 0);
}

}  // namespace
}  // namespace window
