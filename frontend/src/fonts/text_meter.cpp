#include "fonts/text_meter.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fonts/font_stock.hpp"

namespace frontend {
namespace {

/// Lengths in outlines' units, as OpenSCAD's development version aligns texts.
class MeasuredText {
 public:
  MeasuredText(const std::vector<ShapedGlyph>& glyphs, double spacing, bool is_vertical,
               FontFace& font)
      : is_vertical_(is_vertical) {
    for (const ShapedGlyph& glyph : glyphs) {
      const Rectangle& box = font.pixel_box(glyph.index);
      if (!box.empty()) add(box, advance_ + glyph.offset);
      advance_ += spacing * glyph.advance;
    }
  }

  language::TextMetrics metrics(const language::TextRequest& text) const {
    const Vec2 offset(offset_x(text.halign), offset_y(text.valign));
    language::TextMetrics result;
    if (!box_.empty()) {
      result.position = scaled(text.size, box_.min + offset);
      result.size = scaled(text.size, box_.max - box_.min);
    }
    result.ascent = ascent_ / kOutlineUnits * text.size;
    result.descent = descent_ / kOutlineUnits * text.size;
    result.offset = scaled(text.size, offset);
    result.advance = scaled(text.size, advance_);
    return result;
  }

 private:
  void add(const Rectangle& box, const Vec2& at) {
    ascent_ = is_empty_ ? box.max.y : std::max(ascent_, box.max.y);
    descent_ = is_empty_ ? box.min.y : std::min(descent_, box.min.y);
    is_empty_ = false;
    box_.merge(box.min + at);
    box_.merge(box.max + at);
  }
  double offset_x(const std::string& word) const {
    if (is_vertical_) {
      if (box_.empty()) return 0;
      return word == "left" ? -box_.min.x : word == "right" ? -box_.max.x : 0;
    }
    return word == "center" ? -advance_.x / 2 : word == "right" ? -advance_.x : 0;
  }
  double offset_y(const std::string& word) const {
    if (is_vertical_)
      return word == "center" ? -advance_.y / 2 : word == "bottom" ? -advance_.y : 0;
    if (word == "center") return -(ascent_ + descent_) / 2;
    return word == "top" ? -ascent_ : word == "bottom" ? -descent_ : 0;
  }
  static std::array<double, 2> scaled(double size, const Vec2& v) {
    return {v.x / kOutlineUnits * size, v.y / kOutlineUnits * size};
  }

  const bool is_vertical_;
  bool is_empty_ = true;  // whether no letter has ink
  Rectangle box_;         // of all letters where they stand
  double ascent_ = 0, descent_ = 0;
  Vec2 advance_{0.0};
};

class FontMeter final : public language::TextMeter {
 public:
  std::optional<language::TextMetrics> measure(const language::TextRequest& text,
                                               std::span<const std::string> fonts) override {
    FontStock* const stock = FontStock::instance();
    if (stock == nullptr) return std::nullopt;
    const auto lock = stock->lock();
    FontFace* const font = find(*stock, text.font, fonts);
    if (font == nullptr) return std::nullopt;
    const TextRun run =
        run_of(stock->libraries(),
               stock->within_limits({text.text, text.direction, text.script, text.language}));
    return MeasuredText(font->shape(run), text.spacing, run.is_vertical(), *font).metrics(text);
  }

  std::optional<language::FontMetrics> measure_font(const std::string& name, double size,
                                                    std::span<const std::string> fonts) override {
    FontStock* const stock = FontStock::instance();
    if (stock == nullptr) return std::nullopt;
    const auto lock = stock->lock();
    FontFace* const font = find(*stock, name, fonts);
    if (font == nullptr) return std::nullopt;
    const FontFace::Extent extent = font->extent();
    const auto scaled = [&](double length) { return length / kOutlineUnits * size; };
    return language::FontMetrics{scaled(extent.ascent),
                                 scaled(extent.descent),
                                 scaled(extent.most_ascent),
                                 scaled(extent.most_descent),
                                 scaled(extent.line_distance),
                                 extent.family,
                                 extent.style};
  }

 private:
  FontFace* find(FontStock& stock, const std::string& name, std::span<const std::string> fonts) {
    const std::vector<std::string> files(fonts.begin(), fonts.end());
    if (!is_used_ || stock.files() != files) stock.use_files(files);
    is_used_ = true;
    return stock.find(name).face.get();
  }

  bool is_used_ = false;
};

}  // namespace

std::shared_ptr<language::TextMeter> make_text_meter() { return std::make_shared<FontMeter>(); }

}  // namespace frontend
