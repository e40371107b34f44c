#include "heal/healing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <random>
#include <string>

#include "csgcore/polyhedron.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "heal/matrix_healing.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Mat3;
using csgcore::Primitive;
using csgcore::Vec3;

// Agreement in a design of size 10 to 30: a hundred roundings of a double.
constexpr double kAgrees = 1e-12;

double as_printed(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%g", value);
  return std::strtod(text.data(), nullptr);
}

Affine as_printed(Affine map) {
  for (int i = 0; i < 3; ++i) {
    map.translation[i] = as_printed(map.translation[i]);
    for (int k = 0; k < 3; ++k) map.linear[i][k] = as_printed(map.linear[i][k]);
  }
  return map;
}

double difference(const Mat3& a, const Mat3& b) {
  double result = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) result = std::max(result, std::abs(a[i][k] - b[i][k]));
  }
  return result;
}

double unorthogonality(const Mat3& m) { return difference(glm::transpose(m) * m, Mat3(1.0)); }

std::vector<Primitive> import_text(const std::string& text) {
  return import_design(parse(text, "a.csg")).scene.primitives;
}

/// Returns the .csg that the installed OpenSCAD writes for the design.
std::string exported(const std::string& scad) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("healing_test_" + std::to_string(getpid()) + ".scad");
  std::ofstream(path) << scad;
  const std::string command = "openscad -o - --export-format=csg " + path.string() + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer;
  for (size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe.get())) > 0;) {
    text.append(buffer.data(), n);
  }
  std::filesystem::remove(path);
  EXPECT_FALSE(text.empty()) << "openscad is needed";
  return text;
}

std::vector<Primitive> import_scad(const std::string& scad) { return import_text(exported(scad)); }

Vec3 cap_center(const Primitive& primitive, int cap) {
  const auto& frustum = primitive.as<csgcore::FrustumShape>();
  return primitive.local_to_world.point(Vec3(0, 0, cap == 0 ? frustum.z_min : frustum.z_max));
}

Vec3 cap_normal(const Primitive& primitive) {
  const Mat3& map = primitive.local_to_world.linear;
  return glm::normalize(glm::cross(map[0], map[1]));
}

/// Returns how far the cap of `b` leaves the plane of the cap of `a`, at most.
double plane_gap(const Primitive& a, int cap_a, const Primitive& b, int cap_b) {
  const auto& frustum = b.as<csgcore::FrustumShape>();
  const double radius = cap_b == 0 ? frustum.r_bottom : frustum.r_top;
  double gap = 0;
  for (int i = 0; i < 12; ++i) {
    const double angle = i * M_PI / 6;
    const Vec3 rim = b.local_to_world.direction(radius * Vec3(std::cos(angle), std::sin(angle), 0));
    const Vec3 offset = cap_center(b, cap_b) + rim - cap_center(a, cap_a);
    gap = std::max(gap, std::abs(glm::dot(cap_normal(a), offset)));
  }
  return gap;
}

double axis_gap(const Primitive& a, const Primitive& b) {
  const Vec3 axis = glm::normalize(a.local_to_world.linear[2]);
  double gap = 0;
  for (int cap = 0; cap < 2; ++cap) {
    const Vec3 offset = cap_center(b, cap) - cap_center(a, 0);
    gap = std::max(gap, glm::length(glm::cross(axis, offset)));
  }
  return gap;
}

/// The sides of a cube.
enum Side { kRight, kLeft, kBack, kFront, kTop, kBottom };

/// The four corners of a cube's side.
std::array<Vec3, 4> corners(const Primitive& cube, Side side) {
  const int axis = side / 2;
  std::array<Vec3, 4> result;
  for (int i = 0; i < 4; ++i) {
    Vec3 corner(0.0);
    corner[axis] = side % 2 == 0 ? 1 : 0;
    corner[(axis + 1) % 3] = i == 1 || i == 2;
    corner[(axis + 2) % 3] = i >= 2;
    result[i] = cube.local_to_world.point(corner);
  }
  return result;
}

Vec3 side_normal(const Primitive& cube, Side side) {
  const std::array<Vec3, 4> at = corners(cube, side);
  return glm::normalize(glm::cross(at[1] - at[0], at[3] - at[0]));
}

/// Returns how far the side of `b` leaves the plane of the side of `a`, at most.
double side_gap(const Primitive& a, Side side_a, const Primitive& b, Side side_b) {
  double gap = 0;
  for (const Vec3& corner : corners(b, side_b)) {
    gap = std::max(gap, std::abs(glm::dot(side_normal(a, side_a), corner - corners(a, side_a)[0])));
  }
  return gap;
}

