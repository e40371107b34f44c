// Minkowski sums of the parts of solids.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "solids/solid_pool.hpp"
#include "solids/solid_value.hpp"

namespace frontend {

/// Collects the sums of pairs of parts, whose union is the sum of the unions.
class SolidSums {
 public:
  /// What is round and not convex becomes facets, with that many chords for a whole circle.
  SolidSums(SolidPool& pool, int chords) : pool_(pool), chords_(chords) {}

  /// Adds the sum of each part of the one and each of the other.
  void add(std::vector<SolidPart> a, std::vector<SolidPart> b);
  std::vector<SolidPart> take() { return std::move(sums_); }
  /// Empty: there was none.
  std::string_view failure() const { return failure_; }

 private:
  SolidPart as_mesh(SolidPart part) const;
  csgcore::TriangleSet surface_of(const SolidPart& mesh) const;
  size_t reflex_edges(const std::vector<SolidPart>& parts) const;
  std::vector<SolidPart> in_convex_parts(const std::vector<SolidPart>& parts);
  void add_pair(const SolidPart& a, const SolidPart& b);
  void add_convex(const SupportSet& a, const SupportSet& b, const csgcore::Box& box);
  void add_mesh(const SolidPart& part, const SolidPart& convex, const csgcore::Box& box);
  void add_faces(const SolidPart& mesh, const SupportSet& convex, const csgcore::Box& box);
  void add_rounded(const SolidPart& mesh, const Generator& ball, const csgcore::Box& box);
  void add_extrusion(const SolidPart& part, const SolidPart& convex, const csgcore::Box& box);
  void fail(std::string_view why);

  SolidPool& pool_;
  int chords_;
  std::vector<SolidPart> sums_;
  std::string_view failure_;
  size_t work_ = 0;  // of what was added: pairs of generators, and their sums
};

}  // namespace frontend
