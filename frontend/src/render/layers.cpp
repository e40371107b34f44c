#include "render/layers.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace frontend {
namespace {

using csgcore::Boundary;
using csgcore::CanonicalPrimitive;
using csgcore::CanonicalPrimitives;
using csgcore::CsgTree;
using csgcore::Image;
using csgcore::kSurfaceSquare_px;
using csgcore::Layer;
using csgcore::PixelBlock;

struct LayerColor {
  uint8_t r, g, b, a;
};

/// OpenSCAD's colours of `%` and `#` parts.
constexpr LayerColor kBackgroundColor{180, 180, 180, 128};
constexpr LayerColor kHighlightColor{255, 81, 81, 128};

/// A surface is not shown that lies this many times as far behind what is seen as coincident
/// surfaces may: theirs is measured at the further one, and rounded to float.
constexpr double kMostReaches = 4;

/// The depth of a pixel that shows nothing.
constexpr float kNothing = std::numeric_limits<float>::infinity();
bool is_nothing(float depth) { return depth == kNothing; }

/// In float a tolerance is taken this much larger than in double, which exceeds what float rounds.
constexpr float kNearlyOne = 1 + 0x1p-10f;

const LayerColor& color_of(Layer::Kind kind) {
  return kind == Layer::Kind::kBackground ? kBackgroundColor : kHighlightColor;
}

/// Makes the solid of a tree, of the primitives alone that it names: most layers name few of a
/// design's. A part that is subtracted shows its cut faces.
csgcore::Solid solid_of(const CanonicalPrimitives& primitives, Layer::Kind kind,
                        const CsgTree& tree, bool is_subtracted = false) {
  auto named = std::make_shared<CanonicalPrimitives>();
  std::unordered_map<uint32_t, uint32_t> new_indices;
  const CsgTree renamed = csgcore::renamed(tree, [&](uint32_t index) {
    const auto next = static_cast<uint32_t>(named->size());
    const auto [entry, is_new] = new_indices.try_emplace(index, next);
    if (is_new) {
      CanonicalPrimitive& primitive = named->emplace_back(primitives[index]);
      // Colours do not count in `#` parts.
      if (kind == Layer::Kind::kHighlight) {
        primitive.color = csgcore::Color{-1, -1, -1, kHighlightColor.a / 255.0f};
      }
      if (is_subtracted) primitive.cut_faces = csgcore::CutFaces::kAlways;
    }
    return entry->second;
  });
  return csgcore::Solid(std::move(named), renamed);
}

}  // namespace

std::shared_ptr<const csgcore::Solid> PartSolids::solid_of(Layer::Kind kind,
                                                           const Layer::Part& part) {
  std::vector<uint64_t> key{static_cast<uint64_t>(kind), part.is_subtracted};
  for (const csgcore::CsgToken& token : part.solid.tokens()) {
    const uint64_t what = token.is_primitive ? 0 : 1 + static_cast<uint64_t>(token.op);
    key.push_back(what << 32 | token.value);
  }
  std::shared_ptr<const csgcore::Solid>& solid = made_[std::move(key)];
  if (!solid) {
    solid = std::make_shared<const csgcore::Solid>(
        frontend::solid_of(primitives_, kind, part.solid, part.is_subtracted));
  }
  return solid;
}

PreparedLayer::PreparedLayer(const CanonicalPrimitives& primitives, const Layer& layer,
                             PartSolids& parts)
    : kind_(layer.kind),
      shows_behind_(layer.shows_behind),
      solid_(solid_of(primitives, layer.kind, layer.solid)) {
  for (const Layer::Part& part : layer.parts) {
    parts_.push_back({parts.solid_of(kind_, part), part.is_subtracted});
  }
  const float layer_opacity = is_of_model() ? 1.0f : color_of(kind_).a / 255.0f;
  for (const CanonicalPrimitive& primitive : solid_.primitives()) {
    own_opacity_[primitive.id] = primitive.color ? primitive.color->a : layer_opacity;
  }
  const bool is_uniform =
      std::all_of(own_opacity_.begin(), own_opacity_.end(),
                  [&](const auto& entry) { return entry.second == own_opacity_.begin()->second; });
  if (is_uniform && !own_opacity_.empty()) opacity_ = own_opacity_.begin()->second;
}

