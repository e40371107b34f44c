// Tests repeated measurements, and running and measuring other programs.
#include <gtest/gtest.h>
#include <spng.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "memory.hpp"
#include "png.hpp"
#include "process.hpp"
#include "samples.hpp"

namespace {

using measure::ProcessResult;
using measure::Summary;

TEST(Samples, MedianAndQuartilesStandBetweenNeighbours) {
  const Summary odd = measure::summarise({5, 1, 3, 2, 4});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.least, 1);
  EXPECT_EQ(odd.lower_quartile, 2);
  EXPECT_EQ(odd.upper_quartile, 4);
  EXPECT_EQ(odd.count, 5u);
  const Summary even = measure::summarise({4, 1, 2, 3});
  EXPECT_EQ(even.median, 2.5);
  EXPECT_EQ(even.lower_quartile, 1.75);
  EXPECT_EQ(even.upper_quartile, 3.25);
  const Summary one = measure::summarise({7});
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.lower_quartile, 7);
  EXPECT_EQ(one.upper_quartile, 7);
}

TEST(Samples, AreJsonWithFixedKeys) {
  const nlohmann::json json = measure::summarise({1, 2, 3});
  EXPECT_EQ(json,
            nlohmann::json::parse(R"({"median":2.0,"least":1.0,"quartiles":[1.5,2.5],"count":3})"));
}

TEST(Samples, AreTakenInTurnAndTheFirstRoundDoesNotCount) {
  std::string order;
  double first_ms = 100, second_ms = 200;
  const measure::Timed works[] = {[&] {
                                    order += 'a';
                                    return first_ms++;
                                  },
                                  [&] {
                                    order += 'b';
                                    return second_ms++;
                                  }};
  const auto summaries = measure::measure_in_turn(works, {3, 3, 0});
  EXPECT_EQ(order, "abababab");
  EXPECT_EQ(summaries[0].least, 101);
  EXPECT_EQ(summaries[0].median, 102);
  EXPECT_EQ(summaries[1].least, 201);
  EXPECT_EQ(summaries[1].count, 3u);
}

TEST(Samples, AreTakenUntilTheyTookLongEnough) {
  const auto count = [](double ms, const measure::Repetitions& repetitions) {
    return measure::measure([&] { return ms; }, repetitions).count;
  };
  EXPECT_EQ(count(100, {2, 50, 1'000}), 10u);
  EXPECT_EQ(count(5'000, {2, 50, 1'000}), 2u);
  EXPECT_EQ(count(0.1, {2, 50, 1'000}), 50u);
}

TEST(Process, HasItsStatusAndWhatItPrints) {
  const ProcessResult result = measure::run_process(
      {"sh", "-c", "echo out; echo err >&2; pwd; echo $WORD; exit 3"}, {10, "/", {"WORD=said"}});
  EXPECT_EQ(result.status, 3);
  EXPECT_FALSE(result.succeeded());
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.output, "out\nerr\n/\nsaid\n");
}

TEST(Process, ThatIsNotFoundHasStatus127) {
  EXPECT_EQ(measure::run_process({"no-such-program-anywhere"}).status, 127);
  EXPECT_EQ(measure::find_program("no-such-program-anywhere"), "");
  EXPECT_EQ(measure::find_program("sh").filename(), "sh");
}

TEST(Process, ThatASignalEndsHasNoStatus) {
  const ProcessResult result = measure::run_process({"sh", "-c", "kill -9 $$"});
  EXPECT_EQ(result.status, std::nullopt);
  EXPECT_FALSE(result.timed_out);
}

TEST(Process, IsTimedAndItsProcessorTimeIsNot) {
  const ProcessResult sleeping = measure::run_process({"sleep", "0.2"});
  EXPECT_GE(sleeping.wall_ms, 200);
  EXPECT_LT(sleeping.cpu_ms, 100);
  EXPECT_GT(sleeping.peak_bytes, 100'000u);
  const ProcessResult busy =
      measure::run_process({"sh", "-c", "i=0; while [ $i -lt 100000 ]; do i=$((i + 1)); done"});
  EXPECT_GT(busy.cpu_ms, 10);
}

bool is_running(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("State:", 0) == 0) return line.find('Z') == std::string::npos;
  }
  return false;
}

TEST(Process, ThatTakesTooLongIsKilledWithItsChildren) {
  const ProcessResult result =
      measure::run_process({"sh", "-c", "sleep 60 & echo $!; wait"}, {0.5});
  EXPECT_TRUE(result.timed_out);
  EXPECT_FALSE(result.succeeded());
  EXPECT_LT(result.wall_ms, 30'000);
  const pid_t child = std::stoi(result.output);
  for (int i = 0; i < 100 && is_running(child); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(is_running(child));
}

TEST(Process, KeepsTheEndOfWhatItPrints) {
  const ProcessResult result =
      measure::run_process({"sh", "-c", "yes 0123456789 | head -n 100000; echo end"});
  EXPECT_TRUE(result.succeeded());
  EXPECT_EQ(result.output.size(), 64u * 1024);
  EXPECT_TRUE(result.output.ends_with("0123456789\nend\n"));
}

TEST(PeakMemory, CountsWhatIsHeldInBetweenOnly) {
  constexpr size_t kBytes = 64 << 20;
  const auto hold = [] {
    const std::vector<char> held(kBytes, 'x');
    return held[held.size() / 2];
  };
  hold();
  const measure::PeakMemory memory;
  if (!memory.bytes()) GTEST_SKIP() << "this system does not tell";
  EXPECT_LT(*memory.bytes(), kBytes / 2);
  EXPECT_EQ(hold(), 'x');
  EXPECT_GE(*memory.bytes(), kBytes * 9 / 10);
}

/// Writes an RGB picture of these bytes.
std::filesystem::path write_png(const std::string& name, uint32_t width, uint32_t height,
                                const std::vector<uint8_t>& rgb) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / name;
  spng_ctx* const context = spng_ctx_new(SPNG_CTX_ENCODER);
  std::FILE* const stream = std::fopen(file.c_str(), "wb");
  spng_ihdr header{width, height, 8, SPNG_COLOR_TYPE_TRUECOLOR, 0, 0, 0};
  EXPECT_EQ(spng_set_png_file(context, stream), 0);
  EXPECT_EQ(spng_set_ihdr(context, &header), 0);
  EXPECT_EQ(spng_encode_image(context, rgb.data(), rgb.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE),
            0);
  spng_ctx_free(context);
  std::fclose(stream);
  return file;
}

TEST(Png, IsReadAsItWasWritten) {
  const std::vector<uint8_t> rgb{1, 2, 3, 1, 2, 4};
  const measure::Png picture = measure::read_png(write_png("measuring.png", 2, 1, rgb));
  EXPECT_EQ(picture, (measure::Png{2, 1, rgb}));
  EXPECT_FALSE(measure::is_blank(picture));
  EXPECT_TRUE(measure::is_blank({2, 1, {1, 2, 3, 1, 2, 3}}));
}

TEST(Png, ThatIsNoneIsAnError) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "measuring.txt";
  std::ofstream(file) << "not a picture";
  EXPECT_THROW(measure::read_png(file), std::runtime_error);
  EXPECT_THROW(measure::read_png(file.string() + ".missing"), std::runtime_error);
}

}  // namespace
