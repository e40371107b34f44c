#include "fonts/text_layout.hpp"

#include <algorithm>
#include <cmath>

namespace frontend {
namespace {

/// OpenSCAD divides outlines by kOutlineUnits, and all that is between them by this.
constexpr double kAdvanceUnits = 1.024e5;

/// Lengths that alignment needs, in units of kAdvanceUnits.
struct Measures {
  double width = 0;
  double ascent = 0, descent = 0;  // above and below the baseline
};

Measures measures_of(const std::vector<ShapedGlyph>& glyphs, const TextSettings& text,
                     bool is_vertical, FontFace& font) {
  Measures result;
  double widest = 0;
  Vec2 advance(0.0);
  for (const ShapedGlyph& glyph : glyphs) {
    advance += text.spacing * glyph.advance;
    const Rectangle& box = font.pixel_box(glyph.index);
    if (box.empty()) continue;
    result.ascent = std::max(result.ascent, box.max.y);
    result.descent = std::max(result.descent, -box.min.y);
    widest = std::max(widest, box.max.x - box.min.x);
  }
  result.width = is_vertical ? widest : advance.x;
  if (!is_vertical) return result;
  // OpenSCAD takes the way down for the letters' height, with its sign.
  result.ascent = advance.y;
  result.descent = 0;
  return result;
}

double aligned_x(HorizontalAlign align, const Measures& measures) {
  switch (align) {
    case HorizontalAlign::kDefault:
    case HorizontalAlign::kLeft:
      return 0;
    case HorizontalAlign::kCenter:
      return -measures.width / 2;
    case HorizontalAlign::kRight:
      return -measures.width;
  }
  return 0;
}

double aligned_y(VerticalAlign align, const Measures& measures) {
  switch (align) {
    case VerticalAlign::kDefault:
    case VerticalAlign::kBaseline:
      return 0;
    case VerticalAlign::kTop:
      return -measures.ascent;
    case VerticalAlign::kCenter:
      return (measures.descent - measures.ascent) / 2;
    case VerticalAlign::kBottom:
      return measures.descent;
  }
  return 0;
}

bool is_finite(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

}  // namespace

MeasuredText::MeasuredText(const std::vector<ShapedGlyph>& glyphs, double spacing, bool is_vertical,
                           FontFace& font)
    : is_vertical_(is_vertical) {
  for (const ShapedGlyph& glyph : glyphs) {
    const Rectangle& pixels = font.pixel_box(glyph.index);
    if (!pixels.empty()) {
      const Rectangle box{pixels.min / kOutlineUnits, pixels.max / kOutlineUnits};
      ascent_ = is_empty_ ? box.max.y : std::max(ascent_, box.max.y);
      descent_ = is_empty_ ? box.min.y : std::min(descent_, box.min.y);
      is_empty_ = false;
      const Vec2 place = advance_ + glyph.offset / kOutlineUnits;
      box_.merge(place + box.min);
      box_.merge(place + box.max);
    }
    advance_ += spacing * (glyph.advance / kOutlineUnits);
  }
}

Vec2 MeasuredText::offset(HorizontalAlign halign, VerticalAlign valign) const {
  Vec2 offset(0.0);
  if (is_vertical_) {
    if (halign == HorizontalAlign::kLeft && !is_empty_) offset.x = -box_.min.x;
    if (halign == HorizontalAlign::kRight && !is_empty_) offset.x = -box_.max.x;
    if (valign == VerticalAlign::kCenter) offset.y = -advance_.y / 2;
    if (valign == VerticalAlign::kBottom) offset.y = -advance_.y;
    return offset;
  }
  if (halign == HorizontalAlign::kCenter) offset.x = -advance_.x / 2;
  if (halign == HorizontalAlign::kRight) offset.x = -advance_.x;
  if (valign == VerticalAlign::kCenter) offset.y = -descent_ - (ascent_ - descent_) / 2;
  if (valign == VerticalAlign::kTop) offset.y = -ascent_;
  if (valign == VerticalAlign::kBottom) offset.y = -descent_;
  return offset;
}

std::vector<PlacedGlyph> lay_out(const TextSettings& text, const TextRun& run, FontFace& font,
                                 int pieces) {
  std::vector<PlacedGlyph> result;
  if (!std::isfinite(text.size) || text.size == 0) return result;
  const std::vector<ShapedGlyph> glyphs = font.shape(run);
  Vec2 at(0.0);
  const double units = text.is_placed_exactly ? kOutlineUnits : kAdvanceUnits;
  const bool begins_at_origin =
      (text.halign == HorizontalAlign::kDefault || text.halign == HorizontalAlign::kLeft) &&
      (text.valign == VerticalAlign::kDefault || text.valign == VerticalAlign::kBaseline);
  if (begins_at_origin && !(text.is_placed_exactly && run.is_vertical())) {
    // The letters' boxes, which take a while to load, do not matter.
  } else if (text.is_placed_exactly) {
    const MeasuredText measured(glyphs, text.spacing, run.is_vertical(), font);
    at = kOutlineUnits * measured.offset(text.halign, text.valign);
  } else {
    const Measures measures = measures_of(glyphs, text, run.is_vertical(), font);
    at = {aligned_x(text.halign, measures), aligned_y(text.valign, measures)};
  }
  for (const ShapedGlyph& glyph : glyphs) {
    const GlyphShape& shape = font.shape_of_glyph(glyph.index, pieces);
    const Vec2 place = text.size / units * (at + glyph.offset);
    if (shape.figure && is_finite(place)) {
      result.push_back({shape, {glm::dmat2(text.size / kOutlineUnits), place}});
    }
    at += text.spacing * glyph.advance;
  }
  return result;
}

}  // namespace frontend