csgcore::FrameSettings PreparedLayer::frame(csgcore::FrameSettings scene_frame) const {
  if (is_of_model()) return scene_frame;
  const LayerColor& color = color_of(kind_);
  scene_frame.front = scene_frame.back = glm::vec3(color.r, color.g, color.b) / 255.0f;
  return scene_frame;
}

float PreparedLayer::opacity(uint32_t id) const {
  return opacity_ ? *opacity_ : own_opacity_.at(id);
}

bool PreparedLayer::is_opaque() const {
  return std::ranges::all_of(own_opacity_, [](const auto& entry) { return entry.second >= 1; });
}

LayerSurfaces::LayerSurfaces(const std::vector<const PreparedLayer*>& layers,
                             const csgcore::FrameSettings& frame, Translucency order_of_blending)
    : order(order_of_blending) {
  const bool is_by_depth = order == Translucency::kDepth;
  std::map<const csgcore::Solid*, uint32_t> parts;
  uint32_t number = 0;
  for (const PreparedLayer* const layer : layers) {
    const csgcore::FrameSettings of_layer = layer->frame(frame);
    const auto add = [&](const csgcore::Solid& solid, Boundary boundary) {
      surfaces.push_back({&solid, nullptr, boundary, of_layer});
      return static_cast<uint32_t>(surfaces.size()) - 1;
    };
    ++number;
    has_parts = has_parts || (!is_by_depth && !layer->parts().empty());
    const auto take_turn = [&](uint32_t surface, bool is_part) {
      turns.push_back(surface);
      blended.push_back({layer, number, is_part});
    };
    const bool has_far_side = is_by_depth ? !layer->is_opaque() : layer->shows_behind();
    if (has_far_side) take_turn(add(layer->solid(), Boundary::kBehind), false);
    take_turn(add(layer->solid(), Boundary::kFirst), false);
    if (is_by_depth) continue;
    for (const PreparedLayer::Part& part : layer->parts()) {
      const auto [entry, is_new] = parts.try_emplace(part.solid.get(), 0);
      if (is_new) {
        entry->second = add(*part.solid, part.is_subtracted ? Boundary::kBehind : Boundary::kFirst);
      }
      take_turn(entry->second, true);
    }
  }
}

Compositor::Compositor(Image& image, std::span<const float> depth, double scene_size,
                       const LayerSurfaces& surfaces, std::optional<uint32_t> shares_from)
    : image_(image),
      scene_size_(scene_size),
      surfaces_(surfaces),
      turns_(surfaces.blended),
      squares_across_((image.width_px + kSurfaceSquare_px - 1) / kSurfaceSquare_px),
      stride_px_(squares_across_ * kSurfaceSquare_px),
      shares_from_(shares_from) {
  depth_.resize(size_t{stride_px_} * image.height_px, kNothing);
  for (uint32_t y = 0; y < image.height_px && !depth.empty(); ++y) {
    std::ranges::copy(depth.subspan(size_t{y} * image.width_px, image.width_px),
                      depth_.begin() + static_cast<ptrdiff_t>(size_t{y} * stride_px_));
  }
  if (surfaces.has_parts) last_layer_.resize(depth_.size(), kNoLayer);
  const uint32_t squares_down = (image.height_px + kSurfaceSquare_px - 1) / kSurfaceSquare_px;
  squares_.assign(size_t{squares_across_} * squares_down,
                  {kNothing, kNothing, kNoLayer, false, true});
  if (surfaces.order == Translucency::kDepth) kept_.resize(squares_.size());
  if (shares_from_) start_shares();
}

namespace {

/// Calls visit(pixel in the square, pixel of the picture) for each pixel of a square.
template <typename Visit>
void for_each_pixel_of_square(const Image& image, size_t square, const Visit& visit) {
  const size_t across = (image.width_px + kSurfaceSquare_px - 1) / kSurfaceSquare_px;
  const size_t left = square % across * kSurfaceSquare_px;
  const size_t top = square / across * kSurfaceSquare_px;
  for (uint32_t i = 0; i < kSurfaceSquare_px * kSurfaceSquare_px; ++i) {
    const size_t x = left + i % kSurfaceSquare_px, y = top + i / kSurfaceSquare_px;
    if (x < image.width_px && y < image.height_px) visit(i, y * image.width_px + x);
  }
}

}  // namespace

