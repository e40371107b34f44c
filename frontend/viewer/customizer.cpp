#include "customizer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "frontend/error.hpp"
#include "frontend/files.hpp"
#include "language/parameter_set_file.hpp"

namespace window {
namespace {

using language::ParameterSet;
using language::ParameterSetFile;

/// Returns the last value of an option that has one; empty: none.
std::string last_value(const std::vector<std::string>& arguments, const std::string& option) {
  std::string value;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
    if (arguments[i] == option) value = arguments[i + 1];
  }
  return value;
}

/// Returns the names that -D assigns.
std::vector<std::string> assigned(const std::vector<std::string>& arguments) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
    if (arguments[i] != "-D") continue;
    const std::string& text = arguments[++i];
    std::string name = text.substr(0, text.find('='));
    name.erase(name.find_last_not_of(" \t") + 1);
    name.erase(0, name.find_first_not_of(" \t"));
    names.push_back(std::move(name));
  }
  return names;
}

/// Returns the file's sets, none if there is no file. Throws frontend::Error.
ParameterSetFile read(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::exists(path, failed)) return ParameterSetFile();
  const frontend::FileText text = frontend::read_regular_file(path);
  try {
    return ParameterSetFile(text.view());
  } catch (const ParameterSetFile::ParseError& error) {
    throw frontend::Error(path + ":" + std::to_string(error.line), {}, "this is no JSON",
                          "correct it, or move it away");
  }
}

/// Does what may throw frontend::Error, and returns its text; empty: nothing was thrown.
template <typename Work>
std::string error_of(const Work& work) {
  try {
    work();
    return {};
  } catch (const frontend::Error& error) {
    return error.what();
  }
}

const Customizer::Parameter* find(const std::shared_ptr<const frontend::DesignParameters>& all,
                                  const std::string& name) {
  if (!all) return nullptr;
  const auto found = std::find_if(all->list.begin(), all->list.end(),
                                  [&](const auto& parameter) { return parameter.name == name; });
  return found == all->list.end() ? nullptr : &*found;
}

/// Returns the value that a set gives to a parameter, or else its default.
Customizer::Value value_in(const ParameterSet& set, const Customizer::Parameter& parameter) {
  const auto text = set.find(parameter.name);
  if (text == set.end()) return parameter.value;
  return language::value_of_text(text->second, parameter.value).value_or(parameter.value);
}

constexpr int kMostDecimals = 9;

/// Returns how many decimals a number is written with.
int decimals_of(double number) {
  for (int decimals = 0; decimals < kMostDecimals; ++decimals) {
    const double scaled = number * std::pow(10, decimals);
    if (std::abs(scaled - std::round(scaled)) <= 1e-9 * std::max(1.0, std::abs(scaled))) {
      return decimals;
    }
  }
  return kMostDecimals;
}

bool is_integer(double number) { return number == std::round(number); }

/// Returns the power of ten that is a hundredth to a thousandth of a length.
double fine_step(double length) {
  return std::pow(10, std::clamp(std::floor(std::log10(length)) - 2, -6.0, 6.0));
}

double natural_step(const std::optional<language::ParameterRange>& range, double fallback) {
  if (!range) return is_integer(fallback) ? 1 : fine_step(std::abs(fallback));
  const bool are_integers =
      is_integer(range->min) && is_integer(range->max) && is_integer(fallback);
  return are_integers ? 1 : fine_step(range->max - range->min);
}

}  // namespace

Customizer::Customizer(const std::string& design,
                       const std::vector<std::string>& openscad_arguments)
    : design_(design),
      file_(last_value(openscad_arguments, "-p")),
      fixed_(assigned(openscad_arguments)) {
  const bool has_file = !file_.empty();
  if (!has_file) file_ = std::filesystem::path(design).replace_extension(".json").string();
  if (has_file) {
    choose(last_value(openscad_arguments, "-P"));
  } else {
    read_sets();
  }
  inputs_.reset();  // the design is read with that set, by the options
}

void Customizer::take(std::shared_ptr<const frontend::DesignParameters> parameters) {
  if (parameters == parameters_) return;
  const auto before = std::exchange(parameters_, std::move(parameters));
  const bool was_touched = inputs_.has_value();
  std::erase_if(texts_, [&](const auto& entry) {
    const Parameter* was = find(before, entry.first);
    const Parameter* is = find(parameters_, entry.first);
    return was && (!is || !language::value_of_text(entry.second, is->value));
  });
  if (was_touched) inputs_ = texts_;
  show();
}

