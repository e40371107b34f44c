#include "base/read_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace language {
namespace {

TEST(ReadFile, ReturnsAllBytes) {
  const std::string path = testing::TempDir() + "read_file_test.scad";
  const std::string bytes = std::string(100'000, 'x') + std::string("\0\r\n", 3);
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(read_file(path), bytes);
  std::filesystem::remove(path);
}

TEST(ReadFile, ReadsWhatHasNoSize) {
  const std::string path = "/proc/self/cmdline";  // whose size is told as 0
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(read_file(path), bytes.str());
}

TEST(ReadFile, ReadsRegularFilesAlone) {
  const std::string path = testing::TempDir() + "regular_file_test.scad";
  std::ofstream(path) << "x";
  EXPECT_EQ(read_regular_file(path), "x");
  std::filesystem::remove(path);
  for (const std::string& other :
       {path, std::string("/dev/zero"), std::string("/dev/null"), testing::TempDir()})
    EXPECT_EQ(read_regular_file(other), std::nullopt) << other;
}

TEST(ReadFile, ReadsNoFolderAndNothingThatIsMissing) {
  EXPECT_EQ(read_file(testing::TempDir()), std::nullopt);
  EXPECT_EQ(read_file(testing::TempDir() + "no such file"), std::nullopt);
}

}  // namespace
}  // namespace language
