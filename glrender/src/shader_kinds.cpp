#include "shader_kinds.hpp"

#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "shader_sources.hpp"

namespace glrender {
namespace {

using csgcore::Shape;

struct Kind {
  Shape shape;
  std::string_view name;
  std::string_view source;
};

// A kind without an embedded shader is a compile error here.
#define GLRENDER_KIND(Name) Kind{Shape::k##Name, #Name, shader_source::k##Name},
constexpr std::array kKinds = {CSGCORE_FOR_EACH_SHAPE(GLRENDER_KIND)};
#undef GLRENDER_KIND
static_assert(kKinds.size() <= 32, "a KindSet has 32 bits");

/// Returns the prefix of the kind's functions in GLSL: "rounded_box" for "RoundedBox".
std::string glsl_name(const Kind& kind) {
  std::string result;
  for (const char c : kind.name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isupper(letter) && !result.empty()) result += '_';
    result += static_cast<char>(std::tolower(letter));
  }
  return result;
}

std::vector<Kind> listed(KindSet kinds) {
  std::vector<Kind> result;
  for (const Kind& kind : kKinds) {
    if (kinds.has(kind.shape)) result.push_back(kind);
  }
  return result;
}

std::string is_of(const Kind& kind) {
  return "ray.enclosure == " + std::to_string(static_cast<int>(kind.shape)) + ".0";
}

/// Writes code that returns what the function of the ray's enclosure returns. The last kind needs
/// no comparison, since it is the only one left.
std::string call_by_enclosure(const std::vector<Kind>& enclosures, std::string_view function,
                              std::string_view arguments, std::string_view without_kinds) {
  if (enclosures.empty()) return "  return " + std::string(without_kinds) + ";\n";
  std::string result;
  for (const Kind& kind : enclosures) {
    result += "  ";
    if (&kind != &enclosures.back()) {
      result += "if (" + is_of(kind) + ") ";
    }
    result.append("return ").append(glsl_name(kind)).append(function).append(arguments) += ";\n";
  }
  return result;
}

std::string call_each_cut(const std::vector<Kind>& cuts, std::string_view result_name,
                          std::string_view function, std::string_view arguments) {
  std::string result;
  for (const Kind& kind : cuts) {
    result.append("  ").append(result_name).append(" = ");
    result.append(glsl_name(kind)).append(function).append(arguments) += ";\n";
  }
  return result.append("  return ").append(result_name) += ";\n";
}

/// Writes the functions of primitives that are not convex, whose `enclosure` is their own kind.
std::string nonconvex_source(const std::vector<Kind>& kinds) {
  if (kinds.empty()) return {};
  std::string source, is_any;
  for (const Kind& kind : kinds) {
    source += kind.source;
    is_any += (is_any.empty() ? "" : " || ") + is_of(kind);
  }
  source += "bool is_nonconvex(CanonicalRay ray) { return " + is_any + "; }\n";
  source += "Stretch nonconvex_stretch(Ray world, CanonicalRay ray, float t) {\n" +
            call_by_enclosure(kinds, "_stretch", "(world, ray, t)", "") + "}\n";
  source += "vec3 nonconvex_gradient(CanonicalRay ray, int face) {\n" +
            call_by_enclosure(kinds, "_gradient", "(ray, face)", "") + "}\n";
  return source;
}

}  // namespace

std::string kinds_source(KindSet enclosures, KindSet cuts, KindSet nonconvex) {
  const std::vector<Kind> enclosing = listed(enclosures);
  const std::vector<Kind> cutting = listed(cuts);
  std::string source = nonconvex_source(listed(nonconvex));
  for (const Kind& kind : enclosing) source += kind.source;
  for (const Kind& kind : cutting) source += kind.source;
  source += "Segment enclosure_segment(CanonicalRay ray) {\n" +
            call_by_enclosure(enclosing, "_segment", "(ray)", "NO_SEGMENT") + "}\n";
  source += "vec3 enclosure_gradient(CanonicalRay ray, vec3 point) {\n" +
            call_by_enclosure(enclosing, "_gradient", "(ray, point)", "point") + "}\n";
  if (cutting.empty()) return source;
  source += "Segment cut_segment(CanonicalRay ray, Segment segment) {\n" +
            call_each_cut(cutting, "segment", "_cut", "(ray, segment)") + "}\n";
  source += "vec3 cut_gradient(CanonicalRay ray, vec3 point, int face, vec3 gradient) {\n" +
            call_each_cut(cutting, "gradient", "_cut_gradient", "(ray, point, face, gradient)") +
            "}\n";
  return source;
}

}  // namespace glrender
