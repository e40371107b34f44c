#include "nef_lines.hpp"

#include <algorithm>
#include <limits>
#include <random>

namespace oracle {
namespace {

using csgcore::Box;
using csgcore::Vec3;

std::vector<Box> boxes_of(const std::vector<BoundaryTriangle>& triangles) {
  std::vector<Box> boxes;
  for (const BoundaryTriangle& t : triangles) {
    const CGAL::Bbox_3 box = t.triangle.bbox();  // rounded outwards
    boxes.push_back({{box.xmin(), box.ymin(), box.zmin()}, {box.xmax(), box.ymax(), box.zmax()}});
  }
  return boxes;
}

Vec3 rounded(const Point& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// Returns a random direction, so that a line from a point meets an edge only by chance.
Vec3 random_direction(std::minstd_rand& random) {
  Vec3 direction;
  for (int axis = 0; axis < 3; ++axis)
    direction[axis] = 0.25 + static_cast<double>(random()) * 0x1p-31;
  return direction;
}

}  // namespace

NefLines::NefLines(const std::vector<BoundaryTriangle>& triangles, const std::vector<Plane>& planes)
    : triangles_(triangles), planes_(planes), boxes_(boxes_of(triangles)) {}

Number NefLines::parameter(uint32_t plane, const Point& origin, const Vector& direction) const {
  const Plane& p = planes_[plane];
  const Vector normal = p.orthogonal_vector();
  return -(normal * (origin - CGAL::ORIGIN) + p.d()) / (normal * direction);
}

NefLines::Stabbing NefLines::stab(const Point& origin, const Vec3& direction,
                                  double first_s) const {
  Stabbing result;
  std::vector<uint32_t> candidates;
  // (The boxes are wide enough for the rounding of the origin.)
  boxes_.find(rounded(origin), direction, first_s, candidates);
  const Vector along = vector_of(direction);
  const Kernel::Line_3 line(origin, along);
  std::vector<Touch> touches;
  for (const uint32_t candidate : candidates) {
    const auto& [triangle, plane] = triangles_[candidate];
    if (!CGAL::do_intersect(line, triangle)) continue;
    const CGAL::Sign ascent = CGAL::sign(planes_[plane].orthogonal_vector() * along);
    if (ascent == CGAL::ZERO) {
      result.runs_along = true;
    } else {
      touches.push_back({parameter(plane, origin, along), plane, ascent == CGAL::NEGATIVE});
    }
  }
  std::sort(touches.begin(), touches.end(),
            [](const Touch& a, const Touch& b) { return a.s < b.s; });
  // At an edge or a vertex the line touches several planes. Inside a facet it touches only that of
  // the facet, even where two of its triangles meet.
  for (const Touch& touch : touches) {
    if (result.events.empty() || result.events.back().s != touch.s) {
      result.events.push_back({touch.s, touch.plane, true, touch.enters});
    } else if (result.events.back().plane != touch.plane) {
      result.events.back().is_simple = false;
    }
  }
  return result;
}

Place NefLines::locate(const Point& point) const {
  std::minstd_rand random;
  for (;;) {
    const Stabbing stabbing = stab(point, random_direction(random), 0);
    const auto first = std::find_if(stabbing.events.begin(), stabbing.events.end(),
                                    [](const Event& event) { return event.s >= 0; });
    if (first != stabbing.events.end() && first->s == 0) return Place::kBoundary;
    if (stabbing.runs_along) continue;
    if (first == stabbing.events.end()) return Place::kOutside;
    if (first->is_simple) return first->enters ? Place::kOutside : Place::kInside;
  }
}

std::vector<Crossing> NefLines::crossings(const Point& origin, const Vec3& direction) const {
  const Stabbing stabbing = stab(origin, direction, -kInfinity);
  const std::vector<Event>& events = stabbing.events;
  const bool runs_along = stabbing.runs_along;
  const Vector along = vector_of(direction);
  const auto place_after = [&](size_t i) {
    if (events[i].is_simple && !runs_along) {
      return events[i].enters ? Place::kInside : Place::kOutside;
    }
    if (i + 1 == events.size()) return Place::kOutside;
    return locate(origin + (events[i].s + events[i + 1].s) / 2 * along);
  };
  std::vector<Crossing> result;
  Place place = Place::kOutside;
  for (size_t i = 0; i < events.size(); ++i) {
    const Place after = place_after(i);
    if (after != place) {
      const auto [lower, upper] = CGAL::to_interval(events[i].s);
      result.push_back({lower, upper, after, events[i].plane, events[i].is_simple && !runs_along});
    }
    place = after;
  }
  return result;
}

}  // namespace oracle
