// import() as a function: a file of JSON becomes a value.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/evaluation_thread.hpp"
#include "base/read_file.hpp"
#include "functions/builtin_functions.hpp"
#include "language/make.hpp"
#include "values/members_object.hpp"

namespace language::functions {
namespace {

using Json = nlohmann::json;

/// Makes values of what the parser meets, however deeply it nests. Members are in the order of
/// their names; of those of one name the last counts.
class ValueMaker {
 public:
  const Value& value() const { return result_; }

  bool null() { return add(Value::undef()); }
  bool boolean(bool given) { return add(Value::boolean(given)); }
  bool number_integer(Json::number_integer_t number) { return add(static_cast<double>(number)); }
  bool number_unsigned(Json::number_unsigned_t number) { return add(static_cast<double>(number)); }
  bool number_float(double number, const std::string&) { return add(number); }
  bool string(const std::string& text) { return add(make_string(text)); }
  bool binary(const Json::binary_t&) { return false; }  // which JSON's text has not
  bool start_object(size_t) { return open(true); }
  bool start_array(size_t) { return open(false); }
  bool key(const std::string& name) {
    levels_.back().key = name;
    return true;
  }
  bool end_array() { return close(make_vector(levels_.back().elements)); }
  bool end_object() {
    Level& level = levels_.back();
    std::stable_sort(level.members.begin(), level.members.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    ObjectWriter object;
    for (auto& [name, value] : level.members) object.set(name, std::move(value));
    return close(object.take());
  }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) { return false; }

 private:
  struct Level {
    bool is_object;
    std::string key{};
    std::vector<Value> elements{};
    std::vector<std::pair<std::string, Value>> members{};
  };

  bool open(bool is_object) {
    levels_.push_back({is_object});
    return true;
  }
  bool close(Value value) {
    levels_.pop_back();
    return add(std::move(value));
  }
  bool add(Value value) {
    count_work();
    if (levels_.empty()) {
      result_ = std::move(value);
    } else if (levels_.back().is_object) {
      levels_.back().members.emplace_back(std::move(levels_.back().key), std::move(value));
    } else {
      levels_.back().elements.push_back(std::move(value));
    }
    return true;
  }

  Value result_;
  std::vector<Level> levels_;
};

}  // namespace

Value imported_json(const FunctionCall& call) {
  const std::string name(call.arguments[0].is_string() ? call.arguments[0].text() : "");
  const NamedFile file = call.environment.files.find(name, call.place);
  std::error_code failed;
  const bool is_folder = std::filesystem::is_directory(file.opened, failed);
  const auto text = read_regular_file(file.opened);
  if (!text && !is_folder) {
    call.warn("Could not read file '" + file.opened + "'");
    return Value::undef();
  }
  ValueMaker maker;
  constexpr bool kIsWhole = false;  // OpenSCAD reads a value, and looks at nothing behind it
  if (text && Json::sax_parse(*text, &maker, nlohmann::detail::input_format_t::json, kIsWhole))
    return maker.value();
  call.warn("Failed to parse file '" + file.opened + "': %s");  // which OpenSCAD says, too
  return Value::undef();
}

}  // namespace language::functions
