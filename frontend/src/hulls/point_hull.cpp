#include "hulls/point_hull.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "csgcore/stop_scope.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;
using Triangle = PointHull::Triangle;

constexpr uint32_t kNone = 0xFFFFFFFFu;

/// Exact, and so are the differences of places.
Vec3 place_of(const GridPoint& point) {
  return {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
}

Vec3 vector_of(const GridPoint& from, const GridPoint& to) { return place_of(to) - place_of(from); }

/// Points that span the hull's dimension: at most four.
struct Simplex {
  std::array<uint32_t, 4> points{};
  int count = 0;
};

/// Quickhull (Barber, Dobkin, Huhdanpaa 1996) with exact predicates: each face keeps the points
/// that lie beyond it, and the furthest of them becomes a corner.
class Quickhull {
 public:
  explicit Quickhull(const std::vector<GridPoint>& points) : points_(points) {
    places_.reserve(points.size());
    for (const GridPoint& point : points) places_.push_back(place_of(point));
  }

  void run(const Simplex& simplex) {
    start(simplex);
    for (uint32_t i = 0; i < faces_.size(); ++i) {
      csgcore::stop_point();
      // New faces come last; a face that was replaced has no points.
      if (faces_[i].first_beyond != kNone) add_corner(i);
    }
  }

  void write(PointHull& hull) const {
    std::vector<uint32_t> place(faces_.size(), kNone);
    uint32_t count = 0;
    for (size_t i = 0; i < faces_.size(); ++i) {
      if (faces_[i].is_alive) place[i] = count++;
    }
    std::vector<bool> is_corner(points_.size());
    for (const Face& face : faces_) {
      if (!face.is_alive) continue;
      hull.triangles.push_back(face.corners);
      Triangle& neighbors = hull.neighbors.emplace_back();
      for (size_t k = 0; k < 3; ++k) {
        neighbors[k] = place[face.neighbors[k]];
        is_corner[face.corners[k]] = true;
      }
    }
    for (uint32_t i = 0; i < points_.size(); ++i) {
      if (is_corner[i]) hull.corners.push_back(i);
    }
  }

 private:
  struct Face {
    Triangle corners{};
    Triangle neighbors{};
    Vec3 normal{0.0};
    Vec3 bound{0.0};                // what the rounding of `normal` is a share of
    uint32_t first_beyond = kNone;  // the first of the points on the outer side (next_)
    bool is_alive = true;
    bool is_visible = false;  // from the point that is being added
  };
  static constexpr size_t kMostReserved = 1 << 10;

  struct HorizonEdge {
    uint32_t from, to, outer;
  };

  Face face_of(const Triangle& corners) const {
    Face face;
    face.corners = corners;
    const Vec3 u = places_[corners[1]] - places_[corners[0]];
    const Vec3 v = places_[corners[2]] - places_[corners[0]];
    face.normal = glm::cross(u, v);
    const Vec3 a = glm::abs(u), b = glm::abs(v);
    face.bound = Vec3(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
    return face;
  }

  double height(const Face& face, uint32_t point) const {
    return glm::dot(face.normal, places_[point] - places_[face.corners[0]]);
  }

  bool sees(uint32_t point, const Face& face) const {
    const Vec3 offset = places_[point] - places_[face.corners[0]];
    const double height = glm::dot(face.normal, offset);
    // Six roundings of 2^-53 each, and some room.
    constexpr double kRounding = 0x1p-49;
    if (std::abs(height) > kRounding * glm::dot(face.bound, glm::abs(offset))) return height > 0;
    return orientation(points_[face.corners[0]], points_[face.corners[1]], points_[face.corners[2]],
                       points_[point]) > 0;
  }

  void start(const Simplex& simplex) {
    auto [a, b, c, d] = simplex.points;
    if (orientation(points_[a], points_[b], points_[c], points_[d]) > 0) std::swap(b, c);
    // a b c is seen from outside, and d lies behind it.
    faces_ = {face_of({a, b, c}), face_of({b, a, d}), face_of({c, b, d}), face_of({a, c, d})};
    faces_[0].neighbors = {1, 2, 3};
    faces_[1].neighbors = {0, 3, 2};
    faces_[2].neighbors = {0, 1, 3};
    faces_[3].neighbors = {0, 2, 1};
    // Each corner replaces some faces by two more.
    faces_.reserve(std::min(points_.size(), kMostReserved) * 4);
    start_of_.assign(points_.size(), kNone);
    next_.resize(points_.size());
    for (uint32_t i = 0; i < points_.size(); ++i) give_to_face(i, 0);
  }

  /// Gives the point to one of the faces from `first` on that it lies beyond, if there is one.
  void give_to_face(uint32_t point, uint32_t first) {
    for (uint32_t i = first; i < faces_.size(); ++i) {
      Face& face = faces_[i];
      if (!sees(point, face)) continue;
      next_[point] = face.first_beyond;
      face.first_beyond = point;
      return;
    }
  }

  /// The point beyond the face that is furthest from it.
  uint32_t furthest_beyond(const Face& face) const {
    uint32_t best = face.first_beyond;
    double most = height(face, best);
    for (uint32_t point = next_[best]; point != kNone; point = next_[point]) {
      const double here = height(face, point);
      if (here <= most) continue;
      most = here;
      best = point;
    }
    return best;
  }

  void add_corner(uint32_t start) {
    const uint32_t corner = furthest_beyond(faces_[start]);
    find_visible(start, corner);
    points_to_give_.clear();
    for (const uint32_t face : visible_) {
      faces_[face].is_alive = false;
      for (uint32_t p = faces_[face].first_beyond; p != kNone; p = next_[p]) {
        if (p != corner) points_to_give_.push_back(p);
      }
      faces_[face].first_beyond = kNone;
    }
    const auto first = static_cast<uint32_t>(faces_.size());
    for (const HorizonEdge& edge : horizon_) {
      start_of_[edge.from] = static_cast<uint32_t>(faces_.size());
      faces_.push_back(face_of({edge.from, edge.to, corner}));
    }
    for (uint32_t i = 0; i < horizon_.size(); ++i) link(horizon_[i], first + i);
    for (const uint32_t point : points_to_give_) give_to_face(point, first);
  }

  /// The visible faces are connected, and the horizon around them is one simple loop.
  void find_visible(uint32_t start, uint32_t corner) {
    visible_ = {start};
    horizon_.clear();
    faces_[start].is_visible = true;
    for (size_t next = 0; next < visible_.size(); ++next) {
      const uint32_t at = visible_[next];
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t other = faces_[at].neighbors[k];
        if (faces_[other].is_visible) continue;
        if (sees(corner, faces_[other])) {
          faces_[other].is_visible = true;
          visible_.push_back(other);
        } else {
          const Triangle& corners = faces_[at].corners;
          horizon_.push_back({corners[k], corners[(k + 1) % 3], other});
        }
      }
    }
  }

  void link(const HorizonEdge& edge, uint32_t face) {
    const uint32_t next = start_of_[edge.to];
    faces_[face].neighbors[0] = edge.outer;
    faces_[face].neighbors[1] = next;
    faces_[next].neighbors[2] = face;
    Face& outer = faces_[edge.outer];
    for (size_t k = 0; k < 3; ++k) {
      if (outer.corners[k] == edge.to && outer.corners[(k + 1) % 3] == edge.from) {
        outer.neighbors[k] = face;
      }
    }
  }

  const std::vector<GridPoint>& points_;
  std::vector<Vec3> places_;  // of the points
  std::vector<Face> faces_;
  std::vector<uint32_t> next_;  // by point: the next one beyond the same face
  // Buffers of add_corner().
  std::vector<uint32_t> visible_, points_to_give_;
  std::vector<HorizonEdge> horizon_;
  std::vector<uint32_t> start_of_;  // by point: the new face whose horizon edge starts there
};

/// Returns the point for which `measure` is largest, or nothing if it is 0 for all.
template <typename Measure>
std::optional<uint32_t> furthest(size_t count, const Measure& measure) {
  std::optional<uint32_t> best;
  double largest = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const double value = measure(i);
    if (value <= largest) continue;
    largest = value;
    best = i;
  }
  return best;
}

