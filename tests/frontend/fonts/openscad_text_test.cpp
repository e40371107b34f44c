// Compares the letters of text() with what OpenSCAD exports: with a sample of the texts, or with
// all of them (SCADRAY_TEST_FULL).
//
// An SVG has six digits of each coordinate, and OpenSCAD rounds to multiples of 2^-16 before:
// letters are compared as far as these go.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "frontend/parser.hpp"
#include "plane/outlines.hpp"
#include "subtrees/subtree.hpp"
#include "support/full_run.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

bool openscad_installed() { return std::system("command -v openscad >/dev/null 2>&1") == 0; }

/// A .csg's text has no escapes, but in a .scad these characters need them.
std::string as_scad(const std::string& csg) {
  std::string scad;
  for (const char c : csg.substr(0, csg.size() - 1)) {
    scad += c == '\t' ? "\\t" : c == '\n' ? "\\n" : std::string(1, c);
  }
  return scad;
}

/// OpenSCAD's outlines of a .csg, closed; none if it exports nothing.
Polygons openscad_outlines(const TemporaryFolder& folder, const std::string& csg) {
  const std::string in = folder.write("text.scad", as_scad(csg));
  const std::string out = folder / "text.svg";
  std::filesystem::remove(out);
  const std::string command = "openscad -o '" + out + "' '" + in + "' >/dev/null 2>&1";
  static_cast<void>(std::system(command.c_str()));
  std::ifstream file(out);
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  Polygons result;
  const size_t begin = svg.find("<path d=\"");
  if (begin == std::string::npos) return result;
  std::istringstream path(svg.substr(begin + 9, svg.find('"', begin + 9) - begin - 9));
  std::string word;
  while (path >> word) {
    if (word == "M") result.emplace_back();
    if (word != "M" && word != "L") continue;
    double x = 0, y = 0;
    char comma = ' ';
    path >> x >> comma >> y;
    result.back().emplace_back(x, -y);
  }
  return result;
}

/// The outlines of the .csg's only node, which is a text, in OpenSCAD's facets.
Polygons own_outlines(const std::string& csg) {
  const DesignTree tree = parse(csg, "text.csg");
  DesignFonts fonts({});
  PolyhedronPool polyhedra(false, false);
  FileImports files({}, polyhedra);
  NodeProblems problems;
  Subtree subtree(*tree.nodes, 0);
  const ImportOptions options{.facets = Facets::kAll};
  subtree.take(0, {options, fonts}, files, problems);
  std::vector<Figure> letters;
  for (const PlacedGlyph& letter : subtree.data<TextNode>(0).letters) {
    letters.push_back(mapped(letter.place, *letter.shape.figure));
  }
  const std::optional<SimplePolygons> outlines = united(letters);
  return outlines.value_or(SimplePolygons{});
}

double distance_to_edge(const Vec2& point, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0;
  return glm::length(point - a - t * along);
}

double distance_to(const Vec2& point, const Polygons& outlines) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polygon& polygon : outlines) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      least =
          std::min(least, distance_to_edge(point, polygon[i], polygon[(i + 1) % polygon.size()]));
    }
  }
  return least;
}

/// By how much a corner may be off.
double tolerance_at(const Vec2& corner) {
  constexpr double kGrid = 0x1p-16;
  const double largest = std::max({std::abs(corner.x), std::abs(corner.y), 1e-3});
  // Half of the sixth digit in x and in y, and as much for the ends of the edge that is near.
  return 3 * kGrid + 1.5 * std::pow(10, std::floor(std::log10(largest)) - 5);
}

/// The corners of the first that are not on the second's outline.
std::vector<Vec2> corners_off(const Polygons& corners, const Polygons& outlines) {
  std::vector<Vec2> off;
  for (const Polygon& polygon : corners) {
    for (const Vec2& corner : polygon) {
      if (!(distance_to(corner, outlines) <= tolerance_at(corner))) off.push_back(corner);
    }
  }
  return off;
}

double area_of(const Polygons& outlines) {
  double twice = 0;
  for (const Polygon& polygon : outlines) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& a = polygon[i];
      const Vec2& b = polygon[(i + 1) % polygon.size()];
      twice += a.x * b.y - a.y * b.x;
    }
  }
  return std::abs(twice) / 2;
}

