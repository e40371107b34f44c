#include "lower/import_arguments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "lower/argument_lookup.hpp"
#include "lower/import_colors.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

/// What a round primitive's arguments may be called.
enum RoundArgument : uint8_t { kR, kR1, kR2, kD, kD1, kD2, kH, kFn, kFa, kFs, kCount, kCenter };

struct RoundName {
  language::ArgumentName name;
  RoundArgument argument;
};
// In the order in which OpenSCAD writes them: the search ends soonest.
constexpr std::array<RoundName, 11> kRoundNames{{{"$fn", kFn},
                                                 {"$fa", kFa},
                                                 {"$fs", kFs},
                                                 {"h", kH},
                                                 {"r1", kR1},
                                                 {"r2", kR2},
                                                 {"center", kCenter},
                                                 {"r", kR},
                                                 {"d", kD},
                                                 {"d1", kD1},
                                                 {"d2", kD2}}};
constexpr std::array<RoundArgument, 1> kSpherePositions{kR};
constexpr std::array<RoundArgument, 4> kCylinderPositions{kH, kR1, kR2, kCenter};

struct RoundArguments {
  std::array<double, kCount> numbers;
  uint32_t given = 0;  // bit per RoundArgument
  bool center = false;

  bool has(RoundArgument argument) const { return (given >> argument & 1u) != 0; }
  double get(RoundArgument argument, double otherwise) const {
    return has(argument) ? numbers[argument] : otherwise;
  }
  double radius(RoundArgument diameter, RoundArgument radius, double otherwise) const {
    return has(diameter) ? numbers[diameter] / 2 : get(radius, otherwise);
  }
};

RoundArgument argument_of(language::ArgumentName name) {
  for (const RoundName& known : kRoundNames) {
    if (known.name == name) return known.argument;
  }
  return kCount;
}

RoundArguments read_round_arguments(const NodeTree& tree, const Node& node,
                                    std::span<const RoundArgument> positions,
                                    NodeProblems& problems) {
  RoundArguments result;
  size_t position = 0;
  for (const language::NodeArgument& argument : tree.arguments_of(node)) {
    RoundArgument which = kCount;
    if (!argument.name.is_positional()) {
      which = argument_of(argument.name);
    } else if (position < positions.size()) {
      which = positions[position++];
    }
    const ArgumentValue value(tree, argument);
    if (which == kCount || value.is_undef()) continue;
    if (which == kCenter) {
      result.center = read_center(node, value, problems);
      continue;
    }
    if (!value.is_number()) {
      const auto known = std::find_if(kRoundNames.begin(), kRoundNames.end(),
                                      [&](const RoundName& n) { return n.argument == which; });
      note_wrong_type(problems, node, known->name.text(), value, "a number");
      continue;
    }
    result.numbers[which] = value.number();
    result.given |= 1u << which;
  }
  return result;
}

csgcore::Primitive cylinder_of(const RoundArguments& arguments) {
  const double h = arguments.get(kH, 1);
  const double r = arguments.radius(kD, kR, 1);
  const double r1 = arguments.radius(kD1, kR1, r);
  const double r2 = arguments.radius(kD2, kR2, r);
  const double z_min = arguments.center ? -h / 2 : 0;
  const double z_max = arguments.center ? h / 2 : h;
  return csgcore::make_frustum(z_min, z_max, r1, r2);
}

/// A list of `fewest` to three numbers; those that are not there are 0.
std::optional<Vec3> vector_of(const ArgumentValue& list, size_t fewest) {
  if (!list.is_list()) return std::nullopt;
  const ValueList numbers = list.elements();
  if (numbers.size() < fewest || numbers.size() > 3) return std::nullopt;
  Vec3 result(0.0);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (!numbers[i].is_number()) return std::nullopt;
    result[static_cast<int>(i)] = numbers[i].number();
  }
  return result;
}

/// A value as OpenSCAD writes it, but for what is long: strings, long lists and lists in lists.
std::string text_of(const ArgumentValue& value, bool is_inner = false) {
  constexpr size_t kMostElements = 8, kLongestString = 40;
  if (value.is_string()) {
    return '"' + std::string(value.text().substr(0, kLongestString)) + '"';
  }
  if (!value.is_list()) return scalar_text(value);
  const ValueList elements = value.elements();
  if (is_inner && !elements.empty()) return "[...]";
  std::string text = "[";
  for (size_t i = 0; i < std::min(elements.size(), kMostElements); ++i) {
    text += (i > 0 ? ", " : "") + text_of(elements[i], true);
  }
  return text + (elements.size() > kMostElements ? ", ...]" : "]");
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// −1 or any other negative channel marks an invalid colour; nan compares false, so it is one too.
/// A channel far beyond what any light shows as white.
constexpr double kBrightestChannel = 1000;

/// Channels that are negative, or no numbers, are the scheme's; none of them is the colour's: no
/// colour.
std::optional<csgcore::Color> color_of_channels(const std::array<double, 4>& channels) {
  std::array<float, 4> result;
  bool has_own = false;
  for (size_t i = 0; i < 3; ++i) {
    const bool is_own = channels[i] >= 0;
    result[i] = is_own ? static_cast<float>(std::min(channels[i], kBrightestChannel)) : -1.0f;
    has_own = has_own || is_own;
  }
  const bool has_alpha = channels[3] >= 0 && channels[3] < 1;
  result[3] = has_alpha ? static_cast<float>(channels[3]) : 1.0f;
  if (!has_own && !has_alpha) return std::nullopt;
  return csgcore::Color{result[0], result[1], result[2], result[3]};
}

}  // namespace

