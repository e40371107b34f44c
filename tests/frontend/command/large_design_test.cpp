// Tests the program's memory on large designs.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "full_run.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

/// Writes a cylinder minus many spheres on its wall, as OpenSCAD does.
void write_design(const std::string& path, int spheres) {
  std::ofstream file(path, std::ios::binary);
  file << "difference() {\n\tcylinder($fn = 48, $fa = 12, $fs = 2, h = 20, r1 = 10, r2 = 10, "
          "center = true);\n\tgroup() {\n\t\tgroup() {\n";
  for (int i = 0; i < spheres; ++i) {
    char node[256];
    std::snprintf(node, sizeof node,
                  "\t\t\tgroup() {\n\t\t\t\tmultmatrix([[1, 0, 0, %g], [0, 1, 0, %g], [0, 0, 1, "
                  "%g], [0, 0, 0, 1]]) {\n\t\t\t\t\tsphere($fn = 48, $fa = 12, $fs = 2, r = %g);"
                  "\n\t\t\t\t}\n\t\t\t}\n",
                  10 * std::cos(i), 10 * std::sin(i), 20 * std::fmod(i * 0.618034, 1) - 10,
                  20 / std::sqrt(spheres));
    file << node;
  }
  file << "\t\t}\n\t}\n}\n";
}

/// Returns the peak memory of a run in bytes; 0 if it fails.
uint64_t peak_bytes(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
    return 0;
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) return 0;
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

/// A million primitives take 1.2 GB, of which 0.5 GB are the arguments of their nodes. The rest is
/// the program itself and its picture.
TEST(LargeDesign, TakesLittleMoreThanAKilobyteAPrimitive) {
  constexpr uint64_t kBytesAPrimitive = 1200;
  constexpr uint64_t kRest = 30'000'000;
  const int spheres = test_support::full_run() ? 1'000'000 : 300'000;
  std::printf("%d spheres\n", spheres);
  const TemporaryFolder folder;
  write_design(folder / "large.csg", spheres);
  const uint64_t peak = peak_bytes({SCADRAY_PROGRAM, "-o", folder / "x.png", "--renderer=cpu",
                                    "--imgsize=640,480", folder / "large.csg"});
  std::printf("%.1f MB\n", static_cast<double>(peak) / 1e6);
  EXPECT_GT(peak, 0u);
  EXPECT_LE(peak, kBytesAPrimitive * static_cast<uint64_t>(spheres) + kRest);
}

}  // namespace
}  // namespace frontend
