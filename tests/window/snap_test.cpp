// Tests what a click snaps to: vertices, edges and centres of circles, which operations make, too.
#include "snap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "framing.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/scene_renderer.hpp"
#include "navigation.hpp"

namespace window {
namespace {

using csgcore::Projection;
using csgcore::Vec3;
using Kind = Surface::Kind;

constexpr Size kSize{640, 480};
constexpr double kReach_px = 7;
/// For a point that rays in double have found, per unit of its coordinates.
constexpr double kExact = 1e-11;

const std::string kBlock = "cube(size = [10, 20, 30], center = true);\n";
const std::string kHole =
    "multmatrix([[1, 0, 0, 2], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])"
    " cylinder($fn = 0, h = 100, r1 = 3, r2 = 3, center = true);\n";

/// A design that is looked at from the diagonal.
class SnapTest : public testing::TestWithParam<Projection> {
 protected:
  void load(const std::string& text) {
    design_ = frontend::import_design(frontend::parse(text, ""));
    renderer_.load(std::make_shared<csgcore::Scene>(design_.scene));
    Navigation navigation({}, GetParam());
    const auto box = [this](const csgcore::Mat3& to_frame) {
      return seen_box(design_.scene, seen_box(design_.scene), to_frame);
    };
    view_ = framed(navigation, box(csgcore::Mat3(1.0)), box, {0, 0, 1, 1, 640.0 / 480}).view(kSize);
  }
  /// Returns what a click snaps to that many pixels beside the place where a point is seen.
  std::optional<RayHit> snap_beside(const Vec3& point, double x_px, double y_px) const {
    const ModelRays rays([this](const csgcore::View& view) { return renderer_.look(view); },
                         design_.scene.primitives);
    const PicturePoint seen = *project(view_, point);
    return snap(rays, view_, {seen.x_px + x_px, seen.y_px + y_px}, kReach_px);
  }
  void expect_snap(const Vec3& point, Kind kind) const {
    for (const auto& [x, y] : {std::pair(4.0, 1.0), {-4.0, 2.0}, {0.0, 0.0}, {1.0, -4.0}}) {
      SCOPED_TRACE(testing::Message() << coordinates(point) << " by " << x << ", " << y);
      const auto found = snap_beside(point, x, y);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->surface.kind, kind);
      if (found->surface.kind == kind) expect_near(found->position, point);
    }
  }
  static void expect_near(const Vec3& found, const Vec3& point) {
    EXPECT_LE(glm::distance(found, point), kExact * glm::length(point)) << coordinates(found);
  }
  void expect_edge(const Vec3& point, double length) const {
    SCOPED_TRACE(coordinates(point));
    const auto found = snap_beside(point, 3, 2);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->surface.kind, Kind::kEdge);
    EXPECT_NEAR(found->surface.length, length, kExact * length);
  }

  frontend::ImportedDesign design_;
  frontend::SceneRenderer renderer_;
  csgcore::View view_;
};

TEST_P(SnapTest, VerticesAndEdgesOfABlock) {
  load(kBlock);
  expect_snap({5, -10, 15}, Kind::kVertex);
  expect_snap({-5, -10, -15}, Kind::kVertex);
  expect_snap({5, 10, 15}, Kind::kVertex);  // beside it is the background
  expect_edge({0, -10, 15}, 10);
  expect_edge({5, 0, 15}, 20);
  expect_edge({5, -10, 0}, 30);
  expect_edge({-5, -10, 0}, 30);  // its other face is not seen
  EXPECT_FALSE(snap_beside({0, -10, 0}, 0, 0));
  EXPECT_FALSE(snap_beside({5, -10, -15}, -30, 30));
}

/// A vertex behind the block, where a face is seen, is none.
TEST_P(SnapTest, HiddenVerticesDoNotCount) {
  load(kBlock +
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, 60], [0, 0, 1, 0], [0, 0, 0, 1]])"
       " cube(size = [1, 1, 1], center = true);\n");
  const Vec3 hidden(-5, 10, -15);
  const auto found = snap_beside(hidden, 0, 0);
  EXPECT_FALSE(found && glm::distance(found->position, hidden) < 1);
}

TEST_P(SnapTest, CirclesOfAHole) {
  load("difference() {\n" + kBlock + kHole + "}\n");
  const Vec3 center(2, 1, 15);
  const auto found = snap_beside(center, 3, -3);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->surface.kind, Kind::kCircle);
  expect_near(found->position, center);
  EXPECT_NEAR(found->surface.radius, 3, kExact);
  const Vec3 on_rim = center + Vec3(-3, 0, 0);
  const auto rim = snap_beside(on_rim, 2, 2);
  ASSERT_TRUE(rim);
  ASSERT_EQ(rim->surface.kind, Kind::kCircle);
  EXPECT_NEAR(glm::distance(rim->position, center), 3, kExact * 20);
  EXPECT_NEAR(rim->position.z, 15, kExact * 20);
  EXPECT_LT(glm::distance(rim->position, on_rim), 1);
}

