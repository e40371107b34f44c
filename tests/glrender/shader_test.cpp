// Tests that every shader variant compiles, and that GL objects have one owner.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <regex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "csgcore/canonical_primitive.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/primitive.hpp"
#include "csgcore/profile.hpp"
#include "gl_object.hpp"
#include "glrender/context.hpp"
#include "glrender/renderer.hpp"
#include "shader_program.hpp"
#include "shape_texels.hpp"
#include "support/full_run.hpp"
#include "support/models.hpp"
#include "support/test_meshes.hpp"
#include "temporary_folder.hpp"

namespace {

using namespace glrender;

template <typename T>
constexpr bool kMoveOnly =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(kMoveOnly<Buffer> && kMoveOnly<Texture> && kMoveOnly<Framebuffer> &&
              kMoveOnly<VertexArray> && kMoveOnly<Program> && kMoveOnly<HeadlessContext>);

bool compiles(csgcore::Shape enclosure, KindSet cuts) {
  ProgramKey key;
  key.path = Path::kList;
  key.enclosures = {enclosure};
  key.cuts = cuts;
  try {
    compile_program(key);
    return true;
  } catch (const GlError&) {
    return false;
  }
}

/// The kinds of each sort of ray.glsl. Those that are convex have the sort that their shaders say.
struct Roles {
  std::vector<csgcore::Shape> enclosures, cuts;
  KindSet nonconvex;
};

Roles find_roles() {
  Roles roles;
#define FIND_ROLE(Name)                                                   \
  (compiles(csgcore::Shape::k##Name, {}) ? roles.enclosures : roles.cuts) \
      .push_back(csgcore::Shape::k##Name);
  CSGCORE_FOR_EACH_CONVEX_SHAPE(FIND_ROLE)
#undef FIND_ROLE
#define ADD_NONCONVEX(Name) roles.nonconvex.add(csgcore::Shape::k##Name);
  CSGCORE_FOR_EACH_OTHER_SHAPE(ADD_NONCONVEX)
#undef ADD_NONCONVEX
  return roles;
}

TEST(ShaderTest, EveryKindHasASegmentOrCutsOne) {
  HeadlessContext context;
  const Roles roles = find_roles();
  ASSERT_FALSE(roles.enclosures.empty());
  for (const csgcore::Shape cut : roles.cuts) {
    EXPECT_TRUE(compiles(roles.enclosures[0], {cut})) << "kind " << int(cut);
  }
}

/// The paths that draw primitives that are not convex.
constexpr bool is_general(Path path) {
  return path == Path::kShortList || path == Path::kLongList || path == Path::kList ||
         path == Path::kBoxes;
}

/// Returns every set of kinds that a scene may have, or a sample of the variants: compiling all
/// takes minutes. It has every eleventh, or 25th, which share no factor with the periods of the
/// bits and paths.
std::vector<ProgramKey> variants(const Roles& roles) {
  // The sets of enclosures, each with all cuts and without any, and with all kinds that are not
  // convex and without any.
  const int sets = 1 << roles.enclosures.size();
  const int step = test_support::full_run() ? 1 : test_support::does_less() ? 25 : 11;
  int count = 0;
  std::vector<ProgramKey> result;
  for (int path = 0; path < kPaths; ++path) {
    for (int bits = 0; bits < 256 * sets; ++bits) {
      ProgramKey key;
      key.path = static_cast<Path>(path);
      key.shading = bits & 1 ? Shading::kPhong : Shading::kOpenScad;
      key.perspective = bits & 2;
      key.measured = bits & 4;
      key.behind = bits & 8;
      key.conservative_depth = key.clip_zero_to_one = bits & 16;
      if (bits & 32) {
        for (const csgcore::Shape cut : roles.cuts) key.cuts.add(cut);
      }
      key.tiles = bits & 64;
      for (size_t i = 0; i < roles.enclosures.size(); ++i) {
        if (bits / 256 >> i & 1) key.enclosures.add(roles.enclosures[i]);
      }
      if (bits & 128) key.nonconvex = roles.nonconvex;
      if (key.enclosures.empty() && (key.nonconvex.empty() || !key.cuts.empty())) continue;
      if (!key.nonconvex.empty() && !is_general(key.path)) continue;
      const bool is_of_tiles =
          key.path == Path::kSingle || key.path == Path::kShortList || key.path == Path::kLongList;
      if (key.tiles && (!is_of_tiles || key.conservative_depth)) continue;
      if (!key.tiles && key.path == Path::kLongList) continue;
      // The shading does not depend on the cuts nor on what is not convex, nor do measured channels
      // on the cuts.
      const bool is_plain = key.cuts.empty() && key.nonconvex.empty();
      if (!is_plain && key.shading == Shading::kPhong) continue;
      if (!key.cuts.empty() && key.measured) continue;
      if (key.shading == Shading::kPhong && count % 2 == 1) key.shading = Shading::kStudio;
      if (count++ % step == 0) result.push_back(key);
    }
  }
  const int convex = (sets - 1) * ((kPaths - 1) * (32 + 8) + 3 * (16 + 4));
  const int nonconvex = sets * (3 * 16 + 2 * 8) + (sets - 1) * (3 * 8 + 2 * 4);
  EXPECT_EQ(count, convex + nonconvex);
  std::printf("%zu of %d variants\n", result.size(), count);
  return result;
}

TEST(ShaderTest, EveryVariantCompiles) {
  HeadlessContext context;
  for (const ProgramKey& key : variants(find_roles())) {
    ASSERT_NO_THROW(compile_program(key)) << static_cast<int>(key.path);
  }
}

/// Drivers differ in what they let pass; Khronos' compiler is the reference.
TEST(ShaderTest, EveryVariantIsGlslByTheReferenceCompiler) {
  if (std::system("command -v glslangValidator >/dev/null") != 0)
    GTEST_SKIP() << "no glslangValidator";
  HeadlessContext context;  // for the roles
  const frontend::TemporaryFolder folder;
  std::string files;
  for (ProgramKey key : variants(find_roles())) {
    // glslangValidator lacks GL_ARB_conservative_depth, and `precise` in GL_ARB_gpu_shader5.
    key.conservative_depth = false;
    ProgramSources sources = program_sources(key);
    const std::regex gpu_shader5("GL_ARB_gpu_shader5");
    sources.fragment = std::regex_replace(sources.fragment, gpu_shader5, "GL_unknown");
    const std::string name = std::to_string(files.size());
    files += " " + folder.write(name + ".vert", sources.vertex);
    files += " " + folder.write(name + ".frag", sources.fragment);
  }
  folder.write("files", files);
  const std::string log = folder / "log";
  EXPECT_EQ(std::system(("xargs glslangValidator <" + (folder / "files") + " >" + log).c_str()), 0)
      << folder.read("log");
}

TEST(ShaderTest, CacheCompilesOnce) {
  HeadlessContext context;
  ProgramCache cache;
  ProgramKey key;
  const GLuint first = cache.get(key);
  EXPECT_EQ(cache.get(key), first);
  EXPECT_EQ(cache.size(), 1u);
  key.perspective = false;
  EXPECT_NE(cache.get(key), first);
  key.enclosures.add(csgcore::Shape::kSphere);
  cache.get(key);
  EXPECT_EQ(cache.size(), 3u);
}

TEST(ShaderTest, RenderersOfAContextShareThePrograms) {
  HeadlessContext context;
  csgcore::View view;
  view.eye = {0, 0, 9};
  view.half_height = 0.5;
  view.width_px = view.height_px = 16;
  FrameSettings settings;
  settings.technique = Technique::kTiles;
  const auto programs_after = [&](double radius) {
    const csgcore::Scene scene =
        test_support::scene_of(csgcore::Op::kUnion, {csgcore::make_sphere(radius)});
    const csgcore::Solid solid(csgcore::canonical_primitives(scene), scene.model);
    FrameStats stats;
    Renderer(context, solid).draw(view, settings, stats);
    return context.programs().size();
  };
  const size_t first = programs_after(1);
  EXPECT_GT(first, 0u);
  EXPECT_EQ(programs_after(2), first);
}

TEST(PolyhedronTexelsTest, HoldEveryFaceOnce) {
  PolyhedronTexels all;
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(all.first_of(nullptr), 0u);
  const auto ball = csgcore::Polyhedron::sphere(2, 20);
  const auto box = csgcore::Polyhedron::box({csgcore::Vec3(0), csgcore::Vec3(1)});
  EXPECT_EQ(all.first_of(ball.get()), 1u);
  const uint32_t first_of_box = all.first_of(box.get());
  const size_t size = all.texels().size();
  EXPECT_EQ(all.first_of(ball.get()), 1u);
  EXPECT_EQ(all.first_of(box.get()), first_of_box);
  EXPECT_EQ(all.texels().size(), size);
  EXPECT_EQ(all.texels()[0][0], 0);
  for (const auto& [polyhedron, first] : {std::pair(ball, 1u), std::pair(box, first_of_box)}) {
    // Reads by the texels alone every entry that csgcore lists, and every place at which its
    // branches end.
    uint32_t texel = first + 1;
    std::vector<std::pair<uint32_t, uint32_t>> branches;  // the texel after it, the entry after it
    const auto& entries = polyhedron->entries();
    for (uint32_t i = 0; i < entries.size(); ++i) {
      for (const auto& [texel_after, entry_after] : branches) {
        EXPECT_EQ(texel == texel_after, i == entry_after);
      }
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(all.texels()[texel][axis], float(entries[i].normal[axis]));
      }
      const float skip = all.texels()[texel][3];
      EXPECT_EQ(skip > 0, entries[i].skip > 0);
      if (skip > 0) {
        ++texel;
        EXPECT_LT(all.texels()[texel][0], entries[i].limit);
        EXPECT_GT(all.texels()[texel][0], entries[i].limit - 1e-5);
        branches.emplace_back(texel + 1 + uint32_t(skip), i + 1 + entries[i].skip);
      }
      ++texel;
    }
    EXPECT_EQ(float(texel - first - 1), all.texels()[first][0]);
  }
  EXPECT_EQ(first_of_box + 1 + 6, size);
}

TEST(PolyhedronTexelsTest, RefuseMoreThanFloatsCanCount) {
  const auto box = csgcore::Polyhedron::box({csgcore::Vec3(0), csgcore::Vec3(1)});
  EXPECT_NO_THROW(PolyhedronTexels(9).first_of(box.get()));
  EXPECT_THROW(PolyhedronTexels(7).first_of(box.get()), GlError);
}

std::shared_ptr<const csgcore::Profile> half_disks(int count) {
  using Edge = csgcore::ProfileEdge;
  std::vector<csgcore::ProfileLoop> loops;
  for (int i = 0; i < count; ++i) {
    const double x = 3 * i;
    loops.push_back(
        {{Edge::Kind::kArc, true, {x - 1, 0}, {x, 0}}, {Edge::Kind::kLine, true, {x + 1, 0}, {}}});
  }
  return std::make_shared<const csgcore::Profile>(std::move(loops), csgcore::FillRule::kNonZero);
}

TEST(ProfileTexelsTest, HoldEveryPieceOnce) {
  ProfileTexels all;
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(all.first_of(nullptr), 0u);
  EXPECT_EQ(all.first_of(half_disks(9)), 1u);
  const std::vector<ProfileTexels::Texel> texels = all.take_added();
  EXPECT_EQ(texels.size(), all.size());
  EXPECT_EQ(all.first_of(half_disks(9)), 1u) << "an equal one";
  EXPECT_TRUE(all.take_added().empty());
  EXPECT_EQ(all.first_of(half_disks(2)), texels.size());
  const auto profile = half_disks(9);
  EXPECT_EQ(texels[1][0], float(texels.size() - 2));
  EXPECT_EQ(texels[1][1], 1);
  EXPECT_EQ(texels[1][2], float(profile->radii().x));
  // Reads every piece, within the boxes of all nodes above it.
  struct Node {
    ProfileTexels::Texel box;
    size_t end;
  };
  std::vector<Node> above;
  size_t found = 0;
  for (size_t i = 2; i < texels.size();) {
    while (!above.empty() && above.back().end == i) above.pop_back();
    above.push_back({texels[i], i + 2 + static_cast<size_t>(texels[i + 1][0])});
    const auto count = static_cast<size_t>(texels[i + 1][1]);
    i += 2;
    for (size_t piece = 0; piece < count; ++piece, i += 3, ++found) {
      const csgcore::Profile::Piece& expected = profile->pieces()[found];
      EXPECT_EQ(texels[i][0], float(expected.start.x));
      EXPECT_EQ(texels[i][1], float(expected.start.y));
      EXPECT_EQ(texels[i + 1][0], float(expected.end.x));
      EXPECT_EQ(texels[i + 1][1], float(expected.end.y));
      EXPECT_EQ(texels[i + 1][2], float(expected.weight));
      EXPECT_EQ(texels[i + 2][0], float(expected.end.x - expected.start.x));
      for (const Node& node : above) {
        EXPECT_LE(i + 3, node.end);
        for (const size_t axis : {0u, 1u}) {
          EXPECT_LT(node.box[axis], texels[i][axis]);
          EXPECT_GT(node.box[axis + 2], texels[i][axis]);
        }
      }
    }
    if (count > 0) {
      EXPECT_EQ(above.back().end, i);
    }
  }
  EXPECT_EQ(found, profile->pieces().size());
}

TEST(ProfileTexelsTest, RefuseMoreThanFloatsCanCount) {
  EXPECT_NO_THROW(ProfileTexels(14).first_of(half_disks(1)));
  EXPECT_THROW(ProfileTexels(12).first_of(half_disks(1)), GlError);
}

/// Returns the triangles that the texels of a mesh hold. Expects each of them within the boxes of
/// all nodes above it, and its normal beside it.
std::vector<std::array<csgcore::Vec3, 3>> triangles_in(const std::vector<MeshTexels::Texel>& texels,
                                                       uint32_t first) {
  std::vector<std::array<csgcore::Vec3, 3>> found;
  struct Node {
    csgcore::Box box;
    size_t end;  // of the texels below it
  };
  std::vector<Node> above;
  const size_t end = first + 1 + static_cast<size_t>(texels[first][0]);
  const auto place = [&](size_t i) {
    return csgcore::Vec3{texels[i][0], texels[i][1], texels[i][2]};
  };
  for (size_t i = first + 1; i < end;) {
    while (!above.empty() && above.back().end == i) above.pop_back();
    above.push_back({{place(i), place(i + 1)}, i + 2 + static_cast<size_t>(texels[i][3])});
    const auto count = static_cast<size_t>(texels[i + 1][3]);
    i += 2;
    for (size_t triangle = 0; triangle < count; ++triangle, i += 3) {
      found.push_back({place(i), place(i + 1), place(i + 2)});
      for (const csgcore::Vec3& corner : found.back()) {
        for (const Node& node : above) {
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LT(node.box.min[axis], corner[axis]) << i;
            EXPECT_GT(node.box.max[axis], corner[axis]) << i;
          }
        }
      }
      const csgcore::Vec3 normal{texels[i][3], texels[i + 1][3], texels[i + 2][3]};
      const auto& [a, b, c] = found.back();
      EXPECT_NEAR(glm::dot(normal, glm::normalize(glm::cross(b - a, c - a))), 1, 1e-6) << i;
    }
    if (count > 0) {
      EXPECT_EQ(above.back().end, i);
    }
  }
  while (!above.empty() && above.back().end == end) above.pop_back();
  EXPECT_TRUE(above.empty());
  return found;
}

TEST(MeshTexelsTest, HoldEveryTriangleOnce) {
  MeshTexels all;
  EXPECT_TRUE(all.empty());
  EXPECT_EQ(all.first_of(nullptr), 0u);
  const auto torus = test_support::torus_parts(3, 1, 20, 10).mesh();
  const auto open_box = test_support::open_box_parts(csgcore::Vec3(0), csgcore::Vec3(1)).mesh();
  EXPECT_EQ(all.first_of(torus), 1u);
  std::vector<MeshTexels::Texel> texels = all.take_added();
  EXPECT_EQ(texels.size(), all.size());
  const uint32_t first_of_box = all.first_of(open_box);
  EXPECT_EQ(first_of_box, texels.size());
  const std::vector<MeshTexels::Texel> added = all.take_added();
  texels.insert(texels.end(), added.begin(), added.end());
  EXPECT_EQ(texels.size(), all.size());
  EXPECT_EQ(texels[1][1], 1);
  EXPECT_EQ(texels[first_of_box][1], 0);
  for (const auto& [mesh, first] : {std::pair(torus, 1u), std::pair(open_box, first_of_box)}) {
    auto found = triangles_in(texels, first);
    ASSERT_EQ(found.size(), mesh->triangles().size());
    for (const auto& [a, b, c] : mesh->triangles()) {
      const auto& vertices = mesh->canonical_vertices();
      const std::array wanted{csgcore::Vec3(glm::vec3(vertices[a])),
                              csgcore::Vec3(glm::vec3(vertices[b])),
                              csgcore::Vec3(glm::vec3(vertices[c]))};
      const auto place = std::find(found.begin(), found.end(), wanted);
      ASSERT_NE(place, found.end());
      found.erase(place);
    }
  }
  // A mesh of the same content is the same mesh.
  EXPECT_EQ(all.first_of(test_support::torus_parts(3, 1, 20, 10).mesh()), 1u);
  EXPECT_TRUE(all.take_added().empty());
}

TEST(MeshTexelsTest, RefuseMoreThanFloatsCanCount) {
  const auto ball = test_support::icosphere_parts(1, 0).mesh();
  MeshTexels all;
  all.first_of(ball);
  EXPECT_NO_THROW(MeshTexels(all.size()).first_of(ball));
  EXPECT_THROW(MeshTexels(all.size() - 1).first_of(ball), GlError);
}

TEST(FaceRoundsTest, AreOneAFaceButForThousands) {
  EXPECT_EQ(face_rounds(nullptr), 0u);
  EXPECT_EQ(face_rounds(csgcore::Polyhedron::box({csgcore::Vec3(0), csgcore::Vec3(1)}).get()), 6u);
  EXPECT_EQ(face_rounds(csgcore::Polyhedron::sphere(2, 100).get()), 256u);
}

TEST(ThicknessTest, IsThatBetweenTheNearestPlanes) {
  using csgcore::make_frustum;
  using csgcore::make_polyhedron;
  using csgcore::make_sphere;
  using csgcore::Mat3;
  using csgcore::Polyhedron;
  using csgcore::Vec3;
  const csgcore::Affine turned{glm::mat3_cast(glm::normalize(glm::dquat(0.3, 0.8, -0.4, 0.2))),
                               {3, -2, 7}};
  const auto squeezed = [&](double x, double y, double z) {
    return csgcore::compose(turned, {Mat3{Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}}, Vec3(1)});
  };
  const csgcore::Affine sheared =
      csgcore::compose(turned, {Mat3{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{5, -3, 1}}, Vec3(1)});
  const auto expect_thickness = [](const csgcore::Primitive& primitive, double thickness) {
    const csgcore::CanonicalPrimitive canonical = csgcore::canonicalize(primitive);
    EXPECT_TRUE(is_thinner(canonical, 1.0001 * thickness)) << thickness;
    EXPECT_FALSE(is_thinner(canonical, 0.9999 * thickness)) << thickness;
  };
  expect_thickness(make_sphere(0.5, turned), 1);
  for (const auto& [x, y, z] :
       {std::array{1.0, 1e-3, 1.0}, {1e-3, 1e-3, 1.0}, {1e-3, 1.0, 1.01e-3}}) {
    expect_thickness(make_sphere(0.5, squeezed(x, y, z)), 1e-3);
  }
  expect_thickness(make_frustum(2, 2 + 1e-4, 5, 5, turned), 1e-4);
  expect_thickness(make_frustum(2, 2 + 1e-4, 5, 3, sheared), 1e-4);  // the caps keep their distance
  expect_thickness(make_frustum(-8, 8, 1e-3, 1e-3, turned), 2e-3);
  expect_thickness(make_frustum(-8, 8, 1, 1, squeezed(1e-3, 1, 1)), 2e-3);
  expect_thickness(make_polyhedron(Polyhedron::box({Vec3(1, 2, 3), Vec3(4, 2 + 1e-5, 7)}), turned),
                   1e-5);
  expect_thickness(make_polyhedron(Polyhedron::frustum(0, 1e-4, 5, 5, 30), sheared), 1e-4);
}

TEST(GlObjectTest, MovesOwnership) {
  HeadlessContext context;
  Buffer a = Buffer::make();
  const GLuint name = a.name();
  Buffer b = std::move(a);
  EXPECT_EQ(a.name(), 0u);
  EXPECT_EQ(b.name(), name);
  b = Buffer();
  EXPECT_FALSE(glIsBuffer(name));
}

}  // namespace
