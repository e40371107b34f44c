#include "edits/random_statements.hpp"

#include <iterator>

namespace window_test {
namespace {

/// A recursion goes on while the first holds. No edit of theirs makes it longer: they have neither
/// numbers nor texts.
constexpr const char* kGoesOn = "$depth < PI * PI";
constexpr const char* kDeeper = "$depth = $depth + PI";

std::string numbered(char letter, std::size_t number) { return letter + std::to_string(number); }

}  // namespace

std::string RandomStatements::number() {
  const std::string whole = std::to_string(pick(10));
  return chance(4) ? whole + ".5" : whole;
}

/// Names that are unknown where the expression stands are undef, with a warning.
std::string RandomStatements::expression(std::size_t functions, std::size_t variables, int depth) {
  const auto part = [&] { return expression(functions, variables, depth - 1); };
  if (depth == 0 || chance(3)) {
    static constexpr const char* kNames[] = {"n",  "x",         "i",    "$k",    "$t * 8",
                                             "$l", "$children", "size", "count", "len(label)"};
    constexpr std::size_t kKnownEverywhere = 6;
    if (chance(3)) return kNames[pick(is_quiet_ ? kKnownEverywhere : std::size(kNames))];
    return variables > 0 && chance(3) ? numbered('v', pick(variables)) : number();
  }
  switch (pick(11)) {
    case 0:
      return "(" + part() + " > " + part() + " ? " + part() + " : " + part() + ")";
    case 1:
      return "(let (i = " + part() + ") i + " + part() + ")";
    case 2:
      return "[" + part() + ", " + part() + "][" + (chance(2) ? "0" : "i % 2") + "]";
    case 3:
      if (is_quiet_) return "(" + part() + " + $k)";
      return "rands(0, " + number() + ", " + (chance(2) ? "1" : "2, " + number()) + ")[0]";
    case 4:
      return "max([for (i = [0 : 2]) i * " + part() + "])";
    case 5:
      return !is_quiet_ && chance(3) ? "len(parent_module(0))" : "min(6, " + part() + ")";
    case 6:
    case 7:
      if (functions > 0) {
        return numbered('f', pick(functions)) + "(" + part() + (chance(4) ? ", $k = 2" : "") + ")";
      }
      [[fallthrough]];
    default:
      return "(" + part() + (chance(2) ? " + " : chance(2) ? " - " : " * ") + part() + ")";
  }
}

std::string RandomStatements::function_definition(std::size_t number) {
  const std::string name = numbered('f', number), value = expression(number, number, 2);
  if (chance(5)) {
    return "function " + name + "(n) = " + kGoesOn + " ? " + name + "(n - 1, " + kDeeper + ") + " +
           value + " : 1;";
  }
  if (chance(6))
    return name + " = function (n, x = " + expression(number, number, 1) + ") " + value + ";";
  return "function " + name + "(n, x = " + this->number() +
         ") = " + (!is_quiet_ && chance(6) ? "echo(\"" + name + "\", n) " : "") + value + ";";
}

std::string RandomStatements::assignment(std::size_t number) {
  if (chance(20)) return "$fn = " + this->number() + ";";
  if (chance(40)) return "$vpr = [" + this->number() + ", 0, 10 * $t];";
  const std::string bound = chance(8) ? "$k = " + expression(0, number, 1) + "; " : "";
  return bound + numbered('v', number) + " = " + expression(number, number, 2) + ";";
}

std::string RandomStatements::figure(int depth) {
  switch (depth == 0 ? pick(3) : pick(6)) {
    case 0:
      return "square([" + expression() + ", " + number() + "]);";
    case 1:
      return "circle(" + expression() + (chance(2) ? ", $fn = 6" : "") + ");";
    case 2:
      return "polygon([[0, 0], [" + number() + ", 1], [2, " + number() + "]]);";
    case 3:
      return "offset(" + number() + ") " + figure(depth - 1);
    case 4:
      return "translate([" + expression() + ", 1]) " + figure(depth - 1);
    default:
      return "difference() { " + figure(depth - 1) + " " + figure(depth - 1) + " }";
  }
}

std::string RandomStatements::primitive() {
  switch (pick(10)) {
    case 0:
    case 1:
      return "cube(" + vector() + (chance(2) ? ", center = true" : "") + ");";
    case 2:
      return "cube(" + expression() + ");";
    case 3:
    case 4:
      return "sphere(" + expression() + (chance(3) ? ", $fn = " + number() : "") + ");";
    case 5:
    case 6:
      return "cylinder(" + expression() + ", " + number() + ", " + number() +
             (chance(3) ? ", $fn = " + number() : "") + ");";
    case 7:
      return "linear_extrude(" + expression() + (chance(3) ? ", twist = 30" : "") +
             (chance(3) ? ", scale = 0.5" : "") + ") " + figure(1);
    case 8:
      return "rotate_extrude(" + std::string(chance(2) ? "angle = 90" : "") + ") translate([" +
             number() + ", 0]) square(" + number() + ");";
    default:
      return chance(2) ? "import(\"part.off\");" : "cylinder(d = " + expression() + ", h = $k);";
  }
}

std::string RandomStatements::arguments() {
  std::string text = "(";
  if (!chance(4)) text += expression();
  if (chance(3)) text += std::string(text.size() > 1 ? ", " : "") + "x = " + expression();
  if (chance(4)) {
    text +=
        std::string(text.size() > 1 ? ", " : "") + (chance(2) ? "$k = " : "$l = ") + expression();
  }
  return text + ")";
}

std::string RandomStatements::transform() {
  switch (pick(10)) {
    case 0:
      return "rotate(" + (chance(2) ? vector() : "30 * " + number()) + ") ";
    case 1:
      return "scale([1, " + number() + ", 0.5]) ";
    case 2:
      return "mirror([1, " + number() + ", 0]) ";
    case 3:
      return "multmatrix([[1, 0, 0, " + expression() + "], [0, 1, 0.2, 0], [0, 0, 1, 0]]) ";
    case 4:
    case 5:
      return "color(" + std::string(chance(3) ? "\"red\"" : "[0, 0.1 * " + number() + ", 1]") +
             (chance(4) ? ", 0.5" : "") + ") ";
    default:
      return "translate(" + vector() + ") ";
  }
}

std::string RandomStatements::control() {
  switch (pick(5)) {
    case 0:
      return "for (i = [0 : min(2, " + expression() + ")]) ";
    case 1:
      return "for (i = [" + number() + ", " + number() + "]) ";
    case 2:
      return "let (x = " + expression() + (chance(2) ? ", $k = " + number() : "") + ") ";
    case 3:
      return "intersection_for (i = [1 : 2]) ";
    default:
      return "if (" + expression() + " > " + number() + ") ";
  }
}

std::string RandomStatements::module_call(std::size_t levels, int depth) {
  return numbered('m', pick(levels)) + arguments() + (chance(2) ? ";" : " " + body(levels, depth));
}

std::string RandomStatements::said() {
  static constexpr const char* kSaid[] = {"echo(\"at\", n, $k);",
                                          "echo(parent_module(0), $parent_modules);",
                                          "echo($children, x);",
                                          "echo(v1, f1(2));",
                                          "echo(rands(0, 1, 1)[0] > 0.5);",
                                          "assert(true);",
                                          "missing(1);",
                                          "cube(missing);",
                                          "echo(str(size, label));"};
  return chance(25) ? "assert(" + expression() + " < 30);" : kSaid[pick(std::size(kSaid))];
}

std::string RandomStatements::children() {
  static constexpr const char* kChildren[] = {"children();", "children(0);", "children(i);",
                                              "children([0 : 1]);", "children($k % 2);"};
  return kChildren[pick(std::size(kChildren))];
}

std::string RandomStatements::statement(std::size_t levels, int depth) {
  static constexpr const char* kModifiers[] = {"%", "#", "*", "#", "%", "*", "#", "!"};
  const std::string modifier = chance(20) ? kModifiers[pick(std::size(kModifiers))] : "";
  if (!is_quiet_ && chance(4)) return said();
  if (depth == 0) return modifier + primitive();
  switch (pick(12)) {
    case 0:
    case 1:
      return modifier + primitive();
    case 2:
    case 3:
      return modifier + transform() + body(levels, depth - 1);
    case 4:
    case 5:
      return modifier + control() + body(levels, depth - 1) +
             (chance(6) ? " " + body(levels, depth - 1) : "");
    case 6: {
      static constexpr const char* kOperations[] = {
          "union", "difference", "difference", "intersection", "hull", "group", "render"};
      return modifier + kOperations[pick(std::size(kOperations))] + "() " +
             block(levels, depth - 1);
    }
    case 7:
      if (chance(3))
        return modifier + "minkowski() { " + primitive() + " sphere(" + number() + "); }";
      return children();
    default:
      if (levels == 0) return modifier + transform() + primitive();
      return modifier + module_call(levels, depth - 1);
  }
}

std::string RandomStatements::block(std::size_t levels, int depth) {
  std::string text = "{ ";
  if (chance(4)) text += chance(3) ? "$k = " + number() + "; " : "x = " + expression() + "; ";
  for (std::size_t count = 1 + pick(3); count > 0; --count) text += statement(levels, depth) + " ";
  return text + "}";
}

std::string RandomStatements::body(std::size_t levels, int depth) {
  return chance(2) ? block(levels, depth) : statement(levels, depth);
}

std::string RandomStatements::module_definition(std::size_t number) {
  const std::string name = numbered('m', number);
  std::string text =
      "module " + name + "(n = " + this->number() + ", x = " + this->number() + ") {\n";
  if (chance(4)) text += "  n = " + expression() + ";\n";
  if (chance(4)) text += "  x = " + expression() + ";\n";
  if (chance(5)) text += "  $k = " + expression() + ";\n";
  if (chance(4)) {
    text += "  module part(i) " + block(number, 1) + "\n  part(" + expression() + ");\n";
  }
  if (chance(5)) {
    text += "  function f1(n) = n + x;\n  cube(f1(" + expression() + "));\n";
  }
  if (chance(6)) {
    text += std::string("  if (") + kGoesOn + ") translate([2, 0, n]) " + name + "(n - 1, " +
            kDeeper + ")" + (chance(2) ? " children()" : "") + ";\n";
  }
  for (std::size_t count = 1 + pick(3); count > 0; --count) {
    text += "  " + statement(number, 1) + "\n";
  }
  if (chance(2)) text += "  " + children() + "\n";
  return text + "}";
}

}  // namespace window_test
