#include "picture/edge_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace frontend {

MeshLookup::MeshLookup(const ImportedDesign& design) : facets_(design.meshes) {
  for (const csgcore::Primitive& primitive : design.scene.primitives) {
    if (!primitive.mesh() && !facets_.contains(primitive.polyhedron())) continue;
    if (primitives_.empty()) primitives_.resize(design.primitive_nodes);
    primitives_.at(primitive.id) = &primitive;
  }
}

namespace {

using csgcore::Image;
using csgcore::Vec3;
using csgcore::View;

/// Depths are floats, and a renderer's may be off by a few ulp.
constexpr double kSameDepth = 1e-5;  // as a share of the depth
/// The relative error of a slope that is computed from a float normal at a grazing angle.
constexpr double kSlopeError = 1e-3;
/// From one pixel to the next, the normal of a sphere turns at most 1 + √2 times as far as in the
/// steps before and after. Where it turns farther, the surface has a crease.
constexpr float kMostGrowth = 3;
/// Creases of less than this angle (radians) are not visible.
constexpr float kLeastBend = 0.01f;

/// Finds edges between neighbours in a row or a column.
class EdgeFinder {
 public:
  EdgeFinder(const Image& image, const View& view, const MeshLookup& meshes)
      : image_(image),
        meshes_(meshes),
        view_(view),
        width_(image.width_px),
        height_(image.height_px),
        pixel_(2 * view.half_height / view.height_px),
        is_perspective_(view.projection == csgcore::Projection::kPerspective),
        is_edge_(image.rgb.size(), 0) {}

  /// Returns for each pixel whether an edge is drawn there.
  std::vector<uint8_t> find() {
    for (std::size_t row = 0; row < height_; ++row) {
      look_along(row * width_, 1, width_, view_.right, [&](std::size_t i) {
        return direction(static_cast<double>(i), static_cast<double>(row));
      });
    }
    for (std::size_t column = 0; column < width_; ++column) {
      look_along(column, width_, height_, -view_.up, [&](std::size_t i) {
        return direction(static_cast<double>(column), static_cast<double>(i));
      });
    }
    return std::move(is_edge_);
  }

 private:
  Vec3 direction(double x_px, double y_px) const {
    return csgcore::pixel_ray(view_, x_px, y_px).direction;
  }
  bool is_hit(std::size_t pixel) const { return std::isfinite(image_.z[pixel]); }
  /// Returns whether the pixel shows a surface whose edges are not those of a mesh.
  bool is_smooth(std::size_t pixel) const {
    return is_hit(pixel) && !meshes_.primitive_of(image_.id[pixel]);
  }

  /// Returns the depth that is linear over a plane on the screen: 1/z in a perspective view, else
  /// z.
  double linear_depth(std::size_t pixel) const {
    const double z = image_.z[pixel];
    return is_perspective_ ? 1 / z : z;
  }
  /// Returns how much the linear depth grows to the next pixel, on the plane that touches the
  /// surface. `step` is the direction to that pixel in the world.
  double slope(std::size_t pixel, const Vec3& ray, const Vec3& step) const {
    const Vec3 normal(image_.normal[pixel]);
    const double along_step = pixel_ * glm::dot(normal, step);
    const double along_ray = glm::dot(normal, ray);
    return is_perspective_ ? along_step / (along_ray * image_.z[pixel]) : -along_step / along_ray;
  }
  /// Returns whether the surface continues from one pixel to its neighbour without a gap. Then its
  /// linear depth grows by a slope between those of the two pixels, as the surface between them
  /// bends to one side, or once.
  bool is_continuous(std::size_t a, double slope_a, std::size_t b, double slope_b) const {
    const double growth = linear_depth(b) - linear_depth(a);
    const double size =
        std::max(std::abs(linear_depth(a)), is_perspective_ ? 0 : view_.half_height);
    const double error =
        kSameDepth * size + kSlopeError * std::max(std::abs(slope_a), std::abs(slope_b));
    const auto [least, most] = std::minmax(slope_a, slope_b);
    return growth >= least - error && growth <= most + error;
  }

  /// Looks at `count` pixels from `first` on, at distances of `stride`; ray(i) is the direction of
  /// the i-th.
  template <typename Ray>
  void look_along(std::size_t first, std::size_t stride, std::size_t count, const Vec3& step,
                  Ray ray) {
    // turns_[i + 1] is how far the normal turns from pixel i to the next; below 0: the surface ends
    // there.
    turns_.assign(count + 2, -1);
    double slope_a = is_hit(first) ? slope(first, ray(0), step) : 0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const std::size_t a = first + i * stride;
      const std::size_t b = a + stride;
      const double slope_b = is_hit(b) ? slope(b, ray(i + 1), step) : 0;
      if (is_hit(a) && is_hit(b) && is_continuous(a, slope_a, b, slope_b)) {
        turns_[i + 1] = glm::distance(image_.normal[a], image_.normal[b]);
      } else if (is_hit(a) || is_hit(b)) {
        const std::size_t nearer = image_.z[a] <= image_.z[b] ? a : b;  // a miss is at infinity
        if (is_smooth(nearer)) is_edge_[nearer] = 1;
      }
      slope_a = slope_b;
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const float around = std::max({turns_[i], turns_[i + 2], 0.0f});
      const std::size_t pixel = first + i * stride;
      if (turns_[i + 1] > kMostGrowth * around + kLeastBend &&
          (is_smooth(pixel) || is_smooth(pixel + stride))) {
        is_edge_[pixel] = 1;
      }
    }
  }

  const Image& image_;
  const MeshLookup& meshes_;
  const View& view_;
  std::size_t width_, height_;
  double pixel_;
  bool is_perspective_;
  std::vector<uint8_t> is_edge_;
  std::vector<float> turns_;
};

}  // namespace

ContrastLines::Color ContrastLines::color_on(const Color& color) {
  // Relative luminance of sRGB, by the definition of WCAG 2.2.
  constexpr std::array<double, 3> kShares{0.2126, 0.7152, 0.0722};
  // Below it, (luminance + 0.05) / 0.05 is less than 3, and 1.05 / (luminance + 0.05) at least 7.
  constexpr double kDark = 0.1;
  double luminance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = color[i] / 255.0;
    luminance +=
        kShares[i] * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  const uint8_t line = luminance < kDark ? 255 : 0;
  return {line, line, line};
}

void draw_edges(Image& image, const View& view, const ColorScheme& scheme, const MeshLookup& meshes,
                const ContrastLines* contrast) {
  const std::vector<uint8_t> is_edge = EdgeFinder(image, view, meshes).find();
  const Rgb& background = scheme.background;
  const std::array<unsigned, 3> target = {background.r, background.g, background.b};
  for (std::size_t pixel = 0; pixel < is_edge.size(); ++pixel) {
    if (is_edge[pixel] == 0) continue;
    if (contrast) {
      image.rgb[pixel] = contrast->at(pixel);
      continue;
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
      uint8_t& value = image.rgb[pixel][channel];
      value = static_cast<uint8_t>((value + target[channel]) / 2);
    }
  }
}

}  // namespace frontend