Simplex simplex_of(const std::vector<GridPoint>& points) {
  Simplex simplex;
  if (points.empty()) return simplex;
  const auto add = [&](uint32_t point) {
    simplex.points[static_cast<size_t>(simplex.count++)] = point;
  };
  const auto [least, most] = std::minmax_element(points.begin(), points.end());
  add(static_cast<uint32_t>(least - points.begin()));
  if (*least == *most) return simplex;
  add(static_cast<uint32_t>(most - points.begin()));
  const GridPoint& a = *least;
  const GridPoint& b = *most;
  const Vec3 line = vector_of(a, b);
  const auto c = furthest(points.size(), [&](uint32_t i) {
    if (are_collinear(a, b, points[i])) return 0.0;
    const Vec3 across = glm::cross(line, vector_of(a, points[i]));
    // Above 0 in any case: it is not on the line.
    return std::max(glm::dot(across, across), std::numeric_limits<double>::min());
  });
  if (!c) return simplex;
  add(*c);
  const Vec3 normal = normal_of(a, b, points[*c]);
  const auto d = furthest(points.size(), [&](uint32_t i) {
    if (orientation(a, b, points[*c], points[i]) == 0) return 0.0;
    const double height = std::abs(glm::dot(normal, vector_of(a, points[i])));
    return std::max(height, std::numeric_limits<double>::min());
  });
  if (d) add(*d);
  return simplex;
}

