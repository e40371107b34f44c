// Tests translucent parts in depth order (--translucency=depth) against what each ray meets by the
// formulas of balls and boxes, sorted.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "csgcore/tracer.hpp"
#include "frontend/camera.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/render_settings.hpp"
#include "render/prepared_scene.hpp"
#include "render/solid_renderer.hpp"

namespace frontend {
namespace {

using csgcore::Image;
using csgcore::Vec3;

struct Part {
  Vec3 center;
  double size;  // radius, or half of the side
  bool is_ball;
  std::array<double, 4> color;

  std::string text() const {
    std::string result = "color([";
    for (const double channel : color) result += std::to_string(channel) + ",";
    result.back() = ']';
    result += ") multmatrix([[1,0,0," + std::to_string(center.x) + "],[0,1,0," +
              std::to_string(center.y) + "],[0,0,1," + std::to_string(center.z) + "],[0,0,0,1]]) ";
    return result + (is_ball ? "sphere(r = " + std::to_string(size) + ");"
                             : "cube(size = " + std::to_string(2 * size) + ", center = true);");
  }

  struct Crossing {
    double t;
    Vec3 normal;
  };
  /// Returns where a ray enters and leaves the part; nothing if it misses it.
  std::vector<Crossing> crossings(const Vec3& origin, const Vec3& direction) const {
    if (is_ball) {
      const Vec3 from = origin - center;
      const double a = glm::dot(direction, direction), b = glm::dot(from, direction);
      const double root = b * b - a * (glm::dot(from, from) - size * size);
      if (root <= 0) return {};
      std::vector<Crossing> result;
      for (const double sign : {-1.0, 1.0}) {
        const double t = (-b + sign * std::sqrt(root)) / a;
        result.push_back({t, (from + t * direction) / size});
      }
      return result;
    }
    Crossing enter{-1e9, Vec3(0.0)}, leave{1e9, Vec3(0.0)};
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1 / direction[axis];
      const double sign = inverse > 0 ? 1 : -1;
      const double near = (center[axis] - sign * size - origin[axis]) * inverse;
      const double far = (center[axis] + sign * size - origin[axis]) * inverse;
      Vec3 normal(0.0);
      normal[axis] = sign;
      if (near > enter.t) enter = {near, -normal};
      if (far < leave.t) leave = {far, normal};
    }
    if (enter.t >= leave.t) return {};
    return {enter, leave};
  }
};

/// OpenSCAD's light.
std::array<double, 3> lit(const Part& part, const Vec3& normal, const csgcore::View& view) {
  const double light =
      (-glm::dot(normal, view.right) + glm::dot(normal, view.up) - glm::dot(normal, view.forward)) /
      std::sqrt(3.0);
  const double shade = 0.2 + std::abs(light);
  std::array<double, 3> result;
  for (size_t i = 0; i < 3; ++i) result[i] = std::min(255.0, 255 * shade * part.color[i]);
  return result;
}

std::array<double, 3> color_by_depth(const std::vector<Part>& parts, const csgcore::View& view,
                                     uint32_t x, uint32_t y, const Rgb& background) {
  struct Surface {
    double t, alpha;
    std::array<double, 3> color;
  };
  std::vector<Surface> surfaces;
  const csgcore::Ray ray = csgcore::pixel_ray(view, x, y);
  for (const Part& part : parts) {
    for (const Part::Crossing& crossing : part.crossings(ray.origin, ray.direction)) {
      surfaces.push_back({crossing.t, part.color[3], lit(part, crossing.normal, view)});
    }
  }
  std::sort(surfaces.begin(), surfaces.end(),
            [](const Surface& a, const Surface& b) { return a.t > b.t; });
  std::array<double, 3> color{double(background.r), double(background.g), double(background.b)};
  for (const Surface& surface : surfaces) {
    for (size_t i = 0; i < 3; ++i) color[i] += surface.alpha * (surface.color[i] - color[i]);
  }
  return color;
}

std::string text_of(const std::vector<Part>& parts) {
  std::string text;
  for (const Part& part : parts) text += part.text();
  return text;
}

class DepthOrder : public testing::TestWithParam<Technique> {
 protected:
  DepthOrder() {
    settings_.technique = GetParam();
    settings_.translucency = Translucency::kDepth;
    CameraOptions options;
    options.width_px = 121;
    options.height_px = 97;
    options.projection = csgcore::Projection::kPerspective;
    Camera camera;
    camera.distance = 60;
    view_ = make_view(camera, options);
  }

  Image draw(const std::string& text) {
    const auto scene = std::make_shared<csgcore::Scene>(import_design(parse(text, "a.csg")).scene);
    RenderStats stats;
    return PreparedScene(scene).draw(*make_cpu_renderer(), {view_, settings_, stats});
  }

