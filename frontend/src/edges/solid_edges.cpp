#include "frontend/solid_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "edges/bodies.hpp"
#include "edges/corners.hpp"
#include "edges/face_crossings.hpp"
#include "edges/solid_around.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Vec3;

/// Pieces of edges that are no longer than this share of the largest coordinate are left out, and
/// ends of edges that are no further from each other are one vertex.
constexpr double kShortest = 1e-7;
/// OpenSCAD cuts the coordinates of operands to multiples of this (frontend/OPENSCAD.md).
constexpr double kGrid = 1.0 / (1 << 20);
/// An edge through a smooth body is tested in so many parts.
constexpr int kSmoothParts = 16;

__extension__ using Exact = __int128;

/// Returns six times the volume of the tetrahedron between a point and three others, given as
/// vectors of whole numbers from it. Exact if these are below 2^40.
Exact volume(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto minor = [](double p, double q, double r, double s) {
    return Exact(p) * Exact(s) - Exact(q) * Exact(r);
  };
  return Exact(a.x) * minor(b.y, b.z, c.y, c.z) - Exact(a.y) * minor(b.x, b.z, c.x, c.z) +
         Exact(a.z) * minor(b.x, b.y, c.x, c.y);
}

/// Returns the diagonal of a quadrilateral that is an edge in OpenSCAD's final solid, which is the
/// convex hull of the corners after these are cut to a grid: the one that runs further out. Nothing
/// if the corners lie in one plane there.
std::optional<std::array<uint32_t, 2>> bent_diagonal(const Body& body,
                                                     const FacetMesh::Edge& edge) {
  const auto cut = [&](uint32_t vertex) { return glm::trunc(body.vertices[vertex] / kGrid); };
  const Vec3 origin = cut(edge.from);
  const Vec3 a = cut(edge.to) - origin;
  const Vec3 b = cut(edge.left) - origin;
  const Vec3 c = cut(edge.right) - origin;
  constexpr double kLargest = 1e12;
  for (const Vec3& v : {a, b, c}) {
    if (!(std::abs(v.x) + std::abs(v.y) + std::abs(v.z) < kLargest)) {
      return std::array{edge.from, edge.to};
    }
  }
  const Exact bend = volume(a, b, c);
  if (bend == 0) return std::nullopt;
  const Vec3 outwards = body.vertices[edge.from] - body.box.center();
  const bool is_ridge = (bend < 0) == (glm::dot(glm::cross(a, b), outwards) > 0);
  return is_ridge ? std::array{edge.from, edge.to} : std::array{edge.left, edge.right};
}

double largest_coordinate(std::span<const Body> bodies) {
  double largest = 0;
  for (const Body& body : bodies) {
    for (int axis = 0; axis < 3; ++axis) {
      largest = std::max({largest, std::abs(body.box.min[axis]), std::abs(body.box.max[axis])});
    }
  }
  return largest;
}

class EdgeSearch {
 public:
  EdgeSearch(const ImportedDesign& design, uint64_t most_steps)
      : bodies_(bodies_of(design)),
        around_(design, bodies_, steps_),
        shortest_(kShortest * largest_coordinate(bodies_)),
        corners_(shortest_),
        most_steps_(most_steps) {}

  SolidEdges find() {
    for (uint32_t i = 0; i < bodies_.size() && is_within_limit(); ++i) {
      if (bodies_[i].mesh) look_at(i);
    }
    result_.is_complete = is_within_limit();
    corners_.for_each_vertex([&](const Vec3& position, uint32_t owner) {
      result_.vertices.push_back({position, around_.is_cut(bodies_[owner], position)});
    });
    return std::move(result_);
  }

 private:
  bool is_within_limit() const { return steps_ < most_steps_; }