TEST_P(SnapTest, CirclesOfAPinAndACone) {
  load(
      "cube(size = [40, 40, 2], center = true);\n"
      "multmatrix([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])"
      " cylinder($fn = 0, h = 6, r1 = 4, r2 = 2, center = false);\n");
  const auto top = snap_beside({8, 0, 7}, 1, 1);
  ASSERT_TRUE(top);
  ASSERT_EQ(top->surface.kind, Kind::kCircle);
  expect_near(top->position, {8, 0, 7});
  EXPECT_NEAR(top->surface.radius, 2, kExact);
  // The rim at the foot of the cone.
  const auto foot = snap_beside({8, -4, 1}, 2, 0);
  ASSERT_TRUE(foot);
  ASSERT_EQ(foot->surface.kind, Kind::kCircle);
  EXPECT_NEAR(foot->surface.radius, 4, kExact * 20);
}

/// The vertices and lengths that operations leave.
TEST_P(SnapTest, EdgesOfWhatIsCut) {
  load("difference() {\n" + kBlock +
       "multmatrix([[1, 0, 0, 0], [0, 1, 0, -12], [0, 0, 1, 10], [0, 0, 0, 1]])"
       " cube(size = [6, 10, 20], center = true);\n}\n");
  expect_snap({-3, -7, 15}, Kind::kVertex);  // concave
  expect_snap({3, -10, 15}, Kind::kVertex);
  expect_edge({-4, -10, 15}, 2);
  expect_edge({4, -10, 15}, 2);
  expect_edge({-3, -8.5, 15}, 3);
  expect_edge({0, -7, 15}, 6);
}

/// A round hole ends an edge as exactly as a plane does.
TEST_P(SnapTest, EdgesEndAtWhatIsRound) {
  load("difference() {\n" + kBlock +
       "multmatrix([[1, 0, 0, 5], [0, 1, 0, -10], [0, 0, 1, 0], [0, 0, 0, 1]])"
       " sphere($fn = 0, $fa = 12, $fs = 2, r = 4);\n}\n");
  expect_edge({5, -10, 10}, 11);
  expect_edge({5, -10, -10}, 11);
  load("difference() {\n" + kBlock +
       "multmatrix([[1, 0, 0, 5], [0, 0, 1, 0], [0, 1, 0, 15], [0, 0, 0, 1]])"
       " cylinder($fn = 0, h = 6, r1 = 2, r2 = 2, center = true);\n}\n");
  expect_edge({5, -7, 15}, 7);
}

TEST_P(SnapTest, AnySizeWillDo) {
  for (const double scale : {1e-6, 1e6}) {
    const std::string s = std::to_string(1) + "e" + (scale < 1 ? "-6" : "6");
    load("multmatrix([[" + s + ", 0, 0, 0], [0, " + s + ", 0, 0], [0, 0, " + s +
         ", 0], [0, 0, 0, 1]]) {\n" + kBlock + "}\n");
    expect_snap(scale * Vec3(5, -10, 15), Kind::kVertex);
  }
}

/// A ball, and the middle of a face, have nothing to snap to.
TEST_P(SnapTest, BallsHaveNoEdges) {
  load("sphere($fn = 0, $fa = 12, $fs = 2, r = 10);\n");
  EXPECT_FALSE(snap_beside({0, 0, 0}, 0, 0));
  EXPECT_FALSE(snap_beside({0, 0, 0}, 90, 10));
}

/// Where many small faces are next to a click, it would always meet some vertex.
TEST_P(SnapTest, FinelyFacetedSurfacesHaveNone) {
  std::string text = "cube(size = [100, 100, 1]);\n";
  for (int i = 0; i < 100; ++i) {
    text += "multmatrix([[1, 0, 0, " + std::to_string(50 + 0.4 * (i % 10)) + "], [0, 1, 0, " +
            std::to_string(50 + 0.4 * (i / 10)) + "], [0, 0, 1, 0], [0, 0, 0, 1]]) " +
            "cube(size = [0.2, 0.2, " + std::to_string(2 + i * 7 % 10 * 0.1) + "]);\n";
  }
  load(text);
  EXPECT_FALSE(snap_beside({52, 52, 2}, 0, 0));
  EXPECT_TRUE(snap_beside({100, 0, 1}, 3, 0));
}

INSTANTIATE_TEST_SUITE_P(, SnapTest,
                         testing::Values(Projection::kPerspective, Projection::kOrthographic));

}  // namespace
}  // namespace window
