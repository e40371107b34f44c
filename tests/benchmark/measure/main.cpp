// Measures scadray and its peers; tests/benchmark/run calls it. Writes a results file (JSON), and
// keeps the file's other sections if they are of the same commit and machine.
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>

#include "machine.hpp"
#include "section.hpp"

namespace {

namespace options = boost::program_options;
using nlohmann::json;

std::string names_of_sections() {
  std::string names;
  for (const measure::Section& section : measure::sections()) {
    names += (names.empty() ? "" : ", ") + std::string(section.name);
  }
  return names;
}

/// Returns the sections of the file if they are of the same machine and commit; else nothing.
json sections_kept(const std::filesystem::path& file, const json& machine) {
  std::ifstream stream(file);
  const json old = json::parse(stream, nullptr, false);
  if (!old.is_object()) return json::object();
  const json before = old.value("machine", json::object());
  for (const char* key : {"processor", "cores", "commit"}) {
    if (before.value(key, json()) != machine.at(key)) return json::object();
  }
  return old.value("sections", json::object());
}

/// Writes all or nothing: the old file stays until the new one is complete.
void write(const std::filesystem::path& file, const json& results) {
  const std::filesystem::path fresh = file.string() + ".new";
  std::ofstream stream(fresh);
  stream << results.dump(1) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(fresh.string() + ": cannot be written");
  std::filesystem::rename(fresh, file);
}

int run(int argc, char** argv) {
  measure::Settings settings;
  settings.examples = SCADRAY_EXAMPLES_DIR;
  std::vector<std::string> wanted;
  std::string output, folder, scadray;
  options::options_description described("measure [options]; sections: " + names_of_sections());
  described.add_options()("help,h", "this text")(
      "output,o", options::value(&output)->default_value("results.json"), "the results file")(
      "section,s", options::value(&wanted),
      "only this one, and the others as they were; repeatable")(
      "scadray", options::value(&scadray)->default_value(SCADRAY_PROGRAM),
      "the program that is measured as a process")(
      "folder", options::value(&folder)->default_value("benchmark_work"),
      "for exported designs and pictures; kept")(
      "peer-limit", options::value(&settings.peer_limit_s)->default_value(settings.peer_limit_s),
      "seconds that a peer may take for one picture")(
      "most-primitives",
      options::value(&settings.most_primitives)->default_value(settings.most_primitives),
      "of the largest scene")("threads", options::value(&settings.threads)->default_value(2),
                              "of scadray and Embree")(
      "quick", options::bool_switch(&settings.quick), "a few of each kind, to see that all works");
  options::variables_map values;
  options::store(options::parse_command_line(argc, argv, described), values);
  options::notify(values);
  if (values.count("help") > 0) {
    std::cout << described;
    return 0;
  }
  for (const std::string& name : wanted) {
    const auto all = measure::sections();
    if (std::none_of(all.begin(), all.end(), [&](const auto& s) { return name == s.name; })) {
      throw std::runtime_error("no section " + name + " (there are: " + names_of_sections() + ")");
    }
  }
  settings.scadray = scadray;
  if (settings.quick) settings.repetitions = {1, 2, 0};
  std::filesystem::create_directories(folder);
  settings.work_folder = std::filesystem::canonical(folder);

  const json machine = measure::describe_machine(settings);
  json kept = wanted.empty() ? json::object() : sections_kept(output, machine);
  for (const measure::Section& section : measure::sections()) {
    const bool is_wanted = std::find(wanted.begin(), wanted.end(), section.name) != wanted.end();
    if (!wanted.empty() && !is_wanted) continue;
    measure::say(std::string("== ") + section.title);
    settings.keep = [&](const json& result) {
      kept[section.name] = result;
      write(output, {{"format", 1}, {"machine", machine}, {"sections", kept}});
    };
    settings.keep(section.measure(settings));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const measure::WrongAnswer& wrong) {
    std::fprintf(stderr, "measure: wrong answer: %s: no times\n", wrong.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measure: error: %s\n", error.what());
  }
  return 1;
}
