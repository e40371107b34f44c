# Writes OUTPUT, a header with each shader of SHADERS as a string in namespace glrender::shader_source,
# named after its file: cell.frag.glsl becomes cell_frag.
set(text "// Generated from glrender/shaders.\n#pragma once\n#include <string_view>\n\n")
string(APPEND text "namespace glrender::shader_source {\n")
foreach(shader IN LISTS SHADERS)
  get_filename_component(name "${shader}" NAME)
  string(REGEX REPLACE "\\.glsl$" "" name "${name}")
  string(REPLACE "." "_" name "${name}")
  file(READ "${shader}" source)
  string(APPEND text "inline constexpr std::string_view ${name} = R\"glsl(${source})glsl\";\n")
endforeach()
string(APPEND text "}  // namespace glrender::shader_source\n")
file(WRITE "${OUTPUT}" "${text}")
