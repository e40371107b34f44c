// Scenes with eyes far away, models far from the origin, huge and tiny models, and maps that shear
// and mirror.
#include <cmath>
#include <random>

#include "cases.hpp"
#include "support/models.hpp"

namespace stress {
namespace {

/// A drilled and filled block whose faces coincide everywhere, with a rough side.
Part block() {
  const Part body = rod(0, 10, 8) - rod(4, 10, 5) - rod(0, 4, 2);
  const Part plug = rod(4, 10, 2.5, {2, 0, 0});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(0, 2 * M_PI), height(0, 10);
  std::vector<Part> bites;
  for (int i = 0; i < 40; ++i) {
    const double a = angle(random);
    bites.push_back(ball(1.2, {8 * std::cos(a), 8 * std::sin(a), height(random)}));
  }
  return (body + plug) - all_of(bites);
}

/// A block with thirds for lengths, so that a coordinate far out is all rounding.
Part fractional_block() {
  const Part body = rod(0, 10 / 3.0, 8 / 3.0) - rod(4 / 3.0, 10 / 3.0, 5 / 3.0);
  return (body + rod(4 / 3.0, 10 / 3.0, 1 / 3.0, {1 / 3.0, 0, 0})) + ball(2 / 3.0, {0, 3, 3});
}

std::vector<Camera> from_afar(const Scene& scene, PictureSize size, double distance) {
  const Box box = camera_box(scene);
  return {{"oblique", view_around(box, size, Projection::kPerspective, 25, 35, distance)},
          {"along x", view_along(box, size, Projection::kPerspective, 0, distance)},
          {"orthographic", view_around(box, size, Projection::kOrthographic, 130, 50, distance)}};
}

Family far_cameras() {
  Family family{"far_cameras", {}};
  for (const int digits : {2, 4, 6, 8}) {
    const double distance = std::pow(10.0, digits);
    family.cases.push_back({"1e" + std::to_string(digits) + "_sizes",
                            [] { return block().scene(); },
                            [distance](const Scene& scene, PictureSize size) {
                              return from_afar(scene, size, distance);
                            }});
  }
  family.cases.push_back(
      {"cylinder_minus_spheres_1e4", [] { return test_support::cylinder_minus_spheres(1000); },
       [](const Scene& scene, PictureSize size) { return from_afar(scene, size, 1e4); }});
  return family;
}

Family far_models() {
  Family family{"far_models", {}};
  for (const int digits : {3, 6, 9, 12}) {
    const double far = std::pow(10.0, digits);
    family.cases.push_back({"1e" + std::to_string(digits), [far] {
                              return block().at({far, -far, far}).scene();
                            }});
  }
  family.cases.push_back({"thirds_at_1e6", [] {
                            return fractional_block().at({1e6 / 3, -1e6, 1e6 / 7}).scene();
                          }});
  family.cases.push_back({"thirds_at_1e9", [] {
                            return fractional_block().at({1e9 / 3, -1e9, 1e9 / 7}).scene();
                          }});
  family.cases.push_back(
      {"two_1e6_apart",
       [] {
         return (block() + block().at({1e6, 0, 0})).scene();
       },
       [](const Scene&, PictureSize size) {
         const Box near = camera_box(block().scene());
         const Box far = camera_box(block().at({1e6, 0, 0}).scene());
         return std::vector<Camera>{
             {"the first", view_around(near, size, Projection::kPerspective, 25, 35, 3)},
             {"the other", view_around(far, size, Projection::kPerspective, 200, 15, 3)},
             {"both", view_along(near, size, Projection::kPerspective, 0, 3)}};
       }});
  return family;
}

Family scales() {
  Family family{"scales", {}};
  const auto add = [&](const char* name, double scale, bool beyond_float) {
    family.cases.push_back({name,
                            [scale] {
                              return block().under({Mat3{scale}, Vec3{0.0}}).scene();
                            },
                            default_cameras, false, beyond_float});
  };
  add("1e12", 1e12, false);
  add("1e-9", 1e-9, false);
  add("1e60", 1e60, true);
  add("1e-60", 1e-60, true);
  family.cases.push_back({"ball_of_1e-9_beside_one_of_1",
                          [] {
                            return (ball(1) + ball(1e-9, {0, 0, 1 + 1e-9})).scene();
                          },
                          [](const Scene& scene, PictureSize size) {
                            std::vector<Camera> cameras = default_cameras(scene, size);
                            const Vec3 tiny{0, 0, 1 + 1e-9};
                            View close = view_around({tiny - 1e-9, tiny + 1e-9}, size,
                                                     Projection::kPerspective, 25, 35, 3);
                            cameras[0] = {"the tiny one", close};
                            return cameras;
                          }});
  return family;
}

Family sheared_and_mirrored() {
  const Affine shear{Mat3{Vec3{1, 0.2, 0}, Vec3{0.6, 1, 0.1}, Vec3{0.3, -0.5, 1}}, Vec3{1, 2, 3}};
  const Affine mirror{Mat3{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}, Vec3{0.0}};
  const Affine stretch{Mat3{Vec3{1, 0, 0}, Vec3{0, 30, 0}, Vec3{0, 0, 1000}}, Vec3{0.0}};
  const Affine nearly_flat{Mat3{Vec3{1, 0.5, 0.3}, Vec3{1, 0.50001, 0.3}, Vec3{0.2, -0.4, 1}},
                           Vec3{0.0}};
  return {
      "sheared_and_mirrored",
      {{"sheared", [=] { return block().under(shear).scene(); }},
       {"mirrored_twin", [=] { return (block() + block().under(mirror)).scene(); }},
       {"sheared_mirror", [=] { return block().under(csgcore::compose(shear, mirror)).scene(); }},
       {"stretched", [=] { return block().under(stretch).scene(); }},
       {"nearly_flat", [=] { return block().under(nearly_flat).scene(); }},
       {"sheared_sleeve", [=] {
          return (rod(0, 10, 8) - rod(0, 10, 5) + rod(0, 10, 5) + ball(4, {0, 0, 12}))
              .under(shear)
              .scene();
        }}}};
}

}  // namespace

std::vector<Family> far_families() {
  return {far_cameras(), far_models(), scales(), sheared_and_mirrored()};
}

}  // namespace stress
