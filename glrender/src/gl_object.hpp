// Move-only owners of OpenGL names.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace glrender {

/// Owns one name; 0 is none. `Traits::create()` makes a name, `Traits::destroy(name)` frees it.
template <typename Traits>
class GlObject {
 public:
  GlObject() = default;
  static GlObject make() { return GlObject(Traits::create()); }
  explicit GlObject(GLuint name) : name_(name) {}
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  void reset() {
    if (name_ != 0) Traits::destroy(name_);
    name_ = 0;
  }
  GLuint name_ = 0;
};

#define GLRENDER_OBJECT(Type, Suffix)                                \
  struct Type##Traits {                                              \
    static GLuint create() {                                         \
      GLuint name = 0;                                               \
      glGen##Suffix(1, &name);                                       \
      return name;                                                   \
    }                                                                \
    static void destroy(GLuint name) { glDelete##Suffix(1, &name); } \
  };                                                                 \
  using Type = GlObject<Type##Traits>

GLRENDER_OBJECT(Buffer, Buffers);
GLRENDER_OBJECT(Texture, Textures);
GLRENDER_OBJECT(Framebuffer, Framebuffers);
GLRENDER_OBJECT(VertexArray, VertexArrays);
#undef GLRENDER_OBJECT

struct ProgramTraits {
  static GLuint create() { return glCreateProgram(); }
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
using Program = GlObject<ProgramTraits>;

}  // namespace glrender
