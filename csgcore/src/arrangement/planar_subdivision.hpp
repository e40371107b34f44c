// A triangulation of a plane region, into which points and lines are inserted exactly.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "arrangement/exact_point.hpp"
#include "arrangement/facet_grid.hpp"

namespace csgcore {

/// A point of the arrangement, which its name defines. A corner is on the grid.
struct ArrangedPoint {
  PointName name;
  Vec3 position{0.0};  // exact on the grid, else off by less than kPointError
};

ArrangedPoint arranged_point(const Facets& facets, const PointName& name);
ArrangedPoint grid_point(const PointName& name, const GridPoint& point);
ExactPoint exact_point(const Facets& facets, const ArrangedPoint& point);

/// turn() of points of the arrangement.
int turn(const Facets& facets, const ArrangedPoint& a, const ArrangedPoint& b,
         const ArrangedPoint& c, int axis);

class PlanarSubdivision {
 public:
  struct Triangle {
    std::array<uint32_t, 3> points;  // counterclockwise in the drawing
    /// By edge, from each point to the next: the triangle beyond it or kNoPlace, and the first of
    /// its lines in a list of links, or kNoPlace.
    std::array<uint32_t, 3> beyond{kNoPlace, kNoPlace, kNoPlace};
    std::array<uint32_t, 3> lines{kNoPlace, kNoPlace, kNoPlace};
  };
  struct Link {
    uint32_t line;
    uint32_t next;
  };
  /// Another name of a point that is there already.
  struct Alias {
    uint32_t point;
    PointName name;
  };
  /// Returns the point in which two lines cross, and other names that it has.
  using Meet =
      std::function<ArrangedPoint(uint32_t line, uint32_t other, std::vector<PointName>& aliases)>;

  /// The drawing is along the axis. The first triangle's points lie around all that is inserted,
  /// in either direction.
  PlanarSubdivision(const Facets& facets, int axis, Meet meet)
      : facets_(facets), axis_(axis), meet_(std::move(meet)) {}
  /// Starts anew with a triangle.
  void start(const ArrangedPoint& a, const ArrangedPoint& b, const ArrangedPoint& c);
  /// Starts anew with the rectangle that a box has in the drawing, whose corners have the first
  /// kBorderPoints numbers, and no names.
  void start_around(const GridPoint& least, const GridPoint& most);
  static constexpr uint32_t kBorderPoints = 4;

  /// Returns the number of the point, which may be there already.
  uint32_t insert(const ArrangedPoint& point);
  /// Makes the segment between two points a chain of edges of the line.
  void draw(uint32_t from, uint32_t to, uint32_t line);

  int axis() const { return axis_; }
  /// Returns a triangle at the border.
  uint32_t border_triangle() const;
  const std::vector<ArrangedPoint>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Link>& links() const { return links_; }
  const std::vector<Alias>& aliases() const { return aliases_; }

 private:
  struct Place {
    uint32_t triangle;
    size_t edge;
  };
  struct Segment {
    uint32_t from;
    uint32_t to;
    uint32_t line;
  };
  int turn_of(uint32_t a, uint32_t b, uint32_t c) const {
    return turn(facets_, points_[a], points_[b], points_[c], axis_);
  }
  uint32_t add_point(const ArrangedPoint& point);
  uint32_t add_triangle(const Triangle& triangle);
  void set(uint32_t number, const Triangle& triangle);
  void join(uint32_t triangle, uint32_t before, uint32_t after);
  size_t edge_towards(uint32_t triangle, uint32_t beyond) const;
  void divide_triangle(uint32_t triangle, uint32_t point);
  void divide_edge(Place edge, uint32_t point);
  bool can_flip(Place edge) const;
  void flip(Place edge);
  void make_delaunay(uint32_t point);
  bool is_in_circle(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const;
  template <class Visit>
  void visit_around(uint32_t point, Visit visit) const;
  Place find_edge(uint32_t from, uint32_t to) const;
  void add_line(Place edge, uint32_t line);
  void draw_step(const Segment& segment);
  void clear_way(std::vector<std::array<uint32_t, 2>>& crossed, const Segment& segment);

  const Facets& facets_;
  int axis_;
  Meet meet_;
  std::vector<ArrangedPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> triangle_at_;  // by point: one that has it
  std::vector<Link> links_;
  std::vector<Alias> aliases_;
  std::vector<Segment> open_;      // segments that are yet to be drawn
  std::vector<Place> suspicious_;  // edges that may not be Delaunay's
  uint32_t last_ = 0;              // the triangle in which the last search ended
  uint32_t steps_ = 0;
};

}  // namespace csgcore
