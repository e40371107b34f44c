#include "csgcore/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "checks.hpp"
#include "primitives/profile_line.hpp"
#include "profile_figures.hpp"
#include "support/full_run.hpp"

namespace csgcore {
namespace {

using checks::circle;
using checks::polygon;
using checks::uniform;
using Kind = ProfileEdge::Kind;

Vec2 to_local(const Profile& profile, const Vec2& place) {
  return profile.center() + profile.half() * place;
}

TEST(Profile, DividesEdgesIntoMonotonePiecesThatMeet) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const auto profile = checks::random_profile(random, false);
    Vec2 low(1.0), high(-1.0);
    size_t loops = 0;
    const auto& pieces = profile->pieces();
    for (size_t i = 0, first = 0; i < pieces.size(); ++i) {
      const Profile::Piece& piece = pieces[i];
      low = glm::min(low, piece.start), high = glm::max(high, piece.start);
      if (!piece.is_line()) {
        ASSERT_EQ(glm::clamp(piece.control, glm::min(piece.start, piece.end),
                             glm::max(piece.start, piece.end)),
                  piece.control);
        ASSERT_GT(piece.weight, 0.7);
        ASSERT_LE(piece.weight, 1);
      }
      if (piece.end == pieces[first].start) {
        ++loops;
        first = i + 1;
      } else {
        ASSERT_LT(i + 1, pieces.size());
        ASSERT_EQ(piece.end, pieces[i + 1].start);
      }
    }
    ASSERT_GE(loops, profile->loops().size());
    ASSERT_LT(glm::distance(low, Vec2(-1.0)) + glm::distance(high, Vec2(1.0)), 1e-15);
  }
}

/// Each edge is where its pieces are, and no piece is elsewhere.
TEST(Profile, HasPiecesWhereItsEdgesAre) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    const std::vector<ProfileLoop> loops{checks::random_loops(random)[0]};
    const Profile profile(loops, FillRule::kNonZero);
    if (!profile.has_area()) continue;
    Vec2 start = profile.loops()[0].back().end;
    for (const ProfileEdge& edge : profile.loops()[0]) {
      const Vec2 place = checks::edge_point(start, edge, uniform(random, 0, 1)).place;
      const Vec2 canonical = (place - profile.center()) / profile.half();
      double nearest = 10;
      for (const Profile::Piece& piece : profile.pieces()) {
        // The distance from a line through the point that runs along the edge.
        const Vec2 normal = piece_normal(piece, canonical);
        const double length = glm::length(normal);
        const Vec2 low = glm::min(piece.start, piece.end) - 1e-13,
                   high = glm::max(piece.start, piece.end) + 1e-13;
        if (glm::clamp(canonical, low, high) != canonical || length == 0) continue;
        double gap = 10;
        if (piece.is_line()) {
          gap = std::abs(glm::dot(normal, canonical - piece.start)) / length;
        } else {
          for_each_crossing(
              {normal / length, cross(normal, canonical) / length}, piece, [&](double along, int) {
                gap = std::min(gap, std::abs(along - glm::dot(normal, canonical) / length));
              });
        }
        nearest = std::min(nearest, gap);
      }
      EXPECT_LT(nearest, 1e-14) << "kind " << static_cast<int>(edge.kind);
      start = edge.end;
    }
    if (HasFailure()) return;
  }
}

TEST(Profile, HasABoundingVolumeHierarchyOfAllItsPieces) {
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    const Profile profile(checks::random_loops(random, 100), FillRule::kNonZero);
    std::vector<int> visits(profile.pieces().size());
    std::vector<uint32_t> open{0};
    while (!open.empty()) {
      const Profile::Node& node = profile.nodes()[open.back()];
      open.pop_back();
      for (uint32_t i = node.begin; i < node.end; ++i) {
        const Profile::Piece& piece = profile.pieces()[i];
        for (const Vec2& p : {piece.start, piece.end}) {
          for (int axis = 0; axis < 2; ++axis) {
            EXPECT_LT(node.min[static_cast<size_t>(axis)], p[axis]);
            EXPECT_GT(node.max[static_cast<size_t>(axis)], p[axis]);
          }
        }
        if (node.is_chain && i > node.begin) {
          EXPECT_EQ(piece.start, profile.pieces()[i - 1].end);
        }
        if (node.children == 0) ++visits[i];
      }
      if (node.children != 0) {
        open.push_back(node.children);
        open.push_back(node.children + 1);
      } else {
        EXPECT_LE(node.end - node.begin, Profile::kLeafPieces);
        EXPECT_TRUE(node.is_chain);
      }
    }
    EXPECT_TRUE(std::ranges::all_of(visits, [](int count) { return count == 1; }));
  }
}

TEST(Profile, ContainsWhatItsDefinitionDoes) {
  std::mt19937 random(4);
  int inside = 0;
  for (int round = 0; round < 200; ++round) {
    const auto profile = checks::random_profile(random, false);
    for (int i = 0; i < 100; ++i) {
      const Vec2 place{uniform(random, -1.1, 1.1), uniform(random, -1.1, 1.1)};
      const Vec2 local = to_local(*profile, place);
      const bool expected = checks::holds(profile->loops(), profile->fill_rule(), local.x, local.y);
      ASSERT_EQ(profile->contains(place), expected) << "round " << round;
      inside += expected;
    }
  }
  EXPECT_GT(inside, 2000);
}

