// Scenes of convex polyhedra: cubes and prisms that share faces, edges and vertices with one
// another and with round parts; thin, huge, tiny and sheared ones; and thousands of facets.
#include <cmath>
#include <memory>
#include <numbers>

#include "cases.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/tracer.hpp"
#include "support/reference.hpp"

namespace stress {
namespace {

// --- Cubes ---

/// A checkerboard, whose cubes meet in edges, on a plate that is flush with its sides.
Part checkerboard() {
  std::vector<Part> cubes{brick({0, 0, -1}, {6, 6, 0})};
  for (int x = 0; x < 6; ++x) {
    for (int y = x % 2; y < 6; y += 2) cubes.push_back(cube(1, {x + 0.5, y + 0.5, 0.5}));
  }
  return all_of(cubes);
}

/// 27 cubes that form one, minus those at its corners.
Part cube_of_cubes() {
  std::vector<Part> cubes, corners;
  for (int i = 0; i < 27; ++i) {
    cubes.push_back(cube(2, 2.0 * Vec3{i % 3, i / 3 % 3, i / 9}));
  }
  for (int i = 0; i < 8; ++i) {
    corners.push_back(cube(2, 4.0 * Vec3{i & 1, i >> 1 & 1, i >> 2 & 1}));
  }
  return all_of(cubes) - all_of(corners);
}

Part nested_cubes(int count) {
  Part result = cube(10);
  for (int i = 0; i < count; ++i) result = i % 2 ? result + cube(10) : result - cube(10);
  return result + cube(10) - cube(12, {6, 6, 6});
}

/// A drilled and filled block, with the caps of the cylinders in its faces.
Part drilled() {
  const Part body = brick({-8, -8, 0}, {8, 8, 10});
  return (body - rod(0, 10, 5) - rod(6, 10, 3, {5, 5, 0})) + rod(2, 10, 3) + cube(2, {0, 0, 11});
}

/// A block whose pocket and plug are given in frames that are composed in the other order.
Part turned_box_frames() {
  const Affine first = turn(17, 29, 0), second = turn(0, 0, 43);
  const Part body = brick({-8, -8, 0}, {8, 8, 4}).under(csgcore::compose(first, second));
  const Part pocket = brick({-8, -2, 2}, {3, 6, 4}).under(second).under(first);
  const Part plug = brick({-4, -2, 2}, {0, 6, 4}).under(second).under(first);
  return (body - pocket) + plug;
}

/// Quarter turns about an axis, in matrices that are rounded.
Part quarter_turns() {
  Part result = cube(10);
  for (int i = 1; i < 4; ++i) {
    const Part same = cube(10).under(turn(90 * i, 0, 90));
    result = i % 2 ? result - same : result + same;
  }
  return (result + cube(10).under(turn(0, 270, 180))) - brick({0, 0, 0}, {6, 6, 6});
}

Family coincident_cubes() {
  return {"coincident_cubes",
          {{"pocket",
            [] {
              return (cube(10) - brick({-3, -4, 0}, {4, 2, 5})).scene();
            }},
           {"tower",
            [] {
              return (cube(6) + cube(6, {0, 0, 6}) + brick({-3, -3, 9}, {0, 3, 12})).scene();
            }},
           {"checkerboard", [] { return checkerboard().scene(); }},
           {"cube_of_cubes", [] { return cube_of_cubes().scene(); }},
           {"nested", [] { return nested_cubes(9).scene(); }},
           {"less_itself",
            [] {
              return ((cube(8) - cube(8)) + cube(1, {5, 0, 0})).scene();
            }},
           {"drilled", [] { return drilled().scene(); }},
           {"turned_frames", [] { return turned_box_frames().scene(); }},
           {"quarter_turns", [] { return quarter_turns().scene(); }},
           {"common_face",
            [] {
              return (cube(8) * brick({-9, -1, -4}, {2, 9, 4})).scene();
            }}},
          true};
}

// --- Prisms ---

Part nut_trap() {
  const Part trap = prism(6, 10, 4, 6), nut = trap - rod(0, 10, 2);
  return (brick({-8, -8, 0}, {8, 8, 10}) - trap - rod(0, 10, 2)) + nut.at({0, 0, -1});
}

/// Six-sided prisms about one axis, turned by sixths of a turn.
Part sixths_of_a_turn() {
  Part result = prism(0, 4, 6, 6);
  for (int i = 1; i < 6; ++i) {
    const Part same = prism(i % 2 ? 1 : 2, 4 + i, 6, 6).under(turn(0, 0, 60 * i));
    result = i % 3 ? result + same : result - same;
  }
  return result.under(turn(21, 33, 0));
}

/// A bar as wide as the hexagon is across its flats, and the triangles in the hexagon.
Part across_flats() {
  const double half = 4 * std::sqrt(0.75);
  const Part bar = brick({-9, -half, 0}, {9, half, 3});
  return all_of({prism(0, 6, 4, 6) - bar, prism(6, 8, 4, 3),
                 prism(8, 9, 4, 3).under(turn(0, 0, 180)), bar - prism(0, 3, 2, 6)});
}

/// Hexagons that share walls.
Part honeycomb() {
  std::vector<Part> cells;
  for (int i = 0; i < 12; ++i) {
    const double x = i % 4, y = i / 4;
    const Vec3 at{3 * x, 2 * std::sqrt(3.0) * y + std::sqrt(3.0) * (i % 2), 0};
    const Part cell = prism(0, 2 + i % 3, 2, 6, at);
    cells.push_back(i % 5 == 4 ? cell - prism(1, 9, 2, 6, at) : cell);
  }
  return all_of(cells);
}

Family prisms() {
  return {"prisms",
          {{"nut_trap", [] { return nut_trap().scene(); }},
           {"sixths_of_a_turn", [] { return sixths_of_a_turn().scene(); }},
           {"across_flats", [] { return across_flats().scene(); }},
           {"honeycomb", [] { return honeycomb().scene(); }},
           {"prism_in_its_rod", [] { return (rod(0, 6, 5) - prism(0, 6, 5, 6)).scene(); }},
           {"rod_in_its_prism",
            [] {
              return (prism(0, 6, 5, 8) - rod(0, 6, 5 * std::cos(std::numbers::pi / 8))).scene();
            }}},
          true};
}

// --- Thin ones ---

/// Cameras close to the middle, so that pictures are some widths wide.
Cameras close_up(double width) {
  return [width](const Scene& scene, PictureSize size) {
    const Vec3 middle = camera_box(scene).center();
    const Box box{middle - width, middle + width};
    return std::vector<Camera>{
        {"oblique", view_around(box, size, Projection::kPerspective, 25, 35, 3)},
        {"orthographic", view_around(box, size, Projection::kOrthographic, 70, 20, 3)},
        {"from afar", view_around(box, size, Projection::kPerspective, 200, 2, 1e6)}};
  };
}

constexpr double kToleranceShares[] = {0.2, 0.7, 0.99, 1.01, 1.3, 2, 7, 50};  // of the tolerance

/// Plates on a block, and gaps and slits in it, of so many tolerances.
Scene tolerances() {
  const Part block = brick({-10, -10, -4}, {10, 10, 0}) + cube(1, {0, 0, 3});
  const double tolerance = csgcore::thickness_tolerance(csgcore::reference_box(block.scene()));
  Part result = block;
  double x = -10;
  for (const double share : kToleranceShares) {
    const double t = share * tolerance;
    result = result + brick({x, -9, 0}, {x + 2, -6, t});             // a plate
    result = result + brick({x, -5, t}, {x + 2, -2, 1});             // over a gap
    result = result - brick({x, 2, -2}, {x + 1, 4, -t});             // under a skin
    result = result - brick({x + 0.5, 6, -1}, {x + 0.5 + t, 9, 1});  // a slit
    x += 2.5;
  }
  return result.scene();
}

Family thin_polyhedra() {
  const auto shell = [](double share) {
    const double inner = 10 * (1 - share);
    return (cube(10) - cube(inner) - brick({0, 0, 0}, {6, 6, 6})).scene();
  };
  return {"thin_polyhedra",
          {{"plate_of_1e-7",
            [] {
              return brick({-5, -5, 0}, {5, 5, 1e-6}).scene();
            }},
           {"bar_of_1e-6",
            [] {
              return brick({0, 0, 0}, {1e-5, 1e-5, 10}).under(turn(30, 40, 0)).scene();
            },
            close_up(1e-5)},
           {"shell_of_1e-4", [=] { return shell(1e-4); }},
           {"shell_of_1e-7", [=] { return shell(1e-7); }},
           {"tolerances", tolerances}}};
}

// --- Scales and maps ---

Part faceted_block() {
  const Part body = brick({-8, -8, 0}, {8, 8, 10}) - prism(4, 10, 5, 6) - rod(0, 4, 2);
  return (body + prism(4, 10, 2.5, 5, {2, 0, 0})) - faceted_ball(4, 9, {8, 8, 10});
}

Family scaled_polyhedra() {
  Family family{"scaled_polyhedra", {}};
  add_mapped(faceted_block, family);
  family.cases.push_back(
      {"mirrored_twin", [] {
         const Mat3 mirror{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
         return (faceted_block() + faceted_block().under({mirror, Vec3{0.0}})).scene();
       }});
  // The local numbers and the matrix cancel each other.
  family.cases.push_back({"1e12_times_1e-12", [] {
                            const Part huge =
                                brick(Vec3{-5e12}, Vec3{5e12}) - cube(6e12, Vec3{5e12});
                            return huge.under({Mat3{1e-12}, Vec3{0.0}}).scene();
                          }});
  return family;
}

// --- Many facets ---

Part octahedron(double radius) {
  csgcore::Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 v(0.0);
    v[axis] = radius;
    mesh.vertices.insert(mesh.vertices.end(), {v, -v});
  }
  for (uint32_t i = 0; i < 8; ++i) {
    const uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
    const bool is_even = (x + y + z) % 2 == 0;
    mesh.faces.push_back(is_even ? std::vector{x, y, z} : std::vector{x, z, y});
  }
  return csgcore::make_polyhedron(csgcore::Polyhedron::from(mesh));
}

Family facets() {
  Family family{"facets", {}};
  const auto add = [&](const char* name, const std::function<Part()>& make,
                       bool only_full_run = false) {
    family.cases.push_back(
        {name, [make] { return make().scene(); }, cameras_off_edges, only_full_run});
  };
  add("ball_of_48", [] { return faceted_ball(10, 48); });
  add("ball_of_100", [] { return faceted_ball(10, 100); });
  add(
      "ball_of_200", [] { return faceted_ball(10, 200); }, true);
  add("48_less_48", [] { return faceted_ball(10, 48) - faceted_ball(7, 48, {6, 5, 4}); });
  add("48_less_100", [] { return faceted_ball(10, 48) - faceted_ball(7, 100, {6, 5, 4}); });
  add("48_less_half_of_itself_turned_by_a_sector", [] {
    return faceted_ball(10, 48) -
           faceted_ball(10, 48).under(turn(0, 0, 7.5)) * cube(20, {10, 0, 0});
  });
  add("ball_in_its_sphere", [] { return ball(10) - faceted_ball(10, 48); });
  add("sphere_in_its_ball", [] { return faceted_ball(10, 48) - ball(9.99, {3, 0, 0}); });
  add("dodecahedron", [] { return dodecahedron(3).under(turn(10, 20, 30)); });
  add("dodecahedron_less_its_cube", [] {
    return dodecahedron(3) - cube(6) - brick({0, 0, 0}, {6, 6, 6});
  });
  add("dodecahedra_on_their_cubes", [] {
    return dodecahedron(3) + cube(6, {0, 0, 6}) + dodecahedron(3).at({0, 0, 12});
  });
  add("octahedra", [] {
    return octahedron(5) + octahedron(5).at({5, 5, 0}) - octahedron(2.5).at({2.5, 0, 2.5});
  });
  return family;
}

// --- Eyes ---

/// Eyes in faces of a cube of ±5.
std::vector<Camera> eyes_in_faces(const Scene& scene, PictureSize size) {
  const auto looking_around = [&](double around_deg, double above_deg, const Vec3& eye) {
    View view =
        view_around(camera_box(scene), size, Projection::kPerspective, around_deg, above_deg, 1);
    view.eye = eye;
    view.half_height = 0.8;
    return view;
  };
  return {{"in an edge", looking_around(0, 3, {5, 5, 0})},
          {"in a face", looking_around(20, 10, {1, 2, 5})},
          {"in a corner", looking_around(50, 20, {5, 5, 5})}};
}

Family eyes_in_polyhedra() {
  const auto pocket = [] { return cube(10) - cube(6, {2, 2, 2}); };
  const auto steps = [] {
    return brick({-5, -5, -5}, {5, 5, -2}) + brick({-5, -5, -2}, {2, 5, 1}) +
           brick({-5, -5, 1}, {-1, 5, 5});
  };
  return {"eyes_in_polyhedra",
          {{"cube", [] { return cube(10).scene(); }, eyes_in_faces},
           {"pocket", [=] { return pocket().scene(); }, eyes_in_faces},
           {"steps", [=] { return steps().scene(); }, eyes_in_faces}},
          true};
}

}  // namespace

std::vector<Family> polyhedron_families() {
  return {coincident_cubes(), prisms(), thin_polyhedra(),
          scaled_polyhedra(), facets(), eyes_in_polyhedra()};
}

}  // namespace stress