/// The shares of what stands in the picture before any layer is drawn.
void Compositor::start_shares() {
  shares_.resize(squares_.size());
  tbb::parallel_for(size_t{0}, shares_.size(), [this](size_t square) {
    for_each_pixel_of_square(image_, square, [&](uint32_t in_square, size_t pixel) {
      const uint32_t id = image_.id.empty() ? csgcore::kNoPrimitive : image_.id[pixel];
      if (has_share(id)) shares_[square].push_back({in_square, id, 1});
    });
  });
}

/// Draws pixels over those shares that are known.
void Compositor::share(const PreparedLayer& layer, const PixelBlock& block,
                       const csgcore::SurfacePixels& pixels) {
  std::vector<csgcore::PixelShare>& shares = shares_[square_at(block.x, block.y)];
  // A block is as wide as the square.
  const uint32_t first = block.y % kSurfaceSquare_px * kSurfaceSquare_px;
  std::array<float, PixelBlock::kPixels> light;
  light.fill(1);
  for (uint32_t left = block.pixels; left != 0; left &= left - 1) {
    const auto pixel = static_cast<uint32_t>(std::countr_zero(left));
    light[pixel] = 1 - std::min(layer.opacity(pixels.id[pixel]), 1.0f);
  }
  for (csgcore::PixelShare& below : shares) {
    if (below.pixel - first < light.size()) below.share *= light[below.pixel - first];
  }
  std::erase_if(shares, [](const auto& below) { return !(below.share > 0); });
  for (uint32_t left = block.pixels; left != 0; left &= left - 1) {
    const auto pixel = static_cast<uint32_t>(std::countr_zero(left));
    const uint32_t id = pixels.id[pixel];
    if (has_share(id)) shares.push_back({first + pixel, id, 1 - light[pixel]});
  }
}

std::optional<std::vector<csgcore::PixelShare>> Compositor::shares(uint32_t side) const {
  if (!shares_from_) return std::nullopt;
  const uint32_t width = image_.width_px / side;
  const size_t rows = squares_.size() / squares_across_;
  // Bands of `side` rows of squares, which are so many rows of the smaller picture.
  std::vector<std::vector<csgcore::PixelShare>> bands((rows + side - 1) / side);
  tbb::parallel_for(size_t{0}, bands.size(), [&](size_t band) {
    // Most shares are the background's, and need not be sorted.
    std::vector<float> background(size_t{width} * kSurfaceSquare_px);
    std::vector<csgcore::PixelShare> others;
    const size_t begin = band * side, end = std::min(begin + side, rows);
    const auto first = static_cast<uint32_t>(band * background.size());
    for (size_t square = begin * squares_across_; square < end * squares_across_; ++square) {
      const auto left = static_cast<uint32_t>(square % squares_across_) * kSurfaceSquare_px;
      const auto top = static_cast<uint32_t>(square / squares_across_) * kSurfaceSquare_px;
      for (const csgcore::PixelShare& of_fine : shares_[square]) {
        const uint32_t x = (left + of_fine.pixel % kSurfaceSquare_px) / side;
        const uint32_t y = (top + of_fine.pixel / kSurfaceSquare_px) / side;
        const float share = of_fine.share / static_cast<float>(side * side);
        if (of_fine.id == csgcore::kNoPrimitive) {
          background[y * width + x - first] += share;
        } else {
          others.push_back({y * width + x, of_fine.id, share});
        }
      }
    }
    std::ranges::sort(others, [](const auto& a, const auto& b) {
      return std::tuple(a.pixel, a.id, a.share) < std::tuple(b.pixel, b.id, b.share);
    });
    auto other = others.begin();
    for (uint32_t i = 0; i < background.size(); ++i) {
      std::vector<csgcore::PixelShare>& shares = bands[band];
      const size_t before = shares.size();
      for (; other != others.end() && other->pixel == first + i; ++other) {
        if (shares.size() > before && shares.back().id == other->id) {
          shares.back().share += other->share;
        } else {
          shares.push_back(*other);
        }
      }
      if (background[i] > 0) shares.push_back({first + i, csgcore::kNoPrimitive, background[i]});
    }
  });
  std::vector<csgcore::PixelShare> all;
  for (const auto& band : bands) all.insert(all.end(), band.begin(), band.end());
  return all;
}

