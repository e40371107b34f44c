#include "families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace slow_search {
namespace {

/// Writes six digits, as in a .csg.
std::string text_of(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", number);
  return text.data();
}

std::string cube(double x, double y, double z, bool center = true) {
  return "cube(size=[" + text_of(x) + "," + text_of(y) + "," + text_of(z) +
         "],center=" + (center ? "true" : "false") + ");\n";
}

std::string sphere(double r) { return "sphere($fn=0,$fa=12,$fs=2,r=" + text_of(r) + ");\n"; }

std::string cylinder(double h, double r1, double r2, int fn = 0, bool center = false) {
  return "cylinder($fn=" + std::to_string(fn) + ",$fa=12,$fs=2,h=" + text_of(h) +
         ",r1=" + text_of(r1) + ",r2=" + text_of(r2) + ",center=" + (center ? "true" : "false") +
         ");\n";
}

std::string block(const std::string& head, const std::string& children) {
  return head + "{\n" + children + "}\n";
}

std::string moved(double x, double y, double z, const std::string& child) {
  return block("multmatrix([[1,0,0," + text_of(x) + "],[0,1,0," + text_of(y) + "],[0,0,1," +
                   text_of(z) + "],[0,0,0,1]])",
               child);
}

/// Turns about an axis, 0 for x.
std::string turned(int axis, double angle_deg, const std::string& child) {
  const double c = std::cos(angle_deg * std::numbers::pi / 180);
  const double s = std::sin(angle_deg * std::numbers::pi / 180);
  double rows[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  rows[a][a] = rows[b][b] = c;
  rows[a][b] = -s;
  rows[b][a] = s;
  std::string head = "multmatrix([";
  for (const auto& row : rows) {
    head += "[" + text_of(row[0]) + "," + text_of(row[1]) + "," + text_of(row[2]) + ",0],";
  }
  return block(head + "[0,0,0,1]])", child);
}

std::string turned_anyhow(Random& random, const std::string& child) {
  return turned(2, random.between(0, 360), turned(0, random.between(0, 180), child));
}

std::string placed_anyhow(Random& random, double reach, const std::string& child) {
  return moved(random.between(-reach, reach), random.between(-reach, reach),
               random.between(-reach, reach), child);
}

std::string overlapping_plates(Random& random, int count) {
  const double step = random.between(0, 1);
  std::string text;
  for (int i = 0; i < count; ++i) text += moved(i * step, i * step / 2, 0, cube(60, 60, 5));
  return text;
}

std::string equal_cubes(Random&, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += cube(10, 10, 10);
  return text;
}

std::string equal_spheres(Random&, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += sphere(10);
  return text;
}

std::string cylinders_on_one_base(Random& random, int count) {
  const double reach = random.between(0, 40);
  const int fn = random.one_in(2) ? 0 : 6;
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += moved(random.between(-reach, reach), random.between(-reach, reach), 0,
                  cylinder(random.from_to(4, 8), 20, 20, fn));
  }
  return text;
}

std::string rounded_plates(Random& random, int count) {
  const double step = random.one_in(2) ? 0 : random.between(0, 1);
  std::string plate = moved(20, 20, 2.5, cube(30, 40, 5)) + moved(20, 20, 2.5, cube(40, 30, 5));
  for (const int x : {5, 35}) {
    for (const int y : {5, 35}) plate += moved(x, y, 0, cylinder(5, 5, 5));
  }
  std::string text;
  for (int i = 0; i < std::max(1, count / 6); ++i) {
    text += step == 0 ? plate : moved(i * step, 0, 0, plate);
  }
  return text;
}

std::string nested_spheres(Random& random, int count) {
  const double step = std::pow(10, random.between(-5, -1));
  std::string text = sphere(50);
  for (int i = 0; i < count / 2; ++i) text += sphere(50 - i * step);
  return block("difference()",
               block("union()", sphere(50 + step)) + text + moved(0, -50, 0, cube(100, 100, 100)));
}

std::string shells(Random& random, int count) {
  const double step = std::pow(10, random.between(-4, -1));
  std::string text;
  for (int i = 0; i < count / 2; ++i) {
    text += block("difference()", sphere(50 - 2 * i * step) + sphere(50 - (2 * i + 1) * step));
  }
  return block("difference()", block("union()", text) + moved(50, -50, 50, cube(100, 100, 100)));
}

std::string exclusive_or(Random& random, int count) {
  std::string text = cube(20, 20, 20, false);
  const double step = random.between(0, 4);
  for (int level = 1; (2 << level) < count; ++level) {
    const std::string other =
        moved(level * step, level, level * step / 2, sphere(15 + random.between(0, 5)));
    text = block("difference()", block("union()", text) + other) +
           block("difference()", other + block("union()", text));
  }
  return text;
}

std::string turned_cubes(Random& random, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += turned_anyhow(random, cube(20, 20, 20));
  return block(random.one_in(2) ? "intersection()" : "union()", text);
}

std::string turned_bars(Random& random, int count) {
  const double angle_deg = random.one_in(2) ? 360.0 / count : random.between(0, 20);
  std::string text;
  for (int i = 0; i < count; ++i) text += turned(2, i * angle_deg, cube(40, 4, 5));
  return text;
}

std::string plates_behind_each_other(Random& random, int count) {
  const double step = random.between(0.01, 1);
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string plate = random.one_in(8) ? sphere(30) : cube(60, step / 2, 60);
    text += moved(0, i * step, 0, plate);
  }
  return text;
}

