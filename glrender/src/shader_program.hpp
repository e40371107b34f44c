// Shader variants, compiled from the embedded sources when first needed.
#pragma once

#include <map>
#include <string>

#include "gl_object.hpp"
#include "glrender/frame_settings.hpp"
#include "shader_constants.hpp"
#include "shader_kinds.hpp"

namespace glrender {

/// The properties that select a shader variant.
struct ProgramKey {
  Path path = Path::kSingle;
  bool tiles = false;  // tiles of the screen, not cells
  Shading shading = Shading::kOpenScad;
  bool perspective = true;
  bool measured = false;
  KindSet enclosures;  // kinds of the scene's primitives: see kinds_source()
  KindSet cuts;
  KindSet nonconvex;
  bool conservative_depth = false;
  bool clip_zero_to_one = false;
  bool behind = false;  // for Renderer::draw_behind

  auto operator<=>(const ProgramKey&) const = default;
};

/// GLSL 3.30.
struct ProgramSources {
  std::string vertex, fragment;
};
ProgramSources program_sources(const ProgramKey& key);

/// Compiles and links one variant. Throws GlError with the driver's log.
Program compile_program(const ProgramKey& key);

/// The variants compiled so far.
class ProgramCache {
 public:
  GLuint get(const ProgramKey& key);
  void set_compiles(bool compiles) { compiles_ = compiles; }
  size_t size() const { return programs_.size(); }

 private:
  std::map<ProgramKey, Program> programs_;
  bool compiles_ = true;
};

}  // namespace glrender
