// Tests which hulls are made anew when a design changes.
#include "solids/hull_pool.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "csgcore/scene_edit.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace frontend {
namespace {

std::string hull_of(double radius, double x) {
  return "multmatrix([[1,0,0," + std::to_string(x) +
         "],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { hull() { sphere(" + std::to_string(radius) +
         "); cube(9); } }";
}

/// Imports a version of a design, and returns how many hulls were made for it.
size_t made_for(const std::string& text, const std::shared_ptr<HullPool>& pool) {
  const size_t before = pool->made();
  ImportOptions options;
  options.hulls = pool;
  const ImportedDesign design = import_design(parse(text, "a.csg"), options);
  const ImportedDesign anew = import_design(parse(text, "a.csg"));
  EXPECT_TRUE(csgcore::compare(design.scene, anew.scene).nothing()) << text;
  return pool->made() - before;
}

TEST(HullPool, MakesWhatAnEditChangesAlone) {
  const auto pool = std::make_shared<HullPool>(HullPool::Keeps::kAll);
  const std::string first = hull_of(1, 0) + hull_of(2, 0) + "minkowski() { cube(1); sphere(3); }";
  EXPECT_EQ(made_for(first + hull_of(3, 0), pool), 4u);
  EXPECT_EQ(made_for(first + hull_of(3, 0), pool), 0u);
  EXPECT_EQ(made_for(first + hull_of(4, 0), pool), 1u);
  EXPECT_EQ(made_for("cube(1);" + first + hull_of(4, 20), pool), 0u) << "in another place";
  EXPECT_EQ(made_for(first, pool), 0u);
  EXPECT_EQ(made_for(first + hull_of(4, 0), pool), 1u) << "forgotten since";
}

TEST(HullPool, OfOneDesignMakesRepeatedOnesOnce) {
  const auto pool = std::make_shared<HullPool>();
  EXPECT_EQ(made_for(hull_of(1, 0) + hull_of(1, 5) + hull_of(1, 9) + hull_of(2, 0), pool), 2u);
}

}  // namespace
}  // namespace frontend
