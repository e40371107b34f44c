#include "csgcore/changed_areas.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "csgcore/geometry.hpp"
#include "screen/screen_extents.hpp"
#include "tree/subtree_boxes.hpp"

namespace csgcore {
namespace {

/// If more primitives than this have changed, one area holds all of them: finding overlaps among
/// their rectangles takes time that grows with the square of their number.
constexpr size_t kManyPrimitives = 64;

PixelArea whole_picture(const View& view) { return {0, 0, view.width_px, view.height_px}; }

uint64_t size_of(const PixelArea& area) { return uint64_t{area.width} * area.height; }

PixelArea hull(const PixelArea& a, const PixelArea& b) {
  const uint32_t left = std::min(a.x, b.x), top = std::min(a.y, b.y);
  return {left, top, std::max(a.x + a.width, b.x + b.width) - left,
          std::max(a.y + a.height, b.y + b.height) - top};
}

bool overlap(const PixelArea& a, const PixelArea& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Returns whether the two areas should be merged.
bool belong_together(const PixelArea& a, const PixelArea& b) {
  return overlap(a, b) || size_of(hull(a, b)) <= size_of(a) + size_of(b);
}

/// Merges areas until no two overlap. No two areas before `next` belong together.
void merge(std::vector<PixelArea>& areas) {
  for (size_t next = 1; next < areas.size();) {
    const auto at = areas.begin() + static_cast<long>(next);
    const auto other = std::find_if(
        areas.begin(), at, [&](const PixelArea& area) { return belong_together(area, *at); });
    if (other == at) {
      ++next;
      continue;
    }
    *other = hull(*other, *at);
    areas.erase(at);
    next = std::max<size_t>(1, static_cast<size_t>(other - areas.begin()));
  }
}

/// Finds the areas of primitives on the screen.
class Screen {
 public:
  /// `bounds` are those of the solids, outside of which nothing is seen.
  Screen(const View& view, const Box& bounds) : view_(view), frame_(frame_rays(view, bounds)) {
    // The margin is far larger than the rounding of a ray, and far smaller than a pixel.
    const double margin = cell_overlap(bounds);
    bounds_ = {bounds.min - margin, bounds.max + margin};
  }

  /// Returns an area that has every pixel with a point through which a ray may meet the primitive
  /// within the solid's bounds.
  std::optional<PixelArea> area_of(const CanonicalPrimitive& primitive) const {
    const Box box = intersection(primitive.bounds, bounds_);
    if (box.empty()) return std::nullopt;
    const Extent extents[] = {extent_of(primitive), extent_of(box)};
    const uint32_t indices[] = {0, 1};
    Extent on_screen[2];
    find_screen_extents(extents, indices, frame_, {false}, on_screen);
    const PixelArea area =
        intersection(pixels_of(on_screen[0], view_), pixels_of(on_screen[1], view_));
    return area.empty() ? std::nullopt : std::optional(area);
  }

 private:
  static Extent extent_of(const CanonicalPrimitive& primitive) {
    return csgcore::extent_of(primitive);
  }
  static Extent extent_of(const Box& box) {
    CanonicalPrimitive of_box;
    of_box.bounds = box;
    return csgcore::extent_of(of_box);
  }

  const View& view_;
  FrameRays frame_;
  Box bounds_;
};

/// Returns, by index, whether the solid's list names the primitive.
std::vector<uint8_t> named(const Solid& solid) {
  std::vector<uint8_t> result(solid.primitives().size());
  for (const BlistTest& test : solid.list().tests) result[test.primitive] = 1;
  return result;
}

}  // namespace

std::vector<PixelArea> changed_areas(const Solid& before, const Solid& after, const SceneEdit& edit,
                                     TreeEdit tree_edit, const View& view,
                                     const FrameSettings& settings) {
  const bool same_bounds =
      before.bounds().min == after.bounds().min && before.bounds().max == after.bounds().max;
  if (tree_edit == TreeEdit::kAnywhere || !same_bounds ||
      (settings.measured_channels && edit.has_other_ids)) {
    return {whole_picture(view)};
  }
  if (after.bounds().empty()) return {};
  const Screen screen(view, after.bounds());
  std::vector<PixelArea> areas;
  const auto add = [&](const Solid& solid, const std::vector<uint32_t>& primitives) {
    if (primitives.empty()) return;
    const std::vector<uint8_t> is_named = named(solid);
    for (const uint32_t i : primitives) {
      if (!is_named[i]) continue;
      if (const auto area = screen.area_of(solid.primitives()[i])) areas.push_back(*area);
    }
  };
  add(before, edit.removed);
  add(after, edit.added);
  add(after, edit.recolored);
  if (areas.size() > kManyPrimitives) {
    areas = {std::accumulate(areas.begin(), areas.end(), areas.front(), hull)};
  }
  merge(areas);
  return areas;
}

PixelArea area_of(const Solid& solid, const View& view) {
  if (solid.bounds().empty()) return {};
  const FrameRays frame = frame_rays(view, solid.bounds());
  return pixels_of(screen_extent_of(solid.bounds(), frame, {false}), view);
}

uint64_t count_pixels(const std::vector<PixelArea>& areas) {
  return std::accumulate(areas.begin(), areas.end(), uint64_t{0},
                         [](uint64_t sum, const PixelArea& area) { return sum + size_of(area); });
}

}  // namespace csgcore
