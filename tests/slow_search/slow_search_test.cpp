// Tests the search for slow designs: it makes designs, the same for the same seed, and it ends and
// leaves nothing behind. No time is asserted.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "families.hpp"
#include "frontend/parser.hpp"
#include "mutation.hpp"
#include "search.hpp"
#include "temporary_folder.hpp"

namespace slow_search {
namespace {

namespace fs = std::filesystem;
using frontend::Environment;
using frontend::TemporaryFolder;

std::vector<fs::path> csg_files(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".csg") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Parses with the program's parser; nothing if it refuses the text.
std::optional<std::vector<frontend::NodeKind>> kinds_of(const std::string& text) {
  std::vector<frontend::NodeKind> kinds;
  try {
    const frontend::SyntaxTree tree = frontend::parse(text, "a.csg");
    for (const frontend::SyntaxNode& node : tree.nodes) kinds.push_back(node.kind);
  } catch (const frontend::Error&) {
    return std::nullopt;
  }
  return kinds;
}

TEST(Design, KeepsTheNodesOfTheCorpus) {
  for (const char* folder : {SCADRAY_FUZZ_CORPUS, SCADRAY_EXAMPLES_DIR}) {
    for (const fs::path& path : csg_files(folder)) {
      // OpenSCAD writes a text's quotes without a backslash; scadray draws no text.
      if (path.stem() == "every_node_2021" || path.stem() == "master") continue;
      const std::string text = text_of_file(path);
      const auto kinds = kinds_of(text);
      if (!kinds) continue;
      const std::optional<Design> design = parse(text);
      ASSERT_TRUE(design) << path;
      EXPECT_EQ(kinds_of(text_of(*design)), kinds) << path;
    }
  }
}

TEST(Design, OfNodesWithoutBraces) {
  const std::optional<Design> design =
      parse("/* a */ union ( ) # color([1, 0]) sphere(r1 = -2.5e-3, \"x 1\"); // b\ncube ( 1 ) ;");
  ASSERT_TRUE(design);
  EXPECT_EQ(text_of(*design),
            "union(){\n#color([1,0]){\nsphere(r1=-2.5e-3,\"x 1\");\n}\n}\ncube(1);\n");
  EXPECT_EQ(subtree_end(*design, 0), 5u);
  EXPECT_EQ(subtree_end(*design, 5), 6u);
  const std::vector<NumberPlace> numbers = numbers_of((*design)[2].head);
  ASSERT_EQ(numbers.size(), 1u);
  EXPECT_EQ((*design)[2].head.substr(numbers[0].begin, numbers[0].length), "-2.5e-3");
}

TEST(Design, RefusesWhatIsNone) {
  for (const char* text : {"cube(1)", "union() {", "}", "cube(1;", "1;", "a(", "union() { ) }"}) {
    EXPECT_FALSE(parse(text)) << text;
  }
}

TEST(Families, AreDesigns) {
  for (const Family& family : families()) {
    for (const int count : {1, 2, 30}) {
      Random random(1);
      const std::string text = family.make(random, count);
      ASSERT_TRUE(parse(text)) << family.name;
      EXPECT_NO_THROW(frontend::parse(text, family.name)) << text;
      Random again(1);
      EXPECT_EQ(family.make(again, count), text) << family.name;
    }
  }
}

/// Returns a row of mutations, each of the one before.
std::vector<std::string> mutations(uint64_t seed, int count) {
  Random random(seed);
  std::vector<std::string> texts;
  Design design;
  for (int i = 0; i < count; ++i) {
    const Family& family = families()[random.below(families().size())];
    design = mutated(design, *parse(family.make(random, 8)), random);
    texts.push_back(text_of(design));
  }
  return texts;
}

TEST(Mutations, AreDesignsOfAtMostSoManyBytes) {
  std::set<std::string> different;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    for (const std::string& text : mutations(seed, 40)) {
      ASSERT_LE(text.size(), kMostBytes);
      const std::optional<Design> design = parse(text);
      ASSERT_TRUE(design) << text;
      EXPECT_EQ(text_of(*design), text);
      ASSERT_NO_THROW(frontend::parse(text, "a.csg")) << text;
      different.insert(text);
    }
  }
  EXPECT_GT(different.size(), 130u);
  EXPECT_EQ(mutations(1, 50), mutations(1, 50));
}

TEST(Archive, KeepsTheSlowestPerByteOfAFamilyAndSize) {
  Archive archive;
  const auto add = [&](const char* family, std::size_t bytes, double excess_ms) {
    archive.add({family, {}, bytes, excess_ms, 0, 0, {}});
  };
  add("a", 1000, 100);
  add("a", 900, 80);  // slower per byte only than nothing
  add("a", 600, 90);  // slower per byte, of a similar size
  add("a", 5000, 300);
  add("b", 1000, 1);
  EXPECT_DOUBLE_EQ(archive.least_excess_ms("a", 800), 120);
  EXPECT_DOUBLE_EQ(archive.least_excess_ms("c", 800), 0);
  std::vector<std::size_t> sizes;
  for (const Found& found : archive.ranked(200)) sizes.push_back(found.bytes);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{5000, 600, 1000}));
}