// --- Numbers --------------------------------------------------------------------------------

TEST(HealingDigits, AreThoseOfThePrintedNumber) {
  const auto count = [](double value) { return digits_of(value).count; };
  EXPECT_EQ(count(0), 0);
  EXPECT_EQ(count(-120), 2);
  EXPECT_EQ(count(0.333333), 6);
  EXPECT_EQ(count(12.345), 5);
  EXPECT_EQ(count(1.23457e+06), 6);
  EXPECT_EQ(count(1e-07), 1);
  EXPECT_EQ(count(0.70710678118654752), 7);
  EXPECT_DOUBLE_EQ(digits_of(0.333333).half_unit, 5e-7);
  EXPECT_DOUBLE_EQ(digits_of(-12.3457).half_unit, 5e-5);
  EXPECT_DOUBLE_EQ(digits_of(0.5).half_unit, 5e-7);
  EXPECT_DOUBLE_EQ(digits_of(1.5).half_unit, 5e-6);
  EXPECT_DOUBLE_EQ(digits_of(1).half_unit, 5e-7);
  EXPECT_DOUBLE_EQ(digits_of(0.70710678118654752).half_unit, 0);
}

TEST(HealingDigits, BoundTheRoundingOfAnyNumber) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-8, 8);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::pow(10.0, exponent(random));
    const Digits digits = digits_of(as_printed(value));
    EXPECT_LE(digits.count, 6);
    EXPECT_LE(std::abs(value - as_printed(value)), digits.half_unit * (1 + 1e-9)) << value;
  }
}

// --- Matrices -------------------------------------------------------------------------------

Mat3 healed(const Mat3& design) { return heal_matrix(as_printed(Affine{design, {}})).map.linear; }

TEST(HealingMatrix, FindsTheAnglesOfTheDesign) {
  for (const Vec3& angles :
       {Vec3(17, 23, 41), Vec3(0, 0, 45), Vec3(30, 60, -45), Vec3(1, 2, 3),
        Vec3(12.5, -7.25, 133.33), Vec3(0, 90, 17), Vec3(20, -90, 0), Vec3(180, 0, 33.3),
        Vec3(0, 0, 360.0 / 7), Vec3(5 * 360.0 / 11, 0, 0), Vec3(170, 100, -170)}) {
    const HealedMatrix matrix = heal_matrix(as_printed(Affine{euler_rotation(angles), {}}));
    EXPECT_LT(difference(matrix.map.linear, euler_rotation(angles)), 1e-15) << angles.x;
    EXPECT_TRUE(matrix.exact) << angles.x;
  }
}

TEST(HealingMatrix, FindsAxisAngleMirrorAndScale) {
  const std::string scad =
      "rotate(33, [1, 1, 1]) sphere(); rotate(180, [1, 2, 0]) sphere(); mirror([1, 2, 3]) sphere();"
      "scale(2.5) rotate(40, [0, 1, 2]) sphere(); multmatrix([[1.2, -1.6, 0], [1.6, 1.2, 0], "
      "[0, 0, 2]]) sphere();";
  for (const Primitive& primitive : import_scad(scad)) {
    const Mat3& map = primitive.local_to_world.linear;
    EXPECT_LT(unorthogonality(map / glm::length(map[0])), 4e-16 * 4) << primitive.id;
  }
  const Mat3 mirror = import_scad("mirror([1, 2, 3]) sphere();")[0].local_to_world.linear;
  const Vec3 normal = glm::normalize(Vec3(1, 2, 3));
  EXPECT_LT(difference(mirror, Mat3(1.0) - 2.0 * glm::outerProduct(normal, normal)), 1e-15);
}

TEST(HealingMatrix, ScaledRotation) {
  const Mat3 design = euler_rotation(Vec3(17, 23, 41)) * 2.5;
  EXPECT_LT(difference(healed(design), design), 1e-15);
  const Mat3 third = euler_rotation(Vec3(17.123456, 23.234567, 41.345678)) / 3.0;
  const Mat3 result = healed(third);
  const double scale = glm::length(result[0]);
  EXPECT_LT(unorthogonality(result / scale), 1e-14);
  EXPECT_NEAR(scale, 1.0 / 3, 1e-6);
}

