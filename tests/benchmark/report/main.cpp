// Writes the report of what `measure` has found, with its plots, and the summary in README.md.
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "readme.hpp"
#include "report.hpp"

namespace {

namespace options = boost::program_options;

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open()) throw std::runtime_error(file.string() + ": cannot be read");
  return text;
}

/// Writes all or nothing.
void write(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream stream(fresh, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(fresh.string() + ": cannot be written");
  std::filesystem::rename(fresh, file);
}

/// Removes the plots of an earlier report that are not in this one.
void remove_others(const std::filesystem::path& folder, const report::Report& report) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".svg") old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) {
    const auto is_drawn = [&](const report::Figure& figure) { return file.stem() == figure.name; };
    if (std::none_of(report.figures.begin(), report.figures.end(), is_drawn)) {
      std::filesystem::remove(file);
    }
  }
}

int run(int argc, char** argv) {
  std::string results, folder, readme, link, gnuplot;
  options::options_description described("benchmark_report [options]");
  described.add_options()("help,h", "this text")("results", options::value(&results)->required(),
                                                 "what measure has written")(
      "report", options::value(&folder)->required(),
      "the folder of the report and its plots; other plots are removed from it")(
      "summary", options::value(&readme)->required(),
      "the repository's README.md, or a copy: its marked part is replaced")(
      "link", options::value(&link)->default_value("tests/benchmark/results"),
      "the report's folder, as README.md links to it")(
      "gnuplot", options::value(&gnuplot)->default_value("gnuplot"), "the program");
  options::variables_map values;
  options::store(options::parse_command_line(argc, argv, described), values);
  if (values.count("help") > 0) {
    std::cout << described;
    return 0;
  }
  options::notify(values);

  const std::string old_readme = contents_of(readme);
  const nlohmann::json measured = nlohmann::json::parse(contents_of(results), nullptr, false);
  if (measured.is_discarded()) throw std::runtime_error(results + ": is no JSON (measure again)");
  const report::Report report = report::make_report(measured);
  const std::string new_readme =
      report::with_region(old_readme, report::make_summary(measured, link));
  std::filesystem::create_directories(folder);
  for (const report::Figure& figure : report.figures) report::draw(figure, folder, gnuplot);
  remove_others(folder, report);
  write(std::filesystem::path(folder) / "README.md", report.markdown);
  write(readme, new_readme);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark_report: error: %s\n", error.what());
  }
  return 1;
}
