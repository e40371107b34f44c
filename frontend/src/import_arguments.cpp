#include "import_arguments.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace frontend {
namespace {

using csgcore::Vec3;

/// In place of an index that no point can have.
constexpr uint32_t kNoPoint = std::numeric_limits<uint32_t>::max();

std::string_view name_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::kUndef:
      return "undef";
    case ValueKind::kBool:
      return "a boolean";
    case ValueKind::kNumber:
      return "a number";
    case ValueKind::kString:
      return "a string";
    case ValueKind::kList:
      return "a list";
  }
  return "";
}

[[noreturn]] void throw_wrong(const SyntaxTree& tree, const SyntaxNode& node,
                              std::string_view argument, std::string_view found,
                              std::string_view wanted) {
  throw Error(
      tree.file_name, node.location,
      std::string(name_of(node.kind)) + ": " + std::string(argument) + " is " + std::string(found),
      "it must be " + std::string(wanted));
}

[[noreturn]] void throw_wrong_type(const SyntaxTree& tree, const SyntaxNode& node,
                                   std::string_view argument, const Value& found,
                                   std::string_view wanted) {
  throw_wrong(tree, node, argument, name_of(found.kind), wanted);
}

bool read_center(const SyntaxTree& tree, const SyntaxNode& node, const Value& value) {
  if (value.kind != ValueKind::kBool) {
    throw_wrong_type(tree, node, "center", value, "true or false");
  }
  return value.boolean;
}

/// What a round primitive's arguments may be called.
enum RoundArgument : uint8_t { kR, kR1, kR2, kD, kD1, kD2, kH, kFn, kFa, kFs, kCount, kCenter };

struct RoundName {
  std::string_view name;
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

RoundArgument argument_of(std::string_view name) {
  for (const RoundName& known : kRoundNames) {
    if (known.name == name) return known.argument;
  }
  return kCount;
}

RoundArguments read_round_arguments(const SyntaxTree& tree, const SyntaxNode& node,
                                    std::span<const RoundArgument> positions) {
  RoundArguments result;
  size_t position = 0;
  for (const Argument& argument : tree.arguments_of(node)) {
    RoundArgument which = kCount;
    if (!argument.name.empty()) {
      which = argument_of(argument.name);
    } else if (position < positions.size()) {
      which = positions[position++];
    }
    const Value& value = argument.value;
    if (which == kCount || value.kind == ValueKind::kUndef) continue;
    if (which == kCenter) {
      result.center = read_center(tree, node, value);
      continue;
    }
    if (value.kind != ValueKind::kNumber) {
      const auto known = std::find_if(kRoundNames.begin(), kRoundNames.end(),
                                      [&](const RoundName& n) { return n.argument == which; });
      throw_wrong_type(tree, node, known->name, value, "a number");
    }
    result.numbers[which] = value.number;
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

/// The argument of that name, or else the one at that place among those without a name.
const Value* find_argument(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name,
                           size_t position) {
  const Value* positional = nullptr;
  size_t seen = 0;
  for (const Argument& argument : tree.arguments_of(node)) {
    if (argument.name == name) return &argument.value;
    if (argument.name.empty() && seen++ == position) positional = &argument.value;
  }
  return positional;
}

/// The elements of the list of that name or place; none where it is missing.
std::span<const Value> list_argument(const SyntaxTree& tree, const SyntaxNode& node,
                                     std::string_view name, size_t position) {
  const Value* list = find_argument(tree, node, name, position);
  if (list == nullptr || list->kind == ValueKind::kUndef) return {};
  if (list->kind != ValueKind::kList) throw_wrong_type(tree, node, name, *list, "a list");
  return tree.elements_of(*list);
}

/// A list of up to three numbers, at least `fewest`; the rest are 0.
Vec3 read_vector(const SyntaxTree& tree, const SyntaxNode& node, const Value& list,
                 std::string_view name, std::string_view wanted, size_t fewest) {
  if (list.kind != ValueKind::kList) throw_wrong_type(tree, node, name, list, wanted);
  const std::span<const Value> numbers = tree.elements_of(list);
  if (numbers.size() < fewest || numbers.size() > 3) {
    throw_wrong(tree, node, name, "a list of " + std::to_string(numbers.size()), wanted);
  }
  Vec3 result(0.0);
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i].kind != ValueKind::kNumber) {
      throw_wrong(tree, node, name, "a list with " + std::string(name_of(numbers[i].kind)), wanted);
    }
    result[static_cast<int>(i)] = numbers[i].number;
  }
  return result;
}

/// −1 or any other negative channel marks an invalid colour; nan compares false, so it is one too.
std::optional<csgcore::Color> checked_color(const std::array<double, 4>& channels) {
  std::array<float, 4> result;
  for (size_t i = 0; i < 4; ++i) {
    if (!(channels[i] >= 0)) return std::nullopt;
    result[i] = static_cast<float>(std::min(channels[i], 1.0));
  }
  return csgcore::Color{result[0], result[1], result[2], result[3]};
}

}  // namespace

RoundPrimitive read_round_primitive(const SyntaxTree& tree, const SyntaxNode& node) {
  const bool is_sphere = node.kind == NodeKind::kSphere;
  const std::span<const RoundArgument> positions =
      is_sphere ? std::span<const RoundArgument>(kSpherePositions)
                : std::span<const RoundArgument>(kCylinderPositions);
  const RoundArguments arguments = read_round_arguments(tree, node, positions);
  RoundPrimitive result;
  result.primitive =
      is_sphere ? csgcore::make_sphere(arguments.radius(kD, kR, 1)) : cylinder_of(arguments);
  const csgcore::FacetSettings defaults;
  result.facets = {arguments.get(kFn, defaults.fn), arguments.get(kFa, defaults.fa),
                   arguments.get(kFs, defaults.fs)};
  return result;
}