TEST(HealingMatrix, LeavesEverythingElseAsItIs) {
  const Mat3 scale(Vec3(0.333333, 0, 0), Vec3(0, 0.333333, 0), Vec3(0, 0, 0.333333));
  const Mat3 shear(Vec3(1, 0, 0), Vec3(0.2, 1, 0), Vec3(0, 0, 1));
  const Mat3 uneven =
      Mat3(Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)) * euler_rotation(Vec3(17, 23, 41));
  // A mistake of two units in the fifth digit is not rounding.
  Mat3 bent = euler_rotation(Vec3(0, 0, 30));
  bent[0][0] = 0.86605;
  for (const Mat3& matrix : {scale, shear, as_printed(Affine{uneven, {}}).linear, bent}) {
    EXPECT_EQ(heal_matrix({matrix, {}}).map.linear, matrix);
  }
  // A number that a person gave to 17 digits is right already.
  const Mat3 precise = euler_rotation(Vec3(17.123456, 23.234567, 41.345678));
  EXPECT_LT(difference(heal_matrix({precise, {}}).map.linear, precise), 1e-14);
}

TEST(HealingMatrix, RandomRotationsAndMirrors) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-180, 180);
  int kept = 0;
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    Mat3 design = euler_rotation(Vec3(angle(random), angle(random), angle(random)));
    if (i % 4 == 1) design = design * Mat3(-1.0);
    if (i % 4 == 2) design = euler_rotation(Vec3(0, 0, angle(random)));
    // Half of these have an entry of 0, which the file gives exactly.
    if (i % 4 == 3) design = euler_rotation(Vec3(0, angle(random), angle(random)));
    const Affine file = as_printed(Affine{design, {}});
    const HealedMatrix matrix = heal_matrix(file);
    // The result is never further from the design than the bound says.
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        EXPECT_LE(std::abs(matrix.map.linear[c][r] - file.linear[c][r]),
                  digits_of(file.linear[c][r]).half_unit + 1e-13);
        if (!matrix.exact) {
          EXPECT_LE(std::abs(matrix.map.linear[c][r] - design[c][r]),
                    matrix.linear_error[c][r] + 1e-13);
        }
      }
    }
    if (unorthogonality(matrix.map.linear) > 1e-14) ++kept;
    // Healing it again changes nothing.
    EXPECT_LT(difference(heal_matrix({matrix.map.linear, {}}).map.linear, matrix.map.linear),
              1e-14);
  }
  EXPECT_LT(kept, kCount / 200);
}

TEST(HealingMatrix, OfTranslationsIsTheIdentityWithABound) {
  const HealedMatrix rounded = heal_matrix({Mat3(1.0), Vec3(12.3457, 0.25, 3)});
  EXPECT_EQ(rounded.map.translation, Vec3(12.3457, 0.25, 3));
  EXPECT_DOUBLE_EQ(rounded.translation_error.x, 5e-5);
  EXPECT_EQ(rounded.translation_error.y, 0);
  EXPECT_TRUE(heal_matrix({Mat3(1.0), Vec3(12, 0.25, 3.5)}).exact);
}

// --- Features -------------------------------------------------------------------------------

TEST(HealingFeatures, FlushCapsInTurnedFrames) {
  // The design's angles cannot be guessed, and the caps coincide only in the design.
  const std::vector<Primitive> primitives = import_scad(
      "a = [17.12345678, 23.23456789, 41.3456789];"
      "rotate(a) cylinder(r = 5, h = 10);"
      "rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) translate([2, 0, 10]) "
      "  mirror([0, 0, 1]) cylinder(r = 1, h = 4);"
      "rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) translate([0, 2, 0]) "
      "  cylinder(r = 1, h = 10);");
  ASSERT_EQ(primitives.size(), 3u);
  EXPECT_LT(plane_gap(primitives[0], 1, primitives[1], 0), kAgrees);
  EXPECT_LT(plane_gap(primitives[0], 1, primitives[2], 1), kAgrees);
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[2], 0), kAgrees);
}

TEST(HealingFeatures, NestedAnglesThatAreToBeGuessed) {
  const std::vector<Primitive> primitives = import_scad(
      "rotate([17, 23, 41]) rotate([7, 0, 0]) { cylinder(r = 5, h = 10);"
      "rotate([0, 0, 13]) rotate([11, 0, 0]) rotate([-11, 0, 0]) translate([1, 1, 0])"
      "cylinder(r = 2, h = 10); }");
  EXPECT_LT(plane_gap(primitives[0], 1, primitives[1], 1), kAgrees);
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[1], 0), kAgrees);
}

