// DXF: each edge as a LINE in layer 0.

#include <utility>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

namespace frontend {

std::string dxf_of(const Polygons& outlines) {
  std::string text = "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n";
  visit_edges(outlines, [&](const Vec2& start, const Vec2& end) {
    text += "  0\nLINE\n  8\n0\n";
    for (const auto& [code, coordinate] : {std::pair(10, start.x), std::pair(20, start.y),
                                           std::pair(11, end.x), std::pair(21, end.y)}) {
      text += ' ' + std::to_string(code) + '\n';
      append_number(text, coordinate);
      text += '\n';
    }
  });
  return text + "  0\nENDSEC\n  0\nSECTION\n  2\nOBJECTS\n  0\nDICTIONARY\n  0\nENDSEC\n  0\nEOF\n";
}

}  // namespace frontend
