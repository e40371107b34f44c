#include "solid/operand_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <latch>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "checks.hpp"
#include "made.hpp"
#include "screen/screen_bounds.hpp"
#include "screen/screen_extents.hpp"
#include "simd_levels.hpp"
#include "solid/extent_tests.hpp"
#include "solid/restriction.hpp"
#include "support/models.hpp"
#include "trace_scenes.hpp"
#include "whole_list.hpp"

namespace csgcore {
namespace {

using checks::uniform;

const Box kSpace{Vec3(-8.0), Vec3(8.0)};

/// Small balls, large ones among them.
Primitive random_ball(std::mt19937& random) {
  const double radius = random() % 50 == 0 ? uniform(random, 2, 5) : uniform(random, 0.02, 0.3);
  return make_sphere(radius, checks::moved(checks::random_point(random, kSpace)));
}

/// Nested operations of up to hundreds of operands; some primitives are in them repeatedly.
void add_operation(CsgTreeBuilder& builder, Scene& scene, std::mt19937& random, int depth) {
  const bool is_large = random() % 2;
  // Intersections of many operands leave little.
  const Op op = static_cast<Op>(is_large ? 2 * (random() % 2) : random() % 3);
  static_assert(static_cast<int>(Op::kIntersection) == 1);
  builder.open(op);
  const uint32_t operands = is_large ? 100 + random() % 200 : 2 + random() % 4;
  for (uint32_t i = 0; i < operands; ++i) {
    if (depth > 0 && random() % (operands < 10 ? 2 : 50) == 0) {
      add_operation(builder, scene, random, depth - 1);
      continue;
    }
    uint32_t primitive = static_cast<uint32_t>(scene.primitives.size());
    if (primitive > 0 && random() % 20 == 0) {
      primitive = random() % primitive;
    } else {
      scene.primitives.push_back(random_ball(random));
    }
    builder.primitive(primitive);
  }
  builder.close();
}

Scene random_scene(uint32_t seed) {
  std::mt19937 random(seed);
  Scene scene;
  CsgTreeBuilder builder;
  builder.open(Op::kUnion);
  for (uint32_t i = 0; i < 150; ++i) {
    builder.primitive(i);
    scene.primitives.push_back(random_ball(random));
  }
  for (int i = 0; i < 3; ++i) add_operation(builder, scene, random, 3);
  builder.close();
  scene.model = builder.finish();
  return scene;
}

bool box_holds(const Extent& extent, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(point[axis] - extent.center[axis]) > extent.half[axis]) return false;
  }
  return true;
}

/// Returns the value at a point. A group's members are evaluated only if its box holds the point.
bool value_at(const Solid& solid, const Vec3& point) {
  const OperandGroups& groups = solid.groups();
  const std::function<bool(uint32_t)> inside = [&](uint32_t index) {
    if (!groups.is_group(index)) return contains(solid.primitives()[index], point);
    if (!box_holds(groups.extents()[index], point)) return false;
    const OperandGroups::Members members = groups.members(index);
    uint32_t number = static_cast<uint32_t>(members.primitive.size()) - 1 + CellList::kFirst;
    while (number >= CellList::kFirst) {
      const uint32_t i = number - CellList::kFirst;
      const bool is_in = inside(members.primitive[i] & kPrimitiveBits);
      number = is_in ? members.if_inside[i] : members.if_outside[i];
    }
    return number == CellList::kTrue;
  };
  std::vector<BlistTest> tests;
  append(tests, groups.list());
  if (tests.empty()) return groups.list().root == CellList::kTrue;
  return evaluate(std::span<const BlistTest>(tests), inside);
}

class GroupsOf : public testing::TestWithParam<uint32_t> {
 protected:
  const Scene scene_ = random_scene(GetParam());
  const Solid solid_{canonical_primitives(scene_), scene_.model};
  const OperandGroups& groups_ = solid_.groups();
};

TEST_P(GroupsOf, RandomTreeHaveItsValues) {
  ASSERT_GT(groups_.count(), groups_.first_group());
  std::mt19937 random(1);
  int holds = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 point = checks::random_point(random, kSpace);
    ASSERT_EQ(value_at(solid_, point), solid_.contains(point));
    holds += solid_.contains(point);
  }
  EXPECT_GT(holds, 0);
}

