// A random design of several files, which is edited at random.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "edits/random_statements.hpp"
#include "frontend/design_file_options.hpp"

namespace window_test {

/// A main file, a file that it includes, one that it uses, one that both of these use, and a solid.
class EditedDesign {
 public:
  explicit EditedDesign(uint32_t seed);

  /// Does one of: change, insert, remove, repeat, move statements, also within modules; change a
  /// number; damage a file; take edits back; remove or change a file; change the inputs.
  void edit();
  /// Undoes the last edit; may be called once after it.
  void take_back() { now_ = before_; }

  /// Returns the files' texts by their names; those that are not there are missing.
  std::map<std::string, std::string> texts() const;
  const frontend::DesignInputs& inputs() const { return now_.inputs; }
  RandomStatements& random() { return random_; }

 private:
  using Items = std::vector<std::string>;  // one statement each, or damaged ones
  struct State {
    std::map<std::string, Items> files;
    frontend::DesignInputs inputs;
  };

  void choose_quiet(const std::string& file);
  void add_definitions(const std::string& file, Items& items);
  Items library(const std::string& file);
  Items main_file();
  std::string item(const std::string& file);
  std::string part();
  void edit_items(const std::string& file);
  void edit_within(std::string& item);
  void edit_color(Items& items);
  void edit_inputs();
  void damage(std::string& item);

  RandomStatements random_;
  std::set<std::string> loud_;  // files of which a third of the statements are loud; else few
  State now_, before_, sound_;
  int damaged_ = 0;  // for how many edits
};

}  // namespace window_test