size_t Compositor::square_at(uint32_t x, uint32_t y) const {
  return size_t{y / kSurfaceSquare_px} * squares_across_ + x / kSurfaceSquare_px;
}

Compositor::Square Compositor::look_at_square(uint32_t x, uint32_t y) const {
  x -= x % kSurfaceSquare_px;
  y -= y % kSurfaceSquare_px;
  const uint32_t right = std::min(x + kSurfaceSquare_px, image_.width_px);
  const uint32_t bottom = std::min(y + kSurfaceSquare_px, image_.height_px);
  const bool has_parts = !last_layer_.empty();
  const size_t top_left = size_t{y} * stride_px_ + x;
  Square square{-kNothing, -kNothing, has_parts ? last_layer_[top_left] : kNoLayer, true};
  for (uint32_t row = y; row < bottom; ++row) {
    const size_t first = size_t{row} * stride_px_;
    for (size_t pixel = first + x; pixel < first + right; ++pixel) {
      const float depth = depth_[pixel];
      square.furthest = depth > square.furthest ? depth : square.furthest;
      const float seen = is_nothing(depth) ? -kNothing : depth;
      square.furthest_seen = seen > square.furthest_seen ? seen : square.furthest_seen;
      if (has_parts) square.has_one &= last_layer_[pixel] == square.layer;
    }
  }
  return square;
}

/// Returns whether the square of this pixel may show a surface that lies nowhere before `nearest`.
bool Compositor::may_show(const Turn& turn, double nearest, uint32_t x, uint32_t y) const {
  Square& square = squares_[square_at(x, y)];
  const auto may_show = [&] {
    if (!turn.is_part) return !(nearest > square.furthest);
    return !(nearest > square.furthest_seen) && !(square.has_one && square.layer == turn.number);
  };
  if (!may_show()) return false;
  if (!square.is_stale) return true;
  square = look_at_square(x, y);
  return may_show();
}

bool Compositor::wants(uint32_t turn, const csgcore::PixelArea& area, float nearest_z) const {
  const double nearest = nearest_z - reach(nearest_z);
  for (uint32_t y = area.y; y < area.y + area.height; y += kSurfaceSquare_px) {
    for (uint32_t x = area.x; x < area.x + area.width; x += kSurfaceSquare_px) {
      if (may_show(turns_[turn], nearest, x, y)) return true;
    }
  }
  return false;
}

namespace {

constexpr uint32_t kRowPixels = (uint32_t{1} << PixelBlock::kWidth_px) - 1;

/// Calls visit(row's first pixel in the block, and among pixels with this many in a row) for each
/// row of the block that has any of the pixels.
template <typename Visit>
void for_each_row(const PixelBlock& block, uint32_t stride_px, const Visit& visit) {
  for (uint32_t y = 0; y < PixelBlock::kHeight_px; ++y) {
    const uint32_t first = y * PixelBlock::kWidth_px;
    if ((block.pixels >> first & kRowPixels) == 0) continue;
    visit(first, size_t{block.y + y} * stride_px + block.x);
  }
}

/// Returns the pixels of the block for which holds(pixel in the block, its index). Asks
/// for whole rows, which compilers make vectors of.
template <typename Holds>
uint32_t pixels_where(const PixelBlock& block, uint32_t stride_px, const Holds& holds) {
  uint32_t result = 0;
  for_each_row(block, stride_px, [&](uint32_t first, size_t index) {
    uint32_t row = 0;
    for (uint32_t x = 0; x < PixelBlock::kWidth_px; ++x) {
      row |= holds(first + x, index + x) ? uint32_t{1} << x : 0;
    }
    result |= row << first;
  });
  return result & block.pixels;
}

/// Returns those of the pixels for which holds(pixel in the block, its index), one by one.
template <typename Holds>
uint32_t those_where(uint32_t pixels, const PixelBlock& block, uint32_t stride_px,
                     const Holds& holds) {
  uint32_t result = 0;
  for (uint32_t left = pixels; left != 0; left &= left - 1) {
    const auto pixel = static_cast<uint32_t>(std::countr_zero(left));
    const size_t row = block.y + pixel / PixelBlock::kWidth_px;
    const size_t index = row * stride_px + block.x + pixel % PixelBlock::kWidth_px;
    if (holds(pixel, index)) result |= left & -left;
  }
  return result;
}

}  // namespace

