#include "export/flush_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <unordered_map>

#include "csgcore/stop_scope.hpp"

namespace frontend {
namespace {

using csgcore::TriangleSet;
using csgcore::Vec3;

/// Corners this far from a plane are in it, as a share of the largest coordinate: what some
/// products of matrices round away.
constexpr double kPlaneRounding = 0x1p-40;
/// The keys of equal planes differ by less: by rounding over the size of the smallest faces that
/// count.
constexpr double kKeyRounding = 0x1p-26;

struct Plane {
  Vec3 normal;  // of length 1
  double offset;
};

/// A face, by a number that is equal for faces of one plane.
struct Face {
  double key;
  uint32_t operand;
  uint32_t triangle;
};

class Planes {
 public:
  Planes(std::span<const TriangleSet> operands, std::span<const uint32_t> candidates)
      : operands_(operands) {
    size_t count = 0;
    for (const uint32_t operand : candidates) {
      count += operands[operand].triangles.size();
      for (const Vec3& vertex : operands[operand].vertices) {
        for (int axis = 0; axis < 3; ++axis) size_ = std::max(size_, std::abs(vertex[axis]));
      }
    }
    faces_.reserve(count);
    for (const uint32_t operand : candidates) {
      for (uint32_t i = 0; i < operands[operand].triangles.size(); ++i) add(operand, i);
    }
    std::ranges::sort(faces_, [](const Face& a, const Face& b) {
      return std::tie(a.key, a.operand, a.triangle) < std::tie(b.key, b.operand, b.triangle);
    });
  }

  /// Calls visit(operand, plane) for each face, with the number of its plane.
  template <typename Visit>
  void visit(const Visit& visit) const {
    struct Known {
      double key;
      uint32_t number;
      Plane plane;
    };
    std::vector<Known> near;  // the planes whose keys are near, in their order
    uint32_t planes = 0;
    for (const Face& face : faces_) {
      csgcore::stop_point();
      std::erase_if(near, [&](const Known& known) { return face.key - known.key > kKeyRounding; });
      const auto same =
          std::ranges::find_if(near, [&](const Known& known) { return holds(known.plane, face); });
      if (same != near.end()) {
        visit(face.operand, same->number);
        continue;
      }
      visit(face.operand, planes);
      near.push_back({face.key, planes++, plane_of(face)});
    }
  }

 private:
  std::array<Vec3, 3> corners_of(const Face& face) const {
    const TriangleSet& surface = operands_[face.operand];
    const auto [a, b, c] = surface.triangles[face.triangle];
    return {surface.vertices[a], surface.vertices[b], surface.vertices[c]};
  }

  Plane plane_of(const Face& face) const {
    const auto [a, b, c] = corners_of(face);
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    return {normal, glm::dot(normal, a)};
  }

  void add(uint32_t operand, uint32_t triangle) {
    // Any direction will do in which no two planes of a design look alike.
    const Vec3 direction(0.5384, 0.7327, 0.4159);
    constexpr double kShare = 0.6173;
    Face face{0, operand, triangle};
    const Plane plane = plane_of(face);
    // Either side of the plane may be the front.
    face.key = std::abs(glm::dot(plane.normal, direction) + kShare * plane.offset / size_);
    if (std::isfinite(face.key)) faces_.push_back(face);
  }

  bool holds(const Plane& plane, const Face& face) const {
    return std::ranges::all_of(corners_of(face), [&](const Vec3& corner) {
      return std::abs(glm::dot(plane.normal, corner) - plane.offset) <= kPlaneRounding * size_;
    });
  }

  std::span<const TriangleSet> operands_;
  std::vector<Face> faces_;
  double size_ = 0;
};

}  // namespace

FlushFaces::FlushFaces(std::span<const TriangleSet> operands,
                       std::span<const uint32_t> candidates) {
  const Planes planes(operands, candidates);
  constexpr uint32_t kNoOperand = 0xFFFFFFFFu, kSeveral = 0xFFFFFFFEu;
  std::vector<uint32_t> operand_of;  // by plane: the one whose faces it holds, or kSeveral
  planes.visit([&](uint32_t operand, uint32_t plane) {
    if (plane >= operand_of.size()) operand_of.resize(plane + 1, kNoOperand);
    uint32_t& known = operand_of[plane];
    if (known != operand) known = known == kNoOperand ? operand : kSeveral;
  });
  if (std::ranges::find(operand_of, kSeveral) == operand_of.end()) return;
  planes_of_.resize(operands.size());
  planes.visit([&](uint32_t operand, uint32_t plane) {
    if (operand_of[plane] == kSeveral) planes_of_[operand].push_back(plane);
  });
  for (std::vector<uint32_t>& numbers : planes_of_) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }
}

bool FlushFaces::are_among(std::span<const uint32_t> operands) const {
  std::unordered_map<uint32_t, uint32_t> operand_of;  // by plane: the first one
  return std::ranges::any_of(operands, [&](uint32_t operand) {
    return std::ranges::any_of(planes_of_[operand], [&](uint32_t plane) {
      return operand_of.try_emplace(plane, operand).first->second != operand;
    });
  });
}

}  // namespace frontend
