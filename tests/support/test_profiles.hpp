// Profiles for tests.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include "csgcore/profile.hpp"

namespace test_support {

using csgcore::FillRule;
using csgcore::ProfileLoop;
using csgcore::Vec2;
using ProfilePointer = std::shared_ptr<const csgcore::Profile>;

/// Loops begin at their last edge's end.
ProfileLoop polygon_loop(const std::vector<Vec2>& points);
/// Two half circles, counterclockwise.
ProfileLoop circle_loop(const Vec2& center, double radius);
ProfileLoop rectangle_loop(const Vec2& min, const Vec2& max);
/// Lines, and quarters of circles of that radius.
ProfileLoop rounded_loop(const Vec2& min, const Vec2& max, double radius);
/// A star of `points` points about a centre.
ProfileLoop star_loop(const Vec2& center, int points, double outer, double inner);
/// Quadratic Béziers through the middles of a polygon's sides, whose control points are its
/// corners: a glyph's outline.
ProfileLoop glyph_loop(const std::vector<Vec2>& points);

ProfilePointer profile_of(std::vector<ProfileLoop> loops, FillRule fill_rule = FillRule::kEvenOdd);

/// Random loops of all sorts within `min` and `max`, which may cross each other. Coordinates are
/// often multiples of a quarter.
ProfilePointer random_profile(std::mt19937& random, const Vec2& min, const Vec2& max);

}  // namespace test_support
