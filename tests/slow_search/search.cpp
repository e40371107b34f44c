#include "search.hpp"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "families.hpp"
#include "mutation.hpp"
#include "process.hpp"

namespace slow_search {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "scadray-slow-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The limit for `cube(1);` on any machine.
constexpr double kBaseLimit_s = 30;

struct Timing {
  double median_ms = 0;
  double cpu_ms = 0;  // the least: load by others only adds to it
  double peak_mb = 0;
  std::string end;  // as in Found
};

class Timer {
 public:
  explicit Timer(const fs::path& program) : program_(program) {}

  /// Returns nothing if the design is refused, or if its first picture takes less than `least_ms`.
  std::optional<Timing> time(const std::string& text, double least_ms, double limit_s) {
    constexpr std::size_t kRuns = 3;
    const fs::path design = folder_.path() / "design.csg";
    std::ofstream(design, std::ios::binary) << text;
    Timing timing;
    std::array<double, kRuns> times{};
    for (double& time : times) {
      measure::ProcessOptions options;
      options.limit_s = limit_s;
      const measure::ProcessResult run =
          measure::run_process({program_, "-q", "--renderer=cpu", "--imgsize=640,480", "-o",
                                folder_.path() / "picture.png", design},
                               options);
      time = run.wall_ms;
      timing.cpu_ms = &time == times.data() ? run.cpu_ms : std::min(timing.cpu_ms, run.cpu_ms);
      timing.peak_mb = std::max(timing.peak_mb, static_cast<double>(run.peak_bytes) / 1e6);
      if (run.timed_out || !run.status) {
        timing.end = run.timed_out ? "over the limit" : "signal";
        timing.median_ms = run.wall_ms;
        return timing;
      }
      if (!run.succeeded() || times[0] < least_ms) return std::nullopt;
    }
    std::sort(times.begin(), times.end());
    timing.median_ms = times[kRuns / 2];
    return timing;
  }

 private:
  const fs::path program_;
  TemporaryFolder folder_;
};

struct Candidate {
  std::string family;
  Design design;
};

class Search {
 public:
  explicit Search(const Settings& settings)
      : settings_(settings), random_(settings.seed), timer_(settings.program) {
    const std::optional<Timing> base = timer_.time("cube(1);", 0, kBaseLimit_s);
    if (!base || !base->end.empty()) {
      throw std::runtime_error(settings.program.string() + " does not draw cube(1);");
    }
    result_.base_ms = base->median_ms;
  }

  Result run() {
    for (Candidate& start : starts()) {
      if (!goes_on()) break;
      judge(std::move(start));
    }
    while (goes_on()) judge(next());
    result_.found = archive_.ranked(settings_.threshold_ms);
    return std::move(result_);
  }

 private:
  bool goes_on() const {
    const double taken_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const bool has_designs_left = settings_.designs == 0 || result_.designs < settings_.designs;
    return has_designs_left && taken_s < settings_.seconds && settings_.goes_on();
  }

  std::vector<Candidate> starts() {
    std::vector<Candidate> candidates;
    for (const fs::path& path : settings_.starts) {
      const std::optional<Design> design = parse(text_of_file(path));
      if (design) candidates.push_back({path.stem(), *design});
    }
    for (const int count : {20, 200}) {
      for (const Family& family : families()) candidates.push_back(made(family, count));
    }
    return candidates;
  }

  /// Makes a design of the family, and halves the count if the text gets too large.
  Candidate made(const Family& family, int count) {
    for (;;) {
      const std::optional<Design> design = parse(family.make(random_, count));
      if (!design) throw std::logic_error(std::string(family.name) + " is no design");
      if (count <= 1 || text_of(*design).size() <= kMostBytes) return {family.name, *design};
      count /= 2;
    }
  }

  Candidate next() {
    if (archive_.empty() || random_.one_in(6)) {
      const auto& all = families();
      return made(all[random_.below(all.size())], random_.from_to(2, 4 << random_.below(9)));
    }
    const Found& parent = archive_.any(random_);
    return {parent.family, mutated(parent.design, archive_.any(random_).design, random_)};
  }

  void judge(Candidate candidate) {
    ++result_.designs;
    const std::string text = text_of(candidate.design);
    if (text.empty() || text.size() > kMostBytes) return;
    const double least = archive_.least_excess_ms(candidate.family, text.size());
    const std::optional<Timing> timing =
        timer_.time(text, result_.base_ms + least, settings_.limit_s);
    if (!timing) return;
    ++result_.drawn;
    Found found{std::move(candidate.family),
                std::move(candidate.design),
                text.size(),
                std::max(0.0, timing->median_ms - result_.base_ms),
                timing->cpu_ms,
                timing->peak_mb,
                timing->end};
    if (found.excess_ms > settings_.threshold_ms || !found.end.empty()) say(found);
    archive_.add(std::move(found));
  }

  void say(const Found& found) const {
    char line[200];
    std::snprintf(line, sizeof line, "design %llu: %.0f ms beyond cube(1);, %zu bytes, %s%s%s",
                  static_cast<unsigned long long>(result_.designs), found.excess_ms, found.bytes,
                  found.family.c_str(), found.end.empty() ? "" : ", ", found.end.c_str());
    settings_.say(line);
  }

  const Settings& settings_;
  const Clock::time_point start_ = Clock::now();
  Random random_;
  Timer timer_;
  Archive archive_;
  Result result_;
};

}  // namespace

Result search(const Settings& settings) { return Search(settings).run(); }

void write(const Result& result, const Settings& settings, const fs::path& folder) {
  std::ofstream table(folder / "found.txt");
  char line[300];
  std::snprintf(line, sizeof line,
                "# seed %llu: %llu designs, %llu timed in full; cube(1); takes %.1f ms, %.0f ms "
                "beyond that is slow\n",
                static_cast<unsigned long long>(settings.seed),
                static_cast<unsigned long long>(result.designs),
                static_cast<unsigned long long>(result.drawn), result.base_ms,
                settings.threshold_ms);
  table << line << "#  ms beyond cube(1);  CPU ms   bytes   ms/kB   peak MB  file\n";
  std::size_t rank = 0;
  for (const Found& found : result.found) {
    std::snprintf(line, sizeof line, "%03zu_%s.csg", ++rank, found.family.c_str());
    const std::string name = line;
    std::ofstream(folder / name, std::ios::binary) << text_of(found.design);
    std::snprintf(line, sizeof line, "%22.1f %7.0f %7zu %7.1f %9.0f  %s%s%s\n", found.excess_ms,
                  found.cpu_ms, found.bytes, 1000 * found.ms_per_byte(), found.peak_mb,
                  name.c_str(), found.end.empty() ? "" : "  ", found.end.c_str());
    table << line;
  }
  if (!table.flush()) throw std::runtime_error((folder / "found.txt").string() + ": cannot write");
}

}  // namespace slow_search
