// The design's parameters, the values that the user has given them, and the sets that these are
// kept in, in a file beside the design.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "frontend/design_version.hpp"
#include "language/customizer_parameter.hpp"

namespace language {
class ParameterSetFile;
}

namespace window {

class Customizer {
 public:
  using Parameter = language::CustomizerParameter;
  using Value = language::ParameterValue;

  /// The file of sets and the chosen set are those of -p and -P, or else the file beside the design
  /// that has its name, and none. A variable that -D assigns is not offered.
  Customizer(const std::string& design, const std::vector<std::string>& openscad_arguments);

  /// Takes the parameters of a newer version. Values of parameters that are gone, or have another
  /// type, are forgotten.
  void take(std::shared_ptr<const frontend::DesignParameters> parameters);

  /// Returns those that are shown, in the order of their groups.
  const std::vector<Parameter>& parameters() const { return shown_; }
  /// Returns the value of a parameter, by its index.
  const Value& value(std::size_t parameter) const { return values_[parameter]; }
  bool is_changed(std::size_t parameter) const {
    return values_[parameter] != shown_[parameter].value;
  }
  bool is_any_changed() const;
  /// Sets a value, which must have the default's type.
  void set(std::size_t parameter, Value value);
  void reset(std::size_t parameter);
  void reset_all();

  /// Returns what the design is to be read with: nothing as long as that is what the command line
  /// says.
  const std::optional<language::ParameterSet>& inputs() const { return inputs_; }

  const std::string& file() const { return file_; }
  /// Returns the names of the file's sets, as last read.
  const std::vector<std::string>& set_names() const { return set_names_; }
  /// Returns the name of the set that the values come from, or were saved in; empty: none.
  const std::string& set_name() const { return set_name_; }
  /// Returns whether values have changed since the set was chosen or saved.
  bool is_set_changed() const;

  // These read the file anew and return what went wrong; empty: nothing.

  std::string read_sets();
  /// Takes the values of a set; without a name the defaults.
  std::string choose(const std::string& set);
  /// Writes all values into a set, new or not. What else stands in the file stays.
  std::string save(const std::string& set);
  std::string erase(const std::string& set);

 private:
  void show();
  void changed();
  void write(const language::ParameterSetFile& file);

  std::string design_;
  std::string file_;
  std::vector<std::string> fixed_;  // variables that -D assigns
  std::shared_ptr<const frontend::DesignParameters> parameters_;
  std::vector<Parameter> shown_;
  std::vector<Value> values_;     // of shown_
  language::ParameterSet texts_;  // where they are not the defaults; also of unknown variables
  std::optional<language::ParameterSet> inputs_;

  std::vector<std::string> set_names_;
  std::string set_name_;
  language::ParameterSet set_texts_;
};

/// The values that a number of the customizer takes while it is dragged.
class NumberGrid {
 public:
  /// Of one of a parameter's numbers, whose default this is. Without a step in its comment it is 1
  /// where all are integers, or else a power of ten that divides its range into some hundreds.
  NumberGrid(const language::CustomizerParameter& parameter, double fallback);

  double step() const { return step_; }
  const std::optional<language::ParameterRange>& range() const { return range_; }
  /// Returns the next value of the grid, within the range.
  double snap(double value) const;
  /// Returns a value within the range.
  double clamp(double value) const;

 private:
  double origin_;
  double step_;
  int decimals_;  // of origin and step
  std::optional<language::ParameterRange> range_;
};

// What the user is entering in the customizer.

/// Belongs to one control, until what is entered counts.
struct ParameterEdit {
  std::string id;  // of the control; empty: nothing is being entered
  double number = 0;
  bool is_typed = false;  // the number is, and need not lie on the grid
  std::string text{};
};

}  // namespace window