TEST(HealingFeatures, CoaxialCylindersInTurnedFrames) {
  const std::vector<Primitive> primitives = import_scad(
      "a = [17.12345678, 23.23456789, 41.3456789];"
      "translate([1/3, 2/3, 5/3]) rotate(a) cylinder(r = 5, h = 10);"
      "translate([1/3, 1/3, 1/3]) translate([0, 1/3, 4/3]) rotate([0, 0, a.z])"
      "rotate([0, a.y, 0]) rotate([a.x, 0, 0]) rotate([0, 0, 33.3333333])"
      "translate([0, 0, 1.5]) "
      "cylinder(r1 = 2, r2 = 1, h = 6);");
  EXPECT_LT(axis_gap(primitives[0], primitives[1]), kAgrees);
  EXPECT_LT(axis_gap(primitives[1], primitives[0]), kAgrees);
}

TEST(HealingFeatures, SphereCentresAndRadii) {
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 0]) sphere(1);"
      "translate([1/3, 0, 0]) translate([1/3, 0, 0]) scale(1/3) sphere(3);");
  EXPECT_LT(glm::length(primitives[0].local_to_world.translation -
                        primitives[1].local_to_world.translation),
            kAgrees);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(3 * glm::length(primitives[1].local_to_world.linear[i]), 1, kAgrees);
  }
}

TEST(HealingFeatures, CylinderRadiusOfAScaledFrame) {
  const std::vector<Primitive> primitives =
      import_scad("cylinder(r = 1, h = 5); scale([1/3, 1/3, 1]) cylinder(r = 3, h = 4);");
  EXPECT_NEAR(3 * glm::length(primitives[1].local_to_world.linear[0]), 1, kAgrees);
  EXPECT_EQ(cap_center(primitives[1], 1), Vec3(0, 0, 4));
}

TEST(HealingFeatures, LiteralDifferencesStay) {
  const auto expect_untouched = [](const std::string& text) {
    const DesignTree tree = parse(text, "a.csg");
    for (const Primitive& primitive : import_design(tree).scene.primitives) {
      const Mat3& map = primitive.local_to_world.linear;
      EXPECT_LT(unorthogonality(map), 1e-15) << text;
    }
  };
  const std::string turned =
      "multmatrix([[0.694714,-0.541175,0.473816,0],[0.603906,0.79668,0.024486,0],"
      "[-0.390731,0.26913,0.880283,0],[0,0,0,1]]) {";
  const std::string unguessed =  // 17.12345678, 23.23456789, 41.3456789
      "multmatrix([[0.689851,-0.544118,0.477537,0.333333],[0.607024,0.79419,0.0280116,0.666667],"
      "[-0.394496,0.270552,0.878165,1.66667],[0,0,0,1]]) {";
  const std::string two = "cylinder(h = 1, r = 2); cylinder(h = 0.999999, r = 1); }";
  for (const std::string& frame : {turned, unguessed, std::string("group() {")}) {
    const std::vector<Primitive> primitives = import_text(frame + two);
    EXPECT_NEAR(plane_gap(primitives[0], 1, primitives[1], 1), 1e-6, 1e-10);
    expect_untouched(frame + two);
    // Numbers in two frames inside it are as literal.
    const std::string shifted =
        "multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0]]) { cylinder(h = 1, r = 2); }"
        "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0]]) { cylinder(h = 0.999999, r = 1); } }";
    const std::vector<Primitive> others = import_text(frame + shifted);
    EXPECT_NEAR(plane_gap(others[0], 1, others[1], 1), 1e-6, 1e-10);
  }
}

TEST(HealingFeatures, NumbersThatArePrintedDifferentlyInOneStepDiffer) {
  const std::vector<Primitive> primitives = import_text(
      "multmatrix([[1,0,0,0.123456],[0,1,0,0],[0,0,1,0.333333]]) { cylinder(h = 2, r = 2); }"
      "multmatrix([[1,0,0,0.123456],[0,1,0,0],[0,0,1,0.333334]]) { cylinder(h = 3, r = 1); }");
  EXPECT_NEAR(plane_gap(primitives[0], 0, primitives[1], 0), 1e-6, 1e-10);
}

TEST(HealingFeatures, WhatIsExactLeadsWhereverItStands) {
  const std::vector<Primitive> primitives = import_scad(
      "translate([0, 0, 1/3]) translate([0, 0, 1/3]) translate([0, 0, 1/3]) cylinder(h = 3, r = 2);"
      "translate([0, 0, 1]) cylinder(h = 5, r = 1);");
  EXPECT_EQ(primitives[1].local_to_world.translation, Vec3(0, 0, 1));
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[1], 0), kAgrees);
}

