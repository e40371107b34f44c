#include "language/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_set>

#include "base/evaluation_thread.hpp"
#include "evaluation/machine.hpp"
#include "language/make.hpp"
#include "syntax/parameter_set.hpp"
#include "syntax/parse_program.hpp"
#include "values/object_memory.hpp"
#include "values/value_text.hpp"

namespace language {
namespace {

// Bytes of the messages that an evaluation may say: they are kept until the output is written, and
// a recursion can say more than any memory holds.
constexpr size_t kMostMessageBytes = size_t{64} << 20;

ModuleShape shape_of(const BuiltinModule& module, uint32_t index, NameTable& names,
                     const Dialect& dialect) {
  ModuleShape shape{};
  shape.index = index;
  for (const auto& list : {module.positional, module.named_only})
    for (const std::string_view name : list) shape.parameters.push_back(names.intern(name));
  shape.positional =
      dialect.has_named_only_parameters ? module.positional.size() : shape.parameters.size();
  shape.takes_children = module.children == ChildRule::kTakes;
  shape.refuses_children = module.children == ChildRule::kRefuses;
  shape.successor = module.successor;
  shape.wants_first = module.wants_first != nullptr;
  return shape;
}

Builtins builtin_shapes(NameTable& names, const Dialect& dialect) {
  Builtins builtins;
  uint32_t index = 0;
  for (const BuiltinFunction& function : builtin_functions()) {
    const uint32_t number = index++;
    if (function.is_experimental && !dialect.has_objects) continue;
    const Arity arity = arity_of(function, dialect);
    const bool is_lazy =
        function.next_argument != nullptr && (dialect.has_lazy_functions || function.reads_names);
    FunctionShape& shape = builtins.functions[names.intern(function.name)];
    shape = {number, arity.least, arity.most, is_lazy};
    if (dialect.has_lazy_functions) continue;
    for (const std::string_view parameter : function.parameters)
      shape.parameters.push_back(names.intern(parameter));
  }
  index = 0;
  for (const BuiltinModule& module : builtin_modules(dialect.version)) {
    builtins.modules[names.intern(module.name)] = shape_of(module, index, names, dialect);
    ++index;
  }
  return builtins;
}

std::shared_ptr<KeptSources> sources_of(const EvaluationOptions& options) {
  if (!options.cache) return std::make_shared<KeptSources>();
  options.cache->begin(options.language);
  return options.cache->sources();
}

std::vector<std::string> font_files(const Program& program) {
  std::vector<std::string> files;
  for (const Unit& unit : program.units)
    files.insert(files.end(), unit.fonts.begin(), unit.fonts.end());
  return files;
}

// One evaluation, from text to nodes.
class Session {
 public:
  Session(const std::string& path, const EvaluationOptions& options, const MessageSink& sink,
          std::optional<std::string_view> text)
      : path_(path),
        options_(options),
        sink_(sink),
        text_(text),
        tree_(std::make_shared<NodeTree>()),
        program_(std::make_unique<Program>(dialect_of(options.language), sources_of(options))),
        messages_(program_->files, [this](const Message& message) { take(message); }) {}

  Evaluation run();

 private:
  void take(const Message& message);
  void abort();
  void run_program(Machine& machine);
  void parse_and_evaluate();
  void evaluate_program();
  void preset_names(Machine& machine) const;
  void apply_parameters(Machine& machine);
  void read_camera(const Machine& machine);
  void read_values(const Machine& machine);
  template <typename Converted>
  void read_camera_value(const Machine& machine, std::string_view name, std::string_view type,
                         Converted (*convert)(const Value&, bool&), Converted& target);
  void say_root_modifiers();
  void list_sources();

