// Draws plots as SVG, by gnuplot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace report {

struct Axis {
  std::string title;  // with the unit
  bool is_logarithmic = true;
  /// Where a logarithmic axis shows 0, marked as such; nothing: zeros are not drawn.
  std::optional<double> zero_at{};
  /// The least upper end of the axis.
  std::optional<double> up_to{};
};

struct Point {
  double x = 0;
  double y = 0;
  /// Ends of an error bar; if they are equal, there is none.
  double low = 0, high = 0;
};
/// A point without an error bar.
inline Point point(double x, double y) { return {x, y, y, y}; }

struct Series {
  enum class Style {
    kLine,   // marks, joined
    kMarks,  // marks alone
    kGuide   // a dashed grey line without marks, behind the others
  };
  std::string name;  // in the legend; empty: not in it
  std::vector<Point> points;
  Style style = Style::kLine;
};

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

/// One picture: panels side by side, with a common legend. Series of the same name look the same.
struct Figure {
  std::string name;  // of the file, without ".svg"
  std::vector<Panel> panels;
};

/// Returns gnuplot's script. The same figure gives the same bytes.
std::string gnuplot_script(const Figure& figure, const std::filesystem::path& svg);

/// Draws FOLDER/NAME.svg. Throws std::runtime_error if gnuplot fails, and then leaves no file.
void draw(const Figure& figure, const std::filesystem::path& folder, const std::string& gnuplot);

}  // namespace report
