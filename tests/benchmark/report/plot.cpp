#include "plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "process.hpp"

namespace report {
namespace {

constexpr int kPanelWidth_px = 800, kSmallPanelWidth_px = 480;
constexpr int kHeight_px = 500;
/// The legend under the panels: the height of a line, and the names in one.
constexpr int kLegendLine_px = 24;
constexpr size_t kNamesPerLine = 3;

/// Okabe and Ito's colours, which all eyes can tell apart; filled marks, then open ones.
constexpr std::array kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                             "#e69f00", "#56b4e9", "#000000", "#8c564b"};
constexpr std::array kMarks{7, 5, 9, 11, 13, 15, 6, 4, 8, 10, 12, 14};

/// Escapes a string in single quotes that gnuplot takes for "enhanced text".
std::string quoted(const std::string& text) {
  static const std::string kSpecial = "_^{}@&~\\";
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    if (kSpecial.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result + "'";
}

/// Returns the value if the axis can show it.
std::optional<double> shown(const Axis& axis, double value) {
  if (!std::isfinite(value)) return {};
  if (!axis.is_logarithmic || value > 0) return value;
  return axis.zero_at;
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

/// Returns the range of what is measured; empty if nothing is.
Range range_of(const Panel& panel, const Axis& axis, bool is_x) {
  Range range;
  for (const Series& series : panel.series) {
    if (series.style == Series::Style::kGuide) continue;
    for (const Point& point : series.points) {
      for (const double value :
           {is_x ? point.x : point.y, is_x ? point.x : point.low, is_x ? point.x : point.high}) {
        if (const auto place = shown(axis, value)) range.add(*place);
      }
    }
  }
  if (axis.up_to && !range.empty()) range.add(*axis.up_to);
  return range;
}

void write_axis(std::ostream& out, char name, const Axis& axis, const Range& range) {
  out << "set " << name << "label " << quoted(axis.title) << "\n";
  if (!axis.is_logarithmic) {
    out << "unset logscale " << name << "\nset format " << name << " '%g'\n";
    if (name == 'y' || range.low >= 0) out << "set " << name << "range [0:*]\n";
    out << "set " << name << "tics autofreq\n";
    return;
  }
  out << "set logscale " << name << "\n";
  // The range ends at whole decades, so that both ends have a tick. A value hardly beyond one (CSn
  // has n + 1 primitives) needs no further decade. The margin shows such values, and gnuplot's
  // ticks at the ends.
  constexpr double kSlack = 0.01, kMargin = 1.03;
  const int first = static_cast<int>(std::floor(std::log10(range.low) + kSlack));
  int last = static_cast<int>(std::ceil(std::log10(range.high) - kSlack));
  last = std::max(last, first + 1);
  out << "set " << name << "range [" << std::pow(10.0, first) / kMargin << ":"
      << std::pow(10.0, last) * kMargin << "]\n";
  constexpr int kMostTicks = 8, kPlainDigits = 4;
  const int step = (last - first + kMostTicks - 1) / kMostTicks;
  const bool is_plain = first >= -kPlainDigits + 1 && last <= kPlainDigits;
  out << "set " << name << "tics (";
  for (int digits = first; digits <= last; digits += step) {
    if (digits != first) out << ", ";
    const double value = std::pow(10.0, digits);
    const bool is_zero = axis.zero_at && value <= *axis.zero_at * (1 + 1e-9);
    if (is_zero) {
      out << "'0'";
    } else if (is_plain) {
      out << "'" << value << "'";
    } else {
      out << "'10^{" << digits << "}'";
    }
    out << " 1e" << digits;
  }
  out << ")\n";
}

std::vector<std::string> names_of(const Figure& figure) {
  std::vector<std::string> names;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const bool is_known = std::find(names.begin(), names.end(), series.name) != names.end();
      if (!series.name.empty() && !is_known) names.push_back(series.name);
    }
  }
  return names;
}

/// Guides come first, so that they are behind.
std::vector<const Series*> in_drawing_order(const Panel& panel) {
  std::vector<const Series*> order;
  for (const Series& series : panel.series) order.push_back(&series);
  std::stable_partition(order.begin(), order.end(), [](const Series* series) {
    return series->style == Series::Style::kGuide;
  });
  return order;
}

/// Only what is measured gets colours, guides do not.
size_t look_of(const Series& series, const Figure& figure) {
  std::vector<std::string> names;
  for (const Panel& panel : figure.panels) {
    for (const Series& other : panel.series) {
      if (other.style == Series::Style::kGuide) continue;
      if (std::find(names.begin(), names.end(), other.name) == names.end()) {
        names.push_back(other.name);
      }
    }
  }
  return static_cast<size_t>(std::find(names.begin(), names.end(), series.name) - names.begin());
}

void write_data(std::ostream& out, const std::string& name, const Panel& panel,
                const Series& series) {
  out << name << " << EOD\n";
  for (const Point& point : series.points) {
    const auto x = shown(panel.x, point.x), y = shown(panel.y, point.y);
    if (!x || !y) continue;
    out << *x << " " << *y << " " << shown(panel.y, point.low).value_or(*y) << " "
        << shown(panel.y, point.high).value_or(*y) << "\n";
  }
  out << "EOD\n";
}

bool has_points(const Panel& panel, const Series& series) {
  return std::any_of(series.points.begin(), series.points.end(), [&](const Point& point) {
    return shown(panel.x, point.x) && shown(panel.y, point.y);
  });
}

bool has_error_bars(const Series& series) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [](const Point& point) { return point.low != point.high; });
}

