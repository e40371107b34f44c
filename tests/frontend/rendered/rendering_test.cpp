// Tests the parts of designs that openscad renders, with programs in its place and with the
// installed one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "base/primitive_traits.hpp"
#include "csgcore/canonical_primitive.hpp"
#include "csgcore/solid.hpp"
#include "follow/followed.hpp"
#include "frontend/files.hpp"
#include "frontend/importer.hpp"
#include "frontend/parser.hpp"
#include "frontend/stop.hpp"
#include "meshes/read_solid_file.hpp"
#include "rendered/render_cache.hpp"
#include "subtrees/render_text.hpp"
#include "temporary_folder.hpp"

namespace frontend {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// The sum of two solids that are not convex.
std::string sum(int size = 1) {
  return "minkowski() { difference() { cube(" + std::to_string(size) +
         "); sphere(0.5); } difference() { cube(1); sphere(0.5); } }";
}

bool has_children() { return waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD; }

/// A program in openscad's place, whose starts are counted, and a cache of its own.
class FakeRenderer : public testing::Test {
 protected:
  FakeRenderer() {
    set_program("cat " + kFrame);
    options_.rendering.timeout_s = 60;
  }

  void set_program(const std::string& body) {
    folder_.script("openscad", "echo >>'" + folder_.path() + "/starts'\n" + body);
  }
  ImportedDesign import(const std::string& text, const std::stop_token& stop = {}) {
    return import_design(parse(text, "a.csg"), options_, stop);
  }
  size_t starts() const { return folder_.read("starts").size(); }
  /// Waits until the program has run so often. A program that is ended at once may have made the
  /// file and written nothing: it counts only once it has.
  void wait_for_starts(size_t count) const {
    while (!folder_.has("starts") || starts() < count) {
      std::this_thread::sleep_for(milliseconds(2));
    }
  }
  /// Of the only result that is kept.
  std::string cache_file() const {
    std::string found;
    for (const auto& entry : fs::directory_iterator(folder_ / "cache/scadray")) {
      EXPECT_EQ(found, "");
      found = entry.path();
    }
    return found;
  }
  void expect_frame(const ImportedDesign& design) {
    EXPECT_THAT(design.warnings, IsEmpty());
    EXPECT_EQ(design.rendered_leaves, 1u);
    ASSERT_THAT(design.scene.primitives, SizeIs(1));
    EXPECT_EQ(design.view_box.max, csgcore::Vec3(10 / kRenderScale));
  }

  static inline const std::string kFrame = std::string(SCADRAY_MESH_FILES) + "/frame.nef3";
  TemporaryFolder folder_;
  Environment program_{"OPENSCAD", folder_ / "openscad"};
  Environment cache_{"XDG_CACHE_HOME", folder_ / "cache"};
  ImportOptions options_;
};

TEST_F(FakeRenderer, MakesWhatIsNotLowered) {
  const ImportedDesign design = import("multmatrix([[1,0,0,7]]) { color(\"red\") " + sum() + "}");
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_EQ(design.rendered_leaves, 1u);
  EXPECT_EQ(design.left_out, 0u);
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.scene.primitives[0].color, csgcore::Color({1, 0, 0, 1}));
  EXPECT_EQ(design.view_box.min.x, 7);
  EXPECT_EQ(design.view_box.max.x, 7 + 10 / kRenderScale);
  EXPECT_EQ(starts(), 1u);
}

TEST_F(FakeRenderer, IsAskedForTheSameOnce) {
  expect_frame(import(sum()));
  expect_frame(import("// the same, in other words\ncolor(\"red\") { " + sum() + "}"));
  EXPECT_EQ(starts(), 1u);
  const ImportedDesign twice = import(sum() + sum());
  EXPECT_EQ(twice.rendered_leaves, 2u);
  EXPECT_EQ(starts(), 1u);
  import(sum(2));
  EXPECT_EQ(starts(), 2u) << "another sum";
  set_program("cat " + kFrame + " # another program");
  import(sum());
  EXPECT_EQ(starts(), 3u);
}