/// The same by expanding the groups, cell by cell.
TEST_P(GroupsOf, RandomTreeOpenIntoItsList) {
  const WorldClassifier classifier(solid_.primitives());
  Restrictor restrictor(groups_.extents(), classifier);
  std::mt19937 random(2);
  for (int round = 0; round < 100; ++round) {
    const Vec3 center = checks::random_point(random, kSpace);
    const Vec3 half(uniform(random, 0.01, 1));
    const Box cell{center - half, center + half};
    CellList list, closed;
    restrictor.restrict(groups_.list(), cell, list);
    for (bool any = true; any;) {
      any = false;
      std::vector<uint8_t> marked(list.count());
      for (uint32_t i = 0; i < list.count(); ++i) {
        if (!groups_.is_group(list.primitive[i] & kPrimitiveBits)) continue;
        marked[i] = 1;
        any = true;
      }
      std::swap(list, closed);
      restrictor.open(closed, groups_, marked, {cell}, list);
    }
    std::vector<BlistTest> tests;
    append(tests, list);
    for (int i = 0; i < 30; ++i) {
      const Vec3 point = checks::random_point(random, cell);
      const auto inside = [&](uint32_t p) { return contains(solid_.primitives()[p], point); };
      const bool value = tests.empty() ? list.root == CellList::kTrue
                                       : evaluate(std::span<const BlistTest>(tests), inside);
      ASSERT_EQ(value, solid_.contains(point));
    }
  }
}

/// All other primitives are in exactly one group.
TEST_P(GroupsOf, RandomTreeNamesWhatStandsInNoGroupOrInSeveral) {
  std::map<uint32_t, int> uses;  // number of groups, by primitive
  for (uint32_t group = groups_.first_group(); group < groups_.count(); ++group) {
    for (const uint32_t entry : groups_.members(group).primitive) ++uses[entry & kPrimitiveBits];
  }
  std::set<uint32_t> expected;
  for (const uint32_t entry : groups_.list().primitives()) expected.insert(entry & kPrimitiveBits);
  for (const auto& [index, count] : uses) {
    if (count > 1) expected.insert(index);
  }
  EXPECT_TRUE(std::ranges::equal(groups_.common(), expected));
}

TEST_P(GroupsOf, RandomTreeShowTheSame) {
  for (const auto& [name, view] : checks::trace_views(kSpace, 48, 36)) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(checks::same_bits(checks::trace_by_tiles(solid_, view, {}),
                                  checks::WholeList(solid_, view).picture()));
  }
}

