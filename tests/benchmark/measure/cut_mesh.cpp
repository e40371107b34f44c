#include "cut_mesh.hpp"

#include <glm/geometric.hpp>
#include <stdexcept>

#include "kinds/test_kind.hpp"

namespace measure {
namespace {

using csgcore::Affine;
using csgcore::Box;
using csgcore::HalfSpace;
using csgcore::Primitive;
using csgcore::Vec3;

using Polygon = std::vector<Vec3>;

/// A half-space that contains the polygon up to this share of the model's size does not cut it.
constexpr double kFlat = 1e-12;

/// A faceted primitive in world space.
struct Part {
  csgcore::Mesh mesh;
  std::vector<HalfSpace> half_spaces;  // normals of unit length
  Box box;
  /// The centre of a ball inside it and of one around it.
  Vec3 center{0.0};
  double inner = 0, outer = 0;
};

Part part_of(const Primitive& primitive, int fragments) {
  auto faceted = test_support::test_kind_of(primitive.shape).faceted(primitive, fragments);
  if (!faceted) throw std::invalid_argument("cut_mesh: a primitive is not round");
  Part part;
  part.mesh = std::move(faceted->mesh);
  part.half_spaces = std::move(faceted->half_spaces);
  const Affine& map = primitive.local_to_world;
  const auto to_world = glm::transpose(csgcore::inverse(map.linear));
  for (HalfSpace& half_space : part.half_spaces) {
    const Vec3 normal = to_world * half_space.normal;
    const double length = glm::length(normal);
    half_space = {normal / length,
                  (half_space.offset + glm::dot(normal, map.translation)) / length};
  }
  for (Vec3& vertex : part.mesh.vertices) {
    vertex = map.point(vertex);
    part.box.merge(vertex);
  }
  part.center = part.box.center();
  part.inner = std::numeric_limits<double>::infinity();
  for (const HalfSpace& half_space : part.half_spaces) {
    part.inner = std::min(part.inner, half_space.offset - glm::dot(half_space.normal, part.center));
  }
  for (const Vec3& vertex : part.mesh.vertices) {
    part.outer = std::max(part.outer, glm::length(vertex - part.center));
  }
  return part;
}

Box box_of(const Polygon& polygon) {
  Box box;
  for (const Vec3& vertex : polygon) box.merge(vertex);
  return box;
}

bool overlap(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.min[axis] > b.max[axis] || b.min[axis] > a.max[axis]) return false;
  }
  return true;
}

struct Halves {
  Polygon within, beyond;
};

/// Splits the polygon by the half-space's plane. A piece no thicker than `flat` is empty.
Halves split(const Polygon& polygon, const HalfSpace& half_space, double flat) {
  thread_local std::vector<double> heights;
  heights.clear();
  double lowest = 0, highest = 0;
  for (const Vec3& vertex : polygon) {
    heights.push_back(glm::dot(half_space.normal, vertex) - half_space.offset);
    lowest = std::min(lowest, heights.back());
    highest = std::max(highest, heights.back());
  }
  if (highest <= flat) return {polygon, {}};
  if (lowest >= -flat) return {{}, polygon};
  Halves halves;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const size_t next = (i + 1) % polygon.size();
    if (heights[i] <= 0) halves.within.push_back(polygon[i]);
    if (heights[i] >= 0) halves.beyond.push_back(polygon[i]);
    if (heights[i] * heights[next] < 0) {
      const double t = heights[i] / (heights[i] - heights[next]);
      const Vec3 crossing = polygon[i] + t * (polygon[next] - polygon[i]);
      halves.within.push_back(crossing);
      halves.beyond.push_back(crossing);
    }
  }
  return halves;
}

/// The piece inside the part, and the half-spaces that it was cut by.
struct Within {
  Polygon polygon;
  std::vector<const HalfSpace*> cuts;
};

