#include "solid/redundant_operands.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <unordered_map>

#include "base/constants.hpp"
#include "primitives/primitive_kind.hpp"

namespace csgcore {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFFu;

/// The class of a primitive or an operand. Equal ones have the same class.
using Class = uint32_t;

/// Spreads a difference in any bit over all bits (the finaliser of MurmurHash3, Appleby 2011).
constexpr uint64_t mixed_bits(uint64_t bits) {
  bits = (bits ^ bits >> 33) * 0xFF51AFD7ED558CCDu;
  bits = (bits ^ bits >> 33) * 0xC4CEB9FE1A85EC53u;
  return bits ^ bits >> 33;
}

uint64_t hash_of(const CanonicalPrimitive& primitive) {
  const double numbers[] = {primitive.center.x, primitive.center.y, primitive.center.z,
                            primitive.canonical_to_world[0][0]};
  uint64_t sum = 0;
  for (const double number : numbers) {
    constexpr uint64_t kOdd = 0x9E3779B97F4A7C15u;               // 2⁶⁴ over the golden ratio
    sum = kOdd * (sum + std::bit_cast<uint64_t>(number + 0.0));  // −0 equals 0
    sum ^= sum >> 32;
  }
  return mixed_bits(sum);
}

bool is_equal(const CanonicalPrimitive& a, const CanonicalPrimitive& b) {
  return a.shape == b.shape && a.center == b.center && a.radius_mid == b.radius_mid &&
         a.radius_slope == b.radius_slope && a.canonical_to_world == b.canonical_to_world &&
         kind_of(a.shape).has_same_form(a, b);
}

/// Returns, for each primitive, the lowest index among the primitives that equal it. Most often no
/// two are equal, which costs a few passes over hashes.
std::vector<Class> classes_of(std::span<const CanonicalPrimitive> primitives) {
  const size_t count = primitives.size();
  std::vector<uint64_t> hashes(count);
  constexpr size_t kAtOnce = 4096;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, kAtOnce), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) hashes[i] = hash_of(primitives[i]);
  });
  // `twice` marks the bits that two hashes share. There are so many bits that few are shared by
  // chance.
  constexpr size_t kBitsEach = 8;
  const size_t mask = std::bit_ceil(kBitsEach * std::max<size_t>(count, 64)) - 1;
  std::vector<uint64_t> once((mask + 1) / 64), twice((mask + 1) / 64);
  for (const uint64_t hash : hashes) {
    const size_t bit = hash & mask;
    const uint64_t here = uint64_t{1} << bit % 64;
    twice[bit / 64] |= once[bit / 64] & here;
    once[bit / 64] |= here;
  }
  std::vector<Class> classes(count);
  std::iota(classes.begin(), classes.end(), 0u);
  std::unordered_map<uint64_t, uint32_t> first_of;  // by hash
  std::vector<uint32_t> next_of;                    // another with the same hash
  for (uint32_t i = 0; i < count; ++i) {
    const size_t bit = hashes[i] & mask;
    if ((twice[bit / 64] >> bit % 64 & 1) == 0) continue;
    const auto [first, is_new] = first_of.try_emplace(hashes[i], i);
    if (is_new) continue;
    if (next_of.empty()) next_of.assign(count, kNone);
    uint32_t other = first->second;
    while (!is_equal(primitives[i], primitives[other]) && next_of[other] != kNone) {
      other = next_of[other];
    }
    if (is_equal(primitives[i], primitives[other])) {
      classes[i] = other;
    } else {
      next_of[other] = i;
    }
  }
  return classes;
}

/// For each union, so many of its largest operands are tested for holding the others. A union with
/// more than kMostOperands is not searched.
constexpr size_t kLargest = 4;
constexpr size_t kMostOperands = size_t{1} << 17;

/// As a share of the thickness tolerance: a primitive must lie so deep below the surface of the one
/// that holds it, unless coincident faces show the latter: then it may reach out by kCoplanar.
constexpr double kApartInside = 4;

/// Finds primitives that lie within another operand of their union.
class InnerOperands {
 public:
  InnerOperands(std::span<const CsgToken> tokens, std::span<const CanonicalPrimitive> primitives,
                std::span<const Extent> extents, double thickness_tolerance)
      : tokens_(tokens),
        primitives_(primitives),
        extents_(extents),
        in_surface_(kCoplanar * thickness_tolerance),
        inside_(-kApartInside * thickness_tolerance),
        is_inner_(tokens.size()) {}

