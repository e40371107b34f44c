// Tests of the studio's light: what reaches a point is what the reference says, nothing darkens an
// open face, and a picture comes near to one by many more directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <string>

#include "checks.hpp"
#include "csgcore/light_tracer.hpp"
#include "csgcore/phong_shadows.hpp"
#include "csgcore/polyhedron.hpp"
#include "csgcore/profile.hpp"
#include "csgcore/studio.hpp"
#include "csgcore/studio_light.hpp"
#include "csgcore/tracer.hpp"
#include "reference.hpp"
#include "simd_levels.hpp"
#include "support/full_run.hpp"
#include "support/test_meshes.hpp"
#include "support/test_profiles.hpp"
#include "trace_scenes.hpp"

namespace csgcore {
namespace {

Solid solid_of(const Scene& scene) { return {canonical_primitives(scene), scene.model}; }

/// The points that a picture shows.
struct SeenPoints {
  std::vector<Vec3> position, normal;
  std::vector<uint32_t> all;
  SurfacePoints points() const { return {position, normal}; }
};

SeenPoints seen_of(const Solid& solid, const View& view) {
  Hits hits;
  TraceStats stats;
  trace(solid, view, {}, hits, stats);
  SeenPoints seen;
  for (size_t pixel = 0; pixel < hits.s.size(); ++pixel) {
    if (hits.primitive[pixel] == Hits::kMiss) continue;
    seen.position.push_back(hits.position[pixel]);
    seen.normal.push_back(hits.normal[pixel]);
  }
  seen.all.resize(seen.position.size());
  std::iota(seen.all.begin(), seen.all.end(), 0u);
  return seen;
}

std::vector<uint8_t> lit_from(const Solid& solid, const SeenPoints& seen, const Vec3& light) {
  std::vector<uint8_t> result(seen.position.size());
  LightTracer(solid).find_lit_from(seen.points(), light, result);
  return result;
}

std::vector<uint8_t> lit(const Solid& solid, const SeenPoints& seen, const Vec3& to_light) {
  std::vector<uint8_t> result(seen.all.size());
  LightTracer(solid).find_lit(seen.points(), to_light, result);
  return result;
}

/// The cosine at a face, steeper than which rounding moves a crossing too far along the ray to be
/// told from another.
constexpr double kLeastCosine = 1e-4;
/// As shares of the model's size: how far rays are moved sideways, to find what depends on
/// roundings; and along the normal, what counts as the point's own face, which is above
/// LightTracer's 2e-9.
constexpr double kSideways = 1e-9;
constexpr double kOwnFace = 1e-8;

/// Says by the reference whether points are lit, as far as it does not depend on roundings.
class LightReference {
 public:
  /// The light comes along −to_light, or from so far away from the bounds' centre.
  LightReference(const Scene& scene, const Box& bounds, const Vec3& to_light,
                 std::optional<double> distance = {})
      : view_(checks::view_of(bounds, -to_light, distance.value_or(1))),
        reference_(scene, with_one_pixel(view_, distance.has_value())) {}
  const Vec3& light() const { return view_.eye; }

  std::optional<bool> is_lit(const Vec3& position, const Vec3& normal) const {
    const Vec3 from_eye = position - view_.eye;
    const double s = glm::dot(from_eye, view_.forward);
    const bool is_perspective = view_.projection == Projection::kPerspective;
    const Vec3 direction = is_perspective ? from_eye / s : view_.forward;
    const double cosine = -glm::dot(normal, direction);
    const double size = reference_.model_size();
    if (std::abs(cosine) < kLeastCosine) return std::nullopt;
    if (cosine < 0) return false;
    // A view of one pixel has the height of 2 half_height.
    const double px = 2 * view_.half_height * (is_perspective ? s : 1);
    const double x = glm::dot(from_eye, view_.right) / px;
    const double y = -glm::dot(from_eye, view_.up) / px;
    const double least_s = s - kOwnFace * size / cosine;
    const auto by = [&](double right, double up) {
      const LongVec3 shift = LongVec3(kSideways * size * (right * view_.right + up * view_.up));
      const ReferenceHit hit = reference_.at(x, y, shift);
      return !hit.hit() || hit.s >= least_s;
    };
    const bool result = by(0, 0);
    for (const auto& [right, up] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      if (by(right, up) != result) return std::nullopt;
    }
    return result;
  }

