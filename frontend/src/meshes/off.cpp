// OFF: points, and faces of any number of corners.
#include <algorithm>
#include <array>

#include "csg/lexer.hpp"
#include "meshes/number_text.hpp"
#include "meshes/read_solid_file.hpp"

namespace frontend {
namespace {

/// The words of the file, without its comments.
class OffText {
 public:
  explicit OffText(std::string_view text) : text_(text) {}

  std::string_view word() {
    for (;;) {
      std::string_view rest = text_;
      const std::string_view word = take_word(rest);
      if (!word.starts_with('#')) {
        text_ = rest;
        return word;
      }
      text_ = text_.substr(static_cast<size_t>(word.data() - text_.data()));
      take_line(text_);
    }
  }
  /// Takes the rest of the line, and returns it without a comment.
  std::string_view end_line() {
    const std::string_view line = take_line(text_);
    return line.substr(0, line.find('#'));
  }

 private:
  std::string_view text_;
};

bool is_header(std::string_view word) {
  if (!word.ends_with("OFF")) return false;
  word.remove_suffix(3);
  return word.find_first_not_of("STCN") == std::string_view::npos;
}

bool read_points(OffText& text, uint32_t count, FaceSet& faces) {
  for (uint32_t i = 0; i < count; ++i) {
    csgcore::Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> coordinate = number_of(text.word());
      if (!coordinate) return false;
      point[axis] = *coordinate;
    }
    faces.points.push_back(point);
    text.end_line();
  }
  return true;
}

/// Reads a channel of a colour, which has a point if it is none of 255ths.
std::optional<float> off_channel(std::string_view word) {
  const std::optional<double> number = number_of(word);
  if (!number || *number < 0) return std::nullopt;
  const double share = word.find('.') == std::string_view::npos ? *number / 255 : *number;
  return static_cast<float>(std::min(share, 1.0));
}

/// Returns nothing if the words are no colour.
std::optional<csgcore::Color> off_color(std::string_view words) {
  std::array<float, 4> channels{0, 0, 0, 1};
  for (size_t i = 0; i < channels.size(); ++i) {
    const std::string_view word = take_word(words);
    if (i == 3 && word.empty()) break;
    const std::optional<float> channel = off_channel(word);
    if (!channel) return std::nullopt;
    channels[i] = *channel;
  }
  return csgcore::Color{channels[0], channels[1], channels[2], channels[3]};
}

/// By 2026's rules `file` gets colours, and is told of corners that are left out.
bool read_faces(OffText& text, uint32_t count, bool is_of_2026, const std::string& name,
                SolidFile& file) {
  FaceSet& faces = file.faces;
  for (uint32_t i = 0; i < count; ++i) {
    const std::optional<uint32_t> corners = index_of(text.word());
    if (!corners) return false;
    for (uint32_t k = 0; k < *corners; ++k) {
      const std::string_view word = text.word();
      const std::optional<uint32_t> corner = index_of(word);
      const bool is_right = corner && *corner < faces.points.size();
      if (is_right) faces.corners.push_back(*corner);
      if (is_right) continue;
      if (!is_of_2026 || word.empty()) return false;
      if (!file.problem.empty()) continue;
      file.problem =
          "OFF: ignored bad face vertex index: " + quoted(word) + " importing file '" + name + "'";
    }
    faces.end_face();
    const std::string_view rest = text.end_line();
    if (is_of_2026) faces.colors.push_back(off_color(rest));
  }
  return true;
}

SolidFile read_off_file(std::string_view bytes, const std::string& name, bool is_of_2026) {
  SolidFile file;
  OffText text(bytes);
  const bool has_header = is_header(text.word());
  const std::optional<uint32_t> points = index_of(text.word()), faces = index_of(text.word());
  if (has_header && points && faces) {
    text.end_line();  // with the count of edges
    if (read_points(text, *points, file.faces) &&
        read_faces(text, *faces, is_of_2026, name, file)) {
      return file;
    }
  }
  file.faces = {};
  file.problem = "The file '" + name + "' is not in OFF";
  return file;
}

}  // namespace

SolidFile read_off(std::string_view bytes, const std::string& name) {
  return read_off_file(bytes, name, false);
}

SolidFile read_colored_off(std::string_view bytes, const std::string& name) {
  return read_off_file(bytes, name, true);
}

}  // namespace frontend
