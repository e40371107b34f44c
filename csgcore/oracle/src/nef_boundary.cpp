// Set operations on Nef polyhedra, and their boundaries as triangles. No other file includes
// CGAL/Nef_polyhedron_3.h, which is slow to compile.
#include "nef_boundary.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Projection_traits_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <istream>
#include <map>
#include <optional>
#include <ostream>
#include <queue>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "nef_polytope.hpp"

namespace oracle {
namespace {

/// A plane polygon, possibly with holes: closed cycles of indices of points, in any order. An edge
/// that cycles run along in both directions has the polygon on both of its sides.
struct Facet {
  Vector normal;
  std::vector<std::vector<std::size_t>> cycles;
};

/// The number of borders between a triangle and the outside.
using Nesting = std::optional<int>;

using Traits = CGAL::Projection_traits_3<Kernel>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Traits>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Traits, CGAL::Triangulation_face_base_with_info_2<Nesting, Traits>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Traits, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

/// Returns the edges that cycles run along once, by their ends. An edge of the solid may lie within
/// a facet and end there, as the ridge of a groove does that reaches the facet from behind. A cycle
/// runs along such an edge in both directions, and the facet is on both of its sides.
std::set<std::pair<std::size_t, std::size_t>> borders_of(const Facet& facet) {
  std::set<std::pair<std::size_t, std::size_t>> borders;
  for (const std::vector<std::size_t>& cycle : facet.cycles) {
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const auto [a, b] = std::minmax(cycle[i], cycle[(i + 1) % cycle.size()]);
      const auto [border, is_new] = borders.emplace(a, b);
      if (!is_new) borders.erase(border);
    }
  }
  return borders;
}

/// Finds the nesting of all triangles, from the infinite face inwards.
void find_nesting(const Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
  open.back()->info() = 0;
  for (std::size_t next = 0; next < open.size(); ++next) {
    const Triangulation::Face_handle face = open[next];
    for (int side = 0; side < 3; ++side) {
      const Triangulation::Face_handle neighbor = face->neighbor(side);
      if (neighbor->info()) continue;
      neighbor->info() = *face->info() + (face->is_constrained(side) ? 1 : 0);
      open.push_back(neighbor);
    }
  }
}

/// Appends triangles, counterclockwise about the normal, whose corners are those of the facet.
void triangulate(const Facet& facet, const std::vector<Point>& points,
                 std::vector<std::array<std::size_t, 3>>& triangles) {
  Triangulation triangulation{Traits(facet.normal)};
  std::map<std::size_t, Triangulation::Vertex_handle> corners;
  for (const std::vector<std::size_t>& cycle : facet.cycles) {
    for (const std::size_t index : cycle) {
      const auto [corner, is_new] = corners.try_emplace(index);
      if (!is_new) continue;
      corner->second = triangulation.insert(points[index]);
      corner->second->info() = index;
    }
  }
  for (const auto& [a, b] : borders_of(facet)) {
    triangulation.insert_constraint(corners.at(a), corners.at(b));
  }
  find_nesting(triangulation);
  for (const Triangulation::Face_handle face : triangulation.finite_face_handles()) {
    const bool is_within = *face->info() % 2 == 1;
    if (!is_within) continue;
    triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
}

// The base of numbers in the text. A power of two is fastest.
constexpr int kBase = 32;

using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Surface = CGAL::Polyhedron_3<Kernel>;

class SurfaceOf : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  explicit SurfaceOf(const Polytope& polytope) : polytope_(polytope) {}
  void operator()(Surface::HalfedgeDS& surface) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(surface, true);
    builder.begin_surface(polytope_.vertices.size(), polytope_.facets.size());
    for (const Point& vertex : polytope_.vertices) builder.add_vertex(vertex);
    for (const auto& facet : polytope_.facets) builder.add_facet(facet.begin(), facet.end());
    builder.end_surface();
  }

 private:
  const Polytope& polytope_;
};

Nef nef_of(const Polytope& polytope) {
  Surface surface;
  SurfaceOf build(polytope);
  surface.delegate(build);
  if (!surface.is_closed()) throw std::invalid_argument("a shell is no closed manifold");
  return Nef(surface);
}

/// Returns the solid where the winding number of shells is not 0: where the number of outward
/// shells that hold a point differs from that of inward ones.
Nef solid_of(const std::vector<MeshShell>& shells) {
  std::vector<Nef> levels[2];  // [is_inward][k]: where more than k shells of that kind are
  for (const MeshShell& shell : shells) {
    std::vector<Nef>& own = levels[shell.is_inward];
    const Nef nef = nef_of(shell.polytope);
    own.push_back(Nef(Nef::EMPTY));
    for (size_t k = own.size(); k-- > 1;) own[k] = own[k] + own[k - 1] * nef;
    own[0] = own[0] + nef;
  }
  const size_t most = std::max(levels[0].size(), levels[1].size());
  for (std::vector<Nef>& own : levels) own.resize(most, Nef(Nef::EMPTY));
  Nef result(Nef::EMPTY);
  for (size_t k = 0; k < most; ++k) {
    result = result + (levels[0][k] - levels[1][k]) + (levels[1][k] - levels[0][k]);
  }
  return result;
}

