// Tests which hulls and outcomes of operations are made anew when a design changes.
#include "solids/solid_pool.hpp"

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
size_t made_for(const std::string& text, const std::shared_ptr<SolidPool>& pool) {
  const size_t before = pool->made();
  ImportOptions options;
  options.solids = pool;
  const ImportedDesign design = import_design(parse(text, "a.csg"), options);
  const ImportedDesign anew = import_design(parse(text, "a.csg"));
  EXPECT_TRUE(csgcore::compare(design.scene, anew.scene).nothing()) << text;
  return pool->made() - before;
}

TEST(SolidPool, MakesWhatAnEditChangesAlone) {
  const auto pool = std::make_shared<SolidPool>(SolidPool::Keeps::kAll);
  const std::string first = hull_of(1, 0) + hull_of(2, 0) + "minkowski() { cube(1); sphere(3); }";
  EXPECT_EQ(made_for(first + hull_of(3, 0), pool), 4u);
  EXPECT_EQ(made_for(first + hull_of(3, 0), pool), 0u);
  EXPECT_EQ(made_for(first + hull_of(4, 0), pool), 1u);
  EXPECT_EQ(made_for("cube(1);" + first + hull_of(4, 20), pool), 0u) << "in another place";
  EXPECT_EQ(made_for(first, pool), 0u);
  EXPECT_EQ(made_for(first + hull_of(4, 0), pool), 1u) << "forgotten since";
}

TEST(SolidPool, OfOneDesignMakesRepeatedOnesOnce) {
  const auto pool = std::make_shared<SolidPool>();
  EXPECT_EQ(made_for(hull_of(1, 0) + hull_of(1, 5) + hull_of(1, 9) + hull_of(2, 0), pool), 2u);
}

std::string hull_of_cut(double side) {
  return "hull() { difference() { cube(" + std::to_string(side) +
         "); multmatrix([[1,0,0,1],[0,1,0,1],[0,0,1,1]]) { cube(9); } } }";
}

/// Returns how many boundaries are made for a version.
size_t boundaries_for(const std::string& text, const std::shared_ptr<SolidPool>& pool) {
  const size_t before = pool->boundaries_made();
  made_for(text, pool);
  return pool->boundaries_made() - before;
}

TEST(SolidPool, KeepsTheOutcomeOfOperations) {
  const auto pool = std::make_shared<SolidPool>(SolidPool::Keeps::kAll);
  EXPECT_EQ(boundaries_for(hull_of_cut(2) + hull_of_cut(3), pool), 2u);
  EXPECT_EQ(boundaries_for("cube(1);" + hull_of_cut(2) + hull_of_cut(3), pool), 0u);
  EXPECT_EQ(boundaries_for(hull_of_cut(2) + hull_of_cut(4), pool), 1u);
  EXPECT_EQ(boundaries_for(hull_of_cut(2) + hull_of_cut(3), pool), 1u) << "forgotten since";
}

TEST(SolidPool, KeepsWhatIsAddedToASolidInPieces) {
  // An L of two convex pieces, plus a cube with a notch.
  const std::string sum =
      "minkowski() { difference() { cube(4); multmatrix([[1,0,0,2],[0,1,0,2],[0,0,1,-1]]) { "
      "cube(9); } } difference() { cube(1); multmatrix([[1,0,0,0.5],[0,1,0,0.5],[0,0,1,0.5]]) { "
      "cube(9); } } }";
  const auto pool = std::make_shared<SolidPool>(SolidPool::Keeps::kAll);
  EXPECT_GT(boundaries_for(sum, pool), 2u);
  EXPECT_EQ(boundaries_for(sum + "sphere(1);", pool), 0u);
}

TEST(SolidPool, OfOneDesignMakesRepeatedBoundariesOnce) {
  const auto pool = std::make_shared<SolidPool>();
  EXPECT_EQ(boundaries_for(hull_of_cut(2) + hull_of_cut(2) + hull_of_cut(3), pool), 2u);
}

}  // namespace
}  // namespace frontend
