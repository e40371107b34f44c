// Scenes of triangle meshes: of many shapes, with faces that they share with one another and with
// other primitives, self-intersecting, inside out, open, thin, and seen from within.
#include <cmath>
#include <random>

#include "cases.hpp"
#include "csgcore/tracer.hpp"
#include "support/reference.hpp"
#include "support/test_meshes.hpp"

namespace stress {
namespace {

using test_support::box_parts;
using test_support::MeshParts;

Part mesh_brick(const Vec3& min, const Vec3& max) { return mesh(box_parts(min, max)); }

MeshParts torus(double radius, double tube) {
  return test_support::torus_parts(radius, tube, 40, 16);
}
MeshParts thread() { return test_support::helix_parts(5, 0.8, 2, 4, 24, 8); }
MeshParts hills(double size) {
  std::mt19937 random(3);
  return test_support::height_field_parts(size, 12, 1, 4, random);
}
MeshParts star() {
  std::mt19937 random(4);
  return test_support::star_parts(3, 7, 3, random);
}
MeshParts sliced(double half) {
  std::mt19937 random(5);
  return test_support::sliced_box_parts(Vec3(half), 6, random);
}
/// A box with a ball-shaped cavity, in one mesh.
MeshParts hollow() {
  MeshParts parts = box_parts(Vec3(-6), Vec3(6));
  parts.add(test_support::icosphere_parts(4, 2).inside_out());
  return parts;
}
/// Two boxes and a ball that overlap, in one mesh.
MeshParts overlapping() {
  MeshParts parts = box_parts(Vec3(-6), Vec3(2));
  parts.add(box_parts(Vec3(-2), Vec3(6)));
  parts.add(test_support::icosphere_parts(4, 2).moved({4, -4, 0}));
  return parts;
}

Family meshes() {
  Family family{
      "meshes",
      {{"torus_less_rods",
        [] {
          return (mesh(torus(6, 2)) - rod(-3, 3, 1, {6, 0, 0}) - rod(-9, 9, 4.5)).scene();
        }},
       {"thread_on_a_rod", [] { return (rod(-1, 10, 5) + mesh(thread())).scene(); }},
       {"thread_cut_from_a_rod", [] { return (rod(-1, 10, 5.3) - mesh(thread())).scene(); }},
       {"hills_with_a_hole",
        [] {
          return (mesh(hills(12)) - rod(-1, 9, 2, {6, 6, 0})).scene();
        }},
       {"star_in_a_ball", [] { return (ball(5) * mesh(star())).scene(); }},
       {"ball_less_star",
        [] {
          return (ball(6) - mesh(star()) - cube(20, {10, 0, 0})).scene();
        }},
       {"hollow_opened",
        [] {
          return (mesh(hollow()) - cube(12, {6, -6, 6})).scene();
        }},
       {"overlapping", [] { return (mesh(overlapping()) - rod(-9, 9, 1.5)).scene(); }},
       {"inside_out",
        [] {
          return (mesh(torus(6, 2).inside_out()) - cube(8, {6, 0, 4})).scene();
        }},
       {"sliced", [] { return (mesh(sliced(5)).under(turn(20, 30, 40)) - ball(5.5)).scene(); }},
       {"torus_less_itself_turned",
        [] {
          return (mesh(torus(6, 2)) - mesh(torus(6, 2)).under(turn(90, 0, 0)).at({6, 0, 0}))
              .scene();
        }},
       {"links", [] {
          Part chain = mesh(torus(4, 1));
          for (int i = 1; i < 5; ++i) {
            chain = chain + mesh(torus(4, 1)).under(turn(90 * (i % 2), 0, 0)).at({6.0 * i, 0, 0});
          }
          return chain.scene();
        }}}};
  for (Case& one : family.cases) one.cameras = cameras_off_edges;
  return family;
}

// --- Coincident faces ---

/// An L of which a brick fills the inner corner, flush on all sides.
Part filled_corner() {
  return mesh(test_support::l_prism_parts(10, 3, 4)) + brick({3, 3, 0}, {10, 10, 4}) -
         rod(0, 4, 2, {6, 6, 0});
}

/// Boxes in one mesh that share a face, edges and vertices.
Part neighbours_in_a_mesh() {
  MeshParts parts = box_parts({0, 0, 0}, {4, 4, 4});
  parts.add(box_parts({4, 0, 0}, {8, 4, 4}));
  parts.add(box_parts({0, 4, 4}, {4, 8, 8}));
  parts.add(box_parts({8, 4, 4}, {12, 8, 8}));
  return mesh(parts) - brick({2, 2, 2}, {6, 4, 4});
}

/// A mesh twice in itself, and once inside out within: the windings are 2 and 1.
Part same_shells() {
  MeshParts parts = test_support::icosphere_parts(5, 2);
  parts.add(test_support::icosphere_parts(5, 2));
  MeshParts inner = test_support::icosphere_parts(3, 2).inside_out();
  parts.add(inner);
  parts.add(inner);
  return mesh(parts) - brick({0, 0, 0}, Vec3(6));
}

/// Two shells of opposite orientation in the same place leave nothing.
Part cancelled_shells() {
  MeshParts parts = box_parts(Vec3(-4), Vec3(4));
  parts.add(box_parts(Vec3(-4), Vec3(4)).inside_out());
  parts.add(box_parts(Vec3(-2), Vec3(2)));
  return mesh(parts) + rod(-4, -2, 3);
}

Family coincident_meshes() {
  return {"coincident_meshes",
          {{"box_less_its_brick",
            [] {
              return (mesh_brick(Vec3(-5), Vec3(5)) - brick(Vec3(-5), Vec3(5)) + ball(1)).scene();
            }},
           {"brick_less_a_box_to_its_faces",
            [] {
              return (brick(Vec3(-5), Vec3(5)) - mesh_brick({0, -5, 0}, {5, 2, 5})).scene();
            }},
           {"box_and_brick",
            [] { return (mesh_brick(Vec3(-5), Vec3(5)) + brick(Vec3(-5), Vec3(5))).scene(); }},
           {"brick_and_box",
            [] { return (brick(Vec3(-5), Vec3(5)) + mesh_brick(Vec3(-5), Vec3(5))).scene(); }},
           {"tower",
            [] {
              return all_of({mesh_brick({-4, -4, 0}, {4, 4, 3}), brick({-4, -4, 3}, {4, 4, 6}),
                             rod(6, 8, 4), mesh(torus(4, 1)).at({0, 0, 8}), rod(-3, 0, 2)})
                  .scene();
            }},
           {"filled_corner", [] { return filled_corner().scene(); }},
           {"neighbours_in_a_mesh", [] { return neighbours_in_a_mesh().scene(); }},
           {"same_shells", [] { return same_shells().scene(); }},
           {"cancelled_shells", [] { return cancelled_shells().scene(); }},
           {"torus_less_itself",
            [] { return (mesh(torus(6, 2)) - mesh(torus(6, 2)) + ball(2)).scene(); }},
           {"torus_in_its_frame",
            [] {
              const Affine first = turn(17, 29, 0), second = turn(0, 0, 43);
              const Part whole = mesh(torus(6, 2)).under(csgcore::compose(first, second));
              return (whole - mesh(torus(6, 2)).under(second).under(first) * cube(12, {6, 0, 0}))
                  .scene();
            }},
           {"ball_turned_by_its_symmetry",
            [] {
              const Part solid = mesh(test_support::icosphere_parts(6, 2));
              return (solid - solid.under(turn(180, 0, 0)) * cube(9, {5, 0, 0}) + ball(2)).scene();
            }},
           {"flush_holes",
            [] {
              return (mesh_brick({-8, -8, 0}, {8, 8, 4}) - rod(0, 4, 3) -
                      brick({4, 4, 0}, {8, 8, 4}) - mesh_brick({-8, 4, 2}, {-4, 8, 4}) +
                      prism(0, 4, 2, 6))
                  .scene();
            }},
           {"sliced_on_a_brick",
            [] {
              return (mesh(sliced(5)) + brick({-5, -5, 5}, {5, 5, 7}) - brick(Vec3(0.0), Vec3(5)))
                  .scene();
            }},
           {"same_in_many_differences",
            [] {
              Part result = mesh(torus(6, 2));
              for (int i = 0; i < 9; ++i) {
                result = i % 2 ? result + mesh(torus(6, 2)) : result - mesh(torus(6, 2));
              }
              return (result + rod(-2, 2, 4)).scene();
            }}},
          true};
}

// --- The tolerance ---

constexpr double kShares[] = {0.2, 0.7, 0.99, 1.01, 1.3, 2, 7, 50};  // of the tolerance

/// Plates, gaps, skins and slits of so many tolerances, all in one mesh over a mesh block.
Scene mesh_tolerances() {
  const Box box{Vec3(-10, -10, -4), Vec3(10, 10, 4)};
  const double tolerance = csgcore::thickness_tolerance(box);
  MeshParts plates = box_parts(box.min, {10, 10, 0});
  plates.add(box_parts({-10, -10, 3}, {-9, -9, 4}));
  MeshParts cuts;
  double x = -10;
  for (const double share : kShares) {
    const double t = share * tolerance;
    plates.add(box_parts({x, -9, 0}, {x + 2, -6, t}));
    plates.add(box_parts({x, -5, t}, {x + 2, -2, 1}));
    cuts.add(box_parts({x, 2, -2}, {x + 1, 4, -t}));
    cuts.add(box_parts({x + 0.5, 6, -1}, {x + 0.5 + t, 9, 1}));
    x += 2.5;
  }
  return (mesh(plates) - mesh(cuts)).scene();
}

/// Shells in one mesh that are so many tolerances apart, each cut open.
Scene shells_in_a_mesh() {
  const double tolerance = csgcore::thickness_tolerance({Vec3(-11), Vec3(11)});
  MeshParts shells = box_parts(Vec3(-11), Vec3(-10));
  shells.add(box_parts(Vec3(10), Vec3(11)));
  double x = -7;
  for (const double share : kShares) {
    shells.add(test_support::icosphere_parts(1, 1).moved({x, 0, 0}));
    const double inner = 1 - share * tolerance;
    shells.add(test_support::icosphere_parts(inner, 1).inside_out().moved({x, 0, 0}));
    x += 2;
  }
  return (mesh(shells) - brick({-9, -2, -0.1}, {10, 0, 3})).scene();
}

/// Sheets in the top of a block, or so many tolerances above it, cut from it: where a sheet reaches
/// into the block, its back is seen.
Scene sheets_in_a_block() {
  const double tolerance = csgcore::thickness_tolerance({Vec3(-10, -10, -4), Vec3(10, 10, 0)});
  Part result = brick({-10, -10, -4}, {10, 10, 0});
  double x = -9;
  for (const double share : {0.0, -0.4, -0.8, -1.3, -2.5, -6.0}) {
    const double z = share * tolerance;
    result = result - mesh({{{x, -9, z}, {x + 2.5, -9, z}, {x + 2.5, 9, z}, {x, 9, z}},
                            {{0, 1, 2}, {0, 2, 3}}});
    x += 3;
  }
  return result.scene();
}

Family mesh_tolerance() {
  return {"mesh_tolerance",
          {{"plates_and_cuts", mesh_tolerances},
           {"shells", shells_in_a_mesh},
           {"sheets_in_a_block", sheets_in_a_block},
           {"plate_of_1e-7",
            [] {
              return mesh_brick({-5, -5, 0}, {5, 5, 1e-6}).scene();
            }},
           {"sheet_without_a_volume", [] {
              MeshParts sheet = box_parts({-5, -5, 0}, {5, 5, 0});
              return (mesh(sheet) + ball(2, {0, 0, 3})).scene();
            }}}};
}

// --- Scales and maps ---

Part mesh_block() {
  return (mesh(hollow()) - rod(-9, 9, 2)) + mesh(torus(8, 1)) - mesh(star()).at({6, 6, 6});
}

Family scaled_meshes() {
  Family family{"scaled_meshes", {}};
  add_mapped(mesh_block, family);
  family.cases.push_back({"vertices_at_1e6", [] {
                            const MeshParts far = hollow().moved({1e6, -2e6, 1e6});
                            return (mesh(far) - rod(-9, 9, 2, {1e6, -2e6, 1e6})).scene();
                          }});
  return family;
}

// --- Eyes ---

/// Eyes at these places, which look around.
Cameras eyes_at(const std::vector<Vec3>& eyes) {
  return [eyes](const Scene& scene, PictureSize size) {
    std::vector<Camera> cameras;
    for (const Vec3& eye : eyes) {
      const auto i = static_cast<double>(cameras.size());
      View view = view_around(camera_box(scene), size, Projection::kPerspective, 20 + 50 * i,
                              5 + 10 * i, 1);
      view.eye = eye;
      view.half_height = 0.8;
      cameras.push_back({"eye " + std::to_string(cameras.size()), view});
    }
    return cameras;
  };
}

Family eyes_in_meshes() {
  const auto opened = [] { return (mesh(hollow()) - rod(-9, 9, 1, {3, 3, 0})).scene(); };
  return {
      "eyes_in_meshes",
      {{"in_the_solid_and_the_cavity", opened, eyes_at({{5, 5, 5}, {0.1, 0.2, 0.3}, {5.5, 0, 0}})},
       {"in_a_face_an_edge_a_vertex", opened, eyes_at({{1, 2, 6}, {6, 6, 0}, {6, 6, 6}})},
       {"in_a_tube", [] { return mesh(torus(6, 2)).scene(); },
        eyes_at({{6, 0, 0}, {0, 0, 0}, {8, 0, 0}})},
       {"in_overlapping_shells", [] { return mesh(overlapping()).scene(); },
        eyes_at({{-1, -1, -1}, {2, 2, 2}, {-2, -2, -2}})},
       {"in_nothing_less_a_mesh", [] { return (ball(20) - mesh(star())).scene(); },
        eyes_at({{0, 0, 0}, {15, 0, 0}, {0.5, 0.5, 0.5}})}},
      true};
}

// --- Rays in faces, edges and vertices ---

/// Orthographic views along the axes whose rays are at multiples of 1/4.
std::vector<Camera> on_the_grid(const Scene&, PictureSize size) {
  std::vector<Camera> cameras;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t height = size.height_px < 128 ? 64 : 512;
    View view = view_along(Box{Vec3{-16.0}, Vec3{16.0}}, size, Projection::kOrthographic, axis, 2);
    view.half_height = height / 8.0;
    view.width_px = height * 3 / 2;
    view.height_px = height;
    view.eye += 0.125 * (view.right + view.up);
    cameras.push_back({"axis " + std::to_string(axis), view});
  }
  return cameras;
}

Family meshes_on_the_grid() {
  return {
      "meshes_on_the_grid",
      {{"l_prism", [] { return mesh(test_support::l_prism_parts(10, 3, 4)).scene(); }, on_the_grid},
       {"filled_corner", [] { return filled_corner().scene(); }, on_the_grid},
       {"neighbours", [] { return neighbours_in_a_mesh().scene(); }, on_the_grid},
       {"hills",
        [] {
          return (mesh(hills(12)) - mesh_brick({2, 2, 0}, {4, 8, 9})).scene();
        },
        on_the_grid},
       {"boxes_of_one_mesh_less_bricks",
        [] {
          MeshParts boxes;
          Part bricks = brick({-6, -6, 0}, {6, 6, 1});
          for (int i = 0; i < 16; ++i) {
            const Vec3 at{2.0 * (i % 4) - 4, 2.0 * (i / 4) - 4, 0};
            boxes.add(box_parts(at, at + Vec3(2, 2, 1 + i % 3)));
            if (i % 5 == 0) bricks = bricks + brick(at + Vec3(0, 0, 1), at + Vec3(2, 1, 2));
          }
          return (mesh(boxes) - bricks).scene();
        },
        on_the_grid}},
      true,
      true};
}

// --- Open meshes ---

MeshParts without_a_lid() {
  MeshParts parts = box_parts({-5, -5, -5}, {5, 5, 5});
  parts.triangles.erase(parts.triangles.begin() + 2, parts.triangles.begin() + 4);
  return parts;
}

MeshParts torn(const MeshParts& parts, double share) {
  std::mt19937 random(6);
  return test_support::with_holes(parts, share, random);
}

Family open_meshes() {
  Family family{
      "open_meshes",
      {{"triangle",
        [] {
          return mesh({{{-5, -5, 0}, {5, -5, 1}, {0, 5, 2}}, {{0, 1, 2}}}).scene();
        }},
       {"box_without_a_lid", [] { return mesh(without_a_lid()).scene(); }},
       {"filled_box_without_a_lid", [] { return (mesh(without_a_lid()) + ball(4)).scene(); }},
       {"box_without_a_lid_less_a_rod",
        [] { return (mesh(without_a_lid()) - rod(-9, 9, 3)).scene(); }},
       {"ball_less_a_box_without_a_lid",
        [] {
          return (ball(6) - mesh(without_a_lid()) - cube(9, {6, 0, 0})).scene();
        }},
       {"torn_ball",
        [] { return (mesh(torn(test_support::icosphere_parts(6, 3), 0.1)) + ball(2)).scene(); }},
       {"torn_torus_in_a_brick",
        [] {
          return (brick({-9, -9, 0}, {9, 9, 3}) - mesh(torn(torus(6, 2), 0.05))).scene();
        }},
       {"torn_hills", [] { return mesh(torn(hills(12), 0.2)).scene(); }},
       {"open_on_a_brick", [] {
          return (brick({-5, -5, -5}, {5, 5, -3}) + mesh(without_a_lid())).scene();
        }}}};
  for (Case& one : family.cases) one.cameras = cameras_off_edges;
  return family;
}

// --- Large ones ---

Family large_meshes() {
  Family family{"large_meshes", {}};
  family.cases.push_back(
      {"ball_of_20480",
       [] {
         return (mesh(test_support::icosphere_parts(6, 5)) - ball(4, {4, 0, 2})).scene();
       },
       default_cameras});
  family.cases.push_back(
      {"hills_of_100000",
       [] {
         std::mt19937 random(8);
         return mesh(test_support::height_field_parts(10, 158, 1, 1.2, random)).scene();
       },
       default_cameras, true});
  return family;
}

}  // namespace

std::vector<Family> mesh_families() {
  return {meshes(),         coincident_meshes(),  mesh_tolerance(), scaled_meshes(),
          eyes_in_meshes(), meshes_on_the_grid(), open_meshes(),    large_meshes()};
}

}  // namespace stress