Nef nef_of(const FacetedSolid& solid) {
  return solid.mesh ? solid_of(shells_of(solid)) : nef_of(polytope_of(solid));
}

/// Combines one or more operands, always the two smallest ones first, since an operation takes time
/// in proportion to the sizes of both.
template <class Operation>
Nef accumulate(std::span<Nef> operands, Operation operation) {
  const auto is_larger = [](const Nef& a, const Nef& b) {
    return a.number_of_vertices() > b.number_of_vertices();
  };
  std::priority_queue queue(is_larger, std::vector<Nef>(operands.begin(), operands.end()));
  while (queue.size() > 1) {
    const Nef a = queue.top();
    queue.pop();
    const Nef b = queue.top();
    queue.pop();
    queue.push(operation(a, b));
  }
  return queue.top();
}

Nef apply(csgcore::Op op, std::span<Nef> operands) {
  const auto unite = [](const Nef& a, const Nef& b) { return a + b; };
  switch (op) {
    case csgcore::Op::kUnion:
      return accumulate(operands, unite);
    case csgcore::Op::kIntersection:
      return accumulate(operands, [](const Nef& a, const Nef& b) { return a * b; });
    case csgcore::Op::kDifference:
      break;
  }
  return operands.front() - accumulate(operands.subspan(1), unite);
}

Nef value_of(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra) {
  std::vector<Nef> operands;
  for (const csgcore::CsgToken& token : tree.tokens()) {
    if (token.is_primitive) {
      operands.push_back(nef_of(polyhedra[token.value]));
      continue;
    }
    const std::size_t first = operands.size() - token.value;
    operands[first] = apply(token.op, std::span(operands).subspan(first));
    operands.resize(first + 1);
  }
  return operands.empty() ? Nef(Nef::EMPTY) : operands.front();
}

/// Returns the regularised solid's boundary: the facets between its volumes and the outside. A
/// dangling facet, or a crack, has volumes of the same kind on both of its sides.
///
/// Neither of CGAL's own functions can be used. Nef_polyhedron_3::regularization() merges facets by
/// SNC_simplify, whose SNC_decorator::add_sloop_to_facet() links the circle that is left about a
/// vertex to the wrong side of its facet (5.5.1): if an apex touches that facet, inside and outside
/// become one volume. CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h loses a cavity that
/// contains something, and fails if a vertex touches a facet.
ExactBoundary boundary_of(const Nef& solid) {
  ExactBoundary boundary;
  std::unordered_map<Nef::Vertex_const_handle, std::size_t> indices;
  const auto index_of = [&](Nef::Vertex_const_handle vertex) {
    const auto [entry, is_new] = indices.try_emplace(vertex, indices.size());
    if (is_new) boundary.vertices.push_back(vertex->point());
    return entry->second;
  };
  Nef::Halffacet_const_iterator half;
  CGAL_forall_halffacets(half, solid) {
    // A halffacet faces its volume. Take the one of each pair that faces out of the solid.
    if (half->incident_volume()->mark() || !half->twin()->incident_volume()->mark()) continue;
    Facet facet{half->plane().orthogonal_vector(), {}};
    Nef::Halffacet_cycle_const_iterator cycle;
    CGAL_forall_facet_cycles_of(cycle, half) {
      if (!cycle.is_shalfedge()) continue;  // a vertex that touches the facet
      std::vector<std::size_t>& corners = facet.cycles.emplace_back();
      Nef::SHalfedge_around_facet_const_circulator edge{Nef::SHalfedge_const_handle(cycle)};
      const auto first = edge;
      do {
        corners.push_back(index_of(edge->source()->center_vertex()));
      } while (++edge != first);
    }
    triangulate(facet, boundary.vertices, boundary.triangles);
  }
  return boundary;
}

}  // namespace

void write_boundary(std::ostream& out, const ExactBoundary& boundary) {
  out << boundary.vertices.size() << ' ' << boundary.triangles.size() << '\n';
  for (const Point& vertex : boundary.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      out << rational_of(vertex[axis]).get_str(kBase) << (axis < 2 ? ' ' : '\n');
    }
  }
  for (const auto& [a, b, c] : boundary.triangles) out << a << ' ' << b << ' ' << c << '\n';
}

ExactBoundary read_boundary(std::istream& in) {
  std::size_t vertices = 0, triangles = 0;
  in >> vertices >> triangles;
  ExactBoundary boundary;
  for (std::size_t i = 0; i < vertices && in; ++i) {
    std::array<Number, 3> coordinates;
    for (Number& coordinate : coordinates) {
      std::string digits;
      if (in >> digits) coordinate = Rational(digits, kBase);
    }
    boundary.vertices.emplace_back(coordinates[0], coordinates[1], coordinates[2]);
  }
  for (std::size_t i = 0; i < triangles && in; ++i) {
    auto& [a, b, c] = boundary.triangles.emplace_back();
    in >> a >> b >> c;
  }
  if (!in) throw std::runtime_error("the boundary of a solid ends early");
  return boundary;
}

ExactBoundary nef_boundary(const csgcore::CsgTree& tree, std::span<const FacetedSolid> polyhedra) {
  // Dangling facets and cracks have no volume, and make none in a later operation, so that it is
  // enough to leave them out of the final solid.
  return boundary_of(value_of(tree, polyhedra));
}

}  // namespace oracle
