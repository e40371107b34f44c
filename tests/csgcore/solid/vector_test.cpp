// Tests that are evaluated several at a time must give the same answers with every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "checks.hpp"
#include "simd_levels.hpp"
#include "solid/extent_tests.hpp"

namespace csgcore {
namespace {

struct Answers {
  std::vector<uint64_t> bits;
  std::vector<uint32_t> counts;
  bool operator==(const Answers&) const = default;
};

class VectorTest : public testing::Test {
 protected:
  VectorTest() {
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
      primitives_.push_back(canonicalize(checks::random_primitive(random, {.low = 1, .high = 4})));
      extents_.push_back(extent_of(primitives_.back()));
      indices_.push_back(static_cast<uint32_t>(random() % 3000) | (random() % 2 ? 1u << 31 : 0));
    }
    indices_.resize(3000 + kVectorPadding, 0);
  }

  static Halves random_halves(std::mt19937& random) {
    Box cell;
    const Vec3 corner = checks::random_point(random, {Vec3(-6.0), Vec3(6.0)});
    const double size = checks::uniform(random, 0.1, 6);
    cell.merge(corner);
    cell.merge(corner + size * checks::random_point(random, {Vec3(0.1), Vec3(1.0)}));
    Halves halves{cell, cell, static_cast<uint32_t>(random() % 3)};
    const int axis = static_cast<int>(halves.axis);
    halves.below.max[axis] = halves.above.min[axis] = cell.center()[axis];
    return halves;
  }

  Answers answers() const {
    std::mt19937 random(2);
    Answers result;
    for (int round = 0; round < 500; ++round) {
      const Halves halves = random_halves(random);
      const uint32_t first = static_cast<uint32_t>(random() % 2900);
      const uint32_t count = 1 + static_cast<uint32_t>(random() % 64);
      const ExtentAnswers a = test_extents(extents_.data(), indices_.data() + first, count, halves);
      result.bits.insert(result.bits.end(),
                         {a.outside[0], a.outside[1], a.inside[0], a.inside[1], a.open});
      EndCounts counts;
      count_ends(extents_.data(), indices_.data(), round == 0 ? 3000 : count, halves.below, counts);
      for (const auto* ends : {&counts.starts, &counts.ends}) {
        for (const auto& axis : *ends) result.counts.insert(result.counts.end(), axis, axis + 8);
      }
    }
    return result;
  }

  std::vector<CanonicalPrimitive> primitives_;
  Extents extents_;
  std::vector<uint32_t> indices_;
};

TEST_F(VectorTest, EveryInstructionSetAgrees) {
  const Answers expected = answers();
  int levels = 0;
  checks::for_each_simd_level([&](SimdLevel level) {
    EXPECT_EQ(answers(), expected) << checks::name_of(level);
    ++levels;
  });
  EXPECT_GE(levels, 1);
}

TEST_F(VectorTest, AnswersAreThoseOfOnePrimitive) {
  std::mt19937 random(3);
  int outside = 0, inside = 0;
  for (int round = 0; round < 900; ++round) {
    const Halves halves = random_halves(random);
    const size_t first = static_cast<size_t>(64 * round % 2900);
    const uint32_t* const indices = indices_.data() + first;
    const ExtentAnswers answers = test_extents(extents_.data(), indices, 64, halves);
    for (uint32_t i = 0; i < 64; ++i) {
      const CanonicalPrimitive& primitive = primitives_[indices[i] & kPrimitiveBits];
      const bool open = (answers.open >> i) & 1;
      ASSERT_EQ(open, primitive.ball_radius == 0);
      for (const int side : {0, 1}) {
        const Classification single = classify(primitive, side == 0 ? halves.below : halves.above);
        const bool is_outside = (answers.outside[side] >> i) & 1;
        const bool is_inside = (answers.inside[side] >> i) & 1;
        outside += is_outside;
        inside += is_inside;
        ASSERT_FALSE(open && is_inside);
        if (is_outside || !open) {
          ASSERT_EQ(is_outside, single == Classification::kOutside);
        }
        if (!open) {
          ASSERT_EQ(is_inside, single == Classification::kInside);
        }
      }
    }
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(inside, 20);
}

TEST_F(VectorTest, CountsWhereBoxesStartAndEnd) {
  const Box cell{{-2, -3, -4}, {2, 5, 4}};
  EndCounts counts;
  count_ends(extents_.data(), indices_.data(), 3000, cell, counts);
  const auto bin = [&](double value, int axis) {
    const double share = (value - cell.min[axis]) / cell.size()[axis];
    return std::min(std::max(static_cast<int>(std::floor(share * kSplitBins)), 0), kSplitBins - 1);
  };
  EndCounts expected{};
  for (int i = 0; i < 3000; ++i) {
    const Extent& extent = extents_[indices_[static_cast<size_t>(i)] & kPrimitiveBits];
    for (int axis = 0; axis < 3; ++axis) {
      ++expected.starts[axis][bin(extent.center[axis] - extent.half[axis], axis)];
      ++expected.ends[axis][bin(extent.center[axis] + extent.half[axis], axis)];
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kSplitBins; ++i) {
      EXPECT_EQ(counts.starts[axis][i], expected.starts[axis][i]) << axis << ' ' << i;
      EXPECT_EQ(counts.ends[axis][i], expected.ends[axis][i]) << axis << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace csgcore
