#include "machine.hpp"

#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <regex>

#include "base/simd.hpp"
#include "process.hpp"

namespace measure {
namespace {

/// A program's words, and the place of its version in them.
struct Peer {
  const char* name;
  std::vector<std::string> command;
  const char* version;
};

std::string first_match(const std::string& text, const char* pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::string name = first_match(line, R"(^model name\s*:\s*(.*))");
    if (!name.empty()) return name;
  }
  return "unknown";
}

std::string system_name() {
  std::ifstream file("/etc/os-release");
  for (std::string line; std::getline(file, line);) {
    const std::string name = first_match(line, R"re(^PRETTY_NAME="(.*)")re");
    if (!name.empty()) return name;
  }
  return "unknown";
}

const char* name_of(csgcore::SimdLevel level) {
  switch (level) {
    case csgcore::SimdLevel::kAvx512:
      return "AVX-512";
    case csgcore::SimdLevel::kAvx2:
      return "AVX2";
    case csgcore::SimdLevel::kSse4:
      return "SSE4";
    case csgcore::SimdLevel::kBaseline:
      break;
  }
  return "baseline";
}

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%MZ", &utc);
  return text;
}

std::string commit_of(const std::filesystem::path& folder) {
  const auto git = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"git", "-C", folder});
    return run_process(arguments);
  };
  const ProcessResult head = git({"rev-parse", "--short=10", "HEAD"});
  if (!head.succeeded()) return "unknown";
  // What this program and the report write does not change what is measured.
  const ProcessResult changes = git({"status", "--porcelain", "--untracked-files=no", "--", ":/",
                                     ":!/README.md", ":!/tests/benchmark/results"});
  return first_match(head.output, R"((\w+))") + (changes.output.empty() ? "" : "+");
}

/// Returns the version of a Debian package; empty if it is not installed.
std::string package_version(const std::string& package) {
  const ProcessResult result = run_process({"dpkg-query", "-W", "-f=${Version}", package});
  return result.succeeded() ? result.output : "";
}

}  // namespace

nlohmann::json describe_machine(const Settings& settings) {
  const Peer peers[] = {
      {"scadray", {settings.scadray, "--version"}, R"(([\d.]+))"},
      {"OpenSCAD", {"openscad", "--version"}, R"(([\d.]+))"},
      {"POV-Ray", {"povray", "--version"}, R"(POV-Ray ([\d.]*\d))"},
  };
  nlohmann::json versions = nlohmann::json::object();
  for (const Peer& peer : peers) {
    const ProcessResult result = run_process(peer.command);
    const std::string version = first_match(result.output, peer.version);
    if (!version.empty()) versions[peer.name] = version;
  }
  for (const auto& [name, package] :
       {std::pair{"CGAL", "libcgal-dev"}, std::pair{"Embree", "libembree-dev"},
        std::pair{"Mesa", "libgl1-mesa-dri"}}) {
    const std::string version = package_version(package);
    if (!version.empty()) versions[name] = version;
  }
  struct sysinfo memory {};
  sysinfo(&memory);
  utsname kernel{};
  uname(&kernel);
  return {{"processor", processor()},
          {"cores", get_nprocs()},
          {"instruction_set", name_of(csgcore::simd_level())},
          {"memory_bytes", uint64_t{memory.totalram} * memory.mem_unit},
          {"system", system_name() + ", Linux " + kernel.release},
          {"compiler", std::string("GCC ") + __VERSION__},
          {"commit", commit_of(settings.examples)},
          {"date", now()},
          {"versions", versions}};
}

}  // namespace measure