void Compositor::blend_row(const PreparedLayer& layer, uint32_t drawn,
                           const csgcore::SurfacePixels& pixels, uint32_t first,
                           std::array<uint8_t, 3>* row) {
  for (uint32_t x = 0; x < PixelBlock::kWidth_px; ++x) {
    if ((drawn >> x & 1) == 0) continue;
    const float alpha = layer.opacity(pixels.id[first + x]);
    for (size_t channel = 0; channel < 3; ++channel) {
      const float below = row[x][channel];
      const float above = pixels.rgb[first + x][channel];
      row[x][channel] = static_cast<uint8_t>(below + alpha * (above - below) + 0.5f);
    }
  }
}

uint32_t Compositor::wanted(uint32_t turn, const PixelBlock& block, float nearest_z,
                            double (&furthest_z)[PixelBlock::kPixels]) const {
  const Turn& own = turns_[turn];
  for_each_row(block, stride_px_, [&](uint32_t first, size_t index) {
    for (uint32_t x = 0; x < PixelBlock::kWidth_px; ++x) {
      const double depth = depth_[index + x];
      furthest_z[first + x] = depth + kMostReaches * reach(depth);
    }
  });
  const double nearest = nearest_z;
  const uint32_t result = pixels_where(
      block, stride_px_, [&](uint32_t pixel, size_t) { return !(nearest > furthest_z[pixel]); });
  if (!own.is_part) return result;
  return result & pixels_where(block, stride_px_, [&](uint32_t, size_t index) {
           return last_layer_[index] != own.number && !is_nothing(depth_[index]);
         });
}

uint32_t Compositor::shown(uint32_t turn, const PixelBlock& block,
                           const float (&z)[PixelBlock::kPixels]) const {
  const Turn& own = turns_[turn];
  // Most pixels are decided in float.
  if (own.is_part) {
    const float share = kNearlyOne * static_cast<float>(kSameDepth);
    const auto size = static_cast<float>(scene_size_);
    const uint32_t near = pixels_where(block, stride_px_, [&](uint32_t pixel, size_t index) {
      return std::abs(z[pixel] - depth_[index]) <= share * (std::abs(z[pixel]) + size);
    });
    return those_where(near, block, stride_px_, [&](uint32_t pixel, size_t index) {
      return last_layer_[index] != own.number &&
             std::abs(z[pixel] - depth_[index]) <= reach(z[pixel]);
    });
  }
  const uint32_t before = pixels_where(
      block, stride_px_, [&](uint32_t pixel, size_t index) { return z[pixel] <= depth_[index]; });
  return before |
         those_where(block.pixels & ~before, block, stride_px_, [&](uint32_t pixel, size_t index) {
           return z[pixel] - reach(z[pixel]) <= depth_[index];
         });
}

void Compositor::draw(uint32_t turn, const PixelBlock& block,
                      const csgcore::SurfacePixels& pixels) {
  const Turn& own = turns_[turn];
  if (!kept_.empty()) return keep(turn, block, pixels);
  if (shares_from_) share(*own.layer, block, pixels);
  for_each_row(block, stride_px_, [&](uint32_t first, size_t index) {
    const uint32_t drawn = block.pixels >> first & kRowPixels;
    const size_t row = block.y + first / PixelBlock::kWidth_px;
    blend_row(*own.layer, drawn, pixels, first, &image_.rgb[row * image_.width_px + block.x]);
    if (own.is_part) return;
    for (uint32_t x = 0; x < PixelBlock::kWidth_px; ++x) {
      if ((drawn >> x & 1) == 0) continue;
      depth_[index + x] = std::min(depth_[index + x], pixels.z[first + x]);
      if (!last_layer_.empty()) last_layer_[index + x] = own.number;
    }
  });
  if (!own.is_part) mark_stale(block);
}

void Compositor::mark_stale(const PixelBlock& block) {
  Square& square = squares_[square_at(block.x, block.y)];
  square = {square.furthest, square.furthest, kNoLayer, false, true};
}

