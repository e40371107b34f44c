#include "arguments/round_node.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace frontend {
namespace {

/// What a round primitive's arguments may be called.
enum RoundArgument : uint8_t {
  kR,
  kR1,
  kR2,
  kD,
  kD1,
  kD2,
  kH,
  kFn,
  kFa,
  kFs,
  kFe,
  kCount,
  kCenter
};

struct RoundName {
  language::ArgumentName name;
  RoundArgument argument;
};
// In the order in which OpenSCAD writes them: the search ends soonest.
constexpr std::array<RoundName, 12> kRoundNames{{{"$fn", kFn},
                                                 {"$fa", kFa},
                                                 {"$fs", kFs},
                                                 {"$fe", kFe},
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

RoundArguments read_arguments(NodeReader& reader, std::span<const RoundArgument> positions) {
  RoundArguments result;
  size_t position = 0;
  for (const language::NodeArgument& argument : reader.arguments()) {
    RoundArgument which = kCount;
    if (!argument.name.is_positional()) {
      which = argument_of(argument.name);
    } else if (position < positions.size()) {
      which = positions[position++];
    }
    const ArgumentValue value(reader.tree(), argument);
    if (which == kCount || value.is_undef()) continue;
    if (which == kCenter) {
      result.center = reader.center(value);
      continue;
    }
    if (!value.is_number()) {
      const auto known = std::find_if(kRoundNames.begin(), kRoundNames.end(),
                                      [&](const RoundName& n) { return n.argument == which; });
      reader.tell_wrong_type(known->name.text(), value, "a number");
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

csgcore::FacetSettings facets_of(const RoundArguments& arguments) {
  const csgcore::FacetSettings defaults;
  return {arguments.get(kFn, defaults.fn), arguments.get(kFa, defaults.fa),
          arguments.get(kFs, defaults.fs),
          std::max(arguments.get(kFe, defaults.tolerance), defaults.tolerance)};
}

}  // namespace

RoundNode read_sphere(NodeReader& reader) {
  const RoundArguments arguments = read_arguments(reader, kSpherePositions);
  return {csgcore::make_sphere(arguments.radius(kD, kR, 1)), facets_of(arguments)};
}

RoundNode read_cylinder(NodeReader& reader) {
  const RoundArguments arguments = read_arguments(reader, kCylinderPositions);
  return {cylinder_of(arguments), facets_of(arguments)};
}

}  // namespace frontend