TEST_F(FakeRenderer, IsAskedAgainWhenAFileHasChanged) {
  const std::string design =
      "minkowski() { difference() { import(\"" +
      folder_.write("a.off",
                    "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
                    "3 1 2 3\n") +
      "\"); sphere(0.1); } difference() { cube(1); sphere(0.5); } }";
  import(design);
  import(design);
  EXPECT_EQ(starts(), 1u);
  folder_.write("a.off",
                "OFF 4 4 0\n0 0 0\n2 0 0\n0 2 0\n0 0 2.5\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
                "3 1 2 3\n");
  import(design);
  EXPECT_EQ(starts(), 2u);
}

TEST_F(FakeRenderer, APoisonedCacheCostsATimeAlone) {
  expect_frame(import(sum()));
  const std::string path = cache_file();
  const std::string good(read_file(path).view());
  std::mt19937 random(26);
  const auto write = [&](const std::string& bytes) {
    fs::remove_all(path);
    folder_.write("cache/scadray/" + fs::path(path).filename().string(), bytes);
  };
  size_t expected = 1;
  std::vector<std::string> poisons = {"", "x", good + "x", std::string(1000, '\0')};
  for (int i = 0; i < 100; ++i) {
    std::string damaged = good;
    const size_t place = random() % good.size();
    if (i % 2 == 0) {
      damaged.resize(place);
    } else {
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << random() % 8));
    }
    poisons.push_back(damaged);
  }
  for (const std::string& poison : poisons) {
    write(poison);
    expect_frame(import(sum()));
    EXPECT_EQ(starts(), ++expected);
  }
  expect_frame(import(sum()));
  EXPECT_EQ(starts(), expected) << "it is mended";
}

TEST_F(FakeRenderer, WithoutACacheWorksAsWell) {
  const auto expect_starts = [&](const char* what) {
    SCOPED_TRACE(what);
    const size_t before = starts();
    expect_frame(import(sum()));
    expect_frame(import(sum()));
    EXPECT_EQ(starts(), before + 2);
  };
  {
    const Environment file("XDG_CACHE_HOME", folder_.write("file", ""));
    expect_starts("a file in place of the folder");
  }
  {
    const Environment none("XDG_CACHE_HOME", "relative");
    const Environment home("HOME", "");
    expect_starts("no home");
  }
  {
    const Environment full("XDG_CACHE_HOME", "/dev/full");
    expect_starts("a device");
  }
  expect_frame(import(sum()));
  const std::string path = cache_file();
  fs::remove(path);
  fs::create_directory(path);
  expect_starts("a folder in place of the file");
}

TEST_F(FakeRenderer, ThatFailsLeavesAPartOut) {
  const auto expect_warning = [&](const std::string& body, const std::string& why) {
    set_program(body);
    const ImportedDesign design = import("sphere();\n " + sum());
    EXPECT_THAT(design.warnings, SizeIs(1));
    EXPECT_THAT(design.warnings[0].text,
                AllOf(HasSubstr("a.csg:2:2: warning: minkowski is left out ("), HasSubstr(why)));
    EXPECT_EQ(design.left_out, 1u);
    EXPECT_EQ(design.rendered_leaves, 0u);
    EXPECT_THAT(design.scene.primitives, SizeIs(1));
    EXPECT_FALSE(has_children());
  };
  expect_warning("exit 3", "openscad failed with exit code 3");
  expect_warning("kill -SEGV $$", "openscad failed with exit code 139");
  expect_warning("echo 'ERROR: no way' >&2; exit 1", "openscad says: no way");
  expect_warning("echo garbage", "openscad wrote no solid");
  expect_warning("head -c 3000 " + kFrame, "openscad wrote no solid");
  options_.rendering.timeout_s = 0.05;
  expect_warning("cat " + kFrame + "; sleep 1000", "has not finished in time");
  expect_warning("while :; do echo x; done", "has not finished in time");
  const Environment missing("OPENSCAD", folder_ / "missing");
  expect_warning("", "was not found");
}

TEST_F(FakeRenderer, MayFindThatNothingIsThere) {
  set_program("echo 'Current top level object is empty.' >&2; exit 1");
  const ImportedDesign design = import(sum());
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_THAT(design.scene.primitives, IsEmpty());
  import(sum());
  EXPECT_EQ(starts(), 1u);
}

TEST_F(FakeRenderer, IsNotAskedWithoutATimeLimit) {
  options_.rendering.timeout_s = 0;
  EXPECT_THAT(import(sum()).warnings, SizeIs(1));
  EXPECT_FALSE(folder_.has("starts"));
  EXPECT_FALSE(folder_.has("cache"));
}