/// Rectangles of balls contain what is bounded in double, and hardly more.
TEST_P(GroupsOf, RandomTreeHaveRectanglesThatHoldTheirMembers) {
  for (const auto& [name, view] : checks::trace_views(kSpace, 640, 480)) {
    SCOPED_TRACE(name);
    const FrameRays frame = frame_rays(view, solid_.bounds());
    Extents screen(groups_.count());
    double area = 0, exact_area = 0;
    int visible = 0;
    for (uint32_t group = groups_.first_group(); group < groups_.count(); ++group) {
      const OperandGroups::Members members = groups_.members(group);
      const auto count = static_cast<uint32_t>(members.primitive.size());
      const double* const center = groups_.extents()[group].center;
      // The numbers after a group's are another group's.
      std::vector<float> rows[4];
      for (auto& row : rows) row.assign(count + 1, 7.0f);
      const ScreenRectangle all = find_rectangles(
          groups_.balls(group), count, {center[0], center[1], center[2]}, frame, {false},
          {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()});
      for (const auto& row : rows) ASSERT_EQ(row[count], 7.0f);
      if (!all.is_empty()) {
        EXPECT_GE(all.low_x, *std::min_element(rows[0].begin(), rows[0].end() - 1));
        EXPECT_LE(all.high_x, *std::max_element(rows[1].begin(), rows[1].end() - 1));
        EXPECT_GE(all.low_y, *std::min_element(rows[2].begin(), rows[2].end() - 1));
        EXPECT_LE(all.high_y, *std::max_element(rows[3].begin(), rows[3].end() - 1));
      }
      std::vector<uint32_t> indices;
      for (const uint32_t entry : members.primitive) indices.push_back(entry & kPrimitiveBits);
      find_screen_extents(groups_.extents().data(), indices, frame, {false}, screen.data());
      for (uint32_t i = 0; i < count; ++i) {
        const Extent& exact = screen[indices[i]];
        if (!is_visible(exact)) continue;
        ++visible;
        EXPECT_LE(all.low_x, rows[0][i]);
        EXPECT_GE(all.high_x, rows[1][i]);
        EXPECT_LE(all.low_y, rows[2][i]);
        EXPECT_GE(all.high_y, rows[3][i]);
        for (const int axis : {0, 1}) {
          const double last = axis == 0 ? view.width_px : view.height_px;
          ASSERT_LE(rows[2 * axis][i], std::max(exact.center[axis] - exact.half[axis], -1.0));
          ASSERT_GE(rows[2 * axis + 1][i], std::min(exact.center[axis] + exact.half[axis], last));
        }
        if (groups_.is_group(indices[i]) || exact.half[0] > 100) continue;
        area += (rows[1][i] - rows[0][i]) * (rows[3][i] - rows[2][i]);
        exact_area += 4 * exact.half[0] * exact.half[1];
      }
    }
    EXPECT_GT(visible, 0);
    // Near the eye a ball is not seen as one any more.
    EXPECT_LT(area, (name == "FromWithin" ? 2 : 1.2) * exact_area);
  }
}

/// Returns the members of a group that do not lie outside of the cell; the bounds have their
/// extents then.
std::vector<uint32_t> members_in(const OperandGroups& groups, const ScreenBounds& bounds,
                                 uint32_t group, const Box& cell) {
  std::vector<uint32_t> result;
  const OperandGroups::Members members = groups.members(group);
  const auto count = static_cast<uint32_t>(members.primitive.size());
  for (uint32_t first = 0; first < count; first += 64) {
    const uint32_t some = std::min(count - first, 64u);
    const uint64_t outside = bounds.members_outside(members, first, some, cell).value();
    for (uint32_t i = 0; i < some; ++i) {
      if ((outside >> i & 1) == 0) result.push_back(members.primitive[first + i]);
    }
  }
  return result;
}

/// On the screen a group reaches as far as its members, and not as far as its box.
TEST_P(GroupsOf, RandomTreeAreNoLargerThanTheirMembers) {
  for (const auto& [name, view] : checks::trace_views(kSpace, 640, 480)) {
    SCOPED_TRACE(name);
    const FrameRays frame = frame_rays(view, solid_.bounds());
    const ScreenBounds bounds(solid_.primitives(), groups_, frame, true);
    const Box picture{Vec3(0, 0, -1e9), Vec3(view.width_px - 1, view.height_px - 1, 1e9)};
    Extents boxes(groups_.count());
    double area = 0, box_area = 0;
    std::vector<uint32_t> left;
    const auto add_groups = [&](std::span<const uint32_t> entries) {
      for (const uint32_t entry : entries) {
        if (groups_.is_group(entry & kPrimitiveBits)) left.push_back(entry & kPrimitiveBits);
      }
    };
    for (add_groups(groups_.list().primitives()); !left.empty();) {
      const uint32_t group = left.back();
      left.pop_back();
      const Extent& extent = bounds.extents()[group];
      find_screen_extents(groups_.extents().data(), std::span(&group, 1), frame, {true},
                          boxes.data());
      const Extent& box = boxes[group];
      if (!is_visible(box)) continue;
      const std::vector<uint32_t> members = members_in(groups_, bounds, group, picture);
      add_groups(members);
      if (is_visible(extent)) {
        const bool is_on_screen = box.half[0] < 0.5 * view.width_px;
        area += is_on_screen ? extent.half[0] * extent.half[1] : 0;
        box_area += is_on_screen ? box.half[0] * box.half[1] : 0;
      }
      for (const uint32_t entry : members) {
        const Extent& member = bounds.extents()[entry & kPrimitiveBits];
        if (!is_visible(member)) continue;
        // Only the part within the group's box and the picture counts.
        double low[2], high[2];
        for (const int axis : {0, 1}) {
          const double last = axis == 0 ? view.width_px - 1.0 : view.height_px - 1.0;
          low[axis] = std::max(
              {member.center[axis] - member.half[axis], box.center[axis] - box.half[axis], 0.0});
          high[axis] = std::min(
              {member.center[axis] + member.half[axis], box.center[axis] + box.half[axis], last});
        }
        if (low[0] > high[0] || low[1] > high[1]) continue;
        ASSERT_TRUE(is_visible(extent));
        for (const int axis : {0, 1}) {
          EXPECT_LE(extent.center[axis] - extent.half[axis], low[axis]);
          EXPECT_GE(extent.center[axis] + extent.half[axis], high[axis]);
        }
      }
    }
    // Along the axes boxes are tight.
    EXPECT_LE(area, box_area);
    if (name == "Perspective") {
      EXPECT_LT(area, 0.9 * box_area);
    }
  }
}

