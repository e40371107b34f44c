#include "edits/edited_design.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace window_test {
namespace {

/// The first item of the main file seeds rands(), which is seeded by the time otherwise, and lets
/// recursions end; it is left alone.
constexpr const char* kSeeding = "seeding = rands(0, 1, 1, 42); $depth = 0;";

/// The names that expressions use wherever they stand.
constexpr const char* kOrdinary = "n = 2; x = 3; i = 1;";

constexpr const char* kFiles[] = {"main.scad", "main.scad", "main.scad",
                                  "lib.scad",  "used.scad", "deep.scad"};

struct Modules {
  std::size_t first, count;
};
Modules modules_of(const std::string& file) {
  if (file == "deep.scad") return {0, 3};
  if (file == "used.scad") return {1, 4};
  if (file == "lib.scad") return {2, 4};
  return {3, 5};
}

}  // namespace

EditedDesign::EditedDesign(uint32_t seed) : random_(seed) {
  for (const char* file : {"deep.scad", "used.scad", "lib.scad", "main.scad"}) {
    if (random_.chance(3)) loud_.insert(file);
  }
  for (const char* file : {"deep.scad", "used.scad", "lib.scad"}) now_.files[file] = library(file);
  now_.files["used.scad"].insert(now_.files["used.scad"].begin(), "use <deep.scad>");
  now_.files["lib.scad"].push_back("use <deep.scad>");
  if (random_.chance(3)) now_.files["used.scad"].push_back("include <deep.scad>");
  now_.files["main.scad"] = main_file();
  now_.files["part.off"] = {part()};
  before_ = sound_ = now_;
}

void EditedDesign::choose_quiet(const std::string& file) {
  random_.be_quiet(!random_.chance(loud_.contains(file) ? 3 : 30));
}

void EditedDesign::add_definitions(const std::string& file, Items& items) {
  for (std::size_t i = 0; i < RandomStatements::kVariables; ++i) {
    choose_quiet(file);
    items.push_back(random_.assignment(i));
  }
  for (std::size_t i = 0; i < RandomStatements::kFunctions; ++i) {
    choose_quiet(file);
    items.push_back(random_.function_definition(i));
  }
}

EditedDesign::Items EditedDesign::library(const std::string& file) {
  const Modules modules = modules_of(file);
  Items items = {kOrdinary};
  add_definitions(file, items);
  for (std::size_t i = 0; i < modules.count; ++i) {
    choose_quiet(file);
    items.push_back(random_.module_definition(modules.first + i));
  }
  if (random_.chance(3)) items.push_back(random_.call(modules.first));
  return items;
}

EditedDesign::Items EditedDesign::main_file() {
  Items items = {kSeeding,
                 "size = " + random_.number() + "; // [0:0.5:10]",
                 "count = 2; // [0:4]",
                 "label = \"ab\"; // [ab, abc, abcd]",
                 "$k = 2; $l = 1;",
                 kOrdinary,
                 "include <lib.scad>",
                 "use <used.scad>"};
  add_definitions("main.scad", items);
  for (std::size_t i = 5; i < RandomStatements::kModules; ++i) {
    choose_quiet("main.scad");
    items.push_back(random_.module_definition(i));
  }
  for (std::size_t i = 0; i < 10; ++i) {
    choose_quiet("main.scad");
    items.push_back(random_.call());
  }
  // What is seen of most designs, and of which an edit often changes the colour alone.
  items.push_back("color([0, 0.1 * 3, 1]) { cylinder(8, 5, 2); cube(6); }");
  return items;
}

/// A box of a random height, as a file.
std::string EditedDesign::part() {
  const std::string h = std::to_string(1 + random_.pick(6));
  return "OFF\n4 4 0\n0 0 0\n4 0 0\n0 4 0\n0 0 " + h + "\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
}

std::string EditedDesign::item(const std::string& file) {
  const Modules modules = modules_of(file);
  choose_quiet(file);
  switch (random_.pick(8)) {
    case 0:
    case 1:
      return random_.assignment(random_.pick(RandomStatements::kVariables));
    case 2:
      return random_.function_definition(random_.pick(RandomStatements::kFunctions));
    case 3:
    case 4:
      return random_.module_definition(modules.first + random_.pick(modules.count));
    case 5:
      if (random_.chance(4) && file == "main.scad") {
        return random_.chance(2) ? "include <lib.scad>" : "use <used.scad>";
      }
      [[fallthrough]];
    default:
      return random_.call(file == "main.scad" ? RandomStatements::kModules : modules.first);
  }
}

