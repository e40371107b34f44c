// The exact twin of the convex polyhedron.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "csgcore/polyhedron.hpp"
#include "disc_box.hpp"
#include "exact_twin.hpp"
#include "number_text.hpp"

namespace oracle {
namespace {

using csgcore::HalfSpace;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Vec3;

csgcore::Box vertex_box(const Polyhedron& polyhedron) {
  csgcore::Box box;
  for (const Vec3& vertex : polyhedron.vertices()) box.merge(vertex);
  return box;
}

Plane<Exact> scaled(const HalfSpace& half_space, const Vector<Exact>& middle,
                    const Exact& magnification) {
  const Vec3 size = glm::abs(half_space.normal);
  const Exact scale = power_of_two(-std::ilogb(std::max({size.x, size.y, size.z})));
  Plane<Exact> plane;
  for (int i = 0; i < 3; ++i) plane.normal[i] = Exact(half_space.normal[i]);
  plane.limit = scale * magnification * (Exact(half_space.offset) - dot(plane.normal, middle));
  for (Exact& coordinate : plane.normal) coordinate = scale * coordinate;
  return plane;
}

/// Returns the indices of the face's vertices as text, clockwise as seen from outside.
std::vector<std::string> face_of(const Polyhedron& polyhedron, const HalfSpace& half_space) {
  constexpr double kRounding = 1e-9;  // of vertices, as a share of the largest
  const Vec3 normal = glm::normalize(half_space.normal);
  const double offset = half_space.offset / glm::length(half_space.normal);
  double largest = 0;
  for (const Vec3& v : polyhedron.vertices()) largest = std::max(largest, glm::length(v));
  std::vector<size_t> corners;
  Vec3 middle(0.0);
  for (size_t i = 0; i < polyhedron.vertices().size(); ++i) {
    const Vec3& v = polyhedron.vertices()[i];
    if (std::abs(glm::dot(normal, v) - offset) > kRounding * largest) continue;
    corners.push_back(i);
    middle += v;
  }
  if (corners.empty()) return {};
  middle /= double(corners.size());
  const Vec3 right = polyhedron.vertices()[corners[0]] - middle, up = glm::cross(normal, right);
  const auto angle = [&](size_t i) {
    const Vec3 v = polyhedron.vertices()[i] - middle;
    return std::atan2(glm::dot(up, v), glm::dot(right, v));
  };
  std::sort(corners.begin(), corners.end(),
            [&](size_t a, size_t b) { return angle(a) > angle(b); });
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  std::vector<std::string> names;
  for (const size_t i : corners) names.push_back(std::to_string(i));
  return names;
}

/// Returns solids that may replace a polyhedron: the simplest ones, and its box.
std::vector<std::shared_ptr<const Polyhedron>> simpler_than(const Polyhedron& polyhedron) {
  std::vector<std::shared_ptr<const Polyhedron>> result{Polyhedron::frustum(-1, 1, 1, 0, 3),
                                                        Polyhedron::box({Vec3(-1), Vec3(1)}),
                                                        Polyhedron::box(vertex_box(polyhedron))};
  for (int fragments = 3; fragments <= 8; ++fragments) {
    result.push_back(Polyhedron::frustum(-1, 1, 1, 1, fragments));
    result.push_back(Polyhedron::sphere(1, fragments));
  }
  return result;
}

class PolyhedronTwin final : public ExactTwin {
 public:
  Vector<Exact> middle(const Primitive& primitive) const override {
    const Vec3 center = vertex_box(*primitive.polyhedron()).center();
    return {center.x, center.y, center.z};
  }
  void add_surfaces(const Primitive& primitive, const Exact& magnification,
                    Target<Exact>& target) const override {
    const Polyhedron& polyhedron = *primitive.polyhedron();
    const Vector<Exact> middle = this->middle(primitive);
    for (const HalfSpace& half_space : polyhedron.half_spaces()) {
      target.planes.push_back(scaled(half_space, middle, magnification));
    }
    const Vec3 size = vertex_box(polyhedron).size();
    const Vec3 slender = std::min({size.x, size.y, size.z}) / size;
    target.weight = slender * slender;
  }
  void merge_box(const Vec3& point, const Primitive& primitive, csgcore::Box& box) const override {
    for (const Vec3& vertex : primitive.polyhedron()->vertices()) {
      merge_point(point, primitive.local_to_world, vertex, box);
    }
  }
  std::string as_cpp(const Primitive& primitive, const std::string& map) const override {
    std::vector<std::string> half_spaces, vertices;
    for (const HalfSpace& h : primitive.polyhedron()->half_spaces()) {
      half_spaces.push_back("{{" + coordinates(h.normal) + "}, " + shortest_text(h.offset) + "}");
    }
    for (const Vec3& v : primitive.polyhedron()->vertices()) {
      vertices.push_back("{" + coordinates(v) + "}");
    }
    return "make_polyhedron(std::make_shared<Polyhedron>(std::vector<HalfSpace>{" +
           joined(half_spaces) + "}, std::vector<Vec3>{" + joined(vertices) + "}), " + map + ")";
  }
  std::string as_openscad(const Primitive& primitive) const override {
    const Polyhedron& polyhedron = *primitive.polyhedron();
    std::vector<std::string> points, faces;
    for (const Vec3& v : polyhedron.vertices()) points.push_back("[" + coordinates(v) + "]");
    for (const HalfSpace& half_space : polyhedron.half_spaces()) {
      faces.push_back("[" + joined(face_of(polyhedron, half_space)) + "]");
    }
    return "polyhedron([" + joined(points) + "], [" + joined(faces) + "])";
  }
  std::vector<Primitive> simpler(const Primitive& primitive) const override {
    const csgcore::Affine& map = primitive.local_to_world;
    std::vector<Primitive> result{csgcore::make_sphere(1, map)};
    for (const auto& solid : simpler_than(*primitive.polyhedron())) {
      result.push_back(csgcore::make_polyhedron(solid, map));
    }
    return result;
  }
};

constexpr PolyhedronTwin kPolyhedronTwin;

}  // namespace

constinit const ExactTwin& Polyhedron_twin = kPolyhedronTwin;

}  // namespace oracle