std::string crowd(Random& random, int count) {
  const double size = random.between(2, 40);
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string part = random.one_in(2) ? sphere(size) : cube(size, size, size);
    text += placed_anyhow(random, 20, part);
  }
  return text;
}

std::string long_difference(Random& random, int count) {
  const double reach = random.between(10, 60), size = random.between(5, 40);
  std::string text = cube(80, 80, 80);
  for (int i = 0; i < count; ++i) text += placed_anyhow(random, reach, sphere(size));
  return block("difference()", text);
}

std::string needles(Random& random, int count) {
  const double radius = std::pow(10, random.between(-3, 0));
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string needle =
        random.one_in(2) ? cylinder(100, radius, radius, 0, true) : cube(100, radius, radius);
    text += placed_anyhow(random, 20, turned_anyhow(random, needle));
  }
  return text;
}

std::string modified_parts(Random& random, int count) {
  const char* const modifier = random.one_in(2) ? "#" : "%";
  const bool is_round = random.one_in(2);
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += modifier + placed_anyhow(random, 20, is_round ? sphere(15) : cube(25, 25, 25));
  }
  return text + cube(10, 10, 10);
}

std::string stacked_frusta(Random& random, int count) {
  std::string text;
  double radius = 20;
  for (int i = 0; i < count; ++i) {
    const double next = 10 + random.between(0, 20);
    text += moved(0, 0, i * 0.5, cylinder(0.5, radius, next));
    radius = next;
  }
  return text;
}

std::string touching_cubes(Random& random, int count) {
  const int side = std::max(1, static_cast<int>(std::cbrt(count)));
  const bool is_checkered = random.one_in(2);
  std::string text;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) {
        if (is_checkered && (x + y + z) % 2 == 1) continue;
        text += moved(x, y, z, cube(1, 1, 1));
      }
    }
  }
  return text;
}

std::string cones_of_one_apex(Random& random, int count) {
  const int fn = random.one_in(2) ? 0 : 5;
  std::string text;
  for (int i = 0; i < count; ++i) text += turned_anyhow(random, cylinder(30, 0, 8, fn));
  return text;
}

std::string touching_spheres(Random& random, int count) {
  const int side = std::max(1, static_cast<int>(std::sqrt(count)));
  const double radius = random.one_in(2) ? 0.5 : 0.8;
  std::string text;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) text += moved(x, y, 0, sphere(radius));
  }
  return text;
}

