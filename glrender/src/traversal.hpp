// Turns the leaves of the kd-tree, front to back (paper §2.3), or the tiles of the screen into
// instances for the GPU.
#pragma once

#include <array>
#include <vector>

#include "csgcore/subdivision.hpp"
#include "csgcore/tile_lists.hpp"
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

/// Instances by path, each in front-to-back order. A cell around the eye is drawn by its back
/// faces, since its front faces lie behind the eye.
struct InstanceStreams {
  std::array<std::vector<Instance>, kPaths> front_faces;
  std::array<std::vector<Instance>, kPaths> back_faces;
  void clear();
  uint64_t size() const;
};

/// Estimates how many loop rounds the shaders take to evaluate the Blist once, without those for
/// primitives that are not convex (kMostNonconvexRounds).
uint64_t rounds(const csgcore::Solid& solid, std::span<const csgcore::BlistTest> tests);

/// Returns whether all primitives of the list are convex.
bool are_convex(const csgcore::Solid& solid, std::span<const csgcore::BlistTest> tests);

/// Sorts leaves into streams.
class InstanceSorter {
 public:
  /// `eye_inside`: the solid's complement is drawn, for which only the general paths work.
  /// `short_list`: the longest list for Path::kShortList. `boxes`: the cells themselves are drawn.
  InstanceSorter(const Frame& frame, const csgcore::Solid& solid, uint32_t short_list,
                 double overlap, bool eye_inside, bool boxes, InstanceStreams& streams)
      : frame_(frame),
        solid_(solid),
        short_list_(short_list),
        overlap_(overlap),
        eye_inside_(eye_inside),
        boxes_(boxes),
        streams_(streams) {}

  /// Adds a leaf. `tests` is its Blist, which starts at `first_test` on the GPU. Throws GlError if
  /// the Blist takes more than kMostRounds.
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

/// A subdivision's tests as they go to the GPU. Leaves that are not drawn, such as those that a
/// threshold has dropped, have none there.
struct PackedTests {
  std::vector<csgcore::BlistTest> tests;
  std::vector<uint64_t> first_test;  // by leaf: where its tests start
};

PackedTests pack_tests(const csgcore::Subdivision& subdivision);

/// Calls `sorter.add` for every leaf that may be on the screen, nearest first. `first_test` is
/// PackedTests::first_test.
void traverse_front_to_back(const csgcore::Subdivision& subdivision,
                            std::span<const uint64_t> first_test, const Frame& frame,
                            InstanceSorter& sorter);

/// Throws ListsTooLong.
[[noreturn]] void refuse_lists();

/// Adds all tiles to the front faces, each by the path of its list. `eye_inside` means what it
/// means in InstanceSorter. Throws ListsTooLong. Precondition: no list is longer than kLongList.
void add_tiles(const csgcore::TileLists& lists, const Frame& frame, const csgcore::Solid& solid,
               bool eye_inside, InstanceStreams& streams);

}  // namespace glrender