TEST(HealingFeatures, WhatIsRoundIsHealedBeforeItGetsFacets) {
  const std::vector<Primitive> primitives = import_scad(
      "cylinder(r = 1, h = 5, $fn = 6); scale([1/3, 1/3, 1]) cylinder(r = 3, h = 4, $fn = 6);");
  ASSERT_EQ(primitives[1].shape(), csgcore::Shape::kPolyhedron);
  EXPECT_EQ(primitives[0].polyhedron(), primitives[1].polyhedron());
  EXPECT_NEAR(glm::length(primitives[1].local_to_world.linear[0]), 1, kAgrees);
}

TEST(HealingFeatures, AnAxisMovesAlongObliqueCaps) {
  const std::string shear = "multmatrix([[1, 0, 0.5], [0, 1, 0], [0, 0, 1]])";
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 0]) " + shear + " cylinder(h = 3, r = 2);" +
      "translate([1/3, 0, 0]) translate([1/3, 0, 0]) " + shear + "cylinder(h = 2, r = 1);");
  EXPECT_LT(axis_gap(primitives[0], primitives[1]), kAgrees);
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[1], 0), kAgrees);
}

TEST(HealingFeatures, BothCapsOfOneCylinderMayBeShared) {
  // Two plates in different frames, and a bolt in a third between them.
  const std::vector<Primitive> primitives = import_scad(
      "a = [17.12345678, 23.23456789, 41.3456789];"
      "rotate(a) translate([0, 0, 10/3]) cylinder(r = 5, h = 1);"
      "rotate(a) translate([0, 0, -10/3]) mirror([0, 0, 1]) cylinder(r = 5, h = 1);"
      "rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) scale(1/3)"
      "cylinder(r = 3, h = 20, center = true);");
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[2], 1), kAgrees);
  EXPECT_LT(plane_gap(primitives[1], 0, primitives[2], 0), kAgrees);
  EXPECT_LT(axis_gap(primitives[0], primitives[2]), kAgrees);
}

TEST(HealingFeatures, FlushCubesInTurnedFrames) {
  // The angles cannot be guessed, and the top of the plate is the others' bottom only in the
  // design.
  const std::vector<Primitive> primitives = import_scad(
      "a = [17.12345678, 23.23456789, 41.3456789];"
      "module turned() rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) children();"
      "rotate(a) cube([20, 20, 2]);"
      "turned() translate([3, 4, 2]) cube([5, 6, 7]);"
      "turned() translate([15, 15, 2]) cylinder(h = 3, r = 2);"
      "turned() translate([4, 13, 4]) cube(4, center = true);");
  const Vec3 normal = side_normal(primitives[0], kTop);
  EXPECT_LT(side_gap(primitives[0], kTop, primitives[1], kBottom), kAgrees);
  EXPECT_LT(side_gap(primitives[0], kTop, primitives[3], kBottom), kAgrees);
  EXPECT_LT(
      std::abs(glm::dot(normal, cap_center(primitives[2], 0) - corners(primitives[0], kTop)[0])),
      kAgrees);
  EXPECT_LT(glm::length(glm::cross(normal, cap_normal(primitives[2]))), kAgrees);
  // The rest moves by no more than the rounding.
  EXPECT_NEAR(glm::length(corners(primitives[1], kTop)[2] - corners(primitives[1], kBottom)[3]),
              std::hypot(5, 7), 2e-5);
}

TEST(HealingFeatures, EachFaceOfACubeMovesAlone) {
  // A cube at 0.333333 + 0.333333 between neighbours at 0.666667 below and 2.66667 above, along
  // every axis.
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 2/3, 2/3]) translate([-4, -4, -4]) cube(4);"
      "translate([8/3, 8/3, 8/3]) cube(4);"
      "translate([1/3, 1/3, 1/3]) translate([1/3, 1/3, 1/3]) cube(2);");
  const Primitive& cube = primitives[2];
  for (const Side upper : {kRight, kBack, kTop}) {
    const Side lower = static_cast<Side>(upper + 1);
    EXPECT_LT(side_gap(primitives[0], upper, cube, lower), kAgrees);
    EXPECT_LT(side_gap(primitives[1], lower, cube, upper), kAgrees);
  }
  EXPECT_NEAR(cube.local_to_world.linear[0].x, 2.000003, 1e-9);
}

