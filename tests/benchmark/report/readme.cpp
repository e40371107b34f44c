#include "readme.hpp"

#include <stdexcept>

namespace report {
namespace {

size_t only_place_of(const std::string& mark, const std::string& text) {
  const size_t place = text.find(mark);
  if (place == std::string::npos || text.find(mark, place + 1) != std::string::npos) {
    throw std::runtime_error("the line " + mark + " has to stand in it once");
  }
  return place;
}

}  // namespace

std::string with_region(const std::string& readme, const std::string& region) {
  const size_t start = only_place_of(kRegionStart, readme) + std::string(kRegionStart).size();
  const size_t end = only_place_of(kRegionEnd, readme);
  if (end < start) throw std::runtime_error("the benchmarks' end stands before their start");
  return readme.substr(0, start) + "\n" + region + readme.substr(end);
}

}  // namespace report
