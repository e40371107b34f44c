// Tests the words of what is measured, as they are shown and copied.
#include <gmock/gmock.h>

#include "frontend/options.hpp"
#include "state_texts.hpp"

namespace window {
namespace {

using csgcore::Vec3;
using testing::ElementsAre;

MeasuredPoint point_at(const Vec3& position, const Surface& surface) {
  MeasuredPoint point;
  point.position = position;
  point.place.trail = {{"cube(3)", {"/a/b.scad", "b.scad", 4, 5}}};
  point.surface = surface;
  return point;
}

class MeasuredText : public testing::Test {
 protected:
  State state_{frontend::Options{}};
};

TEST_F(MeasuredText, NamesPointsAndTheirDistance) {
  state_.measure(point_at({1, 2, 3}, {Surface::Kind::kVertex, {1, 2, 3}}));
  EXPECT_THAT(measured_lines(state_.points), ElementsAre("vertex"));
  EXPECT_EQ(text_to_copy(state_), "[1, 2, 3]\ncube(3)  b.scad:4:5\nvertex");
  state_.measure(point_at({1, 6, 6}, {Surface::Kind::kEdge, {1, 6, 6}, {1, 0, 0}, 0, 12.5}));
  EXPECT_EQ(distance_text(state_.points), "5  [0, 4, 3]");
  EXPECT_THAT(measured_lines(state_.points),
              ElementsAre("edge, length 12.5, direction [1, 0, 0]", "vertex 5 from the edge"));
  EXPECT_EQ(text_to_copy(state_),
            "[1, 2, 3]\ncube(3)  b.scad:4:5\nvertex\n"
            "[1, 6, 6]\ncube(3)  b.scad:4:5\nedge, length 12.5, direction [1, 0, 0]\n"
            "5  [0, 4, 3]\nvertex 5 from the edge");
}

TEST_F(MeasuredText, IsWhatIsSaidWhereNothingIsMeasured) {
  EXPECT_EQ(text_to_copy(state_), "");
  state_.messages =
      messages_of({"ERROR: a", "TRACE: called by 'b' in file c.scad, line 1", "ECHO: 1"});
  EXPECT_EQ(text_to_copy(state_), "ERROR: a\nTRACE: called by 'b' in file c.scad, line 1\nECHO: 1");
  state_.measure(point_at({1, 2, 3}, {}));
  EXPECT_EQ(text_to_copy(state_), "[1, 2, 3]\ncube(3)  b.scad:4:5");
}

}  // namespace
}  // namespace window