TEST(HealingFeatures, AMovedFaceTearsNothingElse) {
  // A and B are in one frame and share a plane; A's other side is flush with C's.
  const std::vector<Primitive> primitives = import_scad(
      "translate([0, 0, 2/3]) translate([0, 0, -1]) cube(1);"
      "translate([0, 0, 1/3]) translate([0, 0, 1/3]) {"
      "  cube([1, 1, 2]); translate([3, 0, 1]) cube(1); }");
  EXPECT_LT(side_gap(primitives[0], kTop, primitives[1], kBottom), kAgrees);
  EXPECT_LT(side_gap(primitives[1], kTop, primitives[2], kTop), kAgrees);
  EXPECT_NEAR(primitives[2].local_to_world.translation.z, 1.666666, 1e-12);
}

TEST(HealingFeatures, AFaceOfAShearedCubeMovesAlongTheOthers) {
  // A move along its normal would take along the leaning top and bottom, which B shares.
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 0]) translate([-1, 0, 0]) cube([1, 9, 9]);"
      "translate([1/3, 0, 0]) translate([1/3, 0, 0])"
      "  multmatrix([[1, 0, 0], [0, 1, 0], [0.5, 0, 1]]) {"
      "    cube(1); translate([3, 3, 0]) cube(1); }");
  EXPECT_LT(side_gap(primitives[0], kRight, primitives[1], kLeft), kAgrees);
  EXPECT_LT(side_gap(primitives[1], kTop, primitives[2], kTop), kAgrees);
  EXPECT_LT(side_gap(primitives[1], kBottom, primitives[2], kBottom), kAgrees);
}

TEST(HealingFeatures, AMovedCapTearsNothingElse) {
  // The same with cylinders, and with a hexagonal prism that is a polyhedron.
  const std::vector<Primitive> primitives = import_scad(
      "translate([0, 0, 2/3]) mirror([0, 0, 1]) cylinder(r = 5, h = 1);"
      "translate([0, 0, 1/3]) translate([0, 0, 1/3]) {"
      "  cylinder(h = 2, r = 1); translate([3, 0, 1]) cylinder(h = 1, r = 1);"
      "  polyhedron([for (z = [0, 2], i = [0 : 5]) [cos(60 * i), sin(60 * i), z]],"
      "    [[0, 1, 2, 3, 4, 5], [11, 10, 9, 8, 7, 6], [0, 6, 7, 1], [1, 7, 8, 2], [2, 8, 9, 3],"
      "     [3, 9, 10, 4], [4, 10, 11, 5], [5, 11, 6, 0]]); }");
  EXPECT_LT(plane_gap(primitives[0], 0, primitives[1], 0), kAgrees);
  EXPECT_LT(plane_gap(primitives[1], 1, primitives[2], 1), kAgrees);
  const Affine& prism = primitives[3].local_to_world;
  EXPECT_NEAR(prism.translation.z, 0.666667, kAgrees);
  EXPECT_NEAR(prism.translation.z + prism.linear[2].z, 2.666666, kAgrees);
}

TEST(HealingFeatures, TwoFacesThatCannotBothBeReachedDoNotUndoOneAnother) {
  // Three chains of rounded matrices represent one rotation: the plates are not parallel.
  const std::vector<Primitive> primitives = import_scad(
      "a = [17.12345678, 23.23456789, 41.3456789];"
      "rotate(a) cube([20, 20, 2]);"
      "rotate([0, 0, a.z]) rotate([a.x, a.y, 0]) translate([0, 0, 5]) cube([20, 20, 2]);"
      "rotate([0, 0, a.z]) rotate([0, a.y, 0]) rotate([a.x, 0, 0]) translate([5, 5, 2])"
      "  cube([10, 10, 3]);");
  EXPECT_GT(glm::length(
                glm::cross(side_normal(primitives[0], kTop), side_normal(primitives[1], kBottom))),
            1e-8);
  EXPECT_LT(side_gap(primitives[0], kTop, primitives[2], kBottom), kAgrees) << "it comes first";
  EXPECT_LT(side_gap(primitives[1], kBottom, primitives[2], kTop), 2e-5);
}

TEST(HealingFeatures, SidesOfACubeInAShearedFrameStay) {
  const std::string shear = "multmatrix([[1, 0, 0.5], [0, 1, 0.25], [0, 0, 1]])";
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 2/3]) " + shear + " cube([1, 1, 2]);" +
      "translate([1/3, 0, 1/3]) translate([1/3, 0, 1/3]) " + shear + " cube([1, 1, 3]);");
  for (const Side side : {kLeft, kRight, kFront, kBack, kBottom}) {
    EXPECT_LT(side_gap(primitives[0], side, primitives[1], side), kAgrees) << side;
  }
}

