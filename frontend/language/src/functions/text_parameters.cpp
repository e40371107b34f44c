#include "functions/text_parameters.hpp"

#include <utility>

#include "functions/scripts.hpp"
#include "values/parameter_values.hpp"

namespace language {
namespace {

enum TextParameter : size_t {
  kTextOfText,
  kSizeOfText,
  kFontOfText,
  kDirectionOfText,
  kLanguageOfText,
  kScriptOfText,
  kHalignOfText,
  kValignOfText,
  kSpacingOfText,
  kEmOfText,
};

/// In which they are checked.
constexpr TextParameter kOrder[] = {
    kSizeOfText,      kEmOfText,       kTextOfText,   kSpacingOfText, kFontOfText,
    kDirectionOfText, kLanguageOfText, kScriptOfText, kHalignOfText,  kValignOfText};

/// Returns the direction that a name's first letter means; empty for none.
std::string_view direction_named(std::string_view name) {
  switch (name.empty() ? '\0' : name.front() | 0x20) {
    case 'l':
      return "ltr";
    case 'r':
      return "rtl";
    case 't':
      return "ttb";
    case 'b':
      return "btt";
    default:
      return {};
  }
}

}  // namespace

TextRequest text_request(std::span<const Value> parameters, std::string_view halign,
                         std::string_view valign) {
  constexpr double kSizeOfEm = 0.72;
  TextRequest request;
  request.text = text_or(parameters[kTextOfText], "");
  request.size = number_or(parameters[kSizeOfText], 10);
  if (parameters.size() > kEmOfText && parameters[kEmOfText].is_number())
    request.size = kSizeOfEm * parameters[kEmOfText].number();
  request.spacing = number_or(parameters[kSpacingOfText], 1);
  request.font = text_or(parameters[kFontOfText], "");
  const std::string_view script_name = text_or(parameters[kScriptOfText], "");
  const std::string code =
      script_name.empty() ? std::string(script_of(request.text)) : script_code(script_name);
  request.script = code.empty() ? script_name : code;
  request.direction = direction_named(text_or(parameters[kDirectionOfText], ""));
  if (request.direction.empty()) request.direction = direction_of_script(code);
  request.language = text_or(parameters[kLanguageOfText], "en");
  request.halign = text_or(parameters[kHalignOfText], halign);
  request.valign = text_or(parameters[kValignOfText], valign);
  return request;
}

void check_text_types(std::string_view callee, std::span<const Value> parameters,
                      const std::function<void(std::string)>& warn) {
  for (const TextParameter parameter : kOrder) {
    const Value& value = parameters[parameter];
    const bool is_number =
        parameter == kSizeOfText || parameter == kSpacingOfText || parameter == kEmOfText;
    const bool is_right = is_number ? value.is_number() : value.is_string();
    if (is_given(value) && !is_right)
      warn(wrong_type(callee, kTextParameters[parameter], is_number ? "number" : "string", value));
  }
}

}  // namespace language