TEST_F(FakeRenderer, IsNotAskedForWhatItDoesNotKnow) {
  EXPECT_THAT(import("hull() { " + sum() + " roof() { square(); } }").warnings, Not(IsEmpty()));
  EXPECT_THAT(import("hull() { roof() { square(); } }").warnings, SizeIs(1));
  EXPECT_FALSE(folder_.has("starts"));
}

TEST_F(FakeRenderer, IsNotWaitedForWherePartsMayBeMissing) {
  options_.rendering.waits = false;
  const ImportedDesign without = import("sphere();\n" + sum());
  EXPECT_THAT(without.warnings, IsEmpty());
  EXPECT_THAT(without.lines_to_render, ElementsAre(2));
  EXPECT_THAT(without.scene.primitives, SizeIs(1));
  EXPECT_FALSE(folder_.has("starts"));
  options_.rendering.waits = true;
  import(sum());
  options_.rendering.waits = false;
  const ImportedDesign with = import("sphere();\n" + sum());
  EXPECT_THAT(with.lines_to_render, IsEmpty());
  EXPECT_THAT(with.scene.primitives, SizeIs(2));
}

TEST_F(FakeRenderer, EndsAtOnceWhenItIsStopped) {
  set_program("sleep 1000");
  std::stop_source stop;
  std::jthread stopper([&] {
    wait_for_starts(1);
    stop.request_stop();
  });
  EXPECT_THROW(import(sum() + sum(2) + sum(3), stop.get_token()), Stopped);
  EXPECT_FALSE(has_children());
  EXPECT_FALSE(folder_.has("cache"));
}

TEST_F(FakeRenderer, RendersSeveralPartsAtOnce) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  // Each waits for the other one.
  const std::string in = "'" + folder_.path() + "'";
  set_program("touch " + in + "/run-$$; for i in $(seq 500); do [ $(ls " + in +
              " | grep -c run-) = 2 ] && exec cat " + kFrame + "; sleep 0.01; done");
  RenderingProgress last;
  options_.rendering.progress = [&](const RenderingProgress& progress) { last = progress; };
  const ImportedDesign design = import(sum() + "\n" + sum(2));
  EXPECT_THAT(design.warnings, IsEmpty());
  EXPECT_EQ(design.rendered_leaves, 2u);
}

TEST_F(FakeRenderer, APlaneFigureIsItsOutlineAtTheBottom) {
  const std::string section = "projection(cut = true) { " + sum() + " }";
  const ImportedDesign design = import(section);
  EXPECT_THAT(design.warnings, IsEmpty());
  ASSERT_THAT(design.scene.primitives, SizeIs(1));
  EXPECT_EQ(design.view_box.max, csgcore::Vec3(10, 10, 0));
  const csgcore::Solid plate(csgcore::canonical_primitives(design.scene), design.scene.model);
  EXPECT_TRUE(plate.contains(csgcore::Vec3(1, 1, 0.4)));
  EXPECT_FALSE(plate.contains(csgcore::Vec3(3, 3, 0.4))) << "in the hole";
  EXPECT_FALSE(plate.contains(csgcore::Vec3(1, 1, 0.6)));
  options_.picture = PictureKind::kRendered;
  EXPECT_THAT(import(section).flat_outlines, SizeIs(2));
}

TEST_F(FakeRenderer, IsFollowedAfterAllElseIsShown) {
  FollowOptions options = by_inotify();
  options.import = options_;
  const std::string path = folder_.write("a.csg", "sphere();\n" + sum());
  Followed design(path, options);
  const DesignVersion first = design.next(), second = design.next();
  EXPECT_THAT(first.design->lines_to_render, ElementsAre(2));
  EXPECT_THAT(first.design->scene.primitives, SizeIs(1));
  EXPECT_THAT(second.design->lines_to_render, IsEmpty());
  EXPECT_THAT(second.design->scene.primitives, SizeIs(2));
  EXPECT_EQ(second.number, 2u);
  EXPECT_EQ(second.files, first.files);
  // What is in the cache is shown with the rest.
  folder_.write("a.csg", "cube();\n" + sum());
  EXPECT_THAT(design.next().design->scene.primitives, SizeIs(2));
}