  void look_at(uint32_t index) {
    const Body& body = bodies_[index];
    for (const FacetMesh::Edge& edge : body.mesh->edges) {
      if (!is_within_limit()) return;
      if (!edge.is_diagonal()) {
        add(index, body.vertices[edge.from], body.vertices[edge.to], false);
      } else if (const auto ends = bent_diagonal(body, edge)) {
        add(index, body.vertices[ends->front()], body.vertices[ends->back()], true);
      }
    }
    for (const uint32_t other : body.neighbours) {
      if (other < index || !bodies_[other].mesh) continue;
      cross_faces(body, bodies_[other], steps_, [&](const Vec3& from, const Vec3& to) {
        add(index, from, to, false);
        return is_within_limit();
      });
    }
  }

  /// Adds what belongs to the solid of a line that lies in faces of the owner. On the pieces
  /// between the places at which other bodies begin or end, the solid looks the same. `is_crease`:
  /// the line is an edge also where the boundary runs straight on.
  void add(uint32_t owner, const Vec3& from, const Vec3& to, bool is_crease) {
    const Body& body = bodies_[owner];
    const double length = glm::distance(from, to);
    if (!(length > shortest_)) return;
    const Vec3 direction = (to - from) / length;
    find_cuts(body, from, to);
    const auto at = [&](double t) { return from + t * (to - from); };
    bool is_open = false;  // an edge has begun and not ended yet
    double begin = 0, end = 0;
    bool was_cut = false;
    const auto finish = [&] {
      if (is_open) result_.edges.push_back({at(begin), at(end), was_cut});
      is_open = false;
    };
    double last = 0;
    for (const double t : cuts_) {
      if ((t - last) * length <= shortest_) continue;
      const Vec3 middle = at((last + t) / 2);
      const CrossSection section = around_.across(body, middle, direction);
      const bool is_edge =
          section == CrossSection::kEdge || (section == CrossSection::kFlat && is_crease);
      if (is_edge) {
        const bool is_cut = around_.is_cut(body, middle);
        if (is_open && is_cut != was_cut) finish();
        if (!is_open) begin = last;
        is_open = true;
        was_cut = is_cut;
        end = t;
        // Also within the edge, where another primitive's edge along the same line may end.
        corners_.add(at(last), direction, owner);
        corners_.add(at(t), -direction, owner);
      } else {
        finish();
      }
      last = t;
    }
    finish();
  }

  /// Sets cuts_ to places on the line, from 0 to 1. All at which bodies begin or end are among
  /// them, and the last is 1.
  void find_cuts(const Body& body, const Vec3& from, const Vec3& to) {
    cuts_.assign(1, 1);
    Box box;
    box.merge(from);
    box.merge(to);
    for (const uint32_t neighbour : body.neighbours) {
      const Body& other = bodies_[neighbour];
      ++steps_;
      if (!touch(other.box, box, other.tolerance)) continue;
      if (!other.mesh) {
        for (int i = 1; i < kSmoothParts; ++i) cuts_.push_back(double(i) / kSmoothParts);
        continue;
      }
      // The line enters and leaves the body in faces near it. More cuts do no harm.
      other.faces.for_each_near(box, other.tolerance, steps_, [&](uint32_t face) {
        const double a = other.planes[face].above(from);
        const double b = other.planes[face].above(to);
        if (std::abs(a) <= other.tolerance && std::abs(b) <= other.tolerance) return;
        const double t = a / (a - b);
        if (t > 0 && t < 1) cuts_.push_back(t);
      });
    }
    std::sort(cuts_.begin(), cuts_.end());
  }

  uint64_t steps_ = 0;
  std::vector<Body> bodies_;
  SolidAround around_;
  double shortest_;
  CornerSet corners_;
  uint64_t most_steps_;
  SolidEdges result_;
  std::vector<double> cuts_;
};

}  // namespace

SolidEdges solid_edges(const ImportedDesign& design, uint64_t most_steps) {
  return EdgeSearch(design, most_steps).find();
}

}  // namespace frontend
