// What differs between the versions of OpenSCAD's language: a table, each row with the behaviour of
// 2021.01, the last release, beside that of 2026, the development snapshots (LANGUAGE.md,
// "Dialects"). Each row is read in one place.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "language/language_version.hpp"

namespace language {

class Dialect : public VersionTable {
 private:
  constexpr std::string_view words(std::string_view of_2021, std::string_view of_2026) const {
    return row(of_2021, of_2026);
  }

 public:
  using VersionTable::VersionTable;

  // Text

  /// Whether `0x1F` is a number; else it is a name.
  const bool has_hexadecimal_numbers = row(false, true);
  /// Whether it is said that a whole number is none that a double can hold.
  const bool tells_imprecise_integers = row(false, true);
  /// Whether names that begin with a digit are deprecated.
  const bool deprecates_digits_first = row(false, true);
  /// Whether `$` alone is a name.
  const bool has_bare_dollars = row(false, true);
  /// Whether it is said that a backslash begins no escape.
  const bool tells_undefined_escapes = row(false, true);
  /// Whether line ends of paths of `include` and `use` are counted, before the brackets and within
  /// them, and warned of within them.
  const bool counts_lines_of_paths = row(false, true);

  // Grammar

  /// Whether commas may be doubled, and stand before the first parameter or element. One may stand
  /// behind the last one, whatever it is.
  const bool has_doubled_commas = row(true, false);
  /// Whether a number with a minus before it is one number, not an operation.
  const bool has_negative_numbers = row(false, true);
  /// Whether an assignment that overwrites others tells of the first of them; else of the last.
  const bool tells_first_assignment = row(false, true);
  /// Whether a vector's first element may be a comprehension in parentheses.
  const bool has_comprehension_first = row(false, true);
  /// Whether a comprehension over several variables is one loop, also over none; else several, and
  /// over none its body, as the text of a function shows.
  const bool joins_loops = row(false, true);

  /// How many symbols of nested code are stacked, and how many calls follow each other in a chain.
  const uint32_t most_symbols = row(19'994u, 199'994u);
  const uint32_t most_chained_calls = row(20'000u, 200'000u);

  // Scopes and calls

  /// Whether the left operand of an operator is evaluated first, and a container before its index.
  const bool evaluates_left_first = row(false, true);
  /// Whether all arguments are evaluated as they are written, and before anything else of the call:
  /// before the warnings about them, the defaults of what is not given, and the `$` names that they
  /// bind. In 2021.01 the order is that of a table, all defaults and the warnings come first, and
  /// `$` names are bound one by one.
  const bool has_arguments_first = row(false, true);
  /// Whether an unnamed argument goes to the next parameter that has none, and not simply to the
  /// next one.
  const bool fills_free_parameters = row(false, true);
  /// Whether the last default counts of a parameter that is listed twice; else the first.
  const bool takes_last_default = row(true, false);
  /// Whether unnamed arguments cannot fill some of a builtin module's parameters.
  const bool has_named_only_parameters = row(true, false);
  /// Whether a block is evaluated when the children of its call are, each time; else before the
  /// call's arguments, which see its variables.
  const bool has_blocks_at_children = row(false, true);
  /// Whether children() and the operations are modules like others, whose arguments are all
  /// evaluated and checked; children() then always makes a group.
  const bool has_plain_children = row(false, true);
  /// Whether loops, blocks and children() can be lists of nodes, where --enable=lazy-union asks for
  /// it; else they are always groups.
  const bool has_lazy_unions = row(false, true);
  /// Whether primitives refuse a block that has assignments only.
  const bool refuses_assignments = row(true, false);
  /// Whether the `$` names of a used file's top level are seen there alone, and not by what it
  /// defines.
  const bool forgets_names_of_units = row(false, true);
  /// Whether a `$` name can be called.
  const bool calls_dynamic_names = row(false, true);
  /// Whether a variable that holds no function hides no function that one further out holds.
  const bool finds_outer_functions = row(false, true);
  /// Whether each call in tail position starts the frame anew; else those by the running function's
  /// own name, whatever it means.
  const bool has_all_tail_calls = row(false, true);
  /// Whether each round of a loop in a vector has its own variables.
  const bool has_scopes_of_rounds = row(false, true);

