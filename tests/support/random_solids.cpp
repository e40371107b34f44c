#include "random_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>
#include <utility>

#include "csgcore/facets.hpp"
#include "models.hpp"

namespace test_support {
namespace {

using csgcore::CsgTree;
using csgcore::CsgTreeBuilder;
using csgcore::Mat3;
using csgcore::Op;
using csgcore::Vec3;
using Random = std::mt19937;
using Rule = SolidOperand::Rule;
using Step = RandomSolid::Step;

constexpr uint32_t kMostOperands = 10;
constexpr uint32_t kManyOperands = 40;  // of some trees
constexpr int kMostDepth = 4;
/// What a face is moved by to make a sliver. It is 1e-9, rounded to the finest step of coordinates.
constexpr double kSliver = 0x1p-30;
/// Round shapes have vertices that are multiples of this.
constexpr double kRoundStep = 0x1p-20;

bool by_chance(Random& random, double probability) {
  return std::uniform_real_distribution<double>(0, 1)(random) < probability;
}

int whole(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

Vec3 lattice_point(Random& random, int low, int high) {
  const int x = whole(random, low, high), y = whole(random, low, high);
  return Vec3(x, y, whole(random, low, high));
}

MeshParts rounded(MeshParts parts) {
  for (Vec3& vertex : parts.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      vertex[axis] = std::round(vertex[axis] / kRoundStep) * kRoundStep;
    }
  }
  return parts;
}

/// Maps the vertices, and turns the triangles if the map is a reflection.
MeshParts mapped(const MeshParts& parts, const Mat3& linear) {
  MeshParts result = glm::determinant(linear) < 0 ? parts.inside_out() : parts;
  for (Vec3& vertex : result.vertices) vertex = linear * vertex;
  return result;
}

void map(SolidOperand& operand, const Mat3& linear) {
  operand.surface = mapped(operand.surface, linear);
  for (MeshParts& shell : operand.shells) shell = mapped(shell, linear);
}

void move(SolidOperand& operand, const Vec3& offset) {
  operand.surface = operand.surface.moved(offset);
  for (MeshParts& shell : operand.shells) shell = shell.moved(offset);
}

/// A rotation by multiples of 90°, or one with a reflection.
Mat3 signed_permutation(Random& random) {
  std::array<int, 3> axes{0, 1, 2};
  std::shuffle(axes.begin(), axes.end(), random);
  Mat3 result(0.0);
  for (int i = 0; i < 3; ++i) result[i][axes[size_t(i)]] = random() % 2 ? 1 : -1;
  return result;
}

/// Five times a rotation by the angle of the triangle with the sides 3, 4 and 5.
Mat3 turn_345(Random& random) {
  const int axis = whole(random, 0, 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool is_swapped = random() % 2 == 0;
  const double c = is_swapped ? 4 : 3, s = (is_swapped ? 3 : 4) * (random() % 2 ? 1 : -1);
  Mat3 result(5.0);
  result[u][u] = c;
  result[u][v] = s;
  result[v][u] = -s;
  result[v][v] = c;
  return result;
}

// Shapes.

MeshParts box(Random& random) {
  const Vec3 min = lattice_point(random, -3, 2);
  return box_parts(min, min + lattice_point(random, 1, 4));
}

/// The points are not all in one line or, for a tetrahedron, plane.
MeshParts tetrahedron(Random& random) {
  for (;;) {
    MeshParts parts;
    for (int i = 0; i < 4; ++i) parts.add(lattice_point(random, -3, 3));
    const std::vector<Vec3>& p = parts.vertices;
    const double volume = glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    if (volume == 0) continue;
    parts.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    return volume > 0 ? parts : parts.inside_out();
  }
}

std::vector<std::array<double, 2>> convex_loop(Random& random) {
  const double a = whole(random, 1, 3), b = whole(random, 1, 3);
  switch (random() % 4) {
    case 0:
      return {{-a, -b}, {a, -b}, {0, b}};
    case 1:
      return {{a, 0}, {0, a}, {-a, 0}, {0, -a}};
    case 2:
      return {{-2 * a, -b}, {2 * a, -b}, {a, b}, {-a, b}};
    default:
      return {{-a - 1, -1}, {-a, -2}, {a, -2}, {a + 1, -1},
              {a + 1, 1},   {a, 2},   {-a, 2}, {-a - 1, 1}};
  }
}

MeshParts prism(Random& random) {
  return fan_prism_parts(convex_loop(random), whole(random, 1, 4));
}

MeshParts pyramid(Random& random) {
  MeshParts parts;
  const auto loop = convex_loop(random);
  for (const auto& [x, y] : loop) parts.add(Vec3(x, y, 0));
  const Vec3 foot = lattice_point(random, -2, 2);
  const uint32_t apex = parts.add(Vec3(foot.x, foot.y, whole(random, 1, 4)));
  for (uint32_t i = 0; i < apex; ++i) {
    const uint32_t next = (i + 1) % apex;
    parts.triangles.push_back({i, next, apex});
    if (i > 0 && next > 0) parts.triangles.push_back({0, next, i});
  }
  return parts;
}

MeshParts faceted_sphere(Random& random) {
  return rounded(parts_of(csgcore::sphere_mesh(whole(random, 1, 3), whole(random, 3, 10))));
}

MeshParts faceted_frustum(Random& random) {
  const double low = -whole(random, 0, 2), high = whole(random, 1, 3);
  const int bottom = whole(random, 0, 3);
  const int top = random() % 2 ? std::max(bottom, 1) : whole(random, bottom == 0 ? 1 : 0, 3);
  return rounded(parts_of(csgcore::frustum_mesh(low, high, bottom, top, whole(random, 3, 9))));
}

MeshParts torus(Random& random) {
  const double tube = whole(random, 1, 2);
  const uint32_t around = random() % 2 ? 4 : uint32_t(whole(random, 3, 8));
  return rounded(torus_parts(tube + whole(random, 1, 2), tube, around, random() % 2 ? 4 : 3));
}

MeshParts l_prism(Random& random) {
  const int thickness = whole(random, 1, 2);
  return l_prism_parts(thickness + whole(random, 1, 2), thickness, whole(random, 1, 4));
}

MeshParts bumpy(Random& random) {
  if (random() % 2) return rounded(star_parts(1, 3, random() % 3 ? 0 : 1, random));
  return rounded(height_field_parts(3, uint32_t(whole(random, 2, 3)), 1, 2, random));
}

MeshParts simple_shape(Random& random) {
  switch (random() % 16) {
    case 0:
    case 1:
      return tetrahedron(random);
    case 2:
    case 3:
      return prism(random);
    case 4:
      return pyramid(random);
    case 5:
      return faceted_sphere(random);
    case 6:
      return faceted_frustum(random);
    case 7:
      return torus(random);
    case 8:
      return l_prism(random);
    case 9:
      return u_prism_parts(whole(random, 1, 2), whole(random, 1, 4));
    case 10:
      return bumpy(random);
    default:
      return box(random);
  }
}

/// A box with a cavity, which may touch its walls from within, and rounding may then cross them.
SolidOperand hollow(Random& random) {
  const Vec3 min = lattice_point(random, -3, 0), size = lattice_point(random, 3, 5);
  const Vec3 gap = lattice_point(random, 0, 1);
  const MeshParts outer = box_parts(min, min + size);
  const MeshParts inner = box_parts(min + gap, min + gap + Vec3(whole(random, 1, 2)));
  return {joined({outer, inner.inside_out()}), {outer, inner}, Rule::kSeparatePair};
}

SolidOperand two_shells(Random& random) {
  const MeshParts first = simple_shape(random);
  const Vec3 offset = random() % 4 ? lattice_point(random, -2, 2) : Vec3(0.0);
  const MeshParts second = random() % 2 ? first.moved(offset) : simple_shape(random);
  if (random() % 4 == 0) {
    return {joined({first, second.inside_out()}), {first, second}, Rule::kSeparatePair};
  }
  return {joined({first, second}), {first, second}, Rule::kUnion};
}

SolidOperand self_crossing(Random& random) {
  const double height = whole(random, 1, 4);
  switch (random() % 3) {
    case 0:  // an hourglass, of which one half is inside out
      return {fan_prism_parts({{-2, -2}, {2, 2}, {2, -2}, {-2, 2}}, height),
              {fan_prism_parts({{0, 0}, {2, -2}, {2, 2}}, height),
               fan_prism_parts({{0, 0}, {-2, 2}, {-2, -2}}, height)},
              Rule::kUnion};
    case 1:  // a loop that surrounds a square twice
      return {fan_prism_parts({{-2, -2}, {4, -2}, {4, 4}, {0, 4}, {0, 0}, {2, 0}, {2, 2}, {-2, 2}},
                              height),
              {box_parts(Vec3(-2, -2, 0), Vec3(4, 2, height)),
               box_parts(Vec3(0, 2, 0), Vec3(4, 4, height))},
              Rule::kUnion};
    default: {  // the triangles of a ball between random points
      MeshParts parts = icosphere_parts(1, 0);
      for (Vec3& vertex : parts.vertices) vertex = lattice_point(random, -3, 3);
      return {parts, {}, Rule::kUnknown};
    }
  }
}

SolidOperand fresh_operand(Random& random) {
  constexpr uint32_t kSelfCrossing = 2;
  SolidOperand operand;
  const uint32_t kind = random() % 10;
  switch (kind) {
    case 0:
      operand = hollow(random);
      break;
    case 1:
      operand = two_shells(random);
      break;
    case kSelfCrossing:
      operand = self_crossing(random);
      break;
    default: {
      const MeshParts shape = simple_shape(random);
      operand = {shape, {shape}, Rule::kUnion};
    }
  }
  if (random() % 2) map(operand, signed_permutation(random));
  // Where a surface crosses itself, its shells would be rounded otherwise.
  if (random() % 8 == 0 && kind != kSelfCrossing) {
    map(operand, random_affine(random).linear);
    operand.surface = rounded(operand.surface);
    for (MeshParts& shell : operand.shells) shell = rounded(shell);
  }
  if (random() % 2) move(operand, lattice_point(random, -3, 3));
  if (random() % 8 == 0) operand.surface = operand.surface.inside_out();
  return operand;
}

/// Returns the largest absolute coordinate.
double reach(const SolidOperand& operand) {
  double result = 0;
  for (const Vec3& p : operand.surface.vertices) {
    result = std::max({result, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return result;
}

/// An operand that shares planes with another one, or nearly so.
SolidOperand related_operand(SolidOperand operand, Random& random) {
  constexpr double kFar = 16;  // what lies beyond is not moved further
  switch (reach(operand) > kFar ? 0 : random() % 8) {
    case 0:
      break;  // equal
    case 1:
    case 2: {
      Vec3 offset(0.0);
      offset[whole(random, 0, 2)] = whole(random, -4, 4);
      move(operand, offset);
      break;
    }
    case 3:
      map(operand, signed_permutation(random));
      break;
    case 4: {
      Vec3 offset(0.0);
      offset[whole(random, 0, 2)] = random() % 2 ? kSliver : -kSliver;
      move(operand, offset);
      break;
    }
    case 5: {  // the mirror image beyond its own side, with other diagonals
      Mat3 mirror(1.0);
      const int axis = whole(random, 0, 2);
      mirror[axis][axis] = -1;
      double side = operand.surface.vertices[0][axis];
      for (const Vec3& vertex : operand.surface.vertices) side = std::max(side, vertex[axis]);
      Vec3 offset(0.0);
      offset[axis] = 2 * side;
      map(operand, mirror);
      move(operand, offset);
      break;
    }
    case 6: {
      Mat3 stretch(1.0);
      const int axis = whole(random, 0, 2);
      stretch[axis][axis] = random() % 2 ? 2 : 3;
      map(operand, stretch);
      break;
    }
    default:
      operand.surface = operand.surface.inside_out();
  }
  return operand;
}

/// Operations open and close at random between the operands. Intersections are rarer, since deep
/// ones are mostly empty.
std::vector<Step> random_steps(Random& random, uint32_t operands) {
  constexpr Op kOps[] = {Op::kUnion,      Op::kUnion,      Op::kUnion,       Op::kDifference,
                         Op::kDifference, Op::kDifference, Op::kIntersection};
  std::vector<uint32_t> order(operands);
  std::iota(order.begin(), order.end(), 0u);
  if (random() % 4 == 0) std::shuffle(order.begin(), order.end(), random);
  std::vector<Step> steps;
  int depth = 0;
  const double share = random() % 3 ? 0.5 : 0.15;  // flat trees have operations of many operands
  for (const uint32_t operand : order) {
    while (depth < kMostDepth && (steps.empty() || by_chance(random, share))) {
      steps.push_back({Step::Kind::kOpen, kOps[random() % std::size(kOps)], 0});
      ++depth;
    }
    steps.push_back({Step::Kind::kOperand, Op::kUnion, operand});
    for (; depth > 0 && by_chance(random, 0.8 * share); --depth) {
      steps.push_back({Step::Kind::kClose, Op::kUnion, 0});
    }
  }
  for (; depth > 0; --depth) steps.push_back({Step::Kind::kClose, Op::kUnion, 0});
  return steps;
}

/// Adds an operand as the operation on its shells, which are `first_shell` and the next ones.
void add_shells(const SolidOperand& operand, uint32_t first_shell, CsgTreeBuilder& builder) {
  const auto shells = static_cast<uint32_t>(operand.shells.size());
  if (shells == 0) {
    builder.empty();
    return;
  }
  const auto add_operation = [&](Op op, bool is_reversed) {
    builder.open(op);
    for (uint32_t i = 0; i < shells; ++i) {
      builder.primitive(first_shell + (is_reversed ? shells - 1 - i : i));
    }
    builder.close();
  };
  if (operand.rule == Rule::kSeparatePair) {
    builder.open(Op::kUnion);
    add_operation(Op::kDifference, false);
    add_operation(Op::kDifference, true);
    builder.close();
  } else {
    add_operation(Op::kUnion, false);
  }
}

CsgTree build(const std::vector<Step>& steps,
              const std::function<void(uint32_t, CsgTreeBuilder&)>& add_operand) {
  CsgTreeBuilder builder;
  for (const Step& step : steps) {
    if (step.kind == Step::Kind::kOpen) builder.open(step.op);
    if (step.kind == Step::Kind::kOperand) add_operand(step.operand, builder);
    if (step.kind == Step::Kind::kClose) builder.close();
  }
  return builder.finish();
}

/// Leaves out operations without operands.
void drop_empty_operations(std::vector<Step>& steps) {
  std::vector<Step> kept;
  for (const Step& step : steps) {
    if (step.kind == Step::Kind::kClose && kept.back().kind == Step::Kind::kOpen) {
      kept.pop_back();
    } else {
      kept.push_back(step);
    }
  }
  steps = std::move(kept);
}

}  // namespace

csgcore::TriangleSet surface_of(const MeshParts& parts) {
  return {parts.vertices, parts.triangles};
}

std::vector<csgcore::TriangleSet> RandomSolid::surfaces() const {
  std::vector<csgcore::TriangleSet> result;
  for (const SolidOperand& operand : operands) result.push_back(surface_of(operand.surface));
  return result;
}

CsgTree RandomSolid::tree() const {
  return build(steps,
               [](uint32_t operand, CsgTreeBuilder& builder) { builder.primitive(operand); });
}

bool RandomSolid::has_shells() const {
  return std::none_of(operands.begin(), operands.end(),
                      [](const SolidOperand& operand) { return operand.rule == Rule::kUnknown; });
}

CsgTree RandomSolid::tree_of_shells(std::vector<MeshParts>& shells) const {
  std::vector<uint32_t> first;
  for (const SolidOperand& operand : operands) {
    first.push_back(static_cast<uint32_t>(shells.size()));
    shells.insert(shells.end(), operand.shells.begin(), operand.shells.end());
  }
  return build(steps, [&](uint32_t operand, CsgTreeBuilder& builder) {
    add_shells(operands[operand], first[operand], builder);
  });
}

RandomSolid RandomSolid::without_operand(uint32_t operand) const {
  RandomSolid result;
  for (uint32_t i = 0; i < operands.size(); ++i) {
    if (i != operand) result.operands.push_back(operands[i]);
  }
  for (Step step : steps) {
    if (step.kind == Step::Kind::kOperand) {
      if (step.operand == operand) continue;
      if (step.operand > operand) --step.operand;
    }
    result.steps.push_back(step);
  }
  drop_empty_operations(result.steps);
  return result;
}

RandomSolid RandomSolid::without_operation(uint32_t open) const {
  RandomSolid result{operands, {}};
  std::vector<bool> is_kept;  // by operation that is open
  uint32_t opened = 0;
  for (const Step& step : steps) {
    if (step.kind == Step::Kind::kOpen) is_kept.push_back(opened++ != open);
    const bool is_operand = step.kind == Step::Kind::kOperand;
    if (is_operand || is_kept.back()) result.steps.push_back(step);
    if (step.kind == Step::Kind::kClose) is_kept.pop_back();
  }
  return result;
}

uint32_t RandomSolid::operation_count() const {
  return static_cast<uint32_t>(std::count_if(
      steps.begin(), steps.end(), [](const Step& step) { return step.kind == Step::Kind::kOpen; }));
}

std::string RandomSolid::as_openscad() const {
  constexpr const char* kNames[] = {"union", "intersection", "difference"};
  std::string text;
  const auto add = [&](const char* format, auto... values) {
    char buffer[200];
    std::snprintf(buffer, sizeof(buffer), format, values...);
    text += buffer;
  };
  for (const Step& step : steps) {
    if (step.kind == Step::Kind::kOpen) add("%s() {\n", kNames[size_t(step.op)]);
    if (step.kind == Step::Kind::kClose) text += "}\n";
    if (step.kind != Step::Kind::kOperand) continue;
    add("/* operand %u */ polyhedron([", step.operand);
    const MeshParts& surface = operands[step.operand].surface;
    for (const Vec3& p : surface.vertices) add("[%.17g, %.17g, %.17g], ", p.x, p.y, p.z);
    text += "], [";
    // OpenSCAD lists a face clockwise.
    for (const auto& [a, b, c] : surface.triangles) add("[%u, %u, %u], ", a, c, b);
    text += "]);\n";
  }
  return text;
}

RandomSolid random_solid(uint32_t seed) {
  Random random(seed);
  RandomSolid solid;
  uint32_t count = random() % 3 ? uint32_t(whole(random, 2, 4)) : 1 + random() % kMostOperands;
  if (random() % 50 == 0) count = kManyOperands;
  while (solid.operands.size() < count) {
    const bool is_related = !solid.operands.empty() && by_chance(random, 0.5);
    solid.operands.push_back(
        is_related ? related_operand(solid.operands[random() % solid.operands.size()], random)
                   : fresh_operand(random));
  }
  if (by_chance(random, 0.2)) {
    const Mat3 turn = turn_345(random);
    for (SolidOperand& operand : solid.operands) map(operand, random() % 2 ? Mat3(5.0) : turn);
  }
  if (by_chance(random, 0.1)) {
    const Vec3 offset(256 * whole(random, -3, 3), 100 * whole(random, -9, 9), 7);
    for (SolidOperand& operand : solid.operands) move(operand, offset);
  }
  solid.steps = random_steps(random, count);
  return solid;
}

RandomSolid minimised(const RandomSolid& solid,
                      const std::function<bool(const RandomSolid&)>& fails) {
  RandomSolid smallest = solid;
  const auto try_smaller = [&](RandomSolid smaller) {
    const bool still_fails = fails(smaller);
    if (still_fails) smallest = std::move(smaller);
    return still_fails;
  };
  for (bool is_smaller = true; is_smaller;) {
    is_smaller = false;
    for (auto i = static_cast<uint32_t>(smallest.operands.size()); i-- > 0;) {
      is_smaller |= try_smaller(smallest.without_operand(i));
    }
    for (uint32_t i = smallest.operation_count(); i-- > 0;) {
      is_smaller |= try_smaller(smallest.without_operation(i));
    }
  }
  return smallest;
}

MeshParts fan_prism_parts(const std::vector<std::array<double, 2>>& loop, double height) {
  MeshParts parts;
  const auto n = static_cast<uint32_t>(loop.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : loop) parts.add(Vec3(x, y, z));
  }
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t next = (i + 1) % n;
    parts.triangles.push_back({i, next, n + next});
    parts.triangles.push_back({i, n + next, n + i});
    if (i == 0 || next == 0) continue;
    parts.triangles.push_back({0, next, i});
    parts.triangles.push_back({n, n + i, n + next});
  }
  return parts;
}

MeshParts u_prism_parts(double unit, double height) {
  const double t = unit;
  // Counterclockwise, from the lower left corner.
  const double outline[][2] = {{0, 0},     {3 * t, 0}, {3 * t, 2 * t}, {2 * t, 2 * t},
                               {2 * t, t}, {t, t},     {t, 2 * t},     {0, 2 * t}};
  constexpr uint32_t kCap[][3] = {{0, 5, 6}, {0, 6, 7}, {1, 2, 3}, {1, 3, 4}, {0, 1, 4}, {0, 4, 5}};
  MeshParts parts;
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : outline) parts.add(Vec3(x, y, z));
  }
  for (const auto& [a, b, c] : kCap) {
    parts.triangles.push_back({a, c, b});
    parts.triangles.push_back({8 + a, 8 + b, 8 + c});
  }
  for (uint32_t a = 0; a < 8; ++a) {
    const uint32_t b = (a + 1) % 8;
    parts.triangles.push_back({a, b, 8 + b});
    parts.triangles.push_back({a, 8 + b, 8 + a});
  }
  return parts;
}

}  // namespace test_support
