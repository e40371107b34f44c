// Runs the recorded command lines (command_lines) with openscad and with scadray. The pictures must
// be equal, apart from single pixels at edges.
#include <gtest/gtest.h>
#include <spng.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/full_run.hpp"
#include "temporary_folder.hpp"

namespace {

using frontend::TemporaryFolder;

// How much a drop-in replacement's picture may differ from OpenSCAD's.
constexpr double kMostDiffering = 0.005;  // of all pixels
constexpr int kTolerance = 24;            // of 255, in any channel

const std::string kPlugins = SCADRAY_PLUGINS_DIR;
const std::string kExamples = SCADRAY_EXAMPLES_DIR;

/// Returns designs of which scadray draws every node.
std::vector<std::string> designs() {
  return {kPlugins + "/modifiers.scad",    kPlugins + "/colors.scad",
          kExamples + "/nut_trap.scad",    kExamples + "/three_spheres.scad",
          kExamples + "/bracket.scad",     kExamples + "/r9.scad",
          kExamples + "/dodecahedron.scad"};
}

std::vector<std::string> command_lines() {
  std::ifstream file(kPlugins + "/command_lines");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("openscad ", 0) == 0) lines.push_back(line);
  }
  return lines;
}

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<std::array<uint8_t, 3>> pixels;
};

/// Returns an empty picture if there is no PNG.
Picture read_png(const std::string& path) {
  Picture picture;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return picture;
  spng_ctx* context = spng_ctx_new(0);
  spng_ihdr header{};
  if (spng_set_png_file(context, file) == 0 && spng_get_ihdr(context, &header) == 0) {
    picture.pixels.resize(std::size_t{header.width} * header.height);
    if (spng_decode_image(context, picture.pixels.data(), picture.pixels.size() * 3, SPNG_FMT_RGB8,
                          0) == 0) {
      picture.width = header.width;
      picture.height = header.height;
    }
  }
  spng_ctx_free(context);
  std::fclose(file);
  return picture;
}

/// Returns the share of the pixels that differ in any channel by more than the tolerance; 1 if the
/// sizes differ.
double differing_share(const Picture& a, const Picture& b) {
  if (a.width == 0 || a.width != b.width || a.height != b.height) return 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(a.pixels[i][c] - b.pixels[i][c]));
    }
    count += most > kTolerance;
  }
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

/// One recorded line with one design.
struct Call {
  std::string line, design;
  std::size_t number;

  std::string picture(const char* program) const {
    return std::to_string(number) + '-' + program + ".png";
  }
};

/// Returns the calls. A sample runs every line with one design, and every design with some lines.
std::vector<Call> calls() {
  const std::vector<std::string> lines = command_lines();
  const std::vector<std::string> all = designs();
  std::vector<Call> calls;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (test_support::full_run() || k == i % all.size()) {
        calls.push_back({lines[i], all[k], calls.size()});
      }
    }
  }
  return calls;
}

std::string quoted(const std::string& text) { return '\'' + text + '\''; }

/// Returns a script that runs all lines with `program` in place of openscad, each in a folder with
/// the designs, and names those that fail.
std::string script(const std::vector<Call>& calls, const char* name, const std::string& program) {
  std::string text = "cd \"$(dirname \"$0\")\" || exit 1\nstatus=0\n";
  for (const Call& call : calls) {
    const std::string stem = std::filesystem::path(call.design).stem();
    std::string command = call.line;
    command.replace(0, std::string("openscad").size(), program);
    text += "IN=" + stem + ".scad BARE=" + stem + " OUT=" + call.picture(name) +
            " DEPS=" + call.picture(name) + ".d\n" + command + " || { echo " +
            quoted("failed: " + call.line + " for " + stem) + "; status=1; }\n";
  }
  return text + "exit $status\n";
}

int run(const std::string& command) { return std::system(command.c_str()); }

TEST(PluginPictures, AreOpenScads) {
  if (run("(command -v openscad && command -v xvfb-run) >/dev/null") != 0) {
    GTEST_SKIP() << "no openscad or xvfb-run";
  }
  const TemporaryFolder folder;
  for (const std::string& design : designs()) {
    const std::filesystem::path path(design);
    std::filesystem::copy_file(path, folder / path.filename());
    std::filesystem::copy_file(path, folder / path.stem());
  }
  const std::vector<Call> all = calls();
  ASSERT_GT(all.size(), designs().size());
  folder.script("openscads", script(all, "openscad", "openscad"));
  folder.script("scadrays", script(all, "scadray", quoted(SCADRAY_PROGRAM) + " --facets=all"));
  ASSERT_EQ(run("xvfb-run -a " + folder / "openscads" + " 2>" + folder / "log"), 0)
      << folder.read("log");
  EXPECT_EQ(run(folder / "scadrays"), 0);

  std::printf("%s: %zu pictures\ndiffering  design         command line\n",
              test_support::full_run() ? "full" : "sample", all.size());
  for (const Call& call : all) {
    const Picture expected = read_png(folder / call.picture("openscad"));
    ASSERT_GT(expected.width, 0u) << "openscad drew nothing: " << call.line << ' ' << call.design;
    const double share = differing_share(expected, read_png(folder / call.picture("scadray")));
    const std::string stem = std::filesystem::path(call.design).stem();
    std::printf("%8.4f%%  %-13s  %s\n", 100 * share, stem.c_str(), call.line.c_str());
    EXPECT_LE(share, kMostDiffering) << call.line << " for " << call.design;
    if (call.line.find("$DEPS") != std::string::npos) {
      EXPECT_NE(folder.read(call.picture("scadray") + ".d").find(stem + ".scad"),
                std::string::npos);
    }
  }
}

}  // namespace