RoundPrimitive read_round_primitive(const NodeTree& tree, const Node& node,
                                    NodeProblems& problems) {
  const bool is_sphere = node.kind != NodeKind::kCylinder;
  const std::span<const RoundArgument> positions =
      is_sphere ? std::span<const RoundArgument>(kSpherePositions)
                : std::span<const RoundArgument>(kCylinderPositions);
  const RoundArguments arguments = read_round_arguments(tree, node, positions, problems);
  RoundPrimitive result;
  result.primitive =
      is_sphere ? csgcore::make_sphere(arguments.radius(kD, kR, 1)) : cylinder_of(arguments);
  const csgcore::FacetSettings defaults;
  result.facets = {arguments.get(kFn, defaults.fn), arguments.get(kFa, defaults.fa),
                   arguments.get(kFs, defaults.fs)};
  return result;
}

csgcore::Box read_cube(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  Vec3 size(1.0);
  const ArgumentValue given = find_argument(tree, node, "size", 0);
  if (given.is_number()) {
    size = Vec3(given.number());
  } else if (!given.is_undef()) {
    if (const std::optional<Vec3> vector = vector_of(given, 3)) {
      size = *vector;
    } else {
      note_wrong(problems, node, "size", text_of(given), kMissing,
                 "a number or a list of three numbers");
    }
  }
  const ArgumentValue center = find_argument(tree, node, "center", 1);
  const bool is_centered = read_center(node, center, problems);
  const Vec3 min = is_centered ? -size / 2.0 : Vec3(0.0);
  return {min, is_centered ? size / 2.0 : size};
}

namespace {

/// The points of the values, nan where a value is none.
std::vector<Vec3> points_of(const ValueList& values) {
  std::vector<Vec3> points;
  points.reserve(values.size());
  for (const ArgumentValue value : values) {
    points.push_back(vector_of(value, 2).value_or(Vec3(std::numeric_limits<double>::quiet_NaN())));
  }
  return points;
}

/// Reads the faces of a polyhedron one by one.
class FaceReader {
 public:
  FaceReader(const Node& node, const ValueList& points, NodeProblems& problems)
      : node_(node), points_(points), problems_(problems) {
    faces_.points = points_of(points);
  }

  FaceSet read(const ValueList& faces) {
    faces_.ends.reserve(faces.size());
    faces_.corners.reserve(3 * faces.size());
    for (size_t i = 0; i < faces.size(); ++i) {
      if (!faces[i].is_list()) {
        note_wrong(problems_, node_, "a face", std::string(name_of(faces[i].kind())), "is left out",
                   "a list of indices of points");
        continue;
      }
      const size_t begin = faces_.corners.size();
      const bool goes_on = read_face(faces[i].elements(), i);
      // The first corner stays the first: one that crosses itself is cut into triangles there.
      if (begin < faces_.corners.size()) {
        std::reverse(faces_.corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                     faces_.corners.end());
      }
      faces_.end_face();
      if (!goes_on) break;
    }
    beyond_points_.tell(node_, problems_);
    return std::move(faces_);
  }

 private:
  /// Returns false if a point is none.
  bool read_face(const ValueList& corners, size_t face) {
    for (size_t i = 0; i < corners.size(); ++i) {
      const std::optional<uint32_t> index = read_index(corners[i], face, i);
      if (!index) continue;
      if (!is_finite(faces_.points[*index])) {
        note_bad_point(*index);
        return false;
      }
      faces_.corners.push_back(*index);
    }
    return true;
  }

  /// Returns the point that a value names; none where it is beyond the points.
  std::optional<uint32_t> read_index(const ArgumentValue& value, size_t face, size_t place) {
    if (!value.is_number()) {
      note_wrong(problems_, node_, "an index of a face", std::string(name_of(value.kind())),
                 "counts as 0", "a number");
    }
    const double number = value.is_number() ? value.number() : 0;
    if (number > -1 && number < static_cast<double>(points_.size())) {
      return static_cast<uint32_t>(number);
    }
    beyond_points_.add([&] {
      return NodeProblems::Description{
          ": Point index " + text_of(value) + " is out of bounds (from faces[" +
              std::to_string(face) + "][" + std::to_string(place) + "]), and is left out",
          points_.empty() ? "there are no points"
                          : "the points are 0 to " + std::to_string(points_.size() - 1)};
    });
    return std::nullopt;
  }

