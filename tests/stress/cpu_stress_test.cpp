// Tests the CPU tracer against the exact ray oracle, on the whole stress suite and on the examples.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu_methods.hpp"
#include "csgcore/light_tracer.hpp"
#include "support/full_run.hpp"
#include "support/read_design.hpp"

namespace {

using csgcore::Hits;
using csgcore::Solid;
using csgcore::Vec3;
using stress::Case;
using stress::Family;
using stress::Line;
using stress::Tally;

/// The bars: undecided pixels per hit; and the median error of positions, in model sizes,
/// beyond the rounding of the coordinates.
constexpr double kMostUndecided = 1e-5;
constexpr double kMedianPosition = 1e-13;

/// The lines of all families, for the table's last rows.
std::vector<Line>& all_lines() {
  static std::vector<Line> lines;
  return lines;
}

class PrintTotals : public testing::Environment {
  void TearDown() override {
    if (all_lines().empty()) return;
    stress::print_header();
    for (const Line& line : stress::totals(all_lines(), "all families of this run")) {
      stress::print_line(line);
    }
  }
};
const testing::Environment* const print_totals = testing::AddGlobalTestEnvironment(new PrintTotals);

void expect_exact(const std::vector<Line>& lines, bool has_ties) {
  for (const Line& line : lines) {
    SCOPED_TRACE(line.name + " by " + line.method);
    const Tally& tally = line.tally;
    EXPECT_EQ(tally.wrong_pixels(), 0u) << tally.first_wrong;
    EXPECT_EQ(tally.speckle, 0u);
    EXPECT_LE(tally.position_errors.median(), kMedianPosition + tally.position_rounding);
  }
  for (const Line& total : stress::totals(lines, "")) {
    if (has_ties) break;
    EXPECT_LE(double(total.tally.undecided), kMostUndecided * double(total.tally.hits))
        << total.method;
  }
  std::vector<Line>& all = all_lines();
  all.insert(all.end(), lines.begin(), lines.end());
}

class CpuStressTest : public testing::TestWithParam<Family> {};

TEST_P(CpuStressTest, EqualsTheOracle) {
  expect_exact(stress::run_family(GetParam(), stress::cpu_methods(), stress::kDoubleTolerance),
               GetParam().has_ties);
}

// --- The same bits ---

bool same_bits(const Hits& a, const Hits& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  return equal(a.s, b.s) && equal(a.position, b.position) && equal(a.normal, b.normal) &&
         equal(a.primitive, b.primitive);
}

/// Draws with one thread and with two; `source` is a Solid or a Subdivision.
template <typename Source>
void expect_same_by_threads(const Source& source, const csgcore::View& view) {
  csgcore::TraceOptions one, two;
  one.threads = 1;
  two.threads = 2;
  csgcore::TraceStats stats;
  Hits by_one, by_two;
  csgcore::trace(source, view, one, by_one, stats);
  csgcore::trace(source, view, two, by_two, stats);
  EXPECT_TRUE(same_bits(by_one, by_two));
  one.samples = two.samples = 4;
  csgcore::Image image_by_one, image_by_two;
  csgcore::draw(source, view, {}, one, image_by_one, stats);
  csgcore::draw(source, view, {}, two, image_by_two, stats);
  EXPECT_EQ(image_by_one.rgb, image_by_two.rgb);
}

TEST_P(CpuStressTest, SamePictureByOneThreadAndByTwo) {
  for (const Case* one : stress::cases_to_run(GetParam())) {
    SCOPED_TRACE(one->name);
    const csgcore::Scene scene = one->make();
    const Solid solid(csgcore::canonical_primitives(scene), scene.model);
    const csgcore::Subdivision subdivision(solid, {});
    for (const stress::Camera& camera : one->cameras(scene, stress::picture_size())) {
      SCOPED_TRACE(camera.name);
      expect_same_by_threads(solid, camera.view);
      expect_same_by_threads(subdivision, camera.view);
    }
  }
}

// --- Light ---

/// The points that a picture shows from outside the solid.
struct LitPoints {
  LitPoints(const Hits& hits, const csgcore::View& view) : pixel_to_point(hits.s.size(), kNone) {
    for (size_t pixel = 0; pixel < hits.s.size(); ++pixel) {
      if (hits.primitive[pixel] == Hits::kMiss) continue;
      const Vec3& at = hits.position[pixel];
      const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
      const Vec3 ray = is_perspective ? at - view.eye : view.forward;
      if (!(glm::dot(ray, hits.normal[pixel]) < 0)) continue;
      pixel_to_point[pixel] = position.size();
      position.push_back(at);
      normal.push_back(hits.normal[pixel]);
      primitive.push_back(hits.primitive[pixel]);
    }
  }
  static constexpr size_t kNone = ~size_t{0};
  std::vector<size_t> pixel_to_point;
  std::vector<Vec3> position, normal;
  std::vector<uint32_t> primitive;
};

/// How far a point is moved along its face, as a share of the way to the pixel beside it, to find
/// whether its light is that of its surroundings, and at least as a share of its coordinates, which
/// are rounded; and the least cosine of light on it: more grazing
/// light is hidden by the face's own roundness there.
constexpr double kBeside = 1e-4;
constexpr double kBesideRounded = 0x1p-48;
constexpr double kLeastCosine = 0.01;

/// Returns how many points have another light than all points close around them.
uint32_t count_light_speckle(const csgcore::LightTracer& tracer, const LitPoints& points,
                             const csgcore::View& view, const Vec3& to_light) {
  std::vector<uint8_t> lit(points.position.size());
  tracer.find_lit({points.position, points.normal}, to_light, lit);
  std::vector<Vec3> moved, normals;
  std::vector<uint8_t> of_middle;
  for (size_t pixel = 0; pixel < points.pixel_to_point.size(); ++pixel) {
    const size_t point = points.pixel_to_point[pixel];
    if (point == LitPoints::kNone) continue;
    const Vec3& normal = points.normal[point];
    if (glm::dot(normal, to_light) < kLeastCosine) continue;
    const size_t x = pixel % view.width_px, y = pixel / view.width_px;
    if (x == 0 || y == 0 || x + 1 == view.width_px || y + 1 == view.height_px) continue;
    int others = 0;
    double distance = std::numeric_limits<double>::infinity();
    for (const size_t other :
         {pixel - 1, pixel + 1, pixel - view.width_px, pixel + view.width_px}) {
      const size_t beside = points.pixel_to_point[other];
      if (beside == LitPoints::kNone || points.primitive[beside] != points.primitive[point]) {
        continue;
      }
      others += lit[beside] != lit[point];
      distance = std::min(distance, glm::length(points.position[beside] - points.position[point]));
    }
    if (others < 2) continue;
    const Vec3 aside = std::abs(normal.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 right = glm::normalize(glm::cross(normal, aside)), up = glm::cross(right, normal);
    const double step =
        std::max(kBeside * distance, kBesideRounded * glm::length(points.position[point]));
    for (const Vec3& way : {right, -right, up, -up}) {
      for (const double lift :
           {0.0, 1.0}) {  // in a valley of a mesh, its faces' planes are covered
        moved.push_back(points.position[point] + step * (way + lift * normal));
        normals.push_back(normal);
        of_middle.push_back(lit[point]);
      }
    }
  }
  std::vector<uint8_t> beside(moved.size());
  tracer.find_lit({moved, normals}, to_light, beside);
  uint32_t speckle = 0;
  constexpr size_t kAround = 8;
  for (size_t first = 0; first < moved.size(); first += kAround) {
    bool differs = true;
    for (size_t i = first; i < first + kAround; ++i) differs = differs && beside[i] != of_middle[i];
    speckle += differs;
  }
  return speckle;
}

TEST_P(CpuStressTest, LightHasNoSpeckle) {
  for (const Case* one : stress::cases_to_run(GetParam())) {
    SCOPED_TRACE(one->name);
    const csgcore::Scene scene = one->make();
    const Solid solid(csgcore::canonical_primitives(scene), scene.model);
    const csgcore::LightTracer tracer(solid);
    for (const stress::Camera& camera : one->cameras(scene, stress::picture_size())) {
      SCOPED_TRACE(camera.name);
      Hits hits;
      csgcore::TraceStats stats;
      csgcore::trace(solid, camera.view, {}, hits, stats);
      const LitPoints points(hits, camera.view);
      const int directions = test_support::full_run() ? 64 : 4;
      for (int i = 0; i < directions; ++i) {
        const double z = 1 - (2.0 * i + 1) / directions, turn = 2.4 * i;
        const double radius = std::sqrt(1 - z * z);
        const Vec3 to_light(radius * std::cos(turn), radius * std::sin(turn), z);
        EXPECT_EQ(count_light_speckle(tracer, points, camera.view, to_light), 0u) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, CpuStressTest, testing::ValuesIn(stress::families()),
                         [](const auto& instance) { return instance.param.name; });

// --- The examples ---

std::vector<std::filesystem::path> example_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SCADRAY_EXAMPLES)) {
    const std::filesystem::path& file = entry.path();
    // csN and ccN include cut_cylinder.
    if (file.extension() == ".scad" && file.stem() != "cut_cylinder") files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(CpuExamplesTest, EqualTheOracle) {
  Family examples{"examples", {}};
  for (const std::filesystem::path& file : example_files()) {
    // The sample has one example of each kind, the full run all.
    const std::string name = file.stem().string();
    const bool is_large = name.size() > 5 && name.ends_with("00");
    examples.cases.push_back({name, [file] { return test_support::read_design(file).scene; },
                              stress::default_cameras, is_large});
  }
  EXPECT_GE(stress::cases_to_run(examples).size(), 5u);
  const std::vector<stress::Method> methods{stress::cpu_method("tiles"), stress::cpu_method("K=8"),
                                            stress::cpu_method("K=64")};
  expect_exact(stress::run_family(examples, methods, stress::kDoubleTolerance), false);
}

}  // namespace