// Returns a stand-in for scadray, which draws cube(1); and then misbehaves.
std::string stand_in(const std::string& misbehaviour) {
  return "for last; do :; done\ncase $(cat \"$last\") in 'cube(1);') exit 0;; esac\n" +
         misbehaviour;
}

class SlowSearch : public testing::Test {
 protected:
  /// Starts the program, with its standard output in a file.
  pid_t start(std::vector<std::string> words) {
    words.insert(words.begin(), SLOW_SEARCH_PROGRAM);
    const pid_t child = fork();
    if (child != 0) return child;
    for (const int number : {SIGINT, SIGTERM}) signal(number, SIG_DFL);
    if (!freopen((folder_ / "out").c_str(), "w", stdout)) _exit(126);
    if (!freopen((folder_ / "err").c_str(), "w", stderr)) _exit(126);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execv(SLOW_SEARCH_PROGRAM, pointers.data());
    _exit(127);
  }
  static int finish(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int run(const std::vector<std::string>& words) { return finish(start(words)); }

  /// Fails if the search has left temporary files.
  void expect_nothing_left() { EXPECT_TRUE(fs::is_empty(folder_ / "tmp")); }

  TemporaryFolder folder_;
  const bool has_tmp_ = fs::create_directory(folder_ / "tmp");
  Environment environment_{"TMPDIR", folder_ / "tmp"};
};

TEST_F(SlowSearch, WritesDesignsAndATable) {
  const std::string start = folder_.write("start.csg", "union() { cube(1); sphere(2); }");
  // However loaded the machine is, each of them takes longer than cube(1);.
  const std::string program =
      folder_.script("slow", stand_in("sleep 0.02; exec '" SCADRAY_PROGRAM "' \"$@\""));
  const int status = run({"--designs=12", "--threshold=0", program, folder_ / "found", start});
  ASSERT_EQ(status, 0) << folder_.read("err");
  const std::vector<fs::path> found = csg_files(folder_ / "found");
  EXPECT_GT(found.size(), 3u);
  for (const fs::path& path : found) {
    const std::string text = text_of_file(path);
    EXPECT_LE(text.size(), kMostBytes) << path;
    EXPECT_NO_THROW(frontend::parse(text, path)) << path;
  }
  const std::string table = folder_.read("found/found.txt");
  EXPECT_NE(table.find("# seed 1: "), std::string::npos) << table;
  EXPECT_NE(table.find(found.front().filename()), std::string::npos) << table;
  expect_nothing_left();
}

TEST_F(SlowSearch, EndsWhatHangsAndItsChildren) {
  const std::string program =
      folder_.script("hangs", stand_in("sleep 1000 & echo $! >>" + (folder_ / "pids") + "; wait"));
  ASSERT_EQ(run({"--designs=3", "--limit=0.2", program, folder_ / "found"}), 0);
  EXPECT_NE(folder_.read("found/found.txt").find("over the limit"), std::string::npos);
  std::istringstream pids(folder_.read("pids"));
  int count = 0;
  for (pid_t pid = 0; pids >> pid; ++count) {
    // A killed process may be a zombie until init has reaped it.
    const std::string stat = text_of_file("/proc/" + std::to_string(pid) + "/stat");
    EXPECT_TRUE(stat.empty() || stat.find(") Z ") != std::string::npos) << stat;
  }
  EXPECT_EQ(count, 3);
  expect_nothing_left();
}

TEST_F(SlowSearch, ReportsWhatEndsByASignal) {
  const std::string program = folder_.script("crashes", stand_in("kill -SEGV $$"));
  ASSERT_EQ(run({"--designs=2", program, folder_ / "found"}), 0);
  EXPECT_NE(folder_.read("found/found.txt").find("signal"), std::string::npos);
}

TEST_F(SlowSearch, LeavesOutWhatIsRefused) {
  const std::string program = folder_.script("refuses", stand_in("exit 1"));
  ASSERT_EQ(run({"--designs=3", program, folder_ / "found"}), 0);
  EXPECT_TRUE(csg_files(folder_ / "found").empty());
}

TEST_F(SlowSearch, InterruptedItWritesWhatItHas) {
  const pid_t child =
      start({"--seconds=1000", "--limit=1", "--threshold=0", SCADRAY_PROGRAM, folder_ / "found"});
  while (folder_.read("out").empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child), 0) << folder_.read("err");
  EXPECT_TRUE(folder_.has("found/found.txt"));
  expect_nothing_left();
}

TEST_F(SlowSearch, Failures) {
  const auto error_of = [&](const std::vector<std::string>& words) {
    EXPECT_EQ(run(words), 1);
    return folder_.read("err");
  };
  EXPECT_EQ(error_of({}), "error: nothing to search with (give PROGRAM FOLDER [START.csg...])\n");
  EXPECT_EQ(error_of({"--seed=x", "a", "b"}),
            "error: --seed=x is not understood (give a number from 0 to 1e9)\n");
  EXPECT_NE(error_of({SCADRAY_PROGRAM, folder_ / "tmp/.."}).find("is not empty"),
            std::string::npos);
  EXPECT_NE(error_of({folder_ / "none", folder_ / "found"}).find("does not draw cube(1);"),
            std::string::npos);
  expect_nothing_left();
}

}  // namespace
}  // namespace slow_search
