// SVG, in millimetres, with y downwards.

#include <cmath>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

namespace frontend {

std::string xml_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string svg_of(const Polygons& outlines, const ExportSettings& settings) {
  const Rectangle box = bounds_of(outlines);
  const Vec2 min = glm::floor(box.min), max = glm::ceil(box.max);
  std::string width, height, corner;
  append_fixed(width, max.x - min.x, 0);
  append_fixed(height, max.y - min.y, 0);
  append_fixed(corner, min.x, 0);
  corner += ' ';
  append_fixed(corner, -max.y, 0);
  std::string text =
      "<?xml version=\"1.0\" standalone=\"no\"?>\n"
      "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" "
      "\"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n"
      "<svg width=\"" +
      width + "mm\" height=\"" + height + "mm\" viewBox=\"" + corner + ' ' + width + ' ' + height +
      "\" xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\">\n"
      "<title>OpenSCAD Model</title>\n"
      "<path d=\"\n";
  constexpr size_t kPointsOfLine = 6;
  for (const Polygon& outline : outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      if (i > 0) text += i % kPointsOfLine == 0 ? "\n " : " ";
      text += i == 0 ? "M " : "L ";
      append_number(text, outline[i].x);
      text += ',';
      append_number(text, -outline[i].y);
    }
    text += " z\n";
  }
  const ExportSettings::Stroke& stroke = settings.svg;
  const auto color = [](bool is_drawn, const std::string& name) {
    return is_drawn ? xml_text(name) : std::string("none");
  };
  text += "\" stroke=\"" + color(stroke.stroke, stroke.stroke_color) + "\" fill=\"" +
          color(stroke.fill, stroke.fill_color) + "\" stroke-width=\"";
  append_number(text, stroke.stroke_width);
  return text + "\"/>\n</svg>\n";
}

}  // namespace frontend