/// Returns the members that the cell shows, group by group.
std::vector<uint32_t> all_members_in(const OperandGroups& groups, const ScreenBounds& bounds,
                                     const Box& cell) {
  const std::span<const uint32_t> all = groups.list().primitives();
  std::vector<uint32_t> shown(all.begin(), all.end());
  for (size_t next = 0; next < shown.size(); ++next) {
    const uint32_t group = shown[next] & kPrimitiveBits;
    if (!groups.is_group(group) || !is_visible(bounds.extents()[group])) continue;
    const std::vector<uint32_t> members = members_in(groups, bounds, group, cell);
    shown.insert(shown.end(), members.begin(), members.end());
  }
  return shown;
}

/// Threads that begin with the same groups bound the same members: ThreadSanitizer looks on.
TEST_P(GroupsOf, RandomTreeAreBoundedByThreadsAtOnce) {
  constexpr int kThreads = 4;
  constexpr int kRounds = 10;
  const View view = checks::trace_views(solid_.bounds(), 640, 480).front().view;
  const FrameRays frame = frame_rays(view, solid_.bounds());
  const Box cell{Vec3(100, 100, -1e9), Vec3(500, 400, 1e9)};
  const ScreenBounds alone(solid_.primitives(), groups_, frame, true);
  const std::vector<uint32_t> expected = all_members_in(groups_, alone, cell);
  ASSERT_GT(expected.size(), groups_.list().primitives().size());
  for (int round = 0; round < kRounds; ++round) {
    const ScreenBounds bounds(solid_.primitives(), groups_, frame, true);
    std::vector<uint32_t> found[kThreads];
    std::latch start(kThreads);
    std::vector<std::jthread> threads;
    for (std::vector<uint32_t>& own : found) {
      threads.emplace_back([&] {
        start.arrive_and_wait();
        own = all_members_in(groups_, bounds, cell);
      });
    }
    threads.clear();  // joins them
    for (const std::vector<uint32_t>& own : found) EXPECT_EQ(own, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, GroupsOf, testing::Range(1u, 7u));

/// Members between the rays have no rectangle; all others have one.
TEST_P(GroupsOf, RandomTreeHaveNoRectanglesBetweenTheRays) {
  std::mt19937 random(GetParam());
  constexpr uint32_t kCount = 4000;
  std::vector<float> x, y, z, radius;
  Extents extents;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < kCount; ++i) {
    const Vec3 place = checks::random_point(random, kSpace);
    const double r = uniform(random, 0.001, 0.2);
    for (auto* row : {&x, &y, &z}) {
      row->push_back(static_cast<float>(place[row == &x ? 0 : row == &y ? 1 : 2]));
    }
    radius.push_back(static_cast<float>(r));
    const Primitive ball =
        make_sphere(radius.back(), checks::moved({x.back(), y.back(), z.back()}));
    extents.push_back(extent_of(canonicalize(ball)));
    indices.push_back(i);
  }
  for (auto* row : {&x, &y, &z, &radius}) row->resize(kCount + kRowPadding);
  for (const auto& [name, view] : checks::trace_views(kSpace, 64, 48)) {
    SCOPED_TRACE(name);
    const FrameRays frame = frame_rays(view, kSpace);
    std::vector<float> rows[4];
    for (auto& row : rows) row.resize(kCount + kRowPadding);
    find_rectangles({x.data(), y.data(), z.data(), radius.data()}, kCount, Vec3(0.0), frame, {true},
                    {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()});
    Extents screen(kCount);
    find_screen_extents(extents.data(), indices, frame, {true}, screen.data());
    uint32_t nowhere = 0, between = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
      const bool is_nowhere = rows[0][i] > rows[1][i];
      nowhere += is_nowhere;
      between += screen[i].outside2 < 0;
      ASSERT_FALSE(is_nowhere && is_visible(screen[i]));
    }
    EXPECT_GE(nowhere, between / 4);
  }
}