 private:
  static View& with_one_pixel(View& view, bool is_perspective) {
    view.projection = is_perspective ? Projection::kPerspective : Projection::kOrthographic;
    view.width_px = view.height_px = 1;
    view.half_height = 1;
    return view;
  }
  View view_;
  Reference reference_;
};

TEST(LightTracer, SaysWhatTheReferenceSays) {
  std::mt19937 random(1);
  int shadows = 0, lights = 0;
  // A million points in a full run.
  const uint32_t side_px = test_support::full_run() ? 60 : 12;
  const int directions = test_support::full_run() ? 6 : 1;
  for (const char* const name :
       {"Ball", "Flush", "Twins", "Thin", "Repeated", "Spheres", "Cones", "Random10", "Random40"}) {
    SCOPED_TRACE(name);
    const Scene scene = checks::trace_scene(name).scene;
    const Solid solid = solid_of(scene);
    for (const auto& [view_name, view] : checks::trace_views(solid.bounds(), side_px, side_px)) {
      SCOPED_TRACE(view_name);
      const SeenPoints seen = seen_of(solid, view);
      for (int light = 0; light < directions; ++light) {
        const Vec3 to_light = checks::random_direction(random);
        const auto compare = [&](const LightReference& reference,
                                 const std::vector<uint8_t>& found) {
          for (const uint32_t i : seen.all) {
            const std::optional<bool> wanted = reference.is_lit(seen.position[i], seen.normal[i]);
            if (!wanted) continue;
            EXPECT_EQ(found[i] != 0, *wanted) << i;
            ++(*wanted ? lights : shadows);
          }
        };
        compare({scene, solid.bounds(), to_light}, lit(solid, seen, to_light));
        const LightReference near(scene, solid.bounds(), to_light, 0.8 * solid.bounds().diagonal());
        compare(near, lit_from(solid, seen, near.light()));
      }
    }
  }
  EXPECT_GT(lights, 1000);
  EXPECT_GT(shadows, 1000);
  std::printf("%d points in the light, %d in shadow\n", lights, shadows);
}

TEST(LightTracer, LightShinesAllAround) {
  const Solid solid = solid_of(test_support::scene_of(
      Op::kUnion, {make_polyhedron(Polyhedron::box({{-12, -12, -12}, {12, 12, -10}})),
                   make_polyhedron(Polyhedron::box({{-12, -12, 10}, {12, 12, 12}})),
                   make_polyhedron(Polyhedron::box({{-12, -12, -12}, {12, -10, 12}})),
                   make_polyhedron(Polyhedron::box({{-12, 10, -12}, {12, 12, 12}})),
                   make_polyhedron(Polyhedron::box({{-12, -12, -12}, {-10, 12, 12}})),
                   make_polyhedron(Polyhedron::box({{10, -12, -12}, {12, 12, 12}})),
                   make_sphere(1, {Mat3(1.0), {-2, 2, 1}})}));
  // On the walls of the room between these boxes.
  SeenPoints seen;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      for (int i = 0; i < 400; ++i) {
        Vec3 position(0.0), normal(0.0);
        position[axis] = 10 * side;
        normal[axis] = -side;
        position[(axis + 1) % 3] = i % 20 - 9.37;
        position[(axis + 2) % 3] = i / 20 - 9.61;
        seen.position.push_back(position);
        seen.normal.push_back(normal);
      }
    }
  }
  const Vec3 light(1, 0.5, -0.3), to_ball = Vec3(-2, 2, 1) - light;
  const std::vector<uint8_t> found = lit_from(solid, seen, light);
  int shadows = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    const Vec3 to_wall = glm::normalize(seen.position[i] - light);
    const bool is_hidden =
        glm::dot(to_wall, to_ball) > 0 && glm::length(glm::cross(to_wall, to_ball)) < 1;
    EXPECT_EQ(found[i] == 0, is_hidden) << i;
    shadows += is_hidden;
  }
  EXPECT_GT(shadows, 20);
}

