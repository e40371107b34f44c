// PDF: the outlines as lines on one page, in their true size.

#include <algorithm>
#include <cmath>
#include <vector>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

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

/// Returns half of the page's size in points: of A4, or what the outlines need with a margin.
Vec2 half_page_of(const Rectangle& box) {
  constexpr double kMarginMm = 10;
  const Vec2 half_a4(297.5, 421);
  const Vec2 reach = glm::max(glm::abs(box.min), glm::abs(box.max)) + kMarginMm;
  return glm::max(glm::ceil(reach * kPointsPerMm), half_a4);
}

}  // namespace

std::string pdf_of(const Polygons& outlines) {
  const Vec2 half_page = half_page_of(bounds_of(outlines));
  std::string drawing = "0 0 0 RG 1 w 0 J 0 j\n";
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
  drawing += "S";
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
  file.add("<< /Title (OpenSCAD Model) /Producer (scadray) >>");
  return file.finish();
}

}  // namespace frontend
