#include "section_hatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "picture/edge_overlay.hpp"

namespace window {
namespace {

using csgcore::Image;
using csgcore::Vec3;

constexpr double kSpacing_px = 9;
/// A line takes this share of the space from one to the next.
constexpr double kLineShare = 0.16;
/// How much a line and an outline take of the colour below them.
constexpr double kHatchStrength = 0.5, kOutlineStrength = 0.85;

/// The directions of parts 0, 1, … in the plane, as draughtsmen choose them: those of parts that
/// follow one another are far from each other. Later parts begin again, with other distances.
constexpr double kAngles_deg[] = {45, 135, 90, 0, 67.5, 157.5, 22.5, 112.5};
constexpr double kSpacings[] = {1, 1.5, 0.75};

/// Returns the vector whose product with a point is the point's phase, a whole number where one of
/// the part's lines begins.
Vec3 hatch_of(uint32_t part, const Vec3& normal, double spacing) {
  const csgcore::Mat3 frame = frame_with(normal);
  const double angle = kAngles_deg[part % std::size(kAngles_deg)] * std::numbers::pi / 180;
  const size_t round = part / std::size(kAngles_deg) % std::size(kSpacings);
  return (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]) / (spacing * kSpacings[round]);
}

/// Returns how much lines cover of the phases up to that one.
double covered_until(double phase) {
  const double whole = std::floor(phase);
  return whole * kLineShare + std::min(phase - whole, kLineShare);
}

/// A number that changes evenly over the picture.
struct Gradient {
  double at_origin, per_column, per_row;
  double at(double x, double y) const { return at_origin + per_column * x + per_row * y; }
};

/// Finds the phases at which rays meet the plane.
class PhaseFinder {
 public:
  PhaseFinder(const csgcore::View& view, const SectionPlane& plane, const Vec3& hatch)
      : position_(plane.position) {
    const csgcore::Ray rays[] = {csgcore::pixel_ray(view, 0, 0), csgcore::pixel_ray(view, 1, 0),
                                 csgcore::pixel_ray(view, 0, 1)};
    const auto along = [&](const Vec3& direction, Vec3 csgcore::Ray::*of) {
      const double first = glm::dot(direction, rays[0].*of);
      return Gradient{first, glm::dot(direction, rays[1].*of) - first,
                      glm::dot(direction, rays[2].*of) - first};
    };
    height_of_origin_ = along(plane.normal, &csgcore::Ray::origin);
    height_of_direction_ = along(plane.normal, &csgcore::Ray::direction);
    phase_of_origin_ = along(hatch, &csgcore::Ray::origin);
    phase_of_direction_ = along(hatch, &csgcore::Ray::direction);
  }

  double at(double x, double y) const {
    const double t = (position_ - height_of_origin_.at(x, y)) / height_of_direction_.at(x, y);
    return phase_of_origin_.at(x, y) + t * phase_of_direction_.at(x, y);
  }

  /// Returns the share of the pixel that lines cover.
  double coverage(uint32_t x, uint32_t y) const {
    const double phase = at(x, y);
    const double width = std::hypot(at(x + 1.0, y) - phase, at(x, y + 1.0) - phase);
    // A plane that is seen edge-on has no width that could be trusted.
    if (!(width > 0 && width < 1)) return kLineShare;
    return (covered_until(phase + width / 2) - covered_until(phase - width / 2)) / width;
  }

 private:
  double position_;
  Gradient height_of_origin_, height_of_direction_, phase_of_origin_, phase_of_direction_;
};

/// The faces of the section that each pixel shows, from the picture's shares.
class SeenFaces {
 public:
  SeenFaces(const Image& image, std::span<const uint32_t> parts)
      : width_px_(image.width_px), height_px_(image.height_px), parts_(parts) {
    const size_t pixels = image.rgb.size();
    const auto add = [&](const csgcore::PixelShare& share) {
      if (!is_section_face(share.id)) return;
      begins_.resize(share.pixel + size_t{1}, static_cast<uint32_t>(seen_.size()));
      seen_.push_back({share.pixel, share.id - kFirstSectionFace, share.share});
    };
    if (image.shares) {
      for (const csgcore::PixelShare& share : *image.shares) add(share);
    } else {
      for (uint32_t pixel = 0; pixel < pixels; ++pixel) add({pixel, image.id[pixel], 1});
    }
    begins_.resize(pixels + 1, static_cast<uint32_t>(seen_.size()));
  }

