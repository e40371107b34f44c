// AMF, as plain XML.

#include <string_view>

#include "export/model_writers.hpp"
#include "export/written_numbers.hpp"

namespace frontend {
namespace {

/// Appends a line with an element that holds a number.
template <typename Number>
void append_element(std::string& text, std::string_view name, Number number) {
  text.append("     <").append(name) += '>';
  append_number(text, number);
  text.append("</").append(name) += ">\n";
}

}  // namespace

std::string amf_of(const csgcore::TriangleSet& surface) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<amf unit=\"millimeter\">\n"
      " <metadata type=\"producer\">scadray</metadata>\n"
      " <object id=\"0\">\n"
      "  <mesh>\n"
      "   <vertices>\n";
  for (const csgcore::Vec3& vertex : surface.vertices) {
    text += "    <vertex><coordinates>\n";
    append_element(text, "x", static_cast<float>(vertex.x));
    append_element(text, "y", static_cast<float>(vertex.y));
    append_element(text, "z", static_cast<float>(vertex.z));
    text += "    </coordinates></vertex>\n";
  }
  text += "   </vertices>\n   <volume>\n";
  for (const std::array<uint32_t, 3>& t : surface.triangles) {
    text += "    <triangle>\n";
    append_element(text, "v1", t[0]);
    append_element(text, "v2", t[1]);
    append_element(text, "v3", t[2]);
    text += "    </triangle>\n";
  }
  return text + "   </volume>\n  </mesh>\n </object>\n</amf>\n";
}

}  // namespace frontend
