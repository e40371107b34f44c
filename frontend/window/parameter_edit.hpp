// What the user is entering in the customizer.
#pragma once

#include <string>

namespace window {

/// Belongs to one control, until what is entered counts.
struct ParameterEdit {
  std::string id;  // of the control; empty: nothing is being entered
  double number = 0;
  bool is_typed = false;  // the number is, and need not lie on the grid
  std::string text{};
};

}  // namespace window