  const std::string& path_;
  const EvaluationOptions& options_;
  const MessageSink& sink_;
  std::optional<std::string_view> text_;  // of the main file
  std::shared_ptr<NodeTree> tree_;
  std::unique_ptr<Program> program_;
  Messages messages_;
  Machine* machine_ = nullptr;  // while it runs
  size_t said_bytes_ = 0;
  bool has_camera_ = false;
  Evaluation result_;
};

void Session::take(const Message& message) {
  said_bytes_ += message.line.size();
  const bool ends_run =
      message.group == MessageGroup::kError || message.group == MessageGroup::kTrace;
  if (machine_ && !ends_run && said_bytes_ > kMostMessageBytes)
    throw TooLarge("The design's messages take too much memory: more than 64 MiB");
  sink_({message.line, message.place, program_->files, message.group, message.text});
  if (!machine_) return;
  if (!options_.hard_warnings || message.group != MessageGroup::kWarning) return;
  if (program_->dialect.fails_by_hard_warnings) result_.outcome = Outcome::kRefused;
  throw HardWarning();
}

void Session::abort() {
  result_.outcome = Outcome::kAborted;
  *tree_ = {};
}

// Returns an angle from 0 to below 360 degrees.
double whole_turn(double angle_deg) {
  constexpr double kTurn_deg = 360;
  const double rest = std::fmod(angle_deg, kTurn_deg);
  return rest < 0 ? rest + kTurn_deg : rest;
}

Value numbers(std::initializer_list<double> list) {
  Value vector = make_vector(list.size());
  for (const double number : list) append_element(vector, number);
  return vector;
}

void Session::preset_names(Machine& machine) const {
  machine.preset("$fn", 0.0);
  machine.preset("$fa", 12.0);
  machine.preset("$fs", 2.0);
  machine.preset("$t", options_.time);
  machine.preset("$preview", Value::boolean(options_.is_preview));
  if (program_->dialect.has_chord_error) machine.preset("$fe", 0.0);
  ViewCamera view{{0, 0, 0}, {0, 0, 0}, 500};
  if (program_->dialect.knows_camera) view = options_.view;
  const auto& [x, y, z] = view.translation;
  const auto& [x_deg, y_deg, z_deg] = view.rotation_deg;
  machine.preset("$vpt", numbers({x, y, z}));
  machine.preset("$vpr", numbers({whole_turn(x_deg), whole_turn(y_deg), whole_turn(z_deg)}));
  machine.preset("$vpd", view.distance);
  machine.preset("$vpf", 22.5);
}

// OpenSCAD takes vectors of two elements for points of z = 0, and leaves the view as it is where
// these are no numbers.
std::optional<std::array<double, 3>> three_numbers(const Value& value, bool& is_converted) {
  const auto elements = value.is_vector() ? value.elements() : std::span<const Value>();
  const bool are_numbers = std::all_of(elements.begin(), elements.end(),
                                       [](const Value& element) { return element.is_number(); });
  is_converted = elements.size() == 2 || (elements.size() == 3 && are_numbers);
  if (!is_converted || !are_numbers) return std::nullopt;
  std::array<double, 3> numbers{};
  for (size_t axis = 0; axis < elements.size(); ++axis) numbers[axis] = elements[axis].number();
  return numbers;
}

std::optional<double> one_number(const Value& value, bool& is_converted) {
  is_converted = value.is_number();
  return is_converted ? std::optional(value.number()) : std::nullopt;
}

template <typename Converted>
void Session::read_camera_value(const Machine& machine, std::string_view name,
                                std::string_view type, Converted (*convert)(const Value&, bool&),
                                Converted& target) {
  const Value value = machine.top_level_value(name);
  if (!value.is_set() || value.is_undef()) return;
  bool is_converted = false;
  target = convert(value, is_converted);
  has_camera_ = has_camera_ || is_converted;
  if (is_converted || options_.camera == CameraChoice::kCommand) return;
  messages_.say(MessageGroup::kWarning, "Unable to convert " + std::string(name) + "=" +
                                            echo_text(value) + " to a " + std::string(type));
}

void Session::read_camera(const Machine& machine) {
  constexpr std::string_view kVector = "vec3 or vec2 of numbers", kNumber = "number";
  DesignCamera& camera = result_.camera;
  read_camera_value(machine, "$vpr", kVector, three_numbers, camera.rotation_deg);
  read_camera_value(machine, "$vpt", kVector, three_numbers, camera.translation);
  read_camera_value(machine, "$vpd", kNumber, one_number, camera.distance);
  read_camera_value(machine, "$vpf", kNumber, one_number, camera.field_of_view_deg);
  if (has_camera_ && options_.camera == CameraChoice::kDesign)
    messages_.say(MessageGroup::kWarning, "Viewall and autocenter disabled in favor of $vp*");
}

// Returns whether a value's text is short: it has few elements, those of its elements among them.
bool is_short(const Value& value, int& elements) {
  constexpr size_t kMostBytes = 200;
  if (--elements < 0) return false;
  if (value.is_string()) return value.text().size() <= kMostBytes;
  if (!value.is_vector()) return !value.is_object() && !value.is_function();
  return std::ranges::all_of(value.elements(),
                             [&](const Value& v) { return is_short(v, elements); });
}

std::string shown_value(const Value& value) {
  int elements = 50;
  if (is_short(value, elements)) return echo_text(value);
  std::string text(type_name(value.type()));
  if (value.is_vector()) text += " of " + std::to_string(value.elements().size()) + " elements";
  if (value.is_string()) text += " of " + std::to_string(value.text().size()) + " bytes";
  return text;
}

void Session::read_values(const Machine& machine) {
  for (const Assignment& assignment : program_->units[0].scope->assignments) {
    const std::string_view name = program_->names.text(assignment.name);
    const Value value = machine.top_level_value(name);
    if (value.is_set()) result_.values.emplace(name, shown_value(value));
  }
}

void Session::apply_parameters(Machine& machine) {
  const std::optional<ParameterSet> set =
      options_.parameters
          ? options_.parameters
          : read_parameter_set(options_.parameter_file, options_.parameter_set, messages_);
  if (!set) return;
  apply_parameter_set(*program_, messages_, *set,
                      [&](const Expression& value) { return machine.type_of(value); });
}

void Session::say_root_modifiers() {
  if (const auto other = root_modifiers(*tree_).other)
    messages_.warn("More than one Root Modifier (!)", *other);
}

// Bytes that a design's values may take (LANGUAGE.md, "Differences").
constexpr int64_t kMemoryLimit = int64_t{2} << 30;

void Session::run_program(Machine& machine) {
  machine_ = &machine;
  try {
    apply_parameters(machine);
    machine.run_assignments();
    machine.run_calls();
  } catch (const Aborted&) {
    if (program_->dialect.keeps_nodes_of_aborted) {
      if (result_.outcome != Outcome::kRefused) result_.outcome = Outcome::kAborted;
      machine.remove_open_nodes();
    } else {
      abort();
    }
    machine.end_early();
  }
  machine_ = nullptr;
}

// A loop may name the same files again and again.
void append_new(std::vector<std::string>& list, const std::vector<std::string>& paths) {
  std::unordered_set<std::string_view> known(list.begin(), list.end());
  std::vector<std::string> added;
  for (const std::string& path : paths)
    if (known.insert(path).second) added.push_back(path);
  list.insert(list.end(), added.begin(), added.end());
}

void Session::evaluate_program() {
  keep_freed_memory();
  object_memory.limit = kMemoryLimit;
  for (const std::string_view name :
       {"$fn", "$fa", "$fs", "$fe", "$t", "$preview", "$vpt", "$vpr", "$vpd", "$vpf"})
    program_->names.intern(name);
  DefinitionReader definitions(*program_, messages_, options_.stop);
  Compiler compiler(*program_, definitions, builtin_shapes(program_->names, program_->dialect),
                    {options_.check_parameters, options_.lazy_union});
  const std::string& folder = program_->units[0].folder;
  NamedFiles files(messages_, folder,
                   program_->dialect.finds_files_beside_calls ? &program_->files : nullptr);
  ModuleEnvironment modules{program_->dialect, messages_, files, options_.check_ranges};
  Machine machine(compiler, messages_, modules, *tree_, options_.stop);
  preset_names(machine);
  machine.set_traces(options_.traces.most_lines, options_.traces.has_parameters);
  machine.use_fonts(options_.text_meter.get(), font_files(*program_));
  try {
    run_program(machine);
    read_camera(machine);
    if (options_.wants_values) read_values(machine);
  } catch (const std::bad_alloc&) {  // outside of calls: for constants, or the text of a value
    messages_.say(MessageGroup::kError, "The design's values take too much memory");
    abort();
  }
  say_root_modifiers();
  list_sources();
  append_new(result_.files_read, files.files_read());
  append_new(result_.lookups, files.lookups());
}

void Session::list_sources() {
  std::vector<std::string> sources;
  for (const FileId file : program_->files.order()) sources.push_back(program_->files[file].path);
  append_new(result_.files_read, sources);
  for (const Unit& unit : program_->units) append_new(result_.files_read, unit.fonts);
  append_new(result_.lookups, program_->lookups);
}

void Session::parse_and_evaluate() {
  ParseOptions options;
  options.definitions = options_.definitions;
  options.hard_warnings = options_.hard_warnings;
  options.stop = options_.stop;
  options.text = text_;
  options.overlay = options_.overlay;
  const ParseOutcome parsed = parse_program(*program_, messages_, path_, options);
  if (parsed == ParseOutcome::kParsed) {
    result_.has_unparsed_files = std::any_of(program_->units.begin(), program_->units.end(),
                                             [](const Unit& unit) { return !unit.scope; });
    const WorkWatch watch(options_.stop);
    evaluate_program();
  } else {
    list_sources();  // a save of one of them may mend the design
    result_.outcome =
        parsed == ParseOutcome::kNotParsed ? Outcome::kNotParsed : Outcome::kUnreadable;
  }
}

Evaluation Session::run() {
  with_deep_stack(program_->dialect.most_symbols, [this] { parse_and_evaluate(); });
  result_.files = std::make_shared<const SourceFiles>(std::move(program_->files));
  tree_->has_all_digits = options_.has_all_digits;
  result_.tree = std::move(tree_);
  return std::move(result_);
}

}  // namespace

Evaluation evaluate(const std::string& path, const EvaluationOptions& options,
                    const MessageSink& sink, std::optional<std::string_view> text) {
  return Session(path, options, sink, text).run();
}

}  // namespace language