/// Draws with white faces.
Image studio_picture(const Solid& solid, const View& view, const StudioSettings& settings,
                     unsigned threads = 0) {
  FrameSettings frame;
  frame.shading = Shading::kStudio;
  TraceOptions options;
  options.threads = threads;
  Image image;
  TraceStats stats;
  draw(solid, view, frame, options, image, stats);
  finish_studio(solid, view, settings, options, image, stats);
  Image by_the_same_rays;
  draw_studio(solid, view, frame, settings, options, by_the_same_rays, stats);
  EXPECT_EQ(by_the_same_rays.rgb, image.rgb);
  return image;
}

View from_above(const Box& bounds) {
  View view = checks::view_of(bounds, glm::normalize(Vec3(0.2, 0.3, -1)), 4.5 * bounds.diagonal());
  view.width_px = view.height_px = 64;
  return view;
}

/// A plate of 20 × 20 with its top at z = 0, and boxes that stand on it or are taken from it.
Solid plate(Op op, const std::vector<Box>& boxes) {
  std::vector<Primitive> primitives{
      make_polyhedron(Polyhedron::box({{-10, -10, -5}, {10, 10, 0}}))};
  for (const Box& box : boxes) primitives.push_back(make_polyhedron(Polyhedron::box(box)));
  return solid_of(test_support::scene_of(op, primitives));
}

TEST(PhongShadows, LeaveTheAmbientLight) {
  const Solid solid = plate(Op::kUnion, {{{-3, -3, 0}, {3, 3, 8}}});
  View view = from_above(solid.bounds());
  view.width_px = view.height_px = 128;
  FrameSettings frame;
  frame.shading = Shading::kPhong;
  frame.front = glm::vec3(0.5f);
  Image unhindered;
  TraceStats stats;
  draw(solid, view, frame, {}, unhindered, stats);
  Image half = unhindered, whole = unhindered;
  cast_phong_shadows(solid, view, solid.bounds(), 0.5, {}, half, stats);
  cast_phong_shadows(solid, view, solid.bounds(), 1, {}, whole, stats);
  const SeenPoints seen = seen_of(solid, view);
  const Vec3 light = phong_light(view, solid.bounds()).position_world;
  const std::vector<uint8_t> found = lit_from(solid, seen, light);
  int shadows = 0;
  for (size_t point = 0, pixel = 0; pixel < whole.rgb.size(); ++pixel) {
    if (unhindered.rgb[pixel] == unhindered.rgb.front()) continue;  // the background
    const int before = unhindered.rgb[pixel][0];
    const bool is_hidden = found[point] == 0;
    const double ambient = 255 * 0.5 * kPhongAmbient;
    EXPECT_NEAR(whole.rgb[pixel][0], is_hidden ? ambient : before, is_hidden ? 1 : 0);
    EXPECT_NEAR(half.rgb[pixel][0], is_hidden ? (before + ambient) / 2 : before, is_hidden ? 1 : 0);
    shadows += is_hidden && before > ambient + 1;
    ++point;
  }
  EXPECT_GT(shadows, 20);
}

/// Convex solids of each kind, and of parts that are flush, in a place where numbers are rounded.
std::vector<Solid> convex_solids() {
  const Vec3 z = glm::normalize(Vec3(0.2, -0.1, 1)), x = glm::normalize(glm::cross({0.3, 1, 0}, z));
  const Affine place{Mat3(x, glm::cross(z, x), z), {13, -7, 3}};
  const auto box = [&](const Box& bounds) {
    return make_polyhedron(Polyhedron::box(bounds), place);
  };
  const auto profile_of = [](const std::vector<Vec2>& points) {
    return std::make_shared<Profile>(std::vector<ProfileLoop>{test_support::polygon_loop(points)},
                                     FillRule::kNonZero);
  };
  std::mt19937 random(1);
  const std::vector<std::vector<Primitive>> all{
      {box({{-10, -10, -5}, {10, 10, 0}})},
      {make_frustum(-5, 0, 10, 10, place)},
      {make_mesh(test_support::sliced_box_parts({10, 10, 2.5}, 8, random).mesh(), place)},
      {make_extrusion(profile_of({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}), -5, 0, 1, 1,
                      place)},
      {make_revolution(profile_of({{0, -5}, {10, -5}, {10, 0}, {0, 0}}), place)},
      {box({{-10, -10, -5}, {0.3, 10, 0}}), box({{0.3, -10, -5}, {0.3 + 1e-9, 10, 0}}),
       box({{-2, -10, -5}, {10, 10, 0}})}};
  std::vector<Solid> solids;
  for (const auto& parts : all) {
    solids.push_back(solid_of(test_support::scene_of(Op::kUnion, parts)));
  }
  return solids;
}