/// Returns the points of a plane or a line that no point is further from than `flat_thickness` of
/// the size; where there is none, the given points of a solid. The given ones do not tell: they may
/// lie close together.
Simplex flattened(const std::vector<GridPoint>& points, const Simplex& solid,
                  double flat_thickness) {
  csgcore::Box box;
  for (const GridPoint& point : points) box.merge(place_of(point));
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto ends = std::minmax_element(points.begin(), points.end(),
                                        [axis](const GridPoint& a, const GridPoint& b) {
                                          return place_of(a)[axis] < place_of(b)[axis];
                                        });
  const GridPoint& least = *ends.first;
  const GridPoint& most = *ends.second;
  Simplex flat;
  const auto add = [&](uint32_t point) { flat.points[static_cast<size_t>(flat.count++)] = point; };
  add(static_cast<uint32_t>(ends.first - points.begin()));
  add(static_cast<uint32_t>(ends.second - points.begin()));
  const Vec3 line = glm::normalize(vector_of(least, most));
  const auto from_line = [&](uint32_t i) {
    return glm::length(glm::cross(line, vector_of(least, points[i])));
  };
  const double thickness = flat_thickness * size[axis];
  const auto third = furthest(points.size(), from_line);
  if (!third || from_line(*third) <= thickness) return flat;
  add(*third);
  const Vec3 normal = glm::normalize(normal_of(least, most, points[*third]));
  const auto from_plane = [&](uint32_t i) {
    return std::abs(glm::dot(normal, vector_of(least, points[i])));
  };
  const auto fourth = furthest(points.size(), from_plane);
  return !fourth || from_plane(*fourth) <= thickness ? flat : solid;
}

/// The corners of points in one plane, or nearly, around it: Andrew's chains, in the coordinate
/// plane that the points' plane is nearest to.
std::vector<uint32_t> polygon_of(const std::vector<GridPoint>& points, const Simplex& simplex) {
  const Vec3 normal =
      normal_of(points[simplex.points[0]], points[simplex.points[1]], points[simplex.points[2]]);
  const Vec3 size = glm::abs(normal);
  const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  // Every point moves into that plane; orientation() then needs a point beside it.
  const auto flat = [dropped](GridPoint point) {
    (dropped == 0 ? point.x : dropped == 1 ? point.y : point.z) = 0;
    return point;
  };
  std::vector<uint32_t> order(points.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(flat(points[a]), a) < std::pair(flat(points[b]), b);
  });
  const auto turns_left = [&](uint32_t a, uint32_t b, uint32_t c) {
    const GridPoint from = flat(points[a]);
    GridPoint above = from;
    (dropped == 0 ? above.x : dropped == 1 ? above.y : above.z) += 1;
    return orientation(from, flat(points[b]), flat(points[c]), above) > 0;
  };
  std::vector<uint32_t> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const size_t first = hull.size();
    for (auto at = begin; at != end; ++at) {
      while (hull.size() >= first + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *at)) {
        hull.pop_back();
      }
      if (hull.size() > first && flat(points[hull.back()]) == flat(points[*at])) continue;
      hull.push_back(*at);
    }
    hull.pop_back();  // the other chain starts there
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return hull;
}

}  // namespace

PointHull point_hull(const PointGrid& grid, double flat_thickness) {
  PointHull hull;
  Simplex simplex = simplex_of(grid.points);
  if (simplex.count == 4 && flat_thickness > 0) {
    simplex = flattened(grid.points, simplex, flat_thickness);
  }
  hull.dimension = simplex.count - 1;
  if (hull.dimension == 3) {
    Quickhull quickhull(grid.points);
    quickhull.run(simplex);
    quickhull.write(hull);
  } else if (hull.dimension == 2) {
    hull.corners = polygon_of(grid.points, simplex);
  } else {
    hull.corners.assign(simplex.points.begin(), simplex.points.begin() + simplex.count);
  }
  return hull;
}

}  // namespace frontend
