// import() and surface().
#include <algorithm>
#include <cmath>

#include "modules/builtin_modules.hpp"
#include "modules/node_values.hpp"

namespace language {
namespace {

/// Returns a parameter's text, or that of its older name where only this is given.
std::string text_of(const BuiltinCall& call, const Value& value, const Value& older,
                    const char* name, const char* older_name) {
  if (is_given(value) || !is_given(older)) return str_or_nothing(value);
  deprecate(call, std::string(older_name) + "= is deprecated. Please use " + name + "=");
  return str_or_nothing(older);
}

/// Returns whether a path ends in .svg, in any case. A file that has no name before it is none.
bool is_svg(std::string_view path) {
  constexpr std::string_view kSuffix = ".svg";
  if (path.size() <= kSuffix.size() || path[path.size() - kSuffix.size() - 1] == '/') return false;
  const std::string_view suffix = path.substr(path.size() - kSuffix.size());
  return std::equal(suffix.begin(), suffix.end(), kSuffix.begin(), [](char c, char wanted) {
    return (c >= 'A' && c <= 'Z' ? c | 0x20 : c) == wanted;
  });
}

/// Returns the path of the call's file, as messages show it.
std::string file_of(const BuiltinCall& call) {
  constexpr std::string_view kBefore = " in file ", kAfter = ", line ";
  const std::string suffix =
      call.environment.messages.place_suffix(call.place, PathBase::kMainFile);
  return suffix.substr(kBefore.size(), suffix.rfind(kAfter) - kBefore.size());
}

/// Reads `dpi`. The message for a wrong one is OpenSCAD's: it names the origin for the default, and
/// the file for the line.
double read_dpi(const BuiltinCall& call, const Value& dpi, const Value& origin) {
  constexpr double kDefault = 72, kLeast = 0.001;
  const double value = number_or(dpi, kDefault);
  if (!(value < kLeast)) return value;
  const std::string file = file_of(call);
  call.environment.messages.say(MessageGroup::kWarning,
                                "Invalid dpi value giving, using default of " + shown(origin) +
                                    " dpi. Value must be positive and >= 0.001, file " + file +
                                    ", import() at line " + file);
  return kDefault;
}

/// The parameters of import().
namespace imported {
enum Parameter : size_t {
  kFile,
  kLayer,
  kConvexity,
  kOrigin,
  kScale,
  kWidth,
  kHeight,
  kFilename,
  kLayername,
  kCenter,
  kDpi,
  kId,  // in 2026
};
}  // namespace imported

Made make_import_node(const BuiltinCall& call, NodeTree& tree, bool knows_svg) {
  using namespace imported;
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kImport);
  const std::string name = text_of(call, given[kFile], given[kFilename], "file", "filename");
  const NamedFile file = call.environment.files.find(name, call.place);
  const std::string layer = text_of(call, given[kLayer], given[kLayername], "layer", "layername");
  double x = 0, y = 0;
  const bool is_origin = read_vec2(given[kOrigin], x, y) && std::isfinite(x) && std::isfinite(y);
  if (is_given(given[kOrigin]) && !is_origin) {
    warn(call, "linear_extrude(..., origin=" + shown(given[kOrigin]) + ") could not be converted");
  }
  const double scale = number_or(given[kScale], 0);
  const double dpi = read_dpi(call, given[kDpi], given[kOrigin]);
  add_escaped(tree, "file", file.path);
  add_escaped(tree, "layer", layer);
  add_numbers(tree, "origin", {x, y});
  if (knows_svg && is_svg(file.path)) {
    add_bool(tree, "center", is_true_bool(given[kCenter]));
    add(tree, "dpi", dpi);
  }
  add(tree, "scale", scale <= 0 ? 1 : scale);
  add_integer(tree, "convexity", std::max(integer_or(call, given[kConvexity], 0), 1));
  add_fragments(tree, fragments_of(call));
  add_integer(tree, "timestamp", file.timestamp);
  return Made::kNode;
}

}  // namespace

Made make_import_2026(const BuiltinCall& call, NodeTree& tree) {
  using namespace imported;
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kImport);
  const std::string name = text_of(call, given[kFile], given[kFilename], "file", "filename");
  const NamedFile file = call.environment.files.find(name, call.place);
  const std::string layer = text_of(call, given[kLayer], given[kLayername], "layer", "layername");
  const std::string id = str_or_nothing(given[kId]);
  double x = 0, y = 0;
  const bool is_origin = read_vec2(given[kOrigin], x, y) && std::isfinite(x) && std::isfinite(y);
  if (is_given(given[kOrigin]) && !is_origin) {
    warn(call,
         "Unable to convert import(..., origin=" + shown(given[kOrigin]) + ") parameter to vec2");
  }
  const double scale = number_or(given[kScale], 0);
  const double dpi = read_dpi(call, given[kDpi], given[kOrigin]);
  add_escaped(tree, "file", file.path);
  if (is_given(given[kId])) add_escaped(tree, "id", id);
  if (is_given(given[kLayer]) || is_given(given[kLayername])) add_escaped(tree, "layer", layer);
  add_numbers(tree, "origin", {x, y});
  if (is_svg(file.path)) add(tree, "dpi", dpi);
  add(tree, "scale", scale <= 0 ? 1 : scale);
  add_bool(tree, "center", is_true_bool(given[kCenter]));
  add_integer(tree, "convexity", std::max(integer_or(call, given[kConvexity], 0), 1));
  add_fragments(tree, fragments_of(call));
  add_integer(tree, "timestamp", file.timestamp);
  return Made::kNode;
}

Made make_import(const BuiltinCall& call, NodeTree& tree) {
  return make_import_node(call, tree, true);
}

Made make_typed_import(const BuiltinCall& call, NodeTree& tree) {
  return make_import_node(call, tree, false);
}

Made make_surface(const BuiltinCall& call, NodeTree& tree) {
  enum : size_t { kMap, kCentered, kConvexity, kInvert };
  const auto& given = call.parameters;
  set_kind(tree, NodeKind::kSurface);
  const NamedFile file = call.environment.files.find(str_or_nothing(given[kMap]), call.place);
  add_escaped(tree, "file", file.path);
  add_bool(tree, "center", is_true_bool(given[kCentered]));
  add_bool(tree, "invert", is_true_bool(given[kInvert]));
  add_integer(tree, "timestamp", file.timestamp);
  return Made::kNode;
}

}  // namespace language
