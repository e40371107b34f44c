// Tests that an import stops soon after it is asked to, whatever it does.
#include "frontend/stop.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stop_token>
#include <string>
#include <thread>

#include "frontend/importer.hpp"
#include "frontend/parser.hpp"

namespace frontend {
namespace {

/// Boxes that are all turned differently.
std::string boxes(int count, double size, double distance) {
  std::string text = "union() {\n";
  for (int i = 0; i < count; ++i) {
    const double s = std::sin(i), c = std::cos(i);
    const double place = distance * std::sin(7 * i);
    text += "multmatrix([[" + std::to_string(c) + ", " + std::to_string(-s) + ", 0, " +
            std::to_string(place) + "], [" + std::to_string(s) + ", " + std::to_string(c) +
            ", 0, " + std::to_string(distance * std::cos(3 * i)) + "], [0, 0.6, 0.8, " +
            std::to_string(distance * std::sin(i)) + "], [0, 0, 0, 1]]) cube(size = [" +
            std::to_string(size) + ", 1, 2], center = false);\n";
  }
  return text + "}\n";
}

std::string sum_of_boxes(int count) {
  return "minkowski() {\n" + boxes(count, 3, 50) + boxes(count, 2, 5) + "}\n";
}

double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Asks an import to stop after so much of its processor time. Returns how much more it takes, or
/// −1 if it ends by itself.
double seconds_after_stop(const std::string& text, double before_s) {
  const DesignTree tree = parse(text, "");
  std::stop_source stop;
  double ended_s = 0;
  bool is_stopped = false;
  std::atomic<bool> has_ended = false;
  std::thread importing([&] {
    try {
      import_design(tree, {}, stop.get_token());
    } catch (const Stopped&) {
      is_stopped = true;
    }
    ended_s = seconds(CLOCK_THREAD_CPUTIME_ID);
    has_ended = true;
  });
  clockid_t clock{};
  pthread_getcpuclockid(importing.native_handle(), &clock);
  while (seconds(clock) < before_s && !has_ended)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const double asked_s = seconds(clock);
  stop.request_stop();
  importing.join();
  return is_stopped ? ended_s - asked_s : -1;
}

/// Returns the processor time of an import that nothing stops.
double seconds_of(const std::string& text) {
  const DesignTree tree = parse(text, "");
  const double start_s = seconds(CLOCK_THREAD_CPUTIME_ID);
  import_design(tree, {}, {});
  return seconds(CLOCK_THREAD_CPUTIME_ID) - start_s;
}

void expect_prompt(double seconds) {
  constexpr double kMost_s = 0.1;  // of the processor's time, which other programs do not change
  EXPECT_GE(seconds, 0) << "it had ended before";
  EXPECT_LT(seconds, kMost_s);
}

TEST(ImportStops, WhileSumsAreMade) { expect_prompt(seconds_after_stop(sum_of_boxes(120), 0.1)); }

/// They are made last, and take most of the time, on a machine of any speed.
TEST(ImportStops, WhileHullsAreMade) {
  const std::string text = sum_of_boxes(80);
  expect_prompt(seconds_after_stop(text, 0.6 * seconds_of(text)));
}

}  // namespace
}  // namespace frontend
