#include "oracle/straight_skeleton.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/create_straight_skeleton_2.h>

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPolygon = CGAL::Polygon_2<Kernel>;

CgalPolygon cgal_polygon(const SkeletonPolygon& polygon) {
  CgalPolygon result;
  for (const glm::dvec2& point : polygon) result.push_back({point.x, point.y});
  return result;
}

glm::dvec2 place_of(const Kernel::Point_2& point) { return {point.x(), point.y()}; }

}  // namespace

bool is_simple(const SkeletonPolygon& polygon) {
  return polygon.size() >= 3 && cgal_polygon(polygon).is_simple();
}

std::vector<SkeletonFace> straight_skeleton(const std::vector<SkeletonPolygon>& polygons) {
  std::vector<CgalPolygon> outline;
  for (const SkeletonPolygon& polygon : polygons) outline.push_back(cgal_polygon(polygon));
  const auto skeleton = CGAL::create_interior_straight_skeleton_2(
      outline.front().vertices_begin(), outline.front().vertices_end(), outline.begin() + 1,
      outline.end(), Kernel());
  std::vector<SkeletonFace> faces;
  if (skeleton == nullptr) return faces;
  for (auto face = skeleton->faces_begin(); face != skeleton->faces_end(); ++face) {
    const auto contour = face->halfedge()->defining_contour_edge();
    SkeletonFace& own = faces.emplace_back();
    own.start = place_of(contour->opposite()->vertex()->point());
    own.end = place_of(contour->vertex()->point());
    auto edge = face->halfedge();
    do {
      own.corners.push_back(place_of(edge->vertex()->point()));
      edge = edge->next();
    } while (edge != face->halfedge());
  }
  return faces;
}

}  // namespace oracle
