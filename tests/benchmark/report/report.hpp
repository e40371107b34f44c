// What the results file holds, as text, tables and plots.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "plot.hpp"

namespace report {

/// The report: a file of its own, which stands in the folder of its plots.
struct Report {
  std::string markdown;
  std::vector<Figure> figures;  // in the order in which the text shows them

  void heading(const std::string& title) { markdown += "\n## " + title + "\n"; }
  /// Adds a paragraph, wrapped at the width of the repository's Markdown files.
  void text(const std::string& paragraph);
  /// Nothing of a table without rows.
  void table(const class Table& table);
  /// A long one, behind a line to click on.
  void folded(const std::string& title, const class Table& table);
  /// Nothing of a figure without points.
  void figure(Figure figure, const std::string& alternative);
};

/// One section of the results, which is not empty. Throws nlohmann::json::exception where it is not
/// as its section's file says.
struct Chapter {
  const char* section;
  void (*write)(const nlohmann::json& section, Report& report);
};
std::span<const Chapter> chapters();

/// The whole of it; sections that are missing or null are left out. Throws std::runtime_error,
/// naming the section that is not as it has to be.
Report make_report(const nlohmann::json& results);

/// What the repository's README.md says of the results: the machine, one table (how many times as
/// fast as other programs scadray is) and one of the report's plots, with a link to the report.
/// `folder` is the report's folder as README.md links to it. What was not measured is left out.
/// Throws as make_report does.
std::string make_summary(const nlohmann::json& results, const std::string& folder);

/// A paragraph between two blank lines, wrapped like Report::text.
std::string paragraph(const std::string& text);

/// Adds the error section's table and its plot of one design, for README.md.
void write_error_summary(const nlohmann::json& section, const std::string& folder,
                         std::string& summary);

void write_opengl(const nlohmann::json& section, Report& report);
void write_paper(const nlohmann::json& section, Report& report);
void write_whole(const nlohmann::json& section, Report& report);
void write_error(const nlohmann::json& section, Report& report);
void write_frames(const nlohmann::json& section, Report& report);
void write_scale(const nlohmann::json& section, Report& report);
void write_stability(const nlohmann::json& section, Report& report);

// --- What chapters share ---

double median(const nlohmann::json& summary);
/// With the quartiles for ends.
Point summary_point(double x, const nlohmann::json& summary);
/// "8.13 (8.01–8.4)": median and quartiles.
std::string with_spread(const nlohmann::json& summary);
/// "CS1000" for "cs1000"; others as they are.
std::string design_title(const std::string& design);

}  // namespace report
