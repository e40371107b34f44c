#include "traversal.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "glrender/gl_error.hpp"
#include "shape_texels.hpp"

namespace glrender {

using csgcore::BlistTest;
using csgcore::Box;
using csgcore::KdNode;
using csgcore::Leaf;
using csgcore::LeafKind;

namespace {

bool is_drawn(const Leaf& leaf) {
  return leaf.kind != LeafKind::kEmpty && leaf.kind != LeafKind::kDropped &&
         leaf.kind != LeafKind::kReplaced;
}

}  // namespace

void InstanceStreams::clear() {
  for (auto& stream : front_faces) stream.clear();
  for (auto& stream : back_faces) stream.clear();
}

uint64_t InstanceStreams::size() const {
  uint64_t sum = 0;
  for (const auto& stream : front_faces) sum += stream.size();
  for (const auto& stream : back_faces) sum += stream.size();
  return sum;
}

uint64_t rounds(const csgcore::Solid& solid, std::span<const BlistTest> tests) {
  uint64_t sum = tests.size();
  for (const BlistTest& test : tests) {
    sum += face_rounds(solid.primitives()[test.primitive].polyhedron.get());
  }
  return sum;
}

/// Returns true when in doubt: back faces work for any cell, front faces only for cells that do not
/// reach the eye once the vertex shader has pushed them out.
bool InstanceSorter::surrounds_eye(const Box& box) const {
  if (!frame_.perspective()) return false;
  const Vec3 from_eye =
      glm::max(glm::abs(box.min - frame_.view.eye), glm::abs(box.max - frame_.view.eye));
  const double margin = glm::length(from_eye) * (frame_.pixel_size + 0x1p-10) + 2 * overlap_;
  const Vec3& eye = frame_.view.eye;
  for (int axis = 0; axis < 3; ++axis) {
    if (eye[axis] < box.min[axis] - margin || eye[axis] > box.max[axis] + margin) return false;
  }
  return true;
}

void InstanceSorter::push(Path path, const Box& box, uint64_t first_test, uint32_t count) {
  const glm::vec3 low = frame_.relative(box.min);
  const glm::vec3 high = frame_.relative(box.max);
  auto& streams = surrounds_eye(box) ? streams_.back_faces : streams_.front_faces;
  streams[static_cast<size_t>(path)].push_back(
      {{low.x, low.y, low.z}, {high.x, high.y, high.z}, static_cast<uint32_t>(first_test), count});
}

bool are_convex(const csgcore::Solid& solid, std::span<const BlistTest> tests) {
  return std::ranges::all_of(
      tests, [&](const BlistTest& test) { return solid.primitives()[test.primitive].is_convex; });
}

void InstanceSorter::add(const Leaf& leaf, std::span<const BlistTest> tests, uint64_t first_test) {
  if (!is_drawn(leaf)) return;
  // The special paths take each primitive for one segment, and draw no complement.
  const bool is_special = !eye_inside_ && are_convex(solid_, tests);
  const bool is_divided = leaf.kind == LeafKind::kUnion && (is_special || leaf.test_count == 1);
  if (leaf.test_count > short_list_ && !is_divided && rounds(solid_, tests) > kMostRounds) {
    throw GlError(std::to_string(leaf.test_count) +
                  " primitives coincide in one place, more than OpenGL can evaluate for a pixel "
                  "(leave out the repeated ones)");
  }
  if (boxes_) {
    push(Path::kBoxes, leaf.box, 0, 0);
  } else if (is_divided) {
    // The depth buffer unites the operands (paper §3.3.3). A primitive is sought only in its own
    // bounds within the cell; its complement in the whole cell.
    for (uint32_t i = 0; i < leaf.test_count; ++i) {
      Box box = leaf.box;
      if (!tests[i].complement) {
        const Box& bounds = solid_.primitives()[tests[i].primitive].bounds;
        box = {glm::max(box.min, bounds.min - overlap_), glm::min(box.max, bounds.max + overlap_)};
        if (box.empty()) continue;
      }
      if (!is_special) {
        push(Path::kList, box, first_test + i, 1);
      } else {
        // The number of later operands that may have the same face.
        const uint32_t later = leaf.test_count <= kSharedFaces ? leaf.test_count - 1 - i : 0;
        push(later > 0 ? Path::kUnion : Path::kSingle, box, first_test + i, later);
      }
    }
  } else if (leaf.kind == LeafKind::kPair && is_special) {
    const int complements = tests[0].complement + tests[1].complement;
    const Path path =
        complements == 0 ? Path::kBoth : (complements == 1 ? Path::kMinus : Path::kNeither);
    push(path, leaf.box, first_test, 2);
  } else {
    const Path path = leaf.test_count <= short_list_ ? Path::kShortList : Path::kList;
    push(path, leaf.box, first_test, leaf.test_count);
  }
}

namespace {

/// The four side planes of the view, through the eye (perspective) or parallel (orthographic).
class Frustum {
 public:
  explicit Frustum(const Frame& frame) {
    const csgcore::View& view = frame.view;
    const double half_width = view.half_height * view.width_px / view.height_px;
    const auto plane = [&](const Vec3& outward, double half) {
      return frame.perspective() ? Plane{outward - half * view.forward,
                                         glm::dot(outward - half * view.forward, view.eye)}
                                 : Plane{outward, glm::dot(outward, view.eye) + half};
    };
    planes_ = {plane(view.right, half_width), plane(-view.right, half_width),
               plane(view.up, view.half_height), plane(-view.up, view.half_height)};
  }