std::string listed(const std::vector<Vec2>& points) {
  std::ostringstream text;
  for (size_t i = 0; i < std::min<size_t>(points.size(), 5); ++i) {
    text << " (" << points[i].x << ", " << points[i].y << ')';
  }
  return text.str();
}

/// Where letters overlap, OpenSCAD's grid moves the crossings of edges that are nearly parallel
/// further than its corners.
size_t crossings_off(const std::string& csg) {
  return csg.find("spacing = 1") == std::string::npos ? 2 : 0;
}

void expect_as_openscad(const TemporaryFolder& folder, const std::string& csg) {
  const Polygons expected = openscad_outlines(folder, csg);
  const Polygons found = own_outlines(csg);
  const std::vector<Vec2> missing = corners_off(expected, found);
  const std::vector<Vec2> added = corners_off(found, expected);
  EXPECT_LE(missing.size(), crossings_off(csg))
      << csg << missing.size() << " corners are missing:" << listed(missing);
  EXPECT_LE(added.size(), crossings_off(csg))
      << csg << added.size() << " corners are not OpenSCAD's:" << listed(added);
  const double area = area_of(expected);
  EXPECT_NEAR(area_of(found), area, 1e-3 * area) << csg;
}

/// Chooses one of a list.
template <typename List>
const auto& one_of(const List& list, std::mt19937& random) {
  return list[std::uniform_int_distribution<size_t>(0, std::size(list) - 1)(random)];
}

constexpr const char* kStrings[] = {
    "AVATAR To Wa",   "office fluff ffi", "Hg jq|{}", "Ελληνικά Ωδή", "Привет, мир", "Съешь ЩЖ",
    "مرحبا بالعالم",  "السلام",           "لا",       "12,345.67",    "a-b_c",       " lead trail ",
    "tab\tnew\nline", "é e\u0301 ñ",      "-",        "Aα Жb",        "(مرحبا) 12",  "…—“x”"};
constexpr const char* kFonts[] = {"",
                                  "DejaVu Sans",
                                  "DejaVu Serif:style=Bold",
                                  "Amiri",
                                  "URW Bookman:style=Light Italic",
                                  "Nimbus Mono PS",
                                  "Z003",
                                  "Arial",
                                  "No Such Font",
                                  " DejaVu Sans Mono:bold ",
                                  "serif"};
constexpr const char* kHaligns[] = {"left", "center", "right"};
constexpr const char* kValigns[] = {"baseline", "top", "center", "bottom"};
constexpr const char* kDirections[] = {"", "", "", "ltr", "rtl", "ttb", "btt"};
constexpr const char* kScripts[] = {"", "", "Latn", "Arab", "grek", "Zzzz", "nonsense"};
constexpr const char* kLanguages[] = {"en", "en", "ar", "tr", "ru", "??"};
constexpr double kSizes[] = {10, 10, 3, 72, 1000, 1e5, -5, 3};
constexpr double kSpacings[] = {1, 1, 1, 0.8, 1.5, 0, -1};
constexpr double kFns[] = {0, 0, 2, 8, 16, 40};

std::string random_text(std::mt19937& random) {
  std::ostringstream csg;
  csg << "text(text = \"" << one_of(kStrings, random) << "\", size = " << one_of(kSizes, random)
      << ", spacing = " << one_of(kSpacings, random) << ", font = \"" << one_of(kFonts, random)
      << '"';
  const std::string direction = one_of(kDirections, random);
  if (!direction.empty()) csg << ", direction = \"" << direction << '"';
  csg << ", language = \"" << one_of(kLanguages, random) << '"';
  const std::string script = one_of(kScripts, random);
  if (!script.empty()) csg << ", script = \"" << script << '"';
  csg << ", halign = \"" << one_of(kHaligns, random) << "\", valign = \""
      << one_of(kValigns, random) << "\", $fn = " << one_of(kFns, random)
      << ", $fa = 12, $fs = 2);\n";
  return csg.str();
}

