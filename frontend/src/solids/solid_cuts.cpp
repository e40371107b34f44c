#include "solids/solid_cuts.hpp"

#include <iterator>
#include <utility>

#include "csgcore/stop_scope.hpp"
#include "hulls/point_solid.hpp"

namespace frontend {
namespace {

using csgcore::Box;
using csgcore::Op;
using csgcore::Vec3;

constexpr std::string_view kBecauseNotConvex =
    "it needs the outcome of a difference or an intersection of solids that are not convex";
constexpr std::string_view kBecauseRound =
    "it needs the outcome of a difference or an intersection with a ball";
constexpr std::string_view kBecauseManyParts =
    "it needs the outcome of operations on too many solids";
/// More parts take seconds to make and to draw.
constexpr size_t kMostParts = 20000;
/// Corners times the faces that they are compared with: so many take some seconds.
constexpr size_t kMostSteps = size_t{1} << 23;
/// Each face of a cutter makes a part of what it cuts.
constexpr size_t kMostFaces = 400;

PointSet points_of(const SolidPart& part) {
  SupportSet support;
  part.add_support(support);
  PointSet result = frontend::points_of(support.generators, kChordsOfCutDisc);
  result.is_faceted = result.is_faceted || support.is_faceted;
  return result;
}

bool have_common_volume(const Box& a, const Box& b) {
  const Box common = csgcore::intersection(a, b);
  if (common.empty()) return false;
  const Vec3 size = common.size();
  return size.x > 0 && size.y > 0 && size.z > 0;
}

SolidPart part_of_corners(const Corners& corners, bool is_faceted) {
  SupportSet support;
  support.is_faceted = is_faceted;
  for (const Vec3& corner : corners) support.generators.emplace_back().center = corner;
  return part_of(std::move(support));
}

}  // namespace

void SolidCuts::fail(std::string_view why) {
  if (failure_.empty()) failure_ = why;
}

bool SolidCuts::is_affordable(size_t parts, size_t steps) {
  steps_ += steps;
  if (parts > kMostParts || steps_ > kMostSteps) fail(kBecauseManyParts);
  return failure_.empty();
}

std::vector<SolidPart> SolidCuts::united(const SolidValue& value) {
  if (value.is_union()) return value.parts;
  std::vector<Parts> done;  // of the subtrees that no operation has taken
  for (const csgcore::CsgToken& token : value.tree.tokens()) {
    if (!failure_.empty()) return {};
    if (token.is_primitive) {
      done.push_back({value.parts[token.value]});
      continue;
    }
    const auto first = done.end() - static_cast<std::ptrdiff_t>(token.value);
    std::vector<Parts> operands(std::make_move_iterator(first),
                                std::make_move_iterator(done.end()));
    done.erase(first, done.end());
    done.push_back(operated(token.op, std::move(operands)));
  }
  return failure_.empty() ? std::move(done.back()) : Parts{};
}

SolidCuts::Parts SolidCuts::operated(Op op, std::vector<Parts> operands) {
  Parts result = std::move(operands.front());
  for (size_t i = 1; i < operands.size() && failure_.empty(); ++i) {
    Parts& other = operands[i];
    switch (op) {
      case Op::kUnion:
        result.insert(result.end(), std::make_move_iterator(other.begin()),
                      std::make_move_iterator(other.end()));
        break;
      case Op::kIntersection:
        result = intersection(result, other);
        break;
      case Op::kDifference:
        for (const SolidPart& cutter : other) result = difference(std::move(result), cutter);
        break;
    }
  }
  return result;
}

bool SolidCuts::are_convex(const SolidPart& a, const SolidPart& b) {
  if (!a.is_convex() || !b.is_convex()) fail(kBecauseNotConvex);
  return failure_.empty();
}

SolidCuts::Parts SolidCuts::difference(Parts parts, const SolidPart& cutter) {
  Parts result;
  std::vector<csgcore::HalfSpace> faces;
  bool is_faceted = false;
  for (SolidPart& part : parts) {
    csgcore::stop_point();
    if (!have_common_volume(part.box, cutter.box)) {
      result.push_back(std::move(part));
      continue;
    }
    if (!are_convex(part, cutter)) return {};
    if (faces.empty()) {
      const PointSet points = points_of(cutter);
      is_faceted = points.is_faceted;
      faces = faces_of(points.points);
      if (faces.size() > kMostFaces) fail(is_faceted ? kBecauseRound : kBecauseManyParts);
    }
    if (faces.empty()) {  // the cutter is flat
      result.push_back(std::move(part));
      continue;
    }
    const PointSet own = points_of(part);
    if (!is_affordable(result.size(), own.points.size() * faces.size())) return {};
    const std::vector<Corners> pieces = frontend::difference(own.points, faces);
    if (pieces.size() == 1 && pieces.front() == own.points) {
      result.push_back(std::move(part));
      continue;
    }
    for (const Corners& piece : pieces) {
      result.push_back(part_of_corners(piece, is_faceted || own.is_faceted));
    }
  }
  return result;
}

SolidCuts::Parts SolidCuts::intersection(const Parts& parts, const Parts& others) {
  Parts result;
  for (const SolidPart& other : others) {
    std::vector<csgcore::HalfSpace> faces;
    bool is_faceted = false;
    for (const SolidPart& part : parts) {
      csgcore::stop_point();
      if (!have_common_volume(part.box, other.box)) continue;
      if (!are_convex(part, other)) return {};
      if (faces.empty()) {
        const PointSet points = points_of(other);
        is_faceted = points.is_faceted;
        faces = faces_of(points.points);
        if (faces.empty()) break;  // it is flat
      }
      const PointSet own = points_of(part);
      if (!is_affordable(result.size(), own.points.size() * faces.size())) return {};
      const Corners common = frontend::intersection(own.points, faces);
      if (!common.empty()) {
        result.push_back(part_of_corners(common, is_faceted || own.is_faceted));
      }
    }
  }
  return result;
}

}  // namespace frontend