/// Beside it is a ball that does not overflow.
TEST(MemberRectangles, WhatOverflowsMayBeAnywhere) {
  constexpr float kOverflown = std::numeric_limits<float>::infinity();
  constexpr uint32_t kCount = 2;
  const std::vector<float> zeros(kCount + kRowPadding);
  struct Ball {
    float x, radius;
  };
  // The last overflows in pixels only.
  for (const Ball& ball : {Ball{kOverflown, 1}, Ball{0, kOverflown}, Ball{1e38f, 2e38f}}) {
    std::vector<float> x(kCount + kRowPadding), radius(kCount + kRowPadding, 1.0f);
    x[0] = ball.x;
    radius[0] = ball.radius;
    for (const auto& [name, view] : checks::trace_views(kSpace, 640, 480)) {
      SCOPED_TRACE(name);
      std::vector<float> rows[4];
      for (auto& row : rows) row.resize(kCount + kRowPadding);
      const ScreenRectangle all =
          find_rectangles({x.data(), zeros.data(), zeros.data(), radius.data()}, kCount, Vec3(0.0),
                          frame_rays(view, kSpace), {false},
                          {rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()});
      EXPECT_LT(std::max(all.low_x, all.low_y), -1);
      EXPECT_GT(std::min(all.high_x, all.high_y), 640);
      const Box corner{Vec3(-1, -1, 0), Vec3(0, 0, 0)};
      const RectangleRows rectangles{rows[0].data(), rows[1].data(), rows[2].data(),
                                     rows[3].data()};
      EXPECT_EQ(find_outside(rectangles, kCount, corner) & 1, 0u);
    }
  }
}

TEST(MemberRectangles, EveryInstructionSetAgrees) {
  std::mt19937 random(4);
  constexpr uint32_t kCount = 37;
  std::vector<float> balls[4];
  for (auto& row : balls) {
    for (uint32_t i = 0; i < kCount + kRowPadding; ++i) {
      row.push_back(static_cast<float>(uniform(random, 0.01, 8)));
    }
  }
  for (const auto& [name, seen] : checks::trace_views(kSpace, 640, 480)) {
    SCOPED_TRACE(name);
    const View& view = seen;
    std::vector<std::vector<float>> answers;
    checks::for_each_simd_level([&](SimdLevel) {
      std::vector<float> rows(4 * kCount);
      float* const row = rows.data();
      const ScreenRectangle all =
          find_rectangles({balls[0].data(), balls[1].data(), balls[2].data(), balls[3].data()},
                          kCount, Vec3(-4.0), frame_rays(view, kSpace), {true},
                          {row, row + kCount, row + 2 * kCount, row + 3 * kCount});
      for (const double bound : {all.low_x, all.high_x, all.low_y, all.high_y}) {
        rows.push_back(static_cast<float>(bound));
      }
      answers.push_back(std::move(rows));
    });
    for (const auto& rows : answers) EXPECT_EQ(rows, answers.front());
  }
}

Solid solid_of(std::vector<Primitive> primitives,
               const std::function<void(CsgTreeBuilder&)>& build) {
  Scene scene;
  scene.primitives = std::move(primitives);
  CsgTreeBuilder builder;
  build(builder);
  scene.model = builder.finish();
  return Solid(canonical_primitives(scene), scene.model);
}