std::string holes(Random& random, int count) {
  const int side = std::max(1, static_cast<int>(std::sqrt(count)));
  const double radius = random.between(0.1, 0.7);
  std::string text = moved((side - 1) / 2.0, (side - 1) / 2.0, 1, cube(side, side, 2));
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) text += moved(x, y, 0, cylinder(2, radius, radius));
  }
  return block("difference()", text);
}

/// Each level's part is cut out of everything deeper, or everything deeper out of the part.
std::string deep_differences(Random& random, int count) {
  std::string text = cube(40, 40, 40);
  for (int i = 0; i < count; ++i) {
    const std::string part =
        placed_anyhow(random, 10, random.one_in(2) ? sphere(20 + i * 0.1) : cube(30, 30, 30));
    text = block("difference()", random.one_in(2) ? part + text : block("union()", text) + part);
  }
  return text;
}

std::string large_polyhedra(Random& random, int count) {
  const int sides = random.from_to(3, 200);
  std::string points, top, bottom, walls;
  for (int i = 0; i < 2 * sides; ++i) {
    const double angle = 2 * std::numbers::pi * (i % sides) / sides;
    points += "[" + text_of(20 * std::cos(angle)) + "," + text_of(20 * std::sin(angle)) + "," +
              (i < sides ? "0" : "5") + "],";
  }
  const auto corner = [](int i) { return std::to_string(i); };
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    bottom += corner(i) + ",";
    top += corner(2 * sides - 1 - i) + ",";
    walls += "[" + corner(i) + "," + corner(sides + i) + "," + corner(sides + next) + "," +
             corner(next) + "],";
  }
  const std::string solid = "polyhedron(points=[" + points + "],faces=[[" + bottom + "],[" + top +
                            "]," + walls + "],convexity=1);\n";
  std::string text;
  for (int i = 0; i < std::max(1, count / 20); ++i) text += placed_anyhow(random, 10, solid);
  return text;
}

std::string flat_ellipsoids(Random& random, int count) {
  const double flatness = std::pow(10, random.between(-4, 0));
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string flat = block("multmatrix([[1,0,0,0],[0," + text_of(random.between(0.2, 1)) +
                                       ",0,0],[0,0," + text_of(flatness) + ",0],[0,0,0,1]])",
                                   sphere(20));
    text += turned_anyhow(random, flat);
  }
  return text;
}

std::string intersections(Random& random, int count) {
  std::string text;
  for (int i = 0; i < count / 3; ++i) {
    text += block("intersection()", placed_anyhow(random, 10, sphere(20)) +
                                        placed_anyhow(random, 10, cube(30, 30, 30)) +
                                        placed_anyhow(random, 10, cylinder(40, 15, 5)));
  }
  return text;
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> kFamilies = {
      {"overlapping_plates", overlapping_plates},
      {"equal_cubes", equal_cubes},
      {"equal_spheres", equal_spheres},
      {"cylinders_on_one_base", cylinders_on_one_base},
      {"rounded_plates", rounded_plates},
      {"nested_spheres", nested_spheres},
      {"shells", shells},
      {"exclusive_or", exclusive_or},
      {"turned_cubes", turned_cubes},
      {"turned_bars", turned_bars},
      {"plates_behind_each_other", plates_behind_each_other},
      {"crowd", crowd},
      {"long_difference", long_difference},
      {"needles", needles},
      {"modified_parts", modified_parts},
      {"stacked_frusta", stacked_frusta},
      {"touching_cubes", touching_cubes},
      {"cones_of_one_apex", cones_of_one_apex},
      {"touching_spheres", touching_spheres},
      {"holes", holes},
      {"deep_differences", deep_differences},
      {"large_polyhedra", large_polyhedra},
      {"flat_ellipsoids", flat_ellipsoids},
      {"intersections", intersections},
  };
  return kFamilies;
}

}  // namespace slow_search