TEST_F(FakeRenderer, IsEndedByTheNextSave) {
  set_program("sleep 1000");
  FollowOptions options = by_inotify();
  options.import = options_;
  Followed design(folder_.write("a.csg", sum()), options);
  design.next();
  wait_for_starts(1);
  EXPECT_TRUE(has_children());
  folder_.write("a.csg", "sphere();");
  EXPECT_THAT(design.next().design->lines_to_render, IsEmpty());
  EXPECT_FALSE(has_children());
  folder_.write("a.csg", sum(2));
  design.next();
  wait_for_starts(2);
  design.end();
  EXPECT_FALSE(has_children());
}

// --- The cache ------------------------------------------------------------------------------

class RenderCacheTest : public testing::Test {
 protected:
  static RingedFaces faces(double size) {
    RingedFaces result;
    result.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    result.corners = {0, 1, 2};
    result.end_ring();
    result.end_face();
    return result;
  }
  TemporaryFolder folder_;
  Environment cache_{"XDG_CACHE_HOME", folder_.path()};
};

TEST_F(RenderCacheTest, RemovesFirstWhatWasNotUsedForTheLongestTime) {
  const RenderCache cache(1000);  // bytes, of which one takes some 150
  const auto age = [&] {
    for (const auto& entry : fs::directory_iterator(folder_ / "scadray")) {
      fs::last_write_time(entry, fs::last_write_time(entry) - std::chrono::hours(2));
    }
  };
  cache.keep("first", faces(1));
  age();
  cache.keep("second", faces(2));
  age();
  ASSERT_TRUE(cache.find("first"));
  folder_.write("scadray/.scadray-1-2.tmp", "left by one that was killed");
  age();
  ASSERT_TRUE(cache.find("first"));
  for (int i = 0; i < 5; ++i) cache.keep("more" + std::to_string(i), faces(i));
  EXPECT_TRUE(cache.find("first"));
  EXPECT_FALSE(cache.find("second"));
  EXPECT_TRUE(cache.find("more4"));
  EXPECT_FALSE(folder_.has("scadray/.scadray-1-2.tmp"));
}

TEST_F(RenderCacheTest, IsPrivateAndFollowsNoLink) {
  fs::create_directory(folder_ / "scadray");
  fs::permissions(folder_ / "scadray", fs::perms::all);
  const RenderCache cache;
  cache.keep("a", faces(1));
  EXPECT_EQ(fs::status(folder_ / "scadray").permissions(), fs::perms::owner_all);
  const std::string target = folder_.write("target", "mine");
  const fs::path kept = *fs::directory_iterator(folder_ / "scadray");
  fs::remove(kept);
  fs::create_symlink(target, kept);
  EXPECT_FALSE(cache.find("a"));
  cache.keep("a", faces(2));
  EXPECT_EQ(std::string(read_file(target).view()), "mine");
  EXPECT_FALSE(fs::is_symlink(kept));
  EXPECT_TRUE(cache.find("a"));
}

TEST_F(RenderCacheTest, MayBeUsedBySeveralAtOnce) {
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([t] {
      const RenderCache cache(1000);
      for (int i = 0; i < 200; ++i) {
        const int key = (i + t) % 8;
        cache.keep(std::to_string(key), faces(key));
        const std::optional<RingedFaces> found = cache.find(std::to_string((i * 3) % 8));
        EXPECT_TRUE(!found || found->points[1].x == (i * 3) % 8);
      }
    });
  }
}

// --- The text -------------------------------------------------------------------------------

std::string text_of(const std::string& design, const ImportOptions& options = {},
                    bool is_plane = false) {
  return render_request(*parse(design, "a.csg").nodes, 0, is_plane, options, {}).text;
}

TEST(RenderText, SaysTheSameOfTheSameGeometry) {
  const std::string text = text_of("hull() { color(\"red\") { sphere(2, $fn = 0); } cube(1); }");
  EXPECT_EQ(text, text_of("%hull()\n{ color([0, 1, 0, 0.5]) { #sphere(2.0, $fn = 0); %cube(3); }"
                          " *sphere(3); cube(1, timestamp = 3); }"));
  EXPECT_NE(text, text_of("hull() { sphere(2, $fn = 0); cube(1); cube(1); }"));
}