TEST(HealingFeatures, CubeOfAScaledFrame) {
  const std::vector<Primitive> primitives =
      import_scad("cube(1); scale([1/3, 1/7, 1]) cube([3, 7, 2]);");
  EXPECT_NEAR(primitives[1].local_to_world.linear[0].x, 1, kAgrees);
  EXPECT_NEAR(primitives[1].local_to_world.linear[1].y, 1, kAgrees);
}

TEST(HealingFeatures, PolyhedraMoveAsAWhole) {
  // A truncated pyramid on a plate and against a wall. Its top cannot stay in place unless its
  // sides move.
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 2/3]) { translate([0, 0, -1]) cube([9, 9, 1]);"
      "  translate([-1, 0, 0]) cube([1, 9, 9]); }"
      "translate([1/3, 1, 1/3]) translate([1/3, 1, 1/3]) polyhedron("
      "points = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0], [0, 1, 5], [2, 1, 5], [2, 2, 5],"
      "  [0, 2, 5]], faces = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 3, 7, 4], [0, 4, 5, 1], [1, 5, 6, 2],"
      "  [3, 2, 6, 7]]);");
  const Affine& pyramid = primitives[2].local_to_world;
  EXPECT_EQ(pyramid.translation, Vec3(0.666667, 2, 0.666667));
  EXPECT_LT(difference(pyramid.linear, Mat3(4.0)), kAgrees);
}

TEST(HealingFeatures, PolyhedraMoveAlongWhatTheyShareAlready) {
  // A wall that leans, x = z / 2, and a floor; the tetrahedron touches both.
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 2/3]) { translate([0, 0, -1]) cube([9, 9, 1]);"
      "  multmatrix([[1, 0, 0.5], [0, 1, 0], [0, 0, 1]]) translate([-1, 0, 0]) cube([1, 9, 9]); }"
      "translate([1/3, 1, 1/3]) translate([1/3, 1, 1/3]) polyhedron("
      "points = [[0, 0, 0], [4, 0, 0], [0, 3, 0], [2, 0, 4]],"
      "faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);");
  EXPECT_NEAR(primitives[2].local_to_world.translation.x, 0.666667, kAgrees);
  EXPECT_NEAR(primitives[2].local_to_world.translation.z, 0.666667, kAgrees);
}

TEST(HealingFeatures, MeshesMoveByTheirPlanes) {
  // An L on a floor and against a wall.
  const std::vector<Primitive> primitives = import_scad(
      "translate([2/3, 0, 2/3]) { translate([0, 0, -1]) cube([9, 9, 1]);"
      "  translate([-1, 0, 0]) cube([1, 9, 9]); }"
      "translate([1/3, 1, 1/3]) translate([1/3, 1, 1/3]) polyhedron("
      "points = [for (z = [0, 2], p = [[0, 0], [6, 0], [6, 2], [2, 2], [2, 6], [0, 6]])"
      "  [p.x, p.y, z]], faces = concat([[0, 1, 2, 3, 4, 5], [11, 10, 9, 8, 7, 6]],"
      "  [for (i = [0:5]) [i, i + 6, (i + 1) % 6 + 6, (i + 1) % 6]]));");
  EXPECT_EQ(primitives[2].shape(), csgcore::Shape::kMesh);
  EXPECT_EQ(primitives[2].local_to_world.translation, Vec3(0.666667, 2, 0.666667));
}

TEST(HealingFeatures, LiteralDifferencesOfCubesStay) {
  const std::string turned =  // 17.12345678, 23.23456789, 41.3456789
      "multmatrix([[0.689851,-0.544118,0.477537,0.333333],[0.607024,0.79419,0.0280116,0.666667],"
      "[-0.394496,0.270552,0.878165,1.66667],[0,0,0,1]]) {";
  for (const std::string& frame : {turned, std::string("group() {")}) {
    const std::vector<Primitive> primitives =
        import_text(frame +
                    "cube([2, 2, 1]); multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0]]) {"
                    "cube([1, 1.000001, 0.999999]); } }");
    EXPECT_NEAR(side_gap(primitives[0], kTop, primitives[1], kTop), 1e-6, 1e-10);
    EXPECT_LT(side_gap(primitives[0], kFront, primitives[1], kFront), 1e-15);
  }
}

