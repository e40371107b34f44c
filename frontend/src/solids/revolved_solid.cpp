#include "solids/revolved_solid.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "csgcore/triangle_mesh.hpp"
#include "language/degrees.hpp"
#include "meshes/triangulation.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

class RevolvedMesh {
 public:
  RevolvedMesh(const SimplePolygons& polygons, const TurnSections& sections)
      : sections_(sections), ring_count_(sections.count + (sections.is_closed() ? 0 : 1)) {
    const bool is_left = bounds_of(polygons).min.x < 0;
    const bool is_reversed = (sections.angle > 0 && !sections.is_closed()) != is_left;
    for (const Polygon& polygon : polygons) add_polygon(polygon, is_reversed);
    add_vertices();
  }

  csgcore::Primitive make() {
    for (int ring = 0; ring < sections_.count; ++ring) {
      add_section(rings_[static_cast<size_t>(ring)],
                  rings_[static_cast<size_t>((ring + 1) % ring_count_)]);
    }
    if (!sections_.is_closed()) {
      add_cap(rings_.front(), true);
      add_cap(rings_.back(), false);
    }
    return csgcore::make_mesh(
        std::make_shared<csgcore::TriangleMesh>(std::move(vertices_), std::move(triangles_)));
  }

 private:
  using Ring = std::vector<uint32_t>;  // by point: its vertex

  /// Points at one place have one number.
  void add_polygon(const Polygon& polygon, bool is_reversed) {
    const size_t first = corners_.size();
    for (const Vec2& point : polygon) {
      const auto [entry, is_new] =
          number_of_.try_emplace({point.x, point.y}, static_cast<uint32_t>(points_.size()));
      if (is_new) points_.push_back(point);
      corners_.push_back(entry->second);
    }
    if (is_reversed) {
      std::reverse(corners_.begin() + static_cast<std::ptrdiff_t>(first), corners_.end());
    }
    ends_.push_back(static_cast<uint32_t>(corners_.size()));
  }

  void add_vertices() {
    rings_.resize(static_cast<size_t>(ring_count_));
    for (int i = 0; i < ring_count_; ++i) {
      Ring& ring = rings_[static_cast<size_t>(i)];
      const double azimuth = sections_.azimuth(i);
      for (size_t point = 0; point < points_.size(); ++point) {
        const Vec2& at = points_[point];
        if (at.x == 0 && i > 0) {
          ring.push_back(rings_.front()[point]);  // the rings share what lies on the axis
          continue;
        }
        ring.push_back(static_cast<uint32_t>(vertices_.size()));
        vertices_.emplace_back(at.x * language::cosine_of_degrees(azimuth),
                               at.x * language::sine_of_degrees(azimuth), at.y);
      }
    }
  }

  void add_section(const Ring& from, const Ring& to) {
    uint32_t first = 0;
    for (const uint32_t end : ends_) {
      for (uint32_t i = first; i < end; ++i) {
        const uint32_t p = corners_[i], q = corners_[i + 1 < end ? i + 1 : first];
        triangles_.push_back({from[p], from[q], to[q]});
        triangles_.push_back({from[p], to[q], to[p]});
      }
      first = end;
    }
  }

  void add_cap(const Ring& ring, bool is_first) {
    Ring corners;
    std::vector<Vec2> places;
    for (const uint32_t point : corners_) {
      corners.push_back(ring[point]);
      places.push_back(points_[point]);
    }
    const auto close = is_first ? triangulate_all_reversed : triangulate_all;
    close(corners, ends_, places, triangles_);
  }

  const TurnSections& sections_;
  int ring_count_;
  std::map<std::pair<double, double>, uint32_t> number_of_;
  std::vector<Vec2> points_;
  std::vector<uint32_t> corners_, ends_;  // of the polygons: points by their numbers
  std::vector<Ring> rings_;
  std::vector<Vec3> vertices_;
  std::vector<csgcore::TriangleMesh::Triangle> triangles_;
};

}  // namespace

csgcore::Primitive revolved_mesh(const SimplePolygons& polygons, const TurnSections& sections) {
  return RevolvedMesh(polygons, sections).make();
}

}  // namespace frontend
