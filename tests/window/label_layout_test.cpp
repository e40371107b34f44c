// Tests that labels can be read wherever their points are.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "panels/layout.hpp"

namespace window {
namespace {

constexpr LabelBox kRoom{0, 20, 400, 260};

bool share_an_area(const LabelBox& a, const LabelBox& b) {
  return std::min(a.x + a.width, b.x + b.width) > std::max(a.x, b.x) &&
         std::min(a.y + a.height, b.y + b.height) > std::max(a.y, b.y);
}

bool is_within(const LabelBox& box, const LabelBox& room) {
  return box.x >= room.x && box.y >= room.y && box.x + box.width <= room.x + room.width &&
         box.y + box.height <= room.y + room.height;
}

TEST(LabelLayout, ThoseThatHaveRoomStayWhereTheyAreWanted) {
  std::array<LabelBox, 2> labels = {{{10, 30, 100, 20}, {10, 60, 100, 20}}};
  separate(labels, std::vector<LabelBox>{{200, 30, 100, 100}}, kRoom);
  EXPECT_EQ(labels[0].y, 30);
  EXPECT_EQ(labels[1].y, 60);
}

/// Two points next to each other, also in a corner of the window.
TEST(LabelLayout, NeitherLabelsNorPointsAreCovered) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> x(-20, 420), y(-20, 300), near(-30, 30), width(20, 380);
  for (int i = 0; i < 1000; ++i) {
    const float at_x = x(random), at_y = y(random);
    std::array<LabelBox, 3> labels;
    std::vector<LabelBox> points;
    for (LabelBox& label : labels) {
      label = {at_x + near(random), at_y + near(random), width(random), 18};
      points.push_back({label.x - 5, label.y - 12, 10, 10});
    }
    separate(labels, points, kRoom);
    for (const LabelBox& label : labels) {
      EXPECT_TRUE(is_within(label, kRoom));
      for (const LabelBox& point : points) EXPECT_FALSE(share_an_area(label, point));
      for (const LabelBox& other : labels) {
        EXPECT_FALSE(&other != &label && share_an_area(label, other));
      }
    }
  }
}

TEST(LabelLayout, WithoutRoomTheyStay) {
  std::array<LabelBox, 2> labels = {{{0, 0, 10, 10}, {0, 0, 10, 10}}};
  separate(labels, {}, {0, 0, 10, 15});
  EXPECT_EQ(labels[0].y, 0);
  EXPECT_EQ(labels[1].y, 0);
}

}  // namespace
}  // namespace window