TEST(HealingFeatures, RandomSpheresStay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-10, 10);
  std::string text;
  std::vector<Vec3> centers;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 center(as_printed(place(random)), as_printed(place(random)),
                      as_printed(place(random)));
    centers.push_back(center);
    std::array<char, 160> line;
    std::snprintf(
        line.data(), line.size(),
        "multmatrix([[1,0,0,%g],[0,1,0,%g],[0,0,1,%g],[0,0,0,1]]) { sphere(r = 0.06); }\n",
        center.x, center.y, center.z);
    text += line.data();
  }
  const std::vector<Primitive> primitives = import_text(text);
  for (size_t i = 0; i < primitives.size(); ++i) {
    ASSERT_EQ(primitives[i].local_to_world.translation, centers[i]) << i;
    ASSERT_EQ(primitives[i].local_to_world.linear, Mat3(1.0)) << i;
  }
}

std::shared_ptr<const csgcore::Polyhedron> unit_cube() {
  static const auto cube = csgcore::Polyhedron::box({Vec3(0.0), Vec3(1.0)});
  return cube;
}

/// Randomly nested frames with cylinders, cubes and spheres, some features of which coincide.
struct RandomDesign {
  FrameTree frames;
  std::vector<Primitive> primitives;
  std::vector<uint32_t> frame_of;
  csgcore::Box box;

  explicit RandomDesign(uint32_t seed) {
    std::mt19937 random(seed);
    const auto whole = [&](int from, int to) {
      return std::uniform_int_distribution<int>(from, to)(random);
    };
    std::uniform_real_distribution<double> angle(-180, 180);
    for (int i = 0; i < 40; ++i) {
      Affine map;
      if (i % 2 == 0) map.linear = euler_rotation(Vec3(0, 0, angle(random)));
      if (i % 5 == 0) map.linear = euler_rotation(Vec3(angle(random), 0, 0));
      if (i % 3 == 0) map.translation = Vec3(0, 0, whole(-2, 2) / 3.0);
      const uint32_t parent = static_cast<uint32_t>(whole(0, static_cast<int>(frames.size()) - 1));
      const uint32_t frame = frames.add(parent, heal_matrix(as_printed(map)));
      for (int k = 0; k < 2; ++k) {
        Primitive primitive =
            csgcore::make_frustum(0, whole(1, 3), whole(1, 2), whole(1, 2), frames[frame].to_world);
        if (i % 7 == 0) primitive = csgcore::make_sphere(1, frames[frame].to_world);
        if (i % 3 == 1) {
          primitive = csgcore::make_polyhedron(unit_cube(), frames[frame].to_world);
          for (int axis = 0; axis < 3; ++axis) {
            primitive.local_to_world.linear[axis] *= whole(1, 2);
          }
        }
        primitives.push_back(primitive);
        frame_of.push_back(frame);
        box.merge(primitive.local_to_world.translation + Vec3(4.0));
        box.merge(primitive.local_to_world.translation - Vec3(4.0));
      }
    }
  }
};

TEST(HealingFeatures, NothingMovesByMoreThanTheRoundingExplainsAndTwiceIsOnce) {
  int moved = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    RandomDesign design(seed);
    const std::vector<Primitive> before = design.primitives;
    merge_features(design.primitives, design.frame_of, design.frames, design.box);
    // No pair's bound exceeds twice the largest one, and a primitive follows at most four leaders.
    double bound = 0;
    for (const uint32_t frame : design.frame_of) {
      bound = std::max(bound,
                       design.frames[frame].point_error + 20 * design.frames[frame].linear_error);
    }
    for (size_t i = 0; i < before.size(); ++i) {
      const Affine& now = design.primitives[i].local_to_world;
      const Affine& then = before[i].local_to_world;
      for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(2, 0, 3), Vec3(0, 2, 3), Vec3(-2, -2, 0)}) {
        EXPECT_LE(glm::length(now.point(corner) - then.point(corner)), 8 * bound) << seed;
      }
      moved += now.linear != then.linear || now.translation != then.translation;
      if (design.frames[design.frame_of[i]].point_error == 0 &&
          design.frames[design.frame_of[i]].linear_error == 0) {
        EXPECT_EQ(now.linear, then.linear);
        EXPECT_EQ(now.translation, then.translation);
      }
    }
    const std::vector<Primitive> once = design.primitives;
    merge_features(design.primitives, design.frame_of, design.frames, design.box);
    for (size_t i = 0; i < once.size(); ++i) {
      EXPECT_LT(
          difference(design.primitives[i].local_to_world.linear, once[i].local_to_world.linear),
          kAgrees)
          << seed << ' ' << i;
      EXPECT_LT(glm::length(design.primitives[i].local_to_world.translation -
                            once[i].local_to_world.translation),
                kAgrees)
          << seed << ' ' << i;
    }
  }
  EXPECT_GT(moved, 200);  // otherwise the test proves nothing
}

}  // namespace
}  // namespace frontend
