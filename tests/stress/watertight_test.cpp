// Tests that no ray slips into a closed mesh or out of it unseen: on every ray the crossings
// cancel. The rays pass vertices, edges and points of faces, along edges, faces, axes or at random,
// from 1 to 1e9 sizes away, on meshes of 4 to a million triangles. Every instruction set must find
// the same crossings, and so must searches that take a few crossings at a time. The full run has
// 10⁸ rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <ostream>
#include <random>

#include "csgcore/simd_levels.hpp"
#include "primitives/intersect.hpp"
#include "support/full_run.hpp"
#include "support/test_meshes.hpp"

namespace {

using csgcore::CanonicalPrimitive;
using csgcore::Crossing;
using csgcore::CrossingSearch;
using csgcore::FrameRays;
using csgcore::kPacketRays;
using csgcore::Mat3;
using csgcore::RayPacket;
using csgcore::SimdLevel;
using csgcore::TriangleMesh;
using csgcore::Vec3;
using test_support::MeshParts;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct NamedMesh {
  const char* name;
  MeshParts (*make)(std::mt19937&);
  bool only_full_run = false;
};
void PrintTo(const NamedMesh& mesh, std::ostream* out) { *out << mesh.name; }

const NamedMesh kMeshes[] = {
    {"Tetrahedron", [](std::mt19937&) { return test_support::tetrahedron_parts(1); }},
    {"Box", [](std::mt19937&) { return test_support::box_parts(Vec3(-1), Vec3(1, 2, 0.5)); }},
    {"LPrism", [](std::mt19937&) { return test_support::l_prism_parts(3, 1, 1); }},
    {"Flat",
     [](std::mt19937&) {
       return test_support::box_parts({-1, -1, 0}, {1, 1, 0});
     }},
    {"SlicedBox",
     [](std::mt19937& random) {
       return test_support::sliced_box_parts({1, 2, 0.3}, 9, random);
     }},
    {"Torus", [](std::mt19937&) { return test_support::torus_parts(3, 1, 24, 12); }},
    {"Helix", [](std::mt19937&) { return test_support::helix_parts(3, 0.5, 1, 5, 24, 8); }},
    {"Shells",
     [](std::mt19937& random) {
       MeshParts parts = test_support::star_parts(0.3, 1, 3, random);
       parts.add(test_support::box_parts(Vec3(-0.7), Vec3(0.7)));
       parts.add(test_support::icosphere_parts(0.4, 2).inside_out());
       return parts;
     }},
    {"HeightField",
     [](std::mt19937& random) {
       return test_support::height_field_parts(1, 50, 0.1, 0.3, random);
     }},
    {"Icosphere20480", [](std::mt19937&) { return test_support::icosphere_parts(1, 5); }},
    {"HeightField1000000",
     [](std::mt19937& random) {
       return test_support::height_field_parts(1, 500, 0.1, 0.11, random);
     },
     true},
    {"Icosphere327680", [](std::mt19937&) { return test_support::icosphere_parts(1, 7); }}};

Mat3 random_map(std::mt19937& random) {
  Mat3 map(1.0);
  if (random() % 2 == 0) return map;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) map[column][row] += uniform(random, -0.4, 0.4);
  }
  if (random() % 4 == 0) map[2] *= 1e-4;
  return map;
}

/// Makes rays about one mesh, in its local space.
class HardRays {
 public:
  HardRays(const TriangleMesh& mesh, std::mt19937& random) : mesh_(mesh), random_(random) {
    csgcore::Box box;
    for (const Vec3& vertex : mesh.vertices()) box.merge(vertex);
    size_ = box.diagonal();
  }

  struct Line {
    Vec3 origin, direction;
  };
  Line next() {
    const TriangleMesh::Triangle triangle = any_triangle();
    const Vec3 point = point_of(triangle);
    Vec3 direction = direction_at(triangle, point);
    // Two points next to each other are only a rounding apart. A view's directions are about 1 long.
    direction /= std::exp2(std::ilogb(glm::length(direction)));
    if (!(glm::length(direction) > 0)) direction = {1, 0, 0};
    direction *= std::exp2(std::floor(uniform(random_, -20, 20)));
    const double distance = random_() % 4 == 0 ? 0 : size_ * std::pow(10, uniform(random_, 0, 9));
    return {point - distance / glm::length(direction) * direction, direction};
  }

 private:
  const TriangleMesh::Triangle& any_triangle() {
    return mesh_.triangles()[random_() % mesh_.triangles().size()];
  }
  const Vec3& vertex(uint32_t index) const { return mesh_.vertices()[index]; }
  double share() {
    constexpr double kShares[] = {0.5, 0.25, 0.75};
    const size_t which = random_() % 4;
    return which < 3 ? kShares[which] : uniform(random_, 0, 1);
  }
  Vec3 point_of(const TriangleMesh::Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    switch (random_() % 4) {
      case 0:
        return vertex(a);
      case 1:
        return glm::mix(vertex(a), vertex(b), share());
      case 2:
        return glm::mix(glm::mix(vertex(a), vertex(b), share()), vertex(c), share());
      default: {  // next to a vertex, by a rounding
        Vec3 point = vertex(a);
        const int axis = static_cast<int>(random_() % 3);
        point[axis] = std::nextafter(point[axis], uniform(random_, -1e9, 1e9));
        return point;
      }
    }
  }
  Vec3 direction_at(const TriangleMesh::Triangle& triangle, const Vec3& point) {
    const auto& [a, b, c] = triangle;
    switch (random_() % 6) {
      case 0:
        return vertex(b) - vertex(a);
      case 1:
        return glm::mix(vertex(b), vertex(c), uniform(random_, -1, 2)) - vertex(a);
      case 2: {
        Vec3 axis(0.0);
        axis[static_cast<int>(random_() % 3)] = random_() % 2 ? 1 : -1;
        return axis;
      }
      case 3:  // through another vertex
        return vertex(any_triangle()[0]) - point;
      case 4: {  // in a plane across an axis, or in a diagonal one
        Vec3 level(uniform(random_, -1, 1), uniform(random_, -1, 1), 0);
        if (random_() % 2) level.z = level.x;
        return level;
      }
      default:
        return Vec3(uniform(random_, -1, 1), uniform(random_, -1, 1), uniform(random_, -1, 1));
    }
  }

