// Every shader variant compiles, and GL objects have one owner.
#include <gtest/gtest.h>

#include <cstdio>
#include <type_traits>
#include <utility>
#include <vector>

#include "gl_object.hpp"
#include "glrender/context.hpp"
#include "polyhedron_texels.hpp"
#include "shader_program.hpp"
#include "support/full_run.hpp"

namespace {

using namespace glrender;

template <typename T>
constexpr bool kMoveOnly =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(kMoveOnly<Buffer> && kMoveOnly<Texture> && kMoveOnly<Framebuffer> &&
              kMoveOnly<VertexArray> && kMoveOnly<Program> && kMoveOnly<HeadlessContext>);

/// Of a minute's worth, every fifth but in a full run: five shares no factor with what a bit or a
/// path repeats by.
TEST(ShaderTest, EveryVariantCompiles) {
  HeadlessContext context;
  const int step = test_support::full_run() ? 1 : 5;
  int variants = 0;
  for (int path = 0; path < kPaths; ++path) {
    for (int bits = 0; bits < 512; ++bits) {
      ProgramKey key;
      key.path = static_cast<Path>(path);
      key.shading = bits & 1 ? Shading::kPhong : Shading::kOpenScad;
      key.perspective = bits & 2;
      key.measured = bits & 4;
      key.has_sphere = bits & 8;
      key.has_frustum = bits & 16;
      key.behind = bits & 32;
      key.conservative_depth = key.clip_zero_to_one = bits & 64;
      key.has_polyhedron = bits & 128;
      key.tiles = bits & 256;
      if (!key.has_sphere && !key.has_frustum) continue;
      const bool is_of_tiles =
          key.path == Path::kSingle || key.path == Path::kShortList || key.path == Path::kLongList;
      if (key.tiles && (!is_of_tiles || key.conservative_depth)) continue;
      if (!key.tiles && key.path == Path::kLongList) continue;
      // Their faces have to do with neither.
      if (key.has_polyhedron && (key.shading == Shading::kPhong || key.measured)) continue;
      if (variants++ % step != 0) continue;
      ASSERT_NO_THROW(compile_program(key)) << path << " " << bits;
    }
  }
  EXPECT_EQ(variants, (kPaths - 1) * (96 + 24) + 3 * (48 + 12));
  std::printf("compiled one in %d of %d variants\n", step, variants);
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
    // By the texels alone, every entry that csgcore lists, and every place that its branches end
    // at.
    uint32_t texel = first + 1;
    std::vector<std::pair<uint32_t, uint32_t>> branches;  // the texel after, the entry after
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