TEST(Studio, TakesNothingFromOpenFaces) {
  const std::vector<Solid> solids = convex_solids();
  for (size_t i = 0; i < solids.size(); ++i) {
    SCOPED_TRACE(i);
    const Solid& solid = solids[i];
    for (const Vec3& direction : {Vec3(0.2, 0.3, -1), Vec3(-1, 0.5, -0.3), Vec3(0.1, 1, 0.6)}) {
      View view = checks::view_of(solid.bounds(), glm::normalize(direction),
                                  4.5 * solid.bounds().diagonal());
      view.width_px = view.height_px = 64;
      const Image image = studio_picture(solid, view, {.edges = 0});
      const Image colors = studio_picture(solid, view, {0, 0, 0});
      EXPECT_EQ(image.rgb, colors.rgb);
    }
  }
}

TEST(Studio, TakesNothingFromWhatIsTranslucent) {
  Scene scene = checks::trace_scene("Spheres").scene;
  const auto darker = [&](float alpha) {
    for (Primitive& primitive : scene.primitives) primitive.color = Color{1, 1, 1, alpha};
    const Solid solid = solid_of(scene);
    const View view = from_above(solid.bounds());
    return studio_picture(solid, view, {.edges = 0}).rgb !=
           studio_picture(solid, view, {0, 0, 0}).rgb;
  };
  EXPECT_TRUE(darker(1));
  EXPECT_FALSE(darker(0.5f));
}

TEST(Studio, WallsLightEachOther) {
  const StudioLight light = studio_light(from_above({{-1, -1, -1}, {1, 1, 1}}));
  const auto sky = [&](double open) {
    return studio_shade(light, Vec3(0, 0, 1), open, 0) / studio_shade(light, Vec3(0, 0, 1), 1, 0);
  };
  EXPECT_EQ(sky(0), 0);
  EXPECT_EQ(sky(1), 1);
  EXPECT_NEAR(sky(0.5), 2.0 / 3, 1e-12);
  // Instead of the rest of the sky a point sees half of walls that are as bright as it is.
  for (const double open : {0.1, 0.3, 0.9}) {
    EXPECT_NEAR(sky(open), open + (1 - open) * sky(open) / 2, 1e-12);
  }
}

TEST(Studio, DarkensWhatIsHidden) {
  const Solid open = plate(Op::kUnion, {});
  const View view = from_above(open.bounds());
  const Image of_open = studio_picture(open, view, {.edges = 0});
  const auto darkened = [&](const Solid& solid, const StudioSettings& settings, Vec3 at) {
    // The pixel that sees this point of the plate.
    at -= view.eye;
    const double s = glm::dot(at, view.forward);
    const double scale = 0.5 * view.height_px / view.half_height / s;
    const auto x = static_cast<size_t>(0.5 * view.width_px + scale * glm::dot(at, view.right));
    const auto y = static_cast<size_t>(0.5 * view.height_px - scale * glm::dot(at, view.up));
    const size_t pixel = y * view.width_px + x;
    return of_open.rgb[pixel][0] - studio_picture(solid, view, settings).rgb[pixel][0];
  };
  const StudioLight light = studio_light(view);
  // A wall that stands between the plate's middle and the key light, but not over it.
  const Vec3 to_light = glm::normalize(Vec3(light.key.x, light.key.y, 0));
  const Vec3 wall = 4.0 * to_light;
  const Solid walled = plate(Op::kUnion, {{wall - Vec3(1, 1, 0), wall + Vec3(1, 1, 6)}});
  const StudioSettings shadows{.occlusion = 0, .edges = 0}, occlusion{.shadows = 0, .edges = 0};
  EXPECT_GT(darkened(walled, shadows, Vec3(0.0)), 45);
  EXPECT_EQ(darkened(walled, shadows, -1.9 * wall), 0);
  EXPECT_GT(darkened(walled, occlusion, 0.6 * wall), 3);
  EXPECT_LT(darkened(walled, occlusion, -1.9 * wall), darkened(walled, occlusion, 0.6 * wall));
}