  const TriangleMesh& mesh_;
  std::mt19937& random_;
  double size_;
};

RayPacket packet_of(HardRays& rays, const Mat3& map) {
  RayPacket packet;
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    const HardRays::Line line = rays.next();
    const Vec3 origin = map * line.origin, direction = map * line.direction;
    for (int axis = 0; axis < 3; ++axis) {
      packet.origin[axis][lane] = origin[axis];
      packet.direction[axis][lane] = direction[axis];
    }
    packet.inverse_length2[lane] = 1 / glm::dot(direction, direction);
  }
  return packet;
}

/// Finds all crossings, some at a time.
void find_some_at_a_time(const RayPacket& packet, const CanonicalPrimitive& primitive, size_t most,
                         CrossingSearch& search, std::vector<Crossing> (&found)[kPacketRays]) {
  for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
    found[lane].clear();
    search.lanes[lane].after = {};
  }
  search.most = most;
  for (bool are_more = true; are_more;) {
    csgcore::find_next_crossings(FrameRays{}, packet, primitive, search);
    are_more = false;
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const std::vector<Crossing>& next = search.lanes[lane].found;
      found[lane].insert(found[lane].end(), next.begin(), next.end());
      if (!next.empty()) search.lanes[lane].after = next.back();
      are_more |= next.size() >= most;
    }
  }
}

bool same(const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
  return std::ranges::equal(a, b, [](const Crossing& x, const Crossing& y) {
    return x.t == y.t && x.face == y.face && x.turn == y.turn;
  });
}

class Watertight : public testing::TestWithParam<NamedMesh> {};

TEST_P(Watertight, CrossingsCancelOnEveryRay) {
  const bool is_full = test_support::full_run();
  if (GetParam().only_full_run && !is_full) GTEST_SKIP() << "only in the full run";
  constexpr uint64_t kFullRays = 100'000'000, kSampleRays = 2'000'000;
  const uint64_t packets =
      (is_full ? kFullRays : kSampleRays) / std::size(kMeshes) / kPacketRays + 1;
  std::mt19937 random(1);
  const auto mesh = GetParam().make(random).mesh();
  ASSERT_TRUE(mesh->is_closed());
  CanonicalPrimitive primitive;
  Mat3 map(1.0);
  HardRays rays(*mesh, random);
  CrossingSearch search, other;
  std::vector<Crossing> by_parts[kPacketRays];
  uint64_t crossed = 0, crossings = 0;
  for (uint64_t i = 0; i < packets; ++i) {
    constexpr uint64_t kPacketsPerMap = 1000;
    if (i % kPacketsPerMap == 0) {
      map = random_map(random);
      primitive = csgcore::canonicalize(csgcore::make_mesh(mesh, {map, Vec3(0.0)}));
    }
    const RayPacket packet = packet_of(rays, map);
    csgcore::find_all_crossings(FrameRays{}, packet, primitive, search);
    const bool compares_levels = i % 16 == 0, compares_parts = i % 16 == 1;
    if (compares_parts) {
      find_some_at_a_time(packet, primitive, 1 + random() % 3, other, by_parts);
    }
    for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
      const std::vector<Crossing>& found = search.lanes[lane].found;
      int turns = 0;
      for (const Crossing& crossing : found) turns += crossing.turn;
      ASSERT_EQ(turns, 0) << "packet " << i << ", lane " << lane;
      crossed += !found.empty();
      crossings += found.size();
      if (compares_parts) {
        ASSERT_TRUE(same(found, by_parts[lane])) << "packet " << i << ", lane " << lane;
      }
    }
    if (!compares_levels) continue;
    csgcore::checks::for_each_simd_level([&](SimdLevel level) {
      csgcore::find_all_crossings(FrameRays{}, packet, primitive, other);
      for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
        ASSERT_TRUE(same(search.lanes[lane].found, other.lanes[lane].found))
            << csgcore::checks::name_of(level) << ", packet " << i << ", lane " << lane;
      }
    });
    if (HasFatalFailure()) return;
  }
  const auto number = [](uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%s: %zu triangles, %llu rays, %llu of them meet it in %llu crossings\n",
              is_full ? "full run" : "sample", mesh->triangles().size(),
              number(packets * kPacketRays), number(crossed), number(crossings));
  EXPECT_GT(crossed, packets * kPacketRays / 8);
}

INSTANTIATE_TEST_SUITE_P(, Watertight, testing::ValuesIn(kMeshes),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