std::vector<Primitive> balls_at(std::initializer_list<double> places) {
  std::vector<Primitive> balls;
  for (const double x : places) balls.push_back(make_sphere(1, checks::moved({x, 0, 0})));
  return balls;
}

TEST(OperandGroups, LeaveOutWhatMattersNowhere) {
  // The difference's operand is elsewhere; the intersection leaves nothing of one; a union within
  // an intersection has one beside it.
  const Solid difference = solid_of(balls_at({0, 1, 5}), [](CsgTreeBuilder& builder) {
    builder.open(Op::kDifference);
    for (uint32_t i = 0; i < 3; ++i) builder.primitive(i);
    builder.close();
  });
  EXPECT_EQ(difference.groups().list().count(), 2u);
  const Solid intersection = solid_of(balls_at({0, 5}), [](CsgTreeBuilder& builder) {
    builder.open(Op::kIntersection);
    builder.primitive(0);
    builder.primitive(1);
    builder.close();
  });
  EXPECT_TRUE(intersection.groups().list().is_constant());
  EXPECT_EQ(intersection.groups().list().root, CellList::kFalse);
  const Solid cut_union = solid_of(balls_at({0, 3, -3, 0.5}), [](CsgTreeBuilder& builder) {
    builder.open(Op::kIntersection);
    builder.open(Op::kUnion);
    for (uint32_t i = 0; i < 3; ++i) builder.primitive(i);
    builder.close();
    builder.primitive(3);
    builder.close();
  });
  EXPECT_EQ(cut_union.groups().list().count(), 2u);
  // Both operands of the union are beside what is left of its box.
  const Solid nothing = solid_of(balls_at({-4, 4, 0}), [](CsgTreeBuilder& builder) {
    builder.open(Op::kIntersection);
    builder.open(Op::kUnion);
    builder.primitive(0);
    builder.primitive(1);
    builder.close();
    builder.primitive(2);
    builder.close();
  });
  EXPECT_TRUE(nothing.groups().list().is_constant());
  // Nor is anything left of what remains of it less something.
  const Solid less = solid_of(balls_at({-4, 4, 0.5, 0}), [](CsgTreeBuilder& builder) {
    builder.open(Op::kIntersection);
    builder.open(Op::kDifference);
    builder.open(Op::kUnion);
    builder.primitive(0);
    builder.primitive(1);
    builder.close();
    builder.primitive(2);
    builder.close();
    builder.primitive(3);
    builder.close();
  });
  EXPECT_TRUE(less.groups().list().is_constant());
  EXPECT_EQ(less.groups().list().root, CellList::kFalse);
}

TEST(OperandGroups, ManyOperandsAreFewTests) {
  const Scene scene = test_support::cylinder_minus_spheres(10000);
  const Solid solid(canonical_primitives(scene), scene.model);
  EXPECT_LE(solid.groups().list().count(), 70u);
  // A group is small: its box is not the whole solid's.
  const OperandGroups& groups = solid.groups();
  double longest = 0;
  for (uint32_t group = groups.first_group(); group < groups.count(); ++group) {
    const Extent& extent = groups.extents()[group];
    longest = std::max({longest, extent.half[0], extent.half[1], extent.half[2]});
  }
  EXPECT_LT(2 * longest, 0.5 * solid.bounds().diagonal());
}

TEST(OperandGroups, DeepNesting) {
  constexpr uint32_t kDepth = 200'000;
  const Solid solid = solid_of(balls_at({0, 0.5}), [](CsgTreeBuilder& builder) {
    for (uint32_t i = 0; i < kDepth; ++i) builder.open(i % 2 ? Op::kUnion : Op::kIntersection);
    builder.primitive(0);
    builder.primitive(1);
    for (uint32_t i = 0; i < kDepth; ++i) {
      builder.primitive(i % 2);
      builder.close();
    }
  });
  EXPECT_EQ(solid.groups().list().count(), solid.cell_list()->count());
}

}  // namespace
}  // namespace csgcore