void write_panel(std::ostream& out, const Figure& figure, size_t index) {
  const Panel& panel = figure.panels[index];
  const Range x = range_of(panel, panel.x, true), y = range_of(panel, panel.y, false);
  if (x.empty() || y.empty()) throw std::runtime_error(figure.name + ": nothing to draw");
  out << "set title " << quoted(panel.title) << "\n";
  write_axis(out, 'x', panel.x, x);
  write_axis(out, 'y', panel.y, y);
  std::vector<std::string> plots;
  size_t count = 0;
  for (const Series* series : in_drawing_order(panel)) {
    if (!has_points(panel, *series)) continue;
    const std::string data = "$p" + std::to_string(index) + "_" + std::to_string(count++);
    write_data(out, data, panel, *series);
    if (series->style == Series::Style::kGuide) {
      plots.push_back(data + " using 1:2 with lines dt 2 lw 1.5 lc rgb '#888888' notitle");
      continue;
    }
    const size_t look = look_of(*series, figure);
    const std::string color = std::string(" lc rgb '") + kColors[look % kColors.size()] + "'";
    const std::string mark = " pt " + std::to_string(kMarks[look % kMarks.size()]) + " ps 0.8";
    if (has_error_bars(*series)) {
      plots.push_back(data + " using 1:2:3:4 with yerrorbars pt 0 lw 1.2" + color + " notitle");
    }
    const bool is_joined = series->style == Series::Style::kLine;
    plots.push_back(data + " using 1:2 with " +
                    (is_joined ? "linespoints lw 2" + mark : "points" + mark) + color + " notitle");
  }
  out << "plot ";
  for (size_t i = 0; i < plots.size(); ++i) out << (i > 0 ? ", \\\n  " : "") << plots[i];
  out << "\n";
}

/// Writes an empty plot that has the key of all panels.
void write_legend(std::ostream& out, const Figure& figure, double share) {
  out << "set size 1," << share << "\nset origin 0,0\n"
      << "unset title\nunset xlabel\nunset ylabel\nunset border\nunset xtics\nunset ytics\n"
      << "unset grid\nunset logscale\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
      << "set xrange [0:1]\nset yrange [0:1]\n"
      << "set key center center horizontal Left reverse maxcols " << kNamesPerLine
      << " width 1\nplot ";
  std::set<std::string> done;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      if (series.name.empty() || !done.insert(series.name).second) continue;
      const size_t look = look_of(series, figure);
      const std::string color = std::string(" lc rgb '") + kColors[look % kColors.size()] + "'";
      const std::string mark = " pt " + std::to_string(kMarks[look % kMarks.size()]) + " ps 0.8";
      std::string with = "linespoints lw 2" + mark + color;
      if (series.style == Series::Style::kMarks) with = "points" + mark + color;
      if (series.style == Series::Style::kGuide) with = "lines dt 2 lw 1.5 lc rgb '#888888'";
      out << (done.size() > 1 ? ", \\\n  " : "") << "NaN with " << with << " title "
          << quoted(series.name);
    }
  }
  out << "\n";
}

}  // namespace

std::string gnuplot_script(const Figure& figure, const std::filesystem::path& svg) {
  const size_t panels = figure.panels.size(), names = names_of(figure).size();
  const int panel_width_px = panels == 1 ? kPanelWidth_px : kSmallPanelWidth_px;
  const auto lines = static_cast<int>((names + kNamesPerLine - 1) / kNamesPerLine);
  const int legend_px = lines == 0 ? 0 : kLegendLine_px * (lines + 1);
  const double legend_share = double(legend_px) / (kHeight_px + legend_px);
  std::ostringstream out;
  out << "set encoding utf8\nset terminal svg size " << panel_width_px * int(panels) << ","
      << kHeight_px + legend_px
      << " enhanced background '#ffffff' font 'Helvetica,Arial,sans-serif' fontscale 1.15\n"
      << "set output '" << svg.string() << "'\nset multiplot\n"
      << "set border 3 lc rgb '#444444'\nset tics nomirror\n"
      << "set grid lw 1 lc rgb '#dddddd'\nunset key\nset mxtics default\n";
  for (size_t i = 0; i < panels; ++i) {
    out << "set size " << 1.0 / double(panels) << "," << 1 - legend_share << "\nset origin "
        << double(i) / double(panels) << "," << legend_share << "\n";
    write_panel(out, figure, i);
  }
  if (names > 0) write_legend(out, figure, legend_share);
  out << "unset multiplot\n";
  return out.str();
}

void draw(const Figure& figure, const std::filesystem::path& folder, const std::string& gnuplot) {
  constexpr double kLimit_s = 60;
  const std::filesystem::path fresh = folder / (figure.name + ".svg.new");
  const std::filesystem::path script = folder / (figure.name + ".gnuplot");
  std::ofstream(script) << gnuplot_script(figure, fresh);
  const measure::ProcessResult result = measure::run_process({gnuplot, script}, {kLimit_s});
  std::filesystem::remove(script);
  if (!result.succeeded() || !std::filesystem::exists(fresh)) {
    std::filesystem::remove(fresh);
    throw std::runtime_error(
        figure.name + ".svg: " +
        (result.status == 127 ? gnuplot + " was not found" : gnuplot + ": " + result.output));
  }
  std::filesystem::rename(fresh, folder / (figure.name + ".svg"));
}

}  // namespace report
