#include "report.hpp"

#include <stdexcept>

#include "text.hpp"

namespace report {
namespace {

using nlohmann::json;

constexpr size_t kLineWidth = 100;

constexpr Chapter kChapters[] = {
    {"error", write_error}, {"whole", write_whole},         {"frames", write_frames},
    {"scale", write_scale}, {"stability", write_stability}, {"opengl", write_opengl},
    {"paper", write_paper},
};

std::string wrapped(const std::string& text) {
  std::string result;
  size_t line = 0;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const size_t length = end - start;
    const bool is_first = line == 0;
    if (!is_first && line + 1 + length > kLineWidth) {
      result += '\n';
      line = 0;
    } else if (!is_first) {
      result += ' ';
      ++line;
    }
    result.append(text, start, length);
    line += length;
    start = end + 1;
  }
  return result + "\n";
}

/// Says on which machine, when and what was measured.
std::string description(const json& machine) {
  const double memory = machine.at("memory_bytes");
  std::vector<std::string> versions;
  for (const auto& [name, version] : machine.at("versions").items()) {
    versions.push_back(name + " " + version.get<std::string>());
  }
  return "Measured " + machine.at("date").get<std::string>().substr(0, 10) + " at commit " +
         machine.at("commit").get<std::string>() + " on " + number(machine.at("cores")) +
         " cores of: " + machine.at("processor").get<std::string>() + " (" +
         machine.at("instruction_set").get<std::string>() + "), " + bytes(memory) + " of memory, " +
         machine.at("system").get<std::string>() + ", " +
         machine.at("compiler").get<std::string>() + "; " + listed(versions) + ".";
}

std::string description_of_machine(const json& results) {
  try {
    return description(results.at("machine"));
  } catch (const json::exception& error) {
    throw std::runtime_error(std::string("no results of tests/benchmark/run: ") + error.what());
  }
}

void write_left_out(const json& section, Report& report) {
  const json reasons = section.value("left_out", json::array());
  if (reasons.empty()) return;
  std::string list = "\nLeft out:\n\n";
  for (const std::string reason : reasons) {
    // The first line gives the reason; what else a program printed does not belong into a report.
    list += "- " + reason.substr(0, reason.find('\n')) + "\n";
  }
  report.markdown += list;
}

}  // namespace

std::string paragraph(const std::string& text) { return "\n" + wrapped(text); }

void Report::text(const std::string& paragraph) { markdown += report::paragraph(paragraph); }

void Report::table(const Table& table) {
  if (!table.empty()) markdown += "\n" + table.markdown();
}

void Report::folded(const std::string& title, const Table& table) {
  if (table.empty()) return;
  markdown +=
      "\n<details><summary>" + title + "</summary>\n\n" + table.markdown() + "\n</details>\n";
}

void Report::figure(Figure figure, const std::string& alternative) {
  std::erase_if(figure.panels, [](const Panel& panel) {
    for (const Series& series : panel.series) {
      if (!series.points.empty() && series.style != Series::Style::kGuide) return false;
    }
    return true;
  });
  if (figure.panels.empty()) return;
  markdown += "\n![" + alternative + "](" + figure.name + ".svg)\n";
  figures.push_back(std::move(figure));
}

std::span<const Chapter> chapters() { return kChapters; }

Report make_report(const json& results) {
  Report report;
  report.markdown = "# Benchmarks\n";
  report.text(
      "[`tests/benchmark/run`](../run) wrote this file, its plots and "
      "[results.json](results.json); "
      "nothing in them is written by hand. It installs what it needs on a Debian 12, builds, holds "
      "every picture against its truth before it takes a time, and measures. Times are medians; "
      "the "
      "quartiles stand in brackets, and as bars in the plots. What bounds each stage, and what was "
      "tried, is in [NOTES.md](../NOTES.md).");
  report.text(description_of_machine(results));
  const json sections = results.value("sections", json::object());
  for (const Chapter& chapter : kChapters) {
    const json section = sections.value(chapter.section, json());
    if (section.is_null() || section.empty()) continue;
    try {
      chapter.write(section, report);
      write_left_out(section, report);
    } catch (const json::exception& error) {
      throw std::runtime_error(std::string("section ") + chapter.section + ": " + error.what());
    }
  }
  return report;
}

std::string make_summary(const json& results, const std::string& folder) {
  std::string summary = paragraph(description_of_machine(results));
  const json section = results.value("sections", json::object()).value("error", json());
  if (section.is_null() || section.empty()) return summary;
  try {
    write_error_summary(section, folder, summary);
  } catch (const json::exception& error) {
    throw std::runtime_error(std::string("section error: ") + error.what());
  }
  return summary;
}

double median(const json& summary) { return summary.at("median"); }

Point summary_point(double x, const json& summary) {
  return {x, median(summary), summary.at("quartiles").at(0), summary.at("quartiles").at(1)};
}

std::string with_spread(const json& summary) {
  return number(median(summary)) + " (" + number(summary.at("quartiles").at(0)) + "–" +
         number(summary.at("quartiles").at(1)) + ")";
}

std::string design_title(const std::string& design) {
  const size_t digits = design.find_first_of("0123456789");
  if (digits == std::string::npos) return design;
  std::string title = design;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return title;
}

}  // namespace report
