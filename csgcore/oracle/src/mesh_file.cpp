#include <glm/geometric.hpp>
#include <iomanip>
#include <limits>
#include <ostream>

#include "oracle/nef_solid.hpp"

namespace oracle {
namespace {

constexpr int kAllDigits = std::numeric_limits<double>::max_digits10;

void write_vector(std::ostream& out, const csgcore::Vec3& v) {
  out << v.x << ' ' << v.y << ' ' << v.z << '\n';
}

}  // namespace

void write_off(std::ostream& out, const csgcore::Mesh& mesh) {
  out << std::setprecision(kAllDigits);
  out << "OFF " << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
  for (const csgcore::Vec3& v : mesh.vertices) write_vector(out, v);
  for (const auto& face : mesh.faces) {
    out << face.size();
    for (const uint32_t vertex : face) out << ' ' << vertex;
    out << '\n';
  }
}

void write_stl(std::ostream& out, const csgcore::Mesh& mesh) {
  out << std::setprecision(kAllDigits) << "solid scadray\n";
  for (const auto& face : mesh.faces) {
    const csgcore::Vec3& a = mesh.vertices[face[0]];
    const csgcore::Vec3& b = mesh.vertices[face[1]];
    const csgcore::Vec3& c = mesh.vertices[face[2]];
    const csgcore::Vec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    out << "facet normal ";
    write_vector(out, length > 0 ? normal / length : normal);
    out << "outer loop\n";
    for (const csgcore::Vec3& v : {a, b, c}) {
      out << "vertex ";
      write_vector(out, v);
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid scadray\n";
}

}  // namespace oracle