  bool misses(const Box& box) const {
    for (const Plane& plane : planes_) {
      double lowest = -plane.offset;
      for (int axis = 0; axis < 3; ++axis) {
        lowest += plane.outward[axis] * (plane.outward[axis] > 0 ? box.min : box.max)[axis];
      }
      if (lowest > 0) return true;
    }
    return false;
  }

 private:
  struct Plane {
    Vec3 outward;
    double offset;  // a point x is outside if outward·x > offset
  };
  std::array<Plane, 4> planes_{};
};

}  // namespace

PackedTests pack_tests(const csgcore::Subdivision& subdivision) {
  PackedTests packed;
  packed.first_test.reserve(subdivision.leaves().size());
  packed.tests.reserve(subdivision.tests().size());
  for (const Leaf& leaf : subdivision.leaves()) {
    packed.first_test.push_back(packed.tests.size());
    if (!is_drawn(leaf)) continue;
    const std::span<const BlistTest> tests = subdivision.tests_of(leaf);
    packed.tests.insert(packed.tests.end(), tests.begin(), tests.end());
  }
  return packed;
}

void traverse_front_to_back(const csgcore::Subdivision& subdivision,
                            std::span<const uint64_t> first_test, const Frame& frame,
                            InstanceSorter& sorter) {
  if (subdivision.nodes().empty() || !frame.visible) return;
  const Frustum frustum(frame);
  struct Visit {
    uint32_t node;
    Box box;
  };
  std::vector<Visit> stack{{0, subdivision.root_box()}};
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    if (frustum.misses(visit.box)) continue;
    const KdNode& node = subdivision.nodes()[visit.node];
    if (node.axis == KdNode::kLeafAxis) {
      const Leaf& leaf = subdivision.leaves()[node.below];
      sorter.add(leaf, subdivision.tests_of(leaf), first_test[node.below]);
      continue;
    }
    const int axis = static_cast<int>(node.axis);
    Visit below{node.below, visit.box};
    Visit above{node.above, visit.box};
    below.box.max[axis] = above.box.min[axis] = node.split;
    const bool below_first =
        frame.perspective() ? frame.view.eye[axis] < node.split : frame.view.forward[axis] > 0;
    stack.push_back(below_first ? above : below);
    stack.push_back(below_first ? below : above);
  }
}

namespace {

using csgcore::BlistTest;
using csgcore::ListedTile;

/// Every segment is found once, and the Blist is evaluated before and behind each segment's ends.
bool is_too_long(const csgcore::Solid& solid, std::span<const BlistTest> tests) {
  const uint64_t evaluations = 2 * tests.size() + 2;
  return rounds(solid, tests) + evaluations * tests.size() > kMostTileRounds;
}

Path path_of(const csgcore::Solid& solid, std::span<const BlistTest> tests, bool eye_inside) {
  if (tests.size() == 1 && !eye_inside && are_convex(solid, tests)) return Path::kSingle;
  if (tests.size() <= short_list(false, true)) return Path::kShortList;
  if (is_too_long(solid, tests)) refuse_lists();
  return Path::kLongList;
}

}  // namespace

void refuse_lists() {
  throw ListsTooLong(
      "more primitives lie behind each other on the screen than OpenGL can evaluate for a pixel "
      "(draw by cells)");
}

void add_tiles(const csgcore::TileLists& lists, const Frame& frame, const csgcore::Solid& solid,
               bool eye_inside, InstanceStreams& streams) {
  for (const ListedTile& tile : lists.tiles) {
    const std::span<const BlistTest> tests =
        std::span(lists.tests).subspan(tile.first_test, tile.test_count);
    const auto x = static_cast<float>(tile.area.x);
    const auto y = static_cast<float>(tile.area.y);
    const auto cut_t = static_cast<float>(tile.cut_s - frame.eye_distance);
    streams.front_faces[static_cast<size_t>(path_of(solid, tests, eye_inside))].push_back(
        {{x, y, cut_t},
         {x + static_cast<float>(tile.area.width), y + static_cast<float>(tile.area.height), 0},
         tile.first_test,
         tile.test_count});
  }
}

}  // namespace glrender