void EditedDesign::edit_within(std::string& item) {
  if (random_.chance(3)) {
    std::vector<std::size_t> braces;
    for (std::size_t i = 0; i < item.size(); ++i) {
      if (item[i] == '{') braces.push_back(i);
    }
    if (!braces.empty()) {
      item.insert(braces[random_.pick(braces.size())] + 1, " " + random_.call(0));
      return;
    }
  }
  const std::size_t digit = item.find_first_of("0123456789", random_.pick(item.size()));
  if (digit != item.npos) item[digit] = static_cast<char>('0' + random_.pick(10));
}

/// Changes a digit of a colour, if the file has any, most often that of the last one.
void EditedDesign::edit_color(Items& items) {
  constexpr std::string_view kComponent = "0.1 * ";  // a digit follows
  std::vector<char*> digits;
  for (std::string& item : items) {
    const std::size_t at = item.find(kComponent);
    if (at != item.npos) digits.push_back(&item[at + kComponent.size()]);
  }
  if (digits.empty()) return;
  char& digit = random_.chance(2) ? *digits.back() : *digits[random_.pick(digits.size())];
  digit = static_cast<char>('0' + random_.pick(10));
}

void EditedDesign::damage(std::string& item) {
  static constexpr const char* kPieces[] = {
      ";",       "}", "{",   ")", "(",      "\"",           "/* x ",
      "\nelse ", "[", " = ", "@", "\r\n\n", "// comment\n", "/**/"};
  item.insert(random_.pick(item.size() + 1), kPieces[random_.pick(std::size(kPieces))]);
  damaged_ = 1;
}

void EditedDesign::edit_items(const std::string& file) {
  Items& items = now_.files[file];
  const std::size_t first = file == "main.scad" ? 1 : 0;  // behind what is left alone
  const auto place = [&] { return first + random_.pick(items.size() - first); };
  const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
  if (items.size() <= first + 1) {
    items.push_back(item(file));
    return;
  }
  switch (random_.pick(16)) {
    case 0:
    case 1:
      items[place()] = item(file);
      break;
    case 2:
    case 3:
      items.insert(at(place()), item(file));
      break;
    case 4:
      items.erase(at(place()));
      break;
    case 5: {
      const std::string repeated = items[place()];
      items.insert(at(place()), repeated);
      break;
    }
    case 6:
      std::swap(items[place()], items[place()]);
      break;
    case 7:
      items.insert(at(place()), random_.chance(2) ? "" : "/* moves\n lines */");
      break;
    case 8:
      damage(items[place()]);
      break;
    default:
      edit_within(items[place()]);
  }
}

void EditedDesign::edit_inputs() {
  if (random_.chance(2)) {
    now_.inputs.time = static_cast<double>(random_.pick(4)) / 4;
    return;
  }
  auto& set = now_.inputs.parameters;
  if (random_.chance(4)) {
    set.reset();
    return;
  }
  if (!set) set.emplace();
  static constexpr const char* kNames[] = {"size", "count", "label", "v2"};
  const std::string name = kNames[random_.pick(std::size(kNames))];
  (*set)[name] = name == "label" ? "abc" : random_.number();
}

void EditedDesign::edit() {
  State last = now_;
  if (damaged_ == 0) sound_ = now_;
  if (damaged_ > 0 && ++damaged_ > 2 && random_.chance(2)) {
    now_ = sound_;
    damaged_ = 0;
  } else if (random_.chance(12)) {
    now_ = before_;
  } else if (random_.chance(10)) {
    edit_inputs();
  } else if (random_.chance(15)) {
    edit_color(now_.files["main.scad"]);
  } else if (random_.chance(30)) {
    now_.files["part.off"] = {part()};
  } else if (random_.chance(60)) {
    now_.files.erase(kFiles[3 + random_.pick(3)]);
    damaged_ = 1;
  } else {
    const std::string file = kFiles[random_.pick(std::size(kFiles))];
    edit_items(file);
  }
  before_ = std::move(last);
}

std::map<std::string, std::string> EditedDesign::texts() const {
  std::map<std::string, std::string> texts;
  for (const auto& [name, items] : now_.files) {
    std::string& text = texts[name];
    for (const std::string& item : items) text += item + "\n";
  }
  return texts;
}

}  // namespace window_test
