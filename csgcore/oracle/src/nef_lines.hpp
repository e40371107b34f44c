// Exact queries of lines and points against the boundary of a solid.
#pragma once

#include <optional>
#include <vector>

#include "box_tree.hpp"
#include "nef_boundary.hpp"

namespace oracle {

struct BoundaryTriangle {
  Kernel::Triangle_3 triangle;
  uint32_t plane;
};

/// All answers are exact. Any number of threads may call its functions.
class NefLines {
 public:
  /// Keeps references to both arguments, which must not change while it lives. The planes' normals
  /// point out of the solid.
  NefLines(const std::vector<BoundaryTriangle>& triangles, const std::vector<Plane>& planes);

  Place locate(const Point& point) const;
  /// Returns the crossings of the line origin + s·direction, in ascending order of s.
  std::vector<Crossing> crossings(const Point& origin, const csgcore::Vec3& direction) const;

  Number parameter(uint32_t plane, const Point& origin, const Vector& direction) const;

 private:
  /// A point at which a line meets a facet.
  struct Touch {
    Number s;
    uint32_t plane;
    bool enters;
  };
  /// All touches at one point of the line.
  struct Event {
    Number s;
    uint32_t plane;
    bool is_simple;  // one facet is met, in its interior
    bool enters;     // if is_simple
  };
  struct Stabbing {
    std::vector<Event> events;  // in ascending order of s
    bool runs_along = false;    // the line runs within a facet somewhere
  };
  Stabbing stab(const Point& origin, const csgcore::Vec3& direction, double first_s) const;

  const std::vector<BoundaryTriangle>& triangles_;
  const std::vector<Plane>& planes_;
  BoxTree boxes_;
};

}  // namespace oracle
