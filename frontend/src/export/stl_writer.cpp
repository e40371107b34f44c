// STL, as text or in binary.

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>
#include <string_view>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"
#include "frontend/error.hpp"

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;

/// Returns the unit normal; of a triangle that is a line, 0.
Vec3 normal_of(const TriangleSet& surface, const std::array<uint32_t, 3>& t) {
  const Vec3& a = surface.vertices[t[0]];
  Vec3 u = surface.vertices[t[1]] - a, v = surface.vertices[t[2]] - a;
  // Of unit size, lest their product be too large or too small.
  if (const double length = glm::length(u); length > 0) u /= length;
  if (const double length = glm::length(v); length > 0) v /= length;
  const Vec3 normal = glm::cross(u, v);
  const double length = glm::length(normal);
  return length > 0 ? normal / length : Vec3(0.0);
}

void append_vector(std::string& text, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) {
    text += ' ';
    append_number(text, static_cast<float>(vector[axis]));
  }
  text += '\n';
}

/// Appends the lowest byte first.
void append_bytes(std::string& bytes, uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xFF);
}

void append_floats(std::string& bytes, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) {
    append_bytes(bytes, std::bit_cast<uint32_t>(static_cast<float>(vector[axis]) + 0.0f));
  }
}

}  // namespace

std::string ascii_stl_of(const TriangleSet& surface) {
  std::string text = "solid OpenSCAD_Model\n";
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    text += "  facet normal";
    append_vector(text, normal_of(surface, t));
    text += "    outer loop\n";
    for (const uint32_t corner : t) {
      text += "      vertex";
      append_vector(text, surface.vertices[corner]);
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid OpenSCAD_Model\n";
}

std::string stl_of(const TriangleSet& surface) {
  constexpr size_t kHeaderBytes = 80, kTriangleBytes = 50;
  std::string bytes = "OpenSCAD Model\n";
  bytes.resize(kHeaderBytes, '\0');
  bytes.reserve(kHeaderBytes + 4 + kTriangleBytes * surface.triangles.size());
  append_bytes(bytes, static_cast<uint32_t>(surface.triangles.size()));
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    append_floats(bytes, normal_of(surface, t));
    for (const uint32_t corner : t) append_floats(bytes, surface.vertices[corner]);
    bytes.append(2, '\0');  // the size of an attribute
  }
  return bytes;
}

}  // namespace frontend
