#include "command/export_option.hpp"

#include <array>
#include <cstdio>
#include <functional>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "command/arguments.hpp"
#include "language/color_names.hpp"

namespace frontend {
namespace {

using Stroke = ExportSettings::Stroke;

/// A setting that scadray's files have no place for. It is taken, and its value is not looked at.
struct Unused {
  const char* form;  // as --help-export shows it
};

/// The place of a value in the settings.
using Place = std::variant<Unused, std::function<bool&(ExportSettings&)>,
                           std::function<double&(ExportSettings&)>,
                           std::function<std::string&(ExportSettings&)>>;

constexpr const char* kAnyColor = "#";
constexpr double kMostStroke_mm = 999;

struct SettingRow {
  const char* section;
  const char* key;
  Place place;
  const char* words = "";  // of a text: those that it may be, with commas between; or kAnyColor
};

Place flag_of(Stroke ExportSettings::*part, bool Stroke::*member) {
  return [=](ExportSettings& s) -> bool& { return s.*part.*member; };
}
Place width_of(Stroke ExportSettings::*part) {
  return [=](ExportSettings& s) -> double& { return (s.*part).stroke_width; };
}
Place color_of(Stroke ExportSettings::*part, std::string Stroke::*member) {
  return [=](ExportSettings& s) -> std::string& { return s.*part.*member; };
}
Place flag(bool ExportSettings::*member) {
  return [=](ExportSettings& s) -> bool& { return s.*member; };
}
Place text(std::string ExportSettings::*member) {
  return [=](ExportSettings& s) -> std::string& { return s.*member; };
}

/// OpenSCAD's settings: --help-export of 2025.07, and the fills and strokes that its pull requests
/// 5863 and 6057 have added.
const std::vector<SettingRow>& rows() {
  using S = ExportSettings;
  constexpr const char* kPdf = "export-pdf";
  constexpr const char* k3mf = "export-3mf";
  constexpr const char* kSvg = "export-svg";
  static const std::vector<SettingRow> all = {
      {kPdf, "paper-size", text(&S::pdf_paper), "a6,a5,a4,a3,letter,legal,tabloid"},
      {kPdf, "orientation", text(&S::pdf_orientation), "portrait,landscape,auto"},
      {kPdf, "show-filename", Unused{"(bool)"}},
      {kPdf, "show-scale", Unused{"(bool)"}},
      {kPdf, "show-scale-message", Unused{"(bool)"}},
      {kPdf, "show-grid", Unused{"(bool)"}},
      {kPdf, "grid-size", Unused{"(double)"}},
      {kPdf, "fill", flag_of(&S::pdf, &Stroke::fill)},
      {kPdf, "fill-color", color_of(&S::pdf, &Stroke::fill_color), kAnyColor},
      {kPdf, "stroke", flag_of(&S::pdf, &Stroke::stroke)},
      {kPdf, "stroke-color", color_of(&S::pdf, &Stroke::stroke_color), kAnyColor},
      {kPdf, "stroke-width", width_of(&S::pdf)},
      {kPdf, "add-meta-data", flag(&S::pdf_meta_data)},
      {kPdf, "meta-data-title", text(&S::pdf_title)},
      {kPdf, "meta-data-author", text(&S::pdf_author)},
      {kPdf, "meta-data-subject", text(&S::pdf_subject)},
      {kPdf, "meta-data-keywords", text(&S::pdf_keywords)},
      {k3mf, "color-mode", text(&S::three_mf_colors), "model,none,selected-only"},
      {k3mf, "unit", text(&S::three_mf_unit), "micron,millimeter,centimeter,meter,inch,foot"},
      {k3mf, "color", text(&S::three_mf_color), kAnyColor},
      {k3mf, "material-type", text(&S::three_mf_material), "color,basematerial"},
      {k3mf, "decimal-precision", Unused{"(int)"}},
      {k3mf, "add-meta-data", flag(&S::three_mf_meta_data)},
      {k3mf, "meta-data-title", text(&S::three_mf_title)},
      {k3mf, "meta-data-designer", text(&S::three_mf_designer)},
      {k3mf, "meta-data-description", text(&S::three_mf_description)},
      {k3mf, "meta-data-copyright", text(&S::three_mf_copyright)},
      {k3mf, "meta-data-license-terms", text(&S::three_mf_license)},
      {k3mf, "meta-data-rating", text(&S::three_mf_rating)},
      {kSvg, "fill", flag_of(&S::svg, &Stroke::fill)},
      {kSvg, "fill-color", color_of(&S::svg, &Stroke::fill_color), kAnyColor},
      {kSvg, "stroke", flag_of(&S::svg, &Stroke::stroke)},
      {kSvg, "stroke-color", color_of(&S::svg, &Stroke::stroke_color), kAnyColor},
      {kSvg, "stroke-width", width_of(&S::svg)},
  };
  return all;
}

std::optional<bool> truth_of(const std::string& word) {
  if (word == "true" || word == "on" || word == "1") return true;
  if (word == "false" || word == "off" || word == "0") return false;
  return std::nullopt;
}

bool is_among(const std::string& word, const char* words) {
  for (const std::string_view candidate : split_at_commas(words)) {
    if (candidate == word) return true;
  }
  return false;
}

/// Sets the value. Returns what it may be if it is not that, or else nothing.
std::string set(const SettingRow& row, const std::string& value, ExportSettings& settings) {
  if (const auto* flag = std::get_if<1>(&row.place)) {
    const std::optional<bool> truth = truth_of(value);
    if (!truth) return "true or false";
    (*flag)(settings) = *truth;
  } else if (const auto* number = std::get_if<2>(&row.place)) {
    const std::optional<double> width = parse_number<double>(value);
    if (!width || *width < 0 || *width > kMostStroke_mm)
      return "a number of millimetres from 0 to 999";
    (*number)(settings) = *width;
  } else if (const auto* text = std::get_if<3>(&row.place)) {
    const bool is_color = row.words == std::string_view(kAnyColor);
    if (is_color && !language::color_of_name(value)) return "#rrggbb or a colour's name";
    if (!is_color && *row.words != '\0' && !is_among(value, row.words)) {
      return "one of " + std::string(row.words);
    }
    (*text)(settings) = value;
  }
  return {};
}

/// Returns "(enum): [a6,<a4>]" and the like.
std::string form_of(const SettingRow& row) {
  ExportSettings defaults;
  if (const auto* unused = std::get_if<Unused>(&row.place)) {
    return std::string(unused->form) + ": taken, without effect";
  }
  if (const auto* flag = std::get_if<1>(&row.place)) {
    return (*flag)(defaults) ? "(bool): <true>/false" : "(bool): true/<false>";
  }
  if (const auto* number = std::get_if<2>(&row.place)) {
    std::array<char, 64> form;
    std::snprintf(form.data(), form.size(), "(double): 0.000000 : <%f> : %f", (*number)(defaults),
                  kMostStroke_mm);
    return form.data();
  }
  const std::string& value = std::get<3>(row.place)(defaults);
  if (*row.words == '\0' || row.words == std::string_view(kAnyColor)) {
    return "(string): \"" + value + "\"";
  }
  std::string list;
  for (const std::string_view word : split_at_commas(row.words)) {
    list += list.empty() ? "" : ",";
    list += word == value ? "<" + value + ">" : std::string(word);
  }
  return "(enum): [" + list + "]";
}

}  // namespace

std::string read_export_setting(const std::string& text, ExportSettings& settings) {
  const std::size_t slash = text.find('/');
  const std::size_t equals = text.find('=');
  const std::string said = "-O " + text;
  if (equals == std::string::npos || slash >= equals) {
    return said + " is no setting and ignored (give SECTION/KEY=VALUE, see --help-export)";
  }
  const std::string section = text.substr(0, slash);
  const std::string key = text.substr(slash + 1, equals - slash - 1);
  for (const SettingRow& row : rows()) {
    if (section != row.section || key != row.key) continue;
    const std::string wanted = set(row, text.substr(equals + 1), settings);
    return wanted.empty() ? "" : said + " is not understood and ignored (give " + wanted + ")";
  }
  return said + " is not known and ignored (see --help-export)";
}

std::string export_settings_text() {
  std::string text =
      "Settings of exported files that -O takes, each as SECTION/KEY=VALUE, for example:\n"
      "scadray -O export-pdf/paper-size=a6 -O export-svg/fill=false -o x.svg -o x.pdf x.scad\n\n";
  std::string section;
  for (const SettingRow& row : rows()) {
    if (section != row.section) text += "Section '" + std::string(row.section) + "':\n";
    section = row.section;
    text += "  - " + std::string(row.key) + " " + form_of(row) + "\n";
  }
  return text;
}

}  // namespace frontend