void Compositor::keep(uint32_t turn, const PixelBlock& block,
                      const csgcore::SurfacePixels& pixels) {
  const PreparedLayer& layer = *turns_[turn].layer;
  Kept& kept = kept_[square_at(block.x, block.y)];
  for (uint32_t left = block.pixels; left != 0; left &= left - 1) {
    const auto pixel = static_cast<uint32_t>(std::countr_zero(left));
    const float opacity = std::min(layer.opacity(pixels.id[pixel]), 1.0f);
    if (!(opacity > 0)) continue;
    const uint32_t x = block.x + pixel % PixelBlock::kWidth_px;
    const uint32_t y = block.y + pixel / PixelBlock::kWidth_px;
    const uint32_t in_square = y % kSurfaceSquare_px * kSurfaceSquare_px + x % kSurfaceSquare_px;
    kept.fragments.push_back({pixels.z[pixel], opacity, pixels.rgb[pixel],
                              static_cast<uint8_t>(in_square), turn, pixels.id[pixel]});
    float& depth = depth_[size_t{y} * stride_px_ + x];
    if (opacity == 1) depth = std::min(depth, pixels.z[pixel]);
  }
  if (kept.fragments.size() >= kept.to_sort_at) drop_hidden(block.x, block.y);
  mark_stale(block);
}

/// Returns which of two coincident surfaces is below: an opaque one, the earlier of such; else what
/// is the same in whatever order the file has them. Between parts that touch, the nearer one ends.
bool Compositor::is_below(const Fragment& a, const Fragment& b) const {
  const auto rank = [this](const Fragment& fragment) {
    const bool is_opaque = fragment.opacity == 1;
    const bool is_far_side =
        surfaces_.surfaces[surfaces_.turns[fragment.turn]].boundary == Boundary::kBehind;
    return std::tuple(!is_opaque, is_opaque ? fragment.turn : 0, is_far_side, fragment.opacity,
                      fragment.rgb);
  };
  return rank(a) < rank(b);
}

namespace {

/// Surfaces behind which less than this share of the light comes through count as opaque: less than
/// half a level of a channel.
constexpr float kDark = 0x1p-10f;

/// Calls visit(pixel in the square, its fragments from the furthest to the nearest) for each pixel
/// that has any.
template <typename Fragments, typename Visit>
void for_each_pixel(Fragments& fragments, const Visit& visit) {
  std::ranges::sort(fragments, [](const auto& a, const auto& b) {
    return std::tuple(a.pixel, -a.z, a.opacity) < std::tuple(b.pixel, -b.z, b.opacity);
  });
  for (std::span rest(fragments); !rest.empty();) {
    const uint32_t pixel = rest.front().pixel;
    const auto end = std::ranges::find_if(rest, [&](const auto& f) { return f.pixel != pixel; });
    const auto count = static_cast<size_t>(end - rest.begin());
    visit(pixel, rest.first(count));
    rest = rest.subspan(count);
  }
}

}  // namespace

/// Returns those fragments of a pixel that can be seen. `fragments` go from the furthest to the
/// nearest. Makes `nearest_opaque` the nearest depth at which no light comes through.
std::span<Compositor::Fragment> Compositor::seen(std::span<Fragment> fragments,
                                                 float& nearest_opaque) const {
  float light = 1;
  for (auto fragment = fragments.rbegin(); fragment != fragments.rend(); ++fragment) {
    light *= 1 - fragment->opacity;
    if (light > kDark) continue;
    nearest_opaque = std::min(nearest_opaque, fragment->z);
    break;
  }
  const auto first = std::ranges::find_if(fragments, [&](const Fragment& fragment) {
    return fragment.z - reach(fragment.z) <= nearest_opaque;
  });
  return fragments.subspan(static_cast<size_t>(first - fragments.begin()));
}

/// Drops what cannot be seen in the square of the pixel, however many surfaces follow.
void Compositor::drop_hidden(uint32_t x, uint32_t y) {
  x -= x % kSurfaceSquare_px;
  y -= y % kSurfaceSquare_px;
  Kept& kept = kept_[square_at(x, y)];
  std::vector<Fragment> left;
  for_each_pixel(kept.fragments, [&](uint32_t pixel, std::span<Fragment> fragments) {
    const size_t row = y + pixel / kSurfaceSquare_px, column = x + pixel % kSurfaceSquare_px;
    const auto those = seen(fragments, depth_[row * stride_px_ + column]);
    left.insert(left.end(), those.begin(), those.end());
  });
  kept.fragments = std::move(left);
  kept.to_sort_at = std::max(kFewFragments, 2 * kept.fragments.size());
}