TEST(Studio, DrawsLinesWhereFacesMeet) {
  const Solid solid = plate(Op::kDifference, {{{-4, -4, -2}, {4, 4, 1}}});
  const View view = from_above(solid.bounds());
  const Image with = studio_picture(solid, view, {.shadows = 0, .occlusion = 0});
  const Image without = studio_picture(solid, view, {0, 0, 0});
  Hits hits;
  TraceStats stats;
  trace(solid, view, {}, hits, stats);
  int lines = 0;
  for (uint32_t y = 1; y + 1 < view.height_px; ++y) {
    for (uint32_t x = 1; x + 1 < view.width_px; ++x) {
      const size_t pixel = size_t{y} * view.width_px + x;
      const bool is_dark = with.rgb[pixel] != without.rgb[pixel];
      bool is_inside = true;  // of a face
      for (const size_t other :
           {pixel - 1, pixel + 1, pixel - view.width_px, pixel + view.width_px}) {
        const bool is_same = hits.primitive[other] == hits.primitive[pixel] &&
                             (hits.primitive[pixel] == Hits::kMiss ||
                              glm::dot(hits.normal[other], hits.normal[pixel]) > 0.9);
        is_inside = is_inside && is_same;
      }
      if (is_inside) {
        EXPECT_FALSE(is_dark) << x << ' ' << y;
      } else if (is_dark) {
        EXPECT_LT(with.rgb[pixel][1], without.rgb[pixel][1] / 2);
        ++lines;
      }
    }
  }
  EXPECT_GT(lines, 100);
}

/// How much darker lines make the picture: by pixel, from 0 to 1.
std::vector<double> lines_of(const Solid& solid, const View& view, uint32_t block_px = 1) {
  StudioSettings settings{.shadows = 0, .occlusion = 0};
  settings.block_px = block_px;
  const Image with = studio_picture(solid, view, settings);
  const Image without = studio_picture(solid, view, {0, 0, 0});
  std::vector<double> result;
  for (size_t pixel = 0; pixel < with.rgb.size(); ++pixel) {
    result.push_back(1 - double(with.rgb[pixel][1]) / without.rgb[pixel][1]);
  }
  return result;
}

TEST(Studio, LinesInCreasesAreEven) {
  const Solid solid = solid_of(test_support::scene_of(Op::kUnion, {make_frustum(-5, 5, 10, 10)}));
  View view = checks::view_of(solid.bounds(), glm::normalize(Vec3(0.1, 1, -1)),
                              4.5 * solid.bounds().diagonal());
  view.width_px = view.height_px = 128;
  const std::vector<double> lines = lines_of(solid, view);
  for (uint32_t x = 54; x < 74; ++x) {
    int dark = 0;
    for (uint32_t y = 0; y < view.height_px; ++y)
      dark += lines[size_t{y} * view.width_px + x] > 0.6;
    // The far rim and the lower one end before the background, the near one meets the side.
    EXPECT_EQ(dark, 1 + 1 + 2) << x;
  }
}

TEST(Studio, LinesAreAsWideInFinerPictures) {
  const Solid solid = plate(Op::kDifference, {{{-4, -4, -2}, {4, 4, 1}}});
  const auto darkness = [&](uint32_t block_px) {
    View view = from_above(solid.bounds());
    view.width_px = view.height_px = 64 * block_px;
    const std::vector<double> lines = lines_of(solid, view, block_px);
    return std::accumulate(lines.begin(), lines.end(), 0.0) / (block_px * block_px);
  };
  EXPECT_NEAR(darkness(4), darkness(2), 0.05 * darkness(2));
  EXPECT_NEAR(darkness(8), darkness(2), 0.05 * darkness(2));
}

TEST(Studio, LinesInCreasesGrowWithTheAngle) {
  // Where the sides of a prism meet, in the middle of a picture of them.
  const auto darkest = [](int sides) {
    const Solid solid = solid_of(test_support::scene_of(
        Op::kUnion, {make_polyhedron(Polyhedron::frustum(-5, 5, 10, 10, sides))}));
    View view = checks::view_of(solid.bounds(), glm::normalize(Vec3(1, 0.1, 0)),
                                4.5 * solid.bounds().diagonal());
    view.width_px = view.height_px = 64;
    const std::vector<double> lines = lines_of(solid, view);
    const auto middle = lines.begin() + 32 * 64;
    return *std::max_element(middle + 24, middle + 40);
  };
  EXPECT_EQ(darkest(24), 0);
  EXPECT_GT(darkest(15), 0.1);
  EXPECT_LT(darkest(15), 0.6);
  EXPECT_GT(darkest(8), 0.65);
}

