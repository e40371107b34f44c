// Plots, drawn by gnuplot as SVG.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace report {

struct Axis {
  std::string title;  // with its unit
  bool is_logarithmic = true;
  /// Where a logarithmic axis shows what is 0, marked as such; else zeros are not drawn.
  std::optional<double> zero_at{};
  /// The axis reaches at least so far up.
  std::optional<double> up_to{};
};

struct Point {
  double x = 0;
  double y = 0;
  /// Ends of an error bar; equal: none.
  double low = 0, high = 0;
};
/// Without an error bar.
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

/// One picture: panels side by side, which share a legend: series of the same name look the same.
struct Figure {
  std::string name;  // of the file, without ".svg"
  std::vector<Panel> panels;
};

/// What gnuplot is told. The same figure gives the same bytes.
std::string gnuplot_script(const Figure& figure, const std::filesystem::path& svg);

/// Draws FOLDER/NAME.svg. Throws std::runtime_error where gnuplot cannot, and leaves no file.
void draw(const Figure& figure, const std::filesystem::path& folder, const std::string& gnuplot);

}  // namespace report
