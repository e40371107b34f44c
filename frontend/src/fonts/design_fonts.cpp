#include "fonts/design_fonts.hpp"

#include "fonts/font_stock.hpp"

namespace frontend {

DrawnText DesignFonts::letters(const TextSettings& text, int pieces) {
  DrawnText result;
  FontStock* const stock = FontStock::instance();
  if (!are_used_ && find_files_) files_ = find_files_();
  const bool is_first = !are_used_;
  are_used_ = true;
  if (stock == nullptr) {
    result.problem = DrawnText::Problem::kNoLibraries;
    return result;
  }
  const auto lock = stock->lock();
  if (is_first || stock->files() != files_) stock->use_files(files_);
  const FoundFont& font = stock->find(text.font);
  result.font_family = font.family;
  result.missing_family = font.missing_family;
  if (!font.face) {
    result.problem = DrawnText::Problem::kNoFont;
    return result;
  }
  TextRun run = run_of(stock->libraries(), stock->within_limits(text.letters));
  if (text.has_features) run.features = font.features;
  result.glyphs = lay_out(text, run, *font.face, pieces);
  return result;
}

}  // namespace frontend
