#include "habits.hpp"

#include <charconv>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/color_scheme.hpp"

namespace window {
namespace {

using frontend::GivenLook;

constexpr Size kDefaultSize{1024, 768};

constexpr const char* kOn = "on";
constexpr const char* kOff = "off";
constexpr const char* kScheme = "colours";
constexpr const char* kSamples = "samples";
constexpr const char* kSize = "size";
constexpr const char* kPosition = "position";
constexpr const char* kMaximized = "maximized";

/// What is on or off. The commands switch it on and off; they are one and the same where that
/// changes it.
struct Switch {
  const char* name;
  Command on, off;
  bool GivenLook::*given;  // whether the command line says it; null: it never does
};
constexpr Switch kSwitches[] = {
    {"axes", Command::kAxes, Command::kAxes, &GivenLook::view},
    {"crosshairs", Command::kCrosshairs, Command::kCrosshairs, &GivenLook::view},
    {"scales", Command::kScales, Command::kScales, &GivenLook::view},
    {"edges", Command::kEdges, Command::kEdges, &GivenLook::view},
    {"orthographic", Command::kOrthographic, Command::kPerspective, &GivenLook::projection},
    {"phong", Command::kPhongShading, Command::kOpenScadShading, &GivenLook::shading},
    {"parameters", Command::kParameters, Command::kParameters, nullptr},
    {"status_line", Command::kStatus, Command::kStatus, nullptr},
    {"messages", Command::kMessages, Command::kMessages, nullptr},
    {"place", Command::kPlace, Command::kPlace, nullptr},
};

std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Returns the two numbers that a space divides.
std::optional<std::pair<int, int>> pair_of(const std::string* text) {
  if (text == nullptr) return std::nullopt;
  const std::size_t space = text->find(' ');
  if (space == std::string::npos) return std::nullopt;
  const auto first = number_of(std::string_view(*text).substr(0, space));
  const auto second = number_of(std::string_view(*text).substr(space + 1));
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

std::string text_of(int first, int second) {
  return std::to_string(first) + " " + std::to_string(second);
}

}  // namespace

Memory::Values habits_of(const State& state) {
  Memory::Values values;
  for (const Switch& row : kSwitches) values[row.name] = state.is_checked(row.on) ? kOn : kOff;
  values[kScheme] = state.look.scheme.name;
  values[kSamples] = std::to_string(state.look.samples);
  return values;
}

void restore_habits(const Memory& memory, const GivenLook& given, State& state) {
  for (const Switch& row : kSwitches) {
    const std::string* const value = memory.find(row.name);
    if (value == nullptr || (row.given != nullptr && given.*row.given)) continue;
    if (*value == kOn && !state.is_checked(row.on)) state.apply(row.on);
    if (*value == kOff && state.is_checked(row.on)) state.apply(row.off);
  }
  state.notice.clear();  // it answers commands, and there was none yet
  const std::string* const scheme = memory.find(kScheme);
  if (scheme != nullptr && !given.scheme) {
    if (const auto* known = frontend::find_color_scheme(*scheme)) state.look.scheme = *known;
  }
  const std::string* const samples = memory.find(kSamples);
  if (samples == nullptr || given.samples) return;
  const int number = number_of(*samples).value_or(0);
  if (number >= 1 && number <= static_cast<int>(frontend::kMaxSamples)) {
    state.look.samples = static_cast<uint32_t>(number);
  }
}

Memory::Values values_of(const Placement& placement, bool has_position) {
  Memory::Values values;
  values[kMaximized] = placement.is_maximized ? kOn : kOff;
  if (placement.is_maximized) return values;  // it goes back to the size that it had before
  values[kSize] = text_of(static_cast<int>(placement.size.width_px),
                          static_cast<int>(placement.size.height_px));
  if (has_position && placement.position) {
    values[kPosition] = text_of(placement.position->first, placement.position->second);
  }
  return values;
}

Placement remembered_placement(const Memory& memory, const std::optional<Size>& given) {
  Placement placement;
  placement.size = given.value_or(kDefaultSize);
  if (memory.is_only_window()) placement.position = pair_of(memory.find(kPosition));
  if (given) return placement;
  const std::string* const maximized = memory.find(kMaximized);
  placement.is_maximized = maximized != nullptr && *maximized == kOn;
  const auto size = pair_of(memory.find(kSize));
  if (size && size->first > 0 && size->second > 0) {
    placement.size = {static_cast<uint32_t>(size->first), static_cast<uint32_t>(size->second)};
    placement.fits_screen = true;
  }
  return placement;
}

}  // namespace window
