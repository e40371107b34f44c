// The files of heights that OpenSCAD's surface() reads, and the solid below them.
// - In lines of numbers # begins a comment. Short rows end in zeros. At a word that is no number,
//   or one beyond the largest double, the reading stops; a row that it begins is none.
// - A pixel is 100/255 · (0.2126 R + 0.7152 G + 0.0722 B) high, and with `invert` 100/255 · (1 −
//   that luminance), which is mostly below 0.
// - The bottom is at the smaller of 0 and 1 below the lowest number. Every cell has four triangles
//   around its middle, which has the mean of its corners' heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "meshes/face_set.hpp"

namespace frontend {

/// The luminance of a PNG picture, 0 to 255.
struct GrayPicture {
  size_t columns = 0, rows = 0;
  std::vector<double> values;  // row by row from the top
};

bool is_png(std::string_view bytes);

/// Reads a picture of any type and depth, which begins as one (is_png()); transparency is ignored.
/// Returns nothing if it is damaged
/// or has more than `most_pixels`.
std::optional<GrayPicture> read_gray_png(std::string_view bytes, size_t most_pixels);

/// Heights over a grid of unit cells. Row 0 is at y = 0.
struct HeightMap {
  size_t columns = 0, rows = 0;
  std::vector<double> heights;  // row by row
  double base = 0;              // the height of the bottom
  std::string problem;          // OpenSCAD's message where it has one; empty: none

  double at(size_t column, size_t row) const { return heights[row * columns + column]; }
};

/// The largest map: one with more cells is not read. Each cell has four triangles, which take some
/// 800 bytes in all.
constexpr size_t kMostCells = size_t{1} << 20;

/// Reads a PNG, whatever its name, and otherwise lines of numbers. In a PNG, white is 100 high and
/// black 0; if it is inverted, black is 100/255 and white 100 below that. `name` is for messages.
HeightMap read_height_map(std::string_view bytes, const std::string& name, bool is_inverted);

/// Returns the faces of the solid between the heights and their base: of each cell four triangles
/// around its middle, which has their mean height. `is_centered`: the grid's middle is at x = y =
/// 0.
FaceSet solid_below(const HeightMap& map, bool is_centered);

}  // namespace frontend