/// Occlusion of each pixel by this many directions of its own.
Image occluded_picture(const Solid& solid, const View& view, uint32_t directions) {
  Image image = studio_picture(solid, view, {0, 0, 0});
  Hits hits;
  TraceStats stats;
  trace(solid, view, {}, hits, stats);
  const SeenPoints seen = seen_of(solid, view);
  std::vector<double> all(seen.all.size()), open(seen.all.size());
  for (uint32_t i = 0; i < directions; ++i) {
    const double z = 1 - (2.0 * i + 1) / directions, turn = 2.399963229728653 * i;
    const double radius = std::sqrt(1 - z * z);
    const Vec3 direction(radius * std::cos(turn), radius * std::sin(turn), z);
    const std::vector<uint8_t> found = lit(solid, seen, direction);
    for (const uint32_t point : seen.all) {
      const double cosine = std::max(0.0, glm::dot(seen.normal[point], direction));
      all[point] += cosine;
      open[point] += found[point] * cosine;
    }
  }
  const StudioLight light = studio_light(view);
  size_t point = 0;
  for (size_t pixel = 0; pixel < hits.s.size(); ++pixel) {
    if (hits.primitive[pixel] == Hits::kMiss) continue;
    const Vec3& normal = hits.normal[pixel];
    const double shade = studio_shade(light, normal, open[point] / all[point], 1);
    for (uint8_t& channel : image.rgb[pixel]) {
      channel = static_cast<uint8_t>(channel * shade / studio_shade(light, normal, 1, 1) + 0.5);
    }
    ++point;
  }
  return image;
}

/// The mean of how far the pixels of the solid are from those of the wanted picture, in levels.
double mean_error(const Image& image, const Image& wanted, const Image& unlit) {
  double sum = 0;
  int count = 0;
  for (size_t pixel = 0; pixel < wanted.rgb.size(); ++pixel) {
    if (unlit.rgb[pixel] == unlit.rgb.front()) continue;  // the background
    sum += std::abs(image.rgb[pixel][0] - wanted.rgb[pixel][0]);
    ++count;
  }
  return sum / count;
}

TEST(Studio, ComesNearToManyDirections) {
  std::vector<const char*> scenes{"Ball", "Flush", "Repeated", "Spheres", "Cones", "Random40"};
  scenes.resize(test_support::sample_size(6));
  for (const char* const name : scenes) {
    SCOPED_TRACE(name);
    const Solid solid = solid_of(checks::trace_scene(name).scene);
    View view = checks::view_of(solid.bounds(), glm::normalize(Vec3(-1, 2, -1.5)),
                                4.5 * solid.bounds().diagonal());
    view.width_px = view.height_px = 192;
    const Image unlit = studio_picture(solid, view, {0, 0, 0});
    const Image wanted = occluded_picture(solid, view, test_support::full_run() ? 4096 : 1024);
    for (const bool shares_light : {true, false}) {
      StudioSettings settings{.shadows = 0, .edges = 0};
      settings.directions = shares_light ? kFewDirections : 256;
      settings.shares_light = shares_light;
      const Image image = studio_picture(solid, view, settings);
      EXPECT_LT(mean_error(image, wanted, unlit), shares_light ? 1.4 : 1);
    }
  }
}

TEST(Studio, AsksMoreDirectionsWhereLightIsNoisy) {
  std::vector<Box> posts;
  for (double x = -9; x <= 9; x += 1.5) {
    for (double y = -9; y <= 9; y += 1.5) posts.push_back({{x, y, 0}, {x + 0.7, y + 0.7, 4}});
  }
  const Solid quiet = plate(Op::kUnion, {{{-3, -3, 0}, {3, 3, 1}}}),
              noisy = plate(Op::kUnion, posts);
  for (const Solid* solid : {&quiet, &noisy}) {
    const View view = from_above(solid->bounds());
    const auto picture = [&](uint32_t directions, double largest_noise) {
      StudioSettings settings{.shadows = 0, .edges = 0};
      settings.directions = directions;
      settings.largest_noise = largest_noise;
      return studio_picture(*solid, view, settings).rgb;
    };
    const auto half = picture(72, 0), all = picture(144, 1e-9);
    EXPECT_TRUE(half != all);
    EXPECT_TRUE(picture(144, 1) == half);
    EXPECT_TRUE(picture(144, 0.031) == (solid == &quiet ? half : all));
  }
}

