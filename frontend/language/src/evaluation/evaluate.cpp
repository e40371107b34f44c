#include "base/with_deep_stack.hpp"
#include "evaluation/builtin_shapes.hpp"
#include "evaluation/machine.hpp"
#include "language/evaluation.hpp"
#include "syntax/parse_program.hpp"
#include "values/make.hpp"

namespace language {
namespace {

// One evaluation, from text to nodes.
class Session {
 public:
  Session(const std::string& path, const EvaluationOptions& options, const MessageSink& sink,
          std::string_view standard_input)
      : path_(path),
        options_(options),
        sink_(sink),
        standard_input_(standard_input),
        program_(std::make_shared<Program>()),
        messages_(program_->files, [this](const Message& message) { take(message); }) {
    result_.root = std::make_shared<Node>();
    result_.files = std::shared_ptr<const SourceFiles>(program_, &program_->files);
  }

  Evaluation run();

 private:
  void take(const Message& message);
  void evaluate_program();
  void preset_names(Machine& machine) const;
  void read_camera(const Machine& machine);
  void say_root_modifiers();
  void list_files(const ModuleEnvironment& modules);

  const std::string& path_;
  const EvaluationOptions& options_;
  const MessageSink& sink_;
  std::string_view standard_input_;
  std::shared_ptr<Program> program_;
  Messages messages_;
  Machine* machine_ = nullptr;
  Evaluation result_;
};

void Session::take(const Message& message) {
  sink_(message.line);
  if (!machine_) return;
  machine_->count_message();
  if (options_.hard_warnings && message.group == MessageGroup::kWarning) throw HardWarning();
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
  machine.preset("$vpt", numbers({0, 0, 0}));
  machine.preset("$vpr", numbers({0, 0, 0}));
  machine.preset("$vpd", 500.0);
  machine.preset("$vpf", 22.5);
}

bool assigns(const Scope& scope, Name name) {
  for (const Assignment& assignment : scope.assignments)
    if (assignment.name == name) return true;
  return false;
}

std::optional<std::array<double, 3>> three_numbers(const Value& value) {
  if (!value.is_vector() || value.elements().size() != 3) return std::nullopt;
  std::array<double, 3> numbers;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (!value.elements()[axis].is_number()) return std::nullopt;
    numbers[axis] = value.elements()[axis].number();
  }
  return numbers;
}

std::optional<double> one_number(const Value& value) {
  return value.is_number() ? std::optional(value.number()) : std::nullopt;
}

void Session::read_camera(const Machine& machine) {
  const Scope& scope = *program_->units[0].scope;
  const auto value_of = [&](std::string_view name) {
    return assigns(scope, program_->names.find(name)) ? machine.top_level_value(name)
                                                      : Value::undef();
  };
  result_.camera.translation = three_numbers(value_of("$vpt"));
  result_.camera.rotation_deg = three_numbers(value_of("$vpr"));
  result_.camera.distance = one_number(value_of("$vpd"));
  result_.camera.field_of_view_deg = one_number(value_of("$vpf"));
}

void Session::say_root_modifiers() {
  if (const auto other = root_modifiers(*result_.root).other)
    messages_.warn("More than one Root Modifier (!)", *other);
}

void Session::evaluate_program() {
  for (const std::string_view name :
       {"$fn", "$fa", "$fs", "$t", "$preview", "$vpt", "$vpr", "$vpd", "$vpf"})
    program_->names.intern(name);
  Compiler compiler(*program_, builtin_shapes(program_->names), options_.check_parameters);
  const std::string& folder = program_->units[0].folder;
  ModuleEnvironment modules{messages_, folder, folder, options_.check_ranges};
  Machine machine(compiler, messages_, modules, options_.stop);
  machine_ = &machine;
  preset_names(machine);
  try {
    machine.run_assignments();
    read_camera(machine);
    machine.run_calls(result_.root);
  } catch (const Aborted&) {
    result_.outcome = Outcome::kAborted;
    result_.root = std::make_shared<Node>();
  }
  machine_ = nullptr;
  say_root_modifiers();
  list_files(modules);
}

void Session::list_files(const ModuleEnvironment& modules) {
  for (FileId file = 0; file < program_->files.size(); ++file)
    result_.files_read.push_back(program_->files[file].path);
  for (const Unit& unit : program_->units)
    result_.files_read.insert(result_.files_read.end(), unit.fonts.begin(), unit.fonts.end());
  result_.files_read.insert(result_.files_read.end(), modules.files_read.begin(),
                            modules.files_read.end());
  result_.lookups = program_->lookups;
  result_.lookups.insert(result_.lookups.end(), modules.lookups.begin(), modules.lookups.end());
}

Evaluation Session::run() {
  ParseOptions options;
  options.definitions = options_.definitions;
  options.hard_warnings = options_.hard_warnings;
  options.stop = options_.stop;
  options.standard_input = standard_input_;
  const ParseOutcome parsed = parse_program(*program_, messages_, path_, options);
  if (parsed == ParseOutcome::kParsed) {
    with_deep_stack([&] { evaluate_program(); });
  } else {
    result_.outcome =
        parsed == ParseOutcome::kNotParsed ? Outcome::kNotParsed : Outcome::kUnreadable;
  }
  return std::move(result_);
}

}  // namespace

Evaluation evaluate(const std::string& path, const EvaluationOptions& options,
                    const MessageSink& sink, std::string_view standard_input) {
  return Session(path, options, sink, standard_input).run();
}

}  // namespace language
