// Every shader variant compiles, and GL objects have one owner.
#include <gtest/gtest.h>

#include <type_traits>

#include "gl_object.hpp"
#include "glrender/context.hpp"
#include "shader_program.hpp"

namespace {

using namespace glrender;

template <typename T>
constexpr bool kMoveOnly =
    std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
    !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(kMoveOnly<Buffer> && kMoveOnly<Texture> && kMoveOnly<Framebuffer> &&
              kMoveOnly<VertexArray> && kMoveOnly<Program> && kMoveOnly<HeadlessContext>);

TEST(ShaderTest, EveryVariantCompiles) {
  HeadlessContext context;
  int compiled = 0;
  for (int path = 0; path < kPaths; ++path) {
    for (int bits = 0; bits < 128; ++bits) {
      ProgramKey key;
      key.path = static_cast<Path>(path);
      key.shading = bits & 1 ? Shading::kPhong : Shading::kOpenScad;
      key.perspective = bits & 2;
      key.measured = bits & 4;
      key.has_sphere = bits & 8;
      key.has_frustum = bits & 16;
      key.behind = bits & 32;
      key.conservative_depth = key.clip_zero_to_one = bits & 64;
      if (!key.has_sphere && !key.has_frustum) continue;
      ASSERT_NO_THROW(compile_program(key)) << path << " " << bits;
      ++compiled;
    }
  }
  EXPECT_EQ(compiled, kPaths * 96);
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