/// A face of a few pixels has no neighbours that could ask all directions for it.
TEST(Studio, LightsSmallFacesAsWell) {
  std::vector<Primitive> primitives{
      make_polyhedron(Polyhedron::box({{-10, -10, -5}, {10, 10, 0}}))};
  for (int x = -9; x <= 9; x += 2) {
    for (int y = -9; y <= 9; y += 2)
      primitives.push_back(make_sphere(0.7, {Mat3(1.0), {x, y, 0.3}}));
  }
  const Solid solid = solid_of(test_support::scene_of(Op::kUnion, primitives));
  const View view = from_above(solid.bounds());
  const Image unlit = studio_picture(solid, view, {0, 0, 0});
  const Image wanted = occluded_picture(solid, view, 1024);
  StudioSettings settings{.shadows = 0, .edges = 0};
  settings.directions = kFewDirections;
  EXPECT_LT(mean_error(studio_picture(solid, view, settings), wanted, unlit), 6);
}

TEST(Studio, SharedLightKeepsTheEdgesOfShadows) {
  // Posts that stand close: their shadows end everywhere.
  std::vector<Box> posts;
  for (int x = -9; x <= 9; x += 3) {
    for (int y = -9; y <= 9; y += 3)
      posts.push_back({{x - 0.5, y - 0.5, 0}, {x + 0.5, y + 0.5, 3}});
  }
  const Solid solid = plate(Op::kUnion, posts);
  const View view = from_above(solid.bounds());
  const Image unlit = studio_picture(solid, view, {0, 0, 0});
  StudioSettings settings{.occlusion = 0, .edges = 0};
  settings.shares_light = false;
  settings.directions = 1024;
  const Image wanted = studio_picture(solid, view, settings);
  EXPECT_GT(mean_error(unlit, wanted, unlit), 20);
  settings.shares_light = true;
  settings.directions = kFewDirections;
  EXPECT_LT(mean_error(studio_picture(solid, view, settings), wanted, unlit), 1.5);
}

TEST(Studio, SharesLightWithinBlocks) {
  const Solid solid = plate(Op::kUnion, {{{-3, -3, 0}, {3, 3, 4}}});
  const View view = from_above(solid.bounds());
  const auto uneven_blocks = [&](uint32_t block_px) {
    StudioSettings settings{.shadows = 0, .edges = 0};
    settings.shares_light = false;
    settings.block_px = block_px;
    const Image image = studio_picture(solid, view, settings);
    int count = 0;
    for (uint32_t y = 0; y < view.height_px; y += 2) {
      for (uint32_t x = 0; x < view.width_px; x += 2) {
        const auto* const pixel = &image.rgb[size_t{y} * view.width_px + x];
        count += pixel[0] != pixel[1] || pixel[0] != pixel[view.width_px];
      }
    }
    return count;
  };
  EXPECT_GT(uneven_blocks(1), 2 * uneven_blocks(2));
}

TEST(Studio, ThreadsAndInstructionSetsDoNotMatter) {
  for (const char* const name : {"Random10", "Cones"}) {
    const Solid solid = solid_of(checks::trace_scene(name).scene);
    View view = checks::view_of(solid.bounds(), glm::normalize(Vec3(-1, 2, -1.5)),
                                4.5 * solid.bounds().diagonal());
    view.width_px = 50;
    view.height_px = 41;
    const Image wanted = studio_picture(solid, view, {}, 1);
    EXPECT_EQ(studio_picture(solid, view, {}, 3).rgb, wanted.rgb);
    checks::for_each_simd_level(
        [&](SimdLevel) { EXPECT_EQ(studio_picture(solid, view, {}, 1).rgb, wanted.rgb); });
  }
}

}  // namespace
}  // namespace csgcore