  /// Calls visit(pixel, x, y, face, share) for all that is seen.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (const csgcore::PixelShare& seen : seen_) {
      visit(seen.pixel, seen.pixel % width_px_, seen.pixel / width_px_, seen.id, seen.share);
    }
  }

  /// Whether the part whose face the pixel shows ends beside it.
  bool is_outline(uint32_t x, uint32_t y, uint32_t face) const {
    const size_t pixel = size_t{y} * width_px_ + x;
    const auto ends = [&](size_t neighbour) { return !shows(neighbour, parts_[face]); };
    return (x > 0 && ends(pixel - 1)) || (x + 1 < width_px_ && ends(pixel + 1)) ||
           (y > 0 && ends(pixel - width_px_)) || (y + 1 < height_px_ && ends(pixel + width_px_));
  }

 private:
  bool shows(size_t pixel, uint32_t part) const {
    return std::any_of(seen_.begin() + begins_[pixel], seen_.begin() + begins_[pixel + 1],
                       [&](const auto& seen) { return parts_[seen.id] == part; });
  }

  const uint32_t width_px_, height_px_;
  const std::span<const uint32_t> parts_;  // by face
  std::vector<csgcore::PixelShare> seen_;  // with faces as ids, pixel by pixel
  std::vector<uint32_t> begins_;           // by pixel: of its part of seen_; and the end
};

class SectionPainter {
 public:
  /// `parts` is by face.
  SectionPainter(Image& image, std::span<const uint32_t> parts)
      : image_(image), parts_(parts), faces_(image, parts), colors_(parts.size()) {}

  /// Finds a colour for each face's lines that is seen on most of it: what is drawn there already
  /// near its border has other colours.
  void choose_colors() {
    struct Sum {
      std::array<double, 3> all{};
      double pixels = 0;
    };
    std::vector<Sum> sums(parts_.size());
    faces_.for_each([&](uint32_t pixel, uint32_t x, uint32_t y, uint32_t face, double share) {
      if (faces_.is_outline(x, y, face)) return;
      for (size_t i = 0; i < 3; ++i) sums[face].all[i] += share * image_.rgb[pixel][i];
      sums[face].pixels += share;
    });
    for (size_t face = 0; face < sums.size(); ++face) {
      const auto& [all, pixels] = sums[face];
      if (!(pixels > 0)) continue;
      frontend::ContrastLines::Color mean{};
      for (size_t i = 0; i < 3; ++i) mean[i] = static_cast<uint8_t>(all[i] / pixels);
      colors_[face] = frontend::ContrastLines::color_on(mean);
    }
  }

  /// Where a face is seen through others, or is translucent, its lines are as faint.
  void draw(std::span<const PhaseFinder> hatches) {
    faces_.for_each([&](uint32_t pixel, uint32_t x, uint32_t y, uint32_t face, double share) {
      const double line = share * (faces_.is_outline(x, y, face)
                                       ? kOutlineStrength
                                       : kHatchStrength * hatches[parts_[face]].coverage(x, y));
      for (size_t i = 0; i < 3; ++i) {
        uint8_t& value = image_.rgb[pixel][i];
        value = static_cast<uint8_t>(std::lround(value + line * (colors_[face][i] - value)));
      }
    });
  }

 private:
  Image& image_;
  std::span<const uint32_t> parts_;
  SeenFaces faces_;
  std::vector<frontend::ContrastLines::Color> colors_;  // by face; black until they are chosen
};

}  // namespace

double hatch_spacing(const csgcore::View& view, double distance) {
  const bool is_perspective = view.projection == csgcore::Projection::kPerspective;
  const double pixel = 2 * view.half_height / view.height_px * (is_perspective ? distance : 1);
  return std::exp2(std::round(std::log2(kSpacing_px * pixel)));
}

void draw_section_faces(Image& image, const csgcore::View& view, const SectionPlane& plane,
                        std::span<const uint32_t> parts, double spacing) {
  if (parts.empty()) return;
  std::vector<PhaseFinder> hatches;  // by part
  for (uint32_t part = 0; part <= std::ranges::max(parts); ++part) {
    hatches.emplace_back(view, plane, hatch_of(part, plane.normal, spacing));
  }
  SectionPainter painter(image, parts);
  painter.choose_colors();
  painter.draw(hatches);
}

}  // namespace window
