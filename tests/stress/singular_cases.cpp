// Scenes with points and lines where surfaces are singular or many of them meet, and rays exactly
// in faces.
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "cases.hpp"

namespace stress {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> height(-1, 1), angle(0, 2 * M_PI);
  const double z = height(random), a = angle(random), r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

/// Balls of one radius, whose surfaces all contain the origin, cut from a plate.
Part balls_through_a_point() {
  std::mt19937 random(11);
  std::vector<Part> balls;
  for (int i = 0; i < 300; ++i) balls.push_back(ball(1, random_direction(random)));
  return rod(-1, 0.2, 3) - all_of(balls);
}

/// Rods about one axis, of many lengths and radii, added and cut in turns.
Part rods_about_a_line() {
  Part result = rod(0, 10, 6);
  for (int i = 0; i < 150; ++i) {
    const double z = std::fmod(i * 3.7, 9);
    const Part step = rod(z, 10, 0.5 + std::fmod(i * 1.3, 5));
    result = i % 2 ? result + step : result - step;
  }
  return result;
}

/// Half-open fans of plates, whose faces all contain the x axis.
Part plates_through_a_line() {
  std::vector<Part> plates;
  for (int i = 0; i < 100; ++i) {
    plates.push_back(rod(0, 0.2, 5).under(turn(3.6 * i, 0, 0)));
  }
  return all_of(plates) - ball(2);
}

Part cones_of_one_apex() {
  std::mt19937 random(5);
  std::vector<Part> cones;
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = random_direction(random);
    const double x = std::asin(-d.y) * 180 / M_PI, y = std::atan2(d.x, d.z) * 180 / M_PI;
    cones.push_back(cone(0, 6, 0, 0.7).under({turned(0, y, 0) * turned(x, 0, 0), Vec3{0.0}}));
  }
  return all_of(cones);
}

Part rods_through_a_point() {
  std::vector<Part> rods;
  for (int i = 0; i < 60; ++i) {
    rods.push_back(rod(0, 9, 1, {1, 0, 0}).under(turn(6 * i, 13 * i, 0)));
  }
  return ball(6) - all_of(rods);
}

Family pencils() {
  return {"pencils",
          {{"balls_through_a_point", [] { return balls_through_a_point().scene(); }},
           {"rods_about_a_line", [] { return rods_about_a_line().scene(); }},
           {"plates_through_a_line", [] { return plates_through_a_line().scene(); }},
           {"cones_of_one_apex", [] { return cones_of_one_apex().scene(); }},
           {"rods_through_a_point", [] { return rods_through_a_point().scene(); }}}};
}

/// An orthographic view whose pixel rays are exactly at multiples of 1/2 (or finer): the height is
/// a power of two.
View on_the_grid(PictureSize size, int axis) {
  View view = view_along(Box{Vec3{-16.0}, Vec3{16.0}}, size, Projection::kOrthographic, axis, 2);
  const uint32_t height = size.height_px < 128 ? 64 : 512;
  view.width_px = height * 3 / 2;
  view.height_px = height;
  view.half_height = 16;
  const double half_pixel = view.half_height / height;
  view.eye += half_pixel * (view.right + view.up);
  return view;
}

std::vector<Camera> grid_cameras(const Scene&, PictureSize size) {
  return {{"along x", on_the_grid(size, 0)},
          {"along y", on_the_grid(size, 1)},
          {"along z", on_the_grid(size, 2)}};
}

/// A perspective view from height z of the model, along the horizon. The number of pixels is odd,
/// so that some rays are exactly level.
View level_at(const Scene& scene, PictureSize size, int axis, double z, double distance) {
  PictureSize odd = size;
  odd.width_px |= 1;
  odd.height_px |= 1;
  View view = view_along(camera_box(scene), odd, Projection::kPerspective, axis, distance);
  view.eye.z = z;
  return view;
}

std::vector<Camera> level_cameras(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  return {{"top", level_at(scene, size, 0, box.max.z, 2)},
          {"bottom", level_at(scene, size, 1, box.min.z, 2)},
          {"middle", level_at(scene, size, 0, 4, 1)}};
}

Part steps() {
  return all_of({rod(-4, 4, 8), rod(4, 8, 4), rod(-8, -4, 2)}) - rod(4, 8, 2) - rod(-4, 0, 1);
}

Family axis_rays() {
  const auto bored = [] {
    const Part across =
        rod(-8, 8, 2).under({Mat3{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}, Vec3{0.0}});
    return (steps() - across).scene();
  };
  return {"axis_rays",
          {{"steps", [] { return steps().scene(); }, grid_cameras},
           {"bored_steps", bored, grid_cameras},
           {"balls_on_the_grid",
            [] {
              return (ball(8) - ball(4, {4, 4, 4}) + ball(2, {-4, 4, 8})).scene();
            },
            grid_cameras},
           {"cones_on_the_grid",
            [] {
              return (cone(-8, 8, 8, 0) - cone(-8, 0, 4, 0) + cone(0, 4, 0, 4, {8, 8, 0})).scene();
            },
            grid_cameras},
           {"level_steps", [] { return steps().scene(); }, level_cameras},
           {"level_tower", [] { return (rod(-4, 4, 8) + rod(4, 8, 8) + rod(8, 12, 8)).scene(); },
            level_cameras}}};
}

Part double_cone() { return cone(-8, 0, 5, 0) + cone(0, 8, 0, 5); }

/// Cameras that look at an apex at the eye's level, from the side and from straight above.
std::vector<Camera> apex_cameras(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  View down = view_along(box, size, Projection::kPerspective, 2, 2);
  down.width_px |= 1;
  down.height_px |= 1;
  return {{"level", level_at(scene, size, 0, 0, 1.5)},
          {"down", down},
          {"oblique", view_around(box, size, Projection::kPerspective, 25, 35, 1)}};
}