TEST(RenderText, HasLargerSolidsAndHealedMatrices) {
  const std::string text = text_of(
      "hull() { multmatrix([[0.866025,-0.5,0,3],[0.5,0.866025,0,0],[0,0,1,0],[0,0,0,1]]) "
      "{ cube(1); linear_extrude(height = 2) { multmatrix([[1,0,0,3]]) { square(); } } "
      "resize([2, 0, 0]) { cube(inf); } } }");
  EXPECT_THAT(text, HasSubstr("[0.8660254037844386,-0.5,0,3072]"));
  EXPECT_THAT(text, HasSubstr("[0,0,1024,0],[0,0,0,1]])cube(1);"));
  EXPECT_THAT(text, HasSubstr("[0,0,1024,0],[0,0,0,1]])linear_extrude(height=2){multmatrix("
                              "[[1,0,0,3],"));
  EXPECT_THAT(text, HasSubstr("resize(newsize=[2048,0,0,],auto=[false,false,false,])"));
  EXPECT_THAT(text, HasSubstr("cube((1/0))"));
}

TEST(RenderText, HasFinerFacetsAsLongAsTheyAreFew) {
  const auto sphere_in = [](const std::string& design, const ImportOptions& options = {}) {
    const std::string text = text_of(design, options);
    const size_t start = text.find("sphere(");
    return text.substr(start, text.find(')', start) + 1 - start);
  };
  EXPECT_EQ(sphere_in("hull() { sphere(2); }"), "sphere(2,$fn=60)");
  EXPECT_EQ(sphere_in("hull() { sphere(2); sphere(1); }"), "sphere(2,$fn=36)");
  EXPECT_EQ(sphere_in("hull() { sphere(2, $fn = 6); }"), "sphere(2,$fn=6)") << "a wanted shape";
  EXPECT_EQ(sphere_in("hull() { sphere(2, $fn = 200); }"), "sphere(2,$fn=200)");
  EXPECT_EQ(sphere_in("minkowski() { cylinder(r = 2, $fn = 20); sphere(2); }"), "sphere(2,$fn=12)");
  ImportOptions all;
  all.facets = Facets::kAll;
  EXPECT_EQ(sphere_in("hull() { sphere(2, $fn = 0, $fa = 12); }", all), "sphere(2,$fn=0,$fa=12)");
  std::string many = "hull() {";
  for (int i = 0; i < 1000; ++i) many += "sphere(2);";
  EXPECT_EQ(sphere_in(many + "}"), "sphere(2)");
}

TEST(RenderText, DoesNotRecurse) {
  std::string nested, closed, list;
  for (int i = 0; i < 100000; ++i) {
    nested += "hull() {";
    closed += '}';
  }
  list.append(100000, '[');
  list.append(100000, ']');
  EXPECT_THAT(text_of(nested + "cube(" + list + ");" + closed), HasSubstr("[[[["));
}

// --- The installed openscad -----------------------------------------------------------------

/// Whatever is rendered touches what stands beside it.
TEST(InstalledRenderer, LeavesNoGap) {
  if (std::system("command -v openscad >/dev/null 2>&1") != 0) GTEST_SKIP() << "no openscad";
  const TemporaryFolder folder;
  const Environment cache("XDG_CACHE_HOME", folder.path());
  ImportOptions options;
  options.rendering.timeout_s = 60;
  // A block from the origin to (3.1, 3.2, 3.3), turned by 30 degrees and moved.
  const std::string design =
      "multmatrix([[0.866025,-0.5,0,0.1],[0.5,0.866025,0,0.7],[0,0,1,0.3]]) { minkowski() { "
      "difference() { cube([2.1,2.2,2.3]); sphere(0.5); } "
      "difference() { cube(1); sphere(0.1); } } }";
  const ImportedDesign all = import_design(parse(design, "a.csg"), options);
  options.rendering = {};
  const ImportedDesign exact =
      import_design(parse("multmatrix([[0.866025,-0.5,0,0.1],[0.5,0.866025,0,0.7],[0,0,1,0.3]]) "
                          "{ cube([3.1, 3.2, 3.3]); }",
                          "a.csg"),
                    options);
  EXPECT_THAT(all.warnings, IsEmpty());
  EXPECT_EQ(all.rendered_leaves, 1u);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(all.view_box.min[axis], exact.view_box.min[axis], 2e-9);
    EXPECT_NEAR(all.view_box.max[axis], exact.view_box.max[axis], 2e-9);
  }
}

}  // namespace
}  // namespace frontend
