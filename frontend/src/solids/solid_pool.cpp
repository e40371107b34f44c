#include "solids/solid_pool.hpp"

#include <functional>
#include <string_view>
#include <utility>

#include "base/hashes.hpp"

namespace frontend {
namespace {

using csgcore::Affine;
using csgcore::Vec3;

/// Larger sets are not kept: their keys take more than they save within a design, or some MB each
/// from version to version.
constexpr size_t kMostShared = 1 << 10, kMostKept = 1 << 16;
/// So many solids are kept before it is known that they are repeated: some 100 MB.
constexpr size_t kMostUnrepeated = 1 << 16;
/// So many triangles of boundaries are kept: some 100 MB.
constexpr size_t kMostKeptTriangles = 1 << 22;

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

template <typename T>
void add_bytes(std::span<const T> items, Hashes& hashes) {
  hashes.add(std::string_view(reinterpret_cast<const char*>(items.data()), items.size_bytes()));
}

Hashes hashes_of(std::span<const csgcore::TriangleSet> operands, const csgcore::CsgTree& tree) {
  Hashes hashes;
  for (const csgcore::TriangleSet& operand : operands) {
    add_bytes(std::span(operand.vertices), hashes);
    add_bytes(std::span(operand.triangles), hashes);
    hashes.add(operand.is_simple ? 1 : 0);
  }
  for (const csgcore::CsgToken& token : tree.tokens()) {
    const auto kind = token.is_primitive ? 0 : 1 + static_cast<uint64_t>(token.op);
    hashes.add(kind << 32 | token.value);
  }
  return hashes;
}

}  // namespace

ConvexSolid SolidPool::shared(const Generators& generators) {
  Key key = key_of(generators);
  const std::string_view bytes(reinterpret_cast<const char*>(key.data()),
                               key.size() * sizeof(double));
  {
    const std::lock_guard lock(mutex_);
    const auto found = solids_.find(key);
    if (found != solids_.end()) {
      found->second.is_used = true;
      return found->second.solid;
    }
    const bool is_kept = keeps_ == Keeps::kAll || solids_.size() < kMostUnrepeated ||
                         !seen_.insert(std::hash<std::string_view>()(bytes)).second;
    if (!is_kept) key.clear();
  }
  // Made without the lock: threads that want the same solid at once make it once each.
  ConvexSolid result = made_of(generators);
  if (key.empty()) return result;
  const std::lock_guard lock(mutex_);
  return solids_.try_emplace(std::move(key), Kept{std::move(result)}).first->second.solid;
}

ConvexSolid SolidPool::made_of(const Generators& generators) {
  ++made_;
  return convex_solid(generators);
}

csgcore::BoundaryMesh SolidPool::boundary(std::span<const csgcore::TriangleSet> operands,
                                          const csgcore::CsgTree& tree) {
  const Hashes hashes = hashes_of(operands, tree);
  const Content content(hashes.first(), hashes.second());
  {
    const std::lock_guard lock(mutex_);
    const auto found = boundaries_.find(content);
    if (found != boundaries_.end()) {
      found->second.is_used = true;
      return found->second.mesh;
    }
  }
  ++boundaries_made_;
  csgcore::BoundaryMesh mesh = csgcore::boundary_mesh(operands, tree);
  const std::lock_guard lock(mutex_);
  if (kept_triangles_ + mesh.triangles.size() <= kMostKeptTriangles &&
      boundaries_.try_emplace(content, KeptBoundary{mesh}).second) {
    kept_triangles_ += mesh.triangles.size();
  }
  return mesh;
}

void SolidPool::end_version() {
  const std::lock_guard lock(mutex_);
  std::erase_if(solids_, [](const auto& entry) { return !entry.second.is_used; });
  for (auto& [key, kept] : solids_) kept.is_used = false;
  std::erase_if(boundaries_, [](const auto& entry) { return !entry.second.is_used; });
  kept_triangles_ = 0;
  for (auto& [content, kept] : boundaries_) {
    kept.is_used = false;
    kept_triangles_ += kept.mesh.triangles.size();
  }
}

ConvexSolid SolidPool::solid(const Generators& generators) {
  if (generators.empty()) return {};
  const Vec3 origin = generators.front().center;
  Generators moved = generators;
  map_all({csgcore::Mat3(1.0), -origin}, moved);
  const size_t most = keeps_ == Keeps::kAll ? kMostKept : kMostShared;
  ConvexSolid result = moved.size() > most ? made_of(moved) : shared(moved);
  for (csgcore::Primitive& piece : result.pieces) piece.local_to_world.translation += origin;
  return result;
}

}  // namespace frontend
