#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "csgcore/polyhedron.hpp"
#include "oracle/minimise.hpp"
#include "shortest_text.hpp"
#include "tree_order.hpp"

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::HalfSpace;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Polyhedron;
using csgcore::Primitive;
using csgcore::Scene;
using csgcore::Shape;
using csgcore::Vec3;

/// "a, b, c"
std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string numbers(const std::vector<double>& values) {
  std::vector<std::string> parts;
  for (const double value : values) parts.push_back(shortest_text(value));
  return joined(parts);
}

std::string coordinates(const Vec3& v) { return numbers({v.x, v.y, v.z}); }

// --- C++ ---

std::string cpp_of(const Vec3& v) { return "Vec3(" + coordinates(v) + ")"; }

std::string cpp_of(const Affine& map) {
  const Mat3& m = map.linear;
  const std::string linear =
      m == Mat3(1.0) ? "Mat3(1.0)"
                     : "Mat3(" + cpp_of(m[0]) + ", " + cpp_of(m[1]) + ", " + cpp_of(m[2]) + ")";
  return "{" + linear + ", " + cpp_of(map.translation) + "}";
}

std::string cpp_of(const Polyhedron& polyhedron) {
  std::vector<std::string> half_spaces, vertices;
  for (const HalfSpace& h : polyhedron.half_spaces()) {
    half_spaces.push_back("{{" + coordinates(h.normal) + "}, " + shortest_text(h.offset) + "}");
  }
  for (const Vec3& v : polyhedron.vertices()) vertices.push_back("{" + coordinates(v) + "}");
  return "std::make_shared<Polyhedron>(std::vector<HalfSpace>{" + joined(half_spaces) +
         "}, std::vector<Vec3>{" + joined(vertices) + "})";
}

std::string cpp_of(const Primitive& p) {
  const std::string map = cpp_of(p.local_to_world);
  switch (p.shape) {
    case Shape::kSphere:
      return "make_sphere(" + shortest_text(p.r_bottom) + ", " + map + ")";
    case Shape::kFrustum:
      return "make_frustum(" + numbers({p.z_min, p.z_max, p.r_bottom, p.r_top}) + ", " + map + ")";
    case Shape::kPolyhedron:
      break;
  }
  return "make_polyhedron(" + cpp_of(*p.polyhedron) + ", " + map + ")";
}

struct CppTree {
  void open(Op op) {
    const char* const names[] = {"kUnion", "kIntersection", "kDifference"};
    text += std::string("builder.open(Op::") + names[size_t(op)] + ");\n";
  }
  void primitive(uint32_t index) { text += "builder.primitive(" + std::to_string(index) + ");\n"; }
  void close() { text += "builder.close();\n"; }
  std::string text;
};

// --- OpenSCAD ---

/// The face's vertices, clockwise seen from outside.
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

std::string scad_of(const Polyhedron& polyhedron) {
  std::vector<std::string> points, faces;
  for (const Vec3& v : polyhedron.vertices()) points.push_back("[" + coordinates(v) + "]");
  for (const HalfSpace& half_space : polyhedron.half_spaces()) {
    faces.push_back("[" + joined(face_of(polyhedron, half_space)) + "]");
  }
  return "polyhedron([" + joined(points) + "], [" + joined(faces) + "])";
}

std::string scad_of(const Affine& map) {
  if (map.linear == Mat3(1.0) && map.translation == Vec3(0.0)) return "";
  if (map.linear == Mat3(1.0)) return "translate([" + coordinates(map.translation) + "]) ";
  std::string rows;
  for (int row = 0; row < 3; ++row) {
    rows += "[" +
            numbers({map.linear[0][row], map.linear[1][row], map.linear[2][row],
                     map.translation[row]}) +
            "], ";
  }
  return "multmatrix([" + rows + "[0, 0, 0, 1]]) ";
}

std::string scad_of(const Primitive& p) {
  const std::string map = scad_of(p.local_to_world);
  switch (p.shape) {
    case Shape::kSphere:
      return map + "sphere(" + shortest_text(p.r_bottom) + ")";
    case Shape::kFrustum:
      return map + "translate([" + numbers({0, 0, p.z_min}) + "]) cylinder(" +
             numbers({p.z_max - p.z_min, p.r_bottom, p.r_top}) + ")";
    case Shape::kPolyhedron:
      break;
  }
  return map + scad_of(*p.polyhedron);
}

struct ScadTree {
  explicit ScadTree(const Scene& of) : scene(of) {}
  void line(const std::string& content) { text += std::string(2 * depth, ' ') + content + "\n"; }
  void open(Op op) {
    const char* const names[] = {"union", "intersection", "difference"};
    line(std::string(names[size_t(op)]) + "() {");
    ++depth;
  }
  void primitive(uint32_t index) { line(scad_of(scene.primitives[index]) + ";"); }
  void close() {
    --depth;
    line("}");
  }
  const Scene& scene;
  std::string text;
  size_t depth = 0;
};

}  // namespace

std::string as_cpp(const Scene& scene) {
  std::string text = "Scene scene;\nscene.primitives = {";
  for (size_t i = 0; i < scene.primitives.size(); ++i) {
    text += (i > 0 ? ",\n    " : "\n    ") + cpp_of(scene.primitives[i]);
  }
  text += "};\nCsgTreeBuilder builder;\n";
  CppTree tree;
  visit_outside_in(scene.model.tokens(), tree);
  return text + tree.text + "scene.model = builder.finish();\n";
}

std::string as_openscad(const Scene& scene) {
  ScadTree tree(scene);
  visit_outside_in(scene.model.tokens(), tree);
  return tree.text;
}

}  // namespace oracle