  /// Returns marks by token, or an empty vector if no primitive lies within another.
  std::vector<uint8_t> find() {
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < tokens_.size(); ++i) {
      const CsgToken& token = tokens_[i];
      if (!token.is_primitive) {
        const size_t first = roots.size() - token.value;
        if (token.op != Op::kIntersection) {
          const size_t skipped = token.op == Op::kDifference ? 1 : 0;
          look_at(std::span(roots).subspan(first + skipped));
        }
        roots.resize(first);
      }
      roots.push_back(i);
    }
    return found_any_ ? std::move(is_inner_) : std::vector<uint8_t>();
  }

 private:
  static double size_of(const Extent& e) {
    return e.half[0] * e.half[0] + e.half[1] * e.half[1] + e.half[2] * e.half[2];
  }

  void look_at(std::span<const uint32_t> roots) {
    if (roots.size() < 2 || roots.size() > kMostOperands) return;
    operands_.clear();
    for (const uint32_t root : roots) {
      if (tokens_[root].is_primitive) operands_.push_back(root);
    }
    if (operands_.size() < 2) return;
    // The largest come first; among equals in size, the last in the tree.
    largest_ = operands_;
    const size_t asked = std::min(kLargest, largest_.size());
    const auto primitive_of = [this](uint32_t root) { return tokens_[root].value; };
    std::partial_sort(largest_.begin(), largest_.begin() + static_cast<long>(asked), largest_.end(),
                      [&](uint32_t a, uint32_t b) {
                        const double sizes[] = {size_of(extents_[primitive_of(a)]),
                                                size_of(extents_[primitive_of(b)])};
                        return sizes[0] != sizes[1] ? sizes[0] > sizes[1] : a > b;
                      });
    largest_.resize(asked);
    for (const uint32_t root : operands_) {
      for (const uint32_t other : largest_) {
        if (other == root || is_inner_[other]) continue;
        if (!is_held(primitive_of(root), primitive_of(other))) continue;
        is_inner_[root] = 1;
        found_any_ = true;
        break;
      }
    }
  }

  bool is_held(uint32_t inner, uint32_t outer) const {
    const double limit = inner < outer ? in_surface_ : inside_;
    const Extent &a = extents_[inner], &b = extents_[outer];
    // Equal primitives are found by their classes.
    if (std::equal(a.half, a.half + 3, b.half)) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const double beyond = std::abs(a.center[axis] - b.center[axis]) + a.half[axis];
      if (beyond > b.half[axis] + in_surface_) return false;
    }
    return inner != outer && lies_within(primitives_[inner], primitives_[outer], limit);
  }

  const std::span<const CsgToken> tokens_;
  const std::span<const CanonicalPrimitive> primitives_;
  const std::span<const Extent> extents_;
  const double in_surface_, inside_;
  std::vector<uint8_t> is_inner_;
  bool found_any_ = false;
  std::vector<uint32_t> operands_, largest_;
};

/// Finds equal operands from the leaves up.
class Merger {
 public:
  /// `dropped` marks, by token, the operands that are left out in any case; it may be empty.
  Merger(std::span<const CsgToken> tokens, std::vector<Class> classes, std::vector<uint8_t> shared,
         std::vector<uint8_t> dropped)
      : tokens_(tokens),
        classes_(std::move(classes)),
        is_shared_(std::move(shared)),
        next_class_(static_cast<Class>(classes_.size())),
        dropped_(std::move(dropped)),
        any_dropped_(!dropped_.empty()) {
    dropped_.resize(tokens.size());
    find_operands();
  }

  /// Drops operands that equal a later one of their operation. Returns whether any operand is
  /// dropped.
  bool find() {
    std::vector<Operand> operands;
    for (uint32_t i = 0; i < tokens_.size(); ++i) {
      const CsgToken& token = tokens_[i];
      if (token.is_primitive) {
        const Class own = classes_[token.value];
        operands.push_back({i, own, token.value, token.value, is_shared_[own] != 0});
        continue;
      }
      const size_t first = operands.size() - token.value;
      drop_equal(std::span(operands).subspan(first + (token.op == Op::kDifference ? 1 : 0)));
      Operand whole = operation_of(i, std::span(operands).subspan(first));
      operands.resize(first);
      operands.push_back(whole);
    }
    return any_dropped_;
  }

