// Turns a results file into text, tables and plots.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "plot.hpp"

namespace report {

/// The report, a file in the folder of its plots.
struct Report {
  std::string markdown;
  std::vector<Figure> figures;  // in the order of the text

  void heading(const std::string& title) { markdown += "\n## " + title + "\n"; }
  /// Adds a paragraph, wrapped at the width of the repository's Markdown files.
  void text(const std::string& paragraph);
  /// Adds a table; nothing if it has no rows.
  void table(const class Table& table);
  /// Adds a long table, hidden behind a line to click on.
  void folded(const std::string& title, const class Table& table);
  /// Adds a figure; nothing if it has no points.
  void figure(Figure figure, const std::string& alternative);
};

/// Writes one section of the results, which must not be empty. Throws nlohmann::json::exception if
/// it is not as its section's file says.
struct Chapter {
  const char* section;
  void (*write)(const nlohmann::json& section, Report& report);
};
std::span<const Chapter> chapters();

/// Returns the whole report; sections that are missing or null are left out. Throws
/// std::runtime_error, naming the section that is malformed.
Report make_report(const nlohmann::json& results);

/// Returns the summary for the repository's README.md: the machine, one table (how many times as
/// fast as other programs scadray is), and one of the report's plots, with a link to the report.
/// `folder` is the report's folder as README.md links to it. What was not measured is left out.
/// Throws as make_report does.
std::string make_summary(const nlohmann::json& results, const std::string& folder);

/// Returns a paragraph between two blank lines, wrapped like Report::text.
std::string paragraph(const std::string& text);

/// Adds the error section's table, and its plot of one design, for README.md.
void write_error_summary(const nlohmann::json& section, const std::string& folder,
                         std::string& summary);

void write_opengl(const nlohmann::json& section, Report& report);
void write_paper(const nlohmann::json& section, Report& report);
void write_whole(const nlohmann::json& section, Report& report);
void write_error(const nlohmann::json& section, Report& report);
void write_frames(const nlohmann::json& section, Report& report);
void write_scale(const nlohmann::json& section, Report& report);
void write_stability(const nlohmann::json& section, Report& report);

// --- Functions for several chapters ---

double median(const nlohmann::json& summary);
/// Returns the point of the median, with the quartiles as ends of its error bar.
Point summary_point(double x, const nlohmann::json& summary);
/// Returns "8.13 (8.01–8.4)": median and quartiles.
std::string with_spread(const nlohmann::json& summary);
/// Returns "CS1000" for "cs1000", and other names unchanged.
std::string design_title(const std::string& design);

}  // namespace report
