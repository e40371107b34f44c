#include "lower/hull_pool.hpp"

#include <utility>

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Vec3;

/// Larger sets are not kept: their keys take more than they save.
constexpr size_t kMostShared = 1024;

void add_numbers(const Vec3& v, std::vector<double>& key) {
  for (int axis = 0; axis < 3; ++axis) key.push_back(v[axis]);
}

std::vector<double> key_of(const Generators& generators) {
  std::vector<double> key;
  constexpr size_t kNumbers = 18;
  key.reserve(kNumbers * generators.size());
  for (const Generator& generator : generators) {
    add_numbers(generator.center, key);
    add_numbers(generator.disc_a, key);
    add_numbers(generator.disc_b, key);
    for (int column = 0; column < 3; ++column) add_numbers(generator.ball[column], key);
  }
  return key;
}

}  // namespace

ConvexSolid HullPool::solid(const Generators& generators) {
  if (generators.empty()) return {};
  const Vec3 origin = generators.front().center;
  Generators moved = generators;
  map_all({csgcore::Mat3(1.0), -origin}, moved);
  ConvexSolid result;
  if (moved.size() > kMostShared) {
    result = convex_solid(moved);
  } else {
    const auto [entry, is_new] = solids_.try_emplace(key_of(moved));
    if (is_new) entry->second = convex_solid(moved);
    result = entry->second;
  }
  for (csgcore::Primitive& piece : result.pieces) piece.local_to_world.translation += origin;
  return result;
}

}  // namespace frontend