  /// Returns the tree without the dropped operands.
  CsgTree tree() const {
    CsgTreeBuilder builder;
    struct Open {
      uint32_t next, end;  // of operand_roots_
    };
    std::vector<Open> open;
    const auto enter = [&](uint32_t token) {
      if (tokens_[token].is_primitive) {
        builder.primitive(tokens_[token].value);
        return;
      }
      builder.open(tokens_[token].op);
      open.push_back({first_operand_[token], first_operand_[token] + tokens_[token].value});
    };
    enter(static_cast<uint32_t>(tokens_.size() - 1));
    while (!open.empty()) {
      Open& innermost = open.back();
      if (innermost.next == innermost.end) {
        builder.close();
        open.pop_back();
        continue;
      }
      const uint32_t operand = operand_roots_[innermost.next++];
      if (!dropped_[operand]) enter(operand);
    }
    return builder.finish();
  }

 private:
  struct Operand {
    uint32_t root;  // token
    Class own;
    uint32_t lowest, highest;  // of its primitives' indices
    bool may_be_shared;        // each of its primitives equals another one
  };

  /// Lists the root tokens of each operation's operands.
  void find_operands() {
    first_operand_.resize(tokens_.size());
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < tokens_.size(); ++i) {
      if (!tokens_[i].is_primitive) {
        const auto first = roots.end() - static_cast<std::ptrdiff_t>(tokens_[i].value);
        first_operand_[i] = static_cast<uint32_t>(operand_roots_.size());
        operand_roots_.insert(operand_roots_.end(), first, roots.end());
        roots.erase(first, roots.end());
      }
      roots.push_back(i);
    }
  }

  void drop_equal(std::span<const Operand> operands) {
    last_of_.clear();
    for (const Operand& operand : operands) {
      if (!operand.may_be_shared || dropped_[operand.root]) continue;
      const auto [entry, is_new] = last_of_.try_emplace(operand.own, &operand);
      if (is_new) continue;
      const Operand*& last = entry->second;
      const bool is_later = last->highest <= operand.lowest;
      // If the primitives of two operands interleave in the file, different ones of the two would
      // be shown on different faces.
      if (!is_later && operand.highest > last->lowest) continue;
      dropped_[(is_later ? *last : operand).root] = 1;
      any_dropped_ = true;
      if (is_later) last = &operand;
    }
  }

  Operand operation_of(uint32_t token, std::span<const Operand> operands) {
    Operand whole{token, kNone, kNone, 0, true};
    key_.assign(1, static_cast<uint32_t>(tokens_[token].op));
    for (const Operand& operand : operands) {
      if (dropped_[operand.root]) continue;
      whole.lowest = std::min(whole.lowest, operand.lowest);
      whole.highest = std::max(whole.highest, operand.highest);
      whole.may_be_shared &= operand.may_be_shared;
      key_.push_back(operand.own);
    }
    constexpr size_t kLone = 2;
    if (key_.size() == kLone) {
      whole.own = key_.back();
    } else if (whole.may_be_shared) {
      uint64_t hash = 0;
      for (const uint32_t part : key_) hash = mixed_bits(hash ^ part);
      std::vector<Known>& known = known_[hash];
      const auto same = std::ranges::find(known, key_, &Known::key);
      whole.own = same != known.end() ? same->own : next_class_++;
      if (same == known.end()) known.push_back({key_, whole.own});
    }
    return whole;
  }

  const std::span<const CsgToken> tokens_;
  const std::vector<Class> classes_;      // by primitive
  const std::vector<uint8_t> is_shared_;  // by class
  Class next_class_;
  std::vector<uint8_t> dropped_;  // by token: an operand's root
  bool any_dropped_;
  std::vector<uint32_t> first_operand_, operand_roots_;  // first_operand_ by token
  struct Known {
    std::vector<uint32_t> key;  // the operation, then its operands' classes
    Class own;
  };
  std::unordered_map<uint64_t, std::vector<Known>> known_;
  std::unordered_map<Class, const Operand*> last_of_;
  std::vector<uint32_t> key_;
};

}  // namespace

std::optional<CsgTree> leave_out_redundant(const CsgTree& tree,
                                           std::span<const CanonicalPrimitive> primitives,
                                           std::span<const Extent> extents,
                                           double thickness_tolerance) {
  std::vector<uint8_t> inner =
      InnerOperands(tree.tokens(), primitives, extents, thickness_tolerance).find();
  std::vector<Class> classes = classes_of(primitives);
  std::vector<uint8_t> is_shared(classes.size());
  bool any_shared = false;
  for (uint32_t i = 0; i < classes.size(); ++i) {
    if (classes[i] == i) continue;
    is_shared[classes[i]] = 1;
    any_shared = true;
  }
  if (inner.empty() && !any_shared) return std::nullopt;
  Merger merger(tree.tokens(), std::move(classes), std::move(is_shared), std::move(inner));
  if (!merger.find()) return std::nullopt;
  return merger.tree();
}

}  // namespace csgcore