/// Tips that touch a plate, from both sides, and tips that just pierce it.
Part tips_on_a_plate() {
  std::vector<Part> parts{rod(-1, 0, 9)};
  for (int i = 0; i < 8; ++i) {
    const double x = -7 + 2 * i;
    parts.push_back(cone(0, 4, 0, 0.9, {x, 0, 0}));
    parts.push_back(cone(-5, -1, 0.9, 0, {x, 2, 0}));
    parts.push_back(cone(-6, 0.001 * i, 0.9, 0, {x, -2, 0}));
  }
  return all_of(parts);
}

Family apexes() {
  return {
      "apexes",
      {{"double_cone", [] { return double_cone().scene(); }, apex_cameras},
       {"double_cone_cut", [] { return (rod(-8, 8, 7) - double_cone()).scene(); }, apex_cameras},
       {"apex_in_common", [] { return (cone(0, 8, 0, 6) - cone(0, 8, 0, 4)).scene(); },
        apex_cameras},
       {"slope_in_common", [] { return (cone(-8, 0, 8, 0) - cone(-4, 0, 4, 0)).scene(); },
        apex_cameras},
       {"tips_on_a_plate", [] { return tips_on_a_plate().scene(); }, apex_cameras},
       {"tip_in_a_hole", [] { return (rod(-2, 2, 6) - rod(-2, 2, 3) + cone(-2, 2, 3, 0)).scene(); },
        apex_cameras}}};
}

/// Cameras inside the model's box.
Cameras inside(const Vec3& eye) {
  return [eye](const Scene& scene, PictureSize size) {
    std::vector<Camera> cameras = default_cameras(scene, size);
    for (Camera& camera : cameras) {
      camera.view.eye = eye;
      if (camera.view.projection == Projection::kPerspective) camera.view.half_height = 0.8;
    }
    return cameras;
  };
}

Family empty_and_full() {
  const auto hollow = [] { return (rod(0, 10, 8) - ball(3, {0, 0, 5}) - rod(5, 12, 1)).scene(); };
  return {"empty_and_full",
          {{"eye_in_the_solid", hollow, inside({5, 0, 5})},
           {"eye_in_a_cavity", hollow, inside({0.5, 0, 5})},
           {"eye_in_a_hole", hollow, inside({0, 0, 9})},
           {"eye_in_coincident_solids",
            [] { return (rod(0, 10, 8) * rod(0, 10, 8) * (rod(0, 10, 8) + ball(9))).scene(); },
            inside({1, 2, 3})},
           {"all_cut", [] { return (rod(0, 10, 8) - rod(-1, 11, 9)).scene(); }},
           {"nothing_in_common",
            [] {
              return (ball(2) * ball(2, {9, 0, 0})).scene();
            }},
           {"cut_by_itself", [] { return (ball(3) - (ball(3) + rod(0, 9, 1))).scene(); }},
           {"one_face_fills_the_picture", [] { return (rod(0, 10, 8) - ball(2)).scene(); },
            [](const Scene& scene, PictureSize size) {
              std::vector<Camera> cameras = default_cameras(scene, size);
              for (Camera& camera : cameras) camera.view.half_height /= 20;
              return cameras;
            }}}};
}

/// Cameras at a point of a face, in all directions: level, up, down and askew.
Cameras in_a_face(const Vec3& eye) {
  return [eye](const Scene& scene, PictureSize size) {
    const Box box = camera_box(scene);
    std::vector<Camera> cameras;
    const auto add = [&](const char* name, View view) {
      view.eye = eye;
      view.half_height = 1;
      cameras.push_back({name, view});
    };
    add("level", view_along(box, size, Projection::kPerspective, 0, 1));
    add("down", view_along(box, size, Projection::kPerspective, 2, 1));
    add("askew up", view_around(box, size, Projection::kPerspective, 25, -35, 1));
    return cameras;
  };
}

Family eye_in_a_face() {
  const auto block = [] { return (rod(0, 10, 8) - ball(2, {0, 0, 10})).scene(); };
  const auto pair = [] { return (rod(0, 10, 8) + rod(10, 20, 8) + ball(3, {20, 0, 12})).scene(); };
  // A plane in a turned frame, with no exact middle.
  const auto turned_block = [] {
    return (rod(0, 10 / 3.0, 5) + ball(2, {0, 4, 6})).under(turn(20, 30, 40)).scene();
  };
  const Vec3 on_turned_top = turned(20, 30, 40) * Vec3{1, -2, 10 / 3.0};
  return {
      "eye_in_a_face",
      {{"on_top", block, in_a_face({5, 1, 10})},
       {"on_the_wall", block, in_a_face({8, 0, 5})},
       {"in_a_shared_plane", pair, in_a_face({1, 2, 10})},
       {"in_a_shared_wall", [] { return (rod(0, 10, 8) - rod(-1, 11, 5) + rod(3, 6, 5)).scene(); },
        in_a_face({5, 0, 4})},
       {"on_a_turned_top", turned_block, in_a_face(on_turned_top)},
       {"on_a_rim", block, in_a_face({8, 0, 10})},
       {"on_an_apex", [] { return (cone(0, 5, 5, 0) + rod(-2, 0, 8)).scene(); },
        in_a_face({0, 0, 5})}}};
}

}  // namespace

std::vector<Family> singular_families() {
  return {pencils(), axis_rays(), apexes(), empty_and_full(), eye_in_a_face()};
}

}  // namespace stress
