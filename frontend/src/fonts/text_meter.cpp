#include "fonts/text_meter.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fonts/font_stock.hpp"
#include "fonts/text_layout.hpp"

namespace frontend {
namespace {

std::array<double, 2> scaled(double size, const Vec2& v) { return {v.x * size, v.y * size}; }

language::TextMetrics metrics_of(const MeasuredText& measured, const language::TextRequest& text) {
  const Vec2 offset = measured.offset(align_of(text.halign, kHorizontalWords),
                                      align_of(text.valign, kVerticalWords));
  language::TextMetrics result;
  const Rectangle& box = measured.box();
  result.has_ink = !box.empty();
  result.position = scaled(text.size, result.has_ink ? box.min + offset : Vec2(0.0));
  result.size = scaled(text.size, result.has_ink ? box.max - box.min : Vec2(0.0));
  result.ascent = measured.ascent() * text.size;
  result.descent = measured.descent() * text.size;
  result.offset = scaled(text.size, offset);
  result.advance = scaled(text.size, measured.advance());
  return result;
}

class FontMeter final : public language::TextMeter {
 public:
  std::optional<language::TextMetrics> measure(const language::TextRequest& text,
                                               std::span<const std::string> fonts) override {
    FontStock* const stock = FontStock::instance();
    if (stock == nullptr) return std::nullopt;
    const auto lock = stock->lock();
    const FoundFont& font = find(*stock, text.font, fonts);
    if (font.face == nullptr) return std::nullopt;
    TextRun run =
        run_of(stock->libraries(),
               stock->within_limits({text.text, text.direction, text.script, text.language}));
    run.features = font.features;
    return metrics_of(
        MeasuredText(font.face->shape(run), text.spacing, run.is_vertical(), *font.face), text);
  }

  std::optional<language::FontMetrics> measure_font(const std::string& name, double size,
                                                    std::span<const std::string> fonts) override {
    FontStock* const stock = FontStock::instance();
    if (stock == nullptr) return std::nullopt;
    const auto lock = stock->lock();
    FontFace* const font = find(*stock, name, fonts).face.get();
    if (font == nullptr) return std::nullopt;
    const FontFace::Extent extent = font->extent();
    const auto sized = [&](double length) { return length / kOutlineUnits * size; };
    return language::FontMetrics{sized(extent.ascent),
                                 sized(extent.descent),
                                 sized(extent.most_ascent),
                                 sized(extent.most_descent),
                                 sized(extent.line_distance),
                                 extent.family,
                                 extent.style};
  }

 private:
  const FoundFont& find(FontStock& stock, const std::string& name,
                        std::span<const std::string> fonts) {
    const std::vector<std::string> files(fonts.begin(), fonts.end());
    if (!is_used_ || stock.files() != files) stock.use_files(files);
    is_used_ = true;
    return stock.find(name);
  }

  bool is_used_ = false;
};

}  // namespace

std::shared_ptr<language::TextMeter> make_text_meter() { return std::make_shared<FontMeter>(); }

}  // namespace frontend
