// Scenes with surfaces that touch, and with solids that are thin in one or two directions.
#include <cmath>
#include <cstdio>
#include <random>

#include "cases.hpp"

namespace stress {
namespace {

double uniform_number(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Part rods_around_a_rod() {
  std::vector<Part> rods{rod(0, 12, 2)};
  for (int i = 0; i < 6; ++i) {
    const double angle = i * M_PI / 3;
    rods.push_back(rod(0, 10 - i, 2, {4 * std::cos(angle), 4 * std::sin(angle), 0}));
  }
  return all_of(rods);
}

Part row_of_balls() {
  Part result = ball(2);
  for (int i = 1; i < 6; ++i) result = result + ball(2, {4.0 * i, 0, 0});
  return result - rod(-3, 3, 2, {10, -4, 0});
}

/// A ball that touches the wall, floor and lid of its case from inside, cut open.
Part ball_in_its_case() {
  return (rod(-5, 5, 5) - ball(5) - rod(-6, 6, 5, {5, 0, 0})) +
         (ball(5) - rod(-6, 6, 5, {5, 0, 0}));
}

Family tangent() {
  return {"tangent",
          {{"row_of_balls", [] { return row_of_balls().scene(); }},
           {"ball_cut_from_within",
            [] {
              return (ball(10) - ball(5, {0, 5, 0})).scene();
            }},
           {"ball_in_its_case", [] { return ball_in_its_case().scene(); }},
           {"rods_around_a_rod", [] { return rods_around_a_rod().scene(); }},
           {"ball_on_a_plate",
            [] {
              return (rod(-2, 0, 8) + ball(3, {0, 0, 3})).scene();
            }},
           {"ball_under_a_plate",
            [] {
              return (rod(-8, 0, 8) - ball(3, {0, 0, -3})).scene();
            }},
           {"ball_in_a_cone",
            // A cone of slope 3:4 about the ball that touches it all around.
            [] {
              return (cone(0, 8, 0, 6) + ball(3, {0, 0, 5})).scene();
            }}}};
}

/// A ball and a cup with walls of `share` of the model's size, cut open.
Scene shells_of(double share) {
  const double wall = share * 12;  // about the model's diagonal
  const Part bowl = ball(3) - ball(3 - wall) - rod(-4, 4, 3, {-3, 0, 0});
  const Part cup = rod(0, 4, 2, {0, 6, 0}) - rod(wall, 4, 2 - wall, {0, 6, 0});
  return (bowl + cup).scene();
}

Family thin_shells() {
  Family family{"shells", {}};
  for (int digits = 1; digits <= 7; ++digits) {
    const double share = std::pow(10.0, -digits);
    family.cases.push_back({"1e-" + std::to_string(digits), [share] { return shells_of(share); }});
  }
  family.cases.push_back({"stretched_to_1e-6", [] {
                            const Part shell = ball(3) - ball(3 - 4e-3);
                            const Mat3 flat{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1e-3}};
                            return (shell - rod(-4, 4, 1)).under({flat, Vec3{0.0}}).scene();
                          }});
  return family;
}

/// Thin rods in all directions, through the middle of the model or about it.
std::vector<Part> needles(int count, double radius, double length) {
  std::mt19937 random(7);
  std::vector<Part> parts;
  for (int i = 0; i < count; ++i) {
    const double x = uniform_number(random, 0, 180), y = uniform_number(random, 0, 180);
    const Vec3 at{uniform_number(random, -2, 2), uniform_number(random, -2, 2),
                  uniform_number(random, -2, 2)};
    parts.push_back(rod(-length / 2, length / 2, radius).under({turned(x, y, 0), at}));
  }
  return parts;
}

Family needle_family() {
  return {"needles",
          {{"one_of_1e6_to_1", [] { return rod(-500, 500, 1e-3).under(turn(0, 41, 17)).scene(); },
            [](const Scene& scene, PictureSize size) {
              // The cameras are close to its middle, since nothing of it would be seen otherwise.
              std::vector<Camera> cameras = default_cameras(scene, size);
              cameras[0].view.half_height = 1e-6;
              cameras[1].view.half_height = 3e-3;
              cameras[2].view.half_height = 3e-6;
              return cameras;
            }},
           {"bundle", [] { return all_of(needles(60, 0.02, 10)).scene(); }},
           {"holes", [] { return (rod(-3, 3, 4) - all_of(needles(60, 0.05, 20))).scene(); }},
           {"sharp_cones", [] {
              std::vector<Part> parts;
              for (int i = 0; i < 30; ++i) {
                parts.push_back(cone(0, 100, 1, 0).under(turn(12 * i, 7 * i, 0)));
              }
              return all_of(parts).scene();
            }}}};
}

Family plates() {
  const auto stack = [](double thickness, double gap, int count) {
    std::vector<Part> parts;
    for (int i = 0; i < count; ++i) {
      const double z = i * (thickness + gap);
      parts.push_back(rod(z, z + thickness, 5 - 0.05 * i));
    }
    return all_of(parts).under(turn(23, 0, 31));
  };
  return {
      "plates",
      {{"one_of_1e-6", [] { return rod(0, 1e-5, 5).under(turn(35, 10, 0)).scene(); }},
       {"stack_1e-5_apart", [stack] { return stack(1e-2, 1e-4, 40).scene(); }},
       {"crossing",
        [] {
          const Part plate = rod(-1e-4, 1e-4, 5);
          return all_of({plate, plate.under(turn(90, 0, 0)), plate.under(turn(0, 60, 0)),
                         plate.under(turn(45, 30, 0))})
              .scene();
        }},
       {"flattened_ball", [] {
          const Mat3 flat{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1e-5}};
          return (ball(5) - rod(-5, 5, 1)).under({flat, Vec3{0.0}}).under(turn(50, 0, 0)).scene();
        }}}};
}

}  // namespace

std::vector<Family> thin_families() {
  return {tangent(), thin_shells(), needle_family(), plates()};
}

}  // namespace stress