  RenderSettings settings_;
  csgcore::View view_;
};

TEST_P(DepthOrder, IsThatOfTheSurfacesOfEachRay) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    const double any = std::uniform_real_distribution<>(low, high)(random);
    return std::round(64 * any) / 64;  // which the design's text has in full
  };
  for (int design = 0; design < 12; ++design) {
    std::vector<Part> parts;
    constexpr double kAlphas[] = {0.2, 0.5, 0.8, 0, 1, 0.4};
    for (int i = 0; i < 9; ++i) {
      parts.push_back({Vec3(between(-6, 6), between(-6, 6), between(-6, 6)),
                       between(1, 4),
                       i % 2 == 0,
                       {between(0, 1), between(0, 1), between(0, 1), kAlphas[i % 6]}});
    }
    const Image image = draw(text_of(parts));
    size_t wrong = 0;
    for (uint32_t y = 0; y < view_.height_px; ++y) {
      for (uint32_t x = 0; x < view_.width_px; ++x) {
        const auto wanted = color_by_depth(parts, view_, x, y, settings_.scheme.background);
        for (size_t i = 0; i < 3; ++i) {
          const double seen = image.rgb[size_t{y} * view_.width_px + x][i];
          if (std::abs(seen - wanted[i]) > 1.5) ++wrong;
        }
      }
    }
    EXPECT_EQ(wrong, 0u) << "of design " << design;
  }
}

/// Of so many that the furthest are dropped before all are known.
TEST_P(DepthOrder, OfManyLayersIsTheSame) {
  std::mt19937 random(5);
  const auto number = [&](int low, int high) {
    return (low + static_cast<int>(random() % unsigned(64 * (high - low))) / 64.0);
  };
  std::vector<Part> parts;
  for (int i = 0; i < 150; ++i) {
    parts.push_back({Vec3(number(-2, 2), number(-2, 2), number(-9, 9)),
                     number(2, 4),
                     i % 2 == 0,
                     {number(0, 1), number(0, 1), number(0, 1), i % 3 == 0 ? 0.75 : 0.0625}});
  }
  const Image image = draw(text_of(parts));
  size_t wrong = 0;
  for (uint32_t y = 0; y < view_.height_px; ++y) {
    for (uint32_t x = 0; x < view_.width_px; ++x) {
      const auto wanted = color_by_depth(parts, view_, x, y, settings_.scheme.background);
      for (size_t i = 0; i < 3; ++i) {
        wrong += std::abs(image.rgb[size_t{y} * view_.width_px + x][i] - wanted[i]) > 1.5;
      }
    }
  }
  // Where surfaces cross, they coincide for a pixel.
  EXPECT_LT(wrong, image.rgb.size() / 100);
  for (int permutation = 0; permutation < 3; ++permutation) {
    std::shuffle(parts.begin(), parts.end(), random);
    EXPECT_EQ(draw(text_of(parts)).rgb, image.rgb);
  }
}

TEST_P(DepthOrder, DoesNotDependOnTheFiles) {
  // Whole numbers make faces coincide and parts touch.
  std::mt19937 random(11);
  const auto below = [&](int end) { return static_cast<int>(random() % unsigned(end)); };
  size_t differing = 0;
  for (int design = 0; design < 10; ++design) {
    std::vector<std::string> parts;
    for (int i = 0; i < 8; ++i) {
      const Part part{Vec3(below(9) - 4, below(9) - 4, below(9) - 4),
                      1.0 + below(4),
                      i % 4 == 3,
                      {below(3) / 2.0, below(3) / 2.0, below(3) / 2.0, 0.25 * (1 + below(3))}};
      parts.push_back(i % 4 == 2 ? "difference() { " + part.text() + " sphere(r = 2.5); }"
                                 : part.text());
    }
    parts.push_back("cube(size = [3, 3, 3]);");  // opaque
    parts.push_back("%cube(size = [2, 9, 2], center = true);");
    const auto text = [&] {
      std::string all;
      for (const std::string& part : parts) all += part;
      return all;
    };
    const Image image = draw(text());
    for (int permutation = 0; permutation < 4; ++permutation) {
      std::shuffle(parts.begin(), parts.end(), random);
      EXPECT_EQ(draw(text()).rgb, image.rgb) << "design " << design;
      settings_.translucency = Translucency::kFile;
      differing += draw(text()).rgb != image.rgb;
      settings_.translucency = Translucency::kDepth;
    }
  }
  EXPECT_EQ(differing, 40u) << "in the file's order it does";
}

TEST_P(DepthOrder, AHighlightLiesOverItsOwnBodyAndBehindWhatIsInFront) {
  const auto middle = [&](const std::string& text) {
    return draw(text).rgb[size_t{view_.height_px / 2} * view_.width_px + view_.width_px / 2];
  };
  const auto plain = middle("cube(size = 6, center = true);");
  const auto marked = middle("#cube(size = 6, center = true);");
  EXPECT_NE(marked, plain);
  settings_.translucency = Translucency::kFile;
  EXPECT_EQ(middle("#cube(size = 6, center = true);"), marked);
  settings_.translucency = Translucency::kDepth;
  const std::string around = "cube(size = 12, center = true);";
  EXPECT_EQ(middle("#cube(size = 6, center = true); " + around), middle(around));
}

INSTANTIATE_TEST_SUITE_P(, DepthOrder, testing::Values(Technique::kTiles, Technique::kCells),
                         [](const auto& technique) {
                           return technique.param == Technique::kTiles ? "Tiles" : "Cells";
                         });

}  // namespace
}  // namespace frontend