TEST(Letters, StandWhereOpenScadHasThem) {
  if (!openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const int count = test_support::full_run() ? 300 : 12;
  std::cout << count << " texts\n";
  const TemporaryFolder folder;
  std::mt19937 random(24);
  for (int i = 0; i < count; ++i) expect_as_openscad(folder, random_text(random));
}

// --- All digits -----------------------------------------------------------------------------

/// The corners of OpenSCAD's outlines of a .csg, exactly.
Polygon openscad_corners(const TemporaryFolder& folder, const std::string& csg) {
  // An operation makes it a Nef polyhedron; what is subtracted is far from it.
  const std::string in =
      folder.write("text.scad", "difference() { linear_extrude(1) " + as_scad(csg) +
                                    " translate([0, 0, -9]) cube(1); }\n");
  const std::string out = folder / "text.nef3";
  std::filesystem::remove(out);
  const std::string command = "openscad -o '" + out + "' '" + in + "' >/dev/null 2>&1";
  static_cast<void>(std::system(command.c_str()));
  std::ifstream file(out);
  Polygon corners;
  // A vertex: "number { … | x y z w } 1", of homogeneous coordinates.
  for (std::string line; std::getline(file, line);) {
    const size_t bar = line.find('|');
    if (bar == std::string::npos || line.find(", -2 |") == std::string::npos) continue;
    std::istringstream numbers(line.substr(bar + 1));
    double x = 0, y = 0, z = 0, w = 0;
    if (numbers >> x >> y >> z >> w && z == 0) corners.emplace_back(x / w, y / w);
  }
  return corners;
}

/// The greatest distance of OpenSCAD's corners from the outlines, and of the outlines' corners from
/// OpenSCAD's, of which it leaves out those where an edge is straight.
double greatest_difference(const Polygon& corners, const Polygons& outlines) {
  double greatest = 0;
  for (const Vec2& corner : corners) greatest = std::max(greatest, distance_to(corner, outlines));
  for (const Polygon& polygon : outlines) {
    const size_t count = polygon.size();
    for (size_t i = 0; i < count; ++i) {
      double least =
          distance_to_edge(polygon[i], polygon[(i + count - 1) % count], polygon[(i + 1) % count]);
      for (const Vec2& corner : corners) least = std::min(least, glm::length(corner - polygon[i]));
      greatest = std::max(greatest, least);
    }
  }
  return greatest;
}

std::string large_text(std::mt19937& random) {
  constexpr double kWide[] = {1, 1, 1.05, 1.5};
  constexpr double kFewFragments[] = {2, 8, 16};
  std::ostringstream csg;
  csg << "text(text = \"" << one_of(kStrings, random)
      << "\", size = 100000, spacing = " << one_of(kWide, random) << ", font = \""
      << one_of(kFonts, random) << '"';
  const std::string direction = one_of(kDirections, random);
  if (!direction.empty()) csg << ", direction = \"" << direction << '"';
  csg << ", halign = \"" << one_of(kHaligns, random) << "\", valign = \""
      << one_of(kValigns, random) << "\", $fn = " << one_of(kFewFragments, random)
      << ", $fa = 12, $fs = 2);\n";
  return csg.str();
}

TEST(Letters, AreWithinABillionthOfOpenScads) {
  if (!openscad_installed()) GTEST_SKIP() << "openscad is not installed";
  const int count = test_support::full_run() ? 200 : 3;
  std::cout << count << " texts\n";
  const TemporaryFolder folder;
  std::mt19937 random(5);
  double greatest = 0;
  for (int i = 0; i < count; ++i) {
    const std::string csg = large_text(random);
    const Polygon corners = openscad_corners(folder, csg);
    const Polygons outlines = own_outlines(csg);
    EXPECT_EQ(corners.empty(), outlines.empty()) << csg;
    const Rectangle box = bounds_of(outlines);
    const double difference =
        greatest_difference(corners, outlines) / glm::length(box.max - box.min);
    EXPECT_LE(difference, 1e-9) << csg;
    greatest = std::max(greatest, difference);
  }
  std::cout << "at most " << greatest << " of the size\n";
}

}  // namespace
}  // namespace frontend
