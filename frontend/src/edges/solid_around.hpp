// How a solid looks around a point of a line.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edges/bodies.hpp"
#include "edges/tree_value.hpp"

namespace frontend {

/// The boundary of the solid where it is cut across a line that lies in faces.
enum class CrossSection : uint8_t {
  kNone,  // the line does not lie in the boundary
  kFlat,  // the boundary runs straight on through the line
  kEdge,
};

class SolidAround {
 public:
  /// `bodies` must be those of `design`, and outlive this object. `steps` is counted up by about
  /// one for each plane or box that a point is compared with.
  SolidAround(const ImportedDesign& design, std::span<const Body> bodies, uint64_t& steps);

  /// Looks across a line of unit `direction` at a point, in the interior of a piece of the line on
  /// which no body begins or ends. The point must lie in the box of `owner`. Every plane through
  /// the point divides its surroundings in two halves, so that the planes' traces across the line
  /// divide them into sectors, in each of which the solid is everywhere or nowhere.
  CrossSection across(const Body& owner, const csgcore::Vec3& point,
                      const csgcore::Vec3& direction);

  /// Returns whether OpenSCAD gives an edge or a vertex the colours of cut faces: if the point is
  /// left out by the operations on closed solids, as by a difference on the surface of what it
  /// takes away.
  bool is_cut(const Body& owner, const csgcore::Vec3& point);

 private:
  /// A plane through the point: the angle of its normal across the line, and the body it bounds.
  struct Trace {
    uint32_t place;  // in near_
    double x, y;     // the normal across the line
  };
  void gather(const Body& owner, const csgcore::Vec3& point);
  void look_at(const Body& body, const csgcore::Vec3& point);
  enum class Position : uint8_t { kOutside, kInside /* or on the surface */ };
  Position position_of(const Body& body, const csgcore::Vec3& point);
  void forget();
  bool is_solid_at(double angle_rad);

  std::span<const Body> bodies_;
  TreeValue tree_;
  uint64_t& steps_;
  // What is known of the point that is being looked at:
  std::vector<uint32_t> near_;  // the primitives of the closed bodies that hold the point
  struct Through {
    uint32_t place;  // in near_
    csgcore::Vec3 normal;
  };
  std::vector<Through> through_;  // the planes of these bodies through the point
  std::vector<Trace> traces_;
  std::vector<uint8_t> is_outside_;  // by place in near_
  std::vector<double> angles_rad_;
};

}  // namespace frontend
