#include "lower/hull_pool.hpp"

#include <functional>
#include <string_view>
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

ConvexSolid HullPool::shared(const Generators& generators) {
  Key key = key_of(generators);
  const std::string_view bytes(reinterpret_cast<const char*>(key.data()),
                               key.size() * sizeof(double));
  {
    const std::lock_guard lock(mutex_);
    if (seen_.insert(std::hash<std::string_view>()(bytes)).second) key.clear();
    const auto found = solids_.find(key);
    if (found != solids_.end()) return found->second;
  }
  // Made without the lock: threads that want the same solid at once make it once each.
  ConvexSolid result = convex_solid(generators);
  if (key.empty()) return result;
  const std::lock_guard lock(mutex_);
  return solids_.try_emplace(std::move(key), std::move(result)).first->second;
}

ConvexSolid HullPool::solid(const Generators& generators) {
  if (generators.empty()) return {};
  const Vec3 origin = generators.front().center;
  Generators moved = generators;
  map_all({csgcore::Mat3(1.0), -origin}, moved);
  ConvexSolid result = moved.size() > kMostShared ? convex_solid(moved) : shared(moved);
  for (csgcore::Primitive& piece : result.pieces) piece.local_to_world.translation += origin;
  return result;
}

}  // namespace frontend