  void note_bad_point(uint32_t index) {
    problems_.add(node_, {": Unable to convert points[" + std::to_string(index) +
                              "] = " + text_of(points_[index]) +
                              " to a vec3 of numbers, and the faces from there on are "
                              "left out",
                          "it must be a list of three finite numbers"});
  }

  const Node& node_;
  const ValueList points_;
  NodeProblems& problems_;
  ElementProblem beyond_points_;
  FaceSet faces_;
};

}  // namespace

FaceSet read_polyhedron(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  const ValueList points = list_argument(tree, node, "points", 0, problems);
  ValueList faces = list_argument(tree, node, "faces", 1, problems);
  if (faces.empty()) faces = list_argument(tree, node, "triangles", kByNameOnly, problems);
  return FaceReader(node, points, problems).read(faces);
}

FileArguments read_file_arguments(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  FileArguments result;
  const ArgumentValue file = find_argument(tree, node, "file", 0);
  if (file.is_string()) {
    result.file = file.text();
  } else {
    note_wrong_type(problems, node, "file", file, "a name");
  }
  if (node.kind != NodeKind::kSurface) return result;
  const ArgumentValue center = find_argument(tree, node, "center", 1);
  result.is_centered = read_center(node, center, problems);
  result.is_inverted = find_argument(tree, node, "invert", 2).is_true();
  return result;
}

FileMatrix read_matrix(const NodeTree& tree, const Node& node, NodeProblems& problems) {
  FileMatrix result;
  result.has_all_digits = tree.has_all_digits;
  const ArgumentValue matrix = find_argument(tree, node, "m", 0);
  if (!matrix.is_list()) {
    note_wrong_type(problems, node, "the matrix", matrix, "a list of four rows");
    return result;
  }
  const ValueList rows = matrix.elements();
  for (size_t row = 0; row < std::min<size_t>(rows.size(), 4); ++row) {
    if (!rows[row].is_list()) {
      note_wrong_type(problems, node, "a row of the matrix", rows[row], "a list of four numbers");
      continue;
    }
    const ValueList entries = rows[row].elements();
    for (size_t column = 0; column < std::min<size_t>(entries.size(), 4); ++column) {
      const ArgumentValue entry = entries[column];
      if (!entry.is_number()) {
        note_wrong_type(problems, node, "an entry of the matrix", entry, "a number");
        continue;
      }
      const int r = static_cast<int>(row);
      const int c = static_cast<int>(column);
      if (row == 3) {
        if (column == 3) result.divisor = entry.number();  // other projective terms are ignored
      } else if (column == 3) {
        result.map.translation[r] = entry.number();
      } else {
        result.map.linear[c][r] = entry.number();
      }
    }
  }
  return result;
}

std::optional<csgcore::Color> read_color(const NodeTree& tree, const Node& node,
                                         NodeProblems& problems) {
  const ArgumentValue color = find_argument(tree, node, "c", 0);
  if (color.is_undef()) return std::nullopt;
  std::array<double, 4> channels{1, 1, 1, 1};  // OpenSCAD's for those that are missing
  if (color.is_list()) {
    const ValueList elements = color.elements();
    for (size_t i = 0; i < std::min<size_t>(elements.size(), 4); ++i) {
      if (elements[i].is_number()) {
        channels[i] = elements[i].number();
        continue;
      }
      channels[i] = 0;  // as OpenSCAD reads it
      if (elements[i].is_undef()) continue;
      note_wrong(problems, node, "a channel", std::string(name_of(elements[i].kind())),
                 "counts as 0", "a number from 0 to 1");
    }
  } else if (color.is_string()) {
    const std::optional<csgcore::Color> named = color_of_name(color.text());
    if (!named) {
      problems.add(node, {": \"" + std::string(color.text()) + "\" is no colour, and is ignored",
                          "use a CSS colour name, \"#rrggbb\" or [r, g, b]"});
      return std::nullopt;
    }
    channels = {named->r, named->g, named->b, named->a};
  } else {
    note_wrong_type(problems, node, "the colour", color, "a list of numbers or a name");
    return std::nullopt;
  }
  const ArgumentValue alpha = find_argument(tree, node, "alpha", 1);
  if (alpha.is_number()) {
    channels[3] = alpha.number();
  } else {
    note_wrong_type(problems, node, "alpha", alpha, "a number from 0 to 1");
  }
  return color_of_channels(channels);
}

}  // namespace frontend