/// Blends what the pixel shows; `fragments` go from the furthest to the nearest.
void Compositor::blend_pixel(std::span<Fragment> fragments, std::array<uint8_t, 3>& rgb) const {
  std::array<float, 3> color;
  std::ranges::copy(rgb, color.begin());
  for (auto first = fragments.begin(); first != fragments.end();) {
    auto last = first + 1;
    while (last != fragments.end() && (last - 1)->z - last->z <= reach(last->z)) ++last;
    std::sort(first, last, [this](const auto& a, const auto& b) { return is_below(a, b); });
    for (; first != last; ++first) {
      for (size_t channel = 0; channel < 3; ++channel) {
        color[channel] += first->opacity * (first->rgb[channel] - color[channel]);
      }
    }
  }
  for (size_t channel = 0; channel < 3; ++channel) {
    rgb[channel] = static_cast<uint8_t>(color[channel] + 0.5f);
  }
}

void Compositor::blend_square(uint32_t x, uint32_t y) {
  Kept kept = std::exchange(kept_[square_at(x, y)], {});
  std::array<float, kSurfaceSquare_px * kSurfaceSquare_px> light;  // that comes through, by pixel
  light.fill(1);
  std::vector<csgcore::PixelShare> shares;
  for_each_pixel(kept.fragments, [&](uint32_t pixel, std::span<Fragment> fragments) {
    const size_t row = y + pixel / kSurfaceSquare_px, column = x + pixel % kSurfaceSquare_px;
    const std::span<Fragment> those = seen(fragments, depth_[row * stride_px_ + column]);
    blend_pixel(those, image_.rgb[row * image_.width_px + column]);
    for (auto nearest = those.rbegin(); shares_from_ && nearest != those.rend(); ++nearest) {
      const float share = light[pixel] * nearest->opacity;
      if (has_share(nearest->id) && share > 0) shares.push_back({pixel, nearest->id, share});
      light[pixel] *= 1 - nearest->opacity;
    }
  });
  if (!shares_from_) return;
  for (csgcore::PixelShare below : shares_[square_at(x, y)]) {
    below.share *= light[below.pixel];
    if (below.share > 0) shares.push_back(below);
  }
  shares_[square_at(x, y)] = std::move(shares);
}

void Compositor::end(const csgcore::PixelArea& area) {
  if (kept_.empty()) return;
  for (uint32_t y = area.y; y < area.y + area.height; y += kSurfaceSquare_px) {
    for (uint32_t x = area.x; x < area.x + area.width; x += kSurfaceSquare_px) blend_square(x, y);
  }
}

void Compositor::finish() { end({0, 0, image_.width_px, image_.height_px}); }

void Compositor::blend(uint32_t turn, const Image& picture, const csgcore::PixelArea& area) {
  const uint32_t right = area.x + area.width, bottom = area.y + area.height;
  csgcore::SurfacePixels pixels{};
  for (uint32_t top = area.y - area.y % PixelBlock::kHeight_px; top < bottom;
       top += PixelBlock::kHeight_px) {
    for (uint32_t left = area.x - area.x % PixelBlock::kWidth_px; left < right;
         left += PixelBlock::kWidth_px) {
      PixelBlock block{left, top, 0};
      for (uint32_t y = std::max(top, area.y); y < std::min(top + PixelBlock::kHeight_px, bottom);
           ++y) {
        for (uint32_t x = std::max(left, area.x); x < std::min(left + PixelBlock::kWidth_px, right);
             ++x) {
          const size_t index = size_t{y} * picture.width_px + x;
          const uint32_t pixel = (y - top) * PixelBlock::kWidth_px + x - left;
          // A miss is at infinity, and in front of nothing.
          if (is_nothing(picture.z[index])) continue;
          block.pixels |= uint32_t{1} << pixel;
          pixels.z[pixel] = picture.z[index];
          pixels.rgb[pixel] = picture.rgb[index];
          pixels.id[pixel] = picture.id[index];
        }
      }
      block.pixels = shown(turn, block, pixels.z);
      if (block.pixels != 0) draw(turn, block, pixels);
    }
  }
}

}  // namespace frontend