Within within(Polygon polygon, const Part& part, double flat) {
  Within result{std::move(polygon), {}};
  for (const HalfSpace& half_space : part.half_spaces) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : result.polygon) {
      highest = std::max(highest, glm::dot(half_space.normal, vertex) - half_space.offset);
    }
    if (highest <= flat) continue;
    result.polygon = split(result.polygon, half_space, flat).within;
    if (result.polygon.empty()) break;
    result.cuts.push_back(&half_space);
  }
  return result;
}

/// Returns whether an edge of the polygon lies in the half-space's plane. If not, later cuts have
/// removed it.
bool bounds(const HalfSpace& half_space, const Polygon& polygon, double flat) {
  size_t on_plane = 0;
  for (const Vec3& vertex : polygon) {
    on_plane += std::abs(glm::dot(half_space.normal, vertex) - half_space.offset) <= flat;
  }
  return on_plane >= 2;
}

/// Appends what remains of the polygon, in few pieces: it is divided along the edges of the removed
/// part.
void cut_away(const Polygon& polygon, const Part& part, double flat, std::vector<Polygon>& kept) {
  const Vec3 middle = box_of(polygon).center();
  double radius = 0, furthest = 0;
  for (const Vec3& vertex : polygon) {
    radius = std::max(radius, glm::length(vertex - middle));
    furthest = std::max(furthest, glm::length(vertex - part.center));
  }
  if (furthest < part.inner) return;
  Within gone;
  if (glm::length(middle - part.center) - radius < part.outer) gone = within(polygon, part, flat);
  Polygon rest = polygon;
  for (const HalfSpace* const cut : gone.cuts) {
    if (gone.polygon.empty() || !bounds(*cut, gone.polygon, flat)) continue;
    Halves halves = split(rest, *cut, flat);
    if (!halves.beyond.empty()) kept.push_back(std::move(halves.beyond));
    rest = std::move(halves.within);
  }
  if (gone.polygon.empty()) kept.push_back(std::move(rest));
}

/// Returns the operands, with the index of the first primitive first.
std::vector<uint32_t> operands(const csgcore::Scene& scene) {
  std::vector<uint32_t> operands;
  for (const csgcore::CsgToken& token : scene.model.tokens()) {
    if (token.is_primitive) {
      operands.push_back(token.value);
    } else if (token.op != csgcore::Op::kDifference || token.value != operands.size() ||
               &token != &scene.model.tokens().back()) {
      throw std::invalid_argument("cut_mesh: not a primitive minus others");
    }
  }
  return operands;
}

}  // namespace

std::vector<CutTriangle> cut_mesh(const csgcore::Scene& scene, int fragments) {
  const std::vector<uint32_t> indices = operands(scene);
  std::vector<Part> parts;
  for (const uint32_t index : indices) {
    parts.push_back(part_of(scene.primitives[index], fragments));
  }
  std::vector<CutTriangle> triangles;
  if (parts.empty()) return triangles;
  const double flat = kFlat * parts.front().box.diagonal();
  for (size_t i = 0; i < parts.size(); ++i) {
    std::vector<const Part*> cutters;
    for (size_t k = 1; k < parts.size(); ++k) {
      if (k != i && overlap(parts[i].box, parts[k].box)) cutters.push_back(&parts[k]);
    }
    for (const std::vector<uint32_t>& face : parts[i].mesh.faces) {
      Polygon polygon;
      for (const uint32_t vertex : face) polygon.push_back(parts[i].mesh.vertices[vertex]);
      if (i > 0) polygon = within(std::move(polygon), parts.front(), flat).polygon;
      std::vector<Polygon> left;
      if (!polygon.empty()) left.push_back(std::move(polygon));
      for (const Part* cutter : cutters) {
        std::vector<Polygon> kept;
        for (const Polygon& piece : left) cut_away(piece, *cutter, flat, kept);
        left = std::move(kept);
      }
      for (const Polygon& piece : left) {
        for (size_t k = 2; k < piece.size(); ++k) {
          CutTriangle triangle{{piece[0], piece[k - 1], piece[k]}, indices[i]};
          if (i > 0) std::swap(triangle.corners[1], triangle.corners[2]);
          triangles.push_back(triangle);
        }
      }
    }
  }
  return triangles;
}

}  // namespace measure