/// Groups stand where their first parameter does.
void Customizer::show() {
  shown_.clear();
  values_.clear();
  if (!parameters_) return;
  std::vector<std::string> groups;
  const auto is_shown = [&](const Parameter& parameter) {
    return !parameter.is_hidden() &&
           std::find(fixed_.begin(), fixed_.end(), parameter.name) == fixed_.end();
  };
  for (const Parameter& parameter : parameters_->list) {
    if (!is_shown(parameter)) continue;
    if (std::find(groups.begin(), groups.end(), parameter.group) == groups.end()) {
      groups.push_back(parameter.group);
    }
    shown_.push_back(parameter);
  }
  const auto rank = [&](const Parameter& parameter) {
    return std::find(groups.begin(), groups.end(), parameter.group) - groups.begin();
  };
  std::stable_sort(shown_.begin(), shown_.end(),
                   [&](const Parameter& a, const Parameter& b) { return rank(a) < rank(b); });
  for (const Parameter& parameter : shown_) values_.push_back(value_in(texts_, parameter));
}

void Customizer::changed() {
  inputs_ = texts_;
  show();
}

bool Customizer::is_any_changed() const {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (is_changed(i)) return true;
  }
  return false;
}

bool Customizer::is_set_changed() const {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (values_[i] != value_in(set_texts_, shown_[i])) return true;
  }
  return false;
}

void Customizer::set(std::size_t parameter, Value value) {
  const Parameter& of = shown_[parameter];
  if (value == of.value) return reset(parameter);
  texts_[of.name] = language::set_text(value);
  inputs_ = texts_;
  values_[parameter] = std::move(value);
}

void Customizer::reset(std::size_t parameter) {
  texts_.erase(shown_[parameter].name);
  inputs_ = texts_;
  values_[parameter] = shown_[parameter].value;
}

void Customizer::reset_all() {
  texts_.clear();
  changed();
}

std::string Customizer::read_sets() {
  return error_of([&] { set_names_ = read(file_).names(); });
}

std::string Customizer::choose(const std::string& set) {
  return error_of([&] {
    const ParameterSetFile file = read(file_);
    set_names_ = file.names();
    const auto found = set.empty() ? ParameterSet() : file.find(set);
    if (!found) throw frontend::Error(file_, {}, "it has no set \"" + set + "\"", "choose another");
    set_name_ = set;
    set_texts_ = texts_ = *found;
    changed();
  });
}

std::string Customizer::save(const std::string& set) {
  return error_of([&] {
    ParameterSetFile file = read(file_);
    ParameterSet all = texts_;
    for (const Parameter& parameter : parameters_ ? parameters_->list : std::vector<Parameter>()) {
      const bool is_given = texts_.contains(parameter.name);
      if (!is_given) all[parameter.name] = language::set_text(parameter.value);
    }
    if (!file.put(set, all)) {
      throw frontend::Error(file_, {}, "this is no file of parameter sets", "move it away");
    }
    write(file);
    set_name_ = set;
    set_texts_ = texts_;
  });
}

std::string Customizer::erase(const std::string& set) {
  return error_of([&] {
    ParameterSetFile file = read(file_);
    file.erase(set);
    write(file);
    if (set_name_ != set) return;
    set_name_.clear();
    set_texts_.clear();
  });
}

void Customizer::write(const ParameterSetFile& file) {
  const frontend::NamedPath design{"the design", design_}, sets{"the file of sets", file_};
  frontend::check_outputs_differ({&sets, 1}, {&design, 1});
  const frontend::PendingOutput output{file_, frontend::bytes_of(file.text())};
  frontend::write_outputs({&output, 1});
  set_names_ = file.names();
}

NumberGrid::NumberGrid(const language::CustomizerParameter& parameter, double fallback)
    : range_(parameter.range) {
  const std::optional<double> step = range_ ? range_->step : parameter.step;
  step_ = step.value_or(natural_step(range_, fallback));
  origin_ = range_ ? range_->min : step ? fallback : 0;
  decimals_ = std::max(decimals_of(step_), decimals_of(origin_));
}

double NumberGrid::clamp(double value) const {
  return range_ ? std::clamp(value, range_->min, range_->max) : value;
}

/// The result is written with few digits: 0.3 rather than 3 · 0.1.
double NumberGrid::snap(double value) const {
  const double near = origin_ + std::round((value - origin_) / step_) * step_;
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals_, near);
  return clamp(std::strtod(text, nullptr));
}

}  // namespace window
