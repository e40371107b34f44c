// Scenes with trees of thousands of levels, and random trees with planted coincidences.
#include <cmath>
#include <iterator>
#include <random>

#include "cases.hpp"
#include "random_scenes.hpp"
#include "support/models.hpp"

namespace stress {
namespace {

Vec3 on_a_spiral(int i) {
  const double angle = i * 0.61, z = std::fmod(i * 0.37, 10);
  return {5 * std::cos(angle), 5 * std::sin(angle), z};
}

/// ((((rod − ball) ∪ ball) − ball) ∪ …
Scene in_turns(int levels) {
  Nest nest(rod(0, 10, 5));
  for (int i = 0; i < levels; ++i) {
    nest.wrap(i % 2 ? Op::kUnion : Op::kDifference, ball(0.6, on_a_spiral(i)));
  }
  return nest.scene();
}

/// … ∩ (everything) ∪ ball: every second level is an intersection.
Scene with_intersections(int levels) {
  Nest nest(rod(0, 10, 5));
  for (int i = 0; i < levels; ++i) {
    if (i % 2) {
      nest.wrap(Op::kIntersection, ball(20 - 10.0 * i / levels, {0, 0, 5}));
    } else {
      nest.wrap(Op::kUnion, ball(0.7, on_a_spiral(i)));
    }
  }
  return nest.scene();
}

/// Equal rods at every level.
Scene equal_levels(int levels) {
  Nest nest(rod(0, 10, 5) + ball(3, {6, 0, 5}));
  for (int i = 0; i < levels; ++i) {
    nest.wrap(i % 2 ? Op::kUnion : Op::kDifference, rod(0, 10, 5));
  }
  return nest.scene();
}

/// Differences within the subtracted side: a − (b − (c − …)).
Scene nested_cuts(int levels) {
  Part result = rod(0, 10, 0.1);
  for (int i = levels; i > 0; --i) {
    const double radius = 0.1 + 5.0 * i / levels;
    result = rod(0, 5 + 5.0 * ((levels - i) % 7) / 7, radius) - result;
  }
  return result.scene();
}

Family deep() {
  return {"deep",
          {{"in_turns_3000", [] { return in_turns(3000); }},
           {"intersections_1000", [] { return with_intersections(1000); }},
           {"equal_levels_201", [] { return equal_levels(201); }},
           {"nested_cuts_300", [] { return nested_cuts(300); }}}};
}

/// Makes primitive `b` share a face with primitive `a`.
void plant(const Primitive& a, Primitive& b, std::mt19937& random) {
  const uint32_t id = b.id;
  const auto* const frustum_a = std::get_if<csgcore::FrustumShape>(&a.solid);
  auto* const frustum_b = std::get_if<csgcore::FrustumShape>(&b.solid);
  const bool both_frusta = frustum_a && frustum_b;
  switch (random() % 5) {
    case 0:  // equal
      b = a;
      break;
    case 1:  // one frame: about one axis, or one centre
      b.local_to_world = a.local_to_world;
      break;
    case 2:  // stacked, or equal but turned about z
      b.local_to_world = a.local_to_world;
      if (both_frusta) {
        const double height = frustum_b->z_max - frustum_b->z_min;
        frustum_b->z_min = frustum_a->z_max;
        frustum_b->z_max = frustum_a->z_max + height;
        const double rim = frustum_a->r_top;
        frustum_b->r_bottom = rim > 0 ? rim : frustum_b->r_bottom + 0.5;
      } else if (a.shape() == csgcore::Shape::kSphere) {
        b = a;
        b.local_to_world = csgcore::compose(a.local_to_world, turn(20, 30, 40));
      }
      break;
    case 3:  // one top plane, parallel axes
      b.local_to_world = a.local_to_world;
      if (both_frusta) {
        frustum_b->z_max = frustum_a->z_max;
        frustum_b->z_min = std::min(frustum_b->z_min, frustum_a->z_max - 1);
      }
      b.local_to_world.translation = a.local_to_world.point({1.5, -0.5, 0});
      break;
    default:  // one wall, with other lengths
      if (both_frusta) {
        const auto& [z_min, z_max, r_bottom, r_top] = *frustum_a;
        const double slope = (r_top - r_bottom) / (z_max - z_min);
        const double middle = 0.5 * z_min + 0.5 * z_max;
        b = a;
        b.as<csgcore::FrustumShape>().z_min = middle;
        b.as<csgcore::FrustumShape>().r_bottom = r_bottom + slope * (middle - z_min);
      } else {
        b = a;
      }
  }
  b.id = id;
}

/// A random tree, in which every second primitive shares a face with an earlier one.
Scene random_with_coincidences(uint32_t primitives, uint32_t seed) {
  Scene scene = test_support::random_tree(primitives, seed);
  std::mt19937 random(seed);
  for (size_t i = 1; i < scene.primitives.size(); ++i) {
    if (random() % 2 == 0) plant(scene.primitives[random() % i], scene.primitives[i], random);
  }
  return scene;
}

int whole(std::mt19937& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// A cube, a prism of 3 to 8 sides, or a faceted ball.
Part lattice_polyhedron(std::mt19937& random) {
  const int kind = whole(random, 0, 4), fragments = whole(random, 3, 8);
  if (kind == 0) return faceted_ball(whole(random, 1, 3), fragments);
  const int z = whole(random, -2, 1), height = whole(random, 1, 4);
  if (kind == 1) return prism(z, z + height, whole(random, 1, 3), fragments);
  const int x = whole(random, -2, 1), y = whole(random, -2, 1);
  return brick({x, y, z}, {x + whole(random, 1, 4), y + whole(random, 1, 4), z + height});
}

/// All sizes are integers and all angles right, so that caps, walls and axes coincide everywhere.
Part lattice_primitive(std::mt19937& random, bool with_polyhedra) {
  const auto shape = [&]() -> Part {
    if (with_polyhedra && whole(random, 0, 2) > 0) return lattice_polyhedron(random);
    const int kind = whole(random, 0, 5);
    if (kind == 0) return ball(whole(random, 1, 3));
    const int z = whole(random, -2, 1), height = whole(random, 1, 4);
    const int r_bottom = whole(random, 1, 3), r_top = whole(random, 0, 3);
    return kind == 1 ? cone(z, z + height, r_bottom, r_top) : rod(z, z + height, r_bottom);
  };
  const Part upright = shape();
  const Vec3 at{double(whole(random, -2, 2)), double(whole(random, -2, 2)),
                double(whole(random, -2, 2))};
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Mat3 frames[] = {Mat3{1.0},          Mat3{1.0},      Mat3{y, z, x},
                         Mat3{z, x, y},      Mat3{x, y, -z}, turned(0, 0, whole(random, 1, 89)),
                         Mat3{2.0 * x, y, z}};
  return upright.under({frames[random() % std::size(frames)], at});
}

Scene lattice_tree(uint32_t seed, bool with_polyhedra) {
  std::mt19937 random(seed);
  std::vector<Part> operands;
  for (int left = whole(random, 3, 12); left > 0; --left) {
    operands.push_back(lattice_primitive(random, with_polyhedra));
    while (operands.size() > 1 && whole(random, 0, 2) > 0) {
      const Part last = operands.back();
      operands.pop_back();
      const int pick = whole(random, 0, 9);
      Part& first = operands.back();
      first = pick < 4 ? first + last : (pick < 8 ? first - last : first * last);
    }
  }
  const Part tree = all_of(operands);
  return (seed % 2 ? tree : tree.under(turn(whole(random, 0, 359), 20, 50))).scene();
}

/// Cameras from the side, along an axis, and at a point of the lattice, often in a face.
std::vector<Camera> lattice_cameras(const Scene& scene, PictureSize size) {
  const Box box = camera_box(scene);
  std::mt19937 random(uint32_t(scene.primitives.size()));
  const double around = whole(random, 0, 359), above = whole(random, -80, 80);
  View within = view_along(box, size, Projection::kPerspective, whole(random, 0, 2), 1);
  within.half_height = 0.8;
  within.eye = {double(whole(random, -3, 3)), double(whole(random, -3, 3)),
                double(whole(random, -3, 3))};
  return {
      {"aside", view_around(box, size, Projection::kPerspective, around, above, 2)},
      {"along an axis", view_along(box, size, Projection::kOrthographic, whole(random, 0, 2), 2)},
      {"from the lattice", within}};
}

/// An eye at a point of the lattice lies in planes with edges, along which diagonals of pixels run.
/// The eye of these cameras lies only in planes across its view.
std::vector<Camera> lattice_cameras_off_edges(const Scene& scene, PictureSize size) {
  std::vector<Camera> cameras = lattice_cameras(scene, size);
  View& within = cameras.back().view;
  within.eye += 0.137 * within.right + 0.261 * within.up;
  return cameras;
}

constexpr uint32_t kSeedsInSample = 8;

Family lattice_family(const char* name, bool with_polyhedra) {
  Family family{name, {}, true};
  for (uint32_t seed = 1; seed <= 100; ++seed) {
    family.cases.push_back(
        {"seed_" + std::to_string(seed), [=] { return lattice_tree(seed, with_polyhedra); },
         with_polyhedra ? lattice_cameras_off_edges : lattice_cameras, seed > kSeedsInSample});
  }
  return family;
}

/// (The trees differ from random_trees_test's.)
Family random_polyhedra_family() {
  constexpr uint32_t kFirstSeed = 1000001;
  Family family{"random_polyhedra", {}};
  for (uint32_t i = 0; i < 60; ++i) {
    family.cases.push_back({"seed_" + std::to_string(kFirstSeed + i),
                            [=] { return random_scene(kFirstSeed + i, stress::Leaves::kAll); },
                            default_cameras, i >= kSeedsInSample});
  }
  return family;
}

Family random_family() {
  Family family{"random", {}};
  for (uint32_t seed = 1; seed <= 60; ++seed) {
    const uint32_t primitives = 6 + 5 * (seed % 9);
    family.cases.push_back({"seed_" + std::to_string(seed),
                            [=] { return random_with_coincidences(primitives, seed); },
                            default_cameras, seed > kSeedsInSample});
  }
  return family;
}

}  // namespace

std::vector<Family> tree_families() {
  return {deep(), random_family(), lattice_family("random_lattice", false),
          random_polyhedra_family(), lattice_family("lattice_of_polyhedra", true)};
}

}  // namespace stress
