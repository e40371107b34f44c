// Lines and points against the boundary of a solid.
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

/// All answers are exact. Any number of threads may ask.
class NefLines {
 public:
  /// Neither may change while this lives. Planes' normals point out of the solid.
  NefLines(const std::vector<BoundaryTriangle>& triangles, const std::vector<Plane>& planes);

  Place locate(const Point& point) const;
  /// Of the line origin + s·direction, in rising order of s.
  std::vector<Crossing> crossings(const Point& origin, const csgcore::Vec3& direction) const;

  Number parameter(uint32_t plane, const Point& origin, const Vector& direction) const;

 private:
  /// Where a line meets a facet's plane, within the facet.
  struct Touch {
    Number s;
    uint32_t plane;
    bool enters;
  };
  /// Those of one point of the line.
  struct Event {
    Number s;
    uint32_t plane;
    bool is_simple;  // one facet, within
    bool enters;     // if it is simple
  };
  struct Stabbing {
    std::vector<Event> events;  // in rising order of s
    bool runs_along = false;    // in a facet somewhere
  };
  Stabbing stab(const Point& origin, const csgcore::Vec3& direction, double first_s) const;

  const std::vector<BoundaryTriangle>& triangles_;
  const std::vector<Plane>& planes_;
  BoxTree boxes_;
};

}  // namespace oracle
