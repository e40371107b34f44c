// Random statements of OpenSCAD's language which make small geometry and few nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace window_test {

/// Modules m0, m1, … call modules of lower numbers, functions f0, … and variables v0, … likewise,
/// so that a design takes little time, however its statements are mixed. What else recurses is
/// limited by its condition. Equal states give equal texts on every machine.
class RandomStatements {
 public:
  static constexpr std::size_t kModules = 8, kFunctions = 6, kVariables = 6;

  explicit RandomStatements(uint32_t seed) : random_(seed) {}

  /// Returns a number from 0 to count - 1; 0 if count is 0.
  std::size_t pick(std::size_t count) { return count > 0 ? random_() % count : 0; }
  bool chance(std::size_t one_in) { return pick(one_in) == 0; }

  /// Quiet statements say nothing where the names are known that a file of EditedDesign defines at
  /// first, call rands() and parent_module() never, and so may be evaluated once for all.
  void be_quiet(bool is_quiet) { is_quiet_ = is_quiet; }

  std::string number();
  /// A statement for the top level may call `levels` of the modules.
  std::string call(std::size_t levels = kModules) { return statement(levels, 2); }
  std::string module_definition(std::size_t number);
  std::string function_definition(std::size_t number);
  std::string assignment(std::size_t number);

 private:
  std::string expression(std::size_t functions, std::size_t variables, int depth);
  std::string expression() { return expression(kFunctions, kVariables, 1 + (chance(3) ? 1 : 0)); }
  std::string vector() {
    return "[" + expression() + ", " + expression() + ", " + expression() + "]";
  }
  std::string primitive();
  std::string figure(int depth);
  std::string arguments();
  std::string transform();
  std::string control();
  std::string module_call(std::size_t levels, int depth);
  std::string said();
  std::string children();
  std::string statement(std::size_t levels, int depth);
  std::string block(std::size_t levels, int depth);
  std::string body(std::size_t levels, int depth);

  std::mt19937 random_;
  bool is_quiet_ = false;
};

}  // namespace window_test
