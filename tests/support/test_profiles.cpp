#include "test_profiles.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

namespace test_support {

using csgcore::ProfileEdge;
using Kind = ProfileEdge::Kind;

ProfileLoop polygon_loop(const std::vector<Vec2>& points) {
  ProfileLoop loop;
  for (const Vec2& point : points) loop.push_back({.end = point});
  return loop;
}

namespace {

ProfileEdge arc(const Vec2& center, const Vec2& end) {
  return {.kind = Kind::kArc, .end = end, .control = center};
}

}  // namespace

ProfileLoop circle_loop(const Vec2& center, double radius) {
  const Vec2 right(radius, 0);
  return {arc(center, center - right), arc(center, center + right)};
}

ProfileLoop rectangle_loop(const Vec2& min, const Vec2& max) {
  return polygon_loop({min, {max.x, min.y}, max, {min.x, max.y}});
}

ProfileLoop rounded_loop(const Vec2& min, const Vec2& max, double radius) {
  const double r = radius;
  const auto line = [](double x, double y) { return ProfileEdge{.end = {x, y}}; };
  return {line(max.x - r, min.y), arc({max.x - r, min.y + r}, {max.x, min.y + r}),
          line(max.x, max.y - r), arc({max.x - r, max.y - r}, {max.x - r, max.y}),
          line(min.x + r, max.y), arc({min.x + r, max.y - r}, {min.x, max.y - r}),
          line(min.x, min.y + r), arc({min.x + r, min.y + r}, {min.x + r, min.y})};
}

ProfileLoop star_loop(const Vec2& center, int points, double outer, double inner) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? outer : inner;
    corners.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon_loop(corners);
}

ProfileLoop glyph_loop(const std::vector<Vec2>& points) {
  ProfileLoop loop;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec2& next = points[(i + 1) % points.size()];
    loop.push_back({.kind = Kind::kBezier, .end = 0.5 * (points[i] + next), .control = points[i]});
  }
  return loop;
}

ProfilePointer profile_of(std::vector<ProfileLoop> loops, FillRule fill_rule) {
  return std::make_shared<csgcore::Profile>(std::move(loops), fill_rule);
}

ProfilePointer random_profile(std::mt19937& random, const Vec2& min, const Vec2& max) {
  std::uniform_real_distribution<double> share(0, 1);
  const bool is_even = random() % 2 == 0;
  const auto coordinate = [&](double low, double high) {
    const double value = low + share(random) * (high - low);
    return is_even ? glm::clamp(0.25 * std::round(4 * value), low, high) : value;
  };
  const auto point = [&] {
    const double x = coordinate(min.x, max.x), y = coordinate(min.y, max.y);
    return Vec2(x, y);
  };
  const auto loop = [&]() -> ProfileLoop {
    const Vec2 a = point(), b = point();
    const Vec2 low = glm::min(a, b), high = glm::max(a, b) + Vec2(0.125);
    const Vec2 size = high - low, center = 0.5 * (low + high);
    const double least = std::fmin(size.x, size.y);
    switch (random() % 5) {
      case 0:
        return rounded_loop(low, high, 0.25 * least);
      case 1:
        return circle_loop(center, 0.5 * least);
      case 2:
        return star_loop(center, 3 + int(random() % 5), 0.5 * least, 0.25 * least);
      default: {
        std::vector<Vec2> points;
        const auto count = 3 + random() % 6;
        for (size_t i = 0; i < count; ++i) points.push_back(point());
        return random() % 2 ? polygon_loop(points) : glyph_loop(points);
      }
    }
  };
  for (;;) {
    std::vector<ProfileLoop> loops;
    const auto count = 1 + random() % 3;
    for (size_t i = 0; i < count; ++i) loops.push_back(loop());
    auto profile =
        profile_of(std::move(loops), random() % 2 ? FillRule::kEvenOdd : FillRule::kNonZero);
    if (profile->has_area() && profile->min_x() >= min.x) return profile;
  }
}

}  // namespace test_support
