#include <string>

#include "arguments/value_text.hpp"
#include "subtrees/node_row.hpp"

namespace frontend {
namespace {

using csgcore::Vec3;

constexpr language::ArgumentName kCubeLabel[] = {"size"};

/// The cube's box in local coordinates; it may be empty, flat or infinite. `size` is a number or
/// three, 1 where it is missing.
csgcore::Box read_cube(NodeReader& reader) {
  Vec3 size(1.0);
  const ArgumentValue given = reader.find("size", 0);
  if (given.is_number()) {
    size = Vec3(given.number());
  } else if (!given.is_undef()) {
    if (const std::optional<Vec3> vector = vector_of(given, 3)) {
      size = *vector;
    } else {
      reader.tell_wrong("size", short_text(given), kMissing, "a number or a list of three numbers");
    }
  }
  const bool is_centered = reader.center(1);
  const Vec3 min = is_centered ? -size / 2.0 : Vec3(0.0);
  return {min, is_centered ? size / 2.0 : size};
}

}  // namespace

const NodeRow kCubeRow{
    .role = Role::kSolid,
    .dimension = 3,
    .label = kCubeLabel,
    .read = [](NodeReader& reader, const NodeSources&) -> NodeData { return read_cube(reader); },
};

}  // namespace frontend