csgcore::Box read_cube(const SyntaxTree& tree, const SyntaxNode& node) {
  Vec3 size(1.0);
  const Value* given = find_argument(tree, node, "size", 0);
  if (given != nullptr && given->kind == ValueKind::kNumber) {
    size = Vec3(given->number);
  } else if (given != nullptr && given->kind != ValueKind::kUndef) {
    size = read_vector(tree, node, *given, "size", "a number or a list of three numbers", 3);
  }
  bool is_centered = false;
  const Value* center = find_argument(tree, node, "center", 1);
  if (center != nullptr && center->kind != ValueKind::kUndef) {
    is_centered = read_center(tree, node, *center);
  }
  const Vec3 min = is_centered ? -size / 2.0 : Vec3(0.0);
  return {min, is_centered ? size / 2.0 : size};
}

PolyhedronArguments read_polyhedron(const SyntaxTree& tree, const SyntaxNode& node) {
  PolyhedronArguments result;
  for (const Value& point : list_argument(tree, node, "points", 0)) {
    result.points.push_back(
        read_vector(tree, node, point, "a point", "a list of three numbers", 2));
  }
  std::span<const Value> faces = list_argument(tree, node, "faces", 1);
  if (faces.empty()) faces = list_argument(tree, node, "triangles", 1);
  for (const Value& face : faces) {
    constexpr std::string_view kWanted = "a list of indices of points";
    if (face.kind != ValueKind::kList) throw_wrong_type(tree, node, "a face", face, kWanted);
    std::vector<uint32_t>& indices = result.faces.emplace_back();
    for (const Value& index : tree.elements_of(face)) {
      if (index.kind != ValueKind::kNumber) {
        throw_wrong_type(tree, node, "an index of a face", index, "a number");
      }
      const bool is_index = index.number > -1 && index.number < kNoPoint;
      indices.push_back(is_index ? static_cast<uint32_t>(index.number) : kNoPoint);
    }
  }
  return result;
}

FileMatrix read_matrix(const SyntaxTree& tree, const SyntaxNode& node) {
  FileMatrix result;
  const Value* matrix = find_argument(tree, node, "m", 0);
  if (matrix == nullptr || matrix->kind == ValueKind::kUndef) return result;
  if (matrix->kind != ValueKind::kList) {
    throw_wrong_type(tree, node, "the matrix", *matrix, "a list of four rows");
  }
  const std::span<const Value> rows = tree.elements_of(*matrix);
  for (size_t row = 0; row < std::min<size_t>(rows.size(), 4); ++row) {
    if (rows[row].kind == ValueKind::kUndef) continue;
    if (rows[row].kind != ValueKind::kList) {
      throw_wrong_type(tree, node, "a row of the matrix", rows[row], "a list of four numbers");
    }
    const std::span<const Value> entries = tree.elements_of(rows[row]);
    for (size_t column = 0; column < std::min<size_t>(entries.size(), 4); ++column) {
      const Value& entry = entries[column];
      if (entry.kind == ValueKind::kUndef) continue;
      if (entry.kind != ValueKind::kNumber) {
        throw_wrong_type(tree, node, "an entry of the matrix", entry, "a number");
      }
      const int r = static_cast<int>(row);
      const int c = static_cast<int>(column);
      if (row == 3) {
        if (column == 3) result.divisor = entry.number;  // other projective terms are ignored
      } else if (column == 3) {
        result.map.translation[r] = entry.number;
      } else {
        result.map.linear[c][r] = entry.number;
      }
    }
  }
  return result;
}

std::optional<csgcore::Color> read_color(const SyntaxTree& tree, const SyntaxNode& node,
                                         std::vector<Warning>& warnings) {
  const Value* color = find_argument(tree, node, "c", 0);
  if (color == nullptr || color->kind == ValueKind::kUndef) return std::nullopt;
  std::array<double, 4> channels{1, 1, 1, 1};  // OpenSCAD's for those that are missing
  if (color->kind == ValueKind::kList) {
    const std::span<const Value> elements = tree.elements_of(*color);
    for (size_t i = 0; i < std::min<size_t>(elements.size(), 4); ++i) {
      if (elements[i].kind == ValueKind::kUndef) {
        channels[i] = 0;  // as OpenSCAD reads it
        continue;
      }
      if (elements[i].kind != ValueKind::kNumber) {
        throw_wrong_type(tree, node, "a channel", elements[i], "a number from 0 to 1");
      }
      channels[i] = elements[i].number;
    }
  } else if (color->kind == ValueKind::kString) {
    const std::optional<csgcore::Color> named = color_of_name(tree.text_of(*color));
    if (!named) {
      warnings.push_back(make_warning(
          tree.file_name, node.location,
          "color: \"" + std::string(tree.text_of(*color)) + "\" is no colour, and is ignored",
          "use a CSS colour name, \"#rrggbb\" or [r, g, b]"));
      return std::nullopt;
    }
    channels = {named->r, named->g, named->b, named->a};
  } else {
    throw_wrong_type(tree, node, "the colour", *color, "a list of numbers or a name");
  }
  const Value* alpha = find_argument(tree, node, "alpha", 1);
  if (alpha != nullptr && alpha->kind != ValueKind::kUndef) {
    if (alpha->kind != ValueKind::kNumber) {
      throw_wrong_type(tree, node, "alpha", *alpha, "a number from 0 to 1");
    }
    channels[3] = alpha->number;
  }
  return checked_color(channels);
}

}  // namespace frontend
