// Exports altered designs and meshes (mutator.hpp), and random designs after random edits
// (edited_design.hpp), in a process of their own: it does not crash and ends in time, and what it
// writes is whole and closed.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "edits/edited_design.hpp"
#include "language/evaluation.hpp"
#include "meshes/read_solid_file.hpp"
#include "mutator.hpp"
#include "process.hpp"
#include "support/full_run.hpp"
#include "temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;  // texts by name
using ReadModel = frontend::SolidFile (*)(std::string_view, const std::string&);

constexpr std::pair<const char*, ReadModel> kModels[] = {
    {"x.stl", frontend::read_stl}, {"x.off", frontend::read_off}, {"x.3mf", frontend::read_3mf}};

/// Numbers that let parts touch, coincide, vanish, or lie far from each other.
constexpr std::string_view kNumbers[] = {"0",    "1",     "2",    "3",  "4",   "0.5",  "0.25",
                                         "-1",   "-2",    "1e-9", "5",  "6",   "1e-5", "0.333333",
                                         "1000", "2e-12", "30",   "45", "0.1", "8",    "12"};

/// Returns how many edges of the faces are passed more often in one direction than in the other.
size_t open_edges(frontend::FaceSet faces) {
  tidy(faces);
  std::map<std::pair<uint32_t, uint32_t>, int> passes;
  for (size_t i = 0; i < faces.face_count(); ++i) {
    const std::span<const uint32_t> face = faces.face(i);
    for (size_t k = 0; k < face.size(); ++k) {
      const uint32_t a = face[k], b = face[(k + 1) % face.size()];
      passes[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return static_cast<size_t>(
      std::ranges::count_if(passes, [](const auto& edge) { return edge.second != 0; }));
}

/// Returns the processor time of all processes that have been waited for.
double used_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Returns how many nodes the evaluated design has.
size_t node_count(const Files& files, const std::string& main) {
  const frontend::TemporaryFolder folder;
  for (const auto& [name, text] : files) folder.write(name, text);
  return language::evaluate(folder / main, {}, [](std::string_view) {}).tree->size();
}

/// Counts what becomes of designs.
class MutatedExports : public testing::Test {
 protected:
  ~MutatedExports() override {
    std::printf("%zu designs, %zu of them solids, the slowest took %.1f s\n", designs_, solids_,
                slowest_s_);
  }

  /// Exports `main` of the files.
  void export_design(const Files& files, const std::string& main, uint64_t seed) {
    const frontend::TemporaryFolder folder;
    std::vector<std::string> names{"err"};
    for (const auto& [name, text] : files) {
      folder.write(name, text);
      names.push_back(name);
    }
    window_test::ProcessSetup setup;
    setup.words = {SCADRAY_PROGRAM};
    for (const auto& [model, read] : kModels)
      setup.words.insert(setup.words.end(), {"-o", folder / model});
    setup.words.push_back(folder / main);
    setup.environment["SCADRAY_LANGUAGE"] = seed % 2 == 0 ? "2021.01" : "2026";
    setup.environment["OPENSCAD"] = "/nonexistent/openscad";
    setup.errors = folder / "err";
    const double start_s = used_s();
    const int status = window_test::Process(setup).wait();
    const double time_s = used_s() - start_s;
    slowest_s_ = std::max(slowest_s_, time_s);
    ++designs_;
    const std::string said = folder.read("err");
    EXPECT_LT(time_s, kMost_s);
    EXPECT_TRUE(status == 0 || status == 1) << status << '\n' << said;
    EXPECT_TRUE(status == 0 || !said.empty());
    // A design that is nothing but an open surface is written so, with a warning.
    const bool is_open = said.find("is no solid (close its surface)") != std::string::npos;
    for (const auto& [model, read] : kModels) {
      const bool is_there = folder.has(model);
      EXPECT_TRUE(is_there || status != 0) << model;
      if (!is_there) continue;
      names.push_back(model);
      const frontend::SolidFile file = read(folder.read(model), model);
      EXPECT_EQ(file.problem, "") << model;
      EXPECT_GT(file.faces.face_count(), 0u) << model;
      EXPECT_TRUE(is_open || open_edges(file.faces) == 0) << model << '\n' << said;
      EXPECT_TRUE(is_open || enclosed_volume(file.faces) > 0) << model << '\n' << said;
    }
    if (status == 0) ++solids_;
    std::ranges::sort(names);
    EXPECT_EQ(folder.names(), names);
    if (!HasFailure()) return;
    std::string story;
    for (const auto& [name, text] : files) story += "---- " + name + '\n' + text;
    FAIL() << story;
  }

 private:
#if defined(SCADRAY_SANITIZED)
  static constexpr double kMost_s = 60;
#else
  static constexpr double kMost_s = 10;
#endif
  size_t designs_ = 0, solids_ = 0;
  double slowest_s_ = 0;
};

TEST_F(MutatedExports, OfAlteredDesignsAreWholeAndClosed) {
  std::vector<std::string> texts;
  for (const char* const name : {"solids.csg", "hulls.csg", "polyhedra.csg", "by_hand.csg"}) {
    texts.push_back(fuzz::content_of(std::string(SCADRAY_FUZZ_CORPUS) + '/' + name));
    ASSERT_FALSE(texts.back().empty()) << name;
  }
  texts.push_back(texts.front());  // twice as often as the others
  fuzz::for_each_seed(test_support::sample_size(60), [&](uint64_t seed) {
    export_design({{"a.csg", fuzz::Mutator(seed, kNumbers, texts).altered()}}, "a.csg", seed);
  });
}

TEST_F(MutatedExports, OfAlteredMeshesAreWholeAndClosed) {
  fuzz::for_each_seed(test_support::sample_size(40), [&](uint64_t seed) {
    const std::string name = seed % 3 == 0   ? "step_text.stl"
                             : seed % 3 == 1 ? "step.off"
                                             : "step.amf";
    const std::string mesh = fuzz::content_of(std::string(SCADRAY_FUZZ_FILES) + '/' + name);
    ASSERT_FALSE(mesh.empty());
    const std::string design = "difference() {\n\timport(\"" + name +
                               "\");\n\tcube(size = [1, 1, 1], center = true);\n}\n";
    export_design({{name, fuzz::Mutator(seed, kNumbers, {&mesh, 1}).altered()}, {"a.csg", design}},
                  "a.csg", seed);
  });
}

TEST_F(MutatedExports, OfEditedDesignsAreWholeAndClosed) {
  constexpr uint64_t kMostEdits = 8;
  constexpr size_t kMostNodes = 1500;  // more take longer, and test no more
  fuzz::for_each_seed(test_support::sample_size(25), [&](uint64_t seed) {
    window_test::EditedDesign design(static_cast<uint32_t>(seed));
    for (uint64_t i = 0; i < seed % kMostEdits; ++i) design.edit();
    const Files files = design.texts();
    if (!files.contains("main.scad") || node_count(files, "main.scad") > kMostNodes) return;
    export_design(files, "main.scad", seed);
  });
}

}  // namespace