TEST(Profile, HasThePointThatIsFurthest) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const auto profile = checks::random_profile(random, false);
    const double angle = uniform(random, -4, 4);
    const Vec2 direction = round % 5 == 0 ? Vec2{0, -1} : Vec2{std::cos(angle), std::sin(angle)};
    const double furthest = glm::dot(profile->support(direction), direction);
    double sampled = -10;
    for (const ProfileLoop& loop : profile->loops()) {
      Vec2 start = loop.back().end;
      for (const ProfileEdge& edge : loop) {
        for (int i = 0; i <= 1000; ++i) {
          const Vec2 p = checks::edge_point(start, edge, i / 1000.0).place;
          const Vec2 place = (p - profile->center()) / profile->half();
          sampled = std::max(sampled, glm::dot(place, direction));
          ASSERT_LE(glm::length(place), profile->reach());
        }
        start = edge.end;
      }
    }
    EXPECT_GE(furthest, sampled - 1e-14);
    EXPECT_LE(furthest, sampled + 1e-5);
  }
}

TEST(Profile, LeavesOutEdgesWithoutALength) {
  ProfileLoop loop = polygon({{0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 1}, {0, 0}});
  loop.push_back({Kind::kArc, true, {0, 0}, {3, 3}});
  const Profile profile({loop, polygon({{5, 5}}), {}}, FillRule::kNonZero);
  ASSERT_EQ(profile.loops().size(), 1u);
  EXPECT_EQ(profile.loops()[0].size(), 3u);
  EXPECT_EQ(profile.pieces().size(), 3u);
}

TEST(Profile, IsTheSameByContent) {
  const Profile a({circle({0, 0}, 2, 3)}, FillRule::kNonZero);
  const Profile b({circle({0, 0}, 2, 3)}, FillRule::kNonZero);
  const Profile other_rule({circle({0, 0}, 2, 3)}, FillRule::kEvenOdd);
  const Profile other_turn({circle({0, 0}, 2, 3, false)}, FillRule::kNonZero);
  const Profile other_size({circle({0, 0}, 2.5, 3)}, FillRule::kNonZero);
  EXPECT_TRUE(same_profile(&a, &b));
  EXPECT_TRUE(same_profile(nullptr, nullptr));
  EXPECT_FALSE(same_profile(&a, nullptr));
  EXPECT_FALSE(same_profile(&a, &other_rule));
  EXPECT_FALSE(same_profile(&a, &other_turn));
  EXPECT_FALSE(same_profile(&a, &other_size));
}

TEST(Profile, MakesSolidsOfFiguresWithAnArea) {
  const auto of = [](const std::vector<Vec2>& points) {
    return std::make_shared<Profile>(std::vector<ProfileLoop>{polygon(points)}, FillRule::kNonZero);
  };
  const auto square = of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_TRUE(is_valid(make_extrusion(square, 0, 1)));
  EXPECT_TRUE(is_valid(make_extrusion(square, 0, 1, 1, 0)));
  EXPECT_TRUE(is_valid(make_revolution(square)));
  EXPECT_FALSE(is_valid(make_extrusion(square, 1, 1)));
  EXPECT_FALSE(is_valid(make_extrusion(square, 0, 1, 0, 0)));
  EXPECT_FALSE(is_valid(make_extrusion(square, 0, 1, -1, 1)));
  EXPECT_FALSE(is_valid(make_extrusion(nullptr, 0, 1)));
  EXPECT_FALSE(is_valid(make_revolution(nullptr)));
  EXPECT_FALSE(is_valid(make_extrusion(of({}), 0, 1)));
  EXPECT_FALSE(is_valid(make_extrusion(of({{0, 0}, {1, 0}}), 0, 1)));
  EXPECT_FALSE(is_valid(make_revolution(of({{-0.1, 0}, {1, 0}, {1, 1}, {0, 1}}))));
}

/// Lines through vertices, along edges and tangent to curves.
TEST(ProfileLines, CrossLoopsAsOftenInBothDirections) {
  std::mt19937 random(6);
  const int figures = test_support::full_run() ? 2000 : 100;
  for (int figure = 0; figure < figures; ++figure) {
    const auto profile = checks::random_profile(random, false);
    const auto& pieces = profile->pieces();
    for (int i = 0; i < 500; ++i) {
      const Profile::Piece& piece = pieces[random() % pieces.size()];
      const Profile::Piece& other = pieces[random() % pieces.size()];
      const Vec2 through = random() % 2 || piece.is_line()
                               ? piece.start
                               : curve_point(piece, {uniform(random, 0, 1), 1});
      Vec2 direction = piece.end - piece.start;
      if (random() % 3 == 0) direction = other.start - piece.start;
      if (random() % 3 == 0) direction = piece.control - piece.start;
      if (random() % 3 == 0) direction = random() % 2 ? Vec2{1, 0} : Vec2{0, -1};
      if (direction == Vec2(0.0)) direction = {0, 1};
      direction = glm::normalize(direction);
      const ProfileLine line{direction, cross(direction, through)};
      int turns = 0, crossings = 0;
      for (const Profile::Piece& each : pieces) {
        for_each_crossing(line, each, [&](double along, int turn) {
          turns += turn;
          ++crossings;
          ASSERT_LT(std::abs(along), 1.5);
        });
      }
      ASSERT_EQ(turns, 0);
      ASSERT_EQ(crossings % 2, 0);
    }
  }
}

}  // namespace
}  // namespace csgcore
