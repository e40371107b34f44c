#include "shader_program.hpp"

#include <charconv>
#include <initializer_list>
#include <string_view>

#include "glrender/gl_error.hpp"
#include "shader_kinds.hpp"
#include "shader_sources.hpp"

namespace glrender {
namespace {

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 9).ptr;
  return {text, end};
}

void define(std::string& source, std::string_view name, int value) {
  source.append("#define ").append(name).append(" ").append(std::to_string(value)).append("\n");
}

std::string prologue(const ProgramKey& key) {
  std::string source = "#version 330 core\n";
  if (key.conservative_depth) source += "#extension GL_ARB_conservative_depth : require\n";
  // For mesh.glsl, which does without it where it must.
  if (!key.nonconvex.empty()) source += "#extension GL_ARB_gpu_shader5 : enable\n";
  for (const ShaderConstant& constant : kShaderConstants) {
    source.append("#define ").append(constant.name).append(" ");
    source += constant.is_integer ? std::to_string(static_cast<int>(constant.value))
                                  : number(constant.value);
    source += "\n";
  }
  source += "#define LIST_TRUE " + std::to_string(csgcore::kListTrue) + "u\n";
  source += "#define LIST_FALSE " + std::to_string(csgcore::kListFalse) + "u\n";
  const bool has_cuts = !key.cuts.empty();
  const bool has_nonconvex = !key.nonconvex.empty();
  const bool is_long = key.path == Path::kLongList;
  define(source, "SHORT_LIST",
         static_cast<int>(is_long ? kLongList : short_list(has_cuts || has_nonconvex, key.tiles)));
  define(source, "PATH", static_cast<int>(is_long ? Path::kShortList : key.path));
  define(source, "TILES", key.tiles);
  define(source, "SHADING", static_cast<int>(key.shading));
  define(source, "PERSPECTIVE", key.perspective);
  define(source, "MEASURED", key.measured);
  define(source, "HAS_CUTS", has_cuts);
  define(source, "HAS_NONCONVEX", has_nonconvex);
  define(source, "HAS_MESHES", key.nonconvex.has(csgcore::Shape::kMesh));
  define(source, "CONSERVATIVE_DEPTH", key.conservative_depth);
  define(source, "CLIP_ZERO_TO_ONE", key.clip_zero_to_one);
  define(source, "BEHIND", key.behind);
  return source;
}

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length > 0 ? length : 1), '\0');
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return log;
}

std::string joined(const ProgramKey& key, std::initializer_list<std::string_view> parts) {
  std::string source = prologue(key);
  for (const std::string_view part : parts) source += part;
  return source;
}

/// Compiles the source and attaches the result to the program.
void attach(GLuint program, GLenum stage, const std::string& source) {
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  const std::string log = compiled ? "" : shader_log(shader);
  if (compiled) glAttachShader(program, shader);
  glDeleteShader(shader);  // the program keeps it
  if (!compiled) throw GlError("a shader does not compile (please report this): " + log);
}

}  // namespace

ProgramSources program_sources(const ProgramKey& key) {
  ProgramSources sources;
  sources.vertex = joined(key, {shader_source::kFrame,
                                key.tiles ? shader_source::kTileVert : shader_source::kCellVert});
  const std::string kinds = kinds_source(key.enclosures, key.cuts, key.nonconvex);
  if (key.path == Path::kBoxes) {
    sources.fragment = joined(key, {shader_source::kFrame, shader_source::kRay, kinds,
                                    shader_source::kShade, shader_source::kBoxFrag});
  } else {
    sources.fragment = joined(
        key, {shader_source::kFrame, shader_source::kRay, kinds, shader_source::kShade,
              shader_source::kFirstHit, shader_source::kSharedFaces, shader_source::kTraceFrag});
  }
  return sources;
}

Program compile_program(const ProgramKey& key) {
  Program program = Program::make();
  const ProgramSources sources = program_sources(key);
  attach(program.name(), GL_VERTEX_SHADER, sources.vertex);
  attach(program.name(), GL_FRAGMENT_SHADER, sources.fragment);
  glLinkProgram(program.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (!linked) {
    GLint length = 0;
    glGetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<size_t>(length > 0 ? length : 1), '\0');
    glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw GlError("a shader does not link (please report this): " + log);
  }
  return program;
}

GLuint ProgramCache::get(const ProgramKey& key) {
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    if (!compiles_) throw ShaderMissing();
    found = programs_.emplace(key, compile_program(key)).first;
  }
  return found->second.name();
}

}  // namespace glrender
