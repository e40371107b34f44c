#include "nef_scenes.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>

namespace oracle {
namespace {

using csgcore::Affine;
using csgcore::Op;
using csgcore::Vec3;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Writes all digits, so that OpenSCAD reads the same double.
std::string text_of(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

std::string text_of(const Affine& map) {
  std::string text = "multmatrix([";
  for (int row = 0; row < 3; ++row) {
    text += "[";
    for (int column = 0; column < 3; ++column) text += text_of(map.linear[column][row]) + ",";
    text += text_of(map.translation[row]) + "],";
  }
  return text + "[0,0,0,1]]) ";
}

/// Half of the maps shift by integers, so that faces coincide.
Affine random_map(std::mt19937& random) {
  Affine map;
  if (random() % 2 == 0) {
    for (int i = 0; i < 3; ++i) map.translation[i] = int(random() % 5) - 2;
    return map;
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) map.linear[i][k] += uniform(random, -0.8, 0.8);
    map.translation[i] = uniform(random, -2, 2);
  }
  return map;
}

struct RandomPart {
  FacetedSolid polyhedron;
  std::string scad;
};

RandomPart random_part(std::mt19937& random) {
  const Affine map = random_map(random);
  const int fn = 3 + int(random() % 6);
  const std::string place = text_of(map);
  const std::string fragments = ", $fn = " + std::to_string(fn) + ");";
  switch (random() % 3) {
    case 0:
      return {box(Vec3(-1), Vec3(1), map), place + "cube(2, center = true);"};
    case 1: {
      const double r = uniform(random, 1, 2);
      return {sphere(r, fn, map), place + "sphere(r = " + text_of(r) + fragments};
    }
    default: {
      const double top = uniform(random, -1, 1.5);
      const double r = top > 0 ? top : 0;
      return {frustum(-1, 1, 1.5, r, fn, map), place + "cylinder(h = 2, r1 = 1.5, r2 = " +
                                                   text_of(r) + ", center = true" + fragments};
    }
  }
}

}  // namespace

FacetedSolid box(const Vec3& min, const Vec3& max, const Affine& local_to_world) {
  return {half_spaces(csgcore::Box{min, max}), local_to_world};
}

FacetedSolid sphere(double radius, int fragments, const Affine& local_to_world) {
  return faceted(csgcore::make_sphere(radius, local_to_world), fragments);
}

FacetedSolid frustum(double z_min, double z_max, double r_bottom, double r_top, int fragments,
                     const Affine& local_to_world) {
  return faceted(csgcore::make_frustum(z_min, z_max, r_bottom, r_top, local_to_world), fragments);
}

Affine shift(const Vec3& by) { return {csgcore::Mat3(1.0), by}; }

NefScene scene_of(Op op, std::vector<FacetedSolid> polyhedra) {
  csgcore::CsgTreeBuilder builder;
  builder.open(op);
  for (uint32_t i = 0; i < polyhedra.size(); ++i) builder.primitive(i);
  builder.close();
  return {builder.finish(), std::move(polyhedra)};
}

std::unique_ptr<const NefSolid> build(const NefScene& scene) {
  NefBuild result = NefSolid::build(scene.tree, scene.polyhedra);
  EXPECT_EQ(result.status, NefStatus::kBuilt) << result.reason;
  return result.solid ? std::move(result.solid) : NefSolid::build({}, {}).solid;
}

RandomScene random_scene(uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  RandomScene result;
  csgcore::CsgTreeBuilder builder;
  int depth = 0;
  const auto close = [&] {
    builder.close();
    result.scad += "}\n";
    --depth;
  };
  for (uint32_t i = 0; i < count; ++i) {
    // Most are unions: a deep tree of other operations is soon empty.
    if (depth < 3 && random() % 2 == 0) {
      constexpr Op kOps[] = {Op::kUnion, Op::kUnion, Op::kIntersection, Op::kDifference};
      const Op op = kOps[random() % 4];
      builder.open(op);
      result.scad += op == Op::kUnion          ? "union() {\n"
                     : op == Op::kIntersection ? "intersection() {\n"
                                               : "difference() {\n";
      ++depth;
    }
    RandomPart part = random_part(random);
    builder.primitive(i);
    result.scad += part.scad + "\n";
    result.scene.polyhedra.push_back(std::move(part.polyhedron));
    if (depth > 0 && random() % 4 == 0) close();
  }
  while (depth > 0) close();
  result.scene.tree = builder.finish();
  return result;
}

}  // namespace oracle
