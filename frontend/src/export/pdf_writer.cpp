// PDF: the outlines as lines on one page, in their true size.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"
#include "language/color_names.hpp"

namespace frontend {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;
/// A thousandth of a point is 0.35 µm.
constexpr int kDigitsOfPoints = 3;

/// A PDF's numbered objects, and the table of where they begin.
class PdfFile {
 public:
  void add(const std::string& object) {
    begins_.push_back(text_.size());
    text_ += std::to_string(begins_.size()) + " 0 obj\n" + object + "\nendobj\n";
  }
  /// The first object is the catalogue.
  std::string finish() {
    const std::string count = std::to_string(begins_.size() + 1);
    const size_t table = text_.size();
    text_ += "xref\n0 " + count + "\n0000000000 65535 f \n";
    for (const size_t begin : begins_) {
      const std::string digits = std::to_string(begin);
      text_ += std::string(10 - std::min<size_t>(digits.size(), 10), '0') + digits + " 00000 n \n";
    }
    return text_ + "trailer\n<< /Size " + count + " /Root 1 0 R /Info 5 0 R >>\nstartxref\n" +
           std::to_string(table) + "\n%%EOF\n";
  }

 private:
  std::string text_ = "%PDF-1.4\n";
  std::vector<size_t> begins_;
};

/// Returns the paper's size upright, in points.
Vec2 paper_of(const std::string& name) {
  if (name == "a6") return {298, 420};
  if (name == "a5") return {420, 595};
  if (name == "a3") return {842, 1191};
  if (name == "letter") return {612, 792};
  if (name == "legal") return {612, 1008};
  if (name == "tabloid") return {792, 1224};
  return {595, 842};  // A4
}

/// Returns half of the page's size in points: of the paper, or what the outlines need with a
/// margin.
Vec2 half_page_of(const Rectangle& box, const ExportSettings& settings) {
  constexpr double kMarginMm = 10;
  Vec2 paper = paper_of(settings.pdf_paper);
  const Vec2 reach = glm::max(glm::abs(box.min), glm::abs(box.max)) + kMarginMm;
  const std::string& orientation = settings.pdf_orientation;
  if (orientation == "landscape" || (orientation == "auto" && reach.x > reach.y)) {
    std::swap(paper.x, paper.y);
  }
  return glm::max(glm::ceil(reach * kPointsPerMm), paper / 2.0);
}

/// Appends red, green and blue and the operator that takes them.
void append_color(std::string& text, const std::string& name, const char* action) {
  const auto color = language::color_of_name(name).value_or(std::array<float, 4>{});
  for (const size_t channel : {0, 1, 2}) {
    append_number(text, color[channel]);
    text += ' ';
  }
  text += action;
  text += ' ';
}

/// Returns the text as PDF's strings have it: beyond ASCII in UTF-8 with its mark, as of PDF 2.0.
std::string pdf_string(const std::string& text) {
  const bool is_ascii = std::all_of(text.begin(), text.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  std::string written = is_ascii ? "(" : "(\xEF\xBB\xBF";
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') written += '\\';
    written += c;
  }
  return written + ")";
}

std::string document_information(const ExportSettings& settings) {
  std::string text = "<< ";
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) text += std::string("/") + key + " " + pdf_string(value) + " ";
  };
  if (settings.pdf_meta_data) {
    add("Title", settings.pdf_title);
    add("Author", settings.pdf_author);
    add("Subject", settings.pdf_subject);
    add("Keywords", settings.pdf_keywords);
  }
  return text + "/Producer (scadray) >>";
}

}  // namespace

std::string pdf_of(const Polygons& outlines, const ExportSettings& settings) {
  const Vec2 half_page = half_page_of(bounds_of(outlines), settings);
  const ExportSettings::Stroke& look = settings.pdf;
  std::string drawing;
  append_color(drawing, look.stroke_color, "RG");
  if (look.fill) append_color(drawing, look.fill_color, "rg");
  append_number(drawing, static_cast<float>(look.stroke_width * kPointsPerMm));
  drawing += " w 0 J 0 j\n";
  const auto append_point = [&](const Vec2& point, char action) {
    const Vec2 place = point * kPointsPerMm + half_page;
    append_fixed(drawing, place.x, kDigitsOfPoints);
    drawing += ' ';
    append_fixed(drawing, place.y, kDigitsOfPoints);
    drawing += std::string(" ") + action + '\n';
  };
  for (const Polygon& outline : outlines) {
    for (size_t i = 0; i < outline.size(); ++i) append_point(outline[i], i == 0 ? 'm' : 'l');
    drawing += "h\n";
  }
  // Holes are not filled: B*, f* and S paint both, the inside alone, the lines alone; n nothing.
  drawing += look.fill && look.stroke ? "B*" : look.fill ? "f*" : look.stroke ? "S" : "n";
  std::string page_size;
  append_fixed(page_size, 2 * half_page.x, 0);
  page_size += ' ';
  append_fixed(page_size, 2 * half_page.y, 0);
  PdfFile file;
  file.add("<< /Type /Catalog /Pages 2 0 R >>");
  file.add("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
  file.add("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + page_size +
           "] /Resources << >> /Contents 4 0 R >>");
  file.add("<< /Length " + std::to_string(drawing.size()) + " >>\nstream\n" + drawing +
           "\nendstream");
  file.add(document_information(settings));
  return file.finish();
}

}  // namespace frontend