  /// Whether the increments of a C-style for bind `$` names until the loop's end.
  const bool keeps_names_of_increments = row(false, true);
  /// Whether assert() without a condition is said to miss one.
  const bool misses_condition = row(true, false);
  /// The elements from which on a range is too long for the module for().
  const uint32_t too_many_rounds = row(10'000u, 1'000'000u);
  /// Whether an evaluation that is aborted leaves the nodes of those statements of the top level
  /// that had ended.
  const bool keeps_nodes_of_aborted = row(false, true);
  /// Whether the program fails after a hard warning, and writes no tree.
  const bool fails_by_hard_warnings = row(false, true);
  /// Whether traces name assignments, and the parameters of modules.
  const bool has_full_traces = row(false, true);

  // Values and functions

  /// Whether [begin : end] with a lesser end is swapped, which is deprecated; else it is empty,
  /// which is said of literals.
  const bool swaps_reversed_ranges = row(true, false);
  /// Whether vectors have members of several letters, v.zyx and v.rgba, and a fourth one.
  const bool has_swizzles = row(false, true);
  /// Whether builtin functions evaluate their arguments one by one, up to the first that is wrong;
  /// else all of them, before anything is said, also where there are too many.
  const bool has_lazy_functions = row(true, false);
  /// Whether messages say which argument has the wrong type, and how many there should be.
  const bool tells_wrong_arguments = row(false, true);
  /// Whether min() and max() compare all elements of a vector; else numbers only.
  const bool compares_any_elements = row(true, false);
  /// Whether search() has freed texts of 16 bytes and more when it looks at them, finds numbers by
  /// their texts, and warns of what it does not find.
  const bool has_old_search = row(true, false);
  /// Whether norm() and lookup() say what is no vector.
  const bool tells_missing_vectors = row(false, true);
  /// Whether a number that does not fit becomes the nearest integer, 0 if it is NaN; else what C's
  /// cast makes of it on x86: the least int, or the low bits of 64.
  const bool has_nearest_integers = row(false, true);
  /// Cut a number to an integer.
  int integer(double number) const;
  uint32_t unsigned_integer(double number) const;
  /// What version() returns: year, month and day.
  const std::array<double, 3> program =
      row(std::array<double, 3>{2021, 1, 0}, std::array<double, 3>{2025, 7, 18});
  /// Whether files are looked for beside the file that has the call; else beside the main or used
  /// file, which may include that one.
  const bool finds_files_beside_calls = row(false, true);
  /// Whether the place is said where a file that is included or used cannot be opened.
  const bool tells_place_of_missing_files = row(false, true);
  /// Whether the paths in all messages are relative to the main file's folder; else in some to that
  /// of the used file whose code is being evaluated, or of the file that uses what is parsed.
  const bool shows_paths_from_main_file = row(false, true);

  /// Whether $vpt, $vpr and $vpd are the camera of the command line when a design begins; else they
  /// are what OpenSCAD 2021.01 begins with.
  const bool knows_camera = row(false, true);
  /// Whether $fe, the largest error of a chord, is known, and written where it is above 0.
  const bool has_chord_error = row(false, true);
  /// Whether there are objects, with the functions that make and read them, and import() of JSON,
  /// textmetrics() and fontmetrics(), which are experimental in OpenSCAD.
  const bool has_objects = row(false, true);
  /// Whether a function that is called as a member of an object gets that object as its parameter
  /// `this`, unless the call gives one.
  const bool has_methods = row(false, true);

  // Nodes, and their text in a .csg

  /// Whether matrices and lists of points are written by C's %g, which keeps -0; else as echo()
  /// writes numbers.
  const bool writes_general_numbers = row(false, true);
  /// Whether primitives without fragments warn of $fa and $fs that are too small.
  const bool checks_unused_fragments = row(true, false);
  /// Whether color() checks its alpha, and what is no colour has none.
  const bool checks_alpha = row(false, true);
  /// Whether "xkcd:dust" is a colour.
  const bool has_survey_colors = row(false, true);
  /// Whether messages about colours have their names in small letters, and say where names are.
  const bool tells_of_web_colors = row(true, false);

  // Words, with {} for what they speak of

  const std::string_view overwritten =
      words("{} was assigned on line {}{} but was overwritten",
            "\"{}\" was assigned on line {}{} but was overwritten");
  const std::string_view undeclared_argument =
      words("variable {} not specified as parameter", "variable \"{}\" not specified as parameter");
  const std::string_view repeated_argument =
      words("argument {} supplied more than once", "argument \"{}\" supplied more than once");
  const std::string_view overriding_argument =
      words("argument {} supplied more than once", "argument \"{}\" overrides positional argument");
  const std::string_view ignored_radius =
      words("Ignoring radius variable '{}' as diameter '{}' is defined too.",
            "Ignoring radius variable \"{}\" as diameter \"{}\" is defined too.");
  const std::string_view missing_include =
      words("Can't open include file '{}'", "Can't find include file '{}'");
  const std::string_view unknown_variable =
      words("Ignoring unknown variable '{}'", "Ignoring unknown variable \"{}\"");
  const bool names_module_of_parameter = row(true, false);
  const std::string_view overwritten_parameter =
      words("Module {}: Parameter {} is overwritten with a literal",
            "Parameter \"{}\" is overwritten with a literal");
  const std::string_view duplicate_assignment =
      words("Ignoring duplicate variable assignment {} = {}",
            "Ignoring duplicate variable assignment \"{}\" = {}");
};

/// Returns the dialect of a version, which lasts.
const Dialect& dialect_of(LanguageVersion version);

/// Returns words with each {} replaced by the next of the parts.
std::string filled(std::string_view words, std::initializer_list<std::string_view> parts);

}  // namespace language
