// The kd-tree in front-to-back order (paper §2.3), as instances for the GPU.
#pragma once

#include <array>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "frame.hpp"
#include "shader_constants.hpp"

namespace glrender {

/// One cell, one primitive of a union cell, or one tile, as its vertex shader reads it.
struct Instance {
  float low[3];
  float high[3];
  uint32_t first_test;
  uint32_t test_count;
};

/// Instances by path, each in front-to-back order. Cells around the eye are drawn by their back
/// faces, as the front ones lie behind it.
struct InstanceStreams {
  std::array<std::vector<Instance>, kPaths> front_faces;
  std::array<std::vector<Instance>, kPaths> back_faces;
  void clear();
  uint64_t size() const;
};

/// Loop rounds that the shaders take for one evaluation of the function, about.
uint64_t rounds(const csgcore::Solid& solid, std::span<const csgcore::BlistTest> tests);

/// Sorts leaves into streams.
class InstanceSorter {
 public:
  /// `eye_inside`: what is drawn is the solid's complement, to which only the general path applies.
  /// `short_list`: the longest list for Path::kShortList.
  InstanceSorter(const Frame& frame, const csgcore::Solid& solid, uint32_t short_list,
                 double overlap, bool eye_inside, bool boxes, InstanceStreams& streams)
      : frame_(frame),
        solid_(solid),
        short_list_(short_list),
        overlap_(overlap),
        eye_inside_(eye_inside),
        boxes_(boxes),
        streams_(streams) {}

  /// `tests` is the leaf's function, whose place on the GPU starts at `first_test`. Throws
  /// GlError for a cell of more than kMostRounds.
  void add(const csgcore::Leaf& leaf, std::span<const csgcore::BlistTest> tests,
           uint64_t first_test);

 private:
  void push(Path path, const csgcore::Box& box, uint64_t first_test, uint32_t count);
  bool surrounds_eye(const csgcore::Box& box) const;

  const Frame& frame_;
  const csgcore::Solid& solid_;
  uint32_t short_list_;
  double overlap_;
  bool eye_inside_;
  bool boxes_;
  InstanceStreams& streams_;
};

/// A subdivision's tests as they go to the GPU: without those of leaves that nothing draws,
/// which a subdivision with a threshold has dropped.
struct PackedTests {
  std::vector<csgcore::BlistTest> tests;
  std::vector<uint64_t> first_test;  // by leaf, where its tests start
};

/// Of the leaves from `first_leaf` on, behind so many tests that are packed already.
PackedTests pack_tests(const csgcore::Subdivision& subdivision, size_t first_leaf = 0,
                       uint64_t packed_before = 0);

/// Calls `sorter.add` for every leaf that may be on the screen, nearest first. `first_test` is
/// PackedTests::first_test.
void traverse_front_to_back(const csgcore::Subdivision& subdivision,
                            std::span<const uint64_t> first_test, const Frame& frame,
                            InstanceSorter& sorter);

}  // namespace glrender
