// The words that options take as values: what the parser knows is what the shells offer.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command/message_writer.hpp"
#include "command/option_row.hpp"
#include "csgcore/view.hpp"
#include "frontend/design_file_options.hpp"
#include "frontend/import_options.hpp"
#include "frontend/model_format.hpp"
#include "frontend/overlays.hpp"
#include "frontend/picture_file.hpp"
#include "frontend/render_settings.hpp"
#include "frontend/text_kind.hpp"

namespace frontend {

template <typename Value>
using Word = std::pair<const char*, Value>;

constexpr Word<PictureFormat> kFormats[] = {{"png", PictureFormat::kPng},
                                            {"exr", PictureFormat::kExr},
                                            {"gif", PictureFormat::kGif},
                                            {"webp", PictureFormat::kWebp}};
/// Formats of texts, beside those of pictures.
constexpr Word<TextKind> kTextKinds[] = {
    {"csg", TextKind::kCsg}, {"echo", TextKind::kEcho}, {"param", TextKind::kParam}};
/// Formats of solids and plane figures.
constexpr Word<ModelFormat> kModelFormats[] = {
    {"stl", ModelFormat::kStl}, {"binstl", ModelFormat::kStl}, {"asciistl", ModelFormat::kAsciiStl},
    {"off", ModelFormat::kOff}, {"obj", ModelFormat::kObj},    {"3mf", ModelFormat::k3mf},
    {"amf", ModelFormat::kAmf}, {"svg", ModelFormat::kSvg},    {"dxf", ModelFormat::kDxf},
    {"pdf", ModelFormat::kPdf}};
/// Formats that scadray leaves to openscad.
constexpr const char* kHandedFormats[] = {"wrl", "nef3", "nefdbg", "ast", "term", "pov"};
/// OpenSCAD's, which it reads in any case.
constexpr Word<bool> kBackends[] = {{"manifold", true}, {"cgal", false}};
constexpr const char* kWholeSummary = "all";
constexpr Word<bool SummaryParts::*> kSummaryParts[] = {
    {"cache", &SummaryParts::cache},
    {"time", &SummaryParts::time},
    {"camera", &SummaryParts::camera},
    {"geometry", &SummaryParts::geometry},
    {"bounding-box", &SummaryParts::bounding_box},
    {"area", &SummaryParts::area}};
constexpr Word<Evaluator> kEvaluators[] = {{"own", Evaluator::kOwn},
                                           {"openscad", Evaluator::kOpenScad}};
constexpr Word<language::LanguageVersion> kLanguages[] = {
    {"2021.01", language::LanguageVersion::k2021}, {"2026", language::LanguageVersion::k2026}};
constexpr Word<csgcore::Projection> kProjections[] = {
    {"o", csgcore::Projection::kOrthographic},
    {"ortho", csgcore::Projection::kOrthographic},
    {"orthogonal", csgcore::Projection::kOrthographic},
    {"p", csgcore::Projection::kPerspective},
    {"perspective", csgcore::Projection::kPerspective}};
/// Each with what it draws; of a wireframe these are the edges that are seen.
constexpr Word<bool Overlays::*> kViews[] = {
    {"axes", &Overlays::axes},     {"crosshairs", &Overlays::crosshairs},
    {"edges", &Overlays::edges},   {"grid", &Overlays::grid},
    {"scales", &Overlays::scales}, {"wireframe", &Overlays::edges}};
constexpr Word<Facets> kFacets[] = {{"all", Facets::kAll}, {"none", Facets::kNone}};
constexpr Word<Shading> kShadings[] = {
    {"openscad", Shading::kOpenScad}, {"phong", Shading::kPhong}, {"studio", Shading::kStudio}};
constexpr Word<Translucency> kTranslucencies[] = {{"file", Translucency::kFile},
                                                  {"depth", Translucency::kDepth}};
constexpr Word<Show> kShows[] = {{"surface", Show::kSurface},
                                 {"cells", Show::kCells},
                                 {"depth", Show::kDepth},
                                 {"normals", Show::kNormals},
                                 {"id", Show::kId}};
constexpr Word<RendererKind> kRenderers[] = {
    {"auto", RendererKind::kAuto}, {"gl", RendererKind::kGl}, {"cpu", RendererKind::kCpu}};
constexpr Word<Technique> kTechniques[] = {{"cells", Technique::kCells},
                                           {"tiles", Technique::kTiles}};
constexpr Word<MessageFormat> kMessageFormats[] = {{"text", MessageFormat::kText},
                                                   {"json", MessageFormat::kJson}};
/// Whether panning moves the view as far as OpenSCAD's.
constexpr Word<bool> kPans[] = {{"mouse", false}, {"openscad", true}};
/// OpenSCAD's, which reads them itself.
constexpr Word<bool> kTruthValues[] = {{"true", true}, {"false", false}};

/// What the word stands for, or null.
template <typename Value, std::size_t kCount>
const Value* find_word(const Word<Value> (&words)[kCount], std::string_view name) {
  for (const auto& [word, value] : words) {
    if (name == word) return &value;
  }
  return nullptr;
}

template <const auto& kWords>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const auto& word : kWords) names.emplace_back(word.first);
  return names;
}

/// The completion of an option that takes one of the words.
template <const auto& kWords>
constexpr Completion kOneOf{Completion::Kind::kWord, names_of<kWords>};

// Options that every program with a design has.
constexpr OptionRow kVariableOption{"D,D", Takes::kTexts, "VAR=VALUE", "a variable of the .scad"};
constexpr OptionRow kParameterFileOption{"p,p", Takes::kText, "FILE",
                                         "customizer's parameter file, for a .scad", kAnyFile};
constexpr OptionRow kParameterSetOption{"P,P", Takes::kText, "SET",
                                        "customizer's parameter set, for a .scad"};
constexpr OptionRow kEvaluatorOption{
    "evaluator", Takes::kText, "WHO",
    "what evaluates a .scad: own (scadray itself) or openscad; default own", kOneOf<kEvaluators>};
constexpr OptionRow kLanguageOption{
    "language", Takes::kText, "VERSION",
    "the OpenSCAD whose language a .scad is in, and that draws it: 2026, the development "
    "snapshots, or 2021.01, the last release; default: $SCADRAY_LANGUAGE, 2026",
    kOneOf<kLanguages>};
constexpr OptionRow kTimeoutOption{"openscad-timeout", Takes::kText, "SECONDS",
                                   "without effect: what is not drawn is left out"};
constexpr OptionRow kSkipOption{"skip-unsupported", Takes::kNothing, "",
                                "without effect: what is not drawn is left out"};
constexpr OptionRow kThreadsOption{"threads", Takes::kText, "N",
                                   "worker threads; default: as many as there are processors"};
constexpr OptionRow kVersionOption{"version,v", Takes::kNothing, "", "print the version"};
constexpr OptionRow kHelpOption{"help,h", Takes::kNothing, "", "print this text"};

}  // namespace frontend
